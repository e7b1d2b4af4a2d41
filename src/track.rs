//! What comes back from a step.

use crate::buffers;
use crate::faults::{self, Stage};
use crate::geometry::{Rect, State};

/// Where a track stands in its life.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub enum TrackState {
    /// Born recently, not yet trusted.
    Tentative,
    /// Trusted, and matched with a detection the last time the detector ran (a *strong* track of the paper).
    Confirmed,
    /// Trusted, but without a detection the last time the detector ran (a *weak* track); its box is a prediction.
    Lost,
}

/// One track after a step.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct Track {
    /// Identity: unique within its tracker until that is reset, never used again.
    pub id: u64,
    /// Box in pixels in this frame.
    pub rect: Rect,
    /// Change of the box per second: centre in px/s, size in px/s.
    pub velocity: State,
    /// State.
    pub state: TrackState,
    /// Score of the detection last taken, in `[0, 1]`.
    pub score: f64,
    /// Class of the detection last taken.
    pub class_id: i32,
    /// Tag of the detection last taken.
    pub tag: u64,
    /// Row of the detection taken in this frame, if any.
    pub detection_index: Option<usize>,
    /// Frames since birth, the birth frame counted as 1.
    pub age: u32,
    /// Detections taken in its life.
    pub hits: u32,
    /// Frames since a detection was last taken: 0 when matched in this frame.
    pub frames_since_match: u32,
}

/// One particle of a track: a hypothesis of its box. Laid out as in C, so that the C ABI can lend
/// it as it lies.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Particle {
    /// Box in pixels.
    pub rect: Rect,
    /// Change of the box per second.
    pub velocity: State,
    /// Fitness in `[0, 1]` after optimisation (eq. 4).
    pub fitness: f64,
}

/// How a track without a detection was moved in the last step, of the rules of the paper.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum WeakMove {
    /// By none of them: it has a detection, or its algorithm has no such rules.
    #[default]
    None,
    /// It stays where it is, being slower than `tau_V`.
    Still,
    /// By its own velocity (eq. 12; also in eq. 13 where it overtakes).
    Own,
    /// By the median displacement of its trustworthy neighbours (eq. 13, first case).
    WithNeighbours,
    /// Around neighbours that move otherwise (eq. 13, second case, and 14).
    Around,
}

/// Medians over the trustworthy neighbours of a track, component by component: of their centres, and of the motion of
/// these.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeighbourMotion {
    /// Centre, u and v, in pixels of the current frame.
    pub centre: (f64, f64),
    /// Displacement of the centre since the previous frame in pixels, without the camera's motion.
    pub displacement: (f64, f64),
    /// Velocity of the centre in pixels per second.
    pub velocity: (f64, f64),
}

/// What guided a track without a detection in the last step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Neighbourhood<'a> {
    /// Identities of its neighbours, the trustworthy ones, which have a detection in this frame, first.
    pub neighbours: &'a [u64],
    /// How many of them are trustworthy.
    pub trusted: usize,
    /// Their motion; `None` if nobody is trustworthy.
    pub motion: Option<NeighbourMotion>,
    /// Which rule moved the track.
    pub rule: WeakMove,
}

/// Results of one step, in buffers that are reused from step to step.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct Output {
    /// Tracks the algorithm stands for in this frame: what a user draws or writes to a file. Matched tracks, and
    /// lost ones whose predicted box is trusted; with algorithms that report new tracks at once also tentative ones.
    pub reported: Vec<Track>,
    /// Tracks too young to be reported, seen again and not yet trusted again, or mostly beyond the image's border with
    /// doubtful scores.
    pub tentative: Vec<Track>,
    /// Live tracks without a detection that are not reported, with their predicted box.
    pub lost: Vec<Track>,
    /// Identities that ended in this step; each is named once.
    pub ended: Vec<u64>,
    /// For each detection the identity of the track that took it, 0 for none.
    pub track_of_detection: Vec<u64>,
}

impl Output {
    /// Empties all lists and sizes `track_of_detection` for a frame of `detections` rows.
    pub fn begin(&mut self, detections: usize) {
        self.reported.clear();
        self.tentative.clear();
        self.lost.clear();
        self.ended.clear();
        self.track_of_detection.clear();
        self.track_of_detection.resize(detections, 0);
    }

    /// Lists a live track where it belongs, and its identity beside its detection. A track that is not `reported` is
    /// listed by its state.
    pub(crate) fn list(&mut self, track: Track, reported: bool) {
        faults::point(Stage::Output);
        if let Some(row) = track.detection_index {
            self.track_of_detection[row] = track.id;
        }
        match track.state {
            _ if reported => buffers::push(&mut self.reported, track),
            TrackState::Lost => buffers::push(&mut self.lost, track),
            TrackState::Tentative | TrackState::Confirmed => buffers::push(&mut self.tentative, track),
        }
    }
}
