//! What the handle promises is kept by every algorithm, also where the publications know nothing of it.

mod parade;
mod simulator;

use std::collections::BTreeSet;

use gentrack2::{Algorithm, CameraMotion, Detection, Frame, Output, Rect, Track, TrackState, Tracker};
use parade::crowd::crowd;
use parade::*;

/// The algorithms whose lost tracks are kept as frames at 30 frames per second.
const BUFFERED: [Algorithm; 3] = [Algorithm::ByteTrack, Algorithm::BotSort, Algorithm::SmileTrack];

#[test]
fn what_came_with_a_detection_comes_back_on_its_track() {
    for_all(|algorithm, name| {
        let mut tracker = tracker(algorithm, patient(algorithm));
        let walkers = three();
        let mut ids = BTreeSet::new();
        for index in 0..20 {
            let mut seen = look(&walkers, frame_time(index));
            for (row, d) in seen.iter_mut().enumerate() {
                (d.tag, d.class_id) = (100 * index as u64 + row as u64, 7 - row as i32);
            }
            // Another order every frame: nothing may hang on it.
            seen.rotate_left(index % 3);
            // One that most ignore.
            seen.push(Detection { tag: 9999, ..Detection::new(1500.0, 900.0, 40.0, 90.0, 0.01) });
            let output = tracker.step(&Frame::new(&seen)).unwrap();
            assert_eq!(output.track_of_detection.len(), seen.len(), "{name}");
            for (row, detection) in seen.iter().enumerate().take(3) {
                let id = output.track_of_detection[row];
                let track =
                    find(output, id).unwrap_or_else(|| panic!("{name}: row {row} of frame {index} has no track"));
                assert_eq!(track.detection_index, Some(row), "{name}: {track:?}");
                assert_eq!((track.tag, track.class_id), (detection.tag, detection.class_id), "{name}: {track:?}");
                assert_eq!((track.score, track.frames_since_match), (detection.score, 0), "{name}: {track:?}");
                assert_eq!((track.hits, track.age), (index as u32 + 1, index as u32 + 1), "{name}: {track:?}");
                ids.insert(id);
            }
            let taken = output.track_of_detection.iter().filter(|id| **id != 0).count();
            assert_eq!(live(output).filter(|t| t.detection_index.is_some()).count(), taken, "{name}");
        }
        assert_eq!(ids.len(), 3, "{name}: {ids:?}");
    });
}

#[test]
fn a_track_without_a_detection_in_this_frame_keeps_what_it_had() {
    for_all(|algorithm, name| {
        let mut tracker = tracker(algorithm, patient(algorithm));
        let walkers = [Walker::new(100.0, 100.0, (60.0, 0.0)).of_class(5)];
        let id = play(&mut tracker, &walkers, 0..10, 1, |_, _| ()).reported[0].id;
        for frame in [Frame::skipped(), Frame::new(&[])] {
            let output = tracker.step(&frame).unwrap();
            let track = find(output, id).unwrap_or_else(|| panic!("{name}: gone at once"));
            assert_eq!((track.detection_index, track.hits), (None, 10), "{name}: {track:?}");
            assert_eq!((track.tag, track.class_id, track.score), (1, 5, 0.9), "{name}: {track:?}");
        }
        assert_eq!(find(tracker.output(), id).unwrap().frames_since_match, 2, "{name}");
    });
}

#[test]
fn an_end_is_named_once_and_when_it_happens() {
    for_all(|algorithm, name| {
        let mut tracker = tracker(algorithm, patient(algorithm));
        // Some leave for good, some come late, one is seen for a moment only.
        let walkers = [
            Walker::new(100.0, 100.0, (60.0, 0.0)),
            Walker::new(800.0, 300.0, (-45.0, 15.0)).seen(0.0, 0.5),
            Walker::new(300.0, 600.0, (30.0, -6.0)).seen(0.4, 1.5),
            Walker::new(900.0, 700.0, (0.0, 0.0)).seen(0.61, 0.64),
            Walker::new(500.0, 100.0, (10.0, 10.0)).hidden(0.8, 1.2),
        ];
        let mut register = Register::default();
        play(&mut tracker, &walkers, 0..120, 1, |_, output| register.check(name, output));
        assert_eq!(register.live.len(), 2, "{name}: the first and the last one stay");
        assert_eq!(register.ended.len(), 3, "{name}: {:?}", register.ended);
        // Once more with a detector that rests now and then.
        tracker.reset();
        let mut register = Register::default();
        play(&mut tracker, &walkers, 0..180, 3, |_, output| register.check(name, output));
        assert_eq!(register.live.len(), 2, "{name}");
    });
}

