//! What all targets do at once is the camera's doing: the shift that strong tracks share beyond their own velocities.
//!
//! Where the camera moves and its motion is not given, velocities lag behind it. Tracks with a detection are put right
//! by that; unmatched ones are carried along by what the others show.

use super::median::OrderKey;
use super::target::Target;

/// Strong tracks from which what they agree on means the scene and not some of them.
const QUORUM: usize = 3;

/// Buffers of the shifts.
#[derive(Clone, Debug, Default)]
pub struct CommonMotion {
    shifts: Vec<OrderKey>,
}

impl CommonMotion {
    /// What most strong tracks agree on of how far their update moved them from their prediction, in pixels.
    pub fn shift(&mut self, targets: &[Target]) -> (f64, f64) {
        let strong = || targets.iter().filter(|t| t.is_strong() && t.motion_is_known());
        if strong().nth(QUORUM - 1).is_none() {
            return (0.0, 0.0);
        }
        let mut of = |get: fn(&Target) -> f64| {
            self.shifts.clear();
            self.shifts.extend(strong().map(|t| OrderKey::from(get(t))));
            agreed(&mut self.shifts)
        };
        (of(|t| t.state.u - t.predicted.u), of(|t| t.state.v - t.predicted.v))
    }
}

/// The quartile of the shifts nearer to 0, or 0 if that lies between them: noise about a still camera cancels out.
fn agreed(shifts: &mut [OrderKey]) -> f64 {
    shifts.sort_unstable();
    let aside = shifts.len() / 4;
    let (low, high) = (f64::from(shifts[aside]), f64::from(shifts[shifts.len() - 1 - aside]));
    low.max(0.0) + high.min(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Detection;
    use crate::trackers::gentrack2::target::Match;

    /// A strong track with a velocity that its update moved by `(u, v)` from its prediction.
    fn moved(u: f64, v: f64) -> Target {
        let mut target = Target::born(&Detection::new(10.0, 20.0, 30.0, 40.0, 0.9), 0, 1);
        target.life.hits = 3;
        target.predicted.u = target.state.u - u;
        target.predicted.v = target.state.v - v;
        target
    }

    #[test]
    fn the_shift_is_the_lesser_quartile_over_strong_tracks() {
        let mut unseen = moved(100.0, 100.0);
        unseen.matched = Match::None;
        let mut new = moved(100.0, 100.0);
        new.life.hits = 2;
        // Of four, sorted, the second and third: 4 and 5 to the right, 2 and 1 up.
        let targets = [moved(4.0, -1.0), unseen, moved(5.0, 0.0), new, moved(-20.0, -3.0), moved(6.0, -2.0)];
        assert_eq!(CommonMotion::default().shift(&targets), (4.0, -1.0));
    }

    #[test]
    fn where_they_disagree_the_camera_stands_still() {
        let targets = [moved(-3.0, -1.0), moved(-2.0, 4.0), moved(1.0, 5.0), moved(3.0, 6.0)];
        assert_eq!(CommonMotion::default().shift(&targets), (0.0, 4.0));
    }

    #[test]
    fn two_tracks_are_no_scene() {
        assert_eq!(CommonMotion::default().shift(&[moved(4.0, -1.0), moved(4.0, -1.0)]), (0.0, 0.0));
    }
}
