//! Checks of a frame before any tracker sees it. They read only, so a refused frame leaves no trace.

use crate::error::{Error, Number};
use crate::frame::{CameraMotion, Detection, Embeddings, Frame};
use crate::parameters::CommonParameters;

/// Largest absolute coordinate and size of a box in pixels: far beyond any image, and small enough that areas and
/// sums of squares stay exact enough to compare.
pub const MAX_COORDINATE: f64 = 1e12;

/// What earlier frames fixed.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct History {
    /// Length of the embeddings seen so far.
    pub embedding_dimension: Option<usize>,
    /// The last timestamp seen.
    pub timestamp_ns: Option<i64>,
}

/// How much a frame may hold, by the parameters of the handle. The C ABI asks before it touches what a frame points to,
/// as a size that is a mistake leads out of the caller's memory.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    detections: usize,
    embedding_dimension: usize,
    image_pixels: usize,
}

impl Limits {
    /// Those of a configuration.
    pub fn of(common: &CommonParameters) -> Self {
        Self {
            detections: common.max_detections as usize,
            embedding_dimension: common.max_embedding_dimension as usize,
            image_pixels: common.max_image_pixels as usize,
        }
    }

    /// Refuses too many detections.
    pub fn check_detections(&self, count: usize) -> Result<(), Error> {
        within("detections", count, self.detections, "max_detections")
    }

    /// Refuses embeddings that are too long.
    pub fn check_embedding_dimension(&self, dimension: usize) -> Result<(), Error> {
        within("frame.embedding_dimension", dimension, self.embedding_dimension, "max_embedding_dimension")
    }

    /// Refuses an image of too many pixels.
    pub fn check_image(&self, width: u32, height: u32) -> Result<(), Error> {
        // No overflow where addresses have 32 bits, as a side has 16.
        within(
            "image.width times image.height",
            width as usize * height as usize,
            self.image_pixels,
            "max_image_pixels",
        )
    }
}

fn within(what: &'static str, count: usize, limit: usize, parameter: &'static str) -> Result<(), Error> {
    if count > limit {
        return Err(Error::Limit { what, count, limit, parameter });
    }
    Ok(())
}

/// Checks everything about a frame.
pub fn check_frame(frame: &Frame<'_>, common: &CommonParameters, history: &History) -> Result<(), Error> {
    let limits = Limits::of(common);
    limits.check_detections(frame.detections.len())?;
    if frame.detector_skipped && !frame.detections.is_empty() {
        let reason = format!("is set, yet there are {} detections", frame.detections.len());
        return Err(Error::Frame { field: "detector_skipped", reason });
    }
    for (row, detection) in frame.detections.iter().enumerate() {
        check_detection(row, detection)?;
    }
    if let Some(image) = &frame.image {
        limits.check_image(image.width(), image.height())?;
    }
    if let Some(embeddings) = &frame.embeddings {
        limits.check_embedding_dimension(embeddings.dimension)?;
        check_embeddings(embeddings, frame.detections.len(), history.embedding_dimension)?;
    }
    if let Some(motion) = &frame.camera_motion {
        check_camera_motion(motion)?;
    }
    check_size(frame)?;
    check_timestamp(frame.timestamp_ns, history.timestamp_ns)
}

fn check_detection(row: usize, detection: &Detection) -> Result<(), Error> {
    let refuse = |field, reason| Err(Error::Detection { row, field, reason });
    let r = &detection.rect;
    for (field, x) in [("left", r.left), ("top", r.top), ("width", r.width), ("height", r.height)] {
        if !x.is_finite() {
            return refuse(field, format!("is {x}, must be finite"));
        }
        if x.abs() > MAX_COORDINATE {
            return refuse(field, format!("is {}, its absolute value must be at most {MAX_COORDINATE:e}", Number(x)));
        }
    }
    for (field, x) in [("width", r.width), ("height", r.height)] {
        if x < 0.0 {
            return refuse(field, format!("is {}, must not be negative", Number(x)));
        }
    }
    if !(0.0..=1.0).contains(&detection.score) {
        return refuse("score", format!("is {}, must be in 0..=1", Number(detection.score)));
    }
    Ok(())
}

fn check_embeddings(embeddings: &Embeddings<'_>, rows: usize, known: Option<usize>) -> Result<(), Error> {
    let refuse = |field, reason| Err(Error::Embeddings { field, reason });
    let Embeddings { data, dimension, stride } = *embeddings;
    if dimension == 0 {
        return refuse("embedding_dimension", "is 0, must be at least 1".to_string());
    }
    if let Some(known) = known.filter(|k| *k != dimension) {
        return refuse("embedding_dimension", format!("is {dimension}, earlier frames had {known}"));
    }
    if stride < dimension {
        return refuse("embedding_stride", format!("is {stride}, must be at least embedding_dimension, {dimension}"));
    }
    let needed = match rows {
        0 => Some(0),
        _ => stride.checked_mul(rows - 1).and_then(|n| n.checked_add(dimension)),
    };
    match needed {
        Some(needed) if data.len() >= needed => {}
        _ => return refuse("embeddings", format!("holds {} numbers, too few for {rows} rows", data.len())),
    }
    for row in 0..rows {
        if let Some(column) = embeddings.row(row).iter().position(|x| !x.is_finite()) {
            return refuse(
                "embeddings",
                format!("row {row}: component {column} is {}, must be finite", embeddings.row(row)[column]),
            );
        }
    }
    Ok(())
}

fn check_camera_motion(motion: &CameraMotion) -> Result<(), Error> {
    let m = &motion.0;
    if let Some(index) = m.iter().position(|x| !x.is_finite() || x.abs() > MAX_COORDINATE) {
        let reason =
            format!("element {index} is {}, must be in -{MAX_COORDINATE:e}..={MAX_COORDINATE:e}", Number(m[index]));
        return Err(Error::CameraMotion(reason));
    }
    let (kx, ky) = motion.size_factors();
    let determinant = m[0] * m[4] - m[1] * m[3];
    // A camera does not zoom a thousandfold between two frames; an all-zero matrix is a forgotten one.
    let sane = |k: f64| (1e-3..=1e3).contains(&k);
    if !sane(kx) || !sane(ky) || determinant.abs() < 1e-6 {
        return Err(Error::CameraMotion(format!(
            "scales by {} and {} with determinant {}, must be an invertible map with scales in 0.001..=1000",
            Number(kx),
            Number(ky),
            Number(determinant)
        )));
    }
    Ok(())
}

fn check_size(frame: &Frame<'_>) -> Result<(), Error> {
    let Some((width, height)) = frame.size else { return Ok(()) };
    for (field, side) in [("image_width", width), ("image_height", height)] {
        if side == 0 || side > crate::image::MAX_IMAGE_SIDE {
            let reason = format!("is {side}, must be in 1..={}", crate::image::MAX_IMAGE_SIDE);
            return Err(Error::Frame { field, reason });
        }
    }
    match frame.image {
        Some(image) if (image.width(), image.height()) != (width, height) => {
            let reason = format!("are {width}x{height}, the image is {}x{}", image.width(), image.height());
            Err(Error::Frame { field: "image_width and image_height", reason })
        }
        _ => Ok(()),
    }
}

fn check_timestamp(now: Option<i64>, before: Option<i64>) -> Result<(), Error> {
    match (now, before) {
        (Some(now), Some(before)) if now <= before => Err(Error::Timestamp(format!(
            "is {now}, must be greater than {before}, the previous frame's (one without counts as a frame later)"
        ))),
        _ => Ok(()),
    }
}
