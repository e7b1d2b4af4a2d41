//! The tracker handle.

use std::ffi::c_char;
use std::ptr::null;

use super::config::gt2_config;
use super::frame::{gt2_frame, read_frame};
use super::guard::{find_in, guard, guard_exclusive, guard_healing, guard_shared};
use super::handle::{Handle, Header, give, take};
use super::neighbourhood::gt2_neighbourhood;
use super::particle::{gt2_particle, gt2_particle_list};
use super::pointer::{require, start, store};
use super::status::*;
use super::track::*;
use super::{structs, tables};
use crate::buffers;
use crate::faults::{self, Stage};
use crate::frame::Detection;
use crate::track::Output;
use crate::tracker::Tracker;
use crate::validation::Limits;

/// Tracks the objects of one video stream. Made by `gt2_tracker_new`, released by `gt2_tracker_free`.
// C order, so that the header comes first; cbindgen takes types of stated alignment as opaque.
#[repr(C, align(8))]
pub struct gt2_tracker {
    header: Header,
    tracker: Tracker,
    /// The caller's detections; kept for its memory.
    detections: Vec<Detection>,
    tracks: TrackLists,
}

/// The output's tracks in their C form.
#[derive(Default)]
struct TrackLists {
    reported: Vec<gt2_track>,
    tentative: Vec<gt2_track>,
    lost: Vec<gt2_track>,
}

impl TrackLists {
    fn fill(&mut self, output: &Output) {
        for (to, from) in [
            (&mut self.reported, &output.reported),
            (&mut self.tentative, &output.tentative),
            (&mut self.lost, &output.lost),
        ] {
            faults::point(Stage::Publishing);
            buffers::collect(to, from.iter().map(gt2_track::from));
        }
    }

    fn of_kind(&self, kind: i32) -> Result<&[gt2_track], Failure> {
        match kind {
            GT2_TRACKS_REPORTED => Ok(&self.reported),
            GT2_TRACKS_TENTATIVE => Ok(&self.tentative),
            GT2_TRACKS_LOST => Ok(&self.lost),
            _ => Err(Failure::argument(format!("kind: is {kind}, must be one of GT2_TRACKS_..."))),
        }
    }
}

// SAFETY: repr(C), header first, and `new` makes it with this tag.
unsafe impl Handle for gt2_tracker {
    const TAG: u64 = 0x6774_3274_7261_636b;
    const NAME: &'static str = "tracker";
    fn header(&self) -> &Header {
        &self.header
    }
}

impl gt2_tracker {
    pub(super) fn new(tracker: Tracker) -> Self {
        let mut tracks = TrackLists::default();
        tracks.fill(tracker.output());
        Self { header: Header::new(Self::TAG), tracker, detections: Vec::new(), tracks }
    }

    #[cfg(feature = "snapshot")]
    pub(super) fn inner(&self) -> &Tracker {
        &self.tracker
    }

    unsafe fn step(&mut self, frame: *const gt2_frame) -> Result<(), Failure> {
        let limits = Limits::of(&self.tracker.config().common);
        // SAFETY: passed on to the caller.
        let frame = unsafe { read_frame(frame, &limits, &mut self.detections) }?;
        let output = self.tracker.step(&frame)?;
        self.tracks.fill(output);
        Ok(())
    }

    fn reset(&mut self) -> Result<(), Failure> {
        // A panic may have left anything behind, so nothing of the old tracker is kept.
        self.tracker = Tracker::new(self.tracker.config())?;
        self.tracks.fill(self.tracker.output());
        Ok(())
    }
}

/// Makes a tracker with a copy of `config` and stores it in `*out`. The first identity is the parameter first_id.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_PARAMETER_VALUE` if parameters contradict each other.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_tracker_new(config: *const gt2_config, out: *mut *mut gt2_tracker) -> gt2_status {
    // SAFETY: a handle and an output by the contract of the header.
    unsafe {
        guard_shared(config, |c| {
            require(out, "out")?;
            store(out, give(gt2_tracker::new(Tracker::new(c.config())?)));
            Ok(())
        })
    }
}

/// Releases a tracker and all lists borrowed from it; NULL is ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_tracker_free(tracker: *mut gt2_tracker) {
    guard(|| {
        // SAFETY: the handle is given up by the caller.
        let taken = unsafe { take(tracker) }?;
        faults::point(Stage::Freeing);
        drop(taken);
        Ok(())
    });
}

/// Forgets everything but the config: the next step is as the first of a new tracker, identities start over. Also
/// makes a tracker usable again that met an internal error. Borrowed lists end.
///
/// Errors: `GT2_ERR_NULL_POINTER`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_tracker_reset(tracker: *mut gt2_tracker) -> gt2_status {
    // SAFETY: a handle by the contract of the header.
    unsafe { guard_healing(tracker, gt2_tracker::reset) }
}

