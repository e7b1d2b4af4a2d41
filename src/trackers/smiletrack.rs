//! SMILEtrack: BoT-SORT whose embeddings refuse pairs instead of attracting them. Wang et al., "SMILEtrack: SiMIlarity
//! LEarning for Occlusion-Aware Multiple Object Tracking", 2022; as its program does it, the paper's cascade is not
//! there. Without embeddings it is BoT-SORT without them.

use super::TrackingAlgorithm;
use super::two_round::{Looks, TwoRound, two_round_parameters};
use crate::error::Error;
use crate::kalman::WidthHeight;

two_round_parameters! {
    /// Parameters of SMILEtrack.
    pub struct SmileTrackParameters {
        match_thresh = 0.8;
        use_camera_motion = true;
        /// Where both sides have an embedding: largest weighted sum of their cosine distance and the squared
        /// Mahalanobis distance of a pair in the first round.
        similarity_gate: f64 = 0.3, [0.0, 100.0], "", "";
        /// Weight of the cosine distance; the Mahalanobis distance has the rest.
        appearance_weight: f64 = 0.98, [0.0, 1.0], "", "lambda";
        /// Largest squared Mahalanobis distance of such a pair: the 95 % quantile of four degrees of freedom.
        gate: f64 = 9.4877, [0.0, 1e6], "", "";
        /// Share of the old embedding when a track learns a new one.
        feature_momentum: f64 = 0.9, [0.0, 1.0], "", "";
    }
}

impl SmileTrackParameters {
    /// Names of the presets, the default first.
    pub const PRESETS: &'static [&'static str] = &["default", "demo"];

    /// The values of a preset: `default` has the thresholds of the published evaluation, `demo` those of the published
    /// demonstration.
    pub fn preset(name: &str) -> Option<Self> {
        let defaults = Self::default();
        match name {
            "default" => Some(defaults),
            "demo" => Some(Self {
                track_high_thresh: 0.3,
                new_track_thresh: 0.4,
                track_buffer: 20,
                match_thresh: 0.7,
                ..defaults
            }),
            _ => None,
        }
    }

    /// A tracker with these parameters.
    pub fn build(&self) -> Result<Box<dyn TrackingAlgorithm>, Error> {
        let looks = Looks::Veto { limit: self.similarity_gate, weight: self.appearance_weight, gate: self.gate };
        let rules = self.shared_rules().with_looks(looks, self.feature_momentum);
        Ok(Box::new(TwoRound::<WidthHeight>::new(rules)))
    }
}
