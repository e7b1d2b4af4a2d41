//! Snapshots of trackers.

use super::guard::{guard, guard_shared};
use super::handle::give;
use super::pointer::{copy_bytes, require, slice, store};
use super::status::*;
use super::tracker::gt2_tracker;
#[cfg(feature = "snapshot")]
use crate::tracker::Tracker;

/// Writes everything that a tracker knows, its config included, to `buffer`, an array of `capacity` bytes, and stores
/// the number of bytes in `*needed`, which may be NULL; with a `capacity` of 0 that is all it does. If the buffer is
/// too small it stays as it is and `*needed` is stored all the same. `gt2_tracker_load` makes a tracker of the bytes
/// that goes on, in any process and on any machine, exactly as this one would. The tracker is unchanged.
///
/// A later version of the library reads the snapshots of earlier ones.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_BUFFER_TOO_SMALL`, `GT2_ERR_UNSUPPORTED` from a library that was built
/// without snapshots.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_tracker_save(
    tracker: *const gt2_tracker,
    buffer: *mut u8,
    capacity: usize,
    needed: *mut usize,
) -> gt2_status {
    // SAFETY: a handle, a buffer and an output by the contract of the header.
    unsafe { guard_shared(tracker, |t| copy_bytes(&save(t)?, buffer, capacity, needed)) }
}

/// Makes a tracker of the `size` bytes of a snapshot and stores it in `*out`; release it with `gt2_tracker_free`. Its
/// lists are those of the tracker that was saved. On an error `*out` is not written.
///
/// The bytes are checked, so a file that was cut or damaged is refused. They are not a place for secrets, nor proof
/// against someone who forges them: what is loaded from a forged snapshot may track nonsense or end in
/// `GT2_ERR_PANIC`, but harms nothing else.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_SNAPSHOT` for bytes that are no snapshot, a damaged one, or one of a later
/// version, `GT2_ERR_UNSUPPORTED` from a library that was built without snapshots.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_tracker_load(bytes: *const u8, size: usize, out: *mut *mut gt2_tracker) -> gt2_status {
    guard(|| {
        require(out, "out")?;
        // SAFETY: an array by the contract of the header.
        let tracker = load(unsafe { slice(bytes, size, "bytes") }?)?;
        // SAFETY: not NULL; the rest is the contract of the header.
        unsafe { store(out, give(tracker)) };
        Ok(())
    })
}

#[cfg(feature = "snapshot")]
fn save(tracker: &gt2_tracker) -> Result<Vec<u8>, Failure> {
    Ok(tracker.inner().save())
}

#[cfg(feature = "snapshot")]
fn load(bytes: &[u8]) -> Result<gt2_tracker, Failure> {
    Ok(gt2_tracker::new(Tracker::load(bytes)?))
}

#[cfg(not(feature = "snapshot"))]
fn save(_tracker: &gt2_tracker) -> Result<Vec<u8>, Failure> {
    Err(unsupported())
}

#[cfg(not(feature = "snapshot"))]
fn load(_bytes: &[u8]) -> Result<gt2_tracker, Failure> {
    Err(unsupported())
}

#[cfg(not(feature = "snapshot"))]
fn unsupported() -> Failure {
    Failure::new(GT2_ERR_UNSUPPORTED, "this library was built without snapshots")
}
