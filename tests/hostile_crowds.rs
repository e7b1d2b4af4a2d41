//! Twenty thousand detections in a frame, in whatever arrangement: handled, and forgotten as they should be.

mod simulator;

use std::time::{Duration, Instant};

use gentrack2::{Algorithm, Detection, Frame};
use simulator::noise::Noise;
use simulator::watched::Watched;

// How long it takes is printed and not judged, for machines are busy.
const COUNT: usize = 20_000;

fn three_frames(mut watched: Watched, detections: impl Fn(usize) -> Vec<Detection>) -> Watched {
    let mut took = Duration::ZERO;
    for t in 0..3 {
        let detections = detections(t);
        assert_eq!(detections.len(), COUNT);
        let start = Instant::now();
        watched.tracker.step(&Frame { size: Some((3840, 2160)), ..Frame::new(&detections) }).unwrap();
        took += start.elapsed();
        watched.contract.check(&detections, watched.tracker.output());
    }
    println!("{:?}: {took:?}, {} tracks", watched.tracker, watched.listed());
    watched
}

fn random(t: usize) -> Vec<Detection> {
    let mut noise = Noise::new(t as u64, 0);
    let mut random = || {
        let (left, top) = (noise.between(-50.0, 3840.0), noise.between(-50.0, 2160.0));
        Detection::new(left, top, noise.between(5.0, 80.0), noise.between(5.0, 160.0), noise.unit())
    };
    (0..COUNT).map(|_| random()).collect()
}

/// 200 x 100 boxes of 19 x 21, each touching its neighbours.
fn grid() -> Vec<Detection> {
    let one = |i: usize| Detection::new((i % 200) as f64 * 19.0, (i / 200) as f64 * 21.0, 19.0, 21.0, 0.9);
    (0..COUNT).map(one).collect()
}

fn with_classes(mut detections: Vec<Detection>, classes: usize) -> Vec<Detection> {
    detections.iter_mut().enumerate().for_each(|(i, d)| d.class_id = (i % classes) as i32 - 3);
    detections
}

/// OC-SORT's other measures look at all pairs, unless there are too many, as with the second number of detections.
#[test]
fn by_every_measure_of_ocsort() {
    for measure in ["giou", "diou", "ciou", "centre_distance"] {
        for count in [3000, COUNT] {
            let settings = [("asso_func", measure), ("use_byte", "true"), ("iou_threshold", "0.9")];
            let mut watched = Watched::with(Algorithm::OcSort, &settings);
            let start = Instant::now();
            for t in 0..3 {
                watched.step(&Frame::new(&random(t)[..count]));
            }
            let took = start.elapsed();
            println!("{measure}, {count}: {took:?}, {} tracks", watched.listed());
        }
    }
}

for_every_algorithm! {
    fn at_random(algorithm: Algorithm) {
        three_frames(Watched::new(algorithm), random);
    }

    fn all_the_same(algorithm: Algorithm) {
        let all_the_same = |_| vec![Detection::new(500.0, 500.0, 40.0, 100.0, 0.9); COUNT];
        let watched = three_frames(Watched::new(algorithm), all_the_same);
        assert!(watched.reported() >= 1);
    }

    fn nearly_the_same(algorithm: Algorithm) {
        three_frames(Watched::new(algorithm), |t| {
            let mut noise = Noise::new(t as u64, 0);
            let mut random = || {
                let (left, top) = (noise.between(500.0, 510.0), noise.between(500.0, 510.0));
                Detection::new(left, top, 40.0, 100.0, noise.between(0.5, 1.0))
            };
            (0..COUNT).map(|_| random()).collect()
        });
    }

    /// More of their widths or heights lie between two of them than an integer counts.
    fn of_slivers_far_apart(algorithm: Algorithm) {
        for (width, height) in [(1e-30, 10.0), (10.0, 1e-30), (1e-30, 1e-30), (1e-160, 10.0)] {
            let sliver = |i: usize| Detection::new(4e7 * i as f64, 4e7 * (i % 150) as f64, width, height, 0.9);
            three_frames(Watched::new(algorithm), |_| (0..COUNT).map(sliver).collect());
        }
    }

    fn on_a_dense_grid_then_none(algorithm: Algorithm) {
        let mut watched = three_frames(Watched::new(algorithm), |_| grid());
        assert_eq!(watched.reported(), COUNT);
        assert_eq!(watched.contract.ended().len(), 0);
        for _ in 0..3 {
            watched.step(&Frame::new(&[]));
        }
    }

    fn of_few_classes(algorithm: Algorithm) {
        for class_policy in ["same_class", "separate"] {
            let watched = || Watched::with(algorithm, &[("class_policy", class_policy)]);
            three_frames(watched(), |t| with_classes(random(t), 7));
            let watched = three_frames(watched(), |_| with_classes(grid(), 7));
            assert_eq!(watched.reported(), COUNT, "{class_policy}");
        }
    }

    fn each_of_its_own_class(algorithm: Algorithm) {
        for class_policy in ["same_class", "separate"] {
            let watched = || Watched::with(algorithm, &[("class_policy", class_policy)]);
            three_frames(watched(), |t| with_classes(random(t), COUNT));
            let watched = three_frames(watched(), |_| with_classes(grid(), COUNT));
            assert_eq!(watched.reported(), COUNT, "{class_policy}");
        }
    }

    /// No class is ever seen again: what is remembered of one must not stay.
    fn of_ever_new_classes(algorithm: Algorithm) {
        three_frames(Watched::with(algorithm, &[("class_policy", "separate")]), |t| {
            let mut detections = grid();
            detections.iter_mut().zip(0..).for_each(|(d, i)| d.class_id = i + (t * COUNT) as i32);
            detections
        });
    }
}
