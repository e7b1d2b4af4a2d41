//! Every stage of the work is made to panic, and where it has errors to fail, in the middle of a scene: the process lives,
//! the handle is poisoned and a reset makes it as new, a failed call has changed nothing, and other handles never notice.
//!
//! Needs the feature `fault-injection`; tools/features.sh runs it.

// The C ABI is called as C does.
#![allow(unsafe_code)]
#![cfg(feature = "snapshot")]

mod simulator;

use std::collections::BTreeSet;
use std::ffi::{CStr, CString};
use std::ptr::{null, null_mut};

use gentrack2::Algorithm;
use gentrack2::capi::*;
use gentrack2::faults::{Action, Fault, Stage, inject, trace};
use simulator::noise::Noise;

const FRAMES: usize = 16;
const WIDTH: u32 = 320;
const HEIGHT: u32 = 240;
const DIMENSION: usize = 4;
const POLICIES: [&CStr; 2] = [c"ignore", c"separate"];

/// What is handed in for a frame, in the caller's memory.
struct Input {
    detections: Vec<gt2_detection>,
    embeddings: Vec<f32>,
    pixels: Vec<u8>,
    motion: [f64; 6],
    skipped: bool,
    time: i64,
}

impl Input {
    /// Two that walk through each other, three side by side whose boxes overlap, two of them of one class, one that comes
    /// late, one that goes and weak ones, under a camera that moves a little; once the detector rests.
    fn of(frame: usize) -> Self {
        let t = frame as f64;
        let side_by_side = [(200.0, 120.0, 0.8), (216.0, 121.0, 0.75), (209.0, 118.0, 0.7)];
        let mut boxes = vec![(40.0 + 8.0 * t, 60.0, 0.9), (160.0 - 8.0 * t, 64.0, 0.85)];
        boxes.extend(side_by_side);
        match frame {
            0..=4 => boxes.push((40.0 + 2.0 * t, 150.0, 0.95)),
            8.. => boxes.push((100.0 + 3.0 * t, 150.0, 0.9)),
            _ => {}
        }
        if frame % 3 == 2 {
            boxes[1].2 = 0.4;
        }
        let skipped = frame == 6;
        let boxes = if skipped { Vec::new() } else { boxes };
        let detection = |(row, (left, top, score)): (usize, &(f64, f64, f64))| gt2_detection {
            left: *left,
            top: *top,
            width: 30.0,
            height: 70.0,
            score: *score,
            class_id: row as i32 % 2,
            reserved: 0,
            tag: row as u64,
        };
        let mut noise = Noise::new(3, 0);
        let pixels: Vec<u8> = (0..WIDTH * HEIGHT).map(|_| noise.bits() as u8).collect();
        let look = |row: usize| (0..DIMENSION).map(move |k| if row % DIMENSION == k { 1.0 } else { 0.1 });
        Self {
            detections: boxes.iter().enumerate().map(detection).collect(),
            embeddings: (0..boxes.len()).flat_map(look).collect(),
            pixels,
            motion: [1.0, 0.0, 0.3, 0.0, 1.0, -0.2],
            skipped,
            time: 33_333_333 * frame as i64,
        }
    }

    fn step(&self, tracker: *mut gt2_tracker) -> gt2_status {
        let image = gt2_image {
            struct_size: size_of::<gt2_image>(),
            data: self.pixels.as_ptr(),
            stride: 0,
            width: WIDTH,
            height: HEIGHT,
            format: GT2_PIXEL_GRAY8,
            reserved: 0,
        };
        let frame = gt2_frame {
            struct_size: size_of::<gt2_frame>(),
            detections: self.detections.as_ptr(),
            detection_count: self.detections.len(),
            detection_stride: size_of::<gt2_detection>(),
            embeddings: if self.skipped { null() } else { self.embeddings.as_ptr() },
            embedding_dimension: if self.skipped { 0 } else { DIMENSION },
            embedding_stride: 0,
            image: &image,
            camera_motion: self.motion.as_ptr(),
            image_width: 0,
            image_height: 0,
            timestamp_ns: self.time,
            has_timestamp: 1,
            detector_skipped: i32::from(self.skipped),
        };
        // SAFETY: a live handle, and a frame whose pointers are live and whose counts are true.
        unsafe { gt2_tracker_step(tracker, &frame) }
    }
}

