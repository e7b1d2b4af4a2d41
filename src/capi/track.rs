//! Tracks on their way out.

use super::structs::SizedStruct;
use crate::track::{Track, TrackState};

/// State of a track: born recently, not yet trusted.
pub const GT2_TRACK_TENTATIVE: i32 = 1;
/// State of a track: trusted, and matched with a detection when the detector last ran.
pub const GT2_TRACK_CONFIRMED: i32 = 2;
/// State of a track: trusted, but without a detection when the detector last ran; its box is a prediction.
pub const GT2_TRACK_LOST: i32 = 3;

/// Kind of list: what the tracker stands for in this frame, what a user draws or writes to a file: matched tracks,
/// and lost ones whose predicted box is trusted. Some of the compared trackers report new tracks at once, which then
/// are in this list with the state `GT2_TRACK_TENTATIVE`: botsort and smiletrack always, conftrack in the first frame.
pub const GT2_TRACKS_REPORTED: i32 = 0;
/// Kind of list: tracks too young to be reported; with sort and ocsort also those seen again after a miss until they
/// have been seen often enough in a row, and with gentrack2 those whose box, of doubtful score, is mostly beyond the
/// image's border.
pub const GT2_TRACKS_TENTATIVE: i32 = 1;
/// Kind of list: live tracks without a detection that are not reported, with their predicted box.
pub const GT2_TRACKS_LOST: i32 = 2;

/// One track after a step.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gt2_track {
    /// Identity: unique within its tracker until that is reset, never used again. At least 1.
    pub id: u64,
    /// Left edge of the box in pixels in this frame.
    pub left: f64,
    /// Top edge in pixels.
    pub top: f64,
    /// Width in pixels.
    pub width: f64,
    /// Height in pixels.
    pub height: f64,
    /// Velocity of the box's centre to the right, in pixels per second.
    pub velocity_u: f64,
    /// Velocity of the box's centre downwards, in pixels per second.
    pub velocity_v: f64,
    /// Growth of the width, in pixels per second.
    pub velocity_w: f64,
    /// Growth of the height, in pixels per second.
    pub velocity_h: f64,
    /// Score of the detection last taken, in 0..=1.
    pub score: f64,
    /// Row of the detection taken in this frame, -1 for none.
    pub detection_index: i64,
    /// Tag of the detection last taken.
    pub tag: u64,
    /// Class of the detection last taken.
    pub class_id: i32,
    /// `GT2_TRACK_TENTATIVE`, `GT2_TRACK_CONFIRMED` or `GT2_TRACK_LOST`.
    pub state: i32,
    /// Frames since birth, the birth frame counted as 1.
    pub age: u32,
    /// Detections taken in its life.
    pub hits: u32,
    /// Frames since a detection was last taken; 0 if one was taken in this frame.
    pub frames_since_match: u32,
    /// 0.
    pub reserved: u32,
}

/// A list of tracks that belongs to the tracker. Start from `GT2_TRACK_LIST_INIT`.
///
/// Go through it with `gt2_track_at`: a later library may have larger tracks than this header knows, `stride` bytes
/// apart.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gt2_track_list {
    /// `sizeof(gt2_track_list)`, set by the caller; 0 stands for the first published layout of this struct.
    pub struct_size: usize,
    /// The tracks; NULL if there are none.
    pub tracks: *const gt2_track,
    /// How many there are.
    pub count: usize,
    /// Bytes from one track to the next.
    pub stride: usize,
}

// SAFETY: repr(C), size first, raw pointers and integers only.
unsafe impl SizedStruct for gt2_track_list {
    const NAME: &'static str = "out";
    const FIRST_SIZE: usize = size_of::<gt2_track_list>();
}

impl From<&Track> for gt2_track {
    fn from(t: &Track) -> Self {
        Self {
            id: t.id,
            left: t.rect.left,
            top: t.rect.top,
            width: t.rect.width,
            height: t.rect.height,
            velocity_u: t.velocity.u,
            velocity_v: t.velocity.v,
            velocity_w: t.velocity.w,
            velocity_h: t.velocity.h,
            score: t.score,
            detection_index: t.detection_index.map_or(-1, |i| i as i64),
            tag: t.tag,
            class_id: t.class_id,
            state: match t.state {
                TrackState::Tentative => GT2_TRACK_TENTATIVE,
                TrackState::Confirmed => GT2_TRACK_CONFIRMED,
                TrackState::Lost => GT2_TRACK_LOST,
            },
            age: t.age,
            hits: t.hits,
            frames_since_match: t.frames_since_match,
            reserved: 0,
        }
    }
}
