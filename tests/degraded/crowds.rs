//! Far too many detections, in one place or everywhere.

use gentrack2::{Algorithm, Detection, Frame};

use crate::for_every_algorithm;
use crate::lanes::{SEEDS, lanes, patient};
use crate::simulator::contract::all_tracks;
use crate::simulator::watched::Watched;
use crate::stream::{Given, demand_identities, frames, identities};

/// Frames with a pile.
const PILED: std::ops::Range<usize> = 60..70;
const PILE: usize = 300;

/// For a third of a second the detector puts 300 boxes where nobody is.
fn piled(stream: Vec<Given>) -> Vec<Given> {
    let mut stream = stream;
    for given in stream.iter_mut().filter(|given| PILED.contains(&given.seen.frame)) {
        let boxes = std::iter::repeat_n(Detection::new(350.0, -400.0, 40.0, 95.0, 0.9), PILE);
        given.seen.detections.extend(boxes);
        given.seen.source.resize(given.seen.detections.len(), None);
    }
    stream
}

/// Instead of people, the detector puts all boxes in one place.
fn collapsed(stream: Vec<Given>) -> Vec<Given> {
    let mut stream = stream;
    for given in stream.iter_mut().filter(|given| PILED.contains(&given.seen.frame)) {
        given.seen.detections.iter_mut().for_each(|d| *d = Detection::new(350.0, -400.0, 40.0, 95.0, 0.9));
        given.seen.source.fill(None);
    }
    stream
}

/// So many people, to a row, in pixels from one to the next.
const COUNT: usize = 5000;
const COLUMNS: usize = 100;
const STEP: (f64, f64) = (25.0, 45.0);

/// A crowd of 5000 that walks by, two pixels a frame, nobody on top of another.
fn crowd(t: usize) -> Vec<Detection> {
    let one = |i: usize| {
        let (x, y) = ((i % COLUMNS) as f64, (i / COLUMNS) as f64);
        Detection { tag: i as u64, ..Detection::new(x * STEP.0 + 2.0 * t as f64, y * STEP.1, 20.0, 40.0, 0.9) }
    };
    (0..COUNT).map(one).collect()
}

for_every_algorithm! {
    /// A pile is shown for what it is while it lasts, which the judge of clutter would not like; people are the same.
    fn a_pile_elsewhere_costs_no_identity(algorithm: Algorithm) {
        for seed in SEEDS {
            let scene = lanes(seed);
            let stream = piled(frames(&scene, false));
            let mut tracker = patient(algorithm, &[]);
            let ids = identities(&mut tracker, &scene, &stream[..PILED.end + 45]);
            // A second and a half later nothing is left of it.
            assert_eq!(all_tracks(tracker.output()).count(), scene.objects.len(), "seed {seed}");
            let later = identities(&mut tracker, &scene, &stream[PILED.end + 45..]);
            assert!(ids.iter().all(|ids| ids.len() == 1) && later == ids, "seed {seed}: {ids:?}, {later:?}");
        }
    }

    fn when_all_detections_are_in_one_place_for_a_moment_identities_come_back(algorithm: Algorithm) {
        for seed in SEEDS {
            let scene = lanes(seed);
            let stream = collapsed(frames(&scene, false));
            let ids = identities(&mut patient(algorithm, &[]), &scene, &stream);
            assert!(ids.iter().all(|ids| ids.len() == 1), "seed {seed}: {ids:?}");
        }
    }

    fn five_thousand_keep_their_identities(algorithm: Algorithm) {
        let mut watched = Watched::new(algorithm);
        let mut owners = Vec::new();
        for t in 0..12 {
            let detections = crowd(t);
            watched.step(&Frame { size: Some((2600, 2300)), ..Frame::new(&detections) });
            if t == 0 {
                owners.clone_from(&watched.tracker.output().track_of_detection);
                assert!(owners.iter().all(|id| *id > 0));
            }
            assert!(watched.tracker.output().track_of_detection == owners, "frame {t}");
        }
        assert_eq!(watched.reported(), COUNT);
    }
}

#[test]
fn a_pile_is_one_to_gentrack2() {
    let stream = piled(frames(&lanes(0), false));
    let mut tracker = patient(Algorithm::GenTrack2, &[]);
    for given in &stream[..PILED.end] {
        tracker.step(&given.frame()).unwrap();
        let listed = all_tracks(tracker.output()).count();
        assert!(listed <= 11, "frame {}: {listed} tracks", given.seen.frame);
    }
    demand_identities(Algorithm::GenTrack2, || patient(Algorithm::GenTrack2, &[]), SEEDS, lanes, |s| frames(s, false));
}