#[test]
fn who_disappears_is_listed_as_lost_where_it_is_predicted_and_found_again() {
    for_all(|algorithm, name| {
        let mut tracker = tracker(algorithm, patient(algorithm));
        let mut walkers = three();
        // For 24 frames: GenTrack2 reports the predicted boxes of the first 20.
        walkers[0] = walkers[0].clone().hidden(2.0, 2.8);
        let (mut id, mut lost_frames, mut before) = (0, 0, f64::NEG_INFINITY);
        play(&mut tracker, &walkers, 0..100, 1, |index, output| {
            let truth = walkers[0].at(frame_time(index));
            match index {
                0..60 => id = nearest(output, &truth).unwrap().id,
                60..84 => {
                    let track = find(output, id).unwrap_or_else(|| panic!("{name}: gone in frame {index}"));
                    assert_eq!(track.state, TrackState::Lost, "{name}: frame {index}");
                    assert_eq!(track.frames_since_match as usize, index - 59, "{name}");
                    assert!(track.rect.left > before + 0.5, "{name}: frame {index}: stands still");
                    assert!(distance(&track.rect, &truth) < 6.0, "{name}: frame {index}: {track:?}, not {truth:?}");
                    before = track.rect.left;
                    lost_frames += usize::from(output.lost.iter().any(|t| t.id == id));
                }
                _ => assert_eq!(nearest(output, &truth).unwrap().id, id, "{name}: frame {index}"),
            }
        });
        // Some report the first predictions; whoever reports longer than this must have good reasons.
        assert!(lost_frames >= 1, "{name}: listed as lost in {lost_frames} of 24 frames");
        assert_eq!(live(tracker.output()).count(), 3, "{name}");
        assert_eq!(find(tracker.output(), id).unwrap().state, TrackState::Confirmed, "{name}");
    });
}

/// Where a track stands, frame by frame.
fn states(algorithm: Algorithm, walker: Walker, frames: std::ops::Range<usize>) -> Vec<(TrackState, bool)> {
    let mut tracker = tracker(algorithm, patient(algorithm));
    let mut found = Vec::new();
    play(&mut tracker, &[Walker::new(900.0, 100.0, (0.0, 0.0)), walker.clone()], 0..frames.end, 1, |index, output| {
        if frames.contains(&index) {
            let track = nearest(output, &walker.at(frame_time(index))).unwrap_or_else(|| panic!("{index}: {output:?}"));
            found.push((track.state, output.reported.contains(track)));
        }
    });
    found
}

#[test]
fn states_are_those_of_the_algorithm() {
    use Algorithm::*;
    use TrackState::{Confirmed, Lost, Tentative};
    let walker = Walker::new(100.0, 100.0, (30.0, 0.0));
    for_all(|algorithm, name| {
        // In the first frame some trust everybody, and some report whom they do not trust.
        let first = match algorithm {
            DeepSort => (Tentative, false),
            ConfTrack => (Tentative, true),
            GenTrack2 | Sort | ByteTrack | OcSort | BotSort | SmileTrack => (Confirmed, true),
        };
        assert_eq!(states(algorithm, walker.clone(), 0..1), [first], "{name}: in the first frame");

        // A newcomer, from his birth on.
        let (young, early) = match algorithm {
            GenTrack2 | DeepSort => (2, false),
            Sort | OcSort => (3, false),
            ByteTrack | ConfTrack => (1, false),
            BotSort | SmileTrack => (1, true),
        };
        let mut expected = vec![(Tentative, early); young];
        expected.extend(vec![(Confirmed, true); 6 - young]);
        let newcomer = walker.clone().seen(0.99, 9.0);
        assert_eq!(states(algorithm, newcomer, 30..36), expected, "{name}: a newcomer");

        // Lost for five frames and found again.
        let lost = states(algorithm, walker.clone().hidden(0.99, 1.16), 29..40);
        let states_only: Vec<TrackState> = lost.iter().map(|s| s.0).collect();
        let again = match algorithm {
            // Must have its run of matches again.
            Sort | OcSort => [Tentative, Tentative, Confirmed, Confirmed, Confirmed],
            _ => [Confirmed; 5],
        };
        let expected: Vec<TrackState> = [&[Confirmed][..], &[Lost; 5], &again].concat();
        assert_eq!(states_only, expected, "{name}: lost and found");
        // Most report no prediction.
        let reported: Vec<bool> = lost[1..6].iter().map(|s| s.1).collect();
        let as_expected = match algorithm {
            // As long as the prediction is trusted.
            GenTrack2 => reported[0] && reported.is_sorted_by_key(|r| !r),
            DeepSort => reported == [true, false, false, false, false],
            _ => reported == [false; 5],
        };
        assert!(as_expected, "{name}: predictions reported: {reported:?}");
    });
}

