//! BoT-SORT: ByteTrack's rounds with a filter of width and height, camera motion, and embeddings. Aharon et al.,
//! "BoT-SORT: Robust Associations Multi-Pedestrian Tracking", 2022.

use super::TrackingAlgorithm;
use super::two_round::{Looks, TwoRound, two_round_parameters};
use crate::error::Error;
use crate::kalman::WidthHeight;
use crate::parameters::only_default_preset;

two_round_parameters! {
    /// Parameters of BoT-SORT.
    pub struct BotSortParameters {
        match_thresh = 0.8;
        use_camera_motion = true;
        /// Largest 1 - IoU of a pair whose embeddings count. They can make a pair cheaper, never dearer.
        proximity_thresh: f64 = 0.5, [0.0, 0.99], "", "";
        /// Largest (1 - cosine)/2 of two embeddings that counts.
        appearance_thresh: f64 = 0.25, [0.0, 1.0], "", "";
        /// Share of the old embedding when a track learns a new one.
        feature_momentum: f64 = 0.9, [0.0, 1.0], "", "";
    }
}
only_default_preset!(BotSortParameters);

impl BotSortParameters {
    /// A tracker with these parameters.
    pub fn build(&self) -> Result<Box<dyn TrackingAlgorithm>, Error> {
        let looks = Looks::Attract { proximity: self.proximity_thresh, threshold: self.appearance_thresh };
        let rules = self.shared_rules().with_looks(looks, self.feature_momentum);
        Ok(Box::new(TwoRound::<WidthHeight>::new(rules)))
    }
}
