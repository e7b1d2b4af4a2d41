//! Two coordinates that move at near-constant velocities and that a camera may turn into each other.

use nalgebra::{Matrix2, Vector2};

/// Mean and covariance of two coordinates and their velocities.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct Plane {
    /// The coordinates.
    pub x: Vector2<f64>,
    /// Their change per frame.
    pub v: Vector2<f64>,
    /// Covariance of the coordinates.
    pub xx: Matrix2<f64>,
    /// Covariance of coordinates (rows) and velocities (columns).
    pub xv: Matrix2<f64>,
    /// Covariance of the velocities.
    pub vv: Matrix2<f64>,
}

impl Plane {
    /// At rest, with the variances of coordinates and velocities.
    pub fn new(x: Vector2<f64>, xx: Vector2<f64>, vv: Vector2<f64>) -> Self {
        let (xx, vv) = (Matrix2::from_diagonal(&xx), Matrix2::from_diagonal(&vv));
        Self { x, v: Vector2::zeros(), xx, xv: Matrix2::zeros(), vv }
    }

    /// Moves on by `dt` frames; `qx` and `qv` are the process noise of one frame, as variances.
    pub fn predict(&mut self, dt: f64, qx: Vector2<f64>, qv: Vector2<f64>) {
        self.x += self.v * dt;
        self.xx += (self.xv + self.xv.transpose() + self.vv * dt) * dt + Matrix2::from_diagonal(&(qx * dt));
        self.xv += self.vv * dt;
        self.vv += Matrix2::from_diagonal(&(qv * dt));
    }

    /// Takes a measurement of both coordinates with variances `r`.
    pub fn correct(&mut self, z: Vector2<f64>, r: Vector2<f64>) {
        let inverse = self.inverse_innovation(r);
        let (gain_x, gain_v) = (self.xx * inverse, self.xv.transpose() * inverse);
        let innovation = z - self.x;
        self.x += gain_x * innovation;
        self.v += gain_v * innovation;
        self.vv = symmetric(self.vv - gain_v * self.xv);
        self.xv -= gain_x * self.xv;
        self.xx = symmetric(self.xx - gain_x * self.xx);
    }

    /// Squared Mahalanobis distance of a measurement with variances `r`.
    pub fn gating_distance(&self, z: Vector2<f64>, r: Vector2<f64>) -> f64 {
        let innovation = z - self.x;
        innovation.dot(&(self.inverse_innovation(r) * innovation))
    }

    /// Applies a linear map to coordinates and velocities.
    pub fn turn(&mut self, map: &Matrix2<f64>) {
        let back = map.transpose();
        self.x = map * self.x;
        self.v = map * self.v;
        for block in [&mut self.xx, &mut self.xv, &mut self.vv] {
            *block = map * *block * back;
        }
        self.xx = symmetric(self.xx);
        self.vv = symmetric(self.vv);
    }

    /// Of a singular matrix there is no inverse; the numbers that come out are then not finite, as with a division by
    /// 0, and the track ends.
    fn inverse_innovation(&self, r: Vector2<f64>) -> Matrix2<f64> {
        let s = self.xx + Matrix2::from_diagonal(&r);
        let determinant = s.m11 * s.m22 - s.m12 * s.m21;
        Matrix2::new(s.m22, -s.m12, -s.m21, s.m11) / determinant
    }
}

