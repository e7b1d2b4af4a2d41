//! ByteTrack: every detection box is associated, those of a high score first. Zhang et al., "ByteTrack: Multi-Object
//! Tracking by Associating Every Detection Box", ECCV 2022.

use super::TrackingAlgorithm;
use super::two_round::{TwoRound, two_round_parameters};
use crate::error::Error;
use crate::kalman::AspectHeight;
use crate::parameters::only_default_preset;

two_round_parameters! {
    /// Parameters of ByteTrack.
    pub struct ByteTrackParameters {
        match_thresh = 0.9;
        use_camera_motion = false;
    }
}
only_default_preset!(ByteTrackParameters);

impl ByteTrackParameters {
    /// A tracker with these parameters.
    pub fn build(&self) -> Result<Box<dyn TrackingAlgorithm>, Error> {
        Ok(Box::new(TwoRound::<AspectHeight>::new(self.shared_rules())))
    }
}
