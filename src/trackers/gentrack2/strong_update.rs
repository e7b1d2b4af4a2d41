//! Strong tracks: the state takes the matched detection (eq. 9).

use crate::frame::Detection;
use crate::geometry::State;

use super::parameters::{GenTrack2Parameters, StrongUpdate};
use super::target::Target;
use super::whiteness::Trust;

/// Share of a detection's score in the running mean: the mean is over some ten detections.
const MEAN_SCORE_GAIN: f64 = 0.1;

/// Updates state, penalty, age and counters of a matched target.
pub fn update(p: &GenTrack2Parameters, target: &mut Target, row: u32, detection: &Detection, trust: &Trust) {
    target.life.take(row, detection);
    target.mean_score += MEAN_SCORE_GAIN * (detection.score - target.mean_score);
    target.state = updated_state(p, target, detection, trust);
    target.penalty = p.strong_penalty * (1.0 - detection.score);
    target.age = 0.0;
    target.missed = 0.0;
    target.blamed = 0.0;
    target.covered = 0.0;
    target.missed_frames = 0;
    target.dormant = false;
    weigh_evidence(p, target);
}

/// A track is confirmed by enough matches of enough confidence.
pub fn weigh_evidence(p: &GenTrack2Parameters, target: &mut Target) {
    target.evidence += (target.life.last.score - p.evidence_score).max(0.0);
    target.confirmed |= i64::from(target.life.hits) >= p.confirm_hits && target.evidence >= p.confirm_evidence;
}

fn updated_state(p: &GenTrack2Parameters, target: &Target, detection: &Detection, trust: &Trust) -> State {
    let detected = State::from(detection.rect);
    let jump = p.jump_distance * target.state.diagonal();
    match p.strong_update {
        StrongUpdate::Replace if target.previous.distance(&detected) >= jump => half_way(&target.previous, &detected),
        StrongUpdate::Blend if target.predicted.distance(&detected) >= jump => half_way(&target.predicted, &detected),
        StrongUpdate::Blend if target.motion_is_known() => {
            let weight = |blend: f64, trust: f64| (blend * detection.score * trust).min(1.0);
            let (centre, size) = (weight(p.blend_centre, trust.centre), weight(p.blend_size, trust.size));
            let (from, error) = (target.predicted, detected - target.predicted);
            State::new(
                from.u + centre * error.u,
                from.v + centre * error.v,
                from.w + size * error.w,
                from.h + size * error.h,
            )
        }
        _ => detected,
    }
}

/// A detection this far off is a glitch as likely as not.
fn half_way(a: &State, b: &State) -> State {
    (*a + *b) * 0.5
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 40 x 80 at (100, 100), predicted 10 px to the right, seen `hits` times.
    fn target(hits: u32) -> Target {
        let mut target = Target::born(&Detection::new(80.0, 60.0, 40.0, 80.0, 0.9), 0, 1);
        target.predicted.u = 110.0;
        target.life.hits = hits;
        target.penalty = 0.7;
        target.age = 12.0;
        target.missed = 3.0;
        target
    }

    fn detection(u: f64, w: f64, score: f64) -> Detection {
        Detection { rect: State::new(u, 100.0, w, 80.0).into(), score, ..Default::default() }
    }

    #[test]
    fn equation_9_literally() {
        let p = GenTrack2Parameters {
            strong_update: StrongUpdate::Replace,
            strong_penalty: 0.0,
            jump_distance: 0.5,
            ..Default::default()
        };
        // Near (20 px, the limit is .5 * 89.4): the detection itself.
        let mut near = target(9);
        update(&p, &mut near, 0, &detection(120.0, 44.0, 0.6), &Trust::NOMINAL);
        assert_eq!(near.state, State::new(120.0, 100.0, 44.0, 80.0));
        assert_eq!((near.penalty, near.age, near.missed, near.life.hits), (0.0, 0.0, 0.0, 10));
        // Far (60 px from X_{t-1}): the mean of (100, ...) and (160, ...).
        let mut far = target(9);
        update(&p, &mut far, 0, &detection(160.0, 40.0, 0.6), &Trust::NOMINAL);
        assert_eq!(far.state, State::new(130.0, 100.0, 40.0, 80.0));
    }

    #[test]
    fn the_blend_weighs_by_confidence() {
        let p = GenTrack2Parameters { blend_centre: 0.7, blend_size: 0.6, strong_penalty: 0.3, ..Default::default() };
        let mut target = target(9);
        update(&p, &mut target, 0, &detection(120.0, 50.0, 0.5), &Trust::NOMINAL);
        // Centre: 110 + .35 * 10 = 113.5; width: 40 + .3 * 10 = 43; penalty: .3 * .5.
        assert_eq!(target.state, State::new(113.5, 100.0, 43.0, 80.0));
        assert_eq!(target.penalty, 0.15);
    }

    #[test]
    fn young_tracks_take_the_detection_and_are_confirmed_by_hits() {
        let p = GenTrack2Parameters { confirm_hits: 3, confirm_evidence: 0.0, ..Default::default() };
        let mut target = target(1);
        update(&p, &mut target, 0, &detection(120.0, 50.0, 0.5), &Trust::NOMINAL);
        assert_eq!(target.state, State::new(120.0, 100.0, 50.0, 80.0));
        assert!(!target.confirmed);
        update(&p, &mut target, 0, &detection(120.0, 50.0, 0.5), &Trust::NOMINAL);
        assert!(target.confirmed);
    }

    #[test]
    fn confirmation_waits_for_evidence() {
        let p =
            GenTrack2Parameters { confirm_hits: 2, confirm_evidence: 0.5, evidence_score: 0.5, ..Default::default() };
        let hits_needed = |score: f64| {
            let mut target = target(1);
            let mut hits = 0;
            while !target.confirmed {
                update(&p, &mut target, 0, &detection(120.0, 50.0, score), &Trust::NOMINAL);
                hits += 1;
            }
            hits
        };
        // .4, .8; .2, .4, .6.
        assert_eq!((hits_needed(0.9), hits_needed(0.7)), (2, 3));
    }

    #[test]
    fn the_mean_score_follows_the_detections() {
        let p = GenTrack2Parameters::default();
        let mut target = target(1);
        assert_eq!(target.mean_score, 0.9);
        // .9 + .1 * (.5 - .9) = .86.
        update(&p, &mut target, 0, &detection(120.0, 50.0, 0.5), &Trust::NOMINAL);
        assert!((target.mean_score - 0.86).abs() < 1e-12);
    }

    #[test]
    fn trust_scales_the_blend() {
        let p = GenTrack2Parameters { blend_centre: 0.7, blend_size: 0.6, ..Default::default() };
        let mut target = target(9);
        update(&p, &mut target, 0, &detection(120.0, 50.0, 0.5), &Trust { centre: 0.4, size: 1.4 });
        // Centre: 110 + .14 * 10; width: 40 + .42 * 10.
        let near = |a: f64, b: f64| (a - b).abs() < 1e-12;
        assert!(near(target.state.u, 111.4) && near(target.state.w, 44.2), "{:?}", target.state);
    }
}