/// Rounding makes a covariance a little less than symmetric, and what is left of that would grow from frame to frame.
fn symmetric(m: Matrix2<f64>) -> Matrix2<f64> {
    let across = 0.5 * (m.m12 + m.m21);
    Matrix2::new(m.m11, across, across, m.m22)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kalman::Axis;

    /// Coordinate `i` of a plane whose coordinates are independent.
    fn axis(p: &Plane, i: usize) -> Axis {
        Axis { x: p.x[i], v: p.v[i], xx: p.xx[(i, i)], xv: p.xv[(i, i)], vv: p.vv[(i, i)] }
    }

    fn near(a: &Axis, b: &Axis) -> bool {
        let pairs = [(a.x, b.x), (a.v, b.v), (a.xx, b.xx), (a.xv, b.xv), (a.vv, b.vv)];
        pairs.iter().all(|(x, y)| (x - y).abs() < 1e-12)
    }

    #[test]
    fn independent_coordinates_are_two_axes() {
        let mut plane = Plane::new(Vector2::new(10.0, 20.0), Vector2::new(4.0, 9.0), Vector2::new(1.0, 0.5));
        let mut axes = [Axis::new(10.0, 4.0, 1.0), Axis::new(20.0, 9.0, 0.5)];
        for z in [[12.0, 19.0], [13.5, 17.0], [15.0, 16.0]] {
            plane.predict(1.5, Vector2::new(1.0, 2.0), Vector2::new(0.1, 0.2));
            axes[0].predict(1.5, 1.0, 0.1);
            axes[1].predict(1.5, 2.0, 0.2);
            let (z, r) = (Vector2::new(z[0], z[1]), Vector2::new(2.0, 3.0));
            let distance = axes[0].gating_distance(z[0], 2.0) + axes[1].gating_distance(z[1], 3.0);
            assert!((plane.gating_distance(z, r) - distance).abs() < 1e-12);
            plane.correct(z, r);
            axes[0].correct(z[0], 2.0);
            axes[1].correct(z[1], 3.0);
        }
        assert!(near(&axis(&plane, 0), &axes[0]) && near(&axis(&plane, 1), &axes[1]), "{plane:?} {axes:?}");
        assert_eq!((plane.xx.m12, plane.xv.m12, plane.vv.m12), (0.0, 0.0, 0.0));
    }

    /// `tests/long_run.rs` shows what comes of it otherwise.
    #[test]
    fn the_covariance_stays_symmetric() {
        let mut plane = Plane::new(Vector2::new(10.0, 20.0), Vector2::new(4.0, 9.0), Vector2::new(1.0, 0.5));
        let turn = Matrix2::new(1.0, -0.3, 0.3, 0.9);
        for frame in 0..20 {
            plane.predict(1.0, Vector2::new(2.0, 1.0), Vector2::new(0.2, 0.1));
            plane.turn(&turn);
            plane.correct(Vector2::new(-19.0, 12.0), Vector2::new(3.0, 2.0));
            assert_eq!((plane.xx.m12, plane.vv.m12), (plane.xx.m21, plane.vv.m21), "frame {frame}");
        }
        assert!(plane.xx.m12 != 0.0);
    }

    #[test]
    fn what_is_turned_by_the_camera_is_filtered_as_if_the_world_were_turned() {
        // A quarter turn swaps the axes; doing it before or after a frame is the same.
        let turn = Matrix2::new(0.0, -1.0, 1.0, 0.0);
        let start = Plane::new(Vector2::new(10.0, 20.0), Vector2::new(4.0, 9.0), Vector2::new(1.0, 0.5));
        let (mut first, mut last) = (start, start);
        first.turn(&turn);
        first.predict(1.0, Vector2::new(2.0, 1.0), Vector2::new(0.2, 0.1));
        first.correct(Vector2::new(-19.0, 12.0), Vector2::new(3.0, 2.0));
        last.predict(1.0, Vector2::new(1.0, 2.0), Vector2::new(0.1, 0.2));
        last.correct(Vector2::new(12.0, 19.0), Vector2::new(2.0, 3.0));
        last.turn(&turn);
        assert!((first.x - last.x).norm() + (first.v - last.v).norm() < 1e-12);
        let covariances = [(first.xx, last.xx), (first.xv, last.xv), (first.vv, last.vv)];
        assert!(covariances.iter().all(|(a, b)| (a - b).norm() < 1e-12));
    }
}
