//! What class ids mean, for every algorithm and every policy.

mod parade;
mod simulator;

use std::collections::{BTreeMap, BTreeSet};

use gentrack2::{Algorithm, Detection, Neighbourhood, Output, Rect, Track, Tracker, WeakMove};
use parade::crowd::{CLASSES, crowd};
use parade::*;

const POLICIES: [&str; 3] = ["ignore", "same_class", "separate"];

/// Runs a test for every algorithm and policy.
fn for_all_policies(test: impl Fn(Algorithm, &str, &dyn Fn(&[(&str, &str)]) -> Tracker, &str)) {
    for_all(|algorithm, name| {
        for policy in POLICIES {
            let make = |more: &[(&str, &str)]| {
                let settings = [patient(algorithm), &[("class_policy", policy)], more].concat();
                tracker(algorithm, &settings)
            };
            test(algorithm, policy, &make, &format!("{name}, {policy}"));
        }
    });
}

#[test]
fn classes_that_swap_places() {
    for_all_policies(|_, policy, make, what| {
        let mut tracker = make(&[]);
        let mut walkers = [Walker::new(100.0, 100.0, (30.0, 0.0)), Walker::new(600.0, 100.0, (30.0, 0.0)).of_class(1)];
        play(&mut tracker, &walkers, 0..20, 1, |_, _| ());
        let id_of =
            |output: &Output, walker: &Walker, index| nearest(output, &walker.at(frame_time(index))).unwrap().id;
        let before: Vec<u64> = walkers.iter().map(|w| id_of(tracker.output(), w, 19)).collect();
        (walkers[0].class, walkers[1].class) = (1, 0);
        play(&mut tracker, &walkers, 20..30, 1, |index, output| {
            // The class that a track has is always that of its detection.
            for (walker, id) in walkers.iter().zip(&before) {
                let track = live(output)
                    .find(|t| t.detection_index.is_some() && t.rect.iou(&walker.at(frame_time(index))) > 0.5);
                let track = track.unwrap_or_else(|| panic!("{what}: frame {index}: {walker:?} is not tracked"));
                assert_eq!(track.class_id, walker.class, "{what}: frame {index}");
                assert_eq!(track.id == *id, policy == "ignore", "{what}: frame {index}: {track:?}");
                assert!(policy == "ignore" || !before.contains(&track.id), "{what}: frame {index}: {track:?}");
            }
        });
    });
}

#[test]
fn one_that_vanishes_where_one_of_another_class_appears() {
    for_all_policies(|_, policy, make, what| {
        let mut tracker = make(&[]);
        let walker = Walker::new(100.0, 100.0, (30.0, 0.0));
        let after = |gone: f64, from: f64| [walker.clone().seen(0.0, gone), walker.clone().of_class(1).seen(from, 9.0)];
        for gap in [0, 3] {
            tracker.reset();
            let walkers = after(frame_time(20) - 0.01, frame_time(20 + gap) - 0.01);
            let id = play(&mut tracker, &walkers, 0..20, 1, |_, _| ()).reported[0].id;
            play(&mut tracker, &walkers, 20..40, 1, |index, output| {
                if index < 20 + gap {
                    return;
                }
                assert_eq!(output.track_of_detection.len(), 1);
                let taken_by = output.track_of_detection[0];
                assert_eq!(taken_by == id, policy == "ignore", "{what}, gap {gap}: frame {index}: {taken_by}");
                assert_ne!(taken_by, 0, "{what}, gap {gap}: frame {index}: nobody took it");
                if policy != "ignore" {
                    // The one that vanished is not dropped for the other's sake.
                    let lost =
                        find(output, id).unwrap_or_else(|| panic!("{what}, gap {gap}: frame {index}: {output:?}"));
                    assert_eq!((lost.class_id, lost.detection_index), (0, None), "{what}, gap {gap}: frame {index}");
                }
            });
        }
    });
}

