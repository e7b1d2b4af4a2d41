//! Input that is wrong, extreme or strange: a clear error that leaves no trace, or correct handling; never a panic, a
//! hang or a number that is not finite.

mod simulator;

use gentrack2::parameters::{Kind, Value};
use gentrack2::{Algorithm, CameraMotion, Config, Detection, Embeddings, Frame, ImageView, PixelFormat, Rect, Tracker};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use simulator::contract::Contract;
use simulator::driver::{exact, tracker, tracker_of};
use simulator::everyone::CLASS_POLICIES;
use simulator::noise::Noise;
use simulator::watched::Watched;

const WIDTH: u32 = 320;
const HEIGHT: u32 = 240;

/// Four walkers in frame `t`, all well detected.
fn walkers(t: usize) -> Vec<Detection> {
    let x = 3.0 * t as f64;
    [(20.0 + x, 20.0), (200.0 - x, 40.0), (100.0, 20.0 + x), (240.0, 120.0)]
        .iter()
        .zip(0..)
        .map(|(&(left, top), row)| Detection { tag: row, ..Detection::new(left, top, 30.0, 70.0, 0.9) })
        .collect()
}

fn texture() -> Vec<u8> {
    let mut noise = Noise::new(1, 1);
    (0..WIDTH * HEIGHT).map(|_| noise.below(256) as u8).collect()
}

fn view(data: &[u8], width: u32, height: u32) -> ImageView<'_> {
    ImageView::new(data, width, height, 0, PixelFormat::Gray8).unwrap()
}

/// Ten good frames with everything a frame can have, from frame `from` on; the exact outputs.
fn ten_good_frames(tracker: &mut Tracker, image: &[u8], from: usize) -> Vec<String> {
    let embeddings = [0.5f32; 16];
    (from..from + 10)
        .map(|t| {
            let detections = walkers(t);
            let frame = Frame {
                embeddings: Some(Embeddings::new(&embeddings, 4)),
                image: Some(view(image, WIDTH, HEIGHT)),
                camera_motion: Some(CameraMotion([1.0, 0.0, 0.1, 0.0, 1.0, -0.1])),
                timestamp_ns: Some(1_000_000 * (t as i64 + 1)),
                ..Frame::new(&detections)
            };
            exact(tracker.step(&frame).unwrap())
        })
        .collect()
}

/// Hands a frame to trackers at work, demands an error that starts with `message`, and that the tracker then goes on
/// exactly as its twin that never saw the frame.
fn refused(message: &str, frame: &Frame<'_>) {
    Algorithm::ALL.iter().for_each(|algorithm| refused_by(*algorithm, message, frame));
}

fn refused_by(algorithm: Algorithm, message: &str, frame: &Frame<'_>) {
    let (image, name) = (texture(), algorithm.name());
    let (mut offended, mut twin) = (tracker_of(algorithm, &[]), tracker_of(algorithm, &[]));
    assert_eq!(ten_good_frames(&mut offended, &image, 0), ten_good_frames(&mut twin, &image, 0), "{name}");
    assert_eq!(twin.output().reported.len(), 4, "{name}: there is a state to damage");
    let error = offended.step(frame).map(exact).expect_err(message).to_string();
    assert!(error.starts_with(message), "{name}: \"{error}\" instead of \"{message}\"");
    assert_eq!(exact(offended.output()), exact(twin.output()), "{name}");
    assert_eq!(ten_good_frames(&mut offended, &image, 10), ten_good_frames(&mut twin, &image, 10), "{name}");
}

