//! Draws a scene into an 8-bit grey image: smooth textures sampled at sub-pixel positions, anti-aliased edges, nearer
//! objects over farther ones, a little sensor noise.

use gentrack2::Rect;

use super::noise::Noise;
use super::scene::{Object, Scene};

/// How far the background reaches beyond the image, in pixels; beyond that its edge is repeated.
const MARGIN: usize = 200;
const SENSOR_NOISE_LENGTH: usize = 1 << 16;

/// A grey picture that can be sampled between its pixels.
struct Picture {
    width: usize,
    height: usize,
    pixels: Vec<f32>,
}

impl Picture {
    /// Two layers of smoothed random dots, `cell` and `cell / 3` pixels apart, around `base`.
    fn texture(width: usize, height: usize, cell: f64, base: f64, contrast: f64, noise: &mut Noise) -> Self {
        let mut pixels = vec![base as f32; width * height];
        for (pitch, share) in [(cell, 0.65), (cell / 3.0, 0.35)] {
            let (columns, rows) = ((width as f64 / pitch) as usize + 2, (height as f64 / pitch) as usize + 2);
            let dots = Picture {
                width: columns,
                height: rows,
                pixels: (0..columns * rows).map(|_| noise.between(-1.0, 1.0) as f32).collect(),
            };
            for y in 0..height {
                for x in 0..width {
                    let value = dots.sample((x as f64 / pitch + 0.5) as f32, (y as f64 / pitch + 0.5) as f32);
                    pixels[y * width + x] += (contrast * share) as f32 * value;
                }
            }
        }
        Self { width, height, pixels }
    }

    /// Bilinear; pixel centres lie at halves, outside the edge is repeated.
    fn sample(&self, x: f32, y: f32) -> f32 {
        let x = (x - 0.5).clamp(0.0, (self.width - 1) as f32);
        let y = (y - 0.5).clamp(0.0, (self.height - 1) as f32);
        let (column, row) = ((x as usize).min(self.width.max(2) - 2), (y as usize).min(self.height.max(2) - 2));
        let (fx, fy) = (x - column as f32, y - row as f32);
        let top = &self.pixels[row * self.width + column..];
        let bottom = &top[self.width..];
        let upper = top[0] + fx * (top[1] - top[0]);
        let lower = bottom[0] + fx * (bottom[1] - bottom[0]);
        upper + fy * (lower - upper)
    }
}

pub struct Renderer {
    background: Picture,
    /// The background as a still camera sees it.
    still: Option<Vec<u8>>,
    textures: Vec<Picture>,
    sensor_noise: Vec<i8>,
    noise: Noise,
}

impl Renderer {
    pub fn new(scene: &Scene) -> Self {
        let mut noise = Noise::new(scene.seed, 2);
        let (width, height) = (scene.width as usize + 2 * MARGIN, scene.height as usize + 2 * MARGIN);
        let background = Picture::texture(width, height, 30.0, 120.0, 60.0, &mut noise);
        let textures = scene.objects.iter().map(|o| object_texture(o, &mut noise)).collect();
        let sensor_noise = (0..SENSOR_NOISE_LENGTH).map(|_| (2.0 * noise.bell()).round() as i8).collect();
        Self { background, still: None, textures, sensor_noise, noise }
    }

    /// The image at time `t`, packed GRAY8.
    pub fn render(&mut self, scene: &Scene, t: f64) -> Vec<u8> {
        let mut image = match &self.still {
            Some(still) => still.clone(),
            None => self.draw_background(scene, t),
        };
        if !scene.camera.moves() && self.still.is_none() {
            self.still = Some(image.clone());
        }
        let mut order: Vec<usize> = (0..scene.objects.len()).collect();
        order.sort_by(|&a, &b| scene.objects[b].depth.total_cmp(&scene.objects[a].depth));
        for object in order {
            if let Some(rect) = scene.objects[object].world_rect(t) {
                draw(&mut image, scene, t, &rect, &self.textures[object]);
            }
        }
        self.add_sensor_noise(&mut image);
        image
    }

    fn draw_background(&self, scene: &Scene, t: f64) -> Vec<u8> {
        let inverse = scene.world_to_image(t).inverse();
        let (dx, dy) = (inverse.0[0] as f32, inverse.0[3] as f32);
        let mut image = Vec::with_capacity((scene.width * scene.height) as usize);
        for row in 0..scene.height {
            let (x, y) = inverse.apply(0.5, row as f64 + 0.5);
            let (x, y) = (x as f32 + MARGIN as f32, y as f32 + MARGIN as f32);
            image.extend((0..scene.width).map(|c| self.background.sample(x + c as f32 * dx, y + c as f32 * dy) as u8));
        }
        image
    }

    fn add_sensor_noise(&mut self, image: &mut [u8]) {
        for line in image.chunks_mut(SENSOR_NOISE_LENGTH / 2) {
            let start = self.noise.below(SENSOR_NOISE_LENGTH / 2);
            for (pixel, noise) in line.iter_mut().zip(&self.sensor_noise[start..]) {
                *pixel = pixel.saturating_add_signed(*noise);
            }
        }
    }
}

/// Dots of about a sixth of the width, as clothes have, around the object's own brightness.
fn object_texture(object: &Object, noise: &mut Noise) -> Picture {
    let base = noise.between(90.0, 170.0);
    let (width, height) = (object.width.ceil() as usize, object.height.ceil() as usize);
    Picture::texture(width, height, object.width / 3.0, base, 80.0, noise)
}

/// Draws one object over what is there.
fn draw(image: &mut [u8], scene: &Scene, t: f64, rect: &Rect, texture: &Picture) {
    let view = scene.world_to_image(t);
    let inverse = view.inverse();
    let scale = (view.0[0] * view.0[4] - view.0[1] * view.0[3]).sqrt();
    let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)]
        .map(|(a, b)| view.apply(rect.left + a * rect.width, rect.top + b * rect.height));
    let range = |values: [f64; 4], side: u32| {
        let low = values.iter().fold(f64::INFINITY, |m, x| m.min(*x)) - 1.0;
        let high = values.iter().fold(f64::NEG_INFINITY, |m, x| m.max(*x)) + 1.0;
        low.clamp(0.0, side as f64) as usize..high.clamp(0.0, side as f64) as usize
    };
    let columns = range(corners.map(|c| c.0), scene.width);
    for row in range(corners.map(|c| c.1), scene.height) {
        for column in columns.clone() {
            let (x, y) = inverse.apply(column as f64 + 0.5, row as f64 + 0.5);
            // Distance to the nearest edge in image pixels, inside positive: half a pixel either side is blended.
            let inside = (x - rect.left).min(rect.right() - x).min(y - rect.top).min(rect.bottom() - y) * scale;
            let cover = (inside + 0.5).clamp(0.0, 1.0) as f32;
            if cover > 0.0 {
                let pixel = &mut image[row * scene.width as usize + column];
                let colour = texture.sample((x - rect.left) as f32, (y - rect.top) as f32);
                *pixel = (cover * colour + (1.0 - cover) * *pixel as f32) as u8;
            }
        }
    }
}
