//! Whether a lost track's predicted box is good enough to be reported.
//!
//! Tracks whose motion has proved predictable are; how many of the scene's predictions proved right when the target
//! was found again decides whether any are.

use super::parameters::GenTrack2Parameters;
use super::residual::SceneResidual;
use super::running_share::RunningShare;
use super::target::Target;

/// Longest loss, in ticks, that counts as evidence in full.
const LONGEST: f64 = 10.0;
/// Evidence assumed at the start, and the share of it that speaks for coasting.
const PRIOR: f64 = 20.0;
const PRIOR_SUCCESS: f64 = 0.6;
/// Growth of the residual that is feared per tick without a match.
const GROWTH: f64 = 0.1;
/// IoU of prediction and detection from which a prediction was right.
const RIGHT: f64 = 0.5;

/// The scene's record of predictions of lost tracks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct CoastRecord(RunningShare);

impl CoastRecord {
    /// Forgets a little.
    pub fn decay(&mut self, ticks: f64) {
        self.0.decay(ticks);
    }

    /// Learns from a lost track that was found again, before its update.
    pub fn found(&mut self, target: &Target, detected: &crate::geometry::Rect) {
        let weight = target.missed.min(LONGEST);
        let right = crate::geometry::Rect::from(target.predicted).iou(detected) >= RIGHT;
        self.0.learn(weight, right);
    }

    /// Learns from a track that was never found again.
    pub fn gone(&mut self, p: &GenTrack2Parameters, target: &Target) {
        if target.life.hits as i64 >= p.coast_hits {
            self.0.learn(target.missed.min(LONGEST), false);
        }
    }

    fn success(&self) -> f64 {
        self.0.value(PRIOR, PRIOR_SUCCESS)
    }
}

/// Whether a confirmed track without a detection is reported.
pub fn is_reported(p: &GenTrack2Parameters, target: &Target, scene: &SceneResidual, record: &CoastRecord) -> bool {
    if i64::from(target.missed_frames) <= p.report_missed {
        return true;
    }
    target.missed <= p.coast
        && i64::from(target.life.hits) >= p.coast_hits
        && target.residual.value(scene) * (1.0 + GROWTH * target.missed) <= p.coast_residual
        && record.success() >= p.coast_success
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Detection;
    use crate::geometry::Rect;

    fn lost(missed: u32, hits: u32) -> Target {
        let mut target = Target::born(&Detection::new(0.0, 0.0, 20.0, 20.0, 0.9), 0, 1);
        target.confirmed = true;
        (target.missed, target.missed_frames, target.life.hits) = (missed as f64, missed, hits);
        target
    }

    #[test]
    fn predictable_tracks_are_reported_longer() {
        let p = GenTrack2Parameters { coast_residual: 0.1, ..Default::default() };
        let (scene, record) = (SceneResidual::default(), CoastRecord::default());
        let reported = |missed, hits| is_reported(&p, &lost(missed, hits), &scene, &record);
        assert!(reported(1, 1));
        // The residual is the scene's .08: .08 * 1.2 = .096 at 2 ticks, .104 at 3.
        assert!(reported(2, 10));
        assert!(!reported(2, 9));
        assert!(!reported(3, 10));
    }

    #[test]
    fn a_record_of_wrong_predictions_stops_it() {
        let p = GenTrack2Parameters::default();
        let mut record = CoastRecord::default();
        assert_eq!(record.success(), 0.6);
        // Found elsewhere after 10 ticks: (12 + 0) / (20 + 10) = .4.
        record.found(&lost(10, 20), &Rect::new(500.0, 0.0, 20.0, 20.0));
        assert_eq!(record.success(), 0.4);
        assert!(!is_reported(&p, &lost(2, 20), &SceneResidual::default(), &record));
        // Found where it was predicted, twice: (12 + 20) / (20 + 30) = .64.
        for _ in 0..2 {
            record.found(&lost(10, 20), &Rect::new(0.0, 0.0, 20.0, 20.0));
        }
        assert_eq!(record.success(), 0.64);
        // One that was seen ten times and is gone: 32 / 60; a short-lived one does not count.
        record.gone(&p, &lost(30, 10));
        record.gone(&p, &lost(30, 9));
        assert!((record.success() - 32.0 / 60.0).abs() < 1e-12);
    }
}