fn inputs() -> Vec<Input> {
    (0..FRAMES).map(Input::of).collect()
}

struct Config(*mut gt2_config);

impl Config {
    fn new(algorithm: Algorithm, policy: &CStr) -> Self {
        let name = CString::new(algorithm.name()).unwrap();
        let mut config = null_mut();
        // SAFETY: live texts and outputs. A parameter that not all have may be unknown.
        unsafe {
            assert_eq!(gt2_config_new(name.as_ptr(), &mut config), GT2_OK);
            assert_eq!(gt2_config_set(config, c"class_policy".as_ptr(), policy.as_ptr()), GT2_OK);
            // Who goes is given up within the scene.
            for (key, value) in [(c"use_camera_motion", c"true"), (c"max_age", c"3"), (c"track_buffer", c"3")] {
                let status = gt2_config_set(config, key.as_ptr(), value.as_ptr());
                assert!([GT2_OK, GT2_ERR_UNKNOWN_PARAMETER].contains(&status), "{}", message());
            }
        }
        Self(config)
    }

    fn set(&self, key: &CStr, value: &CStr) -> gt2_status {
        // SAFETY: a live handle and live texts.
        unsafe { gt2_config_set(self.0, key.as_ptr(), value.as_ptr()) }
    }

    fn new_tracker(&self, out: &mut *mut gt2_tracker) -> gt2_status {
        // SAFETY: a live handle and a live output.
        unsafe { gt2_tracker_new(self.0, out) }
    }
}

impl Drop for Config {
    fn drop(&mut self) {
        // SAFETY: a live handle, not used again.
        unsafe { gt2_config_free(self.0) }
    }
}

struct Tracker(*mut gt2_tracker);

impl Tracker {
    fn new(algorithm: Algorithm, policy: &CStr) -> Self {
        let mut tracker = null_mut();
        assert_eq!(Config::new(algorithm, policy).new_tracker(&mut tracker), GT2_OK);
        Self(tracker)
    }

    fn reset(&self) -> gt2_status {
        // SAFETY: a live handle.
        unsafe { gt2_tracker_reset(self.0) }
    }

    fn save(&self) -> Vec<u8> {
        let mut size = 0;
        // SAFETY: a live handle, and a buffer of the size given.
        unsafe {
            assert_eq!(gt2_tracker_save(self.0, null_mut(), 0, &mut size), GT2_OK);
            let mut bytes = vec![0; size];
            assert_eq!(gt2_tracker_save(self.0, bytes.as_mut_ptr(), size, &mut size), GT2_OK);
            bytes
        }
    }

    /// All that a caller sees, to the last bit, and all that the tracker knows.
    fn state(&self) -> (String, Vec<u8>) {
        let mut seen = String::new();
        for kind in [GT2_TRACKS_REPORTED, GT2_TRACKS_TENTATIVE, GT2_TRACKS_LOST] {
            let mut list = gt2_track_list { struct_size: 0, tracks: null(), count: 0, stride: 0 };
            // SAFETY: a live handle and a live output; the list is read before the next call.
            unsafe {
                assert_eq!(gt2_tracker_tracks(self.0, kind, &mut list), GT2_OK);
                for i in 0..list.count {
                    seen += &format!("{:?}\n", *list.tracks.byte_add(i * list.stride));
                }
            }
        }
        for list in [gt2_tracker_ended, gt2_tracker_track_of_detection] {
            let (mut ids, mut count) = (null(), 0);
            // SAFETY: as above.
            unsafe {
                assert_eq!(list(self.0, &mut ids, &mut count), GT2_OK);
                seen += &format!("{:?}\n", (0..count).map(|i| *ids.add(i)).collect::<Vec<u64>>());
            }
        }
        (seen, self.save())
    }

