//! What happens exactly at the thresholds of the compared trackers, and other small print of their specifications, in
//! hand-made scenes in which everybody stands still. A filter at rest that takes a detection in its place, or none,
//! stays at rest to the last bit, so that what is exact in the boxes is exact in the costs.

use gentrack2::{Config, Detection, Embeddings, Frame, Output, Rect, Track, TrackState, Tracker};

fn tracker(algorithm: &str, settings: &[(&str, &str)]) -> Tracker {
    let mut config = Config::new(algorithm).unwrap();
    for (key, value) in settings {
        config.set_text(key, value).unwrap();
    }
    Tracker::new(&config).unwrap()
}

fn step(tracker: &mut Tracker, detections: &[Detection]) -> Output {
    tracker.step(&Frame::new(detections)).unwrap().clone()
}

/// A step with an embedding per detection.
fn look<const N: usize>(tracker: &mut Tracker, detections: &[Detection], rows: &[[f32; N]]) -> Output {
    let frame = Frame { embeddings: Some(Embeddings::new(rows.as_flattened(), N)), ..Frame::new(detections) };
    tracker.step(&frame).unwrap().clone()
}

/// The identity that takes the only detection of a frame.
fn taker(tracker: &mut Tracker, detection: Detection) -> u64 {
    step(tracker, &[detection]).track_of_detection[0]
}

fn ids(tracks: &[Track]) -> Vec<u64> {
    tracks.iter().map(|t| t.id).collect()
}

/// A square whose pixels, first and last included, are 112 in a row. Two that are 16 apart have 96 columns of 128 in
/// common: with sides counted in pixels their IoU is 3/4, a number without rounding.
fn square(left: f64, score: f64) -> Detection {
    Detection::new(left, 0.0, 111.0, 111.0, score)
}

/// Directions with an angle of 90 degrees between the first two, and of 60 degrees, cosine 1/2, between the third and
/// either: lengths 1, 1 and 2, so that there is no rounding.
const ONE: [f32; 4] = [1.0, 0.0, 0.0, 0.0];
const OTHER: [f32; 4] = [0.0, 1.0, 0.0, 0.0];
const HALF_WAY: [f32; 4] = [1.0, 1.0, 1.0, 1.0];

mod deepsort {
    use super::*;

    /// Tracks of these detections, numbered from 1, confirmed and then missed for one frame: in the next one they are
    /// sought for the second time, by their looks only.
    fn missed<const N: usize>(settings: &[(&str, &str)], detections: &[Detection], rows: &[[f32; N]]) -> Tracker {
        let mut tracker = tracker("deepsort", settings);
        for _ in 0..3 {
            look(&mut tracker, detections, rows);
        }
        assert_eq!(ids(&tracker.output().reported).len(), detections.len());
        step(&mut tracker, &[]);
        tracker
    }

    #[test]
    fn a_cosine_distance_of_exactly_the_threshold_is_a_match() {
        // 1 - cosine = 1/2.
        let seen = [square(0.0, 0.9)];
        for (threshold, expected) in [("0.5", 1), ("0.4999", 2)] {
            let mut tracker = missed(&[("max_cosine_distance", threshold)], &seen, &[ONE]);
            let output = look(&mut tracker, &seen, &[HALF_WAY]);
            assert_eq!(output.track_of_detection, [expected], "{threshold}");
        }
    }

    /// The example of the specification's section 6 in numbers that tell 0.00001 from 0.01.
    #[test]
    fn a_pair_out_of_bounds_costs_a_hundred_thousandth_more_than_the_bound() {
        // Track 1 looks in the direction of 51 degrees, track 2 in that of 0; the detections in those of 30 and 81.
        // Costs 1 - cos: of track 1, with the first .0664 (21 degrees) and with the second .1340 (30); of track 2,
        // with the first .1340 and with the second, 81 degrees, more than the bound, hence .20001.
        // .0664 + .20001 = .2664 < .1340 + .1340 = .2679: track 1 takes the first one, and track 2 nothing. At .21 for
        // a pair out of bounds, .2764, both would take what looks 30 degrees different.
        let at = |degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            [cos as f32, sin as f32]
        };
        let seen = [Detection::new(0.0, 0.0, 50.0, 100.0, 0.9), Detection::new(4.0, 0.0, 50.0, 100.0, 0.9)];
        let mut tracker = missed(&[("max_cosine_distance", "0.2")], &seen, &[at(51.0), at(0.0)]);
        let output = look(&mut tracker, &seen, &[at(30.0), at(81.0)]);
        assert_eq!(output.track_of_detection, [1, 3]);
        assert_eq!(ids(&output.lost), [2]);
    }

    #[test]
    fn an_iou_distance_of_exactly_the_threshold_is_a_match() {
        // 48 px wide and 16 px apart: 32 px of 64 in common.
        let seen = |left: f64| Detection::new(left, 0.0, 48.0, 96.0, 0.9);
        for (threshold, expected) in [("0.5", 1), ("0.4999", 2)] {
            let mut tracker = tracker("deepsort", &[("max_iou_distance", threshold)]);
            step(&mut tracker, &[seen(0.0)]);
            assert_eq!(taker(&mut tracker, seen(16.0)), expected, "{threshold}");
        }
    }
}

