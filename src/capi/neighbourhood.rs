//! What guided a track without a detection, on its way out.

use super::pointer::start;
use super::structs::SizedStruct;
use crate::track::{Neighbourhood, WeakMove};

/// Rule that moved a track: none of those below; it has a detection, or its algorithm has no such rules.
pub const GT2_MOVE_NONE: i32 = 0;
/// Rule that moved a track: it stays where it is, its speed being below the parameter still_speed.
pub const GT2_MOVE_STILL: i32 = 1;
/// Rule that moved a track: its own velocity (eq. 12 of the paper), for want of trustworthy neighbours that move, or
/// because it overtakes them.
pub const GT2_MOVE_OWN: i32 = 2;
/// Rule that moved a track: the median displacement of its trustworthy neighbours (eq. 13, first case), which move as
/// it does.
pub const GT2_MOVE_WITH_NEIGHBOURS: i32 = 3;
/// Rule that moved a track: around its trustworthy neighbours (eq. 13, second case, and eq. 14), which move otherwise.
pub const GT2_MOVE_AROUND: i32 = 4;

/// The neighbours of a track that has no detection, and how they guided it (eq. 11 to 14 of the paper). The algorithm
/// gentrack2 has such. Start from `GT2_NEIGHBOURHOOD_INIT`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gt2_neighbourhood {
    /// `sizeof(gt2_neighbourhood)`, set by the caller; 0 stands for the first published layout of this struct.
    pub struct_size: usize,
    /// Identities of the neighbours: tracks within neighbour_radius, or if nobody is, within neighbour_radius_expanded
    /// (both are parameters). The trustworthy ones, which took a detection in this frame, come first. Some may have
    /// ended in the same step. NULL if there are none.
    pub neighbours: *const u64,
    /// How many there are.
    pub count: usize,
    /// How many of them are trustworthy; if it is 0, the medians below are 0.
    pub trusted_count: usize,
    /// Median of the trustworthy neighbours' centres, to the right, in pixels.
    pub centre_u: f64,
    /// The same downwards.
    pub centre_v: f64,
    /// Median of what these centres moved by since the previous frame, to the right, in pixels; the camera's motion,
    /// where it is given, is taken out.
    pub displacement_u: f64,
    /// The same downwards.
    pub displacement_v: f64,
    /// Median of the trustworthy neighbours' velocities to the right, in pixels per second.
    pub velocity_u: f64,
    /// The same downwards.
    pub velocity_v: f64,
    /// Which rule moved the track, one of `GT2_MOVE_...`.
    pub rule: i32,
    /// 0.
    pub reserved: i32,
}

// SAFETY: repr(C), size first, a raw pointer and numbers only.
unsafe impl SizedStruct for gt2_neighbourhood {
    const NAME: &'static str = "out";
    const FIRST_SIZE: usize = size_of::<gt2_neighbourhood>();
}

impl From<&Neighbourhood<'_>> for gt2_neighbourhood {
    fn from(n: &Neighbourhood<'_>) -> Self {
        let (centre, displacement, velocity) =
            n.motion.map_or_else(Default::default, |m| (m.centre, m.displacement, m.velocity));
        Self {
            struct_size: 0,
            neighbours: start(n.neighbours),
            count: n.neighbours.len(),
            trusted_count: n.trusted,
            centre_u: centre.0,
            centre_v: centre.1,
            displacement_u: displacement.0,
            displacement_v: displacement.1,
            velocity_u: velocity.0,
            velocity_v: velocity.1,
            rule: match n.rule {
                WeakMove::None => GT2_MOVE_NONE,
                WeakMove::Still => GT2_MOVE_STILL,
                WeakMove::Own => GT2_MOVE_OWN,
                WeakMove::WithNeighbours => GT2_MOVE_WITH_NEIGHBOURS,
                WeakMove::Around => GT2_MOVE_AROUND,
            },
            reserved: 0,
        }
    }
}
