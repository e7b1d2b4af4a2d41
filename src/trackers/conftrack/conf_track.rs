//! One track of ConfTrack.

use super::parameters::ConfTrackParameters;
use crate::embedding::MeanEmbedding;
use crate::frame::Detection;
use crate::geometry::{Rect, State};
use crate::kalman::{BoxFilter, NoiseWeights, WidthHeight};
use crate::track::{Track, TrackState};
use crate::trackers::life::{Life, is_beyond, presentable, presentable_velocity};

/// Where a track stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub enum Standing {
    Tentative,
    Confirmed,
    /// Found again in the last frame.
    Rematched,
    Lost,
    /// Ends in this frame.
    Over,
}

/// A track.
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct ConfTrackTrack {
    pub life: Life,
    pub filter: WidthHeight,
    pub standing: Standing,
    /// Score of the detection last taken, fading while the track is lost.
    pub confidence: f64,
    pub embedding: MeanEmbedding,
    pub reported: bool,
    /// Matches since the birth or the last miss.
    streak: i64,
    /// Time since the last match in frames.
    missed: f64,
}

impl ConfTrackTrack {
    pub fn born(p: &ConfTrackParameters, id: u64, row: u32, detection: &Detection, embedding: MeanEmbedding) -> Self {
        let weights = NoiseWeights { position: p.position_noise, velocity: p.velocity_noise };
        Self {
            life: Life::begin(id, row, detection),
            filter: WidthHeight::with_noise(&measure(detection), weights),
            standing: Standing::Tentative,
            confidence: detection.score,
            embedding,
            reported: false,
            streak: 0,
            missed: 0.0,
        }
    }

    pub fn is_confirmed(&self) -> bool {
        matches!(self.standing, Standing::Confirmed | Standing::Rematched)
    }

    pub fn rect(&self) -> Rect {
        Rect::from(self.filter.state())
    }

    /// Takes a detection; the less sure it is, the less it counts.
    pub fn take(&mut self, p: &ConfTrackParameters, row: u32, detection: &Detection) {
        self.life.take(row, detection);
        self.confidence = detection.score;
        let (predicted, mut z) = (self.filter.state(), measure(detection));
        if p.confidence_weighting && detection.score < p.weighting_thresh {
            z = predicted + (z - predicted) * detection.score;
        }
        let noise = if p.noise_scaling { (1.0 - detection.score) * p.noise_amplification } else { 1.0 };
        self.filter.correct_with(&z, noise);
    }

    /// What the frame's matches make of the track; the detector last ran `since` frames before.
    pub fn settle(&mut self, p: &ConfTrackParameters, since: f64) {
        if self.life.row.is_some() {
            self.streak += 1;
            self.missed = 0.0;
            self.standing = match self.standing {
                Standing::Tentative if self.streak < p.init_age && self.confidence < p.confirm_thresh => {
                    Standing::Tentative
                }
                Standing::Lost => Standing::Rematched,
                _ => Standing::Confirmed,
            };
            return;
        }
        self.streak = 0;
        self.confidence *= p.confidence_decay;
        self.missed += since;
        let s = self.filter.state();
        let is_valid = s.w / s.h <= p.max_aspect && s.w * s.h >= p.min_area;
        let lives_on = self.standing != Standing::Tentative && !is_beyond(self.missed, p.max_age as f64) && is_valid;
        self.standing = if lives_on { Standing::Lost } else { Standing::Over };
    }

    pub fn shown(&self, frame_rate: f64) -> Track {
        let state = match self.standing {
            Standing::Tentative => TrackState::Tentative,
            Standing::Confirmed | Standing::Rematched => TrackState::Confirmed,
            Standing::Lost | Standing::Over => TrackState::Lost,
        };
        let rect = presentable(&self.filter.state(), &self.life.last);
        self.life.track(rect, presentable_velocity(self.filter.velocity(), frame_rate), state)
    }
}

/// Sizes below a pixel count as one.
fn measure(detection: &Detection) -> State {
    let Rect { left, top, width, height } = detection.rect;
    let (w, h) = (width.max(1.0), height.max(1.0));
    State::new(left + 0.5 * w, top + 0.5 * h, w, h)
}
