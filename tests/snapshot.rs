//! A tracker that is saved and loaded goes on as if nothing had happened, and what is no snapshot is refused.
#![cfg(feature = "snapshot")]

mod simulator;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use gentrack2::{Algorithm, CameraMotion, Detection, Embeddings, Error, Frame, ImageView, PixelFormat, Tracker};
use simulator::driver::{exact, tracker_of};
use simulator::everyone::CLASS_POLICIES;
use simulator::noise::Noise;
use simulator::scene::{Observation, Scene};
use simulator::stage;

/// Ten crossing targets with clutter and misses, under a camera that shakes.
fn scene() -> Scene {
    Scene { duration: 2.0, ..stage::moving_camera(3, stage::SHAKE) }
}

const DIMENSION: usize = 16;

/// Gives one observation with everything that a frame can have; every fourth frame the detector does not run.
fn step(tracker: &mut Tracker, scene: &Scene, seen: &Observation) -> String {
    let runs = seen.frame % 4 != 3;
    let detections: Vec<_> = seen
        .detections
        .iter()
        .enumerate()
        .map(|(row, d)| Detection { class_id: row as i32 % 2, ..*d })
        .filter(|_| runs)
        .collect();
    let mut noise = Noise::new(seen.frame as u64, 0);
    let embeddings: Vec<f32> = (0..detections.len() * DIMENSION).map(|_| noise.unit() as f32).collect();
    let image =
        seen.image.as_ref().map(|d| ImageView::new(d, scene.width, scene.height, 0, PixelFormat::Gray8).unwrap());
    let output = tracker.step(&Frame {
        detections: &detections,
        detector_skipped: !runs,
        image,
        embeddings: runs.then(|| Embeddings::new(&embeddings, DIMENSION)),
        camera_motion: Some(seen.camera_motion),
        timestamp_ns: Some((seen.time * 1e9) as i64),
        ..Frame::default()
    });
    exact(output.unwrap())
}

fn saved_and_loaded(tracker: &Tracker) -> Tracker {
    let bytes = tracker.save();
    let loaded = Tracker::load(&bytes).unwrap();
    assert_eq!(loaded.save(), bytes, "what was loaded is what was saved");
    loaded
}

for_every_algorithm! {
    fn a_loaded_tracker_goes_on_as_the_saved_one(algorithm: Algorithm) {
        let scene = scene();
        let seen: Vec<Observation> = scene.play(true).collect();
        for class_policy in CLASS_POLICIES {
            let fresh = || tracker_of(algorithm, &[("seed", "7"), ("class_policy", class_policy)]);
            let mut straight = fresh();
            let whole: Vec<String> = seen.iter().map(|s| step(&mut straight, &scene, s)).collect();
            assert!(whole.iter().any(|o| o.contains("id: 5")), "there is something to compare");
            // Saved after every single frame, the first included, and before it.
            let mut interrupted = saved_and_loaded(&fresh());
            for (s, expected) in seen.iter().zip(&whole) {
                assert_eq!(&step(&mut interrupted, &scene, s), expected, "{class_policy}, frame {}", s.frame);
                interrupted = saved_and_loaded(&interrupted);
                assert_eq!(&exact(interrupted.output()), expected, "the last output is kept");
            }
            for track in &straight.output().reported {
                assert_eq!(interrupted.particles(track.id).unwrap(), straight.particles(track.id).unwrap());
            }
        }
    }

    fn saving_changes_nothing_and_loading_keeps_the_configuration(algorithm: Algorithm) {
        let tracker = tracker_of(algorithm, &[("seed", "7"), ("first_id", "40"), ("frame_rate", "12.5")]);
        let before = tracker.save();
        assert_eq!(tracker.save(), before);
        let loaded = Tracker::load(&before).unwrap();
        assert_eq!(loaded.config(), tracker.config());
        assert_eq!(loaded.algorithm(), algorithm);
    }

    fn mutilated_snapshots_are_refused(algorithm: Algorithm) {
        let scene = scene();
        let mut tracker = tracker_of(algorithm, &[]);
        scene.play(true).take(20).for_each(|s| drop(step(&mut tracker, &scene, &s)));
        let good = tracker.save();
        let refused = |bytes: &[u8]| matches!(Tracker::load(bytes), Err(Error::Snapshot(_)));
        assert!(!refused(&good));
        for length in (0..good.len()).step_by(good.len() / 100) {
            assert!(refused(&good[..length]), "cut to {length} bytes");
        }
        assert!(refused(&[&good[..], b"x"].concat()), "a byte too many");
        let mut noise = Noise::new(11, 0);
        for _ in 0..1250 {
            let mut bytes = good.clone();
            for _ in 0..=noise.below(4) {
                let at = noise.below(bytes.len());
                bytes[at] ^= 1 << noise.below(8);
            }
            assert!(bytes == good || refused(&bytes));
        }
    }

    /// Whoever forges a checksum gets an error or a tracker, never a crash.
    fn forged_snapshots_do_no_harm(algorithm: Algorithm) {
        let scene = scene();
        let seen: Vec<Observation> = scene.play(false).take(20).collect();
        let mut tracker = tracker_of(algorithm, &[]);
        seen.iter().for_each(|s| drop(step(&mut tracker, &scene, s)));
        let good = tracker.save();
        let mut noise = Noise::new(12, 0);
        let (mut loaded, mut refused) = (0, 0);
        for _ in 0..1250 {
            let mut bytes = good.clone();
            let end = bytes.len() - 4;
            for _ in 0..=noise.below(3) {
                let at = 20 + noise.below(end - 20);
                bytes[at] = noise.below(256) as u8;
            }
            let checksum = crc32fast::hash(&bytes[..end]);
            bytes[end..].copy_from_slice(&checksum.to_le_bytes());
            match Tracker::load(&bytes) {
                Err(Error::Snapshot(_) | Error::ParameterValue { .. }) => refused += 1,
                Err(other) => panic!("{other:?}"),
                Ok(mut forged) => {
                    loaded += 1;
                    // Nonsense may be refused or panic, which the C ABI catches; it must come to an end.
                    let steps = std::panic::AssertUnwindSafe(|| {
                        for s in &seen[..2] {
                            let _ = forged.step(&Frame::new(&s.detections));
                        }
                    });
                    let _ = std::panic::catch_unwind(steps);
                }
            }
        }
        assert!(loaded > 0 && refused > 0, "{loaded} loaded, {refused} refused");
    }
}

