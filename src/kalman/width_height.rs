//! Centre, width and height, with noise in shares of width and height: the filter of BoT-SORT, SMILEtrack and ConfTrack.

use nalgebra::{Matrix2, Vector2};

use super::{BoxFilter, NOISE_WEIGHTS, NoiseWeights, Plane};
use crate::frame::CameraMotion;
use crate::geometry::{Rect, State};

/// The filter.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct WidthHeight {
    centre: Plane,
    size: Plane,
    weights: NoiseWeights,
}

impl WidthHeight {
    /// At rest at a box.
    pub fn with_noise(s: &State, weights: NoiseWeights) -> Self {
        let size = Vector2::new(s.w, s.h);
        let (position, velocity) = (squares(size * 2.0 * weights.position), squares(size * 10.0 * weights.velocity));
        Self {
            centre: Plane::new(Vector2::new(s.u, s.v), position, velocity),
            size: Plane::new(size, position, velocity),
            weights,
        }
    }

    /// Takes a measured box whose variances are `factor` times the usual ones.
    pub fn correct_with(&mut self, s: &State, factor: f64) {
        let r = self.position_variances() * factor;
        self.centre.correct(Vector2::new(s.u, s.v), r);
        self.size.correct(Vector2::new(s.w, s.h), r);
    }

    /// Moves the centre along with the camera and leaves everything else.
    pub fn move_centre(&mut self, motion: &CameraMotion) {
        let (u, v) = motion.apply_point(self.centre.x.x, self.centre.x.y);
        self.centre.x = Vector2::new(u, v);
    }

    fn position_variances(&self) -> Vector2<f64> {
        squares(self.size.x * self.weights.position)
    }
}

impl BoxFilter for WidthHeight {
    fn new(rect: &Rect) -> Self {
        Self::with_noise(&State::from(*rect), NOISE_WEIGHTS)
    }

    fn predict(&mut self, dt: f64) {
        // Both from the size before the step.
        let (position, velocity) = (self.position_variances(), squares(self.size.x * self.weights.velocity));
        self.centre.predict(dt, position, velocity);
        self.size.predict(dt, position, velocity);
    }

    fn correct(&mut self, rect: &Rect) {
        self.correct_with(&State::from(*rect), 1.0);
    }

    fn stop_growth(&mut self) {
        self.size.v = Vector2::zeros();
    }

    /// The linear part turns centre and size, their velocities and the covariance alike.
    fn follow_camera(&mut self, motion: &CameraMotion) {
        let m = &motion.0;
        let map = Matrix2::new(m[0], m[1], m[3], m[4]);
        self.centre.turn(&map);
        self.size.turn(&map);
        self.centre.x += Vector2::new(m[2], m[5]);
    }

    fn state(&self) -> State {
        State::new(self.centre.x.x, self.centre.x.y, self.size.x.x, self.size.x.y)
    }

    fn velocity(&self) -> State {
        State::new(self.centre.v.x, self.centre.v.y, self.size.v.x, self.size.v.y)
    }

    fn gating_distance(&self, rect: &Rect) -> f64 {
        let (s, r) = (State::from(*rect), self.position_variances());
        self.centre.gating_distance(Vector2::new(s.u, s.v), r) + self.size.gating_distance(Vector2::new(s.w, s.h), r)
    }
}

fn squares(v: Vector2<f64>) -> Vector2<f64> {
    v.component_mul(&v)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_follows_the_size_before_the_step_and_the_camera_turns_size_like_a_vector() {
        // 40 x 80: standard deviations 4 and 8 at birth, 2 and 4 per frame; of velocities 2.5 and 5, and .25 and .5.
        let mut filter = WidthHeight::new(&Rect::new(80.0, 60.0, 40.0, 80.0));
        assert_eq!(filter.centre.xx, Matrix2::new(16.0, 0.0, 0.0, 64.0));
        filter.predict(1.0);
        assert_eq!(filter.centre.xx, Matrix2::new(16.0 + 6.25 + 4.0, 0.0, 0.0, 64.0 + 25.0 + 16.0));
        assert_eq!(filter.size.vv, Matrix2::new(6.25 + 0.0625, 0.0, 0.0, 25.0 + 0.25));
        // A detection 6 px to the right and 10 px taller: 36 / (26.25 + 4) and 100 / (105 + 16) of the size,
        // and the centre 5 px lower: 25 / 121.
        let distance = filter.gating_distance(&Rect::new(86.0, 60.0, 40.0, 90.0));
        assert!((distance - (36.0 / 30.25 + 100.0 / 121.0 + 25.0 / 121.0)).abs() < 1e-12, "{distance}");
        // The centre at (100, 100), twice as large, turned by 90 degrees and shifted.
        filter.follow_camera(&CameraMotion([0.0, -2.0, 7.0, 2.0, 0.0, 5.0]));
        assert_eq!(filter.state(), State::new(-193.0, 205.0, -160.0, 80.0));
        assert_eq!(filter.centre.xx, Matrix2::new(4.0 * 105.0, 0.0, 0.0, 4.0 * 26.25));
    }

    #[test]
    fn a_noisier_measurement_counts_less() {
        let mut filter = WidthHeight::new(&Rect::new(80.0, 60.0, 40.0, 80.0));
        // P = 16, R = 4 times 3: gain 16/28.
        filter.correct_with(&State::new(107.0, 100.0, 40.0, 80.0), 3.0);
        assert!((filter.state().u - 104.0).abs() < 1e-12);
    }
}