#[test]
fn bad_fields_of_detections_are_refused_by_row_and_name() {
    const NAN: f64 = f64::NAN;
    const INF: f64 = f64::INFINITY;
    type Change = fn(&mut Detection, f64);
    let fields: [(&str, Change, &[f64]); 5] = [
        ("left", |d, x| d.rect.left = x, &[NAN, INF, -INF, 1e13]),
        ("top", |d, x| d.rect.top = x, &[NAN, INF, -INF, -1e13]),
        ("width", |d, x| d.rect.width = x, &[NAN, INF, -1.0, -1e-300, 1e13]),
        ("height", |d, x| d.rect.height = x, &[NAN, INF, -1.0, f64::MIN, f64::MAX]),
        ("score", |d, x| d.score = x, &[NAN, INF, -0.001, 1.001]),
    ];
    for (field, change, values) in fields {
        for (row, &value) in values.iter().enumerate() {
            let row = row % 4;
            let mut detections = walkers(10);
            change(&mut detections[row], value);
            refused(&format!("detections[{row}].{field}: "), &Frame::new(&detections));
        }
    }
}

#[test]
fn bad_embeddings_are_refused() {
    let detections = walkers(10);
    let numbers = [0.5f32; 40];
    let mut broken = [0.5f32; 16];
    broken[9] = f32::NAN;
    let with = |e| Frame { embeddings: Some(e), ..Frame::new(&detections) };
    refused("frame.embedding_dimension: is 0", &with(Embeddings { data: &numbers, dimension: 0, stride: 4 }));
    refused("frame.embedding_dimension: is 5", &with(Embeddings::new(&numbers, 5)));
    refused("frame.embedding_stride: is 3", &with(Embeddings { data: &numbers, dimension: 4, stride: 3 }));
    refused("frame.embeddings: holds 15", &with(Embeddings::new(&numbers[..15], 4)));
    refused("frame.embeddings: holds 40", &with(Embeddings { data: &numbers, dimension: 4, stride: usize::MAX / 2 }));
    refused("frame.embeddings: row 2: component 1 is ", &with(Embeddings::new(&broken, 4)));
}

