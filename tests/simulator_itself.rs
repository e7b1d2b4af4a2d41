//! The simulator itself: its scenes contain the events they are named after, its images show what its truth says and
//! its detector is as noisy as stated.

mod simulator;

use simulator::camera::Camera;
use simulator::detector::Detector;
use simulator::path::Path;
use simulator::scene::{Object, Scene, Truth};
use simulator::stage;

#[test]
fn tests_of_every_algorithm_leave_none_out() {
    let all: Vec<_> = gentrack2::Algorithm::ALL.iter().map(|a| a.name()).collect();
    assert_eq!(for_every_algorithm!(@names list)[..], all);
}

const SEEDS: std::ops::Range<u64> = 0..10;

/// The truths of one object, frame by frame.
fn truths(scene: &Scene, object: usize) -> Vec<Truth> {
    scene.play(false).filter_map(|s| s.truth.into_iter().find(|t| t.object == object)).collect()
}

fn frames_below(scene: &Scene, object: usize, visible: f64) -> usize {
    truths(scene, object).iter().filter(|t| t.visible < visible).count()
}

#[test]
fn crossings_hide_the_farther_target() {
    for seed in SEEDS {
        for (degrees, least) in [(90.0, 5), (15.0, 10)] {
            let scene = stage::crossing(seed, degrees);
            let hidden = frames_below(&scene, 1, 0.3);
            assert!(hidden >= least && hidden <= 30, "{degrees} degrees, seed {seed}: {hidden} frames");
            assert_eq!(frames_below(&scene, 0, 0.99), 0, "nothing hides the nearer one");
        }
    }
}

#[test]
fn crossings_have_the_stated_angle() {
    for degrees in [15.0, 90.0f64] {
        let scene = stage::crossing(3, degrees);
        let headings = [0, 1].map(|object| {
            let all = truths(&scene, object);
            let (a, b) = (all[10].rect, all[100].rect);
            (b.left - a.left, b.top - a.top)
        });
        let [(ax, ay), (bx, by)] = headings;
        let cosine = (ax * bx + ay * by) / ((ax * ax + ay * ay) * (bx * bx + by * by)).sqrt();
        assert!((cosine - libm::cos(degrees.to_radians())).abs() < 1e-9, "{degrees}: cosine {cosine}");
    }
}

#[test]
fn a_full_occlusion_of_one_second_shows_nothing_for_thirty_frames() {
    for seed in SEEDS {
        let scene = stage::full_occlusion(seed, 1.0);
        // 37 px either side at 74 px/s: 1 s; the grid that samples the visible share may add a frame at each end.
        let nothing = truths(&scene, 1).iter().filter(|t| t.visible == 0.0).count();
        assert!((30..=32).contains(&nothing), "seed {seed}: {nothing}");
        let undetected = frames_below(&scene, 1, 0.3);
        assert!((36..=42).contains(&undetected), "seed {seed}: {undetected}");
    }
}

#[test]
fn the_turn_happens_out_of_sight() {
    for seed in SEEDS {
        let scene = stage::turn_while_hidden(seed);
        let walker = truths(&scene, 1);
        // 3 s is frame 90.
        assert!(walker[86..94].iter().all(|t| t.visible < 0.3), "seed {seed}");
        let hidden = frames_below(&scene, 1, 0.3);
        assert!((12..=18).contains(&hidden), "seed {seed}: {hidden}");
        assert!(walker.last().unwrap().visible > 0.9, "seed {seed}: it comes out again");
    }
}

#[test]
fn those_who_turn_back_are_on_top_of_each_other_and_then_where_they_came_from() {
    for seed in 0..10 {
        let scene = stage::meeting_and_turning_back(seed);
        let at = |object: usize, t: f64| scene.objects[object].path.at(t).unwrap().0;
        assert!((at(0, 2.5) - at(1, 2.5)).abs() < 10.0, "seed {seed}");
        assert!((0..2).all(|o| (at(o, 5.0) - at(o, 0.0)).abs() < 1.0), "seed {seed}");
        let hidden = frames_below(&scene, 1, 0.6);
        assert!(hidden >= 5, "seed {seed}: {hidden}");
    }
}

