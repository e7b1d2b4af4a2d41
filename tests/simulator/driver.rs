//! Feeds a scene to a tracker.

use gentrack2::{Algorithm, Config, Error, Frame, ImageView, Output, PixelFormat, Tracker};

use super::scene::{Observation, Scene};

/// What the tracker is given besides the detections.
#[derive(Clone, Copy, Debug)]
pub struct Feed {
    pub image: bool,
    pub camera_motion: bool,
    pub timestamps: bool,
    /// The detector runs on one frame in so many.
    pub detect_every: usize,
    /// Seed of the tracker.
    pub seed: u64,
}

impl Default for Feed {
    fn default() -> Self {
        Self { image: false, camera_motion: false, timestamps: false, detect_every: 1, seed: 0 }
    }
}

impl Feed {
    pub fn with_image(image: bool) -> Self {
        Self { image, ..Self::default() }
    }

    pub fn detector_runs(&self, frame: usize) -> bool {
        frame.is_multiple_of(self.detect_every)
    }

    /// Gives one observation to the tracker.
    pub fn step<'t>(&self, tracker: &'t mut Tracker, scene: &Scene, seen: &Observation) -> Result<&'t Output, Error> {
        let runs = self.detector_runs(seen.frame);
        let image = seen.image.as_ref().filter(|_| self.image);
        tracker.step(&Frame {
            detections: if runs { &seen.detections } else { &[] },
            detector_skipped: !runs,
            image: image.map(|d| ImageView::new(d, scene.width, scene.height, 0, PixelFormat::Gray8).unwrap()),
            size: Some((scene.width, scene.height)),
            camera_motion: self.camera_motion.then_some(seen.camera_motion),
            timestamp_ns: self.timestamps.then_some((seen.time * 1e9) as i64),
            ..Frame::default()
        })
    }
}

/// The default tracker with a seed.
pub fn tracker(seed: u64) -> Tracker {
    let mut config = Config::new("gentrack2").unwrap();
    config.set_text("seed", &seed.to_string()).unwrap();
    Tracker::new(&config).unwrap()
}

/// The default tracker of an algorithm, but for some settings. Those that the algorithm does not have are left out.
pub fn tracker_of(algorithm: Algorithm, settings: &[(&str, &str)]) -> Tracker {
    let mut config = Config::of(algorithm);
    for (key, text) in settings {
        if *key == "preset" || config.get(key).is_ok() {
            config.set_text(key, text).unwrap();
        }
    }
    Tracker::new(&config).unwrap()
}

/// An output as text that is equal only for equal bits (Rust prints floats so that they can be read back exactly).
pub fn exact(output: &Output) -> String {
    format!("{output:?}")
}

/// The exact outputs of a whole scene.
pub fn transcript(scene: &Scene, feed: Feed, tracker: &mut Tracker) -> Vec<String> {
    scene.play(feed.image).map(|seen| exact(feed.step(tracker, scene, &seen).unwrap())).collect()
}