#[test]
fn camera_motions_that_are_none_are_refused() {
    let detections = walkers(10);
    for motion in [
        [f64::NAN, 0.0, 0.0, 0.0, 1.0, 0.0],
        [1.0, 0.0, f64::INFINITY, 0.0, 1.0, 0.0],
        [1.0, 0.0, 0.0, 0.0, 1.0, -1e300],
        // Nothing, a line, a line again, a mirror-thin picture, a scale of 10 000.
        [0.0; 6],
        [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [1.0, 2.0, 0.0, 2.0, 4.0, 0.0],
        [1.0, 0.0, 0.0, 0.0, 1e-9, 0.0],
        [1e4, 0.0, 0.0, 0.0, 1e4, 0.0],
    ] {
        refused("camera_motion: ", &Frame { camera_motion: Some(CameraMotion(motion)), ..Frame::new(&detections) });
    }
}

#[test]
fn other_bad_fields_are_refused() {
    let detections = walkers(10);
    let image = texture();
    let good = Frame::new(&detections);
    // The last good frame has time 10 000 000.
    for time in [10_000_000, 9_999_999, 0, i64::MIN] {
        refused("timestamp_ns: ", &Frame { timestamp_ns: Some(time), ..good });
    }
    refused("frame.detector_skipped: ", &Frame { detector_skipped: true, ..good });
    refused("frame.image_width: ", &Frame { size: Some((0, 100)), ..good });
    refused("frame.image_height: ", &Frame { size: Some((100, 70_000)), ..good });
    let image = Some(view(&image, WIDTH, HEIGHT));
    refused("frame.image_width and image_height: ", &Frame { size: Some((WIDTH, HEIGHT + 1)), image, ..good });
}

for_every_algorithm! {
    fn more_detections_than_the_limit_are_refused(algorithm: Algorithm) {
        let mut tracker = tracker_of(algorithm, &[("max_detections", "3")]);
        let error = tracker.step(&Frame::new(&walkers(0))).map(exact).unwrap_err().to_string();
        assert_eq!(error, "detections: 4 exceeds the limit of 3 (parameter max_detections)");
        tracker.step(&Frame::new(&walkers(0)[..3])).unwrap();
    }

    fn there_are_never_more_tracks_than_allowed(algorithm: Algorithm) {
        for class_policy in CLASS_POLICIES {
            let mut watched = Watched::with(algorithm, &[("max_tracks", "3"), ("class_policy", class_policy)]);
            for t in 0..200 {
                // Who stands where and is of which class changes now and then.
                let mut detections = walkers(t % 20);
                detections.iter_mut().zip(0..).for_each(|(d, i)| {
                    d.class_id = (i + t as i32 / 7) % 3;
                    d.rect.left += 500.0 * (t / 10) as f64;
                });
                watched.step(&Frame::new(if t % 9 == 0 { &[] } else { &detections }));
                assert!(watched.listed() <= 3, "{class_policy}, frame {t}: {:?}", watched.tracker.output());
            }
            assert!(watched.contract.ended().len() > 3, "{class_policy}: there was room again");
        }
    }

    fn a_bad_first_frame_leaves_a_new_tracker(algorithm: Algorithm) {
        let image = texture();
        let mut offended = tracker_of(algorithm, &[]);
        let mut bad = walkers(0);
        bad[2].score = 2.0;
        let frame =
            Frame { timestamp_ns: Some(i64::MAX), embeddings: Some(Embeddings::new(&[0.0; 8], 2)), ..Frame::new(&bad) };
        assert!(offended.step(&frame).is_err());
        let mut fresh = tracker_of(algorithm, &[]);
        assert_eq!(ten_good_frames(&mut offended, &image, 0), ten_good_frames(&mut fresh, &image, 0));
    }

    /// By some they are tracked all the same; the others are tracked as ever.
    fn boxes_without_area_do_no_harm(algorithm: Algorithm) {
        let mut watched = Watched::new(algorithm);
        let mut owners = Vec::new();
        for t in 0..20 {
            let mut detections = walkers(t);
            add_boxes_without_area(&mut detections);
            watched.step(&Frame::new(&detections));
            owners.push(watched.tracker.output().track_of_detection[..4].to_vec());
        }
        assert!(owners[0].iter().all(|id| *id > 0), "{owners:?}");
        assert!(owners.iter().all(|o| *o == owners[0]), "{owners:?}");
    }

    fn boxes_of_every_magnitude_stay_finite(algorithm: Algorithm) {
        let image = texture();
        for with_image in [false, true] {
            let mut watched = Watched::new(algorithm);
            for t in 0..30 {
                let x = t as f64;
                let mut detections = Vec::new();
                for magnitude in [1e-300, 1e-9, 1e-3, 1.0, 1e6, 1e9, 1e12] {
                    for sign in [-1.0, 1.0] {
                        // One fixed in size, one as large as it is far away.
                        let place = sign * magnitude * (1.0 - 0.001 * x);
                        detections.push(Detection::new(place, -place, 40.0, 100.0, 0.9));
                        detections.push(Detection::new(place, place, magnitude, 0.5 * magnitude, 0.9));
                    }
                }
                // Thin as a hair, and jumping across the whole range.
                detections.push(Detection::new(100.0, 100.0, 1e-12, 1e12, 0.9));
                detections.push(Detection::new(if t % 2 == 0 { 1e12 } else { -1e12 }, 0.0, 1e12, 1e-12, 0.9));
                let image = with_image.then(|| view(&image, WIDTH, HEIGHT));
                watched.step(&Frame { image, ..Frame::new(&detections) });
            }
        }
    }

    /// Eleven neighbouring targets, each reported two or three times: ties wherever costs are compared.
    fn everything_may_be_reported_several_times(algorithm: Algorithm) {
        for copies in [2, 3] {
            let mut watched = Watched::new(algorithm);
            for t in 0..40 {
                let one = |i: usize| Detection::new(24.0 * (i / copies) as f64 + t as f64, 50.0, 40.0, 100.0, 0.9);
                let detections: Vec<Detection> = (0..11 * copies).map(one).collect();
                watched.step(&Frame::new(&detections));
            }
            // Only GenTrack2 has a rule against births on top of each other.
            let expected = if algorithm == Algorithm::GenTrack2 { 11 } else { 11 * copies };
            assert_eq!(watched.reported(), expected, "{copies} copies");
        }
    }

    fn thousands_on_one_spot_are_no_trouble(algorithm: Algorithm) {
        let mut watched = Watched::new(algorithm);
        let detections = vec![Detection::new(100.0, 100.0, 40.0, 80.0, 0.9); 3000];
        for _ in 0..3 {
            watched.step(&Frame::new(&detections));
        }
        let born = if algorithm == Algorithm::GenTrack2 { 1 } else { 3000 };
        assert!(watched.contract.live().len() + watched.contract.ended().len() >= born);
    }

    fn targets_that_shrink_to_nothing_end_and_their_fitness_stays_a_number(algorithm: Algorithm) {
        let mut watched = Watched::new(algorithm);
        for _ in 0..10 {
            watched.step(&Frame::new(&[Detection::new(100.0, 100.0, 40.0, 100.0, 0.9)]));
        }
        let shrink = CameraMotion([2e-3, 0.0, 0.0, 0.0, 2e-3, 0.0]);
        for frame in 0..150 {
            // GenTrack2 ends what has no size, the others what is not seen.
            let unseen = if frame < 100 { Frame::skipped() } else { Frame::new(&[]) };
            watched.step(&Frame { camera_motion: Some(shrink), ..unseen });
            if let Ok(particles) = watched.tracker.particles(1) {
                assert!(particles.iter().all(|p| (0.0..=1.0).contains(&p.fitness)), "frame {frame}: {particles:?}");
            }
            assert!(frame != 99 || algorithm != Algorithm::GenTrack2 || watched.contract.live().is_empty());
        }
        assert_eq!(watched.contract.ended().iter().copied().collect::<Vec<_>>(), [1]);
    }

    fn targets_at_a_billion_pixels_are_tracked_like_any_other(algorithm: Algorithm) {
        let mut watched = Watched::new(algorithm);
        for t in 0..30 {
            let x = 3.0 * t as f64;
            let detections =
                [Detection::new(1e9 + x, -1e9, 40.0, 100.0, 0.9), Detection::new(-1e9, 1e9 - x, 40.0, 100.0, 0.9)];
            watched.step(&Frame::new(&detections));
            // Some report nothing before three matches.
            assert!(watched.reported() == 2 || t < 3 && algorithm != Algorithm::GenTrack2, "frame {t}");
        }
        assert_eq!(watched.contract.live().iter().copied().collect::<Vec<_>>(), [1, 2]);
    }

    fn boxes_partly_or_wholly_outside_the_image_are_no_trouble(algorithm: Algorithm) {
        let image = texture();
        let mut watched = Watched::new(algorithm);
        for t in 0..40 {
            let x = 10.0 * t as f64;
            let detections = [
                // Passes through the image and out again on both sides.
                Detection::new(x - 60.0, 60.0, 30.0, 70.0, 0.9),
                // Larger than the image.
                Detection::new(-50.0, -50.0, 500.0, 400.0, 0.9),
                // Wholly outside, at each side.
                Detection::new(-200.0, 50.0, 30.0, 70.0, 0.9),
                Detection::new(400.0, 50.0, 30.0, 70.0, 0.9),
                Detection::new(100.0, -200.0, 30.0, 70.0, 0.9),
                Detection::new(100.0, 300.0, 30.0, 70.0, 0.9),
                // Touching a corner from outside, and a sliver inside.
                Detection::new(-30.0, -70.0, 30.0, 70.0, 0.9),
                Detection::new(319.9, 100.0, 30.0, 70.0, 0.9),
            ];
            watched.step(&Frame { image: Some(view(&image, WIDTH, HEIGHT)), ..Frame::new(&detections) });
        }
    }

    fn embeddings_of_length_zero_say_nothing(algorithm: Algorithm) {
        let zeros = [0f32; 32];
        let tiny = [f32::MIN_POSITIVE; 32];
        let large = [f32::MAX; 32];
        for data in [zeros, tiny, large] {
            let mut watched = Watched::new(algorithm);
            for t in 0..20 {
                watched.step(&Frame { embeddings: Some(Embeddings::new(&data, 8)), ..Frame::new(&walkers(t)) });
            }
            assert_eq!(watched.reported(), 4);
            assert_eq!(watched.contract.ended().len(), 0);
        }
    }

    fn wild_camera_motions_within_the_rules_stay_finite(algorithm: Algorithm) {
        let motions = [
            [1.0, 0.0, 1e9, 0.0, 1.0, -1e9],
            [1000.0, 0.0, 0.0, 0.0, 1000.0, 0.0],
            [0.001, 0.0, 0.0, 0.0, 0.1, 0.0],
            [-1.0, 0.0, 320.0, 0.0, -1.0, 240.0],
            [0.0, -1.0, 0.0, 1.0, 0.0, 0.0],
            [1.0, 0.0, 1e12, 0.0, 1.0, 1e12],
            // Sizes stay, while all but one direction grow without end.
            [0.7, 0.7, 0.0, 0.7, 0.71, 0.0],
        ];
        let image = texture();
        for repeated in motions {
            let mut watched = Watched::new(algorithm);
            for t in 0..40 {
                // Over and over, so that 1000^40 would leave the range of numbers were nothing done about it.
                let camera_motion = (t >= 5).then_some(CameraMotion(repeated));
                let image = Some(view(&image, WIDTH, HEIGHT));
                watched.step(&Frame { image, camera_motion, ..Frame::new(&[]) });
                watched.step(&Frame { camera_motion, ..Frame::new(&walkers(t % 20)) });
            }
            let mut unseen = Watched::new(algorithm);
            for t in 0..10 {
                unseen.step(&Frame::new(&walkers(t)));
            }
            for _ in 0..60 {
                unseen.step(&Frame { camera_motion: Some(CameraMotion(repeated)), ..Frame::skipped() });
            }
            for t in 0..10 {
                unseen.step(&Frame::new(&walkers(t)));
            }
        }
    }

    fn time_may_leap(algorithm: Algorithm) {
        const DAY: i64 = 86_400_000_000_000;
        for leap in [1, 1_000_000, DAY, 36_525 * DAY, i64::MAX - 10_000_000_000] {
            let mut watched = Watched::new(algorithm);
            let mut time = 0;
            for t in 0..20 {
                time += 33_333_333;
                watched.step(&Frame { timestamp_ns: Some(time), ..Frame::new(&walkers(t)) });
            }
            assert_eq!(watched.reported(), 4);
            time += leap;
            watched.step(&Frame { timestamp_ns: Some(time), ..Frame::new(&walkers(20)) });
            if leap >= DAY {
                // Who was there a day ago has ended by now, once, by the step after the leap or the one after that.
                time += 33_333_333;
                watched.step(&Frame { timestamp_ns: Some(time), ..Frame::new(&[]) });
            }
            // They start over; where they were before, nobody is reported for longer than predictions are.
            for t in 0..30 {
                time += 33_333_333;
                watched.step(&Frame { timestamp_ns: Some(time), ..Frame::new(&walkers(t)) });
            }
            assert_eq!(watched.reported(), 4, "after a leap of {leap} ns");
        }
        // The whole range at once.
        let mut watched = Watched::new(algorithm);
        for (t, time) in [i64::MIN, i64::MAX - 1, i64::MAX].into_iter().enumerate() {
            watched.step(&Frame { timestamp_ns: Some(time), ..Frame::new(&walkers(t)) });
        }
        // The clock stands at its end: a frame without a time is still welcome.
        watched.step(&Frame::new(&walkers(3)));
    }
}

/// Six of them, three on top of the first detection.
fn add_boxes_without_area(detections: &mut Vec<Detection>) {
    let r = detections[0].rect;
    for (width, height) in [(0.0, 0.0), (0.0, r.height), (r.width, 0.0)] {
        detections.push(Detection::new(r.left, r.top, width, height, 0.95));
        detections.push(Detection::new(150.0, 200.0, width, height, 0.95));
    }
}

#[test]
fn gentrack2_ignores_boxes_without_area() {
    let (mut with, mut without) = (tracker(1), tracker(1));
    for t in 0..20 {
        let plain = walkers(t);
        let mut detections = plain.clone();
        add_boxes_without_area(&mut detections);
        let mut got = with.step(&Frame::new(&detections)).unwrap().clone();
        assert_eq!(got.track_of_detection.split_off(4), [0; 6], "frame {t}");
        assert_eq!(exact(&got), exact(without.step(&Frame::new(&plain)).unwrap()), "frame {t}");
    }
    assert_eq!(with.output().reported.len(), 4);
}

/// The paper has no rule against births on top of each other.
#[test]
fn what_is_reported_several_times_is_several_tracks_of_the_paper() {
    for copies in [2, 3] {
        let mut watched = Watched::with(Algorithm::GenTrack2, &[("preset", "paper")]);
        for t in 0..40 {
            let one = |i: usize| Detection::new(24.0 * (i / copies) as f64 + t as f64, 50.0, 40.0, 100.0, 0.9);
            let detections: Vec<Detection> = (0..11 * copies).map(one).collect();
            watched.step(&Frame::new(&detections));
        }
        assert_eq!(watched.reported(), 11 * copies, "{copies} copies");
    }
    let mut watched = Watched::with(Algorithm::GenTrack2, &[("preset", "paper")]);
    for _ in 0..2 {
        watched.step(&Frame::new(&vec![Detection::new(100.0, 100.0, 40.0, 80.0, 0.9); 3000]));
    }
    assert!(watched.reported() >= 3000);
}

#[test]
fn images_without_texture_of_one_pixel_and_of_changing_size_are_no_trouble() {
    let (flat, textured) = ([128u8; (WIDTH * HEIGHT) as usize], texture());
    let images: [(&[u8], u32, u32); 6] = [
        (&flat, WIDTH, HEIGHT),
        (&textured, WIDTH, HEIGHT),
        (&textured, HEIGHT, WIDTH),
        (&textured, 1, 1),
        (&textured, WIDTH, 1),
        (&textured, 2, 200),
    ];
    // Each alone for long enough to learn from it, then all in turns.
    for (only, (data, width, height)) in images.into_iter().enumerate() {
        let mut watched = Watched::new(Algorithm::GenTrack2);
        for t in 0..20 {
            watched.step(&Frame { image: Some(view(data, width, height)), ..Frame::new(&walkers(t)) });
            if only < 2 {
                assert_eq!(watched.reported(), 4, "image {only}, frame {t}");
            }
        }
    }
    let mut watched = Watched::new(Algorithm::GenTrack2);
    for t in 0..60 {
        let (data, width, height) = images[(t * t + t / 7) % images.len()];
        let image = (t % 5 != 0).then(|| view(data, width, height));
        watched.step(&Frame { image, ..Frame::new(&walkers(t % 20)) });
    }
}

#[test]
fn a_flat_image_is_as_good_as_none() {
    let flat = [77u8; (WIDTH * HEIGHT) as usize];
    for t in [0, 10] {
        let mut watched = Watched::new(Algorithm::GenTrack2);
        for t in t..t + 15 {
            watched.step(&Frame { image: Some(view(&flat, WIDTH, HEIGHT)), ..Frame::new(&walkers(t)) });
        }
        assert_eq!(watched.reported(), 4);
        assert_eq!(watched.contract.live().len() + watched.contract.ended().len(), 4, "one identity each");
    }
}

/// A frame of anything, as owned data.
#[derive(Clone, Debug)]
struct AnyFrame {
    detections: Vec<Detection>,
    skipped: bool,
    image: Option<(u32, u32, u8)>,
    size: Option<(u32, u32)>,
    camera_motion: Option<[f64; 6]>,
    time_step: Option<i64>,
    embeddings: Option<(usize, Vec<f32>)>,
}

fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        8 => -100.0..400.0f64,
        2 => (-20i32..80).prop_map(|x| 5.0 * x as f64),
        1 => prop_oneof![Just(0.0), Just(-0.0), Just(1e9), Just(-1e9), Just(1e12), Just(5e-324)],
        1 => proptest::num::f64::ANY.prop_map(|x| if x.abs() <= 1e12 { x } else { 7.0 }),
    ]
}

