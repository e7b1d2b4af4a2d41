//! How many hidden targets come back, beyond the paper: it is a matter of the place.
//!
//! On a square people step out from behind others all the time. In front of a camera that moves along a street most of
//! those who went out of sight have been left behind, and whoever appears there is somebody else.

use super::parameters::GenTrack2Parameters;
use super::reacquisition::is_hidden;
use super::running_share::RunningShare;
use super::target::Target;

/// Time without a match, in ticks, from which on a target counts: who was missed for a moment comes back anywhere.
const GONE_FOR: f64 = 10.0;
/// Hidden targets assumed at the start, and the share of them that came back.
const PRIOR: f64 = 10.0;
const PRIOR_SHARE: f64 = 0.65;
/// Share of targets that come back at which the cost of time without a match is as it stands.
const USUAL_SHARE: f64 = 0.5;

/// The scene's record of hidden targets.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct ReturnRecord(RunningShare);

impl ReturnRecord {
    /// Forgets a little.
    pub fn decay(&mut self, ticks: f64) {
        self.0.decay(ticks);
    }

    /// Learns from a target that was found where it was expected, before its update. Who was reacquired proves nothing:
    /// that it is the same one is only supposed, because many come back.
    pub fn found(&mut self, target: &Target) {
        if counts(target) {
            self.0.learn(1.0, true);
        }
    }

    /// Learns from a target that was given up, within the image or outside: who was left behind is gone as well.
    pub fn gone(&mut self, target: &Target) {
        if counts(target) {
            self.0.learn(1.0, false);
        }
    }

    /// Share of the hidden that come back.
    fn share(&self) -> f64 {
        self.0.value(PRIOR, PRIOR_SHARE)
    }

    /// Whether so many come back that one who appears near a hidden target is asked whether it is this one.
    pub fn is_worth_asking(&self, p: &GenTrack2Parameters) -> bool {
        self.share() >= p.reacquire_returns
    }

    /// The cost per tick of time without a match: `lost_cost`, more where fewer come back.
    pub fn lost_cost(&self, p: &GenTrack2Parameters) -> f64 {
        let doubt = (1.0 - self.share()) / (1.0 - USUAL_SHARE);
        p.lost_cost * libm::pow(doubt, p.lost_cost_returns)
    }
}

fn counts(target: &Target) -> bool {
    is_hidden(target) && target.missed > GONE_FOR
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Detection;

    fn hidden(missed: f64, covered: f64) -> Target {
        let mut target = Target::born(&Detection::new(0.0, 0.0, 20.0, 20.0, 0.9), 0, 1);
        target.confirmed = true;
        target.life.hits = 50;
        (target.missed, target.covered) = (missed, covered);
        target
    }

    #[test]
    fn the_share_is_that_of_the_record_and_of_what_is_assumed() {
        let mut record = ReturnRecord::default();
        assert_eq!(record.share(), 0.65);
        for _ in 0..5 {
            record.found(&hidden(11.0, 0.5));
        }
        for _ in 0..10 {
            record.gone(&hidden(39.0, 1.0));
        }
        // (6.5 + 5) / (10 + 15).
        assert_eq!(record.share(), 0.46);
        let p = GenTrack2Parameters { reacquire_returns: 0.5, ..Default::default() };
        assert!(!record.is_worth_asking(&p) && ReturnRecord::default().is_worth_asking(&p));
        assert!(record.is_worth_asking(&GenTrack2Parameters { reacquire_returns: 0.0, ..p }));
        record.decay(1e6);
        assert_eq!(record.share(), 0.65);
    }

    #[test]
    fn only_the_hidden_who_were_gone_for_some_time_count() {
        let mut record = ReturnRecord::default();
        record.found(&hidden(10.0, 1.0));
        record.found(&hidden(20.0, 0.4));
        record.gone(&hidden(39.0, 0.0));
        let mut tentative = hidden(39.0, 1.0);
        tentative.confirmed = false;
        record.gone(&tentative);
        assert_eq!(record, ReturnRecord::default());
    }

    #[test]
    fn time_without_a_match_costs_more_where_fewer_come_back() {
        let p = GenTrack2Parameters { lost_cost: 0.01, lost_cost_returns: 0.5, ..Default::default() };
        let record = |back: f64, gone: f64| {
            let mut share = RunningShare::default();
            share.learn(back, true);
            share.learn(gone, false);
            ReturnRecord(share)
        };
        let of = |back: f64, gone: f64| record(back, gone).lost_cost(&p);
        // 15 of 20 come back: half the usual doubt; 11.5 of 23: all of it.
        assert!((of(8.5, 1.5) - 0.01 * (0.25f64 / 0.5).sqrt()).abs() < 1e-15, "{}", of(8.5, 1.5));
        assert!((of(5.0, 8.0) - 0.01).abs() < 1e-15);
        assert!(of(0.0, 50.0) > 0.01);
        let constant = GenTrack2Parameters { lost_cost_returns: 0.0, ..p };
        assert_eq!(record(0.0, 50.0).lost_cost(&constant), 0.01);
    }
}
