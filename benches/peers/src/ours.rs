//! The library's own trackers.

use std::hint::black_box;
use std::time::{Duration, Instant};

use gentrack2::{Algorithm, Frame, Tracker};
use scenes::Video;

use crate::contest::{Contestant, Entry};

struct Ours {
    algorithm: Algorithm,
    tracker: Tracker,
}

impl Contestant for Ours {
    fn begin(&mut self, _: &Video) {
        self.tracker = scenes::tracker(self.algorithm);
    }

    fn step(&mut self, video: &Video, frame: usize) -> Duration {
        let input = Frame { size: Some(video.size), ..Frame::new(&video.frames[frame]) };
        let start = Instant::now();
        black_box(self.tracker.step(&input)).expect("the frame is valid");
        start.elapsed()
    }
}

/// One of the library's trackers.
pub fn entry(algorithm: Algorithm) -> Entry {
    Entry { name: "gentrack2", tracker: Box::new(Ours { algorithm, tracker: scenes::tracker(algorithm) }) }
}
