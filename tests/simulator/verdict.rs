//! Judges a run: did every object keep its one identity, and was it shown where it was?

use std::collections::{BTreeMap, BTreeSet};

use gentrack2::Output;

use super::contract::Contract;
use super::driver::{Feed, tracker};
use super::scene::{Observation, Scene, Truth};

/// Frames with the detector running for which a track of nothing but clutter may be shown: a birth in the first frame
/// is trusted at once and is shown for one more frame.
const CLUTTER_FRAMES: usize = 2;
/// Seconds an object has, once well in view, to be recognised as one.
const WARM_UP: f64 = 0.5;
/// Share of the frames in which an object is well in view and must be shown.
const LEAST_SHOWN: f64 = 0.85;
/// Mean IoU with the truth while matched.
const LEAST_IOU: f64 = 0.75;
/// IoU of two objects' true boxes from which they coincide: whose of the two a detection is cannot be told from its
/// noisy box, so identities are judged again once they have parted.
const COINCIDENT: f64 = 0.5;

#[derive(Default)]
struct ObjectRecord {
    /// Frame and identity under which its detections were shown, where that changed.
    identities: Vec<(usize, u64)>,
    first_in_view: Option<f64>,
    in_view: usize,
    shown: usize,
    ious: Vec<f64>,
}

/// The record of one run.
pub struct Verdict {
    objects: Vec<ObjectRecord>,
    /// For each identity shown the number of frames with the detector running, and whether it was ever on an object.
    shown: BTreeMap<u64, (usize, bool)>,
    pub contract: Contract,
}

impl Verdict {
    pub fn new(scene: &Scene) -> Self {
        Self {
            objects: scene.objects.iter().map(|_| ObjectRecord::default()).collect(),
            shown: BTreeMap::new(),
            contract: Contract::default(),
        }
    }

    /// Takes note of one frame.
    pub fn watch(&mut self, seen: &Observation, detector_ran: bool, output: &Output) {
        self.contract.check(if detector_ran { &seen.detections } else { &[] }, output);
        let mut on_object = vec![None; self.objects.len()];
        for track in &output.reported {
            let entry = self.shown.entry(track.id).or_default();
            entry.0 += usize::from(detector_ran);
            if let Some(object) = track.detection_index.and_then(|row| seen.source[row]) {
                entry.1 = true;
                on_object[object] = Some(track);
            }
        }
        for truth in &seen.truth {
            let record = &mut self.objects[truth.object];
            if let Some(track) = on_object[truth.object] {
                let known = record.identities.last().is_some_and(|last| last.1 == track.id);
                if !known && !coincides(truth, &seen.truth) {
                    record.identities.push((seen.frame, track.id));
                }
                record.ious.push(track.rect.iou(&truth.rect));
            }
            if truth.visible >= 0.7 {
                let since = seen.time - *record.first_in_view.get_or_insert(seen.time);
                if since >= WARM_UP {
                    record.in_view += 1;
                    let identity = record.identities.last().map(|last| last.1);
                    record.shown += usize::from(output.reported.iter().any(|t| Some(t.id) == identity));
                }
            }
        }
    }

    /// The one identity of an object, 0 if it had none or several.
    pub fn identity(&self, object: usize) -> u64 {
        match self.objects[object].identities[..] {
            [(_, id)] => id,
            _ => 0,
        }
    }

    /// Everything that is wrong with the run, in words.
    pub fn complaints(&self) -> Vec<String> {
        let mut complaints = Vec::new();
        let mut owners = BTreeSet::new();
        for (object, record) in self.objects.iter().enumerate() {
            match record.identities[..] {
                [] => complaints.push(format!("object {object} was never shown")),
                [(_, id)] if !owners.insert(id) => complaints.push(format!("object {object} shares id {id}")),
                [_] => {}
                _ => complaints.push(format!("object {object} had (frame, id) {:?}", record.identities)),
            }
            if (record.shown as f64) < LEAST_SHOWN * record.in_view as f64 {
                complaints.push(format!("object {object} was shown in {} of {} frames", record.shown, record.in_view));
            }
            let mean = record.ious.iter().sum::<f64>() / record.ious.len().max(1) as f64;
            if mean < LEAST_IOU && !record.ious.is_empty() {
                complaints.push(format!("object {object} had a mean IoU of {mean:.2}"));
            }
        }
        for (id, (frames, on_object)) in &self.shown {
            if !on_object && *frames > CLUTTER_FRAMES {
                complaints.push(format!("id {id}, nothing but clutter, was shown for {frames} frames"));
            }
        }
        complaints
    }
}

fn coincides(one: &Truth, all: &[Truth]) -> bool {
    all.iter().any(|other| other.object != one.object && other.rect.iou(&one.rect) >= COINCIDENT)
}

/// Plays a scene to a fresh default tracker.
pub fn judge(scene: &Scene, feed: Feed) -> Verdict {
    let mut tracker = tracker(feed.seed);
    let mut verdict = Verdict::new(scene);
    for seen in scene.play(feed.image) {
        let output = feed.step(&mut tracker, scene, &seen).unwrap();
        verdict.watch(&seen, feed.detector_runs(seen.frame), output);
    }
    verdict
}

/// Plays the scene of each seed, with the tracker seeded likewise, and demands that nothing is wrong in any.
pub fn demand_identities(seeds: std::ops::Range<u64>, feed: Feed, scene: impl Fn(u64) -> Scene) {
    let mut complaints = Vec::new();
    for seed in seeds.clone() {
        let verdict = judge(&scene(seed), Feed { seed, ..feed });
        complaints.extend(verdict.complaints().into_iter().map(|c| format!("seed {seed}: {c}")));
    }
    let feed = format!("{feed:?}");
    assert!(
        complaints.is_empty(),
        "{} complaints in seeds {seeds:?}, {feed}:\n{}",
        complaints.len(),
        complaints.join("\n")
    );
}