#[test]
fn a_reset_is_a_new_beginning_identities_included() {
    for_all(|algorithm, name| {
        let mut settings = patient(algorithm).to_vec();
        settings.push(("first_id", "42"));
        let mut tracker = tracker(algorithm, &settings);
        let mut walkers = three();
        walkers[1] = walkers[1].clone().hidden(0.5, 0.7);
        let run = |tracker: &mut Tracker| {
            let mut transcript = Vec::new();
            play(tracker, &walkers, 0..30, 1, |_, output| transcript.push(format!("{output:?}")));
            transcript
        };
        let first = run(&mut tracker);
        let smallest = live(tracker.output()).map(|t| t.id).min();
        assert_eq!(smallest, Some(42), "{name}");
        tracker.reset();
        assert_eq!(format!("{:?}", tracker.output()), format!("{:?}", Output::default()), "{name}");
        assert_eq!(run(&mut tracker), first, "{name}");
    });
}

#[test]
fn a_reset_forgets_the_clock_and_the_length_of_embeddings() {
    for_all(|algorithm, name| {
        let mut tracker = tracker(algorithm, &[]);
        let seen = [Detection::new(10.0, 10.0, 40.0, 90.0, 0.9)];
        let frame = |time: i64, embedding: &'static [f32]| Frame {
            timestamp_ns: Some(time),
            embeddings: Some(gentrack2::Embeddings::new(embedding, embedding.len())),
            ..Frame::new(&seen)
        };
        tracker.step(&frame(1_000_000_000, &[1.0, 0.0])).unwrap();
        tracker.step(&frame(500_000_000, &[1.0, 0.0])).expect_err(name);
        tracker.step(&frame(2_000_000_000, &[1.0, 0.0, 0.0])).expect_err(name);
        tracker.reset();
        let output = tracker.step(&frame(500_000_000, &[1.0, 0.0, 0.0])).expect(name);
        assert_eq!(output.track_of_detection, [1], "{name}");
    });
}

#[test]
fn handles_do_not_share_identities() {
    for_all(|algorithm, name| {
        let (mut a, mut b) = (tracker(algorithm, &[]), tracker(algorithm, &[]));
        for index in 0..10 {
            let seen = look(&three(), frame_time(index));
            let of_a = format!("{:?}", a.step(&Frame::new(&seen)).unwrap());
            assert_eq!(of_a, format!("{:?}", b.step(&Frame::new(&seen)).unwrap()), "{name}: frame {index}");
        }
    });
}

#[test]
fn a_detector_that_runs_now_and_then_costs_no_identity_and_little_precision() {
    for_all(|algorithm, name| {
        for every in [2, 3, 5] {
            let mut tracker = tracker(algorithm, &[]);
            let mut walkers = three();
            // A newcomer.
            walkers.push(Walker::new(700.0, 50.0, (-40.0, 20.0)).seen(0.99, 99.0));
            let mut ids = vec![BTreeSet::new(); walkers.len()];
            play(&mut tracker, &walkers, 0..240, every, |index, output| {
                if index < 60 {
                    return;
                }
                for (walker, ids) in walkers.iter().zip(&mut ids) {
                    let truth = walker.at(frame_time(index));
                    let track = nearest(output, &truth).unwrap_or_else(|| panic!("{name}/{every}: {index}: nobody"));
                    ids.insert(track.id);
                    let what = format!("{name}/{every}: frame {index}: {track:?} instead of {truth:?}");
                    assert!(output.reported.contains(track) && track.state == TrackState::Confirmed, "{what}");
                    assert_eq!(track.detection_index.is_some(), index.is_multiple_of(every), "{what}");
                    assert!(track.rect.iou(&truth) > 0.9, "{what}");
                }
                assert_eq!(live(output).count(), walkers.len(), "{name}/{every}: frame {index}");
                assert!(output.ended.is_empty(), "{name}/{every}: frame {index}");
            });
            assert!(ids.iter().all(|ids| ids.len() == 1), "{name}/{every}: {ids:?}");
        }
    });
}

