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
        let (x, y) = (to.u - from.u, to.v - from.v);
        let length = (x * x + y * y).sqrt() + EPSILON;
        Self { x: x / length, y: y / length }
    }

    /// Turns with the camera.
    pub fn turned(&self, motion: &CameraMotion) -> Self {
        let (x, y) = motion.apply_vector(self.x, self.y);
        let length = (x * x + y * y).sqrt() + EPSILON;
        Self { x: x / length, y: y / length }
    }
}

/// Where a track came from and which way it went.
#[derive(Clone, Copy, Debug)]
pub struct Heading {
    /// The observation looked back to.
    pub from: Rect,
    /// The track's direction.
    pub direction: Direction,
}

impl Heading {
    /// Whether a detection lies rather ahead than behind.
    pub fn faces(&self, detected: &Rect) -> bool {
        let (from, to) = (State::from(self.from), State::from(*detected));
        self.direction.x * (to.u - from.u) + self.direction.y * (to.v - from.v) > 0.0
    }

    /// How well a detection lies in the direction of the track, in `[-1/2, 1/2]`: straight on is 1/2, back is -1/2.
    pub fn consistency(&self, detected: &Rect) -> f64 {
        let towards = Direction::between(&self.from, detected);
        let cosine = self.direction.x * towards.x + self.direction.y * towards.y;
        // The library's own arc cosine has the same bits on every platform.
        (FRAC_PI_2 - libm::acos(cosine.clamp(-1.0, 1.0))) / PI
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straight_on_is_a_half_and_across_is_nothing() {
        let at = |x: f64, y: f64| Rect::new(x, y, 10.0, 10.0);
        let heading = Heading { from: at(0.0, 0.0), direction: Direction::between(&at(-30.0, 0.0), &at(0.0, 0.0)) };
        let near = |a: f64, b: f64| (a - b).abs() < 1e-3;
        assert!(near(heading.consistency(&at(40.0, 0.0)), 0.5));
        assert!(near(heading.consistency(&at(40.0, 40.0)), 0.25));
        assert!(near(heading.consistency(&at(0.0, 40.0)), 0.0));
        assert!(near(heading.consistency(&at(-40.0, 0.0)), -0.5));
        assert!(heading.faces(&at(40.0, 40.0)) && !heading.faces(&at(-1.0, 40.0)));
        // Where it was there is no direction.
        assert!(near(heading.consistency(&at(0.0, 0.0)), 0.0));
    }
}
