//! The parameters of OC-SORT.

use crate::error::Error;
use crate::parameters::{choice, only_default_preset, parameters};
use crate::trackers::TrackingAlgorithm;

choice! {
    /// How alike two boxes are; all in `[0, 1]`.
    pub enum Similarity {
        /// Intersection over union.
        Iou = "iou",
        /// IoU less the empty share of the smallest box around both, rescaled.
        Giou = "giou",
        /// IoU less the squared distance of the centres over that box's diagonal, rescaled.
        Diou = "diou",
        /// DIoU less a term for different aspect ratios, rescaled.
        Ciou = "ciou",
        /// One minus the distance of the centres over the largest of all pairs.
        CentreDistance = "centre_distance",
    }
}

parameters! {
    /// Parameters of OC-SORT.
    pub struct OcSortParameters {
        /// Detections of a greater score are high: they are matched first and start tracks. One of exactly this score
        /// is ignored.
        det_thresh: f64 = 0.6, [0.0, 1.0], "", "";
        /// Detections of a score between this one and det_thresh, both exclusive, are low; with use_byte they are
        /// matched second.
        low_thresh: f64 = 0.1, [0.0, 1.0], "", "";
        /// Frames without a match that a track survives.
        max_age: i64 = 30, [0, 1_000_000], "frames", "";
        /// Matches in a row, the birth not counted, from which a track is reported; also the number of first frames in
        /// which whatever is seen is reported.
        min_hits: i64 = 3, [0, 1_000_000], "matches", "";
        /// Smallest IoU, or similarity, of a pair. Where it is the IoU, boxes must overlap in any case.
        iou_threshold: f64 = 0.3, [0.0, 1.0], "", "";
        /// Frames by which directions of motion look back.
        delta_t: i64 = 3, [1, 1000], "frames", "";
        /// How alike boxes are in the rounds after the first, which has the IoU.
        asso_func: Similarity = Similarity::Iou, [], "", "";
        /// Weight of the direction of motion in the first round.
        inertia: f64 = 0.2, [0.0, 10.0], "", "";
        /// Whether tracks left over may take low scores.
        use_byte: bool = false, [], "", "";
        /// Whether tracks go along with the camera, where its motion is given. Not in the publication.
        use_camera_motion: bool = false, [], "", "";
    }
}
only_default_preset!(OcSortParameters);

impl OcSortParameters {
    /// A tracker with these parameters.
    pub fn build(&self) -> Result<Box<dyn TrackingAlgorithm>, Error> {
        Ok(Box::new(super::OcSort::new(self.clone())))
    }
}
