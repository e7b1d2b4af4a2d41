//! Scenes in which every identity must last, with appearance (the image is given) and without, always with the default
//! parameters. `simulator::verdict` says what "last" means: one identity per object over its whole life, never shared,
//! shown where the object is, and nothing shown where there is none.

mod simulator;

use std::collections::BTreeSet;

use gentrack2::{Config, Detection, Frame, ImageView, PixelFormat, Track, TrackState, Tracker};
use simulator::contract::{Contract, all_tracks};
use simulator::driver::{Feed, tracker};
use simulator::scene::Scene;
use simulator::stage;
use simulator::verdict::{Verdict, demand_identities, judge};

const SEEDS: std::ops::Range<u64> = 0..10;
/// Images take time.
const IMAGE_SEEDS: std::ops::Range<u64> = 0..5;

/// A test of a scene without and one with the image.
macro_rules! scenario {
    ($name:ident, $scene:expr) => {
        mod $name {
            use super::*;

            #[test]
            fn by_motion_alone() {
                demand_identities(SEEDS, Feed::default(), $scene);
            }

            #[test]
            fn with_appearance() {
                demand_identities(IMAGE_SEEDS, Feed::with_image(true), $scene);
            }
        }
    };
}

scenario!(crossing_at_90_degrees, |seed| stage::crossing(seed, 90.0));
scenario!(crossing_at_15_degrees, |seed| stage::crossing(seed, 15.0));
scenario!(full_occlusion_of_one_second, |seed| stage::full_occlusion(seed, 1.0));
scenario!(side_by_side_while_one_is_undetected, |seed| stage::side_by_side(seed, 0.8));
scenario!(turn_while_hidden, stage::turn_while_hidden);
scenario!(entering_and_leaving, stage::entering_and_leaving);
scenario!(ten_targets_with_thirty_percent_misses, |seed| stage::ten_targets(seed, 0.3));

/// To motion alone the two have passed each other; the image tells that they turned back.
#[test]
fn looks_decide_where_motion_misleads() {
    let kept = |image: bool| {
        let keeps = |seed: &u64| {
            let feed = Feed { seed: *seed, ..Feed::with_image(image) };
            judge(&stage::meeting_and_turning_back(*seed), feed).complaints().is_empty()
        };
        (0..20).filter(keeps).count()
    };
    let (with, without) = (kept(true), kept(false));
    assert!(with >= 15 && without <= 5, "kept in {with} of 20 with the image, in {without} without");
}

/// Where nobody could know where somebody went, it is the looks that tell who comes back.
#[test]
fn who_comes_back_is_recognised() {
    for image in [true, false] {
        for seed in IMAGE_SEEDS {
            let scene = stage::turning_back_unseen(seed);
            let mut tracker = tracker(seed);
            let mut contract = Contract::default();
            let mut shown = BTreeSet::new();
            for seen in scene.play(image) {
                let output = Feed::with_image(image).step(&mut tracker, &scene, &seen).unwrap();
                contract.check(&seen.detections, output);
                let on_it = |track: &&Track| seen.source[track.detection_index.unwrap()] == Some(0);
                let matched = output.reported.iter().filter(|t| t.frames_since_match == 0);
                shown.extend(matched.filter(on_it).map(|t| t.id));
                // Nobody is shown where nobody was found for long.
                assert!(output.reported.iter().all(|t| t.frames_since_match < 30), "seed {seed}");
            }
            assert_eq!(shown.len(), if image { 1 } else { 2 }, "seed {seed}: {shown:?}");
        }
    }
}

/// Those who are kept for their looks alone do not take the place of others.
#[test]
fn who_is_only_remembered_makes_room() {
    let mut config = Config::new("gentrack2").unwrap();
    config.set_text("max_tracks", "3").unwrap();
    let mut tracker = Tracker::new(&config).unwrap();
    let texture: Vec<u8> = (0..768u32 * 576).map(|i| (i % 768 * 5 + i / 768 * 3) as u8).collect();
    let image = ImageView::new(&texture, 768, 576, 0, PixelFormat::Gray8).unwrap();
    let row = |top: f64| (0..3).map(move |i| Detection::new(100.0 + 90.0 * i as f64, top, 40.0, 100.0, 0.9));
    let (first, second): (Vec<_>, Vec<_>) = (row(10.0).collect(), row(400.0).collect());
    let mut contract = Contract::default();
    let mut shown = 0;
    for frame in 0..100 {
        let detections = if frame < 20 { &first } else { &second };
        let output = tracker.step(&Frame { image: Some(image), ..Frame::new(detections) }).unwrap();
        contract.check(detections, output);
        assert!(all_tracks(output).count() <= 3, "frame {frame}");
        shown = output.reported.iter().filter(|t| t.rect.top > 300.0).count();
    }
    assert_eq!(shown, 3);
}

