//! Centre, area and aspect ratio (width over height; without a velocity), with fixed noise: the filter of SORT and
//! OC-SORT.

use super::Axis;
use crate::frame::CameraMotion;
use crate::geometry::{Rect, State};

/// Variance of centre, area and ratio at birth, and of the velocities.
const BIRTH: f64 = 10.0;
const BIRTH_VELOCITY: f64 = 1e4;
/// Process noise of all four coordinates, of the centre's velocity and of the area's, per frame.
const PROCESS: f64 = 1.0;
const PROCESS_VELOCITY: f64 = 0.01;
const PROCESS_AREA_VELOCITY: f64 = 0.0001;
/// Measurement noise of the centre and of area and ratio.
const MEASURED_CENTRE: f64 = 1.0;
const MEASURED_SHAPE: f64 = 10.0;

/// What is measured of a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement {
    /// Horizontal centre in px.
    pub u: f64,
    /// Vertical centre in px.
    pub v: f64,
    /// Area in square pixels.
    pub area: f64,
    /// Width over height.
    pub ratio: f64,
}

impl Measurement {
    /// Of a box; `epsilon` is added to the height in the ratio.
    pub fn of(rect: &Rect, epsilon: f64) -> Self {
        let s = State::from(*rect);
        Self { u: s.u, v: s.v, area: s.w * s.h, ratio: s.w / (s.h + epsilon) }
    }

    /// Centre and size.
    pub fn state(&self) -> State {
        let w = (self.area * self.ratio).sqrt();
        State::new(self.u, self.v, w, self.area / w)
    }
}

/// The filter.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct AreaRatio {
    u: Axis,
    v: Axis,
    area: Axis,
    ratio: Axis,
}

impl AreaRatio {
    /// At rest at a measured box.
    pub fn new(z: &Measurement) -> Self {
        Self {
            u: Axis::new(z.u, BIRTH, BIRTH_VELOCITY),
            v: Axis::new(z.v, BIRTH, BIRTH_VELOCITY),
            area: Axis::new(z.area, BIRTH, BIRTH_VELOCITY),
            ratio: Axis::new(z.ratio, BIRTH, 0.0),
        }
    }

    /// Stops an area that `dt` frames on would no longer be positive.
    pub fn clamp_area(&mut self, dt: f64) {
        if self.area.x + dt * self.area.v <= 0.0 {
            self.area.v = 0.0;
        }
    }

    /// Moves on by `dt` frames.
    pub fn predict(&mut self, dt: f64) {
        self.u.predict(dt, PROCESS, PROCESS_VELOCITY);
        self.v.predict(dt, PROCESS, PROCESS_VELOCITY);
        self.area.predict(dt, PROCESS, PROCESS_AREA_VELOCITY);
        self.ratio.predict(dt, PROCESS, 0.0);
    }

    /// Takes a measured box.
    pub fn correct(&mut self, z: &Measurement) {
        self.u.correct(z.u, MEASURED_CENTRE);
        self.v.correct(z.v, MEASURED_CENTRE);
        self.area.correct(z.area, MEASURED_SHAPE);
        self.ratio.correct(z.ratio, MEASURED_SHAPE);
    }

    /// Goes along with the camera: the centre as a point, the size by the map's scale.
    pub fn follow_camera(&mut self, motion: &CameraMotion) {
        (self.u.x, self.v.x) = motion.apply_point(self.u.x, self.v.x);
        (self.u.v, self.v.v) = motion.apply_vector(self.u.v, self.v.v);
        let (kw, kh) = motion.size_factors();
        self.area.x *= kw * kh;
        self.area.v *= kw * kh;
        self.ratio.x *= kw / kh;
    }

    /// Centre and size; not a number where area or ratio are not positive.
    pub fn state(&self) -> State {
        Measurement { u: self.u.x, v: self.v.x, area: self.area.x, ratio: self.ratio.x }.state()
    }

    /// Change of centre and size per frame: the area grows at a fixed ratio.
    pub fn velocity(&self) -> State {
        let growth = 0.5 * self.area.v / self.area.x;
        let s = self.state();
        State::new(self.u.v, self.v.v, s.w * growth, s.h * growth)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kalman::CHECKPOINT;

    /// The numeric checkpoint of the SORT specification, section 9.
    #[test]
    fn checkpoint() {
        let measured = |rect: &Rect| Measurement::of(rect, 0.0);
        let mut filter = AreaRatio::new(&measured(&CHECKPOINT[0].unwrap()));
        let expected: [(usize, [f64; 12]); 5] = [
            (
                2,
                [
                    129.499551,
                    251.999800,
                    5201.798423,
                    0.5,
                    4.494606,
                    1.997603,
                    201.576689,
                    0.999900,
                    9.990021,
                    5.238095,
                    11.995617,
                    20.956092,
                ],
            ),
            (
                4,
                [
                    138.923347,
                    255.445946,
                    5291.792976,
                    0.500302,
                    4.716281,
                    1.770414,
                    92.367142,
                    0.847083,
                    7.132717,
                    3.262201,
                    0.851101,
                    2.339416,
                ],
            ),
            (
                6,
                [
                    148.355909,
                    258.986775,
                    5476.527261,
                    0.500302,
                    4.716281,
                    1.770414,
                    92.367142,
                    7.994737,
                    30.526604,
                    5.262201,
                    0.871101,
                    2.339616,
                ],
            ),
            (
                7,
                [
                    156.273844,
                    260.983980,
                    5521.603704,
                    0.503888,
                    5.398505,
                    1.818740,
                    82.736952,
                    0.934023,
                    8.312013,
                    3.850771,
                    0.280715,
                    0.642405,
                ],
            ),
            (
                9,
                [
                    165.331902,
                    263.940414,
                    5627.659878,
                    0.503634,
                    5.123411,
                    1.710031,
                    73.704861,
                    0.689035,
                    4.771316,
                    2.990495,
                    0.196754,
                    0.305136,
                ],
            ),
        ];
        let mut checked = 0;
        for (frame, seen) in (2..).zip(&CHECKPOINT[1..]) {
            filter.clamp_area(1.0);
            filter.predict(1.0);
            if let Some(seen) = seen {
                filter.correct(&measured(seen));
            }
            let Some((_, expected)) = expected.iter().find(|(f, _)| *f == frame) else { continue };
            let AreaRatio { u, v, area, ratio } = filter;
            let found = [u.x, v.x, area.x, ratio.x, u.v, v.v, area.v, u.xx, area.xx, ratio.xx, u.vv, area.vv];
            for (e, x) in expected.iter().zip(found) {
                assert!((e - x).abs() < 2e-6, "frame {frame}: {found:?} instead of {expected:?}");
            }
            checked += 1;
        }
        assert_eq!(checked, 5);
    }

    #[test]
    fn an_area_that_would_vanish_stands_still() {
        let mut filter = AreaRatio::new(&Measurement::of(&Rect::new(0.0, 0.0, 2.0, 5.0), 0.0));
        filter.area.v = -10.0;
        filter.clamp_area(1.0);
        assert_eq!(filter.area.v, 0.0);
        filter.area.v = -6.0;
        filter.clamp_area(1.0);
        assert_eq!(filter.area.v, -6.0);
        filter.clamp_area(2.0);
        assert_eq!(filter.area.v, 0.0);
    }
}
