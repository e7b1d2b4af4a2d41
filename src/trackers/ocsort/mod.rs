//! OC-SORT: SORT that trusts what was observed more than what was predicted. Cao et al., "Observation-Centric SORT:
//! Rethinking SORT for Robust Multi-Object Tracking", CVPR 2023.
//!
//! | idea | file |
//! |---|---|
//! | directions of motion speak in the association (OCM) | [`heading`] |
//! | a track found again relives the gap (ORU) | [`reupdate`] |
//! | tracks are sought where they were last observed (OCR) | `recovery_round` below |

mod heading;
mod observed_track;
mod parameters;
mod reupdate;
mod similarity;

pub use parameters::*;

use super::TrackingAlgorithm;
use super::life::SMALLEST;
use super::sort_family::{Extra, FullAssociation, list_and_remove};
use crate::assignment::UNMATCHED;
use crate::buffers;
use crate::faults::{self, Stage};
use crate::frame::{Detection, Frame};
use crate::geometry::Rect;
use crate::kalman::is_sane;
#[cfg(feature = "snapshot")]
use crate::snapshot::{Decoder, Encoder};
use crate::track::Output;
use crate::tracker::StepContext;

use heading::Heading;
use observed_track::{ObservedTrack, Spare};
use reupdate::FrozenPool;

/// The tracker.
pub struct OcSort {
    parameters: OcSortParameters,
    /// In the order of their births.
    tracks: Vec<ObservedTrack>,
    work: Workspace,
}

/// Buffers that are only there to be reused.
#[derive(Default)]
struct Workspace {
    high: Vec<u32>,
    low: Vec<u32>,
    /// Tracks not matched yet.
    unmatched: Vec<u32>,
    views: Vec<View>,
    association: FullAssociation,
    spare: Spare,
    frozen: FrozenPool,
}

/// A track as it is before any association of the frame.
#[derive(Clone, Copy)]
struct View {
    predicted: Rect,
    heading: Option<Heading>,
    class: i32,
}

impl OcSort {
    /// A tracker without tracks.
    pub fn new(parameters: OcSortParameters) -> Self {
        Self { parameters, tracks: Vec::new(), work: Workspace::default() }
    }

    /// Moves the tracks on, and looks at them before any association. One walk over them: a large scene's do not fit into
    /// the nearest memory.
    fn predict(&mut self, frame: &Frame<'_>, context: &StepContext<'_>, output: &mut Output) {
        let motion = frame.camera_motion.as_ref().filter(|_| self.parameters.use_camera_motion);
        let (work, delta_t) = (&mut self.work, self.parameters.delta_t as u64);
        work.views.clear();
        // A box without a size has no future.
        let is_over = |track: &mut ObservedTrack| {
            track.predict(context.elapsed);
            if let Some(motion) = motion {
                track.follow_camera(motion);
            }
            let state = track.filter.state();
            if !is_sane(&state) {
                return true;
            }
            if !frame.detector_skipped {
                track.run.next_frame(context.since_detector);
                let (predicted, class) = (state.into(), track.life.last.class_id);
                work.views.push(View { predicted, heading: track.heading(delta_t), class });
            }
            false
        };
        for track in self.tracks.extract_if(.., is_over) {
            output.ended.push(track.life.id);
            work.spare.put(track.retire(&mut work.frozen));
        }
        work.unmatched.clear();
        work.unmatched.extend(0..self.tracks.len() as u32);
    }

    fn split_by_score(&mut self, detections: &[Detection]) {
        let (p, work) = (&self.parameters, &mut self.work);
        work.high.clear();
        work.low.clear();
        for (detection, row) in detections.iter().zip(0..).filter(|(d, _)| d.rect.height >= SMALLEST) {
            if detection.score > p.det_thresh {
                work.high.push(row);
            } else if detection.score > p.low_thresh && detection.score < p.det_thresh {
                work.low.push(row);
            }
        }
    }

    /// Predictions with high scores: IoU, and how well the direction towards the detection goes with the track's own.
    fn first_round(&mut self, detections: &[Detection], context: &StepContext<'_>) {
        faults::point(Stage::Association);
        let (p, Workspace { high, views, association, .. }) = (&self.parameters, &mut self.work);
        let detection = |d: u32| &detections[high[d as usize] as usize];
        let view = |t: u32| &views[t as usize];
        let allowed = |d: u32, t: u32| context.classes.allows(view(t).class, detection(d).class_id);
        let boxes = high.iter().map(|row| detections[*row as usize].rect);
        association.begin(boxes, views.iter().map(|v| v.predicted), p.iou_threshold, allowed);
        if !association.match_unambiguous() {
            let bonus = |d: u32, t: u32| {
                let consistency = view(t).heading.as_ref().map_or(0.0, |h| h.consistency(&detection(d).rect));
                p.inertia * detection(d).score * consistency
            };
            let bound = |d: u32| 0.5 * p.inertia * detection(d).score;
            // Who went nowhere yet is as good for one as for another.
            let is_plain = |t: u32| view(t).heading.is_none() && context.classes.compares_all();
            let rank = |d: u32, t: u32, limit: f64| view(t).heading.as_ref()?.cosine_above(&detection(d).rect, limit);
            association.best_sum(&Extra { bonus, rank, bound, is_plain, allowed });
        }
        self.take_partners(detections, true);
    }