#[test]
fn nobody_is_blamed_while_the_detector_rests() {
    for_all(|algorithm, name| {
        // Twice as long as lost tracks are kept.
        let mut tracker = tracker(algorithm, patient(algorithm));
        let mut walkers = three();
        play(&mut tracker, &walkers, 0..90, 1, |_, _| ());
        let before: Vec<u64> =
            walkers.iter().map(|w| nearest(tracker.output(), &w.at(frame_time(89))).unwrap().id).collect();
        walkers.truncate(2);
        for index in 90..150 {
            let output = tracker.step(&Frame::skipped()).unwrap();
            assert!(output.ended.is_empty() && output.reported.len() == 3, "{name}: frame {index}: {output:?}");
            assert!(output.reported.iter().all(|t| t.state == TrackState::Confirmed), "{name}: frame {index}");
        }
        // Two are where they must be. Of the third the time without a detection counts now.
        let mut ended = Vec::new();
        play(&mut tracker, &walkers, 150..153, 1, |index, output| {
            ended.extend_from_slice(&output.ended);
            for (walker, id) in walkers.iter().zip(&before) {
                assert_eq!(nearest(output, &walker.at(frame_time(index))).map(|t| t.id), Some(*id), "{name}: {index}");
            }
        });
        assert_eq!(ended, before[2..], "{name}");
    });
}

#[test]
fn a_life_of_no_frames_is_enough_for_who_is_always_seen() {
    for_all(|algorithm, name| {
        if !has(algorithm, "max_age") || algorithm == Algorithm::GenTrack2 {
            return;
        }
        let mut tracker = tracker(algorithm, &[("max_age", "0")]);
        play(&mut tracker, &three(), 0..30, 1, |_, output| assert!(output.ended.is_empty(), "{name}: {output:?}"));
        play(&mut tracker, &[], 30..31, 1, |_, output| assert_eq!(output.ended.len(), 3, "{name}: {output:?}"));
    });
}

/// Nanoseconds of a time.
fn stamp(time: f64) -> Option<i64> {
    Some((time * 1e9).round() as i64)
}

/// Uneven times, 20 to 110 ms apart.
fn uneven_times(count: usize) -> Vec<f64> {
    let mut time = 5.0;
    let step = |k: usize| 0.02 + 0.01 * ((k * 7 + k / 5) % 10) as f64;
    (0..count)
        .map(|k| {
            time += step(k);
            time
        })
        .collect()
}

#[test]
fn uneven_timestamps_give_true_speeds_and_places() {
    for_all(|algorithm, name| {
        let mut tracker = tracker(algorithm, &[]);
        let walkers = three();
        for (index, time) in uneven_times(150).into_iter().enumerate() {
            let seen = look(&walkers, time);
            let rests = index > 100 && index % 4 != 0;
            let frame = if rests { Frame::skipped() } else { Frame::new(&seen) };
            let output = tracker.step(&Frame { timestamp_ns: stamp(time), ..frame }).unwrap();
            if index < 100 {
                continue;
            }
            for walker in &walkers {
                let truth = walker.at(time);
                let track = nearest(output, &truth).unwrap_or_else(|| panic!("{name}: frame {index}: nobody"));
                let (du, dv) = (track.velocity.u - walker.speed.0, track.velocity.v - walker.speed.1);
                let speed = walker.speed.0.hypot(walker.speed.1);
                assert!(du.hypot(dv) < 0.1 * speed, "{name}: frame {index}: {track:?} instead of {:?}", walker.speed);
                assert!(distance(&track.rect, &truth) < 1.5, "{name}: frame {index}: {track:?} instead of {truth:?}");
            }
            assert_eq!(live(output).count(), 3, "{name}: frame {index}");
        }
        assert!(live(tracker.output()).all(|t| t.age == 150), "{name}: somebody is new");
    });
}

