//! What is counted: a few steps of every tracker in the middle of a scene.

use std::hint::black_box;

use gentrack2::{Algorithm, CameraMotion, Embeddings, Frame};
use scenes::{Canvas, Crowd, Picture, tracker};

/// Steps before those that count.
const WARM_UP: usize = 12;
/// Steps that count.
pub const STEPS: usize = 6;
/// The function in which callgrind counts.
pub const MEASURED: &str = "measured_step";
/// Numbers per embedding.
const DIMENSION: usize = 16;

/// A scene.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Scene {
    /// Boxes on a canvas that grows with their number.
    Sparse(usize),
    /// Boxes on a canvas of one size.
    Crowd(usize),
    /// Boxes with embeddings and camera motion.
    Looks(usize),
    /// Boxes in a picture.
    Picture(usize),
}

/// A tracker in a scene.
pub struct Case {
    pub name: &'static str,
    algorithm: Algorithm,
    scene: Scene,
}

macro_rules! cases {
    ($($name:literal $algorithm:ident $scene:ident $boxes:literal),* $(,)?) => {
        /// All cases.
        pub const CASES: &[Case] = &[$(Case {
            name: $name,
            algorithm: Algorithm::$algorithm,
            scene: Scene::$scene($boxes),
        }),*];
    };
}

cases! {
    "sort-100" Sort Sparse 100,
    "deepsort-100" DeepSort Sparse 100,
    "bytetrack-100" ByteTrack Sparse 100,
    "botsort-100" BotSort Sparse 100,
    "ocsort-100" OcSort Sparse 100,
    "smiletrack-100" SmileTrack Sparse 100,
    "conftrack-100" ConfTrack Sparse 100,
    "gentrack2-100" GenTrack2 Sparse 100,
    "bytetrack-2000" ByteTrack Sparse 2000,
    "ocsort-2000" OcSort Sparse 2000,
    "gentrack2-2000" GenTrack2 Sparse 2000,
    "sort-crowd-1000" Sort Crowd 1000,
    "bytetrack-crowd-1000" ByteTrack Crowd 1000,
    "ocsort-crowd-1000" OcSort Crowd 1000,
    "conftrack-crowd-1000" ConfTrack Crowd 1000,
    "gentrack2-crowd-1000" GenTrack2 Crowd 1000,
    "deepsort-looks-100" DeepSort Looks 100,
    "botsort-looks-100" BotSort Looks 100,
    "gentrack2-looks-100" GenTrack2 Looks 100,
    "gentrack2-picture-40" GenTrack2 Picture 40,
}

/// A step that callgrind counts: found by its name.
#[unsafe(no_mangle)]
#[inline(never)]
fn measured_step(tracker: &mut gentrack2::Tracker, frame: &Frame<'_>) {
    black_box(tracker.step(frame)).expect("the frame is valid");
}

/// Runs a case.
pub fn run(name: &str) -> Result<(), String> {
    let case = CASES.iter().find(|case| case.name == name).ok_or_else(|| format!("no case {name}"))?;
    let (canvas, boxes) = match case.scene {
        Scene::Crowd(n) => (Canvas::Fixed, n),
        Scene::Sparse(n) | Scene::Looks(n) | Scene::Picture(n) => (Canvas::Growing, n),
    };
    let video = Crowd::new(boxes, canvas, 1).video(WARM_UP + STEPS);
    let most = video.frames.iter().map(Vec::len).max().unwrap_or_default();
    let embeddings: Vec<f32> = (0..most * DIMENSION).map(|i| (i * 2_654_435_761 % 997) as f32 / 997.0 - 0.5).collect();
    let picture = matches!(case.scene, Scene::Picture(_)).then(|| Picture::new(video.size, 0));
    let mut tracker = tracker(case.algorithm);
    for (number, detections) in video.frames.iter().enumerate() {
        let mut frame = Frame { size: Some(video.size), ..Frame::new(detections) };
        if matches!(case.scene, Scene::Looks(_)) {
            frame.embeddings = Some(Embeddings::new(&embeddings, DIMENSION));
            frame.camera_motion = Some(CameraMotion([1.0, 0.0, 0.3, 0.0, 1.0, -0.2]));
        }
        frame.image = picture.as_ref().map(Picture::view);
        if number < WARM_UP {
            tracker.step(&frame).map_err(|e| e.to_string())?;
        } else {
            measured_step(&mut tracker, &frame);
        }
    }
    Ok(())
}