mod moving_camera {
    use super::*;

    fn demand(seeds: std::ops::Range<u64>, image: bool, camera_motion: bool) {
        let camera = if camera_motion { stage::SHAKE } else { stage::SLOW_PAN };
        demand_identities(seeds, Feed { image, camera_motion, ..Feed::default() }, |s| stage::moving_camera(s, camera));
    }

    #[test]
    fn shaking_with_its_motion_given() {
        demand(SEEDS, false, true);
    }

    #[test]
    fn shaking_with_its_motion_given_and_appearance() {
        demand(IMAGE_SEEDS, true, true);
    }

    #[test]
    fn panning_slowly_without_its_motion_given() {
        demand(SEEDS, false, false);
    }

    #[test]
    fn panning_slowly_without_its_motion_given_and_appearance() {
        demand(IMAGE_SEEDS, true, false);
    }
}

mod frame_rates {
    use super::*;

    fn at_ten_frames_per_second(scene: Scene) -> Scene {
        Scene { frames_per_second: 10.0, ..scene }
    }

    #[test]
    fn ten_frames_per_second_with_timestamps() {
        let feed = Feed { timestamps: true, ..Feed::default() };
        demand_identities(SEEDS, feed, |s| at_ten_frames_per_second(stage::crossing(s, 90.0)));
        demand_identities(SEEDS, feed, |s| at_ten_frames_per_second(stage::crossing(s, 15.0)));
        demand_identities(SEEDS, feed, |s| at_ten_frames_per_second(stage::side_by_side(s, 0.8)));
    }

    #[test]
    fn ten_frames_per_second_with_timestamps_and_appearance() {
        let feed = Feed { timestamps: true, ..Feed::with_image(true) };
        demand_identities(IMAGE_SEEDS, feed, |s| at_ten_frames_per_second(stage::crossing(s, 90.0)));
    }

    /// A walker at 90 px/s seen at uneven times: after 1, 4, 2, 1, 4, 2 ... intervals of 1/30 s.
    #[test]
    fn uneven_times_give_the_true_speed_and_place() {
        let at = |t: f64| gentrack2::Rect::new(50.0 + 90.0 * t, 200.0, 40.0, 100.0);
        let mut tracker = tracker(0);
        let mut t = 0.0;
        let mut step = |t: f64, detected: bool| {
            let r = at(t);
            let detections = [Detection::new(r.left, r.top, r.width, r.height, 0.9)];
            let frame = if detected { Frame::new(&detections) } else { Frame::skipped() };
            tracker.step(&Frame { timestamp_ns: Some((t * 1e9) as i64), ..frame }).unwrap().reported.clone()
        };
        for frame in 0..60 {
            t += [1.0, 4.0, 2.0][frame % 3] / 30.0;
            let tracks = step(t, true);
            assert_eq!((tracks.len(), tracks[0].id), (1, 1), "frame {frame}");
            if frame > 20 {
                assert!((tracks[0].velocity.u - 90.0).abs() < 1.0, "frame {frame}: {:?}", tracks[0].velocity);
            }
        }
        // Where the detector does not run the box is a prediction over the time gone by: 3, then 12 px.
        for intervals in [1.0, 4.0] {
            t += intervals / 30.0;
            let tracks = step(t, false);
            assert!(tracks[0].rect.iou(&at(t)) > 0.95, "{:?}, true {:?}", tracks[0].rect, at(t));
        }
    }

    /// A lost track lives as long at 10 frames per second as at 30.
    #[test]
    fn lifetimes_are_in_real_time() {
        let seconds_lost = |interval: f64| {
            let mut tracker = tracker(0);
            let detections = [Detection::new(100.0, 100.0, 40.0, 100.0, 0.9)];
            for frame in 0.. {
                let t = frame as f64 * interval;
                let seen: &[Detection] = if t < 2.0 { &detections } else { &[] };
                let output = tracker.step(&Frame { timestamp_ns: Some((t * 1e9) as i64), ..Frame::new(seen) }).unwrap();
                if !output.ended.is_empty() {
                    return t - 2.0;
                }
            }
            unreachable!()
        };
        let (ten, thirty) = (seconds_lost(0.1), seconds_lost(1.0 / 30.0));
        // Whole frames: an end can come an interval later.
        assert!((ten - thirty).abs() <= 0.101, "{ten} s at 10, {thirty} s at 30 frames per second");
    }

