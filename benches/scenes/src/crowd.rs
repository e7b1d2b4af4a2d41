//! A crowd: boxes that walk about on a canvas and turn at its edges, are missed now and then, with clutter between them.

use gentrack2::Detection;

use crate::Video;
use crate::noise::Noise;

const MISSED: f64 = 0.1;
const CLUTTER: f64 = 0.05;
/// Jitter of a detected box, in pixels.
const JITTER: f64 = 1.0;

/// How large the canvas is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Canvas {
    /// 3840 x 2160 whatever the number of boxes: from 1000 on most boxes overlap others.
    Fixed,
    /// As large as it takes for 1000 boxes per 3840 x 2160.
    Growing,
}

impl Canvas {
    fn size(self, boxes: usize) -> (f64, f64) {
        let scale = match self {
            Canvas::Fixed => 1.0,
            Canvas::Growing => (boxes as f64 / 1000.0).sqrt(),
        };
        ((3840.0 * scale).round(), (2160.0 * scale).round())
    }
}

struct Walker {
    x: f64,
    y: f64,
    dx: f64,
    dy: f64,
    width: f64,
}

/// Makes the frames of a crowd.
pub struct Crowd {
    noise: Noise,
    size: (f64, f64),
    walkers: Vec<Walker>,
}

impl Crowd {
    /// So many boxes.
    pub fn new(boxes: usize, canvas: Canvas, seed: u64) -> Self {
        let (mut noise, size) = (Noise::new(seed), canvas.size(boxes));
        let walkers = (0..boxes)
            .map(|_| Walker {
                x: noise.between(0.0, size.0),
                y: noise.between(0.0, size.1),
                dx: noise.between(-4.0, 4.0),
                dy: noise.between(-2.0, 2.0),
                width: noise.between(30.0, 50.0),
            })
            .collect();
        Self { noise, size, walkers }
    }

    /// The detections of the next frame.
    pub fn frame(&mut self) -> Vec<Detection> {
        let (noise, (width, height)) = (&mut self.noise, self.size);
        let mut detections = Vec::with_capacity(self.walkers.len() * 11 / 10);
        let mut found = |noise: &mut Noise, x: f64, y: f64, w: f64| {
            let score = noise.between(0.62, 0.98);
            detections.push(Detection::new(x - 0.5 * w, y - 1.1 * w, w, 2.2 * w, score));
        };
        for walker in &mut self.walkers {
            walker.x += walker.dx;
            walker.y += walker.dy;
            if !(0.0..width).contains(&walker.x) {
                walker.dx = -walker.dx;
            }
            if !(0.0..height).contains(&walker.y) {
                walker.dy = -walker.dy;
            }
            let mut jitter = || noise.between(-JITTER, JITTER);
            let (x, y, w) = (walker.x + jitter(), walker.y + jitter(), walker.width + jitter());
            if !noise.happens(MISSED) {
                found(noise, x, y, w);
            }
        }
        for _ in 0..self.walkers.len() {
            if noise.happens(CLUTTER) {
                let (x, y, w) = (noise.between(0.0, width), noise.between(0.0, height), noise.between(30.0, 50.0));
                found(noise, x, y, w);
            }
        }
        detections
    }

    /// The next frames.
    pub fn video(&mut self, frames: usize) -> Video {
        let size = (self.size.0 as u32, self.size.1 as u32);
        Video { size, frames: (0..frames).map(|_| self.frame()).collect() }
    }
}
