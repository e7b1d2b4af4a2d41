//! Weak tracks: where an unmatched target goes (eq. 12-14), guided by its trustworthy neighbours.
//!
//! Only the centre moves; the size waits for the next detection, so it can neither shrink away nor grow.

use crate::geometry::State;
use crate::track::WeakMove;

use super::median::{OrderKey, median};
use super::parameters::{GenTrack2Parameters, WeakMotion};
use super::target::Target;

/// A point or displacement of box centres.
type Vector = (f64, f64);

/// The medians over a weak track's trustworthy neighbours: those that have a detection in this frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trusted {
    /// Median centre.
    pub position: Vector,
    /// Median displacement since the previous frame. The median of differences, not the difference of medians, which
    /// jumps when the neighbours change.
    pub displacement: Vector,
    /// Median velocity per tick.
    pub velocity: Vector,
}

/// Buffers of the medians.
#[derive(Clone, Debug, Default)]
pub struct TrustedMedian {
    buffer: Vec<OrderKey>,
}

impl TrustedMedian {
    /// The medians over the strong ones among `neighbours`; `None` if there are none.
    pub fn over(&mut self, targets: &[Target], neighbours: &[u32]) -> Option<Trusted> {
        let strong = || neighbours.iter().map(|j| &targets[*j as usize]).filter(|t| t.is_strong());
        strong().next()?;
        let mut of = |get: fn(&Target) -> f64| {
            self.buffer.clear();
            self.buffer.extend(strong().map(|t| OrderKey::from(get(t))));
            median(&mut self.buffer)
        };
        Some(Trusted {
            position: (of(|t| t.state.u), of(|t| t.state.v)),
            displacement: (of(|t| t.state.u - t.previous.u), of(|t| t.state.v - t.previous.v)),
            velocity: (of(|t| t.velocity.u), of(|t| t.velocity.v)),
        })
    }
}

/// The state of a weak track after `ticks`, and by which rule it came there.
pub fn moved(p: &GenTrack2Parameters, weak: &Target, trusted: Option<&Trusted>, ticks: f64) -> (State, WeakMove) {
    let still = p.still_speed * weak.state.diagonal();
    let own = (weak.velocity.u, weak.velocity.v);
    if length(own) < still {
        return (weak.state, WeakMove::Still);
    }
    let ((u, v), rule) = match trusted.filter(|_| p.weak_motion == WeakMotion::Neighbours) {
        Some(trusted) if length(trusted.velocity) >= still => with_neighbours(p, weak, own, trusted, ticks),
        // Eq. 12.
        _ => (add(centre(&weak.state), scale(own, ticks)), WeakMove::Own),
    };
    (State { u, v, ..weak.state }, rule)
}

/// Eq. 13.
fn with_neighbours(
    p: &GenTrack2Parameters,
    weak: &Target,
    own: Vector,
    trusted: &Trusted,
    ticks: f64,
) -> (Vector, WeakMove) {
    let (speed, others) = (length(own), length(trusted.velocity));
    if dot(own, trusted.velocity) / (speed * others) >= p.delta_d {
        let together = speed.min(others) / speed.max(others) >= p.speed_ratio;
        let (step, rule) = match together {
            true => (trusted.displacement, WeakMove::WithNeighbours),
            false => (scale(own, ticks), WeakMove::Own),
        };
        return (add(centre(&weak.state), step), rule);
    }
    let avoiding = avoid(p, weak, own, trusted, ticks);
    let best = centre(&weak.global_best);
    (add(scale(avoiding, 1.0 - p.sigma_g), scale(best, p.sigma_g)), WeakMove::Around)
}

/// Eq. 14: obstacle avoidance. The push is across the line to the neighbours and against their motion.
fn avoid(p: &GenTrack2Parameters, weak: &Target, own: Vector, trusted: &Trusted, ticks: f64) -> Vector {
    let here = centre(&weak.state);
    let away = (here.0 - trusted.position.0, here.1 - trusted.position.1);
    let distance = length(away);
    if distance == 0.0 {
        return add(here, scale(own, ticks));
    }
    let mut across = (-away.1 / distance, away.0 / distance);
    if dot(across, trusted.velocity) > 0.0 {
        across = (-across.0, -across.1);
    }
    let speed = length(own);
    // Growing without bound as the distance falls to nothing, the push would throw the track out of the scene.
    let push = (p.epsilon_s * speed / distance * weak.state.diagonal()).min(speed);
    add(here, scale(add(own, scale(across, push)), ticks))
}