    /// Nothing is answered any more, and no output is written.
    fn assert_poisoned(&self, what: &str) {
        // SAFETY: all zero is a legal track.
        let mut track: gt2_track = unsafe { std::mem::zeroed() };
        let mut list = gt2_track_list { struct_size: 0, tracks: null(), count: 77, stride: 0 };
        let mut particles = gt2_particle_list { struct_size: 0, particles: null(), count: 77, stride: 0 };
        let (mut ids, mut count, mut needed) = (null(), 77, 77);
        // SAFETY: a live handle and live outputs.
        unsafe {
            let refused = [
                Input::of(0).step(self.0),
                gt2_tracker_tracks(self.0, GT2_TRACKS_REPORTED, &mut list),
                gt2_tracker_copy_tracks(self.0, GT2_TRACKS_LOST, &mut track, size_of::<gt2_track>(), 1, &mut needed),
                gt2_tracker_ended(self.0, &mut ids, &mut count),
                gt2_tracker_track_of_detection(self.0, &mut ids, &mut count),
                gt2_tracker_particles(self.0, 1, &mut particles),
                gt2_tracker_save(self.0, null_mut(), 0, &mut needed),
            ];
            assert_eq!(refused, [GT2_ERR_POISONED; 7], "{what}");
            assert!(gt2_tracker_algorithm(self.0).is_null(), "{what}");
        }
        assert_eq!((list.count, particles.count, count, needed, ids.is_null()), (77, 77, 77, 77, true), "{what}");
    }
}

impl Drop for Tracker {
    fn drop(&mut self) {
        // SAFETY: a live handle, not used again.
        unsafe { gt2_tracker_free(self.0) }
    }
}

fn message() -> String {
    // SAFETY: the text is valid until the next failing call.
    unsafe { CStr::from_ptr(gt2_last_error_message()) }.to_str().unwrap().to_string()
}

/// Runs a call that meets a panic.
fn panics(stage: Stage, nth: usize, what: &str, call: impl FnOnce() -> gt2_status) {
    let (status, struck) = inject(Fault { stage, nth, action: Action::Panic }, call);
    assert!(struck, "{what}: there was no such stage");
    assert_eq!(status, GT2_ERR_PANIC, "{what}: {}", message());
    assert!(
        message().starts_with(&format!("internal error: injected fault in {stage:?} at ")),
        "{what}: {}",
        message()
    );
}

/// Runs a call in which a stage returns its error.
fn fails(stage: Stage, nth: usize, status: gt2_status, what: &str, call: impl FnOnce() -> gt2_status) {
    let (got, struck) = inject(Fault { stage, nth, action: Action::Fail }, call);
    assert!(struck, "{what}: there was no such stage");
    assert_eq!(got, status, "{what}: {}", message());
    assert!(message().contains(&format!("injected fault in {stage:?}")), "{what}: {}", message());
}

/// A tracker's undisturbed run.
struct Reference {
    algorithm: Algorithm,
    policy: &'static CStr,
    inputs: Vec<Input>,
    /// Before the first frame, after the first, and so on.
    states: Vec<(String, Vec<u8>)>,
    /// The stages of each step.
    stages: Vec<Vec<Stage>>,
}

impl Reference {
    fn new(algorithm: Algorithm, policy: &'static CStr) -> Self {
        let tracker = Tracker::new(algorithm, policy);
        let inputs = inputs();
        let mut states = vec![tracker.state()];
        let mut stages = Vec::new();
        for input in &inputs {
            let (status, begun) = trace(|| input.step(tracker.0));
            assert_eq!(status, GT2_OK, "{}", message());
            stages.push(begun);
            states.push(tracker.state());
        }
        assert!(states[FRAMES].0.lines().count() > 4, "there is something to compare: {}", states[FRAMES].0);
        Self { algorithm, policy, inputs, states, stages }
    }

