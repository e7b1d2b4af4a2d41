//! How well a track's motion is predicted: the running size of prediction errors, relative to the box.
//!
//! A track that has been seen little borrows from the scene: its own mean square is weighed against the scene's.

use crate::frame::Detection;
use crate::geometry::State;

use super::target::Target;

/// Largest squared error that counts: one wild detection must not outweigh a history.
const LARGEST_SQUARE: f64 = 0.25;
/// Slowest rate of the track's running mean.
const TRACK_RATE: f64 = 0.1;
/// Matches at which the scene still weighs as much as the track, and the most that are counted.
const TRACK_MEMORY: u32 = 30;
/// Score from which a box is trusted to measure errors with.
const SURE: f64 = 0.5;
/// Rate of the scene's running mean.
const SCENE_RATE: f64 = 0.01;

/// A track's running mean square error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct Residual {
    mean_square: f64,
    count: u32,
}

/// The scene's running mean square error.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct SceneResidual(f64);

impl SceneResidual {
    /// 8 % of the diagonal: pedestrians under a good detector at 30 frames/s.
    pub const UNKNOWN: Self = Self(0.08 * 0.08);
}

impl Default for SceneResidual {
    fn default() -> Self {
        Self::UNKNOWN
    }
}

impl Residual {
    /// Learns from the error of a prediction.
    pub fn learn(&mut self, scene: &mut SceneResidual, error: &State) {
        let size = error.norm();
        let square = (size * size).min(LARGEST_SQUARE);
        let rate = TRACK_RATE.max(1.0 / (self.count + 1) as f64);
        self.mean_square += rate * (square - self.mean_square);
        self.count = (self.count + 1).min(TRACK_MEMORY);
        scene.0 += SCENE_RATE * (square - scene.0);
    }

    /// Root mean square error in box diagonals.
    pub fn value(&self, scene: &SceneResidual) -> f64 {
        let (own, shared) = (self.count as f64, TRACK_MEMORY as f64);
        ((own * self.mean_square + shared * scene.0) / (own + shared)).sqrt()
    }
}

/// What a prediction missed its detection by, in their mean diagonal.
pub fn error(predicted: &State, detected: &State) -> State {
    (*detected - *predicted) * (2.0 / (predicted.diagonal() + detected.diagonal()))
}

/// Whether a match, before its update, says something about predictability: the track has a velocity, was not lost,
/// and the detector is sure of the box.
pub fn is_telling(target: &Target, detection: &Detection) -> bool {
    target.life.hits >= 2 && target.missed == 0.0 && detection.score >= SURE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_track_is_as_predictable_as_the_scene() {
        assert_eq!(Residual::default().value(&SceneResidual::default()), 0.08);
    }

    #[test]
    fn one_error_is_weighed_against_thirty_of_the_scene() {
        // 30 x 40 boxes (diagonal 50), 5 px apart: error 0.1, square 0.01; the first rate is 1/1, so the track's
        // mean is 0.01. The scene's moves from .0064 by .01 * (.01 - .0064) to .006436.
        let mut scene = SceneResidual::default();
        let mut residual = Residual::default();
        let a = State::new(0.0, 0.0, 30.0, 40.0);
        residual.learn(&mut scene, &error(&a, &State::new(3.0, 4.0, 30.0, 40.0)));
        let expected = ((0.01 + 30.0 * 0.006436) / 31.0f64).sqrt();
        assert!((residual.value(&scene) - expected).abs() < 1e-12);
    }

    #[test]
    fn wild_errors_are_clipped() {
        // An error of 20 diagonals counts as .5 diagonals.
        let mut scene = SceneResidual::default();
        let mut residual = Residual::default();
        let a = State::new(0.0, 0.0, 30.0, 40.0);
        residual.learn(&mut scene, &error(&a, &State::new(1000.0, 0.0, 30.0, 40.0)));
        assert_eq!(residual.mean_square, 0.25);
    }
}
