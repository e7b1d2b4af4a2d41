//! ConfTrack: scores of detections steer the filter, the costs and the life of tracks. Jung et al., "ConfTrack: Kalman
//! Filter-based Multi-Person Tracking by Utilizing Confidence Score of Detection Box", WACV 2024.
//!
//! Its five contributions are parameters; each can be switched off.

mod conf_track;
mod parameters;

pub use parameters::*;

use super::TrackingAlgorithm;
use super::overlaps::Extent;
use super::pairing::Pairing;
use crate::buffers;
use crate::embedding::{MeanEmbedding, UnitRows};
use crate::faults::{self, Stage};
use crate::frame::Frame;
use crate::kalman::{BoxFilter, is_sane};
#[cfg(feature = "snapshot")]
use crate::snapshot::{Decoder, Encoder};
use crate::track::Output;
use crate::tracker::StepContext;

use conf_track::{ConfTrackTrack, Standing};

/// The tracker.
pub struct ConfTrack {
    parameters: ConfTrackParameters,
    /// In the order of their births.
    tracks: Vec<ConfTrackTrack>,
    work: Workspace,
}

/// Buffers that are only there to be reused.
#[derive(Default)]
struct Workspace {
    embeddings: UnitRows,
    /// Rows of the detections not taken yet.
    high: Vec<u32>,
    low: Vec<u32>,
    /// Tracks not matched yet: those that take part in the first round, and tentative ones of a low confidence.
    trusted: Vec<u32>,
    doubtful: Vec<u32>,
    suppressing: Vec<u32>,
    pairing: Pairing,
    spare: Vec<MeanEmbedding>,
}

/// Which tracks meet which detections.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Round {
    HighScores,
    LowScores,
    Doubtful,
}

impl ConfTrack {
    /// A tracker without tracks.
    pub fn new(parameters: ConfTrackParameters) -> Self {
        Self { parameters, tracks: Vec::new(), work: Workspace::default() }
    }

    fn predict(&mut self, frame: &Frame<'_>, dt: f64, output: &mut Output) {
        let p = &self.parameters;
        let motion = frame.camera_motion.as_ref().filter(|_| p.use_camera_motion);
        for track in &mut self.tracks {
            track.life.next_frame();
            // Tentative tracks are compared where they were last seen.
            if track.standing != Standing::Tentative {
                if p.constant_size && track.standing == Standing::Lost {
                    track.filter.stop_growth();
                }
                track.filter.predict(dt);
            }
            if let Some(motion) = motion {
                track.filter.move_centre(motion);
            }
        }
        self.remove(output, |t| !is_sane(&t.filter.state()));
    }

    fn remove(&mut self, output: &mut Output, is_over: impl Fn(&ConfTrackTrack) -> bool) {
        faults::point(Stage::Removal);
        for track in self.tracks.extract_if(.., |t| is_over(t)) {
            output.ended.push(track.life.id);
            self.work.retire(track.embedding);
        }
    }

    fn begin_rounds(&mut self, frame: &Frame<'_>) {
        let (p, work) = (&self.parameters, &mut self.work);
        work.embeddings.fill(frame.embeddings.as_ref(), frame.detections.len());
        work.high.clear();
        work.low.clear();
        for (detection, row) in frame.detections.iter().zip(0..) {
            if detection.score >= p.track_high_thresh {
                work.high.push(row);
            } else if detection.score >= p.track_low_thresh {
                work.low.push(row);
            }
        }
        work.trusted.clear();
        work.doubtful.clear();
        for (track, index) in self.tracks.iter().zip(0..) {
            let doubtful = track.standing == Standing::Tentative && track.confidence < p.confirm_thresh;
            if doubtful { &mut work.doubtful } else { &mut work.trusted }.push(index);
        }
    }

    fn associate(&mut self, frame: &Frame<'_>, context: &StepContext<'_>) {
        self.begin_rounds(frame);
        self.round(Round::HighScores, frame, context);
        let tracks = &self.tracks;
        self.work.trusted.retain(|t| tracks[*t as usize].standing != Standing::Tentative);
        self.round(Round::LowScores, frame, context);
        if self.parameters.low_confidence_matching {
            self.suppress(context);
            self.round(Round::Doubtful, frame, context);
        }
    }

