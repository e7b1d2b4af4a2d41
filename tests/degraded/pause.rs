//! A stream that stops and resumes.

use std::collections::BTreeSet;

use gentrack2::{Algorithm, Detection, Frame, Rect, Tracker};

use crate::for_every_algorithm;
use crate::lanes::{SEEDS, lanes, patient};
use crate::simulator::contract::all_tracks;
use crate::simulator::scene::Scene;
use crate::simulator::stage;
use crate::stream::{Given, frames, identities, timed};

/// Seconds.
const PAUSES: [f64; 2] = [10.0, 3600.0];
/// The first frame after the pause.
const RESUMES: usize = 75;

/// The stream stops for so long; afterwards other people walk where those of before would be had time stood still.
fn paused(stream: Vec<Given>, pause: f64) -> Vec<Given> {
    let later = |given: Given| match given.seen.frame {
        frame if frame >= RESUMES => Given { time: given.time.map(|t| t + pause), ..given },
        _ => given,
    };
    stream.into_iter().map(later).collect()
}

/// Those to whom people who walk are new after a pause longer than their memory. Everybody is sought once more, however
/// long the pause was: by ocsort also where they were last seen, by deepsort anywhere, so little is then known.
fn takes_all_for_new(algorithm: Algorithm) -> bool {
    !matches!(algorithm, Algorithm::OcSort | Algorithm::DeepSort)
}

fn all(identities: &[Vec<u64>]) -> BTreeSet<u64> {
    identities.iter().flatten().copied().collect()
}

/// Who was reported before and after a pause.
fn around(tracker: &mut Tracker, scene: &Scene, pause: f64) -> [Vec<Vec<u64>>; 2] {
    let stream = paused(timed(scene, false), pause);
    let before = identities(tracker, scene, &stream[..RESUMES]);
    identities(tracker, scene, &stream[RESUMES..RESUMES + 30]);
    let after = identities(tracker, scene, &stream[RESUMES + 30..]);
    [before, after]
}

for_every_algorithm! {
    /// Whoever is taken for whom: from a second later on everybody has one identity, and nobody shares it.
    fn after_a_pause_all_goes_on(algorithm: Algorithm) {
        for (seed, pause) in SEEDS.flat_map(|seed| PAUSES.map(|pause| (seed, pause))) {
            let scene = lanes(seed);
            let [before, after] = around(&mut patient(algorithm, &[]), &scene, pause);
            for ids in [&before, &after] {
                assert!(ids.iter().all(|ids| ids.len() == 1), "seed {seed}, {pause} s: {ids:?}");
                assert_eq!(all(ids).len(), scene.objects.len(), "seed {seed}, {pause} s: {ids:?}");
            }
            let new = all(&before).is_disjoint(&all(&after));
            assert_eq!(new, takes_all_for_new(algorithm), "seed {seed}, {pause} s: {before:?}, {after:?}");
        }
    }

    /// A pause that nobody is told of is none: who is where somebody was gets that identity.
    fn a_pause_without_timestamps_is_none(algorithm: Algorithm) {
        let scene = lanes(0);
        let mut tracker = patient(algorithm, &[]);
        let ids = identities(&mut tracker, &scene, &frames(&scene, false));
        assert!(ids.iter().all(|ids| ids.len() == 1), "{ids:?}");
    }

    fn a_reset_makes_everybody_new(algorithm: Algorithm) {
        let scene = lanes(0);
        let stream = timed(&scene, false);
        let mut tracker = patient(algorithm, &[]);
        identities(&mut tracker, &scene, &stream[..RESUMES]);
        let last = all_tracks(tracker.output()).map(|t| t.id).max().unwrap();
        tracker.reset();
        let ids = identities(&mut tracker, &scene, &stream[..RESUMES]);
        assert_eq!(all(&ids).into_iter().collect::<Vec<_>>(), (1..=10).collect::<Vec<_>>(), "{last}");
    }
}

/// Someone is hidden when the stream stops. Long after, whoever comes in is somebody else, however far one can have got.
#[test]
fn gentrack2_takes_nobody_for_who_was_hidden_before_the_pause() {
    let mut judged = 0;
    for (seed, pause) in (0..10).flat_map(|seed| PAUSES.map(|pause| (seed, pause))) {
        let scene = stage::full_occlusion(seed, 1.0);
        let mut tracker = patient(Algorithm::GenTrack2, &[]);
        let stream = timed(&scene, false);
        // Half a second before it would come out again.
        let before = identities(&mut tracker, &scene, &stream[..90]);
        let hidden = before[1][0];
        let Some(track) = all_tracks(tracker.output()).find(|t| t.id == hidden && t.detection_index.is_none()) else {
            continue;
        };
        judged += 1;
        for (left, top) in [(60.0, 60.0), (650.0, 60.0), (60.0, 420.0), (650.0, 420.0)] {
            let newcomer =
                [Detection { rect: Rect { left, top, ..track.rect }, ..Detection::new(0.0, 0.0, 0.0, 0.0, 0.9) }];
            let mut tracker = Tracker::load(&tracker.save()).unwrap();
            let now = ((stream[89].seen.time + pause) * 1e9) as i64;
            let size = Some((scene.width, scene.height));
            let frame = Frame { timestamp_ns: Some(now), size, ..Frame::new(&newcomer) };
            let owner = tracker.step(&frame).unwrap().track_of_detection[0];
            assert!(!before.concat().contains(&owner), "seed {seed}, {pause} s, at {left}, {top}: {owner}");
        }
    }
    assert!(judged >= 10, "{judged}");
}
