//! Constant-velocity Kalman filters of boxes, in the three forms that the compared trackers use.
//!
//! In each the box coordinates are independent of each other as long as no camera motion turns them, so that the 7- or
//! 8-dimensional filter of the literature falls apart into one small filter per coordinate ([`Axis`]), or per pair of
//! coordinates where the camera may turn them into each other ([`Plane`]). The numbers are the same but for rounding.
//!
//! | form | state | noise | used by |
//! |---|---|---|---|
//! | [`AreaRatio`] | centre, area, aspect ratio | fixed numbers | SORT, OC-SORT |
//! | [`AspectHeight`] | centre, aspect ratio, height | shares of the height | DeepSORT, ByteTrack |
//! | [`WidthHeight`] | centre, width, height | shares of width and height | BoT-SORT, SMILEtrack, ConfTrack |
//!
//! Time is in frames; a step of `dt` frames adds `dt` times the process noise of one.

mod area_ratio;
mod aspect_height;
mod axis;
mod plane;
mod width_height;

pub use area_ratio::{AreaRatio, Measurement};
pub use aspect_height::AspectHeight;
pub use axis::Axis;
pub use plane::Plane;
pub use width_height::WidthHeight;

use crate::frame::CameraMotion;
use crate::geometry::{Rect, State};

/// Largest absolute value of a coordinate; beyond it a box means nothing and arithmetic loses its digits.
const LARGEST: f64 = 1e13;

/// Shares of the box size by which coordinates and their velocities are uncertain (standard deviations).
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct NoiseWeights {
    /// Of a position, per frame and per measurement.
    pub position: f64,
    /// Of a velocity, per frame.
    pub velocity: f64,
}

/// The published values: 1/20 and 1/160.
pub const NOISE_WEIGHTS: NoiseWeights = NoiseWeights { position: 1.0 / 20.0, velocity: 1.0 / 160.0 };

/// What goes into snapshots: anything, in a build that has none.
#[cfg(feature = "snapshot")]
pub trait Kept: serde::Serialize + serde::de::DeserializeOwned {}
#[cfg(feature = "snapshot")]
impl<T: serde::Serialize + serde::de::DeserializeOwned> Kept for T {}

/// What goes into snapshots: anything, in a build that has none.
#[cfg(not(feature = "snapshot"))]
pub trait Kept {}
#[cfg(not(feature = "snapshot"))]
impl<T> Kept for T {}

/// What the two-round trackers need of a filter.
pub trait BoxFilter: Clone + Send + Kept {
    /// At rest at a detected box.
    fn new(rect: &Rect) -> Self;
    /// Moves on by `dt` frames.
    fn predict(&mut self, dt: f64);
    /// Takes a detected box.
    fn correct(&mut self, rect: &Rect);
    /// Stops the growth of a track that is not seen.
    fn stop_growth(&mut self);
    /// Goes along with the camera.
    fn follow_camera(&mut self, motion: &CameraMotion);
    /// Centre and size.
    fn state(&self) -> State;
    /// Change of centre and size per frame.
    fn velocity(&self) -> State;
    /// Squared Mahalanobis distance of a detected box, the measurement noise included.
    fn gating_distance(&self, rect: &Rect) -> f64;
}

/// Whether a state is one that a box can have; arithmetic on hostile input ends elsewhere.
pub fn is_sane(s: &State) -> bool {
    [s.u, s.v, s.w, s.h].iter().all(|x| x.abs() <= LARGEST)
}

/// The boxes of the specifications' numeric checkpoints, frames 1 to 9; nothing is seen in frames 5 and 6.
#[cfg(test)]
const CHECKPOINT: [Option<Rect>; 9] = [
    Some(Rect::new(100.0, 200.0, 50.0, 100.0)),
    Some(Rect::new(104.0, 201.0, 51.0, 102.0)),
    Some(Rect::new(109.0, 203.0, 50.0, 101.0)),
    Some(Rect::new(113.0, 204.0, 52.0, 103.0)),
    None,
    None,
    Some(Rect::new(130.0, 209.0, 53.0, 104.0)),
    Some(Rect::new(134.0, 210.0, 53.0, 105.0)),
    Some(Rect::new(138.5, 211.0, 53.0, 105.5)),
];
