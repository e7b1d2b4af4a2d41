//! Covering: how much of a weak track lies behind tracks that have a detection in this frame. Behind another target
//! the detector cannot see it, so a miss says little about whether it is still there.

use crate::buffers::refill;
use crate::candidates::OverlapSweep;
use crate::geometry::Rect;

use super::target::Target;

/// Finds covered tracks, with buffers that are reused.
#[derive(Default)]
pub struct Covering {
    shares: Vec<f64>,
}

impl Covering {
    /// For each weak target the largest share of its box, in `[0, 1]`, that one strong target's box covers; 0 for
    /// strong targets.
    pub fn shares(&mut self, sweep: &mut OverlapSweep, targets: &[Target]) -> &[f64] {
        let boxes = |strong: bool| {
            let chosen = move |t: &Target| if t.is_strong() == strong { Rect::from(t.state) } else { Rect::default() };
            targets.iter().map(chosen)
        };
        let found = sweep.between(boxes(false), boxes(true));
        refill(&mut self.shares, targets.len(), 0.0);
        for &(weak, strong) in found.pairs {
            let (own, cover) = (&found.rows[weak as usize], &found.columns[strong as usize]);
            let share = &mut self.shares[weak as usize];
            *share = share.max(own.intersection(cover) / own.area());
        }
        &self.shares
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Detection;
    use crate::trackers::gentrack2::target::Match;

    #[test]
    fn the_share_is_of_the_weak_tracks_own_box_behind_the_best_strong_one() {
        let target = |left: f64, width: f64, strong: bool| {
            let mut target = Target::born(&Detection::new(left, 0.0, width, 20.0, 0.9), 0, 1);
            if !strong {
                target.matched = Match::None;
            }
            target
        };
        // The weak box 0..20 is covered from 5 on by a strong one and up to 4 by another: 15/20 and 4/20. A weak box
        // covers nothing.
        let targets = [
            target(0.0, 20.0, false),
            target(5.0, 100.0, true),
            target(-50.0, 54.0, true),
            target(0.0, 20.0, false),
            target(300.0, 20.0, false),
        ];
        assert_eq!(Covering::default().shares(&mut OverlapSweep::default(), &targets), [0.75, 0.0, 0.0, 0.75, 0.0]);
    }
}
