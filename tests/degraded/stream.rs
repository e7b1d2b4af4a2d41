//! A stream of frames, each given to the tracker in its own way, and the judgement over all of it.

use gentrack2::{Algorithm, Frame, ImageView, PixelFormat, Track, Tracker};

use crate::simulator::contract::Contract;
use crate::simulator::scene::{Observation, Scene};
use crate::simulator::verdict::Verdict;

/// One call of `step`.
#[derive(Clone, Debug)]
pub struct Given {
    pub seen: Observation,
    /// The detector rests.
    pub rests: bool,
    /// Seconds.
    pub time: Option<f64>,
    /// Size of the picture.
    pub size: (u32, u32),
    /// The camera's motion is told.
    pub moved: bool,
}

impl Given {
    pub fn frame(&self) -> Frame<'_> {
        let (width, height) = self.size;
        let image = self.seen.image.as_ref();
        Frame {
            detections: if self.rests { &[] } else { &self.seen.detections },
            detector_skipped: self.rests,
            image: image.map(|data| ImageView::new(data, width, height, 0, PixelFormat::Gray8).unwrap()),
            size: Some(self.size),
            camera_motion: self.moved.then_some(self.seen.camera_motion),
            timestamp_ns: self.time.map(|t| (t * 1e9) as i64),
            ..Frame::default()
        }
    }
}

/// The frames of a scene as they are, without timestamps.
pub fn frames(scene: &Scene, images: bool) -> Vec<Given> {
    let size = (scene.width, scene.height);
    let given = |seen| Given { seen, rests: false, time: None, size, moved: false };
    scene.play(images).map(given).collect()
}

/// The same with the time of each frame.
pub fn timed(scene: &Scene, images: bool) -> Vec<Given> {
    frames(scene, images).into_iter().map(|given| Given { time: Some(given.seen.time), ..given }).collect()
}

/// Gives the stream to the tracker and judges what comes out.
pub fn play(tracker: &mut Tracker, scene: &Scene, stream: &[Given]) -> Verdict {
    let mut verdict = Verdict::new(scene);
    verdict.contract = Contract::of(tracker.algorithm());
    for given in stream {
        tracker.step(&given.frame()).unwrap();
        verdict.watch(&given.seen, !given.rests, tracker.output());
    }
    verdict
}

/// The identities under which each object's detections are reported, without repetition, in the order of their coming.
pub fn identities(tracker: &mut Tracker, scene: &Scene, stream: &[Given]) -> Vec<Vec<u64>> {
    let mut identities = vec![Vec::new(); scene.objects.len()];
    for given in stream {
        let output = tracker.step(&given.frame()).unwrap();
        let on_object = |track: &Track| given.seen.source[track.detection_index?];
        for (object, id) in output.reported.iter().filter_map(|track| Some((on_object(track)?, track.id))) {
            if !identities[object].contains(&id) {
                identities[object].push(id);
            }
        }
    }
    identities
}

/// Demands one identity for everybody from beginning to end, shown where they are.
pub fn demand_identities(
    algorithm: Algorithm,
    tracker: impl Fn() -> Tracker,
    seeds: std::ops::Range<u64>,
    scene: impl Fn(u64) -> Scene,
    stream: impl Fn(&Scene) -> Vec<Given>,
) {
    let mut complaints = Vec::new();
    for seed in seeds {
        let scene = scene(seed);
        let verdict = play(&mut tracker(), &scene, &stream(&scene));
        complaints.extend(verdict.complaints().into_iter().map(|c| format!("seed {seed}: {c}")));
    }
    assert!(complaints.is_empty(), "{}:\n{}", algorithm.name(), complaints.join("\n"));
}