    #[test]
    fn timestamps_at_the_nominal_rate_keep_identities() {
        let feed = Feed { timestamps: true, ..Feed::default() };
        demand_identities(SEEDS, feed, |s| stage::crossing(s, 90.0));
    }
}

mod skipped_detector {
    use super::*;

    const FEED: Feed = Feed { image: false, camera_motion: false, timestamps: false, detect_every: 3, seed: 0 };

    #[test]
    fn on_two_frames_of_three_identities_last() {
        demand_identities(SEEDS, FEED, |s| stage::crossing(s, 90.0));
        demand_identities(SEEDS, FEED, |s| stage::side_by_side(s, 0.6));
        demand_identities(IMAGE_SEEDS, Feed { image: true, ..FEED }, |s| stage::crossing(s, 90.0));
    }

    /// Walkers far apart, each detected whenever the detector runs, with the tracks shown in each frame.
    fn play_in_the_open(skipped: impl Fn(usize) -> bool) -> Vec<Vec<Track>> {
        let mut tracker = tracker(0);
        (0..60)
            .map(|frame| {
                let x = 50.0 + 3.0 * frame as f64;
                let detections = [(x, 50.0), (x, 300.0)].map(|(x, y)| Detection::new(x, y, 40.0, 100.0, 0.9));
                let frame = if skipped(frame) { Frame::skipped() } else { Frame::new(&detections) };
                tracker.step(&frame).unwrap().reported.clone()
            })
            .collect()
    }

    #[test]
    fn tracks_are_shown_and_trusted_where_the_detector_should_see_them() {
        // The detector runs on every third frame, then pauses for 15 frames.
        let skipped = |frame: usize| (31..=45).contains(&frame) || !frame.is_multiple_of(3);
        for (frame, tracks) in play_in_the_open(skipped).iter().enumerate() {
            assert_eq!(tracks.iter().map(|t| t.id).collect::<BTreeSet<_>>(), BTreeSet::from([1, 2]), "frame {frame}");
            for track in tracks {
                assert_eq!(track.state, TrackState::Confirmed, "frame {frame}: {track:?}");
                let wide =
                    track.rect.iou(&gentrack2::Rect::new(50.0 + 3.0 * frame as f64, track.rect.top, 40.0, 100.0));
                assert!(frame < 12 || wide > 0.75, "frame {frame}: IoU {wide} of {track:?}");
            }
        }
    }

    #[test]
    fn a_frame_without_detections_is_a_miss_unlike_a_skipped_one() {
        let mut tracker = tracker(0);
        let detections = [Detection::new(100.0, 100.0, 40.0, 100.0, 0.9)];
        for _ in 0..20 {
            tracker.step(&Frame::new(&detections)).unwrap();
        }
        assert_eq!(tracker.step(&Frame::skipped()).unwrap().reported[0].state, TrackState::Confirmed);
        let output = tracker.step(&Frame::new(&[])).unwrap();
        let tracks: Vec<&Track> = all_tracks(output).collect();
        assert_eq!((tracks.len(), tracks[0].state, tracks[0].frames_since_match), (1, TrackState::Lost, 2));
    }
}

/// Boxes that the image's border cuts off.
mod at_the_border {
    use super::*;

    const SIZE: Option<(u32, u32)> = Some((640, 480));

    /// A step with one detection of which this share is right of the left border.
    fn step(tracker: &mut Tracker, share: f64, score: f64) -> gentrack2::Output {
        let detections = [Detection::new(-40.0 * (1.0 - share), 100.0, 40.0, 100.0, score)];
        tracker.step(&Frame { size: SIZE, ..Frame::new(&detections) }).unwrap().clone()
    }

    #[test]
    fn who_is_mostly_beyond_it_is_tracked_and_reported_again_when_he_is_back() {
        let mut tracker = tracker(0);
        for _ in 0..10 {
            assert_eq!(step(&mut tracker, 1.0, 0.9).track_of_detection, [1]);
        }
        // Out in ten frames; scores fall as less is seen.
        for out in 1..=10 {
            step(&mut tracker, 1.0 - 0.08 * f64::from(out), 0.9);
        }
        let beyond = (0..20).map(|_| step(&mut tracker, 0.2, 0.4)).last().unwrap();
        assert_eq!(beyond.track_of_detection, [1]);
        assert_eq!((beyond.reported.len(), beyond.lost.len()), (0, 0));
        assert_eq!((beyond.tentative[0].id, beyond.tentative[0].state), (1, TrackState::Confirmed));
        for back in 1..=10 {
            step(&mut tracker, 0.2 + 0.08 * f64::from(back), 0.4);
        }
        assert_eq!(step(&mut tracker, 1.0, 0.4).reported[0].id, 1);
    }

