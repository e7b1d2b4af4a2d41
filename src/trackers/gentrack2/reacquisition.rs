//! Who comes out from behind another: before a detection starts a track, the targets that went out of sight near by
//! are asked whether it is one of them.
//!
//! Hidden targets turn and stop where nobody sees it, so their predictions can be far off; what bounds where they can
//! be is their speed and the time they were gone.

use crate::classes::ClassRule;
use crate::geometry::{Rect, State};

use super::appearance_model::{LearntLooks, ROWS};
use super::data_association::{Sight, embedding_part};
use super::observations::{Observations, Observed};
use super::parameters::GenTrack2Parameters;
use super::target::Target;

/// Share of a target's box that must have been covered by one seen in front for it to count as hidden.
const HIDDEN: f64 = 0.5;
/// Matches from which a target's speed is known.
const KNOWN_HITS: u32 = 10;
/// Largest ratio of heights of one and the same target.
const LARGEST_GROWTH: f64 = 1.25;
/// Where it was last seen, a target's centre is known to this share of its diagonal.
const SLACK: f64 = 0.25;
/// Unlikeness from which looks speak against a target.
const STRANGE: f64 = 0.5;
/// Share of a row of a box from which it counts as hidden by a box in front.
const COVERED_ROW: f64 = 0.5;

/// The hidden target that detection `index` is: of those that can have got there and look like it, the nearest.
pub fn find(
    p: &GenTrack2Parameters,
    targets: &[Target],
    unseen: &[u32],
    observations: &mut Observations,
    index: usize,
    rule: ClassRule,
    sight: &mut Sight<'_, '_>,
) -> Option<usize> {
    if p.reacquire_reach == 0.0 {
        return None;
    }
    let Observed { state: detected, detection, .. } = *observations.get(index);
    let mut best = None;
    for slot in unseen.iter().map(|slot| *slot as usize) {
        let target = &targets[slot];
        if !rule.allows(target.life.last.class_id, detection.class_id) {
            continue;
        }
        let Some(detour) = detour(p, target, &detected) else { continue };
        let nearer = best.is_none_or(|(_, least)| detour < least);
        if nearer && looks_alike(p, target, targets, observations, index, sight) {
            best = Some((slot, detour));
        }
    }
    best.map(|(slot, _)| slot)
}

/// How far the hidden target would have had to go to be at `detected`, relative to how far it can have got; `None` if
/// that is too far or it is not one to be looked for.
fn detour(p: &GenTrack2Parameters, target: &Target, detected: &State) -> Option<f64> {
    let last = target.history.last().filter(|_| is_hidden(target) && !target.is_strong())?;
    let growth = detected.h / last.h;
    if !(1.0 / LARGEST_GROWTH..=LARGEST_GROWTH).contains(&growth) {
        return None;
    }
    let reach = p.reacquire_reach * target.velocity.centre_norm() * target.missed + SLACK * last.diagonal();
    let gone = (*detected - last).centre_norm();
    (gone <= reach).then_some(gone / reach)
}

/// Whether a target that is known well went out of sight behind another.
pub fn is_hidden(target: &Target) -> bool {
    target.confirmed && target.covered >= HIDDEN && target.life.hits >= KNOWN_HITS
}

/// Whether nothing that is seen of a detection speaks against a target.
fn looks_alike(
    p: &GenTrack2Parameters,
    target: &Target,
    targets: &[Target],
    observations: &mut Observations,
    index: usize,
    sight: &mut Sight<'_, '_>,
) -> bool {
    if embedding_part(p, target, observations, index) > 0.0 {
        return false;
    }
    let detected = observations.get(index).detection.rect;
    let known = target.looks().filter(|_| p.hog_cost > 0.0).map(LearntLooks::recall);
    let both = known.and_then(|known| Some((known, observations.looks(index, sight.image, sight.hog)?)));
    // What comes out from behind another shows a part of itself, and for the rest the other.
    both.is_none_or(|(known, seen)| {
        let visible = visible_rows(targets, &detected);
        known.of_rows(&visible).unlikeness(p, &seen.of_rows(&visible)) <= STRANGE
    })
}