/// Somebody walks behind a kiosk, and one of another class comes out from where he went in.
#[test]
fn one_that_is_hidden_is_not_found_again_in_another_class() {
    for_all_policies(|algorithm, policy, make, what| {
        let mut tracker = make(&[]);
        let mut kiosk = Walker::new(300.0, 90.0, (0.0, 0.0));
        (kiosk.start.width, kiosk.start.height) = (120.0, 120.0);
        // Where none of the predictions is, yet near enough for one who has turned round.
        let other = Walker::new(262.0, 100.0, (0.0, 0.0)).of_class(1).seen(2.49, 99.0);
        let walkers = [kiosk, Walker::new(190.0, 100.0, (60.0, 0.0)).seen(0.0, 1.9), other];
        let mut id = 0;
        play(&mut tracker, &walkers, 0..80, 1, |index, output| {
            let row = |tag| {
                output.track_of_detection[look(&walkers, frame_time(index)).iter().position(|d| d.tag == tag).unwrap()]
            };
            match index {
                0..57 => id = row(2),
                75.. if policy != "ignore" => assert!(row(3) != 0 && row(3) != id, "{what}: frame {index}"),
                // It is asked for who went out of sight behind another.
                75.. if algorithm == Algorithm::GenTrack2 => assert_eq!(row(3), id, "{what}: frame {index}"),
                _ => (),
            }
        });
    });
}

/// A rider and the bicycle, in nearly the same place: IoU 36 x 88 / (40 x 90) = .88.
fn rider_and_bicycle() -> [Walker; 2] {
    let rider = Walker::new(100.0, 100.0, (40.0, 0.0));
    let mut bicycle = rider.clone().of_class(1);
    bicycle.start = Rect::new(102.0, 101.0, 36.0, 88.0);
    [rider, bicycle]
}

#[test]
fn a_rider_and_a_bicycle_are_two() {
    for_all_policies(|algorithm, policy, make, what| {
        if policy == "ignore" {
            return;
        }
        assert!(rider_and_bicycle()[0].start.iou(&rider_and_bicycle()[1].start) > 0.8);
        // Both at once, one after the other, either hidden for a while, and with a poor score.
        let [rider, bicycle] = rider_and_bicycle();
        let poor = |w: Walker, score: f64| Walker { score, ..w };
        let mut scenes = vec![
            [rider.clone(), bicycle.clone()],
            [rider.clone(), bicycle.clone().seen(0.99, 9.0)],
            [rider.clone().seen(0.99, 9.0), bicycle.clone()],
            [rider.clone().hidden(0.99, 1.4), bicycle.clone()],
            [rider.clone().hidden(0.99, 1.4), bicycle.clone().hidden(1.2, 1.6)],
            [rider.clone().hidden(0.99, 1.4), bicycle.clone().seen(1.05, 9.0)],
        ];
        if algorithm == Algorithm::ConfTrack {
            // Of low confidence, in the place of one that was not seen: within a class it would be suppressed.
            scenes.push([rider.clone().hidden(0.99, 1.4), poor(bicycle, 0.65).seen(1.05, 9.0)]);
        }
        for (number, walkers) in scenes.iter().enumerate() {
            let mut tracker = make(&[]);
            let mut ids = BTreeMap::<i32, BTreeSet<u64>>::new();
            play(&mut tracker, walkers, 0..75, 1, |index, output| {
                let at = format!("{what}: scene {number}, frame {index}: {output:?}");
                assert!(output.track_of_detection.iter().all(|id| *id != 0), "{at}");
                assert!(output.ended.is_empty(), "{at}");
                for track in live(output) {
                    ids.entry(track.class_id).or_default().insert(track.id);
                    let walker = &walkers[track.class_id as usize];
                    assert!(track.rect.iou(&walker.at(frame_time(index))) > 0.7, "{at}");
                    assert_eq!(track.detection_index.is_some(), walker.detection(frame_time(index)).is_some(), "{at}");
                }
            });
            assert!(ids.len() == 2 && ids.values().all(|of_class| of_class.len() == 1), "{what}: {number}: {ids:?}");
        }
    });
}