mod two_round {
    use super::*;

    /// A lost track, 1, and a new one, 2, so far to the right of it, which a low limit keeps from being one.
    fn beside_a_lost_one(distance: f64, settings: &[(&str, &str)]) -> Output {
        let mut tracker = tracker("bytetrack", settings);
        step(&mut tracker, &[square(0.0, 0.9)]);
        assert_eq!(ids(&step(&mut tracker, &[]).lost), [1]);
        step(&mut tracker, &[square(distance, 0.9)])
    }

    #[test]
    fn at_an_iou_distance_of_exactly_the_threshold_there_are_two_objects() {
        // 1 - IoU = 1/4. It would match at a cost of 1 - .75 x .9 = .325, which is above the limit.
        let output = beside_a_lost_one(16.0, &[("match_thresh", "0.3"), ("duplicate_thresh", "0.25")]);
        assert_eq!((ids(&output.tentative), ids(&output.lost)), (vec![2], vec![1]));
        let output = beside_a_lost_one(16.0, &[("match_thresh", "0.3"), ("duplicate_thresh", "0.2501")]);
        assert_eq!((ids(&output.tentative), ids(&output.lost)), (vec![], vec![1]));
    }

    #[test]
    fn of_two_duplicates_of_equal_life_spans_the_tracked_one_goes() {
        // Both were seen once: life spans 0. In the same place a match would cost 1 - .9 = .1.
        let output = beside_a_lost_one(0.0, &[("match_thresh", "0.05")]);
        assert_eq!((ids(&output.tentative), ids(&output.lost)), (vec![], vec![1]));
        // It had not been heard of.
        assert_eq!((output.ended, output.track_of_detection), (vec![], vec![0]));
    }

    #[test]
    fn of_two_duplicates_the_one_with_the_longer_life_span_stays() {
        // Two in nearly the same place, 1 - IoU = 8/116; the second is seen once, a life span of 0, the first twice.
        let mut tracker = tracker("bytetrack", &[]);
        assert_eq!(ids(&step(&mut tracker, &[square(0.0, 0.9), square(4.0, 0.9)]).reported), [1, 2]);
        let output = step(&mut tracker, &[square(0.0, 0.9)]);
        assert_eq!((ids(&output.reported), output.ended), (vec![1], vec![2]));
    }

    #[test]
    fn scores_of_exactly_the_thresholds_are_neither_low_nor_high() {
        for algorithm in ["bytetrack", "botsort", "smiletrack"] {
            for (score, expected) in [(0.1, 0), (0.11, 1), (0.59, 1), (0.6, 0), (0.61, 1)] {
                let mut tracker = tracker(algorithm, &[]);
                step(&mut tracker, &[square(0.0, 0.9)]);
                assert_eq!(taker(&mut tracker, square(0.0, score)), expected, "{algorithm}: {score}");
            }
        }
    }

    #[test]
    fn a_score_of_exactly_the_threshold_starts_a_track() {
        for (score, expected) in [(0.7, 1), (0.69, 0)] {
            assert_eq!(taker(&mut tracker("bytetrack", &[]), square(0.0, score)), expected, "{score}");
        }
    }

    /// A track that looks like `ONE`, and who takes a detection 16 px beside it: by motion, at a cost of
    /// 1 - .75 x .8 = .4, not the track.
    fn taker_beside(settings: &[(&str, &str)], looks: [f32; 4]) -> u64 {
        let mut tracker = tracker("botsort", &[&[("match_thresh", "0.3")], settings].concat());
        look(&mut tracker, &[square(0.0, 0.9)], &[ONE]);
        look(&mut tracker, &[square(16.0, 0.8)], &[looks]).track_of_detection[0]
    }