    #[test]
    fn good_scores_vouch_for_what_is_beyond_it() {
        let mut tracker = tracker(0);
        for share in (2..=10).rev().chain([2; 20]) {
            step(&mut tracker, 0.1 * f64::from(share), 0.9);
        }
        assert_eq!(step(&mut tracker, 0.2, 0.9).reported[0].id, 1);
    }

    #[test]
    fn who_comes_in_starts_a_track_when_enough_is_seen_or_scores_are_good() {
        let births = |share: f64, score: f64| step(&mut tracker(0), share, score).track_of_detection[0];
        assert_eq!((births(0.4, 0.75), births(0.6, 0.75), births(0.4, 0.85)), (0, 1, 1));
    }
}

/// What comes back on tracks besides their box.
mod bookkeeping {
    use super::*;

    #[test]
    fn class_tag_and_row_of_the_detection_come_back() {
        // `Contract` compares them with the detection taken; here they differ from row to row and change in time.
        let mut tracker = tracker(0);
        let mut contract = Contract::default();
        for frame in 0..30u64 {
            let mut detections: Vec<Detection> = (0..5)
                .map(|i| Detection {
                    class_id: 10 * i as i32 - 7,
                    tag: u64::MAX - 100 * frame - i,
                    ..Detection::new(40.0 + 100.0 * i as f64, 50.0 + frame as f64, 40.0, 100.0, 0.8 + 0.01 * i as f64)
                })
                .collect();
            detections.rotate_left(frame as usize % 5);
            let output = tracker.step(&Frame::new(&detections)).unwrap();
            contract.check(&detections, output);
            if frame >= 3 {
                assert_eq!(output.reported.len(), 5);
                assert!(output.reported.iter().all(|t| t.detection_index.is_some() && t.frames_since_match == 0));
                assert_eq!(output.reported.iter().map(|t| t.class_id).collect::<BTreeSet<_>>().len(), 5);
                assert!(output.reported.iter().all(|t| t.age == frame as u32 + 1 && t.hits == t.age));
            }
        }
    }

    #[test]
    fn a_lost_track_is_listed_where_it_is_predicted_until_it_ends_once() {
        let config = Config::new("gentrack2").unwrap();
        let number = |key: &str| config.get(key).unwrap().to_string().parse::<f64>().unwrap();
        let (missed, coast) = (number("max_missed") as usize, number("coast") as usize);
        let mut tracker = tracker(0);
        let mut contract = Contract::default();
        let at =
            |frame: usize| gentrack2::Rect::new(100.0 + 3.0 * frame as f64, 200.0 - 1.0 * frame as f64, 40.0, 100.0);
        let mut end = None;
        for frame in 0..200 {
            let r = at(frame);
            let detections: Vec<Detection> =
                (frame < 40).then(|| Detection::new(r.left, r.top, r.width, r.height, 0.9)).into_iter().collect();
            let output = tracker.step(&Frame { size: Some((768, 576)), ..Frame::new(&detections) }).unwrap();
            contract.check(&detections, output);
            let tracks: Vec<&Track> = all_tracks(output).collect();
            if frame < 40 {
                continue;
            }
            match tracks[..] {
                [track] => {
                    assert!(end.is_none());
                    assert_eq!((track.id, track.frames_since_match as usize), (1, frame - 39));
                    assert!(track.rect.iou(&at(frame)) > 0.6, "frame {frame}: {:?}, true {:?}", track.rect, at(frame));
                    if track.frames_since_match as usize > coast {
                        assert_eq!(output.lost.len(), 1, "frame {frame}: shown for longer than it may coast");
                    }
                }
                [] => end = end.or(Some(frame)),
                _ => panic!("{tracks:?}"),
            }
        }
        // The last match was in frame 39.
        let lived = end.expect("it ends") - 39;
        assert!(lived <= missed + 1 && lived >= missed / 2, "ended {lived} frames after its last match");
        assert_eq!(contract.ended().iter().copied().collect::<Vec<_>>(), [1]);
    }