fn side() -> impl Strategy<Value = f64> {
    prop_oneof![
        8 => 1.0..120.0f64,
        2 => Just(40.0),
        1 => prop_oneof![Just(0.0), Just(5e-324), Just(1e-9), Just(1e9), Just(1e12)],
    ]
}

fn detection() -> impl Strategy<Value = Detection> {
    let score = prop_oneof![4 => 0.5..1.0f64, 1 => 0.0..=1.0f64, 1 => prop_oneof![Just(0.0), Just(1.0)]];
    let class = prop_oneof![2 => 0..3i32, 1 => any::<i32>()];
    (coordinate(), coordinate(), side(), side(), score, class, any::<u64>()).prop_map(
        |(left, top, width, height, score, class_id, tag)| Detection {
            rect: Rect::new(left, top, width, height),
            score,
            class_id,
            tag,
        },
    )
}

/// One bad number now and then.
fn possibly_bad(detection: Detection, which: u8) -> Detection {
    let mut d = detection;
    match which {
        0 => d.rect.left = f64::NAN,
        1 => d.rect.width = -1.0,
        2 => d.score = 1.5,
        3 => d.rect.height = f64::INFINITY,
        _ => {}
    }
    d
}

fn any_frame() -> impl Strategy<Value = AnyFrame> {
    let detections = proptest::collection::vec((detection(), 0u8..=255).prop_map(|(d, w)| possibly_bad(d, w)), 0..12);
    let motion = prop_oneof![
        6 => (-0.1..0.1f64, -0.1..0.1f64, -30.0..30.0f64, -30.0..30.0f64).prop_map(|(a, b, x, y)| [1.0 + a, -b, x, b, 1.0 + a, y]),
        2 => proptest::array::uniform6(-2.0..2.0f64),
        1 => proptest::array::uniform6(proptest::num::f64::ANY),
    ];
    let step = prop_oneof![6 => 1i64..100_000_000, 1 => -10i64..10, 1 => 0i64..1 << 55];
    let embeddings = (prop_oneof![9 => Just(4usize), 1 => 0usize..6], proptest::collection::vec(-1.0..1.0f32, 60));
    (
        detections,
        proptest::bool::weighted(0.1),
        proptest::option::of((1u32..200, 1u32..200, any::<u8>())),
        proptest::option::of((0u32..400, 0u32..400)),
        proptest::option::weighted(0.3, motion),
        proptest::option::of(step),
        proptest::option::weighted(0.3, embeddings),
    )
        .prop_map(|(detections, skipped, image, size, camera_motion, time_step, embeddings)| AnyFrame {
            detections: if skipped { Vec::new() } else { detections },
            skipped,
            image,
            // Image and size must agree; that they are refused otherwise has a test of its own.
            size: size.filter(|_| image.is_none()),
            camera_motion,
            time_step,
            embeddings,
        })
}