/// Which rows of a detection's box no strong target in front of it hides.
fn visible_rows(targets: &[Target], detected: &Rect) -> [bool; ROWS] {
    let height = detected.height / ROWS as f64;
    let in_front = || targets.iter().filter(|t| t.is_strong()).map(|t| Rect::from(t.state));
    std::array::from_fn(|row| {
        let part = Rect { top: detected.top + row as f64 * height, height, ..*detected };
        let hides =
            |front: Rect| front.bottom() > detected.bottom() && front.intersection(&part) >= COVERED_ROW * part.area();
        !in_front().any(hides)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::appearance::HogWorkspace;
    use crate::frame::{Detection, Embeddings, Frame};
    use crate::trackers::gentrack2::target::Match;

    /// Last seen at (100, 100), 30 x 40 (diagonal 50), walking at 5 px/tick, gone for 10 ticks behind another.
    fn hidden() -> Target {
        let mut target =
            Target::born(&Detection { rect: seen(100.0, 100.0).into(), score: 0.9, ..Default::default() }, 0, 1);
        target.history.push(0.0, &target.state, 1);
        target.velocity = State::new(3.0, 4.0, 0.0, 0.0);
        target.matched = Match::None;
        target.confirmed = true;
        target.life.hits = 10;
        target.missed = 10.0;
        target.covered = 0.5;
        target.state.u = 500.0;
        target
    }

    fn seen(u: f64, v: f64) -> State {
        State::new(u, v, 30.0, 40.0)
    }

    fn parameters() -> GenTrack2Parameters {
        GenTrack2Parameters { reacquire_reach: 0.5, ..Default::default() }
    }

    #[test]
    fn the_reach_is_speed_times_time_and_a_little() {
        // .5 * 5 * 10 + .25 * 50 = 37.5 px from where it was last seen, whatever was predicted.
        let p = parameters();
        assert_eq!(detour(&p, &hidden(), &seen(100.0, 70.0)), Some(0.8));
        assert_eq!(detour(&p, &hidden(), &seen(130.0, 122.5)), Some(1.0));
        assert_eq!(detour(&p, &hidden(), &seen(138.0, 100.0)), None);
    }

    #[test]
    fn only_known_targets_that_were_hidden_are_sought() {
        let p = parameters();
        let refused = |change: fn(&mut Target)| {
            let mut target = hidden();
            change(&mut target);
            detour(&p, &target, &seen(100.0, 100.0)).is_none()
        };
        assert!(!refused(|_| ()));
        assert!(refused(|t| t.covered = 0.4));
        assert!(refused(|t| t.confirmed = false));
        assert!(refused(|t| t.life.hits = 9));
        assert!(refused(|t| t.matched = Match::Detection(0)));
        // Heights of 40 and 51: more than a quarter.
        let taller = State { h: 51.0, ..seen(100.0, 100.0) };
        assert_eq!(detour(&p, &hidden(), &taller), None);
    }

    #[test]
    fn rows_behind_somebody_in_front_are_not_seen() {
        // The detection is 80..120, in rows of 5 px; the one in front covers it from 101 on: four fifths of the fifth
        // row and all below.
        let detected = Rect::from(seen(100.0, 100.0));
        let front = |top: f64, matched: Match| {
            let rect = Rect::new(80.0, top, 40.0, 121.0 - top);
            let mut target = Target::born(&Detection { rect, score: 0.9, ..Default::default() }, 0, 1);
            target.matched = matched;
            target
        };
        let strong = Match::Detection(3);
        let upper: [bool; ROWS] = std::array::from_fn(|row| row < 4);
        assert_eq!(visible_rows(&[front(101.0, strong)], &detected), upper);
        // One that is not there, or stands further back, hides nothing.
        assert_eq!(visible_rows(&[front(101.0, Match::None)], &detected), [true; ROWS]);
        let mut behind = front(70.0, strong);
        behind.state = State { v: 90.0, h: 40.0, ..behind.state };
        assert_eq!(visible_rows(&[behind], &detected), [true; ROWS]);
    }

    #[test]
    fn the_nearest_that_does_not_look_otherwise_is_found() {
        let mut far = hidden();
        far.history.push(0.0, &seen(80.0, 100.0), 1);
        let mut targets = [far, hidden()];
        let rect = seen(102.0, 100.0).into();
        let detections = [Detection { rect, score: 0.9, ..Default::default() }];
        let look = [1.0, 0.0];
        let frame = Frame { embeddings: Some(Embeddings::new(&look, 2)), ..Frame::new(&detections) };
        let mut observations = Observations::default();
        observations.prepare(&frame, 0.0);
        let mut found = |targets: &[Target], p: &GenTrack2Parameters| {
            let mut sight = Sight { image: None, hog: &mut HogWorkspace::default() };
            let unseen: Vec<u32> = (0..targets.len() as u32).collect();
            find(p, targets, &unseen, &mut observations, 0, ClassRule::default(), &mut sight)
        };
        assert_eq!(found(&targets, &parameters()), Some(1));
        assert_eq!(found(&targets, &GenTrack2Parameters { reacquire_reach: 0.0, ..parameters() }), None);
        // The nearest looks the opposite, so it is the other one.
        targets[1].embedding.learn(&[-1.0, 0.0], 0.0);
        assert_eq!(found(&targets, &parameters()), Some(0));
    }
}
