//! DeepSORT: SORT with a gallery of embeddings per track. Wojke et al., "Simple Online and Realtime Tracking with a Deep
//! Association Metric", ICIP 2017.

mod gated_pairs;
mod parameters;

pub use parameters::*;

use super::TrackingAlgorithm;
use super::life::{Life, SMALLEST, is_beyond, presentable, presentable_velocity};
use super::overlaps::Extent;
use super::pairing::Pairing;
use crate::assignment::Edge;
use crate::buffers;
use crate::embedding::{Gallery, SpareGalleries, UnitRows};
use crate::faults::{self, Stage};
use crate::frame::{Detection, Frame};
use crate::geometry::Rect;
use crate::kalman::{AspectHeight, BoxFilter, is_sane};
#[cfg(feature = "snapshot")]
use crate::snapshot::{Decoder, Encoder};
use crate::track::{Output, Track, TrackState};
use crate::tracker::StepContext;

use gated_pairs::GatedPairs;

/// A pair out of bounds counts this much more than the bound in the optimum.
const BEYOND: f64 = 1e-5;

/// A track.
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
struct DeepTrack {
    life: Life,
    filter: AspectHeight,
    /// Embeddings of all matches, the birth included; asked once the track is confirmed.
    gallery: Gallery,
    confirmed: bool,
    /// Frames since the last match on which the detector ran, and the time since it.
    missed_frames: u32,
    missed: f64,
}

impl DeepTrack {
    fn rect(&self) -> Rect {
        Rect::from(self.filter.state())
    }

    fn take(
        &mut self,
        row: u32,
        detection: &Detection,
        embedding: Option<&[f64]>,
        p: &DeepSortParameters,
        spare: &mut SpareGalleries,
    ) {
        self.learn(embedding, p, spare);
        self.life.take(row, detection);
        self.filter.correct(&detection.rect);
        self.confirmed |= i64::from(self.life.hits) >= p.n_init;
        self.missed_frames = 0;
        self.missed = 0.0;
    }

    fn learn(&mut self, embedding: Option<&[f64]>, p: &DeepSortParameters, spare: &mut SpareGalleries) {
        if let Some(seen) = embedding {
            spare.make_room(&mut self.gallery, seen.len(), p.nn_budget as usize);
            self.gallery.add(seen, p.nn_budget as usize);
        }
    }

    fn is_over(&self, max_age: f64) -> bool {
        self.missed_frames > 0 && (!self.confirmed || is_beyond(self.missed, max_age))
    }

    fn shown(&self, frame_rate: f64) -> Track {
        let state = match (self.confirmed, self.missed_frames) {
            (false, _) => TrackState::Tentative,
            (true, 0) => TrackState::Confirmed,
            (true, _) => TrackState::Lost,
        };
        let rect = presentable(&self.filter.state(), &self.life.last);
        self.life.track(rect, presentable_velocity(self.filter.velocity(), frame_rate), state)
    }
}

/// The tracker.
pub struct DeepSort {
    parameters: DeepSortParameters,
    /// In the order of their births.
    tracks: Vec<DeepTrack>,
    work: Workspace,
}

/// Buffers that are only there to be reused.
#[derive(Default)]
struct Workspace {
    embeddings: UnitRows,
    /// Rows of the detections not taken yet.
    rows: Vec<u32>,
    /// Where each row stands among them.
    positions: Vec<u32>,
    gated: GatedPairs,
    /// Tracks of the cascade, the least missed first, and those of one of its steps.
    cascade: Vec<u32>,
    step: Vec<u32>,
    edges: Vec<Edge>,
    pairing: Pairing,
    spare: SpareGalleries,
}

impl DeepSort {
    /// A tracker without tracks.
    pub fn new(parameters: DeepSortParameters) -> Self {
        Self { parameters, tracks: Vec::new(), work: Workspace::default() }
    }

    fn predict(&mut self, frame: &Frame<'_>, dt: f64, output: &mut Output) {
        let motion = frame.camera_motion.as_ref().filter(|_| self.parameters.use_camera_motion);
        for track in &mut self.tracks {
            track.life.next_frame();
            track.filter.predict(dt);
            if let Some(motion) = motion {
                track.filter.follow_camera(motion);
            }
        }
        self.remove(output, |t| !is_sane(&t.filter.state()));
    }

    fn remove(&mut self, output: &mut Output, is_over: impl Fn(&DeepTrack) -> bool) {
        faults::point(Stage::Removal);
        for track in self.tracks.extract_if(.., |t| is_over(t)) {
            output.ended.push(track.life.id);
            self.work.spare.put(track.gallery);
        }
    }

    /// Confirmed tracks by their looks within the gate of their motion, those that were seen last first.
    fn cascade(&mut self, frame: &Frame<'_>, context: &StepContext<'_>) {
        faults::point(Stage::Association);
        let (p, tracks, work) = (&self.parameters, &mut self.tracks, &mut self.work);
        // Missed for the first time it is sought however long the detector has rested.
        let in_time = |t: &DeepTrack| !is_beyond(t.missed, p.max_age as f64) || t.missed_frames == 1 && p.max_age > 0;
        let takes_part = |t: &DeepTrack| t.confirmed && in_time(t);
        work.cascade.clear();
        work.cascade.extend((0..).zip(tracks.iter()).filter(|(_, t)| takes_part(t)).map(|(i, _)| i));
        work.cascade.sort_unstable_by_key(|t| (tracks[*t as usize].missed_frames, *t));
        let filters = work.cascade.iter().map(|t| &tracks[*t as usize].filter);
        work.gated.find(filters, work.rows.iter().map(|r| (*r, frame.detections[*r as usize].rect)), p.gate);
        let mut from = 0;
        while from < work.cascade.len() {
            let missed = |t: u32| tracks[t as usize].missed_frames;
            let age = missed(work.cascade[from]);
            let count = work.cascade[from..].iter().take_while(|t| missed(**t) == age).count();
            work.step.clear();
            work.step.extend_from_slice(&work.cascade[from..from + count]);
            work.find_alike(p, tracks, frame, context, from);
            let pairs =
                work.pairing.pair_edges(&work.edges, &mut work.step, &mut work.rows, p.max_cosine_distance + BEYOND);
            for &(track, row) in pairs {
                let embedding = work.embeddings.row(row as usize);
                tracks[track as usize].take(row, &frame.detections[row as usize], embedding, p, &mut work.spare);
            }
            from += count;
        }
    }

