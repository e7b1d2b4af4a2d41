//! What a caller hands in for one frame. Everything is borrowed; nothing is kept after the step.

use crate::geometry::{Rect, State};
use crate::image::ImageView;

/// One detection.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct Detection {
    /// Box in pixels.
    pub rect: Rect,
    /// Detector confidence in `[0, 1]` (`det^conf` of the paper).
    pub score: f64,
    /// Class of the object, any integer; comes back on the track.
    pub class_id: i32,
    /// Any value of the caller's; comes back on the track that took this detection.
    pub tag: u64,
}

impl Detection {
    /// A detection of class 0 without a tag.
    pub const fn new(left: f64, top: f64, width: f64, height: f64, score: f64) -> Self {
        Self { rect: Rect::new(left, top, width, height), score, class_id: 0, tag: 0 }
    }
}

/// Re-identification embeddings, one row per detection, in the detections' order.
#[derive(Clone, Copy, Debug)]
pub struct Embeddings<'a> {
    /// The rows, `stride` apart.
    pub data: &'a [f32],
    /// Numbers per row; the same for every frame that has embeddings.
    pub dimension: usize,
    /// Numbers from the start of one row to the start of the next, at least `dimension`.
    pub stride: usize,
}

impl<'a> Embeddings<'a> {
    /// Densely packed rows.
    pub const fn new(data: &'a [f32], dimension: usize) -> Self {
        Self { data, dimension, stride: dimension }
    }

    /// The embedding of detection `index`.
    pub fn row(&self, index: usize) -> &'a [f32] {
        &self.data[index * self.stride..][..self.dimension]
    }
}

/// Affine camera motion, `[m00 m01 tx; m10 m11 ty]` row-major: maps a point of the previous frame to where the
/// camera's movement alone puts it in this frame, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraMotion(pub [f64; 6]);

impl CameraMotion {
    /// No motion.
    pub const IDENTITY: CameraMotion = CameraMotion([1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);

    /// The image of a point.
    pub fn apply_point(&self, x: f64, y: f64) -> (f64, f64) {
        let m = &self.0;
        (m[0] * x + m[1] * y + m[2], m[3] * x + m[4] * y + m[5])
    }

    /// The image of a displacement: the linear part alone.
    pub fn apply_vector(&self, x: f64, y: f64) -> (f64, f64) {
        let m = &self.0;
        (m[0] * x + m[1] * y, m[3] * x + m[4] * y)
    }

    /// Factors by which widths and heights grow: the column norms of the linear part.
    pub fn size_factors(&self) -> (f64, f64) {
        let m = &self.0;
        ((m[0] * m[0] + m[3] * m[3]).sqrt(), (m[1] * m[1] + m[4] * m[4]).sqrt())
    }

    /// The image of a box state.
    pub fn apply_state(&self, s: &State) -> State {
        let (u, v) = self.apply_point(s.u, s.v);
        let (kw, kh) = self.size_factors();
        State::new(u, v, s.w * kw, s.h * kh)
    }

    /// The image of a velocity.
    pub fn apply_velocity(&self, s: &State) -> State {
        let (u, v) = self.apply_vector(s.u, s.v);
        let (kw, kh) = self.size_factors();
        State::new(u, v, s.w * kw, s.h * kh)
    }
}

/// Everything known about one frame.
#[derive(Clone, Copy, Debug, Default)]
pub struct Frame<'a> {
    /// The detections; empty is normal.
    pub detections: &'a [Detection],
    /// The detector did not run on this frame: tracks coast and are not blamed for a miss. `detections` must be
    /// empty.
    pub detector_skipped: bool,
    /// Re-identification embeddings of the detections.
    pub embeddings: Option<Embeddings<'a>>,
    /// The image, for trackers that look at it.
    pub image: Option<ImageView<'a>>,
    /// Width and height of the frame in pixels where no image is given: tracks that leave it can be ended,
    /// and boxes mostly beyond its border taken less seriously.
    pub size: Option<(u32, u32)>,
    /// Camera motion since the previous frame; the identity says that it stood still, `None` that it is not known.
    pub camera_motion: Option<CameraMotion>,
    /// Capture time in nanoseconds from any fixed origin; must grow from frame to frame.
    pub timestamp_ns: Option<i64>,
}

impl<'a> Frame<'a> {
    /// A frame of detections alone.
    pub fn new(detections: &'a [Detection]) -> Self {
        Self { detections, ..Self::default() }
    }

    /// A frame on which the detector did not run.
    pub fn skipped() -> Self {
        Self { detector_skipped: true, ..Self::default() }
    }

    /// Width and height of the frame, from the image if there is one.
    pub fn size(&self) -> Option<(u32, u32)> {
        self.image.map(|i| (i.width(), i.height())).or(self.size)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn camera_motion_moves_points_turns_vectors_scales_sizes() {
        // A zoom by 2 about the origin and a shift by (10, 20).
        let zoom = CameraMotion([2.0, 0.0, 10.0, 0.0, 2.0, 20.0]);
        assert_eq!(zoom.apply_state(&State::new(1.0, 2.0, 3.0, 4.0)), State::new(12.0, 24.0, 6.0, 8.0));
        assert_eq!(zoom.apply_velocity(&State::new(1.0, 2.0, 0.5, 0.0)), State::new(2.0, 4.0, 1.0, 0.0));
        // A quarter turn: (1, 0) -> (0, 1); sizes keep their length.
        let turn = CameraMotion([0.0, -1.0, 0.0, 1.0, 0.0, 0.0]);
        assert_eq!(turn.apply_vector(1.0, 0.0), (0.0, 1.0));
        assert_eq!(turn.size_factors(), (1.0, 1.0));
    }

    #[test]
    fn embedding_rows_follow_the_stride() {
        let data = [1.0, 2.0, 9.0, 3.0, 4.0];
        let e = Embeddings { data: &data, dimension: 2, stride: 3 };
        assert_eq!(e.row(1), &[3.0, 4.0]);
    }
}