    /// The tracks left over with the low scores; what is left of these is forgotten.
    fn low_score_round(&mut self, detections: &[Detection], context: &StepContext<'_>) {
        if self.parameters.use_byte && self.compare(detections, context, false, |track| track.filter.state().into()) {
            self.take_partners(detections, false);
        }
    }

    /// The tracks left over, where they were last observed, with the high scores left over.
    fn recovery_round(&mut self, detections: &[Detection], context: &StepContext<'_>) {
        if self.is_undefined(detections) {
            return;
        }
        if self.compare(detections, context, true, |track| track.observations.last_box()) {
            self.take_partners(detections, true);
        }
    }

    /// In the reference the IoU of a detection without an area and a track without an observation is 0/0, and no
    /// number is larger than that: there is no recovery in such a frame. The golden outputs have it so.
    fn is_undefined(&self, detections: &[Detection]) -> bool {
        let work = &self.work;
        self.parameters.asso_func == Similarity::Iou
            && work.high.iter().any(|row| detections[*row as usize].rect.area() == 0.0)
            && work.unmatched.iter().any(|t| self.tracks[*t as usize].observations.last_box().area() == 0.0)
    }

    /// Associates the tracks left over, at the boxes that `place` names, with detections; false if no pair is similar
    /// enough to begin with.
    fn compare(
        &mut self,
        detections: &[Detection],
        context: &StepContext<'_>,
        high: bool,
        place: impl Fn(&ObservedTrack) -> Rect,
    ) -> bool {
        faults::point(Stage::Association);
        let (p, work) = (&self.parameters, &mut self.work);
        let rows = if high { &work.high } else { &work.low };
        let (tracks, unmatched, association) = (&self.tracks, &work.unmatched, &mut work.association);
        let track = |t: u32| &tracks[unmatched[t as usize] as usize];
        let detection = |d: u32| &detections[rows[d as usize] as usize];
        let allowed = |d: u32, t: u32| context.classes.allows(track(t).life.last.class_id, detection(d).class_id);
        let boxes = rows.iter().map(|row| detections[*row as usize].rect);
        let places = unmatched.iter().map(|t| place(&tracks[*t as usize]));
        similarity::begin(p.asso_func, association, boxes, places, p.iou_threshold, allowed);
        if !association.has_hits() {
            return false;
        }
        association.best_overlap();
        true
    }

    /// Lets the tracks take their partners, and strikes both off the lists of those left over.
    fn take_partners(&mut self, detections: &[Detection], high: bool) {
        let (p, work) = (&self.parameters, &mut self.work);
        let rows = if high { &mut work.high } else { &mut work.low };
        let partners = work.association.partners();
        for (&row, &slot) in rows.iter().zip(partners).filter(|(_, slot)| **slot != UNMATCHED) {
            let track = std::mem::replace(&mut work.unmatched[slot as usize], UNMATCHED);
            let detection = &detections[row as usize];
            self.tracks[track as usize].take(row, detection, p.delta_t as u64, &mut work.spare, &mut work.frozen);
        }
        work.unmatched.retain(|track| *track != UNMATCHED);
        let mut partners = partners.iter();
        rows.retain(|_| partners.next() == Some(&UNMATCHED));
    }

    fn start_tracks(&mut self, detections: &[Detection], context: &mut StepContext<'_>) {
        let room = context.max_tracks.saturating_sub(self.tracks.len());
        for &row in self.work.high.iter().take(room) {
            buffers::push(&mut self.tracks, ObservedTrack::born(context.ids.take(), row, &detections[row as usize]));
        }
    }
}

impl TrackingAlgorithm for OcSort {
    fn step(&mut self, frame: &Frame<'_>, context: &mut StepContext<'_>, output: &mut Output) {
        self.predict(frame, context, output);
        if !frame.detector_skipped {
            self.split_by_score(frame.detections);
            self.first_round(frame.detections, context);
            self.low_score_round(frame.detections, context);
            self.recovery_round(frame.detections, context);
            for &track in &self.work.unmatched {
                self.tracks[track as usize].miss(&mut self.work.frozen);
            }
            self.start_tracks(frame.detections, context);
        }
        let (max_age, rate) = (self.parameters.max_age, context.frame_rate);
        let (min_hits, detector_frames) = (self.parameters.min_hits, context.detector_frames);
        let judge = |t: &mut ObservedTrack| match frame.detector_skipped {
            true => (),
            false => t.run.judge(min_hits, detector_frames),
        };
        let Workspace { spare, frozen, .. } = &mut self.work;
        list_and_remove(
            &mut self.tracks,
            output,
            judge,
            |t| t.run.is_over(max_age),
            |t| t.shown(rate, !frame.detector_skipped),
            |t| spare.put(t.retire(frozen)),
        );
    }

    fn reset(&mut self) {
        let Workspace { spare, frozen, .. } = &mut self.work;
        self.tracks.drain(..).for_each(|t| spare.put(t.retire(frozen)));
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