/// Advances by one frame. Afterwards the functions below tell what became of the tracks; lists borrowed before have
/// ended. On an error the tracker, the results of the last step included, is as before the call, and the next step
/// gives what it would have given without it (except after `GT2_ERR_PANIC`).
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_INVALID_ARGUMENT`, `GT2_ERR_STRUCT_SIZE`, and for the contents of the frame
/// `GT2_ERR_DETECTION`, `GT2_ERR_IMAGE`, `GT2_ERR_EMBEDDINGS`, `GT2_ERR_CAMERA_MOTION`, `GT2_ERR_TIMESTAMP`,
/// `GT2_ERR_FRAME`, `GT2_ERR_LIMIT`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_tracker_step(tracker: *mut gt2_tracker, frame: *const gt2_frame) -> gt2_status {
    // SAFETY: a handle and a frame by the contract of the header.
    unsafe { guard_exclusive(tracker, |t| t.step(frame)) }
}

/// Name of the tracker's algorithm. Static. NULL if `tracker` is not a tracker.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_tracker_algorithm(tracker: *const gt2_tracker) -> *const c_char {
    // SAFETY: a handle by the contract of the header.
    unsafe { find_in(tracker, null(), |t| Ok(tables::of(t.tracker.algorithm()).name.as_ptr())) }
}

/// Lists the tracks of a kind, `GT2_TRACKS_REPORTED`, `GT2_TRACKS_TENTATIVE` or `GT2_TRACKS_LOST`, after the last
/// step, in `*out`, whose `struct_size` the caller has set. The list is borrowed from the tracker until its next step,
/// reset or release. A live track is in exactly one of the three lists.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_INVALID_ARGUMENT`, `GT2_ERR_STRUCT_SIZE`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_tracker_tracks(
    tracker: *const gt2_tracker,
    kind: i32,
    out: *mut gt2_track_list,
) -> gt2_status {
    // SAFETY: a handle and an output by the contract of the header.
    unsafe {
        guard_shared(tracker, |t| {
            let list = t.tracks.of_kind(kind)?;
            let (tracks, stride) = (start(list), size_of::<gt2_track>());
            structs::write(out, &gt2_track_list { struct_size: 0, tracks, count: list.len(), stride })
        })
    }
}

/// Copies the tracks of a kind to `buffer`, an array of `capacity` elements of `element_size` bytes, which is
/// `sizeof(gt2_track)`; fields that this library does not know become 0. Stores the number of tracks in `*needed`,
/// which may be NULL; with a `capacity` of 0 that is all it does. If the buffer is too small it stays as it is and
/// `*needed` is stored all the same.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_INVALID_ARGUMENT`, `GT2_ERR_BUFFER_TOO_SMALL`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_tracker_copy_tracks(
    tracker: *const gt2_tracker,
    kind: i32,
    buffer: *mut gt2_track,
    element_size: usize,
    capacity: usize,
    needed: *mut usize,
) -> gt2_status {
    // SAFETY: a handle, a buffer and an output by the contract of the header.
    unsafe {
        guard_shared(tracker, |t| {
            let list = t.tracks.of_kind(kind)?;
            if capacity == 0 {
                require(needed, "needed (with capacity 0)")?;
            } else {
                require(buffer, "buffer")?;
                check_element_size(element_size)?;
            }
            if !needed.is_null() {
                store(needed, list.len());
            }
            if capacity == 0 {
                return Ok(());
            }
            if list.len() > capacity {
                let reason = format!("capacity: is {capacity}, there are {} tracks", list.len());
                return Err(Failure::new(GT2_ERR_BUFFER_TOO_SMALL, reason));
            }
            for (i, track) in list.iter().enumerate() {
                let row = buffer.cast::<u8>().add(i * element_size);
                structs::write_row(row, element_size, (&raw const *track).cast(), size_of::<gt2_track>(), 0);
            }
            Ok(())
        })
    }
}

/// Size of `gt2_track` in its first published layout; no header has a smaller one.
const FIRST_TRACK_SIZE: usize = size_of::<gt2_track>();

fn check_element_size(size: usize) -> Result<(), Failure> {
    if (FIRST_TRACK_SIZE..=4096).contains(&size) {
        return Ok(());
    }
    Err(Failure::argument(format!("element_size: is {size}, must be sizeof(gt2_track), in {FIRST_TRACK_SIZE}..=4096")))
}

