//! Centre, aspect ratio (width over height) and height, with noise in shares of the height: the filter of DeepSORT and
//! ByteTrack.

use super::{Axis, BoxFilter, NOISE_WEIGHTS};
use crate::frame::CameraMotion;
use crate::geometry::{Rect, State};

/// Standard deviations of the aspect ratio: at birth and per frame, ...
const ASPECT: f64 = 1e-2;
/// ... of its velocity, ...
const ASPECT_VELOCITY: f64 = 1e-5;
/// ... and of a measurement.
const ASPECT_MEASURED: f64 = 1e-1;

/// The filter.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct AspectHeight {
    u: Axis,
    v: Axis,
    aspect: Axis,
    height: Axis,
}

impl AspectHeight {
    fn position_variance(&self) -> f64 {
        square(NOISE_WEIGHTS.position * self.height.x)
    }

    /// How far the centre can be from a detection within a squared Mahalanobis distance.
    pub fn reach(&self, gate: f64) -> (f64, f64) {
        let r = self.position_variance();
        ((gate * (self.u.xx + r)).sqrt(), (gate * (self.v.xx + r)).sqrt())
    }
}

impl BoxFilter for AspectHeight {
    fn new(rect: &Rect) -> Self {
        let (s, w) = (State::from(*rect), NOISE_WEIGHTS);
        let (position, velocity) = (square(2.0 * w.position * s.h), square(10.0 * w.velocity * s.h));
        Self {
            u: Axis::new(s.u, position, velocity),
            v: Axis::new(s.v, position, velocity),
            aspect: Axis::new(s.w / s.h, square(ASPECT), square(ASPECT_VELOCITY)),
            height: Axis::new(s.h, position, velocity),
        }
    }

    fn predict(&mut self, dt: f64) {
        // Both from the height before the step.
        let position = self.position_variance();
        let velocity = square(NOISE_WEIGHTS.velocity * self.height.x);
        self.u.predict(dt, position, velocity);
        self.v.predict(dt, position, velocity);
        self.aspect.predict(dt, square(ASPECT), square(ASPECT_VELOCITY));
        self.height.predict(dt, position, velocity);
    }

    fn correct(&mut self, rect: &Rect) {
        let (s, r) = (State::from(*rect), self.position_variance());
        self.u.correct(s.u, r);
        self.v.correct(s.v, r);
        self.aspect.correct(s.w / s.h, square(ASPECT_MEASURED));
        self.height.correct(s.h, r);
    }

    fn stop_growth(&mut self) {
        self.height.v = 0.0;
    }

    fn follow_camera(&mut self, motion: &CameraMotion) {
        (self.u.x, self.v.x) = motion.apply_point(self.u.x, self.v.x);
        (self.u.v, self.v.v) = motion.apply_vector(self.u.v, self.v.v);
        let (kw, kh) = motion.size_factors();
        self.height.x *= kh;
        self.height.v *= kh;
        self.aspect.x *= kw / kh;
    }

    fn state(&self) -> State {
        State::new(self.u.x, self.v.x, self.aspect.x * self.height.x, self.height.x)
    }

    fn velocity(&self) -> State {
        let width = self.aspect.v * self.height.x + self.aspect.x * self.height.v;
        State::new(self.u.v, self.v.v, width, self.height.v)
    }

    fn gating_distance(&self, rect: &Rect) -> f64 {
        let (s, r) = (State::from(*rect), self.position_variance());
        self.u.gating_distance(s.u, r)
            + self.v.gating_distance(s.v, r)
            + self.aspect.gating_distance(s.w / s.h, square(ASPECT_MEASURED))
            + self.height.gating_distance(s.h, r)
    }
}

fn square(x: f64) -> f64 {
    x * x
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kalman::CHECKPOINT;

    /// The numeric checkpoint of the DeepSORT specification, section 10.
    #[test]
    fn checkpoint() {
        let mut filter = AspectHeight::new(&CHECKPOINT[0].unwrap());
        let check = |when: &str, filter: &AspectHeight| {
            let expected = match when {
                "2 predicted" => [125.0, 250.0, 0.5, 100.0, 0.0, 0.0, 0.0, 164.0625, 0.0002, 39.453125],
                "2" => [
                    128.904959, 251.735537, 0.5, 101.735537, 0.929752, 0.413223, 0.413223, 21.694215, 0.000196,
                    31.382361,
                ],
                "4" => [
                    138.124477, 255.152819, 0.500044, 102.599066, 3.220808, 1.226536, 0.494206, 19.574949, 0.000373,
                    13.117932,
                ],
                "7 predicted" => [
                    147.786901, 258.832426, 0.500044, 104.081683, 3.220808, 1.226536, 0.494206, 259.915176, 0.000673,
                    14.363446,
                ],
                "7" => [
                    155.677790, 260.795457, 0.500648, 104.007708, 4.658097, 1.584093, 0.480731, 24.526857, 0.000631,
                    6.553982,
                ],
                "9" => [
                    165.041562, 263.850331, 0.501032, 105.465577, 4.663980, 1.566088, 0.551491, 18.876775, 0.000724,
                    5.209810,
                ],
                _ => return,
            };
            let f = filter;
            let found = [f.u.x, f.v.x, f.aspect.x, f.height.x, f.u.v, f.v.v, f.height.v, f.u.xx, f.aspect.xx, f.u.vv];
            for (e, x) in expected.iter().zip(found) {
                assert!((e - x).abs() < 2e-6, "frame {when}: {found:?} instead of {expected:?}");
            }
        };
        for (frame, seen) in (2..).zip(&CHECKPOINT[1..]) {
            filter.predict(1.0);
            check(&format!("{frame} predicted"), &filter);
            if let Some(seen) = seen {
                if frame == 7 {
                    assert!((filter.gating_distance(seen) - 0.289502).abs() < 1e-6);
                }
                filter.correct(seen);
                check(&format!("{frame}"), &filter);
            }
        }
    }
}
