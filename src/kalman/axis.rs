//! One coordinate that moves at a near-constant velocity.

/// Mean and covariance of a coordinate and its velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct Axis {
    /// The coordinate.
    pub x: f64,
    /// Its change per frame.
    pub v: f64,
    /// Variance of the coordinate.
    pub xx: f64,
    /// Covariance of both.
    pub xv: f64,
    /// Variance of the velocity.
    pub vv: f64,
}

impl Axis {
    /// At rest, with the variances of coordinate and velocity.
    pub fn new(x: f64, xx: f64, vv: f64) -> Self {
        Self { x, v: 0.0, xx, xv: 0.0, vv }
    }

    /// Moves on by `dt` frames; `qx` and `qv` are the process noise of one frame, as variances.
    pub fn predict(&mut self, dt: f64, qx: f64, qv: f64) {
        self.x += dt * self.v;
        self.xx += dt * (2.0 * self.xv + dt * self.vv) + dt * qx;
        self.xv += dt * self.vv;
        self.vv += dt * qv;
    }

    /// Takes a measurement of the coordinate with variance `r`.
    pub fn correct(&mut self, z: f64, r: f64) {
        let s = self.xx + r;
        let (gain_x, gain_v) = (self.xx / s, self.xv / s);
        let innovation = z - self.x;
        self.x += gain_x * innovation;
        self.v += gain_v * innovation;
        self.vv -= gain_v * self.xv;
        // (1 - K) P, in a form that cannot become negative.
        let rest = r / s;
        self.xx *= rest;
        self.xv *= rest;
    }

    /// Squared Mahalanobis distance of a measurement with variance `r`.
    pub fn gating_distance(&self, z: f64, r: f64) -> f64 {
        let innovation = z - self.x;
        innovation * innovation / (self.xx + r)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_and_a_measurement_by_hand() {
        // x 10, v 0, variances 4 and 1; one frame with noise 1 and .5: xx = 4 + 1 + 1 = 6, xv = 1, vv = 1.5.
        let mut axis = Axis::new(10.0, 4.0, 1.0);
        axis.predict(1.0, 1.0, 0.5);
        assert_eq!(axis, Axis { x: 10.0, v: 0.0, xx: 6.0, xv: 1.0, vv: 1.5 });
        // s = 6 + 2 = 8, innovation 4: gains 3/4 and 1/8.
        assert_eq!(axis.gating_distance(14.0, 2.0), 2.0);
        axis.correct(14.0, 2.0);
        assert_eq!(axis, Axis { x: 13.0, v: 0.5, xx: 1.5, xv: 0.25, vv: 1.375 });
    }

    #[test]
    fn the_mean_and_its_noise_do_not_depend_on_how_time_is_cut() {
        let start = Axis { x: 1.0, v: 2.0, xx: 3.0, xv: 0.5, vv: 0.25 };
        let (mut whole, mut halves) = (start, start);
        whole.predict(2.0, 0.0, 0.0);
        halves.predict(1.0, 0.0, 0.0);
        halves.predict(1.0, 0.0, 0.0);
        assert_eq!(whole, halves);
        assert_eq!(whole.x, 5.0);
    }
}