    /// Lets tracks take detections; those without one stay in their list.
    fn round(&mut self, round: Round, frame: &Frame<'_>, context: &StepContext<'_>) {
        faults::point(Stage::Association);
        let Self { parameters: p, tracks, work } = self;
        let Workspace { pairing, embeddings, trusted, doubtful, high, low, .. } = work;
        let detection = |row: u32| &frame.detections[row as usize];
        let cost = |track: u32, row: u32, iou: f64| {
            let (track, detection) = (&tracks[track as usize], detection(row));
            if !context.classes.allows(track.life.last.class_id, detection.class_id) {
                return f64::INFINITY;
            }
            match round {
                Round::HighScores => first_cost(p, track, detection.score, embeddings.row(row as usize), iou),
                Round::LowScores | Round::Doubtful => 1.0 - iou,
            }
        };
        let (candidates, rows, limit) = match round {
            Round::HighScores => (trusted, high, p.match_thresh),
            Round::LowScores => (trusted, low, p.second_match_thresh),
            Round::Doubtful => (doubtful, high, p.low_confidence_thresh),
        };
        let place = |track: u32| tracks[track as usize].rect();
        let pairs = pairing.pair(Extent::Inclusive, candidates, place, rows, |row| detection(row).rect, limit, cost);
        for &(track, row) in pairs {
            let track = &mut tracks[track as usize];
            track.take(p, row, detection(row));
            // Detections of a low score have no embedding worth learning.
            if let Some(seen) = embeddings.row(row as usize).filter(|_| round != Round::LowScores) {
                track.embedding.learn(seen, p.feature_momentum);
            }
        }
    }

    /// Doubtful tracks in the place of a confirmed or lost one that was not seen are shadows of it.
    fn suppress(&mut self, context: &StepContext<'_>) {
        let (p, tracks, work) = (&self.parameters, &self.tracks, &mut self.work);
        work.suppressing.clear();
        work.suppressing.extend_from_slice(&work.trusted);
        let place = |track: u32| tracks[track as usize].rect();
        let class = |track: u32| tracks[track as usize].life.last.class_id;
        let cost = |a: u32, b: u32, iou: f64| match context.classes.allows(class(a), class(b)) {
            true => 1.0 - iou,
            false => f64::INFINITY,
        };
        let (doubtful, others) = (&mut work.doubtful, &mut work.suppressing);
        work.pairing.pair(Extent::Inclusive, doubtful, place, others, place, p.suppression_thresh, cost);
    }

    /// What no detection was for: high and low scores left over, in the order of the frame.
    fn start_tracks(&mut self, frame: &Frame<'_>, context: &mut StepContext<'_>) {
        let (p, work) = (&self.parameters, &mut self.work);
        let room = context.max_tracks.saturating_sub(self.tracks.len());
        let is_high = |row: u32| frame.detections[row as usize].score >= p.track_high_thresh;
        let left = &mut work.high;
        left.append(&mut work.low);
        left.sort_unstable();
        let starts = left.iter().filter(|row| frame.detections[**row as usize].score >= p.new_track_thresh);
        for &row in starts.take(room) {
            let embedding = work.spare.pop().unwrap_or_default();
            let mut track =
                ConfTrackTrack::born(p, context.ids.take(), row, &frame.detections[row as usize], embedding);
            if let Some(seen) = work.embeddings.row(row as usize).filter(|_| is_high(row)) {
                track.embedding.learn(seen, p.feature_momentum);
            }
            buffers::push(&mut self.tracks, track);
        }
    }
}

impl Workspace {
    fn retire(&mut self, mut embedding: MeanEmbedding) {
        embedding.clear();
        self.spare.push(embedding);
    }
}

/// IoU and looks; looks can make a pair cheaper, never dearer, and only where it overlaps.
fn first_cost(p: &ConfTrackParameters, track: &ConfTrackTrack, score: f64, embedding: Option<&[f64]>, iou: f64) -> f64 {
    let distance = 1.0 - iou;
    if distance > p.proximity_thresh {
        return f64::INFINITY;
    }
    let fused = |cost: f64| if p.confidence_fusion { 1.0 - (1.0 - cost) * score } else { cost };
    match embedding.and_then(|seen| track.embedding.distance(seen)) {
        Some(looks) if 0.5 * looks <= p.appearance_thresh => fused(distance).min(fused(0.5 * looks)),
        _ => fused(distance),
    }
}

impl TrackingAlgorithm for ConfTrack {
    fn step(&mut self, frame: &Frame<'_>, context: &mut StepContext<'_>, output: &mut Output) {
        self.predict(frame, context.elapsed, output);
        if !frame.detector_skipped {
            self.associate(frame, context);
            for track in &mut self.tracks {
                track.settle(&self.parameters, context.since_detector);
            }
            self.start_tracks(frame, context);
            self.remove(output, |t| t.standing == Standing::Over);
            for track in &mut self.tracks {
                track.reported = match context.detector_frames {
                    1 => track.confidence >= self.parameters.track_high_thresh,
                    _ => track.is_confirmed() && track.life.row.is_some(),
                };
            }
        }
        for track in &self.tracks {
            output.list(track.shown(context.frame_rate), track.reported);
        }
    }

    fn reset(&mut self) {
        for track in self.tracks.drain(..) {
            self.work.retire(track.embedding);
        }
    }

    #[cfg(feature = "snapshot")]
    fn save(&self, state: &mut Encoder) {
        state.put(&self.tracks);
    }

    #[cfg(feature = "snapshot")]
    fn load(&mut self, state: &mut Decoder<'_>) -> Result<(), crate::Error> {
        self.tracks = state.take()?;
        Ok(())
    }
}