/// Stores in `*ids` and `*count` the identities that ended in the last step, each named in one step only. Borrowed as
/// in `gt2_tracker_tracks`; NULL if there are none.
///
/// Errors: `GT2_ERR_NULL_POINTER`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_tracker_ended(
    tracker: *const gt2_tracker,
    ids: *mut *const u64,
    count: *mut usize,
) -> gt2_status {
    // SAFETY: a handle and outputs by the contract of the header.
    unsafe { list_ids(tracker, ids, count, |output| &output.ended) }
}

/// Stores in `*ids` and `*count` for each detection of the last step, in their order, the identity of the track that
/// took it, 0 for none. Borrowed as in `gt2_tracker_tracks`; NULL if there were no detections.
///
/// Errors: `GT2_ERR_NULL_POINTER`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_tracker_track_of_detection(
    tracker: *const gt2_tracker,
    ids: *mut *const u64,
    count: *mut usize,
) -> gt2_status {
    // SAFETY: a handle and outputs by the contract of the header.
    unsafe { list_ids(tracker, ids, count, |output| &output.track_of_detection) }
}

unsafe fn list_ids(
    tracker: *const gt2_tracker,
    ids: *mut *const u64,
    count: *mut usize,
    list: fn(&Output) -> &Vec<u64>,
) -> gt2_status {
    // SAFETY: passed on to the caller.
    unsafe {
        guard_shared(tracker, |t| {
            require(ids, "ids")?;
            require(count, "count")?;
            let list = list(t.tracker.output());
            store(ids, start(list));
            store(count, list.len());
            Ok(())
        })
    }
}

/// Lists the particles of the live track `id` as they were in the last step, in `*out`, whose `struct_size` the caller
/// has set. Borrowed as in `gt2_tracker_tracks`. Empty for algorithms without particles.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_UNKNOWN_TRACK`, `GT2_ERR_STRUCT_SIZE`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_tracker_particles(
    tracker: *const gt2_tracker,
    id: u64,
    out: *mut gt2_particle_list,
) -> gt2_status {
    // SAFETY: a handle and an output by the contract of the header.
    unsafe {
        guard_shared(tracker, |t| {
            let list = t.tracker.particles(id)?;
            // The layouts are the same, see `particle.rs`.
            let (particles, stride) = (start(list).cast::<gt2_particle>(), size_of::<gt2_particle>());
            structs::write(out, &gt2_particle_list { struct_size: 0, particles, count: list.len(), stride })
        })
    }
}

