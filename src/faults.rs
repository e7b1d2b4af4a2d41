//! Faults on demand, for tests: the stages of the library's work, each of which can be made to panic or to fail.
//!
//! Without the cargo feature `fault-injection`, which no library for use has, a point is nothing at all. With it, faults
//! are those of the calling thread and of one closure, see `inject`; nothing lasts, and no other thread sees any.

/// A stage of the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// A parameter is set.
    Configuration,
    /// A tracker is built, also by a reset and of a snapshot.
    Building,
    /// What the caller hands in is borrowed.
    Borrowing,
    /// A frame is checked.
    Validation,
    /// The rows of a frame are sorted by class.
    ClassSplit,
    /// What became of one class is added to the whole.
    ClassMerge,
    /// Tracks are predicted.
    Prediction,
    /// Particles are sampled and guided.
    Particles,
    /// Embeddings are made unit vectors.
    Embeddings,
    /// Something is described by how it looks in the image.
    Appearance,
    /// Boxes that overlap are sought.
    Candidates,
    /// A round of association begins.
    Association,
    /// An assignment is solved.
    Assignment,
    /// A track takes a detection.
    Update,
    /// A track is begun.
    Birth,
    /// Tracks are ended.
    Removal,
    /// Tracks are listed for the caller.
    Output,
    /// The lists are put into their C form.
    Publishing,
    /// A tracker is written to a snapshot.
    Saving,
    /// A tracker is read from a snapshot.
    Loading,
    /// A tracker is given back.
    Freeing,
}

/// Where a stage begins that cannot fail: a test may have it panic.
#[inline(always)]
pub(crate) fn point(stage: Stage) {
    let _ = stage;
    #[cfg(feature = "fault-injection")]
    if injected::strikes(stage) == Some(Action::Fail) {
        panic!("{stage:?} cannot fail, it can only panic");
    }
}

/// Where a stage begins that can fail: a test may have it panic or return the stage's own error.
#[inline(always)]
pub(crate) fn fallible<E>(stage: Stage, error: impl FnOnce(String) -> E) -> Result<(), E> {
    let _ = (stage, &error);
    #[cfg(feature = "fault-injection")]
    if injected::strikes(stage) == Some(Action::Fail) {
        return Err(error(format!("injected fault in {stage:?}")));
    }
    Ok(())
}

#[cfg(feature = "fault-injection")]
pub use injected::{Action, Fault, inject, trace};

#[cfg(feature = "fault-injection")]
mod injected {
    use std::cell::RefCell;

    use super::Stage;

    /// What a fault does.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Action {
        /// It panics.
        Panic,
        /// The stage returns its error, if it is one that has errors.
        Fail,
    }

    /// A fault to come.
    #[derive(Clone, Copy, Debug)]
    pub struct Fault {
        /// Where.
        pub stage: Stage,
        /// The how manieth time that the stage begins, from 0.
        pub nth: usize,
        /// What happens there.
        pub action: Action,
    }

    /// What is going on in a thread that is inside of `inject` or `trace`.
    struct Watch {
        fault: Option<Fault>,
        begun: Vec<Stage>,
        struck: bool,
    }

    thread_local! {
        static WATCH: RefCell<Option<Watch>> = const { RefCell::new(None) };
    }

    /// Takes the watch away again, whatever happened.
    struct Scope;

    impl Drop for Scope {
        fn drop(&mut self) {
            WATCH.with(|w| w.take());
        }
    }

    fn watched<T>(fault: Option<Fault>, body: impl FnOnce() -> T) -> (T, Watch) {
        let watch = Watch { fault, begun: Vec::new(), struck: false };
        assert!(WATCH.with(|w| w.replace(Some(watch))).is_none(), "one fault at a time");
        let _scope = Scope;
        let result = body();
        let watch = WATCH.with(|w| w.take()).expect("only the scope takes it away");
        (result, watch)
    }

    /// Runs `body` with a fault in this thread; tells whether it was met.
    pub fn inject<T>(fault: Fault, body: impl FnOnce() -> T) -> (T, bool) {
        let (result, watch) = watched(Some(fault), body);
        (result, watch.struck)
    }

    /// Runs `body` and lists the stages that began in this thread, in their order.
    pub fn trace<T>(body: impl FnOnce() -> T) -> (T, Vec<Stage>) {
        let (result, watch) = watched(None, body);
        (result, watch.begun)
    }

    /// A stage begins. Panics if that is the fault, or returns the other thing to do.
    pub(super) fn strikes(stage: Stage) -> Option<Action> {
        let action = WATCH.with_borrow_mut(|watch| {
            let watch = watch.as_mut()?;
            let nth = watch.begun.iter().filter(|s| **s == stage).count();
            watch.begun.push(stage);
            let fault = watch.fault.filter(|f| f.stage == stage && f.nth == nth)?;
            watch.struck = true;
            Some(fault.action)
        });
        if action == Some(Action::Panic) {
            panic!("injected fault in {stage:?}");
        }
        action
    }
}