#[test]
fn images_show_the_nearer_object() {
    // A small object stands before a big one: with either taken away, only its own pixels change.
    let standing =
        |x: f64, side: f64, depth: f64| Object::new(side, side, depth, Path::from(0.0, x, 100.0).walk(0.0, 0.0, 1.0));
    let picture = |objects: Vec<Object>| {
        let mut scene = Scene::new(1, 0.1, objects);
        (scene.width, scene.height) = (200, 200);
        scene.play(true).next().unwrap().image.unwrap()
    };
    let (big, small) = (standing(100.0, 80.0, 2.0), standing(100.0, 40.0, 1.0));
    let both = picture(vec![big.clone(), small.clone()]);
    let hidden_swapped = picture(vec![Object { depth: 0.5, ..big.clone() }, small.clone()]);
    let at = |image: &[u8], x: usize, y: usize| image[y * 200 + x];
    let differing = |area: std::ops::Range<usize>| {
        area.clone()
            .flat_map(|y| area.clone().map(move |x| (x, y)))
            .filter(|&(x, y)| at(&both, x, y) != at(&hidden_swapped, x, y))
            .count()
    };
    // The small one covers 80..120; outside it both pictures are the same, inside almost every pixel differs.
    assert!(differing(80..120) > 1400, "{}", differing(80..120));
    assert_eq!(differing(0..200), differing(79..121));
}

#[test]
fn sub_pixel_shifts_change_images_gradually() {
    let at = |x: f64| {
        let object = Object::new(40.0, 80.0, 1.0, Path::from(0.0, x, 100.0).walk(0.0, 0.0, 1.0));
        let mut scene = Scene::new(1, 0.1, vec![object]);
        (scene.width, scene.height) = (200, 200);
        scene.play(true).next().unwrap().image.unwrap()
    };
    let difference = |a: &[u8], b: &[u8]| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b) as u64).sum::<u64>() as f64;
    let (zero, tenth, one) = (at(100.0), at(100.1), at(101.0));
    let share = difference(&zero, &tenth) / difference(&zero, &one);
    assert!((0.03..0.25).contains(&share), "a tenth of a pixel makes {share} of the change of a pixel");
}

#[test]
fn the_camera_motion_moves_what_stands_still() {
    let object = Object::new(40.0, 100.0, 1.0, Path::from(0.0, 300.0, 200.0).walk(0.0, 0.0, 2.0));
    let mut scene = Scene::new(1, 2.0, vec![object]);
    scene.camera = Camera { rotation: Default::default(), ..stage::SHAKE };
    let seen: Vec<_> = scene.play(false).collect();
    let mut farthest: f64 = 0.0;
    for pair in seen.windows(2) {
        let (before, now) = (pair[0].truth[0].rect, pair[1].truth[0].rect);
        let (x, y) = pair[1].camera_motion.apply_point(before.left, before.top);
        assert!((x - now.left).abs() < 1e-6 && (y - now.top).abs() < 1e-6);
        farthest = farthest.max((now.left - before.left).abs());
    }
    assert!(farthest > 20.0 && farthest < 30.0, "{farthest}");
}

#[test]
fn the_detector_is_as_noisy_as_stated() {
    let object = Object::new(50.0, 100.0, 1.0, Path::from(0.0, 300.0, 200.0).walk(0.0, 0.0, 400.0));
    let mut scene = Scene::new(1, 400.0, vec![object]);
    scene.detector = Detector { miss: 0.3, clutter: 0.5, ..scene.detector };
    let (mut found, mut clutter, mut squares, mut score) = (0.0, 0.0, 0.0, 0.0);
    for seen in scene.play(false) {
        for (detection, source) in seen.detections.iter().zip(&seen.source) {
            match source {
                None => clutter += 1.0,
                Some(_) => {
                    let u = detection.rect.left + 0.5 * detection.rect.width;
                    found += 1.0;
                    score += detection.score;
                    squares += (u - 300.0) * (u - 300.0);
                }
            }
        }
    }
    // 12 000 frames: the standard deviation of a share is below 0.005; the centre's is 2 % of 50 px = 1 px.
    assert!((found / 12_000.0 - 0.7f64).abs() < 0.02, "{found}");
    assert!((clutter / 12_000.0 - 0.5f64).abs() < 0.02, "{clutter}");
    assert!((squares / found - 1.0f64).abs() < 0.1, "{}", squares / found);
    assert!((score / found - 0.9f64).abs() < 0.01, "{}", score / found);
}

/// The verdict on an imaginary tracker that knows the truth, told through `tamper`, which may spoil the tracks it shows
/// in a frame.
mod verdict {
    use std::collections::BTreeMap;