    #[test]
    fn looks_of_exactly_the_appearance_threshold_count() {
        // Half of 1 - cosine = 1/2, which is the cost.
        assert_eq!(taker_beside(&[("appearance_thresh", "0.25")], HALF_WAY), 1);
        assert_eq!(taker_beside(&[("appearance_thresh", "0.2499")], HALF_WAY), 2);
    }

    #[test]
    fn looks_count_up_to_exactly_the_proximity_threshold() {
        // 1 - IoU = 1/4, without the score.
        assert_eq!(taker_beside(&[("proximity_thresh", "0.25")], ONE), 1);
        assert_eq!(taker_beside(&[("proximity_thresh", "0.2499")], ONE), 2);
    }

    #[test]
    fn a_match_with_a_low_score_leaves_the_embedding_as_it_was() {
        // A track that learns takes over all of what it sees. The last detection has the looks of the first; compared
        // with those of the second, half of 1 - cosine = 1/2 would be too much to count.
        let settings = [("match_thresh", "0.3"), ("feature_momentum", "0")];
        for (score, expected) in [(0.3, 1), (0.9, 2)] {
            let mut tracker = tracker("botsort", &settings);
            look(&mut tracker, &[square(0.0, 0.9)], &[ONE]);
            assert_eq!(look(&mut tracker, &[square(0.0, score)], &[OTHER]).track_of_detection, [1]);
            let output = look(&mut tracker, &[square(16.0, 0.8)], &[ONE]);
            assert_eq!(output.track_of_detection, [expected], "{score}");
        }
    }
}

mod conftrack {
    use super::*;

    #[test]
    fn a_pair_at_exactly_the_proximity_threshold_is_possible() {
        // 1 - IoU = 1/4; the cost of 1 - .75 x .9 = .325 is well below the limit of .8.
        for (threshold, expected) in [("0.25", 1), ("0.2499", 2)] {
            let mut tracker = tracker("conftrack", &[("proximity_thresh", threshold)]);
            step(&mut tracker, &[square(0.0, 0.9)]);
            assert_eq!(taker(&mut tracker, square(16.0, 0.9)), expected, "{threshold}");
        }
    }

    #[test]
    fn looks_of_exactly_the_appearance_threshold_count() {
        // 37 px apart 75 columns of 149 are in common: motion costs 1 - .503 x .8 = .6, which is too much. Half of
        // 1 - cosine = 1/2 costs 1 - .75 x .8 = .4.
        for (threshold, expected) in [("0.25", 1), ("0.2499", 2)] {
            let mut tracker = tracker("conftrack", &[("match_thresh", "0.5"), ("appearance_thresh", threshold)]);
            look(&mut tracker, &[square(0.0, 0.9)], &[ONE]);
            let output = look(&mut tracker, &[square(37.0, 0.8)], &[HALF_WAY]);
            assert_eq!(output.track_of_detection, [expected], "{threshold}");
        }
    }

    #[test]
    fn sides_below_a_pixel_count_as_one() {
        for (size, expected) in [((0.5, 40.0), (1.0, 40.0)), ((40.0, 0.5), (40.0, 1.0)), ((0.5, 0.25), (1.0, 1.0))] {
            let mut tracker = tracker("conftrack", &[]);
            let output = step(&mut tracker, &[Detection::new(10.0, 20.0, size.0, size.1, 0.9)]);
            assert_eq!(output.reported[0].rect, Rect::new(10.0, 20.0, expected.0, expected.1), "{size:?}");
        }
    }

    #[test]
    fn a_score_of_exactly_the_low_threshold_is_used() {
        // As published it is the score from which tracks start, too.
        for (score, expected) in [(0.1, 1), (0.0999, 0)] {
            assert_eq!(taker(&mut tracker("conftrack", &[]), square(0.0, score)), expected, "{score}");
        }
        // A track that is confirmed takes it, although it starts none.
        let settings = [("new_track_thresh", "0.7")];
        for (score, expected) in [(0.1, 1), (0.0999, 0)] {
            let mut tracker = tracker("conftrack", &settings);
            step(&mut tracker, &[square(0.0, 0.9)]);
            step(&mut tracker, &[square(0.0, 0.9)]);
            assert_eq!(taker(&mut tracker, square(0.0, score)), expected, "{score}");
        }
    }

    #[test]
    fn a_score_of_exactly_the_high_threshold_is_high() {
        // A tentative track is offered high scores only.
        for (score, expected) in [(0.6, 1), (0.59, 2)] {
            let mut tracker = tracker("conftrack", &[]);
            step(&mut tracker, &[square(0.0, 0.9)]);
            assert_eq!(taker(&mut tracker, square(0.0, score)), expected, "{score}");
        }
    }

