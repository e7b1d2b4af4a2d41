//! One track of the family.

use crate::embedding::MeanEmbedding;
use crate::frame::Detection;
use crate::geometry::Rect;
use crate::kalman::BoxFilter;
use crate::track::{Track, TrackState};
use crate::trackers::life::{Life, presentable, presentable_velocity};

/// Where a member stands, or goes in this frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub enum Fate {
    /// Seen when the detector last ran.
    Tracked,
    /// Born in this frame.
    New,
    /// Lost before, seen in this frame.
    Found,
    /// Not seen.
    Lost,
    /// Seen before, not in this frame.
    NewlyLost,
    /// At its end.
    Gone,
}

/// A track.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct Member<F> {
    pub life: Life,
    pub filter: F,
    pub fate: Fate,
    /// Whether the track is confirmed.
    pub activated: bool,
    /// Frame of birth.
    pub start: f64,
    /// Frame of the last match, or of the birth.
    pub last: f64,
    /// Whether it was once lost for too long: found again in its last frame it lives on, but is not sought again.
    pub given_up: bool,
    pub embedding: MeanEmbedding,
}

impl<F: BoxFilter> Member<F> {
    pub fn born(id: u64, row: u32, detection: &Detection, now: f64, embedding: MeanEmbedding) -> Self {
        Self {
            life: Life::begin(id, row, detection),
            filter: F::new(&detection.rect),
            fate: Fate::New,
            activated: false,
            start: now,
            last: now,
            given_up: false,
            embedding,
        }
    }

    /// Takes a detection.
    pub fn take(&mut self, row: u32, detection: &Detection, now: f64) {
        self.life.take(row, detection);
        self.filter.correct(&detection.rect);
        if self.fate == Fate::Lost {
            self.fate = Fate::Found;
        }
        self.activated = true;
        self.last = now;
    }

    pub fn learn(&mut self, embedding: Option<&[f64]>, momentum: f64) {
        if let Some(seen) = embedding {
            self.embedding.learn(seen, momentum);
        }
    }

    pub fn rect(&self) -> Rect {
        Rect::from(self.filter.state())
    }

    /// As its caller sees it.
    pub fn track(&self, is_tracked: bool, frame_rate: f64) -> Track {
        let state = match (is_tracked, self.activated) {
            (true, true) => TrackState::Confirmed,
            (true, false) => TrackState::Tentative,
            (false, _) => TrackState::Lost,
        };
        let rect = presentable(&self.filter.state(), &self.life.last);
        self.life.track(rect, presentable_velocity(self.filter.velocity(), frame_rate), state)
    }
}