#[test]
fn a_gap_between_uneven_timestamps_spoils_no_speed() {
    for_all(|algorithm, name| {
        let mut tracker = tracker(algorithm, patient(algorithm));
        let walker = Walker::new(100.0, 100.0, (60.0, 0.0));
        let mut id = 0;
        for (index, time) in uneven_times(100).into_iter().enumerate() {
            let seen = if (80..88).contains(&index) { vec![] } else { look(std::slice::from_ref(&walker), time) };
            let output = tracker.step(&Frame { timestamp_ns: stamp(time), ..Frame::new(&seen) }).unwrap();
            let track = nearest(output, &walker.at(time)).unwrap_or_else(|| panic!("{name}: frame {index}: nobody"));
            if index == 79 {
                id = track.id;
            }
            if index >= 80 {
                assert_eq!(track.id, id, "{name}: frame {index}");
                assert!((track.velocity.u - 60.0).abs() < 6.0, "{name}: frame {index}: {track:?}");
                assert!(distance(&track.rect, &walker.at(time)) < 3.0, "{name}: frame {index}: {track:?}");
            }
        }
    });
}

#[test]
fn velocities_are_per_second_at_any_frame_rate() {
    for_all(|algorithm, name| {
        for rate in [10.0, 60.0] {
            let mut tracker = tracker(algorithm, &[("frame_rate", &rate.to_string())]);
            let walker = Walker::new(100.0, 100.0, (60.0, 20.0));
            for index in 0..150 {
                tracker.step(&Frame::new(&look(std::slice::from_ref(&walker), index as f64 / rate))).unwrap();
            }
            let track = tracker.output().reported[0];
            let error = (track.velocity.u - 60.0).hypot(track.velocity.v - 20.0);
            assert!(error < 0.1 * 60f64.hypot(20.0), "{name} at {rate}: {track:?}");
            assert!(track.velocity.w.abs() + track.velocity.h.abs() < 1.0, "{name} at {rate}: {track:?}");
        }
    });
}

/// A scene of gaps and ends of all lengths.
fn gaps() -> Vec<Walker> {
    let gap = |n: usize| {
        let (top, from) = (100.0 * n as f64, 1.0 + 0.1 * n as f64);
        let speed = (20.0 + 5.0 * n as f64, 0.0);
        // Of a whole number of frames, whatever the rounding.
        Walker::new(100.0, top, speed).hidden(from - 0.01, from + [1, 2, 3, 10, 29, 30, 31, 32][n] as f64 / RATE - 0.01)
    };
    (0..8).map(gap).chain([Walker::new(900.0, 100.0, (0.0, 0.0)).seen(0.0, 1.0)]).collect()
}

/// Plays the scene of gaps with and without timestamps to two trackers.
fn compare_with_timestamps(algorithm: Algorithm, stamp: impl Fn(f64) -> i64, near: f64) {
    let name = algorithm.name();
    for settings in [&[][..], patient(algorithm)] {
        let (mut plain, mut stamped) = (tracker(algorithm, settings), tracker(algorithm, settings));
        for index in 0..120 {
            let seen = look(&gaps(), frame_time(index));
            let frame = if index % 7 == 6 { Frame::skipped() } else { Frame::new(&seen) };
            let expected = plain.step(&frame).unwrap();
            let found = stamped.step(&Frame { timestamp_ns: Some(stamp(frame_time(index))), ..frame }).unwrap();
            let what = format!("{name}: frame {index}: {found:#?} instead of {expected:#?}");
            assert_eq!(found.ended, expected.ended, "{what}");
            assert_eq!(found.track_of_detection, expected.track_of_detection, "{what}");
            let lists = |o: &Output| [o.reported.clone(), o.tentative.clone(), o.lost.clone()];
            for (found, expected) in lists(found).iter().zip(&lists(expected)) {
                assert_eq!(found.len(), expected.len(), "{what}");
                for (a, b) in found.iter().zip(expected) {
                    let unboxed = |t: &Track| Track { rect: Rect::default(), velocity: Default::default(), ..*t };
                    assert_eq!(unboxed(a), unboxed(b), "{what}");
                    let sides = [a.rect.left - b.rect.left, a.rect.top - b.rect.top, a.rect.right() - b.rect.right()];
                    assert!(sides.iter().all(|d| d.abs() < near), "{what}");
                }
            }
        }
    }
}

