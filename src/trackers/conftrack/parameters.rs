//! The parameters of ConfTrack.

use crate::error::Error;
use crate::parameters::parameters;
use crate::trackers::TrackingAlgorithm;

parameters! {
    /// Parameters of ConfTrack.
    pub struct ConfTrackParameters {
        /// Detections of a lower score are ignored.
        track_low_thresh: f64 = 0.1, [0.0, 1.0], "", "";
        /// Detections of at least this score are matched first; the others second, with tracks that are not tentative.
        track_high_thresh: f64 = 0.6, [0.0, 1.0], "", "";
        /// Smallest score of a detection that starts a track.
        new_track_thresh: f64 = 0.1, [0.0, 1.0], "", "";
        /// Score of a match that confirms a tentative track at once. Below it a tentative track is of low confidence.
        confirm_thresh: f64 = 0.7, [0.0, 1.0], "", "";
        /// Matches in a row, the birth not counted, that confirm a tentative track.
        init_age: i64 = 3, [1, 1_000_000], "matches", "";
        /// Frames without a match that a confirmed track survives.
        max_age: i64 = 30, [0, 1_000_000], "frames", "";
        /// Share of its confidence that a track keeps per missed frame. As published; nothing depends on it, for only
        /// tentative tracks are asked for theirs, and they end with the first miss.
        confidence_decay: f64 = 0.9, [0.0, 1.0], "", "";
        /// Largest 1 - IoU of a pair in the first round.
        proximity_thresh: f64 = 0.6, [0.0, 0.99], "", "";
        /// Largest (1 - cosine)/2 of two embeddings that counts in the first round.
        appearance_thresh: f64 = 0.25, [0.0, 1.0], "", "";
        /// Largest cost of a pair in the first round. Leaving both sides unmatched costs as much.
        match_thresh: f64 = 0.8, [0.0, 1.0], "", "";
        /// The same in the second round: 1 - IoU with low scores.
        second_match_thresh: f64 = 0.5, [0.0, 1.0], "", "";
        /// Correct tracks by the less the lower the score: below weighting_thresh the detection is drawn to the
        /// prediction in proportion.
        confidence_weighting: bool = true, [], "", "CW";
        /// Score below which confidence_weighting acts.
        weighting_thresh: f64 = 0.6, [0.0, 1.0], "", "";
        /// Take a detection of a lower score for a noisier one.
        noise_scaling: bool = true, [], "", "NS";
        /// The noise of a detection of score 0, with noise_scaling, as a multiple of the usual one.
        noise_amplification: f64 = 100.0, [0.0, 1e6], "", "";
        /// Lost tracks keep their size.
        constant_size: bool = true, [], "", "CP";
        /// Cost counts in proportion to the detection's score in the first round.
        confidence_fusion: bool = true, [], "", "CF";
        /// Match tentative tracks of low confidence in a round of their own; without, they die.
        low_confidence_matching: bool = true, [], "", "LM";
        /// Largest 1 - IoU at which such a track is given up for a confirmed or lost one that was not seen.
        suppression_thresh: f64 = 0.7, [0.0, 1.0], "", "";
        /// Largest 1 - IoU of such a track and a detection of a high score left over.
        low_confidence_thresh: f64 = 0.3, [0.0, 1.0], "", "";
        /// Share of the old embedding when a track learns a new one.
        feature_momentum: f64 = 0.9, [0.0, 1.0], "", "";
        /// Largest width over height of a track that survives a miss.
        max_aspect: f64 = 1.6, [0.0, 1e6], "", "";
        /// Smallest area of a track that survives a miss.
        min_area: f64 = 100.0, [0.0, 1e12], "square pixels", "";
        /// Standard deviation of a position, per frame and per measurement.
        position_noise: f64 = 0.05, [1e-6, 10.0], "box widths and heights", "w_p";
        /// Standard deviation of a velocity, per frame.
        velocity_noise: f64 = 0.00625, [1e-9, 10.0], "box widths and heights/frame", "w_v";
        /// Whether tracks go along with the camera, where its motion is given.
        use_camera_motion: bool = true, [], "", "";
    }
}

impl ConfTrackParameters {
    /// Names of the presets, the default first.
    pub const PRESETS: &'static [&'static str] = &["default", "mot"];

    /// The values of a preset: `default` has all contributions of the paper on, `mot` what the published program does
    /// as it was shipped.
    pub fn preset(name: &str) -> Option<Self> {
        let defaults = Self::default();
        match name {
            "default" => Some(defaults),
            "mot" => Some(Self {
                new_track_thresh: 0.7,
                confidence_weighting: false,
                noise_scaling: false,
                constant_size: false,
                low_confidence_matching: false,
                ..defaults
            }),
            _ => None,
        }
    }

    /// A tracker with these parameters.
    pub fn build(&self) -> Result<Box<dyn TrackingAlgorithm>, Error> {
        Ok(Box::new(super::ConfTrack::new(self.clone())))
    }
}