    /// Tentative tracks, and confirmed ones that are missed for the first time, by IoU.
    fn overlap_round(&mut self, frame: &Frame<'_>, context: &StepContext<'_>) {
        faults::point(Stage::Association);
        let (p, tracks, work) = (&self.parameters, &mut self.tracks, &mut self.work);
        work.step.clear();
        work.step.extend((0..).zip(tracks.iter()).filter(|(_, t)| !t.confirmed).map(|(i, _)| i));
        let fresh = (0..).zip(tracks.iter()).filter(|(_, t)| t.confirmed && t.missed_frames == 1);
        work.step.extend(fresh.map(|(i, _)| i));
        let detection = |row: u32| &frame.detections[row as usize];
        let cost = |track: u32, row: u32, iou: f64| {
            let same = context.classes.allows(tracks[track as usize].life.last.class_id, detection(row).class_id);
            if same && 1.0 - iou <= p.max_iou_distance { 1.0 - iou } else { f64::INFINITY }
        };
        let pairs = work.pairing.pair(
            Extent::Continuous,
            &mut work.step,
            |track| tracks[track as usize].rect(),
            &mut work.rows,
            |row| detection(row).rect,
            p.max_iou_distance + BEYOND,
            cost,
        );
        for &(track, row) in pairs {
            let embedding = work.embeddings.row(row as usize);
            tracks[track as usize].take(row, detection(row), embedding, p, &mut work.spare);
        }
    }

    fn start_tracks(&mut self, frame: &Frame<'_>, context: &mut StepContext<'_>) {
        let room = context.max_tracks.saturating_sub(self.tracks.len());
        let Workspace { rows, embeddings, spare, .. } = &mut self.work;
        for &row in rows.iter().take(room) {
            let detection = &frame.detections[row as usize];
            let mut track = DeepTrack {
                life: Life::begin(context.ids.take(), row, detection),
                filter: AspectHeight::new(&detection.rect),
                gallery: spare.take(),
                confirmed: false,
                missed_frames: 0,
                missed: 0.0,
            };
            track.learn(embeddings.row(row as usize), &self.parameters, spare);
            buffers::push(&mut self.tracks, track);
        }
    }
}

impl Workspace {
    /// Lists the admissible pairs of the cascade's step that begins at `from` with the rows left over: within the gate,
    /// and alike, or, where there is nothing to compare, the nearer the cheaper.
    fn find_alike(
        &mut self,
        p: &DeepSortParameters,
        tracks: &[DeepTrack],
        frame: &Frame<'_>,
        context: &StepContext<'_>,
        from: usize,
    ) {
        self.positions.clear();
        self.positions.resize(frame.detections.len(), u32::MAX);
        for (position, row) in self.rows.iter().enumerate() {
            self.positions[*row as usize] = position as u32;
        }
        self.edges.clear();
        for (slot, &track) in self.step.iter().enumerate() {
            let track = &tracks[track as usize];
            for &(row, far) in self.gated.of(from + slot) {
                let position = self.positions[row as usize];
                let class = frame.detections[row as usize].class_id;
                if position == u32::MAX || !context.classes.allows(track.life.last.class_id, class) {
                    continue;
                }
                let looks = self.embeddings.row(row as usize).and_then(|seen| track.gallery.distance(seen));
                let cost = looks.unwrap_or(p.max_cosine_distance * far / p.gate);
                if cost <= p.max_cosine_distance {
                    self.edges.push(Edge { row: slot as u32, column: position, cost });
                }
            }
        }
    }
}

impl TrackingAlgorithm for DeepSort {
    fn step(&mut self, frame: &Frame<'_>, context: &mut StepContext<'_>, output: &mut Output) {
        self.predict(frame, context.elapsed, output);
        if !frame.detector_skipped {
            for track in &mut self.tracks {
                track.missed_frames = track.missed_frames.saturating_add(1);
                track.missed += context.since_detector;
            }
            let work = &mut self.work;
            work.embeddings.fill(frame.embeddings.as_ref(), frame.detections.len());
            work.rows.clear();
            let usable = |d: &Detection| d.rect.height >= SMALLEST && d.score >= self.parameters.min_score;
            work.rows.extend((0..).zip(frame.detections).filter(|(_, d)| usable(d)).map(|(row, _)| row));
            self.cascade(frame, context);
            self.overlap_round(frame, context);
            self.start_tracks(frame, context);
            let max_age = self.parameters.max_age as f64;
            self.remove(output, |t| t.is_over(max_age));
        }
        for track in &self.tracks {
            // Missed for the first time, a track is still reported, where it is predicted.
            output.list(track.shown(context.frame_rate), track.confirmed && track.missed_frames <= 1);
        }
    }

    fn reset(&mut self) {
        for track in self.tracks.drain(..) {
            self.work.spare.put(track.gallery);
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