/// An image from one byte: flat, a ramp or a pattern.
fn pixels(width: u32, height: u32, kind: u8) -> Vec<u8> {
    let mut noise = Noise::new(kind as u64, 0);
    (0..width * height)
        .map(|i| match kind % 3 {
            0 => kind,
            1 => (i % width) as u8,
            _ => noise.below(256) as u8,
        })
        .collect()
}

/// Plays the frames to a tracker that is held to the contract.
fn refused_without_trace_or_handled(watched: &mut Watched, frames: &[AnyFrame]) -> Result<(), TestCaseError> {
    let mut clock = 0i64;
    for frame in frames {
        let image = frame.image.map(|(width, height, kind)| (pixels(width, height, kind), width, height));
        let now = frame.time_step.map(|step| clock.saturating_add(step));
        let input = Frame {
            detections: &frame.detections,
            detector_skipped: frame.skipped,
            embeddings: frame.embeddings.as_ref().map(|(dimension, data)| Embeddings::new(data, *dimension)),
            image: image.as_ref().map(|(data, width, height)| view(data, *width, *height)),
            size: frame.size,
            camera_motion: frame.camera_motion.map(CameraMotion),
            timestamp_ns: now,
        };
        let before = exact(watched.tracker.output());
        match watched.tracker.step(&input).map(|_| ()) {
            Ok(()) => {
                clock = now.unwrap_or(clock);
                watched.contract.check(&frame.detections, watched.tracker.output());
            }
            Err(_) => prop_assert_eq!(exact(watched.tracker.output()), before),
        }
    }
    Ok(())
}