    #[test]
    fn a_score_of_exactly_the_confirmation_threshold_confirms() {
        for (score, expected) in [(0.7, TrackState::Confirmed), (0.69, TrackState::Tentative)] {
            let mut tracker = tracker("conftrack", &[]);
            step(&mut tracker, &[square(0.0, 0.9)]);
            let output = step(&mut tracker, &[square(0.0, score)]);
            let track = output.reported.first().or(output.tentative.first()).unwrap();
            assert_eq!((track.id, track.state), (1, expected), "{score}");
        }
        // One born with it is trusted like a confirmed one: 16 px are too far, 1 - IoU = .25, for the doubtful ones.
        for (score, expected) in [(0.7, 1), (0.69, 2)] {
            let mut tracker = tracker("conftrack", &[("low_confidence_thresh", "0.2")]);
            step(&mut tracker, &[square(0.0, score)]);
            assert_eq!(taker(&mut tracker, square(16.0, 0.9)), expected, "{score}");
        }
    }

    #[test]
    fn the_first_frame_reports_high_scores_and_later_ones_no_newborn() {
        let seen = [square(0.0, 0.6), square(200.0, 0.59), square(400.0, 0.9)];
        let mut tracker = tracker("conftrack", &[]);
        let output = step(&mut tracker, &seen);
        assert_eq!((ids(&output.reported), ids(&output.tentative)), (vec![1, 3], vec![2]));
        tracker.reset();
        step(&mut tracker, &[]);
        let output = step(&mut tracker, &seen);
        assert_eq!((output.reported.len(), output.tentative.len()), (0, 3));
    }

    /// Whether a track of this size outlives a miss; while it is seen it does.
    fn outlives_a_miss(width: f64, height: f64) -> bool {
        let mut tracker = tracker("conftrack", &[]);
        for frame in 0..4 {
            let output = step(&mut tracker, &[Detection::new(0.0, 0.0, width, height, 0.9)]);
            assert_eq!((ids(&output.reported), output.ended), (vec![1], vec![]), "{width} x {height}: frame {frame}");
        }
        let output = step(&mut tracker, &[]);
        assert_eq!(output.lost.len() + output.ended.len(), 1, "{output:?}");
        output.ended.is_empty()
    }

    #[test]
    fn a_track_wider_than_the_largest_aspect_ends_with_a_miss() {
        assert!(outlives_a_miss(160.0, 100.0));
        assert!(!outlives_a_miss(161.0, 100.0));
    }

    #[test]
    fn a_track_smaller_than_the_smallest_area_ends_with_a_miss() {
        assert!(outlives_a_miss(10.0, 10.0));
        // 99 square pixels.
        assert!(!outlives_a_miss(9.0, 11.0));
    }

    #[test]
    fn a_match_with_a_low_score_leaves_the_embedding_as_it_was() {
        // As with BoT-SORT: motion costs 1 - .75 x .8 = .4, the looks of the first frames 1 - .8 = .2.
        let settings = [("match_thresh", "0.3"), ("feature_momentum", "0")];
        for (score, expected) in [(0.3, 1), (0.9, 2)] {
            let mut tracker = tracker("conftrack", &settings);
            look(&mut tracker, &[square(0.0, 0.9)], &[ONE]);
            look(&mut tracker, &[square(0.0, 0.9)], &[ONE]);
            assert_eq!(look(&mut tracker, &[square(0.0, score)], &[OTHER]).track_of_detection, [1]);
            let output = look(&mut tracker, &[square(16.0, 0.8)], &[ONE]);
            assert_eq!(output.track_of_detection, [expected], "{score}");
        }
    }
}

mod ocsort {
    use super::*;

    #[test]
    fn scores_of_exactly_the_thresholds_are_neither_low_nor_high() {
        for (score, expected) in [(0.1, 0), (0.11, 1), (0.59, 1), (0.6, 0), (0.61, 1)] {
            let mut tracker = tracker("ocsort", &[("use_byte", "true")]);
            step(&mut tracker, &[square(0.0, 0.9)]);
            assert_eq!(taker(&mut tracker, square(0.0, score)), expected, "{score}");
        }
        // Nor do they start tracks.
        assert_eq!(taker(&mut tracker("ocsort", &[("use_byte", "true")]), square(0.0, 0.6)), 0);
    }
}
