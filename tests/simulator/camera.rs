//! The camera: how the world lies in the image.

use super::affine::Affine;

/// A swing `amplitude * sin(2 pi hertz t)`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Swing {
    pub amplitude: f64,
    pub hertz: f64,
}

impl Swing {
    pub const fn new(amplitude: f64, hertz: f64) -> Self {
        Self { amplitude, hertz }
    }

    fn at(&self, t: f64) -> f64 {
        self.amplitude * libm::sin(2.0 * std::f64::consts::PI * self.hertz * t)
    }
}

/// A camera that swings; by default it stands still.
#[derive(Clone, Copy, Debug, Default)]
pub struct Camera {
    /// Pan in pixels.
    pub pan_x: Swing,
    pub pan_y: Swing,
    /// Rotation about the image centre in radians.
    pub rotation: Swing,
    /// Zoom about the image centre: the scale is 1 + swing.
    pub zoom: Swing,
}

impl Camera {
    pub fn moves(&self) -> bool {
        [self.pan_x, self.pan_y, self.rotation, self.zoom].iter().any(|s| s.amplitude != 0.0)
    }

    /// World to image at time `t`.
    pub fn at(&self, t: f64, width: u32, height: u32) -> Affine {
        if !self.moves() {
            return Affine::IDENTITY;
        }
        let (cx, cy) = (width as f64 / 2.0, height as f64 / 2.0);
        let angle = self.rotation.at(t);
        let scale = 1.0 + self.zoom.at(t);
        let (cos, sin) = (scale * libm::cos(angle), scale * libm::sin(angle));
        Affine([
            cos,
            -sin,
            cx - cos * cx + sin * cy + self.pan_x.at(t),
            sin,
            cos,
            cy - sin * cx - cos * cy + self.pan_y.at(t),
        ])
    }
}