    use gentrack2::{Output, Track, TrackState};

    use super::*;
    use crate::simulator::scene::Observation;
    use crate::simulator::verdict::Verdict;

    fn complaints(tamper: impl Fn(&Observation, &mut Track)) -> Vec<String> {
        let scene = stage::crossing(0, 90.0);
        let mut verdict = Verdict::new(&scene);
        let mut born: BTreeMap<u64, usize> = BTreeMap::new();
        let mut before: Vec<u64> = Vec::new();
        for seen in scene.play(false) {
            let mut output = Output::default();
            output.begin(seen.detections.len());
            for truth in &seen.truth {
                let row = seen.source.iter().position(|s| *s == Some(truth.object));
                let mut track = known(truth, row.map(|row| (row, &seen.detections[row])));
                tamper(&seen, &mut track);
                let first = *born.entry(track.id).or_insert(seen.frame);
                track.age = (seen.frame - first + 2) as u32;
                if let Some(row) = row {
                    output.track_of_detection[row] = track.id;
                }
                output.reported.push(track);
            }
            let now: Vec<u64> = output.reported.iter().map(|t| t.id).collect();
            output.ended = before.iter().copied().filter(|id| !now.contains(id)).collect();
            before = now;
            verdict.watch(&seen, true, &output);
        }
        verdict.complaints()
    }

    fn known(truth: &Truth, detection: Option<(usize, &gentrack2::Detection)>) -> Track {
        Track {
            id: truth.object as u64 + 1,
            rect: truth.rect,
            velocity: Default::default(),
            state: if detection.is_some() { TrackState::Confirmed } else { TrackState::Lost },
            score: detection.map_or(0.5, |d| d.1.score),
            class_id: 0,
            tag: detection.map_or(0, |d| d.1.tag),
            detection_index: detection.map(|d| d.0),
            age: 0,
            hits: 1,
            frames_since_match: u32::from(detection.is_none()),
        }
    }

    #[test]
    fn has_nothing_to_say_of_the_truth() {
        assert_eq!(complaints(|_, _| {}), Vec::<String>::new());
    }

    #[test]
    fn names_a_swap_of_identities() {
        let got = complaints(|seen, track| {
            if seen.frame >= 80 {
                track.id = 3 - track.id;
            }
        });
        assert_eq!(got.len(), 2, "{got:?}");
        assert!(got[0].starts_with("object 0 had (frame, id) [(0, 1), (") && got[0].ends_with(", 2)]"), "{got:?}");
    }

    /// Frames in which the two objects' true boxes overlap by this IoU or more.
    fn frames_together(iou: f64) -> Vec<usize> {
        let together = |seen: &Observation| seen.truth[0].rect.iou(&seen.truth[1].rect) >= iou;
        stage::crossing(0, 90.0).play(false).filter(together).map(|seen| seen.frame).collect()
    }

    #[test]
    fn takes_no_side_while_two_boxes_coincide_but_knows_who_came_out() {
        let (coincident, near) = (frames_together(0.5), frames_together(0.3));
        assert!(coincident.len() >= 3 && near.len() > coincident.len(), "{coincident:?} {near:?}");
        let swapped = |frames: &[usize]| {
            complaints(|seen, track| {
                if frames.contains(&seen.frame) {
                    track.id = 3 - track.id;
                }
            })
        };
        assert_eq!(swapped(&coincident), Vec::<String>::new());
        assert!(swapped(&near).iter().any(|c| c.starts_with("object 0 had (frame, id)")), "{:?}", swapped(&near));
        let for_good: Vec<usize> = (coincident[0]..1000).collect();
        assert_eq!(swapped(&for_good).len(), 2);
    }

    #[test]
    fn names_a_second_identity() {
        let got = complaints(|seen, track| {
            if seen.frame >= 80 && track.id == 2 {
                track.id = 9;
            }
        });
        assert!(got.len() == 1 && got[0].starts_with("object 1 had (frame, id) [(0, 2), ("), "{got:?}");
    }

    #[test]
    fn names_boxes_that_are_off() {
        // Half a width to the side: IoU 1/3.
        let got = complaints(|_, track| track.rect.left += 0.5 * track.rect.width);
        assert_eq!(got, ["object 0 had a mean IoU of 0.33", "object 1 had a mean IoU of 0.33"]);
    }
}
