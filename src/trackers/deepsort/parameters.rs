//! The parameters of DeepSORT.

use crate::error::Error;
use crate::parameters::{only_default_preset, parameters};
use crate::trackers::TrackingAlgorithm;

parameters! {
    /// Parameters of DeepSORT.
    pub struct DeepSortParameters {
        /// Detections of a lower score are ignored. The publication leaves this to its user: give 0.6 or so where the
        /// detector reports weak ones, too.
        min_score: f64 = 0.0, [0.0, 1.0], "", "";
        /// Largest 1 - cosine of a detection's embedding and the most similar one in the track's gallery. Where there
        /// is nothing to compare, pairs within the gate are matched by their Mahalanobis distance.
        max_cosine_distance: f64 = 0.2, [0.0, 2.0], "", "";
        /// Most embeddings in a track's gallery; the oldest ones go. The publication's experiments have 100, its program by
        /// default no limit, which would let memory grow for as long as a track lives.
        nn_budget: i64 = 100, [1, 100_000], "embeddings", "";
        /// Largest 1 - IoU of a pair in the round without embeddings. Boxes must overlap in any case.
        max_iou_distance: f64 = 0.7, [0.0, 1.0], "", "";
        /// Frames without a match that a confirmed track survives; in the last of them it can no longer be matched.
        max_age: i64 = 30, [0, 1_000_000], "frames", "";
        /// Matches in a row, the birth counted, from which a track is confirmed. The birth alone never is enough.
        n_init: i64 = 3, [1, 1_000_000], "matches", "";
        /// Largest squared Mahalanobis distance of a pair that is compared by embeddings: the 95 % quantile of four
        /// degrees of freedom.
        gate: f64 = 9.4877, [0.001, 1e6], "", "";
        /// Whether tracks go along with the camera, where its motion is given. Not in the publication.
        use_camera_motion: bool = false, [], "", "";
    }
}
only_default_preset!(DeepSortParameters);

impl DeepSortParameters {
    /// A tracker with these parameters.
    pub fn build(&self) -> Result<Box<dyn TrackingAlgorithm>, Error> {
        Ok(Box::new(super::DeepSort::new(self.clone())))
    }
}