    fn tracker(&self) -> Tracker {
        Tracker::new(self.algorithm, self.policy)
    }

    /// Steps through these frames and compares all that there is to compare.
    fn follow(&self, tracker: &Tracker, frames: std::ops::Range<usize>, what: &str) {
        for frame in frames {
            assert_eq!(self.inputs[frame].step(tracker.0), GT2_OK, "{what}: {}", message());
            assert!(tracker.state() == self.states[frame + 1], "{what}: frame {frame} came out otherwise");
        }
    }

    fn tracker_before(&self, frame: usize) -> Tracker {
        let tracker = self.tracker();
        self.inputs[..frame].iter().for_each(|input| assert_eq!(input.step(tracker.0), GT2_OK));
        assert!(tracker.state() == self.states[frame]);
        tracker
    }

    /// Frame and number of a stage's occurrences that are worth a fault: the first, the last and one in between, in the
    /// first and the last frame that has the stage, and in the one that has it most often.
    fn places(&self, stage: Stage) -> BTreeSet<(usize, usize)> {
        let count = |frame: usize| self.stages[frame].iter().filter(|s| **s == stage).count();
        let frames: Vec<usize> = (0..FRAMES).filter(|f| count(*f) > 0).collect();
        let Some(most) = frames.iter().copied().max_by_key(|f| count(*f)) else { return BTreeSet::new() };
        let chosen = [frames[0], most, frames[frames.len() - 1]];
        chosen.iter().flat_map(|f| [0, count(*f) / 2, count(*f) - 1].map(|nth| (*f, nth))).collect()
    }

    fn all_stages(&self) -> BTreeSet<Stage> {
        self.stages.iter().flatten().copied().collect()
    }
}

const FALLIBLE_IN_A_STEP: [(Stage, gt2_status); 2] =
    [(Stage::Borrowing, GT2_ERR_INVALID_ARGUMENT), (Stage::Validation, GT2_ERR_FRAME)];

