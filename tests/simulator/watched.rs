//! A tracker whose every output is checked.

use gentrack2::{Algorithm, Frame, Tracker};

use super::contract::{Contract, all_tracks};
use super::driver::tracker_of;

/// Steps a tracker and holds it to the contract.
pub struct Watched {
    pub tracker: Tracker,
    pub contract: Contract,
}

impl Watched {
    /// Goes along with the camera, as only some do without being told.
    pub fn new(algorithm: Algorithm) -> Self {
        Self::with(algorithm, &[("use_camera_motion", "true")])
    }

    pub fn with(algorithm: Algorithm, settings: &[(&str, &str)]) -> Self {
        Self { tracker: tracker_of(algorithm, settings), contract: Contract::of(algorithm) }
    }

    pub fn step(&mut self, frame: &Frame<'_>) {
        self.tracker.step(frame).unwrap();
        self.contract.check(frame.detections, self.tracker.output());
    }

    pub fn reported(&self) -> usize {
        self.tracker.output().reported.len()
    }

    pub fn listed(&self) -> usize {
        all_tracks(self.tracker.output()).count()
    }
}