/// GenTrack2's random numbers depend on the identity, so its particles stand still where identities are renamed.
fn without_chance(algorithm: Algorithm) -> Vec<(&'static str, &'static str)> {
    let mut settings = patient(algorithm).to_vec();
    if algorithm == Algorithm::GenTrack2 {
        settings.extend([("noise_gain", "0"), ("state_noise", "0"), ("velocity_noise", "0")]);
    }
    settings
}

#[test]
fn separate_is_the_union_of_a_tracker_per_class() {
    for_all(|algorithm, name| {
        let settings = without_chance(algorithm);
        let mut whole = tracker(algorithm, &[&settings[..], &[("class_policy", "separate")]].concat());
        let mut parts = CLASSES.map(|_| tracker(algorithm, &settings));
        let mut most = 0;
        for (seed, reset) in [(1, false), (2, true), (3, true)] {
            if reset {
                whole.reset();
                parts.iter_mut().for_each(Tracker::reset);
            }
            let mut renaming = CLASSES.map(|_| Renaming::default());
            let mut register = Register::default();
            for (index, input) in crowd(seed).iter().enumerate() {
                let what = format!("{name}: scene {seed}, frame {index}");
                let found = whole.step(&input.frame()).unwrap();
                let mut expected = Output::default();
                expected.begin(input.detections.len());
                for ((class, part), renaming) in CLASSES.iter().zip(&mut parts).zip(&mut renaming) {
                    let (of_class, rows) = input.of_class(*class);
                    let output = part.step(&of_class.frame()).unwrap();
                    let placed = |t: &Track| Track { detection_index: t.detection_index.map(|i| rows[i]), ..*t };
                    expected.reported.extend(output.reported.iter().map(placed));
                    expected.tentative.extend(output.tentative.iter().map(placed));
                    expected.lost.extend(output.lost.iter().map(placed));
                    expected.ended.extend(&output.ended);
                    for (row, id) in rows.iter().zip(&output.track_of_detection) {
                        assert!(renaming.agrees(found.track_of_detection[*row], *id), "{what}: row {row}");
                    }
                }
                // In the order of the classes.
                let lists = |o: &Output| [o.reported.clone(), o.tentative.clone(), o.lost.clone()];
                for (found, expected) in lists(found).iter().zip(&lists(&expected)) {
                    assert_eq!(found.len(), expected.len(), "{what}");
                    for (track, other) in found.iter().zip(expected) {
                        assert_eq!(Track { id: 0, ..*track }, Track { id: 0, ..*other }, "{what}");
                        let class = CLASSES.iter().position(|c| *c == track.class_id).unwrap();
                        assert!(renaming[class].agrees(track.id, other.id), "{what}: {track:?} is not {other:?}");
                    }
                }
                assert_eq!(found.ended.len(), expected.ended.len(), "{what}");
                check_rows(found, &input.detections, &what);
                register.check(&what, found);
                most = most.max(register.live.len());
            }
        }
        assert!(most >= 12, "{name}: the scene is too easy: {most}");
    });
}

/// Rows and tags are those of the caller.
fn check_rows(output: &Output, detections: &[Detection], what: &str) {
    assert_eq!(output.track_of_detection.len(), detections.len(), "{what}");
    for track in live(output) {
        let Some(row) = track.detection_index else { continue };
        let detection = &detections[row];
        assert_eq!(output.track_of_detection[row], track.id, "{what}: row {row}");
        assert_eq!((track.tag, track.class_id, track.score), (detection.tag, detection.class_id, detection.score));
    }
    let taken = output.track_of_detection.iter().filter(|id| **id != 0).count();
    assert_eq!(live(output).filter(|t| t.detection_index.is_some()).count(), taken, "{what}");
}