for_every_algorithm! {
    /// So that no stage is forgotten below.
    fn a_step_goes_through_its_stages(algorithm: Algorithm) {
        use Stage::*;
        let mut expected = BTreeSet::from([
            Borrowing, Validation, Prediction, Candidates, Association, Assignment, Update, Birth, Removal, Output, Publishing,
        ]);
        if !matches!(algorithm, Algorithm::Sort | Algorithm::OcSort) {
            expected.insert(Embeddings);
        }
        if algorithm == Algorithm::GenTrack2 {
            expected.extend([Particles, Appearance]);
        }
        assert_eq!(Reference::new(algorithm, POLICIES[0]).all_stages(), expected);
        expected.extend([ClassSplit, ClassMerge]);
        assert_eq!(Reference::new(algorithm, POLICIES[1]).all_stages(), expected);
    }

    fn a_panic_in_a_step_poisons_that_handle_alone_until_it_is_reset(algorithm: Algorithm) {
        for policy in POLICIES {
            let reference = Reference::new(algorithm, policy);
            for stage in reference.all_stages() {
                for (frame, nth) in reference.places(stage) {
                    let what = format!("{policy:?}, {stage:?} number {nth} of frame {frame}");
                    let (struck, other) = (reference.tracker_before(frame), reference.tracker_before(frame));
                    let doomed = reference.tracker_before(frame);
                    let input = &reference.inputs[frame];
                    panics(stage, nth, &what, || input.step(struck.0));
                    panics(stage, nth, &what, || input.step(doomed.0));
                    struck.assert_poisoned(&what);
                    // A poisoned handle can be released as it is.
                    drop(doomed);
                    reference.follow(&other, frame..FRAMES, &what);
                    struck.assert_poisoned(&what);
                    assert_eq!(struck.reset(), GT2_OK, "{what}: {}", message());
                    assert!(struck.state() == reference.states[0], "{what}");
                    reference.follow(&struck, 0..FRAMES, &what);
                }
            }
        }
    }

    fn a_step_that_fails_leaves_everything_as_it_was(algorithm: Algorithm) {
        for policy in POLICIES {
            let reference = Reference::new(algorithm, policy);
            for (stage, status) in FALLIBLE_IN_A_STEP {
                for (frame, nth) in reference.places(stage) {
                    let what = format!("{policy:?}, {stage:?} number {nth} of frame {frame}");
                    let tracker = reference.tracker_before(frame);
                    fails(stage, nth, status, &what, || reference.inputs[frame].step(tracker.0));
                    assert!(tracker.state() == reference.states[frame], "{what}");
                    reference.follow(&tracker, frame..FRAMES, &what);
                }
            }
        }
    }

    fn other_threads_go_on_meanwhile(algorithm: Algorithm) {
        let reference = Reference::new(algorithm, POLICIES[0]);
        std::thread::scope(|scope| {
            let others = scope.spawn(|| {
                for _ in 0..10 {
                    reference.follow(&reference.tracker(), 0..FRAMES, "in another thread");
                }
            });
            while !others.is_finished() {
                let struck = reference.tracker();
                panics(Stage::Birth, 0, "birth", || reference.inputs[0].step(struck.0));
                assert_eq!(struck.reset(), GT2_OK);
            }
            others.join().unwrap();
        });
    }

    fn a_panic_while_saving_poisons_the_handle(algorithm: Algorithm) {
        for policy in POLICIES {
            let reference = Reference::new(algorithm, policy);
            let (_, stages) = trace(|| reference.tracker_before(5).save());
            let times = stages.iter().filter(|s| **s == Stage::Saving).count() / 4;
            assert_eq!(times, if policy == POLICIES[0] { 1 } else { 3 }, "itself and two classes");
            for nth in 0..times {
                let tracker = reference.tracker_before(5);
                let mut needed = 77;
                // SAFETY: a live handle and a live output.
                let save = || unsafe { gt2_tracker_save(tracker.0, null_mut(), 0, &mut needed) };
                panics(Stage::Saving, nth, "saving", save);
                assert_eq!(needed, 77);
                tracker.assert_poisoned("after saving");
                assert_eq!(tracker.reset(), GT2_OK);
                reference.follow(&tracker, 0..FRAMES, "after saving");
            }
        }
    }

    fn loading_that_goes_wrong_makes_no_tracker(algorithm: Algorithm) {
        for policy in POLICIES {
            let reference = Reference::new(algorithm, policy);
            let bytes = &reference.states[9].1;
            // SAFETY: a live array and a live output.
            let load = |out: &mut *mut gt2_tracker| unsafe { gt2_tracker_load(bytes.as_ptr(), bytes.len(), out) };
            let load_and_free = || {
                let mut out = null_mut();
                assert_eq!(load(&mut out), GT2_OK);
                drop(Tracker(out));
            };
            let ((), stages) = trace(load_and_free);
            let loading = [Stage::Configuration, Stage::Building, Stage::Loading, Stage::Publishing];
            for stage in loading {
                let count = stages.iter().filter(|s| **s == stage).count();
                assert!(count > 0, "{stage:?}");
                for nth in BTreeSet::from([0, count / 2, count - 1]) {
                    let mut out = null_mut();
                    panics(stage, nth, "loading", || load(&mut out));
                    if stage != Stage::Publishing {
                        fails(stage, nth, GT2_ERR_SNAPSHOT, "loading", || load(&mut out));
                    }
                    assert!(out.is_null(), "{stage:?} number {nth}");
                }
            }
            let mut out = null_mut();
            assert_eq!(load(&mut out), GT2_OK);
            reference.follow(&Tracker(out), 9..FRAMES, "loaded after all");
        }
    }

    fn a_tracker_that_cannot_be_built_is_not_made(algorithm: Algorithm) {
        for policy in POLICIES {
            let reference = Reference::new(algorithm, policy);
            let config = Config::new(algorithm, policy);
            let mut out = null_mut();
            fails(Stage::Building, 0, GT2_ERR_PARAMETER_VALUE, "new", || config.new_tracker(&mut out));
            assert!(out.is_null());
            assert_eq!(config.new_tracker(&mut out), GT2_OK);
            let earlier = Tracker(std::mem::replace(&mut out, null_mut()));
            for stage in [Stage::Building, Stage::Publishing] {
                let config = Config::new(algorithm, policy);
                panics(stage, 0, "new", || config.new_tracker(&mut out));
                assert!(out.is_null());
                assert_eq!(config.new_tracker(&mut out), GT2_ERR_POISONED);
            }
            reference.follow(&earlier, 0..FRAMES, "made before");
        }
    }

    fn a_reset_that_goes_wrong_can_be_repeated(algorithm: Algorithm) {
        for policy in POLICIES {
            let reference = Reference::new(algorithm, policy);
            let tracker = reference.tracker_before(7);
            fails(Stage::Building, 0, GT2_ERR_PARAMETER_VALUE, "reset", || tracker.reset());
            assert!(tracker.state() == reference.states[7], "nothing was forgotten");
            reference.follow(&tracker, 7..FRAMES, "after a reset that failed");
            for (stage, nth) in [(Stage::Building, 0), (Stage::Publishing, 0), (Stage::Publishing, 2)] {
                panics(stage, nth, "reset", || tracker.reset());
                tracker.assert_poisoned("after a reset that panicked");
                // Neither does it heal.
                fails(Stage::Building, 0, GT2_ERR_PARAMETER_VALUE, "reset", || tracker.reset());
                tracker.assert_poisoned("after a reset that failed");
                assert_eq!(tracker.reset(), GT2_OK);
                reference.follow(&tracker, 0..FRAMES, "reset after all");
            }
        }
    }

    fn a_panic_while_a_tracker_is_released_goes_no_further(algorithm: Algorithm) {
        let reference = Reference::new(algorithm, POLICIES[0]);
        let (tracker, other) = (reference.tracker_before(5), reference.tracker_before(5));
        panics(Stage::Freeing, 0, "free", || {
            drop(tracker);
            // It has no result.
            GT2_ERR_PANIC
        });
        reference.follow(&other, 5..FRAMES, "another one");
    }

    fn a_config_that_panicked_can_only_be_released(algorithm: Algorithm) {
        let (config, other) = (Config::new(algorithm, POLICIES[0]), Config::new(algorithm, POLICIES[0]));
        let text = |config: &Config| {
            let mut buffer = vec![0u8; 1 << 16];
            let mut needed = 0;
            // SAFETY: a live handle, and a buffer of the size given.
            let status = unsafe { gt2_config_to_toml(config.0, buffer.as_mut_ptr().cast(), buffer.len(), &mut needed) };
            (status, buffer)
        };
        let before = text(&config);
        assert_eq!(before.0, GT2_OK);
        let set = || config.set(c"max_tracks", c"7");
        fails(Stage::Configuration, 0, GT2_ERR_PARAMETER_VALUE, "set", set);
        assert!(text(&config) == before, "nothing was set");
        panics(Stage::Configuration, 0, "set", set);
        assert_eq!((set(), text(&config).0), (GT2_ERR_POISONED, GT2_ERR_POISONED));
        let mut out = null_mut();
        assert_eq!(config.new_tracker(&mut out), GT2_ERR_POISONED);
        assert!(out.is_null() && text(&other) == before);
        assert_eq!(other.new_tracker(&mut out), GT2_OK);
        drop(Tracker(out));
    }
}