fn centre(s: &State) -> Vector {
    (s.u, s.v)
}

fn add(a: Vector, b: Vector) -> Vector {
    (a.0 + b.0, a.1 + b.1)
}

fn scale(a: Vector, k: f64) -> Vector {
    (a.0 * k, a.1 * k)
}

fn dot(a: Vector, b: Vector) -> f64 {
    a.0 * b.0 + a.1 * b.1
}

fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Detection;
    use crate::trackers::gentrack2::target::Match;

    /// A 30 x 40 box (diagonal 50) at the given centre that moved by `step` in this frame.
    fn target(centre: Vector, step: Vector) -> Target {
        let state = State::new(centre.0, centre.1, 30.0, 40.0);
        let mut target = Target::born(&Detection { rect: state.into(), score: 0.9, ..Default::default() }, 0, 1);
        target.previous = State::new(centre.0 - step.0, centre.1 - step.1, 30.0, 40.0);
        target.velocity = State::new(step.0, step.1, 0.0, 0.0);
        target
    }

    fn weak(velocity: Vector) -> Target {
        let mut target = target((0.0, 0.0), (0.0, 0.0));
        target.matched = Match::None;
        target.velocity = State::new(velocity.0, velocity.1, 5.0, 5.0);
        target
    }

    fn parameters() -> GenTrack2Parameters {
        GenTrack2Parameters {
            weak_motion: WeakMotion::Neighbours,
            still_speed: 0.02,
            delta_d: 0.9,
            sigma_g: 0.25,
            epsilon_s: 0.1,
            ..Default::default()
        }
    }

    fn position(p: &GenTrack2Parameters, weak: &Target, trusted: Option<&Trusted>) -> Vector {
        let (state, _) = moved(p, weak, trusted, 1.0);
        assert_eq!((state.w, state.h), (30.0, 40.0), "the size is frozen");
        (state.u, state.v)
    }

    #[test]
    fn trustworthy_neighbours_are_the_strong_ones() {
        let mut unseen = target((500.0, 500.0), (9.0, 9.0));
        unseen.matched = Match::None;
        let targets = [
            target((10.0, 0.0), (1.0, 0.0)),
            target((30.0, 20.0), (3.0, 2.0)),
            unseen,
            target((20.0, 50.0), (8.0, 1.0)),
        ];
        let trusted = TrustedMedian::default().over(&targets, &[0, 1, 2, 3]).unwrap();
        assert_eq!(trusted.position, (20.0, 20.0));
        assert_eq!(trusted.displacement, (3.0, 1.0));
        assert_eq!(trusted.velocity, (3.0, 1.0));
        assert_eq!(TrustedMedian::default().over(&targets, &[2]), None);
    }

    #[test]
    fn equation_12_without_neighbours_or_with_standing_ones() {
        let p = parameters();
        assert_eq!(position(&p, &weak((3.0, 4.0)), None), (3.0, 4.0));
        // tau_V = .02 * 50 = 1 px/tick.
        let standing = Trusted { position: (9.0, 9.0), displacement: (0.5, 0.0), velocity: (0.9, 0.0) };
        assert_eq!(position(&p, &weak((3.0, 4.0)), Some(&standing)), (3.0, 4.0));
        // Two ticks go twice as far.
        assert_eq!(moved(&p, &weak((3.0, 4.0)), None, 2.0).0.u, 6.0);
    }

    #[test]
    fn noise_is_suppressed_below_the_still_speed() {
        let moving = Trusted { position: (9.0, 9.0), displacement: (5.0, 0.0), velocity: (5.0, 0.0) };
        assert_eq!(position(&parameters(), &weak((0.6, 0.7)), Some(&moving)), (0.0, 0.0));
    }

    #[test]
    fn equation_13_moves_with_neighbours_that_go_the_same_way() {
        // cos = (3*4 + 4*3) / 25 = .96 >= .9: the displacement of the neighbours, not the own velocity.
        let trusted = Trusted { position: (40.0, 0.0), displacement: (4.5, 2.5), velocity: (4.0, 3.0) };
        assert_eq!(position(&parameters(), &weak((3.0, 4.0)), Some(&trusted)), (4.5, 2.5));
    }

    #[test]
    fn the_one_who_overtakes_goes_its_own_way() {
        // Same direction, speeds 5 and 3: the ratio is .6.
        let p = GenTrack2Parameters { speed_ratio: 0.7, ..parameters() };
        let trusted = Trusted { position: (40.0, 0.0), displacement: (1.8, 2.4), velocity: (1.8, 2.4) };
        assert_eq!(position(&p, &weak((3.0, 4.0)), Some(&trusted)), (3.0, 4.0));
        let literal = GenTrack2Parameters { speed_ratio: 0.0, ..p };
        assert_eq!(position(&literal, &weak((3.0, 4.0)), Some(&trusted)), (1.8, 2.4));
    }

    #[test]
    fn equation_14_pushes_across_and_against_the_neighbours() {
        // The neighbour is 100 px to the right, coming the other way: cos = -1. dX = (-100, 0), across is (0, -1) or
        // (0, 1); its velocity (-2, -1) has a positive product with (0, -1), so the push is along (0, 1). Its size
        // is .1 * 4/100 * 50 = .2. X^o = (4, .2); with a global best at (8, 2): .75 X^o + .25 X_g = (5, .65).
        let trusted = Trusted { position: (100.0, 0.0), displacement: (-2.0, -1.0), velocity: (-2.0, -1.0) };
        let mut track = weak((4.0, 0.0));
        track.global_best = State::new(8.0, 2.0, 30.0, 40.0);
        let (u, v) = position(&parameters(), &track, Some(&trusted));
        assert!((u - 5.0).abs() < 1e-12 && (v - 0.65).abs() < 1e-12, "({u}, {v})");
    }

    #[test]
    fn each_rule_is_named() {
        let p = parameters();
        let rule = |own: Vector, velocity: Option<Vector>| {
            let trusted = velocity.map(|velocity| Trusted { position: (40.0, 0.0), displacement: velocity, velocity });
            moved(&p, &weak(own), trusted.as_ref(), 1.0).1
        };
        // tau_V = .02 * 50 = 1 px/tick.
        assert_eq!(rule((0.6, 0.7), Some((4.0, 3.0))), WeakMove::Still);
        assert_eq!(rule((3.0, 4.0), None), WeakMove::Own);
        assert_eq!(rule((3.0, 4.0), Some((0.9, 0.0))), WeakMove::Own);
        assert_eq!(rule((3.0, 4.0), Some((4.0, 3.0))), WeakMove::WithNeighbours);
        assert_eq!(rule((3.0, 4.0), Some((-3.0, -4.0))), WeakMove::Around);
        let overtaking = GenTrack2Parameters { speed_ratio: 0.7, ..p };
        let slow = Trusted { position: (40.0, 0.0), displacement: (1.8, 2.4), velocity: (1.8, 2.4) };
        assert_eq!(moved(&overtaking, &weak((3.0, 4.0)), Some(&slow), 1.0).1, WeakMove::Own);
    }

    #[test]
    fn the_push_never_exceeds_the_own_speed() {
        let p = GenTrack2Parameters { sigma_g: 0.0, epsilon_s: 1.0, ..parameters() };
        let trusted = Trusted { position: (0.01, 0.0), displacement: (-2.0, 0.0), velocity: (-2.0, 0.0) };
        let (u, v) = position(&p, &weak((4.0, 0.0)), Some(&trusted));
        assert_eq!((u, v.abs()), (4.0, 4.0));
        // On top of the neighbour there is no direction to push in.
        let same = Trusted { position: (0.0, 0.0), ..trusted };
        assert_eq!(position(&p, &weak((4.0, 0.0)), Some(&same)), (4.0, 0.0));
    }
}