#[test]
fn timestamps_at_the_nominal_rate_change_nothing() {
    // A frame of 1/30 s is no whole number of nanoseconds.
    for_all(|algorithm, _| compare_with_timestamps(algorithm, |time| (time * 1e9).round() as i64, 1e-3));
    for_all(|algorithm, _| compare_with_timestamps(algorithm, |time| 77 + (time * 1e9).floor() as i64, 1e-3));
}

#[test]
fn timestamps_in_whole_milliseconds_cost_no_identity() {
    use Algorithm::*;
    // GenTrack2 reckons in real time to the last bit.
    for algorithm in [Sort, DeepSort, ByteTrack, OcSort, BotSort, SmileTrack, ConfTrack] {
        // 33, 33, 34 ms, wherever the long one falls.
        for third in 0..3 {
            let whole = |time: f64| (time * 1e3 + third as f64 / 3.0 + 0.1).floor() as i64;
            compare_with_timestamps(algorithm, |time| 1_000_000 * whole(time), 1.0);
        }
    }
}

/// For how many frames a lost track lives on.
fn lives_on(algorithm: Algorithm, settings: &[(&str, &str)], interval: Option<f64>) -> usize {
    let mut tracker = tracker(algorithm, settings);
    let mut step = |index: usize, seen: &[Detection]| {
        let time = interval.map(|seconds| (index as f64 * seconds * 1e9).round() as i64);
        let output = tracker.step(&Frame { timestamp_ns: time, ..Frame::new(seen) }).unwrap();
        live(output).count()
    };
    let seen = [Detection::new(100.0, 100.0, 40.0, 90.0, 0.9)];
    (0..20).for_each(|index| assert_eq!(step(index, &seen), 1, "{}", algorithm.name()));
    (20..400).position(|index| step(index, &[]) == 0).unwrap_or_else(|| panic!("{} lives on", algorithm.name()))
}

#[test]
fn with_timestamps_lives_are_measured_in_real_time() {
    for_all(|algorithm, name| {
        let settings = patient(algorithm);
        let usual = lives_on(algorithm, settings, None) as f64 / RATE;
        let slow = lives_on(algorithm, settings, Some(0.1)) as f64 * 0.1;
        let fast = lives_on(algorithm, settings, Some(1.0 / 90.0)) as f64 / 90.0;
        // A whole number of frames, one of them perhaps to be sought for once more.
        assert!((slow - usual).abs() < 0.201 && (fast - usual).abs() < 0.067, "{name}: {usual} s, {slow} s, {fast} s");
    });
}

#[test]
fn the_frame_rate_scales_lives_where_the_publication_or_the_parameters_say_so() {
    for_all(|algorithm, name| {
        let life = |rate: &str| {
            let mut settings = patient(algorithm).to_vec();
            settings.push(("frame_rate", rate));
            lives_on(algorithm, &settings, None) as i64
        };
        let (half, usual, twice) = (life("15"), life("30"), life("60"));
        if BUFFERED.contains(&algorithm) {
            assert_eq!((usual - half, twice - usual), (15, 30), "{name}: {half}, {usual}, {twice}");
        } else if algorithm == Algorithm::GenTrack2 {
            assert!(
                (2 * half - usual).abs() <= 2 && (twice - 2 * usual).abs() <= 2,
                "{name}: {half}, {usual}, {twice}"
            );
        } else {
            assert_eq!((half, twice), (usual, usual), "{name}: their parameters are in frames");
        }
    });
}

/// A camera that is shaken: where the origin of the world is seen, in whole pixels.
fn shaken(index: usize) -> (f64, f64) {
    let swing = |k: usize, m: usize| (k * k * 31 % m) as f64 - (m / 2) as f64;
    if index == 0 { (0.0, 0.0) } else { (swing(index, 61), swing(index + 3, 47)) }
}

fn shifted(rect: &Rect, by: (f64, f64)) -> Rect {
    Rect { left: rect.left + by.0, top: rect.top + by.1, ..*rect }
}

