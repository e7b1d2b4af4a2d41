//! Directions of motion between observations (specifications: OC-SORT section 8).

use std::f64::consts::{FRAC_PI_2, PI};

use crate::frame::CameraMotion;
use crate::geometry::{Rect, State};

/// What directions are divided by is never 0.
const EPSILON: f64 = 1e-6;

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
    pub fn cosine(&self, detected: &Rect) -> f64 {
        let to = State::from(*detected);
        let towards = Direction::of(to.u - self.from.0, to.v - self.from.1);
        self.direction.x * towards.x + self.direction.y * towards.y
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
        assert!(heading.cosine(&at(40.0, 40.0)) > 0.0 && heading.cosine(&at(-1.0, 40.0)) < 0.0);
        // Where it was there is no direction.
        assert!(near(heading.consistency(&at(0.0, 0.0)), 0.0));
    }
}
