//! Removal of expired tracks (eq. 15).

use super::parameters::GenTrack2Parameters;
use super::target::Target;

/// Largest size and coordinate of a state in pixels; beyond it a box means nothing and arithmetic loses its digits.
const LARGEST: f64 = 1e13;
/// Smallest width and height of a state in pixels.
pub const SMALLEST: f64 = 1e-6;

/// Whether a target is given up in this frame: it ends, unless it is still remembered.
pub fn is_given_up(p: &GenTrack2Parameters, target: &Target) -> bool {
    // Eq. 15.
    let aged = target.age >= p.max_age;
    let missed = target.blamed > p.max_missed;
    aged || missed || is_void(target)
}

/// Whether a target is nothing to be remembered.
pub fn is_void(target: &Target) -> bool {
    let unconfirmed_miss = !target.confirmed && target.missed > 0.0;
    unconfirmed_miss || !is_sane(target)
}

fn is_sane(target: &Target) -> bool {
    let s = &target.state;
    let finite = [s.u, s.v, s.w, s.h].iter().all(|x| x.abs() <= LARGEST);
    finite && s.w >= SMALLEST && s.h >= SMALLEST
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Detection;
    use crate::trackers::gentrack2::target::Match;

    fn weak(missed: f64) -> Target {
        let mut target = Target::born(&Detection::new(0.0, 0.0, 20.0, 20.0, 0.9), 0, 1);
        target.matched = Match::None;
        target.confirmed = true;
        (target.missed, target.blamed) = (missed, missed);
        target
    }

    #[test]
    fn equation_15_keeps_tracks_younger_than_the_maximum() {
        let p = GenTrack2Parameters { max_age: 60.0, ..Default::default() };
        let mut target = weak(5.0);
        target.age = 59.9;
        assert!(!is_given_up(&p, &target));
        target.age = 60.0;
        assert!(is_given_up(&p, &target));
    }

    #[test]
    fn misses_end_tracks_at_the_limit_and_tentative_ones_at_once() {
        let p = GenTrack2Parameters { max_missed: 30.0, ..Default::default() };
        assert!(!is_given_up(&p, &weak(30.0)));
        assert!(is_given_up(&p, &weak(31.0)));
        let mut young = weak(1.0);
        young.confirmed = false;
        assert!(is_given_up(&p, &young));
        young.missed = 0.0;
        assert!(!is_given_up(&p, &young));
    }

    #[test]
    fn states_that_mean_nothing_end() {
        let p = GenTrack2Parameters::default();
        for (u, w) in [(f64::NAN, 10.0), (1e14, 10.0), (0.0, 0.0), (0.0, 1e-7), (0.0, f64::INFINITY)] {
            let mut target = weak(1.0);
            (target.state.u, target.state.w) = (u, w);
            assert!(is_given_up(&p, &target), "{u} {w}");
        }
    }
}
