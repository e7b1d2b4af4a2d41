//! What can go wrong, each with the field or row at fault.

/// A number in a message: in digits, or with an exponent where those would fill the line.
pub(crate) struct Number(pub f64);

impl std::fmt::Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let x = self.0;
        if x == 0.0 || !x.is_finite() || (1e-6..1e15).contains(&x.abs()) {
            write!(f, "{x}")
        } else {
            write!(f, "{x:e}")
        }
    }
}

/// An error of the library. After any of them the object it came from is as it was before the call.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// A field of a detection is out of range.
    #[error("detections[{row}].{field}: {reason}")]
    Detection {
        /// Row of the detection.
        row: usize,
        /// Field at fault.
        field: &'static str,
        /// What was wrong and what is allowed.
        reason: String,
    },
    /// The image's size, stride, format or buffer do not fit together.
    #[error("image.{field}: {reason}")]
    Image {
        /// Field at fault.
        field: &'static str,
        /// What was wrong and what is allowed.
        reason: String,
    },
    /// Embeddings that do not fit the detections or the frames before, or are not finite.
    #[error("frame.{field}: {reason}")]
    Embeddings {
        /// Field at fault.
        field: &'static str,
        /// What was wrong and what is allowed.
        reason: String,
    },
    /// A camera motion that is not finite or folds the image up.
    #[error("camera_motion: {0}")]
    CameraMotion(String),
    /// A timestamp that does not grow.
    #[error("timestamp_ns: {0}")]
    Timestamp(String),
    /// Another field of the frame.
    #[error("frame.{field}: {reason}")]
    Frame {
        /// Field at fault.
        field: &'static str,
        /// What was wrong and what is allowed.
        reason: String,
    },
    /// More than a configured limit allows.
    #[error("{what}: {count} exceeds the limit of {limit} (parameter {parameter})")]
    Limit {
        /// What there is too much of.
        what: &'static str,
        /// How many.
        count: usize,
        /// The limit.
        limit: usize,
        /// The parameter that sets the limit.
        parameter: &'static str,
    },
    /// No algorithm of that name.
    #[error("unknown algorithm \"{name}\"; known are {known}")]
    UnknownAlgorithm {
        /// The name asked for.
        name: String,
        /// The names that exist.
        known: String,
    },
    /// No parameter of that key.
    #[error("unknown parameter \"{key}\" of {algorithm}")]
    UnknownParameter {
        /// The key asked for.
        key: String,
        /// The algorithm.
        algorithm: &'static str,
    },
    /// A parameter's value is of the wrong type or out of range.
    #[error("parameter {key}: {reason}")]
    ParameterValue {
        /// The key.
        key: String,
        /// What was wrong and what is allowed.
        reason: String,
    },
    /// Text that is not valid TOML, or has the wrong shape.
    #[error("configuration: {0}")]
    ConfigSyntax(String),
    /// Bytes that are no snapshot of a tracker, a damaged one, or one of a later version.
    #[error("snapshot {0}")]
    Snapshot(String),
    /// No live track of that identity.
    #[error("no live track has id {0}")]
    UnknownTrack(u64),
}
