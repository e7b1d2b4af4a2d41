//! A crowd of three classes.

use gentrack2::{CameraMotion, Detection, Embeddings, Frame, Rect};

use super::{Walker, frame_time};
use crate::simulator::noise::Noise;

/// What is fed to a tracker in one frame.
pub struct Input {
    pub detections: Vec<Detection>,
    pub embeddings: Vec<f32>,
    pub motion: CameraMotion,
    pub skipped: bool,
    /// Where the origin of the world is seen.
    pub place: (f64, f64),
}

/// Numbers per embedding.
pub const DIMENSION: usize = 4;
/// Class ids are any numbers.
pub const CLASSES: [i32; 3] = [-5, 0, 1_000_000];

impl Input {
    pub fn frame(&self) -> Frame<'_> {
        Frame {
            detector_skipped: self.skipped,
            embeddings: (!self.skipped).then(|| Embeddings::new(&self.embeddings, DIMENSION)),
            camera_motion: Some(self.motion),
            ..Frame::new(&self.detections)
        }
    }

    /// The same before a camera that stands still.
    pub fn still(&self) -> Input {
        let (x, y) = self.place;
        let moved =
            |d: &Detection| Detection { rect: Rect { left: d.rect.left - x, top: d.rect.top - y, ..d.rect }, ..*d };
        Input {
            detections: self.detections.iter().map(moved).collect(),
            embeddings: self.embeddings.clone(),
            motion: CameraMotion::IDENTITY,
            place: (0.0, 0.0),
            ..*self
        }
    }

    /// The rows of a class, and where they stand in the whole.
    pub fn of_class(&self, class: i32) -> (Input, Vec<usize>) {
        let rows: Vec<usize> = (0..self.detections.len()).filter(|r| self.detections[*r].class_id == class).collect();
        let part = Input {
            detections: rows.iter().map(|r| self.detections[*r]).collect(),
            embeddings: rows.iter().flat_map(|r| &self.embeddings[r * DIMENSION..][..DIMENSION]).copied().collect(),
            ..*self
        };
        (part, rows)
    }
}

/// A crowd of three classes on top of each other, seen badly by a detector that rests now and then and a camera that
/// moves; a class is not there from the beginning, and one is away for a while.
pub fn crowd(seed: u64) -> Vec<Input> {
    let mut noise = Noise::new(seed, 1);
    let mut people: Vec<(Walker, [f32; DIMENSION])> = Vec::new();
    for n in 0..24 {
        let mut walker = Walker::new(
            noise.between(200.0, 900.0),
            noise.between(200.0, 500.0),
            (noise.between(-60.0, 60.0), noise.between(-30.0, 30.0)),
        );
        walker.class = CLASSES[n % 3];
        walker.start.height *= noise.between(0.7, 1.3);
        let mut looks = [0.0; DIMENSION];
        looks.iter_mut().for_each(|x| *x = noise.between(-1.0, 1.0) as f32);
        people.push((walker, looks));
    }
    let mut place = (0.0, 0.0);
    (0..150)
        .map(|index| {
            let time = frame_time(index);
            let step = (noise.between(-6.0, 6.0), noise.between(-6.0, 6.0));
            place = (place.0 + step.0, place.1 + step.1);
            let mut input = Input {
                detections: Vec::new(),
                embeddings: Vec::new(),
                motion: CameraMotion([1.0, 0.0, step.0, 0.0, 1.0, step.1]),
                place,
                skipped: index % 11 == 7 || (60..64).contains(&index),
            };
            noise.shuffle(&mut people);
            for (walker, looks) in &people {
                let away = (walker.class == CLASSES[1] && index < 10)
                    || (walker.class == CLASSES[2] && (80..100).contains(&index));
                if input.skipped || away || noise.chance(0.15) {
                    continue;
                }
                let mut rect = walker.at(time);
                rect.left += place.0 + 1.5 * noise.bell();
                rect.top += place.1 + 1.5 * noise.bell();
                let score = noise.between(0.3, 1.0);
                input.detections.push(Detection { rect, score, class_id: walker.class, tag: noise.bits() });
                input.embeddings.extend(looks.iter().map(|x| x + 0.05 * noise.bell() as f32));
            }
            input
        })
        .collect()
}