/// Snapshots of every format that was ever written, by algorithm: `tests/fixtures/snapshots/FORMAT/ALGORITHM`,
/// and with all that a frame can have, classes apart, `ALGORITHM-everything`.
fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/snapshots")
}

/// Frames that the fixtures' trackers have seen.
const SEEN: usize = 20;

/// What they have seen: six walkers apart from each other.
fn walk(tracker: &mut Tracker, frames: std::ops::Range<usize>, everything: bool) {
    const SIZE: (u32, u32) = (400, 920);
    let pixels: Vec<u8> = (0..(SIZE.0 * SIZE.1) as usize).map(|i| (i / 3 % 251) as u8).collect();
    let numbers: Vec<f32> = (0..6 * 6).map(|i| if i % 7 == 0 { 1.0 } else { 0.0 }).collect();
    for frame in frames {
        let walker = |i: usize| Detection::new(50.0 + 3.0 * frame as f64, 20.0 + 150.0 * i as f64, 40.0, 100.0, 0.9);
        let mut detections: Vec<Detection> = (0..6).map(walker).collect();
        if everything {
            (0..).zip(&mut detections).for_each(|(i, d)| (d.class_id, d.tag) = (i % 2, 7 * i as u64));
        }
        let plain = Frame::new(&detections);
        let full = Frame {
            image: Some(ImageView::new(&pixels, SIZE.0, SIZE.1, 0, PixelFormat::Gray8).unwrap()),
            embeddings: Some(Embeddings::new(&numbers, 6)),
            camera_motion: Some(CameraMotion([1.0, 0.0, 0.0, 0.0, 1.0, 0.0])),
            timestamp_ns: Some(33_333_333 * frame as i64),
            ..plain
        };
        tracker.step(if everything { &full } else { &plain }).unwrap();
    }
}

const FIXTURES: [(&str, bool); 2] = [("", false), ("-everything", true)];

for_every_algorithm! {
    fn snapshots_of_every_format_are_read(algorithm: Algorithm) {
        let mut formats = 0;
        let folders = std::fs::read_dir(fixtures()).unwrap().map(|folder| folder.unwrap().path());
        for (folder, (suffix, everything)) in folders.flat_map(|folder| FIXTURES.map(|kind| (folder.clone(), kind))) {
            let path = folder.join(format!("{}{suffix}", algorithm.name()));
            let mut tracker = Tracker::load(&std::fs::read(&path).unwrap()).unwrap();
            assert_eq!(tracker.algorithm(), algorithm);
            let ids = |tracker: &Tracker| tracker.output().reported.iter().map(|t| t.id).collect::<BTreeSet<u64>>();
            let before = ids(&tracker);
            assert_eq!(before.len(), 6, "{}: there are {before:?}", path.display());
            // Whatever else has changed since, whoever was there is still known.
            walk(&mut tracker, SEEN..SEEN + 3, everything);
            assert_eq!(ids(&tracker), before);
            formats += 1;
        }
        assert!(formats > 0);
    }
}

/// Writes the fixtures of a new format: `cargo test --test snapshot write_fixtures -- --ignored`.
#[test]
#[ignore = "writes files"]
fn write_fixtures() {
    for (algorithm, (suffix, everything)) in Algorithm::ALL.iter().flat_map(|a| FIXTURES.map(|kind| (a, kind))) {
        let settings = [("seed", "7"), ("class_policy", "separate")];
        let mut tracker = tracker_of(*algorithm, &settings[..if everything { 2 } else { 1 }]);
        walk(&mut tracker, 0..SEEN, everything);
        let bytes = tracker.save();
        let format = u32::from_le_bytes(bytes[8..12].try_into().unwrap());
        let folder = fixtures().join(format.to_string());
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join(format!("{}{suffix}", algorithm.name())), bytes).unwrap();
    }
}
