//! Penalty and age of weak tracks (eq. 11).
//!
//! ```text
//! Delta  = (1 - exp(-l^2 / (2 sigma^2))) (1 - f + Delta_e),   sigma = age_max / 6
//! pen   += zeta Delta,   age += zeta Delta age_max
//! zeta   = sign(rho_re - f + Delta_e) beside a strong track, else 1
//! ```
//! per tick, with `l` the time without a match, which passes slower behind other targets, and `f` the history fitness of the swarm's global best.

use super::parameters::GenTrack2Parameters;
use super::target::Target;

/// Ages a weak track by `ticks`. `beside_strong` says that a neighbour has a detection in this frame.
pub fn age(p: &GenTrack2Parameters, target: &mut Target, beside_strong: bool, ticks: f64) {
    let entrance = entrance_penalty(p, target);
    let fitness = target.global_fitness.max(p.fitness_floor);
    let can_recover = p.recovery_threshold < 1.0 && target.looked_at && beside_strong;
    let trust = if can_recover { sign(p.recovery_threshold - fitness + entrance) } else { 1.0 };
    let step = trust * growth(p, target.blamed) * (1.0 - fitness + entrance) * ticks;
    target.penalty = (target.penalty + step).clamp(0.0, 1.0);
    target.age = (target.age + step * p.max_age).clamp(0.0, p.max_age);
}

/// How fast time without a match passes for a track of whose box a strong track covers the given share: slower the
/// more is covered, for a hidden target cannot be detected; faster outside the image, where it will hardly come back.
pub fn pace(p: &GenTrack2Parameters, covered: f64, outside: bool) -> f64 {
    let hidden = 1.0 - (1.0 - p.covered_pace) * covered;
    if outside { hidden * p.outside_pace } else { hidden }
}

/// `1 - exp(-l^2 / (2 sigma^2))`.
fn growth(p: &GenTrack2Parameters, blamed: f64) -> f64 {
    let sigma = p.max_age / 6.0;
    1.0 - libm::exp(-blamed * blamed / (2.0 * sigma * sigma))
}

/// `Delta_e`: the configured penalty inside an entrance area, else 0.
fn entrance_penalty(p: &GenTrack2Parameters, target: &Target) -> f64 {
    let inside = p.entrance_areas.iter().any(|area| area.contains(target.state.u, target.state.v));
    if inside { p.entrance_penalty } else { 0.0 }
}

fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Detection;
    use crate::geometry::Rect;

    fn weak(fitness: f64, blamed: f64) -> Target {
        let mut target = Target::born(&Detection::new(0.0, 0.0, 20.0, 20.0, 0.9), 0, 1);
        target.global_fitness = fitness;
        target.blamed = blamed;
        target.looked_at = true;
        target
    }

    fn parameters() -> GenTrack2Parameters {
        GenTrack2Parameters { max_age: 60.0, recovery_threshold: 0.8, fitness_floor: 0.0, ..Default::default() }
    }

    #[test]
    fn equation_11_by_hand() {
        // sigma = 10; l = 10: 1 - e^-.5 = .393469340287; times 1 - .5: .196734670.
        let mut target = weak(0.5, 10.0);
        age(&parameters(), &mut target, false, 1.0);
        assert!((target.penalty - 0.196_734_670_143).abs() < 1e-9);
        assert!((target.age - 60.0 * 0.196_734_670_143).abs() < 1e-7);
        // Two ticks age twice as much.
        let mut twice = weak(0.5, 10.0);
        age(&parameters(), &mut twice, false, 2.0);
        assert!((twice.penalty - 2.0 * 0.196_734_670_143).abs() < 1e-9);
    }

    #[test]
    fn a_fit_track_beside_a_strong_one_recovers() {
        // f = .9 > rho = .8: zeta = -1; step = -.393469 * .1.
        let mut target = weak(0.9, 10.0);
        target.penalty = 0.5;
        target.age = 30.0;
        age(&parameters(), &mut target, true, 1.0);
        assert!((target.penalty - (0.5 - 0.039_346_934_029)).abs() < 1e-9);
        assert!((target.age - (30.0 - 60.0 * 0.039_346_934_029)).abs() < 1e-7);
        // Alone, or not fit enough, or where nobody could look, it ages.
        let mut unseen = weak(0.9, 10.0);
        unseen.looked_at = false;
        age(&parameters(), &mut unseen, true, 1.0);
        assert!(unseen.penalty > 0.0);
        for (fitness, beside) in [(0.9, false), (0.7, true)] {
            let mut target = weak(fitness, 10.0);
            age(&parameters(), &mut target, beside, 1.0);
            assert!(target.penalty > 0.0);
        }
    }

    #[test]
    fn looking_like_what_hides_it_does_not_end_a_track_sooner() {
        // f = .2 counts as .9: .393469 * .1.
        let p = GenTrack2Parameters { fitness_floor: 0.9, ..parameters() };
        let mut target = weak(0.2, 10.0);
        age(&p, &mut target, false, 1.0);
        assert!((target.penalty - 0.039_346_934_029).abs() < 1e-9);
    }

    #[test]
    fn time_passes_slower_behind_another_target() {
        let p = GenTrack2Parameters { covered_pace: 0.2, ..parameters() };
        assert_eq!(pace(&p, 0.0, false), 1.0);
        assert!((pace(&p, 1.0, false) - 0.2).abs() < 1e-12);
        // Half covered: half-way between 1 and .2.
        assert!((pace(&p, 0.5, false) - 0.6).abs() < 1e-12);
    }

    #[test]
    fn time_passes_faster_outside_the_image() {
        let p = GenTrack2Parameters { covered_pace: 0.2, outside_pace: 3.0, ..parameters() };
        assert_eq!(pace(&p, 0.0, true), 3.0);
        assert!((pace(&p, 0.5, true) - 1.8).abs() < 1e-12);
    }

    #[test]
    fn entrance_areas_speed_up_the_end() {
        let areas = |rect| GenTrack2Parameters { entrance_areas: vec![rect], entrance_penalty: 0.5, ..parameters() };
        let (mut inside, mut outside) = (weak(0.5, 10.0), weak(0.5, 10.0));
        // The centre is (10, 10).
        age(&areas(Rect::new(0.0, 0.0, 11.0, 11.0)), &mut inside, false, 1.0);
        age(&areas(Rect::new(50.0, 0.0, 11.0, 11.0)), &mut outside, false, 1.0);
        // 1 - .5 + .5 = 1 against .5.
        assert!((inside.penalty - 2.0 * outside.penalty).abs() < 1e-12);
        assert!((inside.penalty - 0.393_469_340_287).abs() < 1e-9);
    }

    #[test]
    fn penalty_and_age_stay_in_their_bounds() {
        let p = parameters();
        let mut target = weak(0.0, 1000.0);
        (0..5).for_each(|_| age(&p, &mut target, false, 1.0));
        assert_eq!((target.penalty, target.age), (1.0, 60.0));
        target.global_fitness = 0.95;
        (0..500).for_each(|_| age(&p, &mut target, true, 1.0));
        assert_eq!((target.penalty, target.age), (0.0, 0.0));
    }
}
