//! The same input gives the same bits; the order of the detections means nothing; a reset tracker is a new one.

mod simulator;

use gentrack2::{Config, Detection, Frame, Output, Tracker};
use simulator::camera::Camera;
use simulator::contract::all_tracks;
use simulator::driver::{Feed, tracker, transcript};
use simulator::noise::Noise;
use simulator::scene::{Observation, Scene};
use simulator::stage;

/// Ten crossing targets with clutter and misses: births, losses and ends in one scene.
fn busy(seed: u64) -> Scene {
    Scene { duration: 3.0, ..stage::ten_targets(seed, 0.2) }
}

fn shaky(seed: u64) -> Scene {
    Scene { duration: 2.0, ..stage::moving_camera(seed, stage::SHAKE) }
}

#[test]
fn the_same_seed_gives_the_same_bits() {
    for image in [false, true] {
        let feed = Feed { camera_motion: true, timestamps: true, ..Feed::with_image(image) };
        for scene in [busy(1), shaky(2)] {
            let first = transcript(&scene, feed, &mut tracker(5));
            assert!(first.iter().any(|o| o.contains("id: 3")), "there is something to compare");
            assert_eq!(first, transcript(&scene, feed, &mut tracker(5)));
        }
    }
}

/// All particles of the tracks alive at the end of a scene, exactly.
fn last_particles(scene: &Scene, seed: u64) -> String {
    let mut tracker = tracker(seed);
    transcript(scene, Feed::default(), &mut tracker);
    let ids: Vec<u64> = all_tracks(tracker.output()).map(|t| t.id).collect();
    assert!(ids.len() >= 8, "{ids:?}");
    ids.iter().map(|id| format!("{id}: {:?}\n", tracker.particles(*id).unwrap())).collect()
}

#[test]
fn the_seed_reaches_the_particles() {
    // Were it not to, the tests with several seeds would be tests with one. The tracks themselves may well be the
    // same for all seeds.
    assert_eq!(last_particles(&busy(1), 1), last_particles(&busy(1), 1));
    assert_ne!(last_particles(&busy(1), 1), last_particles(&busy(1), 2));
}

#[test]
fn after_a_reset_everything_is_as_with_a_new_tracker() {
    for image in [false, true] {
        let feed = Feed { timestamps: true, ..Feed::with_image(image) };
        let fresh = transcript(&busy(1), feed, &mut tracker(5));
        assert!(fresh.iter().any(|o| o.contains("id: 3")), "there is something to compare");
        let mut used = tracker(5);
        transcript(&shaky(7), Feed { camera_motion: true, ..feed }, &mut used);
        used.reset();
        assert_eq!(all_tracks(used.output()).count() + used.output().ended.len(), 0, "nothing is left to see");
        assert_eq!(transcript(&busy(1), feed, &mut used), fresh);
    }
}

#[test]
fn a_reset_forgets_the_clock_and_the_embeddings() {
    let detections = [Detection::new(10.0, 10.0, 40.0, 100.0, 0.9)];
    let frame = |time, data| Frame {
        timestamp_ns: Some(time),
        embeddings: Some(gentrack2::Embeddings::new(data, data.len())),
        ..Frame::new(&detections)
    };
    let mut tracker = tracker(0);
    tracker.step(&frame(1_000, &[1.0, 0.0])).unwrap();
    tracker.reset();
    tracker.step(&frame(-5, &[1.0, 0.0, 0.0])).unwrap();
}

#[test]
fn identities_start_at_the_configured_number_also_after_a_reset() {
    let mut config = Config::new("gentrack2").unwrap();
    config.set_text("first_id", "1000").unwrap();
    let mut tracker = Tracker::new(&config).unwrap();
    let detections = [Detection::new(10.0, 10.0, 40.0, 100.0, 0.9)];
    for _ in 0..2 {
        let mut last = 0;
        for _ in 0..5 {
            last = tracker.step(&Frame::new(&detections)).unwrap().reported.last().map_or(0, |t| t.id);
        }
        assert_eq!(last, 1000);
        tracker.reset();
    }
}

/// The tracks of an output in the order of their identities, without the row numbers, which a permutation changes.
fn as_set(output: &Output, detections: &[Detection]) -> Vec<String> {
    let mut tracks: Vec<_> =
        all_tracks(output).map(|t| (t.id, gentrack2::Track { detection_index: None, ..*t })).collect();
    tracks.sort_by_key(|t| t.0);
    let mut owners: Vec<_> = output.track_of_detection.iter().zip(detections).map(|(id, d)| (d.tag, *id)).collect();
    owners.sort_unstable();
    let mut ended = output.ended.clone();
    ended.sort_unstable();
    let lines = tracks.iter().map(|t| format!("{t:?}"));
    lines.chain(owners.iter().map(|o| format!("{o:?}"))).chain([format!("ended {ended:?}")]).collect()
}

#[test]
fn the_order_of_the_detections_changes_nothing() {
    for image in [false, true] {
        let feed = Feed::with_image(image);
        let scene = busy(3);
        let (mut plain, mut permuted) = (tracker(5), tracker(5));
        let mut noise = Noise::new(9, 9);
        for seen in scene.play(image) {
            let mut other = Observation { detections: seen.detections.clone(), ..seen.clone() };
            noise.shuffle(&mut other.detections);
            let expected = as_set(feed.step(&mut plain, &scene, &seen).unwrap(), &seen.detections);
            let got = as_set(feed.step(&mut permuted, &scene, &other).unwrap(), &other.detections);
            assert_eq!(got, expected, "frame {}", seen.frame);
        }
        assert!(plain.output().reported.len() >= 8, "there was something to compare");
    }
}

#[test]
fn the_identity_is_a_camera_motion_that_changes_nothing() {
    let scene = Scene { camera: Camera::default(), ..busy(4) };
    // Not given, the camera's motion would be guessed from the tracks, which is another thing than standing still.
    let mut config = Config::new("gentrack2").unwrap();
    config.set_text("common_motion", "false").unwrap();
    let play = |feed: Feed| transcript(&scene, feed, &mut Tracker::new(&config).unwrap());
    let without = play(Feed::default());
    assert!(without.iter().any(|o| o.contains("id: 3")), "there is something to compare");
    let known = Feed { camera_motion: true, ..Feed::default() };
    assert_eq!(play(known), without);
    // What is given need not be guessed.
    assert_eq!(transcript(&scene, known, &mut Tracker::new(&Config::new("gentrack2").unwrap()).unwrap()), without);
}
