//! The scene: ten people walk in five lanes, two to a lane at one speed, so that nobody ever meets or hides anybody. The
//! detector, whose boxes tremble, misses nobody. Where somebody's identity is lost here, it was for the degradation
//! alone.

use gentrack2::{Algorithm, Tracker};

use crate::simulator::detector::Detector;
use crate::simulator::driver::tracker_of;
use crate::simulator::noise::Noise;
use crate::simulator::path::Path;
use crate::simulator::scene::{Object, Scene};

/// Seconds.
pub const DURATION: f64 = 5.0;
/// Several seeds: speeds, sizes, the detector's noise and misses differ.
pub const SEEDS: std::ops::Range<u64> = 0..4;

pub fn lanes(seed: u64) -> Scene {
    let mut vary = Noise::new(seed, 21);
    let mut objects = Vec::new();
    for lane in 0..5 {
        let rightwards = lane % 2 == 0;
        let speed = vary.between(40.0, 90.0);
        let height = vary.between(86.0, 100.0);
        for nth in 0..2 {
            let from = 50.0 + 130.0 * nth as f64 + vary.between(0.0, 20.0);
            let (x, vx) = if rightwards { (from, speed) } else { (768.0 - from, -speed) };
            let path = Path::from(0.0, x, 60.0 + 113.0 * lane as f64).walk(vx, 0.0, DURATION);
            objects.push(Object::new(0.42 * height, height, objects.len() as f64, path));
        }
    }
    let mut scene = Scene::new(seed, DURATION, objects);
    scene.detector = Detector { miss: 0.0, clutter: 0.0, ..scene.detector };
    scene
}

/// A tracker as the documentation says that it is to be set up for input that is not perfect: the defaults, but for the
/// memory of a single frame of sort, and conftrack's demand that boxes overlap by two fifths. All follow the camera
/// where its motion is given.
pub fn patient(algorithm: Algorithm, more: &[(&str, &str)]) -> Tracker {
    let mut settings = vec![("use_camera_motion", "true")];
    match algorithm {
        Algorithm::Sort => settings.push(("max_age", "30")),
        Algorithm::ConfTrack => settings.extend([("proximity_thresh", "0.8"), ("noise_scaling", "false")]),
        _ => {}
    }
    settings.extend(more);
    tracker_of(algorithm, &settings)
}