/// Tells in `*out`, whose `struct_size` the caller has set, which neighbours the live track `id` had in the last step
/// and how they guided it, if it has no detection. Borrowed as in `gt2_tracker_tracks`. Empty for a track with a
/// detection, for one that is kept without being moved, for algorithms without such guidance, and after
/// `gt2_tracker_load` until the next step.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_UNKNOWN_TRACK`, `GT2_ERR_STRUCT_SIZE`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_tracker_neighbourhood(
    tracker: *const gt2_tracker,
    id: u64,
    out: *mut gt2_neighbourhood,
) -> gt2_status {
    // SAFETY: a handle and an output by the contract of the header.
    unsafe {
        guard_shared(tracker, |t| {
            let neighbourhood = t.tracker.neighbourhood(id)?;
            structs::write(out, &gt2_neighbourhood::from(&neighbourhood))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::detection::gt2_detection;
    use super::*;
    use crate::config::Config;
    use crate::frame::Frame;
    use crate::geometry::{Rect, State};
    use crate::track::{Particle, Track, TrackState};
    use crate::tracker::StepContext;
    use crate::trackers::TrackingAlgorithm;
    use std::ffi::CStr;

    /// Panics in a step with two detections, half-way through its output, and when asked for particles.
    struct Fragile;

    impl TrackingAlgorithm for Fragile {
        fn step(&mut self, frame: &Frame<'_>, context: &mut StepContext<'_>, output: &mut Output) {
            output.reported.push(Track {
                id: context.ids.take(),
                rect: Rect::new(1.0, 2.0, 3.0, 4.0),
                velocity: State::default(),
                state: TrackState::Confirmed,
                score: 0.5,
                class_id: 0,
                tag: 0,
                detection_index: None,
                age: 1,
                hits: 1,
                frames_since_match: 0,
            });
            assert!(frame.detections.len() != 2, "two are too many");
        }

        fn reset(&mut self) {}

        #[cfg(feature = "snapshot")]
        fn save(&self, _state: &mut crate::snapshot::Encoder) {}

        #[cfg(feature = "snapshot")]
        fn load(&mut self, _state: &mut crate::snapshot::Decoder<'_>) -> Result<(), crate::Error> {
            Ok(())
        }

        fn particles(&self, _id: u64) -> &[Particle] {
            panic!("no particles here");
        }
    }

    fn fragile_tracker() -> *mut gt2_tracker {
        let config = Config::new("gentrack2").unwrap();
        let tracker = Tracker::with_algorithm(&config, Box::new(Fragile));
        give(gt2_tracker::new(tracker))
    }

    fn frame_of(detections: &[gt2_detection]) -> gt2_frame {
        // SAFETY: all zero is a legal frame.
        let empty: gt2_frame = unsafe { std::mem::zeroed() };
        gt2_frame { detections: detections.as_ptr(), detection_count: detections.len(), ..empty }
    }

    fn empty_list() -> gt2_track_list {
        gt2_track_list { struct_size: 0, tracks: null(), count: 0, stride: 0 }
    }

    fn last_error() -> &'static str {
        // SAFETY: the function returns a C string that stays valid until the next failing call.
        unsafe { CStr::from_ptr(gt2_last_error_message()) }.to_str().unwrap()
    }

    #[test]
    fn a_panic_poisons_the_tracker_until_it_is_reset() {
        // SAFETY: all zero is a legal detection.
        let detections: [gt2_detection; 2] = unsafe { std::mem::zeroed() };
        let tracker = fragile_tracker();
        let mut list = empty_list();
        let (mut ids, mut count) = (null(), 7);
        let mut particles = gt2_particle_list { struct_size: 0, particles: null(), count: 7, stride: 0 };
        let mut needed = 7;
        // SAFETY: a live handle and live arguments throughout.
        unsafe {
            assert_eq!(gt2_tracker_step(tracker, &frame_of(&detections[..1])), GT2_OK);
            assert_eq!(gt2_tracker_tracks(tracker, GT2_TRACKS_REPORTED, &mut list), GT2_OK);
            assert_eq!(list.count, 1);

            assert_eq!(gt2_tracker_step(tracker, &frame_of(&detections)), GT2_ERR_PANIC);
            let message = last_error();
            assert!(message.starts_with("internal error: two are too many at "), "{message}");
            assert!(message.contains("tracker.rs:"), "{message}");

            assert_eq!(gt2_tracker_step(tracker, &frame_of(&detections[..1])), GT2_ERR_POISONED);
            assert_eq!(last_error(), "tracker met an internal error before");
            assert_eq!(gt2_tracker_tracks(tracker, GT2_TRACKS_REPORTED, &mut list), GT2_ERR_POISONED);
            assert_eq!(gt2_tracker_copy_tracks(tracker, 0, std::ptr::null_mut(), 0, 0, &mut needed), GT2_ERR_POISONED);
            assert_eq!(gt2_tracker_ended(tracker, &mut ids, &mut count), GT2_ERR_POISONED);
            assert_eq!(gt2_tracker_track_of_detection(tracker, &mut ids, &mut count), GT2_ERR_POISONED);
            assert_eq!(gt2_tracker_particles(tracker, 1, &mut particles), GT2_ERR_POISONED);
            let mut around: gt2_neighbourhood = std::mem::zeroed();
            assert_eq!(gt2_tracker_neighbourhood(tracker, 1, &mut around), GT2_ERR_POISONED);
            assert!(gt2_tracker_algorithm(tracker).is_null());
            assert_eq!((count, particles.count, needed), (7, 7, 7));

            assert_eq!(gt2_tracker_reset(tracker), GT2_OK);
            assert_eq!(gt2_tracker_tracks(tracker, GT2_TRACKS_REPORTED, &mut list), GT2_OK);
            assert_eq!(list.count, 0);
            assert_eq!(gt2_tracker_step(tracker, &frame_of(&detections)), GT2_OK);
            gt2_tracker_free(tracker);
        }
    }

    #[test]
    fn a_panic_in_a_reading_function_poisons_too_and_a_poisoned_tracker_can_be_freed() {
        let tracker = fragile_tracker();
        let mut list = gt2_particle_list { struct_size: 0, particles: null(), count: 7, stride: 0 };
        // SAFETY: a live handle and live arguments throughout.
        unsafe {
            assert_eq!(gt2_tracker_step(tracker, &frame_of(&[])), GT2_OK);
            assert_eq!(gt2_tracker_particles(tracker, 1, &mut list), GT2_ERR_PANIC);
            assert!(last_error().starts_with("internal error: no particles here at "));
            assert_eq!(list.count, 7);
            assert_eq!(gt2_tracker_step(tracker, &frame_of(&[])), GT2_ERR_POISONED);
            gt2_tracker_free(tracker);
        }
    }
}
