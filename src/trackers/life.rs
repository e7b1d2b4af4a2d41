//! What every algorithm keeps of a track for its caller: identity, ages, and what came with the detection last taken.

use crate::faults::{self, Stage};
use crate::frame::Detection;
use crate::geometry::{Rect, State};
use crate::track::{Track, TrackState};

/// The outer life of a track.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct Life {
    /// Identity.
    pub id: u64,
    /// The detection last taken.
    pub last: Detection,
    /// Its row in the frame, if it was taken in this frame.
    pub row: Option<u32>,
    /// Frames since birth, the birth counted.
    pub frames: u32,
    /// Detections taken, that of the birth included.
    pub hits: u32,
    /// Frames without a match.
    pub frames_since_match: u32,
}

impl Life {
    /// A life that begins with a detection.
    pub fn begin(id: u64, row: u32, detection: &Detection) -> Self {
        faults::point(Stage::Birth);
        Self { id, last: *detection, row: Some(row), frames: 1, hits: 1, frames_since_match: 0 }
    }

    /// A frame later, nothing taken yet.
    pub fn next_frame(&mut self) {
        faults::point(Stage::Prediction);
        self.row = None;
        self.frames = self.frames.saturating_add(1);
        self.frames_since_match = self.frames_since_match.saturating_add(1);
    }

    /// Takes a detection of this frame.
    pub fn take(&mut self, row: u32, detection: &Detection) {
        faults::point(Stage::Update);
        self.last = *detection;
        self.row = Some(row);
        self.hits = self.hits.saturating_add(1);
        self.frames_since_match = 0;
    }

    /// The track as its caller sees it; `velocity` is per second.
    pub fn track(&self, rect: Rect, velocity: State, state: TrackState) -> Track {
        Track {
            id: self.id,
            rect,
            velocity,
            state,
            score: self.last.score,
            class_id: self.last.class_id,
            tag: self.last.tag,
            detection_index: self.row.map(|row| row as usize),
            age: self.frames,
            hits: self.hits,
            frames_since_match: self.frames_since_match,
        }
    }
}

/// Whether a time in frames is beyond a life of so many. Timestamps are never exact, so it is by the nearest whole number.
pub fn is_beyond(time: f64, frames: f64) -> bool {
    time >= frames + 0.5
}

/// Smallest height, and smallest width where a filter divides by it, of a detection that a Kalman filter can take, in
/// pixels.
pub const SMALLEST: f64 = 1e-3;

/// A filter's box as it is handed out: of a state that is no box any more, the detection last taken.
#[cfg(feature = "_kalman")]
pub fn presentable(state: &State, last: &Detection) -> Rect {
    if !crate::kalman::is_sane(state) {
        return last.rect;
    }
    Rect::from(State { w: state.w.max(0.0), h: state.h.max(0.0), ..*state })
}

/// A filter's velocity as it is handed out, per second.
pub fn presentable_velocity(velocity: State, frame_rate: f64) -> State {
    let v = velocity * frame_rate;
    let finite = |x: f64| if x.is_finite() { x } else { 0.0 };
    State::new(finite(v.u), finite(v.v), finite(v.w), finite(v.h))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_velocity_that_is_finite_per_frame_only_is_none() {
        let velocity = State::new(1e307, 2.0, f64::NAN, f64::NEG_INFINITY);
        assert_eq!(presentable_velocity(velocity, 100.0), State::new(0.0, 200.0, 0.0, 0.0));
    }
}
