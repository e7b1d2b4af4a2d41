//! Detections on their way in.

use super::pointer::require;
use super::status::*;
use crate::error::Error;
use crate::frame::Detection;
use crate::geometry::Rect;
use crate::validation::Limits;

/// One detection. All zero is an empty box of score 0, which is legal. Boxes may reach or lie outside the image.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gt2_detection {
    /// Left edge in pixels; finite, of at most 1e12 like all coordinates.
    pub left: f64,
    /// Top edge in pixels; y points down.
    pub top: f64,
    /// Width in pixels, not negative. A box of zero width or height (less than 1e-6) is accepted; with gentrack2 it
    /// belongs to no track, as it overlaps no other box. The other algorithms do with it what their publications do.
    pub width: f64,
    /// Height in pixels, not negative.
    pub height: f64,
    /// Confidence of the detector, in 0..=1.
    pub score: f64,
    /// Class of the object, any number; comes back on the track.
    pub class_id: i32,
    /// Must be 0.
    pub reserved: i32,
    /// Any number of the caller's; comes back on the track that takes this detection.
    pub tag: u64,
}

/// Bytes of `gt2_detection` in its first published layout, which a stride of 0 stands for. Never changes.
const FIRST_SIZE: usize = size_of::<gt2_detection>();

/// Reads the caller's detections into a buffer that is reused from frame to frame.
///
/// # Safety
/// `rows` is NULL or has `count` rows `stride` bytes apart.
pub(super) unsafe fn read_detections(
    rows: *const gt2_detection,
    count: usize,
    stride: usize,
    limits: &Limits,
    into: &mut Vec<Detection>,
) -> Result<(), Failure> {
    into.clear();
    if count == 0 {
        return Ok(());
    }
    require(rows, "frame.detections")?;
    limits.check_detections(count)?;
    let stride = if stride == 0 { FIRST_SIZE } else { stride };
    let most = isize::MAX as usize / count;
    if !(FIRST_SIZE..=most).contains(&stride) {
        let reason = format!("is {stride}, must be in {FIRST_SIZE}..={most} for {count} detections");
        return Err(Failure::argument(format!("frame.detection_stride: {reason}")));
    }
    into.reserve(count);
    for row in 0..count {
        // SAFETY: the row is within the array; rows of a packed array of larger structs may be misaligned.
        let d = unsafe { rows.byte_add(row * stride).read_unaligned() };
        if d.reserved != 0 {
            return Err(
                Error::Detection { row, field: "reserved", reason: format!("is {}, must be 0", d.reserved) }.into()
            );
        }
        let rect = Rect::new(d.left, d.top, d.width, d.height);
        into.push(Detection { rect, score: d.score, class_id: d.class_id, tag: d.tag });
    }
    Ok(())
}
