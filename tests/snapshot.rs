//! A tracker that is saved and loaded goes on as if nothing had happened, and what is no snapshot is refused.
#![cfg(feature = "snapshot")]

mod simulator;

use gentrack2::{Algorithm, Embeddings, Error, Frame, ImageView, PixelFormat, Tracker};
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
        .map(|(row, d)| gentrack2::Detection { class_id: row as i32 % 2, ..*d })
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
