//! What the classes of detections mean for tracking.

use crate::parameters::choice;

choice! {
    /// What a tracker makes of class ids.
    pub enum ClassPolicy {
        /// Nothing: a track takes detections of any class.
        Ignore = "ignore",
        /// A track takes detections of its own class only; all else is shared.
        SameClass = "same_class",
        /// Each class is tracked as if the others were not there.
        Separate = "separate",
    }
}

/// Whether what is of two classes may be compared at all.
#[derive(Clone, Copy, Debug, Default)]
pub struct ClassRule {
    same_only: bool,
}

impl ClassRule {
    /// The rule of a policy.
    pub fn of(policy: ClassPolicy) -> Self {
        Self { same_only: policy == ClassPolicy::SameClass }
    }

    /// Whether everything may be compared with everything.
    pub fn compares_all(self) -> bool {
        !self.same_only
    }

    /// Whether they may be taken for the same object.
    pub fn allows(self, a: i32, b: i32) -> bool {
        !self.same_only || a == b
    }
}