#[test]
fn no_track_ever_changes_its_class_unless_classes_are_ignored() {
    for_all_policies(|_, policy, make, what| {
        let mut tracker = make(&[]);
        let (mut classes, mut changes) = (BTreeMap::new(), 0);
        let mut register = Register::default();
        for (index, input) in crowd(4).iter().enumerate() {
            let output = tracker.step(&input.frame()).unwrap();
            check_rows(output, &input.detections, &format!("{what}: frame {index}"));
            register.check(what, output);
            for track in live(output) {
                changes += usize::from(*classes.entry(track.id).or_insert(track.class_id) != track.class_id);
            }
        }
        assert!(register.ended.len() > 3, "{what}: {:?}", register.ended);
        assert_eq!(changes > 0, policy == "ignore", "{what}: {changes} changes of class");
    });
}

#[test]
fn the_most_tracks_are_those_of_all_classes() {
    for_all_policies(|_, _, make, what| {
        let mut tracker = make(&[("max_tracks", "5")]);
        let mut most = 0;
        for input in crowd(5) {
            let count = live(tracker.step(&input.frame()).unwrap()).count();
            assert!(count <= 5, "{what}: {count} tracks");
            most = most.max(count);
        }
        assert_eq!(most, 5, "{what}");
    });
}

#[test]
fn particles_are_those_of_the_track_in_every_policy() {
    for policy in POLICIES {
        let mut tracker = tracker(Algorithm::GenTrack2, &[("class_policy", policy)]);
        let mut walkers = three();
        walkers.iter_mut().zip(CLASSES).for_each(|(w, class)| w.class = class);
        play(&mut tracker, &walkers, 0..10, 1, |_, _| ());
        for track in tracker.output().reported.clone() {
            let particles = tracker.particles(track.id).unwrap();
            assert!(!particles.is_empty(), "{policy}");
            assert!(
                particles.iter().all(|p| distance(&p.rect, &track.rect) < 20.0),
                "{policy}: {track:?} {particles:?}"
            );
        }
        tracker.particles(77).expect_err("nobody has this id");
        tracker.reset();
        tracker.particles(1).expect_err("nobody is left");
    }
}

#[test]
fn neighbours_are_those_of_the_track_in_every_policy() {
    for policy in POLICIES {
        let mut tracker = tracker(Algorithm::GenTrack2, &[("class_policy", policy)]);
        // Abreast, and the one in the middle is not seen from frame 20 on.
        let walker = |x: f64| Walker::new(x, 100.0, (60.0, 0.0));
        let walkers = [walker(100.0), walker(142.0).hidden(frame_time(20) - 0.01, 99.0), walker(184.0).of_class(1)];
        let ids = play(&mut tracker, &walkers, 0..20, 1, |_, _| ()).track_of_detection.clone();
        assert!(ids.iter().all(|id| *id != 0), "{policy}: {ids:?}");
        for id in &ids {
            assert_eq!(tracker.neighbourhood(*id).unwrap(), Neighbourhood::default(), "{policy}");
        }
        play(&mut tracker, &walkers, 20..22, 1, |_, _| ());
        let found = tracker.neighbourhood(ids[1]).unwrap();
        let expected = if policy == "separate" { vec![ids[0]] } else { vec![ids[0], ids[2]] };
        assert_eq!(found.neighbours, expected, "{policy}: {found:?}");
        assert_eq!((found.trusted, found.rule), (expected.len(), WeakMove::WithNeighbours), "{policy}");
        let velocity = found.motion.unwrap().velocity;
        assert!((velocity.0 - 60.0).abs() < 10.0 && velocity.1.abs() < 10.0, "{policy}: {velocity:?}");
        tracker.neighbourhood(77).expect_err("nobody has this id");
        tracker.reset();
        tracker.neighbourhood(1).expect_err("nobody is left");
    }
}
