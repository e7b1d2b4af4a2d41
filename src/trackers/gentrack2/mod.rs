//! GenTrack2, one file per step of the paper's Algorithm 1.

mod parameters;

pub use parameters::*;

use crate::frame::Frame;
use crate::track::Output;
use crate::tracker::StepContext;
use crate::trackers::TrackingAlgorithm;

/// The tracker.
pub struct GenTrack2 {
    parameters: GenTrack2Parameters,
}

impl GenTrack2 {
    /// A tracker without tracks.
    pub fn new(parameters: GenTrack2Parameters) -> Self {
        Self { parameters }
    }
}

impl TrackingAlgorithm for GenTrack2 {
    fn step(&mut self, _frame: &Frame<'_>, _context: &mut StepContext<'_>, _output: &mut Output) {}
    fn reset(&mut self) {}
}