    #[test]
    fn those_who_left_end_and_are_not_shown_as_ghosts() {
        let config = Config::new("gentrack2").unwrap();
        let coast: f64 = config.get("coast").unwrap().to_string().parse().unwrap();
        for seed in SEEDS {
            let scene = stage::entering_and_leaving(seed);
            let mut tracker = tracker(seed);
            let mut verdict = Verdict::new(&scene);
            for seen in scene.play(false) {
                let output = Feed::default().step(&mut tracker, &scene, &seen).unwrap();
                verdict.watch(&seen, true, output);
                for track in &output.reported {
                    assert!(track.frames_since_match as f64 <= coast, "seed {seed}, frame {}: {track:?}", seen.frame);
                }
            }
            let shown: BTreeSet<u64> = (0..scene.objects.len()).map(|o| verdict.identity(o)).collect();
            assert_eq!(shown.len(), 9, "seed {seed}");
            // All have left seconds before the end of the scene; only clutter may be alive.
            assert!(shown.is_subset(verdict.contract.ended()), "seed {seed}");
        }
    }

    #[test]
    fn identities_are_never_used_again() {
        // A hundred targets come and go one after the other, each long after the one before has ended.
        let mut tracker = tracker(0);
        let mut contract = Contract::default();
        let detections = [Detection::new(100.0, 100.0, 40.0, 100.0, 0.9)];
        for frame in 0..100 * 80 {
            let seen = if frame % 80 < 6 { &detections[..] } else { &[] };
            let output = tracker.step(&Frame::new(seen)).unwrap();
            contract.check(seen, output);
        }
        assert_eq!(contract.ended().len(), 100);
    }

    #[test]
    fn discarded_particles_are_drawn_again_in_the_next_frame() {
        let mut config = Config::new("gentrack2").unwrap();
        for (key, value) in [("particles", "8"), ("resampling", "discard"), ("resampling_fraction", "0.5")] {
            config.set_text(key, value).unwrap();
        }
        let mut tracker = Tracker::new(&config).unwrap();
        let detections = [Detection::new(10.0, 10.0, 40.0, 100.0, 0.9)];
        tracker.step(&Frame::new(&detections)).unwrap();
        for frame in 1..20 {
            tracker.step(&Frame::new(&detections)).unwrap();
            assert_eq!(tracker.particles(1).unwrap().len(), 4, "frame {frame}");
        }
    }

    #[test]
    fn no_more_tracks_are_born_than_allowed() {
        let mut config = Config::new("gentrack2").unwrap();
        config.set_text("max_tracks", "3").unwrap();
        let mut tracker = Tracker::new(&config).unwrap();
        let detections: Vec<_> = (0..8).map(|i| Detection::new(90.0 * i as f64, 10.0, 40.0, 100.0, 0.9)).collect();
        for _ in 0..10 {
            assert_eq!(all_tracks(tracker.step(&Frame::new(&detections)).unwrap()).count(), 3);
        }
    }

    #[test]
    fn frames_without_detections_are_normal() {
        let mut tracker = tracker(0);
        for frame in
            [Frame::new(&[]), Frame::skipped(), Frame::new(&[]), Frame { size: Some((640, 480)), ..Frame::new(&[]) }]
        {
            let output = tracker.step(&frame).unwrap();
            assert_eq!(all_tracks(output).count() + output.ended.len() + output.track_of_detection.len(), 0);
        }
        let detections = [Detection::new(10.0, 10.0, 40.0, 100.0, 0.9)];
        for _ in 0..5 {
            tracker.step(&Frame::new(&detections)).unwrap();
        }
        assert_eq!(tracker.output().reported.len(), 1);
    }
}

#[test]
fn a_different_seed_keeps_the_identities() {
    let scenes = [
        stage::crossing(1, 90.0),
        stage::crossing(2, 15.0),
        stage::full_occlusion(3, 1.0),
        stage::side_by_side(4, 0.8),
        stage::turn_while_hidden(5),
        stage::ten_targets(6, 0.3),
    ];
    for (scene, image) in scenes.iter().flat_map(|scene| [(scene, false), (scene, true)]) {
        let identities = |seed: u64| -> Vec<u64> {
            let verdict = judge(scene, Feed { seed, ..Feed::with_image(image) });
            assert_eq!(verdict.complaints(), Vec::<String>::new(), "tracker seed {seed}");
            (0..scene.objects.len()).map(|object| verdict.identity(object)).collect()
        };
        let first = identities(0);
        for seed in [1, 2, 1 << 40] {
            assert_eq!(identities(seed), first, "tracker seed {seed}");
        }
    }
}
