//! Pictures that change their size, go black or stand still.

use std::collections::BTreeSet;

use gentrack2::{Algorithm, CameraMotion, Detection, Rect};

use crate::for_every_algorithm;
use crate::lanes::{lanes, patient};
use crate::simulator::scene::{Observation, Scene};
use crate::simulator::stage;
use crate::stream::{Given, demand_identities, frames, identities, play};

/// From this frame on.
const CHANGE: usize = 60;
/// Until this one.
const THAW: usize = 75;

fn halved(r: &Rect) -> Rect {
    Rect::new(0.5 * r.left, 0.5 * r.top, 0.5 * r.width, 0.5 * r.height)
}

/// The camera delivers half the resolution from a frame on; `told` says that the tracker is given that as a motion.
fn at_half_resolution(stream: Vec<Given>, told: bool) -> Vec<Given> {
    let mut stream = stream;
    for given in stream.iter_mut().filter(|given| given.seen.frame >= CHANGE) {
        let (width, height) = (given.size.0 as usize, given.size.1 as usize);
        given.size = (width as u32 / 2, height as u32 / 2);
        given.seen.detections.iter_mut().for_each(|d| *d = Detection { rect: halved(&d.rect), ..*d });
        given.seen.truth.iter_mut().for_each(|t| t.rect = halved(&t.rect));
        if let Some(image) = &mut given.seen.image {
            let pixel = |i: usize| image[2 * (i / (width / 2)) * width + 2 * (i % (width / 2))];
            *image = (0..width / 2 * (height / 2)).map(pixel).collect();
        }
        given.moved = told;
        let scale = if given.seen.frame == CHANGE { 0.5 } else { 1.0 };
        given.seen.camera_motion = CameraMotion([scale, 0.0, 0.0, 0.0, scale, 0.0]);
    }
    stream
}

fn black(stream: Vec<Given>) -> Vec<Given> {
    let mut stream = stream;
    let images =
        stream.iter_mut().filter(|given| given.seen.frame >= CHANGE).filter_map(|given| given.seen.image.as_mut());
    images.for_each(|image| image.fill(0));
    stream
}

/// The camera repeats a picture, and the detector finds the same in it, until it jumps to where people are by then.
fn frozen(stream: Vec<Given>) -> Vec<Given> {
    let mut stream = stream;
    let last = stream[CHANGE].seen.clone();
    for given in &mut stream[CHANGE..THAW] {
        given.seen = Observation { frame: given.seen.frame, time: given.seen.time, ..last.clone() };
    }
    stream
}

fn demand(algorithm: Algorithm, stream: impl Fn(&Scene) -> Vec<Given>) {
    // Pictures take time, and only gentrack2 looks at them.
    let seeds = if algorithm == Algorithm::GenTrack2 { 0..4 } else { 0..1 };
    demand_identities(algorithm, || patient(algorithm, &[]), seeds, lanes, stream);
}

for_every_algorithm! {
    fn another_resolution_that_is_told_as_a_camera_motion_costs_no_identity(algorithm: Algorithm) {
        // The published one moves boxes with the camera and leaves their sizes alone.
        if algorithm == Algorithm::ConfTrack {
            return;
        }
        for image in [false, true] {
            demand(algorithm, |scene| at_half_resolution(frames(scene, image), true));
        }
    }

    /// Who is who cannot be known then; from a second later on it is as if the stream had begun there.
    fn another_resolution_that_nobody_is_told_of_is_a_new_beginning(algorithm: Algorithm) {
        for image in [false, true] {
            let scene = lanes(3);
            let stream = at_half_resolution(frames(&scene, image), false);
            let mut tracker = patient(algorithm, &[]);
            play(&mut tracker, &scene, &stream[..CHANGE + 30]);
            let identities = identities(&mut tracker, &scene, &stream[CHANGE + 30..]);
            assert!(identities.iter().all(|ids| ids.len() == 1), "{identities:?}");
            assert_eq!(identities.concat().into_iter().collect::<BTreeSet<u64>>().len(), identities.len());
        }
    }

    fn a_black_picture_costs_no_identity(algorithm: Algorithm) {
        demand(algorithm, |scene| black(frames(scene, true)));
    }

    /// For half a second, in which people walk up to a box's width: while it lasts everybody is who they were. Afterwards
    /// that is not always to be known by motion, but by looks.
    fn a_frozen_picture_costs_no_identity_while_it_lasts(algorithm: Algorithm) {
        let looks = algorithm == Algorithm::GenTrack2;
        for seed in if looks { 0..4 } else { 0..1 } {
            let scene = lanes(seed);
            let stream = frozen(frames(&scene, true));
            let mut tracker = patient(algorithm, &[]);
            let before = identities(&mut tracker, &scene, &stream[..THAW]);
            assert!(before.iter().all(|ids| ids.len() == 1), "seed {seed}: {before:?}");
            identities(&mut tracker, &scene, &stream[THAW..THAW + 30]);
            let after = identities(&mut tracker, &scene, &stream[THAW + 30..]);
            assert!(after.iter().all(|ids| ids.len() == 1), "seed {seed}: {after:?}");
            assert!(!looks || before == after, "seed {seed}: {before:?}, {after:?}");
        }
    }
}

/// Where people cross, too, as if there had been no picture.
#[test]
fn gentrack2_keeps_identities_across_a_crossing_in_the_dark() {
    let tracker = || patient(Algorithm::GenTrack2, &[]);
    demand_identities(
        Algorithm::GenTrack2,
        tracker,
        0..5,
        |seed| stage::crossing(seed, 90.0),
        |scene| black(frames(scene, true)),
    );
}