/// A configuration with some parameters at an end of their range; `None` if they do not go together.
fn extreme(algorithm: Algorithm, choices: &[u8]) -> Option<Tracker> {
    let mut config = Config::of(algorithm);
    for (spec, choice) in Config::of(algorithm).specs().zip(choices.iter().cycle()) {
        let value = match (spec.kind, choice) {
            // Ten million particles are just slow.
            _ if spec.key == "particles" => continue,
            (Kind::Float, 0) => Value::Float(spec.minimum),
            (Kind::Float, 1) => Value::Float(spec.maximum),
            (Kind::Integer, 0) => Value::Integer(spec.minimum as i64),
            (Kind::Integer, 1) => Value::Integer(spec.maximum as i64),
            (Kind::Boolean, 0..=2) => Value::Boolean(spec.default != Value::Boolean(true)),
            (Kind::Choice(names), 0..=3) => Value::Choice(names[*choice as usize % names.len()]),
            _ => continue,
        };
        config.set(spec.key, &value).unwrap();
    }
    Tracker::new(&config).ok()
}

for_every_algorithm! {
    fn any_sequence_of_frames_is_refused_without_trace_or_handled(algorithm: Algorithm) {
        let frames = proptest::collection::vec(any_frame(), 1..25);
        let class_policy = proptest::sample::select(&CLASS_POLICIES);
        let mut runner = TestRunner::new(ProptestConfig::with_cases(192));
        let outcome = runner.run(&(frames, any::<u32>(), class_policy), |(frames, seed, class_policy)| {
            let (seed, class_policy) = (("seed", &*seed.to_string()), ("class_policy", class_policy));
            let mut watched = Watched::with(algorithm, &[seed, class_policy, ("use_camera_motion", "true")]);
            refused_without_trace_or_handled(&mut watched, &frames)
        });
        outcome.unwrap_or_else(|error| panic!("{error}"));
    }

    fn whatever_the_parameters(algorithm: Algorithm) {
        let frames = proptest::collection::vec(any_frame(), 1..25);
        let choices = proptest::collection::vec(0u8..10, 64);
        let mut runner = TestRunner::new(ProptestConfig::with_cases(96));
        let outcome = runner.run(&(frames, choices), |(frames, choices)| {
            let Some(tracker) = extreme(algorithm, &choices) else { return Ok(()) };
            let mut watched = Watched { tracker, contract: Contract::of(algorithm) };
            refused_without_trace_or_handled(&mut watched, &frames)
        });
        outcome.unwrap_or_else(|error| panic!("{error}"));
    }
}
