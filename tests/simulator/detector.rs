//! A noisy detector.

use gentrack2::{Detection, Rect};

use super::noise::Noise;
use super::scene::{Scene, Truth};

#[derive(Clone, Copy, Debug)]
pub struct Detector {
    /// Probability of missing a fully visible object.
    pub miss: f64,
    /// Further probability of a miss when nothing can be seen; it grows linearly with the hidden share.
    pub miss_hidden: f64,
    /// Objects of which less than this share can be seen are never detected.
    pub least_visible: f64,
    /// Standard deviation of the centre in box widths and heights; it doubles towards full occlusion.
    pub centre_jitter: f64,
    /// Standard deviation of width and height, relative; likewise.
    pub size_jitter: f64,
    /// Mean number of false detections per frame.
    pub clutter: f64,
}

impl Default for Detector {
    fn default() -> Self {
        Self { miss: 0.02, miss_hidden: 0.4, least_visible: 0.3, centre_jitter: 0.02, size_jitter: 0.03, clutter: 0.2 }
    }
}

impl Detector {
    /// The detections of a frame, in random order, with their sources.
    pub fn detect(
        &self,
        scene: &Scene,
        t: f64,
        truth: &[Truth],
        noise: &mut Noise,
    ) -> (Vec<Detection>, Vec<Option<usize>>) {
        let mut found: Vec<(Detection, Option<usize>)> = Vec::new();
        for seen in truth {
            let overlooked = scene.objects[seen.object].missed.is_some_and(|(from, to)| t >= from && t < to);
            // Always the same number of draws, so that one miss does not change everything after it.
            let miss = noise.chance(self.miss + (1.0 - self.miss) * self.miss_hidden * (1.0 - seen.visible));
            let detection = self.jittered(seen, noise);
            if seen.visible >= self.least_visible && !miss && !overlooked {
                found.extend(clipped(&detection, scene).map(|d| (d, Some(seen.object))));
            }
        }
        let count = self.clutter.floor() as usize + usize::from(noise.chance(self.clutter.fract()));
        found.extend((0..count).filter_map(|_| clipped(&false_detection(scene, noise), scene)).map(|d| (d, None)));
        noise.shuffle(&mut found);
        for (row, (detection, _)) in found.iter_mut().enumerate() {
            detection.tag = ((t * 1000.0) as u64) << 20 | row as u64;
        }
        found.into_iter().unzip()
    }

    fn jittered(&self, seen: &Truth, noise: &mut Noise) -> Detection {
        let hidden = 1.0 - seen.visible;
        let (centre, size) = (self.centre_jitter * (1.0 + hidden), self.size_jitter * (1.0 + hidden));
        let r = &seen.rect;
        let u = r.left + r.width * (0.5 + centre * noise.bell());
        let v = r.top + r.height * (0.5 + centre * noise.bell());
        let width = r.width * (1.0 + size * noise.bell());
        let height = r.height * (1.0 + size * noise.bell());
        // 0.9 in full view, 0.52 when 30 % are seen.
        let score = (0.9 - 0.55 * hidden + 0.04 * noise.bell()).clamp(0.05, 0.99);
        Detection::new(u - 0.5 * width, v - 0.5 * height, width, height, score)
    }
}

/// A detection where there need not be anything; one in ten scores above 0.7, none above 0.85.
fn false_detection(scene: &Scene, noise: &mut Noise) -> Detection {
    let like = &scene.objects[noise.below(scene.objects.len())];
    let scale = noise.between(0.7, 1.3);
    let (width, height) = (like.width * scale, like.height * scale);
    let left = noise.between(0.0, scene.width as f64) - 0.5 * width;
    let top = noise.between(0.0, scene.height as f64) - 0.5 * height;
    let u = noise.unit();
    Detection::new(left, top, width, height, 0.1 + 0.75 * u * u)
}

/// The part inside the image, as detectors give it.
fn clipped(detection: &Detection, scene: &Scene) -> Option<Detection> {
    let r = &detection.rect;
    let (left, top) = (r.left.max(0.0), r.top.max(0.0));
    let width = r.right().min(scene.width as f64) - left;
    let height = r.bottom().min(scene.height as f64) - top;
    (width > 1.0 && height > 1.0).then(|| Detection { rect: Rect::new(left, top, width, height), ..*detection })
}
