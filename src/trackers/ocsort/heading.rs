//! Directions of motion between observations (specifications: OC-SORT section 8).

use std::f64::consts::{FRAC_PI_2, PI};

use crate::frame::CameraMotion;
use crate::geometry::{Rect, State};

/// What directions are divided by is never 0.
const EPSILON: f64 = 1e-6;

/// What leaves room for rounding in a comparison of squares.
const SURELY: f64 = 1.0 - 1e-9;

/// A direction, of length 1 but for points that coincide.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct Direction {
    x: f64,
    y: f64,
}

impl Direction {
    /// From the centre of one box to that of another.
    pub fn between(from: &Rect, to: &Rect) -> Self {
        let (from, to) = (State::from(*from), State::from(*to));
        Self::of(to.u - from.u, to.v - from.v)
    }

    /// Of a vector.
    fn of(x: f64, y: f64) -> Self {
        let length = (x * x + y * y).sqrt() + EPSILON;
        Self { x: x / length, y: y / length }
    }

    /// Turns with the camera.
    pub fn turned(&self, motion: &CameraMotion) -> Self {
        let (x, y) = motion.apply_vector(self.x, self.y);
        Self::of(x, y)
    }
}

/// Where a track came from and which way it went.
#[derive(Clone, Copy, Debug)]
pub struct Heading {
    /// Centre of the observation looked back to.
    from: (f64, f64),
    direction: Direction,
}

impl Heading {
    /// Of a track that went in this direction, seen from an earlier observation.
    pub fn new(from: &Rect, direction: Direction) -> Self {
        let from = State::from(*from);
        Self { from: (from.u, from.v), direction }
    }

    /// Cosine of the angle between the track's direction and the one to the detection.
    fn cosine(&self, detected: &Rect) -> f64 {
        let (x, y) = self.way_to(detected);
        let towards = Direction::of(x, y);
        self.direction.x * towards.x + self.direction.y * towards.y
    }

    /// The same if it exceeds a limit that is not negative.
    pub fn cosine_above(&self, detected: &Rect, limit: f64) -> Option<f64> {
        let (x, y) = self.way_to(detected);
        let along = self.direction.x * x + self.direction.y * y;
        // Most do not by far, which is told without a root; with the sign kept there is one branch, and hardly ever taken.
        if along * along.abs() < SURELY * limit * limit * (x * x + y * y) {
            return None;
        }
        Some(self.cosine(detected)).filter(|cosine| *cosine > limit)
    }

    fn way_to(&self, detected: &Rect) -> (f64, f64) {
        let to = State::from(*detected);
        (to.u - self.from.0, to.v - self.from.1)
    }

    /// How well a detection lies in the direction of the track, in `[-1/2, 1/2]`: straight on is 1/2, back is -1/2.
    pub fn consistency(&self, detected: &Rect) -> f64 {
        // The library's own arc cosine has the same bits on every platform.
        (FRAC_PI_2 - libm::acos(self.cosine(detected).clamp(-1.0, 1.0))) / PI
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straight_on_is_a_half_and_across_is_nothing() {
        let at = |x: f64, y: f64| Rect::new(x, y, 10.0, 10.0);
        let heading = Heading::new(&at(0.0, 0.0), Direction::between(&at(-30.0, 0.0), &at(0.0, 0.0)));
        let near = |a: f64, b: f64| (a - b).abs() < 1e-3;
        assert!(near(heading.consistency(&at(40.0, 0.0)), 0.5));
        assert!(near(heading.consistency(&at(40.0, 40.0)), 0.25));
        assert!(near(heading.consistency(&at(0.0, 40.0)), 0.0));
        assert!(near(heading.consistency(&at(-40.0, 0.0)), -0.5));
        for (x, y) in [(40.0, 40.0), (-1.0, 40.0), (40.0, 0.0), (3.0, -40.0), (0.0, 0.0)] {
            let cosine = heading.cosine(&at(x, y));
            for limit in [0.0, 0.05, 0.7, cosine.max(0.0), (cosine - 1e-12).max(0.0)] {
                assert_eq!(heading.cosine_above(&at(x, y), limit), Some(cosine).filter(|c| *c > limit));
            }
        }
        // Where it was there is no direction.
        assert!(near(heading.consistency(&at(0.0, 0.0)), 0.0));
    }
}
