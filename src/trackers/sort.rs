//! SORT: a Kalman filter and IoU. Bewley et al., "Simple Online and Realtime Tracking", ICIP 2016.

use super::TrackingAlgorithm;
use super::life::{Life, SMALLEST, presentable, presentable_velocity};
use super::sort_family::{FullAssociation, Run, list_and_remove};
use crate::assignment::UNMATCHED;
use crate::buffers;
use crate::error::Error;
use crate::faults::{self, Stage};
use crate::frame::{Detection, Frame};
use crate::geometry::Rect;
use crate::kalman::{AreaRatio, Measurement, is_sane};
use crate::parameters::{only_default_preset, parameters};
#[cfg(feature = "snapshot")]
use crate::snapshot::{Decoder, Encoder};
use crate::track::{Output, Track};
use crate::tracker::StepContext;

parameters! {
    /// Parameters of SORT.
    pub struct SortParameters {
        /// Detections of a lower score are ignored. The publication leaves this to its user: give 0.6 or so where the
        /// detector reports weak ones, too.
        min_score: f64 = 0.0, [0.0, 1.0], "", "";
        /// Frames without a match that a track survives.
        max_age: i64 = 1, [0, 1_000_000], "frames", "";
        /// Matches in a row, the birth not counted, from which a track is reported; also the number of first frames in
        /// which whatever is seen is reported.
        min_hits: i64 = 3, [0, 1_000_000], "matches", "";
        /// Smallest IoU of a pair. Boxes must overlap in any case.
        iou_threshold: f64 = 0.3, [0.0, 1.0], "", "";
        /// Whether tracks go along with the camera, where its motion is given. Not in the publication.
        use_camera_motion: bool = false, [], "", "";
    }
}
only_default_preset!(SortParameters);

impl SortParameters {
    /// A tracker with these parameters.
    pub fn build(&self) -> Result<Box<dyn TrackingAlgorithm>, Error> {
        Ok(Box::new(Sort { parameters: self.clone(), ..Default::default() }))
    }
}

/// A track.
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
struct SortTrack {
    life: Life,
    run: Run,
    filter: AreaRatio,
}

impl SortTrack {
    fn shown(&self, frame_rate: f64) -> (Track, bool) {
        let rect = presentable(&self.filter.state(), &self.life.last);
        let velocity = presentable_velocity(self.filter.velocity(), frame_rate);
        (self.life.track(rect, velocity, self.run.state()), self.run.is_reported())
    }
}

/// The tracker.
#[derive(Default)]
struct Sort {
    parameters: SortParameters,
    /// In the order of their births.
    tracks: Vec<SortTrack>,
    /// Rows of the usable detections.
    rows: Vec<u32>,
    association: FullAssociation,
}

impl Sort {
    fn predict(&mut self, frame: &Frame<'_>, dt: f64, output: &mut Output) {
        let motion = frame.camera_motion.as_ref().filter(|_| self.parameters.use_camera_motion);
        for track in &mut self.tracks {
            track.life.next_frame();
            track.filter.clamp_area(dt);
            track.filter.predict(dt);
            if let Some(motion) = motion {
                track.filter.follow_camera(motion);
            }
        }
        // A box without a size has no future.
        let ended = self.tracks.extract_if(.., |t| !is_sane(&t.filter.state()));
        output.ended.extend(ended.map(|t| t.life.id));
    }

    fn associate(&mut self, frame: &Frame<'_>, context: &StepContext<'_>) {
        faults::point(Stage::Association);
        let Self { parameters: p, tracks, rows, association } = self;
        let detection = |row: u32| &frame.detections[row as usize];
        let usable = |d: &Detection| d.rect.height >= SMALLEST && d.score >= p.min_score;
        rows.clear();
        rows.extend(frame.detections.iter().zip(0..).filter(|(d, _)| usable(d)).map(|(_, row)| row));
        let allowed = |d: u32, t: u32| {
            let class = tracks[t as usize].life.last.class_id;
            context.classes.allows(class, detection(rows[d as usize]).class_id)
        };
        let boxes = tracks.iter().map(|t| Rect::from(t.filter.state()));
        association.begin(rows.iter().map(|r| detection(*r).rect), boxes, p.iou_threshold, allowed);
        if !association.match_unambiguous() {
            association.best_overlap();
        }
        for (row, &track) in rows.iter().zip(association.partners()).filter(|(_, t)| **t != UNMATCHED) {
            let track = &mut tracks[track as usize];
            track.life.take(*row, detection(*row));
            track.run.matched();
            track.filter.correct(&measure(detection(*row)));
        }
    }

    /// Every detection left over starts a track.
    fn start_tracks(&mut self, frame: &Frame<'_>, context: &mut StepContext<'_>) {
        let room = context.max_tracks.saturating_sub(self.tracks.len());
        let left = self.rows.iter().zip(self.association.partners()).filter(|(_, t)| **t == UNMATCHED);
        for (&row, _) in left.take(room) {
            let detection = &frame.detections[row as usize];
            buffers::push(
                &mut self.tracks,
                SortTrack {
                    life: Life::begin(context.ids.take(), row, detection),
                    run: Run::default(),
                    filter: AreaRatio::new(&measure(detection)),
                },
            );
        }
    }
}

fn measure(detection: &Detection) -> Measurement {
    Measurement::of(&detection.rect, 0.0)
}

impl TrackingAlgorithm for Sort {
    fn step(&mut self, frame: &Frame<'_>, context: &mut StepContext<'_>, output: &mut Output) {
        self.predict(frame, context.elapsed, output);
        if !frame.detector_skipped {
            for track in &mut self.tracks {
                track.run.next_frame(context.since_detector);
            }
            self.associate(frame, context);
            self.start_tracks(frame, context);
        }
        let (max_age, rate) = (self.parameters.max_age, context.frame_rate);
        let (min_hits, detector_frames) = (self.parameters.min_hits, context.detector_frames);
        let judge = |t: &mut SortTrack| match frame.detector_skipped {
            true => (),
            false => t.run.judge(min_hits, detector_frames),
        };
        list_and_remove(&mut self.tracks, output, judge, |t| t.run.is_over(max_age), |t| t.shown(rate), drop);
    }

    fn reset(&mut self) {
        self.tracks.clear();
    }

    #[cfg(feature = "snapshot")]
    fn save(&self, state: &mut Encoder) {
        state.put(&self.tracks);
    }

    #[cfg(feature = "snapshot")]
    fn load(&mut self, state: &mut Decoder<'_>) -> Result<(), Error> {
        self.tracks = state.take()?;
        Ok(())
    }
}
