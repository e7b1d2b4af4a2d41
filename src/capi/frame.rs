//! Everything about one frame on its way in.

use super::detection::{gt2_detection, read_detections};
use super::image::{gt2_image, read_image};
use super::pointer::{require, slice};
use super::status::*;
use super::structs::{self, SizedStruct};
use crate::faults::{self, Stage};
use crate::frame::{CameraMotion, Detection, Embeddings, Frame};
use crate::validation::Limits;

/// What is known about one frame. Start from `GT2_FRAME_INIT`, or from all zeros, and fill in what there is. All
/// memory it points to is the caller's and is read during `gt2_tracker_step` only.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gt2_frame {
    /// `sizeof(gt2_frame)`; 0 stands for the first published layout of this struct.
    pub struct_size: usize,
    /// The detections, `detection_count` of them. None at all is normal.
    pub detections: *const gt2_detection,
    /// Number of detections, at most the parameter max_detections.
    pub detection_count: usize,
    /// Bytes from one detection to the next, at least `sizeof(gt2_detection)`; more if they are part of a larger
    /// struct of the caller's. 0 stands for the first published size of `gt2_detection`.
    pub detection_stride: usize,
    /// Appearance embeddings (re-identification features) of the detections, one row per detection in the same
    /// order, finite; NULL if there are none. They need not be normalised.
    pub embeddings: *const f32,
    /// Floats per embedding, at most the parameter max_embedding_dimension, the same for all frames until the tracker
    /// is reset; 0 without embeddings.
    pub embedding_dimension: usize,
    /// Floats from the start of one embedding to the start of the next; 0 for `embedding_dimension`.
    pub embedding_stride: usize,
    /// The image, NULL if there is none. Trackers that look at appearance use it, the others do not mind it.
    pub image: *const gt2_image,
    /// How the camera moved: 6 numbers a b c d e f that take a point (x, y) of the previous frame to
    /// (a x + b y + c, d x + e y + f) in this one, in pixels (OpenCV's 2x3 affine matrix, row by row). NULL if it
    /// is not known; the identity says that it stood still, which trackers then need not guess.
    pub camera_motion: *const f64,
    /// Width of the frame in pixels where no image is given, otherwise 0 or the image's; 0 with `image_height` 0 if
    /// unknown. gentrack2 ends tracks sooner that are known to be out of the frame, and takes boxes that are mostly
    /// beyond its border less seriously.
    pub image_width: u32,
    /// Height of the frame in pixels, as `image_width`.
    pub image_height: u32,
    /// With `has_timestamp` 1: when the frame was taken, in nanoseconds from any fixed origin, greater than in the
    /// frame before. Motion and lifetimes follow the time that passed.
    pub timestamp_ns: i64,
    /// 1 if `timestamp_ns` is set; 0: it is ignored, the frame comes one interval of the parameter frame_rate after
    /// the one before.
    pub has_timestamp: i32,
    /// 1 if the detector did not run on this frame (and there are no detections): tracks move on and are not blamed
    /// for a miss. 0 if it ran, even if it found nothing. Time passes all the same: for a track that is not matched when
    /// the detector runs again, its whole rest counts as time without a match.
    pub detector_skipped: i32,
}

// SAFETY: repr(C), size first, raw pointers and integers only.
unsafe impl SizedStruct for gt2_frame {
    const NAME: &'static str = "frame";
    const FIRST_SIZE: usize = size_of::<gt2_frame>();
}

/// Checks what only the ABI can get wrong and borrows the rest; `detections` is a buffer to reuse.
///
/// # Safety
/// `frame` can be read up to its stated size, and the memory that it points to as stated there does not change
/// during `'a`.
pub(super) unsafe fn read_frame<'a>(
    frame: *const gt2_frame,
    limits: &Limits,
    detections: &'a mut Vec<Detection>,
) -> Result<Frame<'a>, Failure> {
    // SAFETY: the caller's promise, here and below.
    let f = unsafe { structs::read(frame) }?;
    faults::fallible(Stage::Borrowing, Failure::argument)?;
    let has_timestamp = flag(f.has_timestamp, "has_timestamp")?;
    let detector_skipped = flag(f.detector_skipped, "detector_skipped")?;
    // SAFETY: as above.
    unsafe {
        read_detections(f.detections, f.detection_count, f.detection_stride, limits, detections)?;
        let image = if f.image.is_null() { None } else { Some(read_image(f.image, limits)?) };
        let camera_motion = if f.camera_motion.is_null() {
            None
        } else {
            Some(CameraMotion(f.camera_motion.cast::<[f64; 6]>().read_unaligned()))
        };
        let size = (f.image_width != 0 || f.image_height != 0).then_some((f.image_width, f.image_height));
        Ok(Frame {
            detections,
            detector_skipped,
            embeddings: read_embeddings(&f, limits)?,
            image,
            size,
            camera_motion,
            timestamp_ns: has_timestamp.then_some(f.timestamp_ns),
        })
    }
}

/// # Safety
/// See [`read_frame`].
unsafe fn read_embeddings<'a>(f: &gt2_frame, limits: &Limits) -> Result<Option<Embeddings<'a>>, Failure> {
    let (rows, dimension) = (f.detection_count, f.embedding_dimension);
    if dimension == 0 && (f.embeddings.is_null() || rows == 0) {
        return Ok(None);
    }
    let stride = if f.embedding_stride == 0 { dimension } else { f.embedding_stride };
    limits.check_embedding_dimension(dimension)?;
    // A senseless stride is refused, with its reason, by the checks that all frames go through; until then nothing may be
    // read.
    if stride < dimension || rows == 0 {
        return Ok(Some(Embeddings { data: &[], dimension, stride }));
    }
    require(f.embeddings, "frame.embeddings")?;
    let span = stride.checked_mul(rows - 1).and_then(|n| n.checked_add(dimension));
    let span = span.ok_or_else(|| Failure::argument(format!("frame.embedding_stride: is {stride}, far too large")))?;
    // SAFETY: the caller's promise.
    let data = unsafe { slice(f.embeddings, span, "frame.embeddings") }?;
    Ok(Some(Embeddings { data, dimension, stride }))
}

fn flag(value: i32, field: &str) -> Result<bool, Failure> {
    match value {
        0 | 1 => Ok(value == 1),
        _ => Err(Failure::argument(format!("frame.{field}: is {value}, must be 0 or 1"))),
    }
}
