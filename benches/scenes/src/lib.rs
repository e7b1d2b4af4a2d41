//! What is fed to the trackers when they are measured: made-up crowds, MOT17 where it is at hand, and trackers set up for
//! both.

mod crowd;
mod mot17;
mod noise;
mod picture;

pub use crowd::{Canvas, Crowd};
pub use mot17::{has_mot17, mot17_04};
pub use picture::Picture;

use gentrack2::{Algorithm, Config, Detection, Tracker};

/// The scores that trackers of one round are given where a detector reports weak boxes, too.
pub const STRONG: f64 = 0.6;

/// The detections of a video, frame by frame.
#[derive(Clone, Debug)]
pub struct Video {
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// The detections of each frame.
    pub frames: Vec<Vec<Detection>>,
}

impl Video {
    /// The same with the detections from this score on.
    pub fn scored_from(&self, score: f64) -> Video {
        let strong = |frame: &Vec<Detection>| frame.iter().filter(|d| d.score >= score).copied().collect();
        Video { size: self.size, frames: self.frames.iter().map(strong).collect() }
    }
}

/// A tracker with its defaults.
pub fn tracker(algorithm: Algorithm) -> Tracker {
    Tracker::new(&Config::of(algorithm)).expect("defaults make a tracker")
}

/// Whether an algorithm has one round only and is to be fed with good detections.
pub fn wants_strong(algorithm: Algorithm) -> bool {
    matches!(algorithm, Algorithm::Sort | Algorithm::DeepSort)
}
