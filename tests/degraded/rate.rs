//! Fewer frames than the camera takes, frames given twice, and a detector that does not run on all of them.

use gentrack2::{Algorithm, Tracker};

use crate::for_every_algorithm;
use crate::lanes::{SEEDS, lanes, patient};
use crate::simulator::noise::Noise;
use crate::simulator::scene::Scene;
use crate::simulator::stage;
use crate::stream::{Given, demand_identities, frames, identities, play, timed};

/// One frame in so many has detections.
const EVERY: [usize; 3] = [2, 3, 5];

/// A fifth of the frames is lost, up to five in a row.
fn dropped(stream: Vec<Given>) -> Vec<Given> {
    let mut noise = Noise::new(stream.len() as u64, 22);
    let mut left_out = 0;
    let mut drops = |given: &Given| {
        if left_out == 0 && given.seen.frame > 10 && noise.chance(0.08) {
            left_out = 1 + noise.below(5);
        }
        let drop = left_out > 0;
        left_out -= usize::from(drop);
        !drop
    };
    stream.into_iter().filter(|given| drops(given)).collect()
}

/// Every third frame comes twice, the second time half a frame interval later.
fn doubled(stream: Vec<Given>) -> Vec<Given> {
    let again = |given: &Given| Given { time: given.time.map(|t| t + 1.0 / 60.0), ..given.clone() };
    let copies = |given: Given| match given.seen.frame % 3 {
        2 => vec![again(&given), given].into_iter().rev().collect(),
        _ => vec![given],
    };
    stream.into_iter().flat_map(copies).collect()
}

/// Only the frames on which the detector runs are given.
fn thinned(stream: Vec<Given>, every: usize) -> Vec<Given> {
    stream.into_iter().filter(|given| given.seen.frame.is_multiple_of(every)).collect()
}

/// All frames are given; on most the detector rests.
fn resting(stream: Vec<Given>, every: usize) -> Vec<Given> {
    let rest = |given: Given| Given { rests: !given.seen.frame.is_multiple_of(every), ..given };
    stream.into_iter().map(rest).collect()
}

/// All frames are given; on most the detector is said to have found nothing.
fn blinded(stream: Vec<Given>, every: usize) -> Vec<Given> {
    let mut stream = stream;
    for given in stream.iter_mut().filter(|given| !given.seen.frame.is_multiple_of(every)) {
        given.seen.detections.clear();
        given.seen.source.clear();
    }
    stream
}

fn demand(algorithm: Algorithm, stream: impl Fn(&Scene) -> Vec<Given>) {
    demand_identities(algorithm, || patient(algorithm, &[]), SEEDS, lanes, stream);
}

