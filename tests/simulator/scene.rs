//! A scene and its play: per frame the truth, the detections and, on request, the image.

use gentrack2::{CameraMotion, Detection, Rect};

use super::affine::Affine;
use super::camera::Camera;
use super::detector::Detector;
use super::noise::Noise;
use super::path::Path;
use super::render::Renderer;

/// A textured rectangle on its way.
#[derive(Clone, Debug)]
pub struct Object {
    pub path: Path,
    pub width: f64,
    pub height: f64,
    /// Nearer (smaller) objects hide farther ones.
    pub depth: f64,
    /// Times, in seconds, between which the detector misses it whatever its visibility.
    pub missed: Option<(f64, f64)>,
}

impl Object {
    pub fn new(width: f64, height: f64, depth: f64, path: Path) -> Self {
        Self { path, width, height, depth, missed: None }
    }

    /// Its box in the world at time `t`.
    pub fn world_rect(&self, t: f64) -> Option<Rect> {
        let (x, y) = self.path.at(t)?;
        Some(Rect::new(x - 0.5 * self.width, y - 0.5 * self.height, self.width, self.height))
    }
}

#[derive(Clone, Debug)]
pub struct Scene {
    pub width: u32,
    pub height: u32,
    pub frames_per_second: f64,
    /// Length in seconds.
    pub duration: f64,
    pub objects: Vec<Object>,
    pub camera: Camera,
    pub detector: Detector,
    /// Seed of textures and detector noise.
    pub seed: u64,
}

impl Scene {
    /// A still scene of 768x576 at 30 frames per second with the usual detector.
    pub fn new(seed: u64, duration: f64, objects: Vec<Object>) -> Self {
        Self {
            width: 768,
            height: 576,
            frames_per_second: 30.0,
            duration,
            objects,
            camera: Camera::default(),
            detector: Detector::default(),
            seed,
        }
    }

    pub fn frame_count(&self) -> usize {
        (self.duration * self.frames_per_second).round() as usize
    }

    /// Plays the scene; the detections do not depend on whether images are rendered.
    pub fn play(&self, images: bool) -> impl Iterator<Item = Observation> + '_ {
        let mut noise = Noise::new(self.seed, 1);
        let mut renderer = images.then(|| Renderer::new(self));
        (0..self.frame_count()).map(move |frame| {
            let t = frame as f64 / self.frames_per_second;
            let truth = self.truth(t);
            let (detections, source) = self.detector.detect(self, t, &truth, &mut noise);
            Observation {
                frame,
                time: t,
                truth,
                detections,
                source,
                image: renderer.as_mut().map(|r| r.render(self, t)),
                camera_motion: self.camera_motion(frame),
            }
        })
    }

    pub fn world_to_image(&self, t: f64) -> Affine {
        self.camera.at(t, self.width, self.height)
    }

    fn camera_motion(&self, frame: usize) -> CameraMotion {
        let now = self.world_to_image(frame as f64 / self.frames_per_second);
        let before = self.world_to_image((frame as f64 - 1.0) / self.frames_per_second);
        CameraMotion(now.after(&before.inverse()).0)
    }

    fn truth(&self, t: f64) -> Vec<Truth> {
        let view = self.world_to_image(t);
        let present = self.objects.iter().enumerate().filter_map(|(i, o)| Some((i, o, o.world_rect(t)?)));
        present
            .map(|(object, o, rect)| Truth {
                object,
                rect: bounding_box(&rect, &view),
                visible: self.visible_share(o, &rect, t, &view),
            })
            .collect()
    }

    /// The share of the object's area that is in the image and not behind a nearer object, by sampling.
    fn visible_share(&self, object: &Object, rect: &Rect, t: f64, view: &Affine) -> f64 {
        const COLUMNS: usize = 24;
        const ROWS: usize = 40;
        let nearer: Vec<Rect> =
            self.objects.iter().filter(|o| o.depth < object.depth).filter_map(|o| o.world_rect(t)).collect();
        let mut seen = 0;
        for row in 0..ROWS {
            for column in 0..COLUMNS {
                let x = rect.left + rect.width * (column as f64 + 0.5) / COLUMNS as f64;
                let y = rect.top + rect.height * (row as f64 + 0.5) / ROWS as f64;
                let (u, v) = view.apply(x, y);
                let inside = u >= 0.0 && v >= 0.0 && u < self.width as f64 && v < self.height as f64;
                seen += usize::from(inside && !nearer.iter().any(|n| n.contains(x, y)));
            }
        }
        seen as f64 / (COLUMNS * ROWS) as f64
    }
}

/// The bounding box of a mapped box.
fn bounding_box(rect: &Rect, view: &Affine) -> Rect {
    let corners =
        [(rect.left, rect.top), (rect.right(), rect.top), (rect.left, rect.bottom()), (rect.right(), rect.bottom())]
            .map(|(x, y)| view.apply(x, y));
    let left = corners.iter().fold(f64::INFINITY, |m, c| m.min(c.0));
    let top = corners.iter().fold(f64::INFINITY, |m, c| m.min(c.1));
    let right = corners.iter().fold(f64::NEG_INFINITY, |m, c| m.max(c.0));
    let bottom = corners.iter().fold(f64::NEG_INFINITY, |m, c| m.max(c.1));
    Rect::new(left, top, right - left, bottom - top)
}

/// What is true of an object in a frame.
#[derive(Clone, Copy, Debug)]
pub struct Truth {
    pub object: usize,
    /// Its whole box in the image, hidden parts included.
    pub rect: Rect,
    /// The share of it that can be seen.
    pub visible: f64,
}

/// One frame.
#[derive(Clone, Debug)]
pub struct Observation {
    pub frame: usize,
    /// Seconds.
    pub time: f64,
    pub truth: Vec<Truth>,
    pub detections: Vec<Detection>,
    /// For each detection the object it came from; `None` is clutter.
    pub source: Vec<Option<usize>>,
    /// Packed GRAY8.
    pub image: Option<Vec<u8>>,
    /// The camera's true motion since the previous frame.
    pub camera_motion: CameraMotion,
}