/// Plays a parade before a shaken camera; `watch` gets the frame, the camera's place and the output.
fn shake(tracker: &mut Tracker, known: bool, mut watch: impl FnMut(usize, (f64, f64), &Output)) {
    let mut walkers = three();
    walkers[0] = walkers[0].clone().hidden(1.0, 1.2);
    for index in 0..90 {
        let place = shaken(index);
        let mut seen = look(&walkers, frame_time(index));
        seen.iter_mut().for_each(|d| d.rect = shifted(&d.rect, place));
        let before = if index == 0 { place } else { shaken(index - 1) };
        let motion = CameraMotion([1.0, 0.0, place.0 - before.0, 0.0, 1.0, place.1 - before.1]);
        let frame = if index > 60 && index % 3 != 0 { Frame::skipped() } else { Frame::new(&seen) };
        let output = tracker.step(&Frame { camera_motion: known.then_some(motion), ..frame }).unwrap();
        watch(index, place, output);
    }
}

#[test]
fn a_known_camera_motion_changes_nothing_but_coordinates() {
    for_all(|algorithm, name| {
        let mut settings = patient(algorithm).to_vec();
        if has(algorithm, "use_camera_motion") {
            settings.push(("use_camera_motion", "true"));
        }
        let mut walkers = three();
        walkers[0] = walkers[0].clone().hidden(1.0, 1.2);
        let (mut shaken, mut still) = (tracker(algorithm, &settings), tracker(algorithm, &settings));
        shake(&mut shaken, true, |index, place, output| {
            let seen = look(&walkers, frame_time(index));
            let frame = if index > 60 && index % 3 != 0 { Frame::skipped() } else { Frame::new(&seen) };
            let frame = Frame { camera_motion: Some(CameraMotion::IDENTITY), ..frame };
            let expected = still.step(&frame).unwrap();
            assert_eq!(live(output).count(), live(expected).count(), "{name}: frame {index}");
            for (track, other) in live(output).zip(live(expected)) {
                let what = format!("{name}: frame {index}: {track:?} instead of {other:?} at {place:?}");
                assert_eq!((track.id, track.state), (other.id, other.state), "{what}");
                assert!(distance(&track.rect, &shifted(&other.rect, place)) < 1e-6, "{what}");
                assert!((track.velocity.u - other.velocity.u).abs() < 1e-6, "{what}");
            }
        });
        let ids: BTreeSet<u64> = live(shaken.output()).map(|t| t.id).collect();
        assert_eq!(ids, BTreeSet::from([1, 2, 3]), "{name}");
    });
}

#[test]
fn a_known_camera_motion_changes_nothing_in_a_crowd() {
    for_all(|algorithm, name| {
        let mut settings = patient(algorithm).to_vec();
        if has(algorithm, "use_camera_motion") {
            settings.push(("use_camera_motion", "true"));
        }
        let (mut moving, mut still) = (tracker(algorithm, &settings), tracker(algorithm, &settings));
        for (index, input) in crowd(11).iter().enumerate() {
            let output = moving.step(&input.frame()).unwrap();
            let expected = still.step(&input.still().frame()).unwrap();
            assert_eq!(output.track_of_detection, expected.track_of_detection, "{name}: frame {index}");
            assert_eq!(output.ended, expected.ended, "{name}: frame {index}");
            for (track, other) in live(output).zip(live(expected)) {
                let what = format!("{name}: frame {index}: {track:?} instead of {other:?} at {:?}", input.place);
                assert_eq!((track.id, track.state), (other.id, other.state), "{what}");
                assert!(distance(&track.rect, &shifted(&other.rect, input.place)) < 1e-6, "{what}");
            }
        }
    });
}

#[test]
fn camera_motion_is_off_by_default_where_the_publication_has_none() {
    use Algorithm::*;
    for_all(|algorithm, name| {
        let transcript = |settings: &[(&str, &str)], known| {
            let mut lines = Vec::new();
            shake(&mut tracker(algorithm, settings), known, |_, _, output| lines.push(format!("{output:?}")));
            lines
        };
        let unknown = transcript(&[], false);
        let by_default = transcript(&[], true);
        let off = transcript(&[("use_camera_motion", "false")], true);
        let on = transcript(&[("use_camera_motion", "true")], true);
        let published = matches!(algorithm, GenTrack2 | BotSort | SmileTrack | ConfTrack);
        assert!(off == unknown, "{name}: off is as if it were not known");
        assert!(on != off, "{name}: it matters");
        assert!(by_default == if published { on } else { off }, "{name}: the default");
    });
}