for_every_algorithm! {
    fn at_full_rate_identities_last(algorithm: Algorithm) {
        demand(algorithm, |scene| frames(scene, false));
        demand(algorithm, |scene| timed(scene, false));
    }

    fn dropped_frames_cost_no_identity(algorithm: Algorithm) {
        let kept = dropped(frames(&lanes(0), false)).len();
        assert!((105..135).contains(&kept), "{kept} of 150 frames are left");
        demand(algorithm, |scene| dropped(timed(scene, false)));
        demand(algorithm, |scene| dropped(frames(scene, false)));
    }

    fn frames_given_twice_cost_no_identity(algorithm: Algorithm) {
        demand(algorithm, |scene| doubled(timed(scene, false)));
        demand(algorithm, |scene| doubled(frames(scene, false)));
    }

    fn identities_last_with_timestamps_when_only_detected_frames_are_given(algorithm: Algorithm) {
        EVERY.into_iter().for_each(|every| demand(algorithm, |scene| thinned(timed(scene, false), every)));
    }

    fn identities_last_without_being_told_when_only_detected_frames_are_given(algorithm: Algorithm) {
        EVERY.into_iter().for_each(|every| demand(algorithm, |scene| thinned(frames(scene, false), every)));
    }

    fn identities_last_with_the_true_frame_rate_when_only_detected_frames_are_given(algorithm: Algorithm) {
        for every in EVERY {
            let rate = (30.0 / every as f64).to_string();
            let tracker = || patient(algorithm, &[("frame_rate", &rate)]);
            demand_identities(algorithm, tracker, SEEDS, lanes, |scene| thinned(frames(scene, false), every));
        }
    }

    fn identities_last_when_the_detector_rests(algorithm: Algorithm) {
        EVERY.into_iter().for_each(|every| demand(algorithm, |scene| resting(timed(scene, false), every)));
        EVERY.into_iter().for_each(|every| demand(algorithm, |scene| resting(frames(scene, false), every)));
    }

    /// Speeds are per second however many frames there are of one: everybody's is known to a tenth of a box width.
    fn speeds_are_true_with_timestamps(algorithm: Algorithm) {
        for every in EVERY {
            let scene = lanes(0);
            let mut tracker = patient(algorithm, &[]);
            let stream = thinned(timed(&scene, false), every);
            let verdict = play(&mut tracker, &scene, &stream);
            let t = stream.last().unwrap().seen.time;
            let mut judged = 0;
            for (object, truth) in scene.objects.iter().enumerate() {
                let Some(track) = tracker.output().reported.iter().find(|t| t.id == verdict.identity(object)) else {
                    continue;
                };
                let x = |t: f64| truth.path.at(t).unwrap().0;
                let speed = (x(t) - x(t - 1.0)) / 1.0;
                assert!((track.velocity.u - speed).abs() < 30.0, "every {every}: {:?}, true {speed}", track.velocity);
                judged += 1;
            }
            assert!(judged >= 7, "{judged} are shown at the end");
        }
    }
}

/// Empty frames are misses: what is for frames without people must not be used for frames without detector.
mod said_to_have_found_nothing {
    use super::*;

    fn reported(algorithm: Algorithm, every: usize) -> usize {
        let scene = lanes(0);
        let mut tracker = patient(algorithm, &[]);
        let mut reported = 0;
        for given in blinded(frames(&scene, false), every) {
            let output = tracker.step(&given.frame()).unwrap();
            reported += if given.seen.frame > 30 { output.reported.len() } else { 0 };
        }
        reported
    }

    #[test]
    fn gentrack2_keeps_identities_all_the_same() {
        for (seed, every) in SEEDS.flat_map(|seed| EVERY.map(|every| (seed, every))) {
            let scene = lanes(seed);
            let stream = blinded(frames(&scene, false), every);
            let ids = identities(&mut patient(Algorithm::GenTrack2, &[]), &scene, &stream);
            assert!(ids.iter().all(|ids| ids.len() == 1), "seed {seed}, every {every}: {ids:?}");
        }
    }

    #[test]
    fn those_that_want_a_run_of_matches_report_nobody() {
        for algorithm in [Algorithm::Sort, Algorithm::DeepSort, Algorithm::OcSort] {
            EVERY.iter().for_each(|every| assert_eq!(reported(algorithm, *every), 0, "{algorithm:?}, every {every}"));
        }
    }
}

/// With neighbours in the way, too.
mod crossing {
    use super::*;

    fn demand_of_gentrack2(stream: impl Fn(&Scene) -> Vec<Given>) {
        let tracker = || -> Tracker { patient(Algorithm::GenTrack2, &[]) };
        demand_identities(Algorithm::GenTrack2, tracker, 0..10, |seed| stage::crossing(seed, 90.0), stream);
    }

    #[test]
    fn gentrack2_keeps_identities_when_only_detected_frames_are_given_with_timestamps() {
        EVERY.iter().for_each(|every| demand_of_gentrack2(|scene| thinned(timed(scene, false), *every)));
    }

    #[test]
    fn gentrack2_keeps_identities_when_the_detector_rests() {
        EVERY.iter().for_each(|every| demand_of_gentrack2(|scene| resting(frames(scene, false), *every)));
    }

    #[test]
    fn gentrack2_keeps_identities_when_frames_are_dropped() {
        demand_of_gentrack2(|scene| dropped(timed(scene, false)));
    }
}
