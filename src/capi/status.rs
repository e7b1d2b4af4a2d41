//! Status codes and the last error of the thread.

use std::cell::Cell;
use std::ffi::c_char;

use crate::error::Error;

/// Result of every function that can fail: `GT2_OK` or one of the negative `GT2_ERR_...`. Numbers never change
/// meaning; later versions may add some, so treat every negative number as an error.
pub type gt2_status = i32;

/// Success.
pub const GT2_OK: i32 = 0;
/// A pointer that must not be NULL is NULL.
pub const GT2_ERR_NULL_POINTER: i32 = -1;
/// A handle that is not of this type, or has been freed. Detected where possible: this is an aid in finding bugs,
/// not a licence to use freed handles.
pub const GT2_ERR_INVALID_HANDLE: i32 = -2;
/// An index, kind or flag out of its range, a misaligned array, or a size or stride that does not fit.
pub const GT2_ERR_INVALID_ARGUMENT: i32 = -3;
/// A `struct_size` that makes no sense, or a struct of a newer header that uses fields this library does not know.
pub const GT2_ERR_STRUCT_SIZE: i32 = -4;
/// A buffer that is too small; the size that is needed has been stored.
pub const GT2_ERR_BUFFER_TOO_SMALL: i32 = -5;
/// A text that is not UTF-8.
pub const GT2_ERR_INVALID_TEXT: i32 = -6;
/// An internal error was caught: a bug in the library, please report its message. The handle is poisoned.
pub const GT2_ERR_PANIC: i32 = -7;
/// The handle met an internal error before. A tracker works again after `gt2_tracker_reset`; a config can only be
/// freed.
pub const GT2_ERR_POISONED: i32 = -8;
/// This build of the library leaves out what the function needs. A library built with the defaults has everything.
pub const GT2_ERR_UNSUPPORTED: i32 = -9;
/// A field of a detection is out of range.
pub const GT2_ERR_DETECTION: i32 = -20;
/// The image's size, stride, format and buffer do not fit together.
pub const GT2_ERR_IMAGE: i32 = -21;
/// Embeddings that do not fit the detections or the frames before, or are not finite.
pub const GT2_ERR_EMBEDDINGS: i32 = -22;
/// A camera motion that is not finite, not invertible or scales beyond reason.
pub const GT2_ERR_CAMERA_MOTION: i32 = -23;
/// A timestamp that is not greater than the one before.
pub const GT2_ERR_TIMESTAMP: i32 = -24;
/// Another field of the frame is out of range or contradicts the others.
pub const GT2_ERR_FRAME: i32 = -25;
/// More of something than a parameter of the config allows.
pub const GT2_ERR_LIMIT: i32 = -26;
/// No algorithm of that name.
pub const GT2_ERR_UNKNOWN_ALGORITHM: i32 = -40;
/// No parameter of that key.
pub const GT2_ERR_UNKNOWN_PARAMETER: i32 = -41;
/// A parameter's value is of the wrong kind or out of range, or values contradict each other.
pub const GT2_ERR_PARAMETER_VALUE: i32 = -42;
/// Text that is not valid TOML, or not of the expected shape.
pub const GT2_ERR_CONFIG_SYNTAX: i32 = -43;
/// No live track has that identity.
pub const GT2_ERR_UNKNOWN_TRACK: i32 = -44;
/// Bytes that are no snapshot of a tracker, a damaged one, or one of a later version of the library.
pub const GT2_ERR_SNAPSHOT: i32 = -45;

/// Why a call failed.
#[derive(Debug)]
pub(super) struct Failure {
    pub status: gt2_status,
    pub message: String,
}

impl Failure {
    pub fn new(status: gt2_status, message: impl Into<String>) -> Self {
        Self { status, message: message.into() }
    }

    pub fn argument(message: impl Into<String>) -> Self {
        Self::new(GT2_ERR_INVALID_ARGUMENT, message)
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let status = match error {
            Error::Detection { .. } => GT2_ERR_DETECTION,
            Error::Image { .. } => GT2_ERR_IMAGE,
            Error::Embeddings { .. } => GT2_ERR_EMBEDDINGS,
            Error::CameraMotion(_) => GT2_ERR_CAMERA_MOTION,
            Error::Timestamp(_) => GT2_ERR_TIMESTAMP,
            Error::Frame { .. } => GT2_ERR_FRAME,
            Error::Limit { .. } => GT2_ERR_LIMIT,
            Error::UnknownAlgorithm { .. } => GT2_ERR_UNKNOWN_ALGORITHM,
            Error::UnknownParameter { .. } => GT2_ERR_UNKNOWN_PARAMETER,
            Error::ParameterValue { .. } => GT2_ERR_PARAMETER_VALUE,
            Error::ConfigSyntax(_) => GT2_ERR_CONFIG_SYNTAX,
            Error::Snapshot(_) => GT2_ERR_SNAPSHOT,
            Error::UnknownTrack(_) => GT2_ERR_UNKNOWN_TRACK,
        };
        Self::new(status, error.to_string())
    }
}

/// Longest message in bytes, the NUL included; longer ones are cut.
const MESSAGE_SIZE: usize = 1024;

thread_local! {
    /// A fixed buffer, so that the pointer a caller holds never dangles while its thread lives.
    static LAST_ERROR: Cell<[u8; MESSAGE_SIZE]> = const { Cell::new([0; MESSAGE_SIZE]) };
}

/// Makes a failure the last error of this thread and returns its status.
pub(super) fn report(failure: Failure) -> gt2_status {
    let room = failure.message.len().min(MESSAGE_SIZE - 1);
    let end = (0..=room).rev().find(|&i| failure.message.is_char_boundary(i)).unwrap_or(0);
    let text = &failure.message[..end];
    let mut buffer = [0; MESSAGE_SIZE];
    buffer[..text.len()].copy_from_slice(text.as_bytes());
    LAST_ERROR.with(|last| last.set(buffer));
    failure.status
}

/// A short English name of a status, "unknown status" for a number that is none. Static.
#[unsafe(no_mangle)]
pub extern "C" fn gt2_status_str(status: gt2_status) -> *const c_char {
    let text = match status {
        GT2_OK => c"ok",
        GT2_ERR_NULL_POINTER => c"null pointer",
        GT2_ERR_INVALID_HANDLE => c"invalid handle",
        GT2_ERR_INVALID_ARGUMENT => c"invalid argument",
        GT2_ERR_STRUCT_SIZE => c"invalid struct size",
        GT2_ERR_BUFFER_TOO_SMALL => c"buffer too small",
        GT2_ERR_INVALID_TEXT => c"text is not UTF-8",
        GT2_ERR_PANIC => c"internal error",
        GT2_ERR_UNSUPPORTED => c"not in this build",
        GT2_ERR_POISONED => c"handle poisoned by an internal error",
        GT2_ERR_DETECTION => c"invalid detection",
        GT2_ERR_IMAGE => c"invalid image",
        GT2_ERR_EMBEDDINGS => c"invalid embeddings",
        GT2_ERR_CAMERA_MOTION => c"invalid camera motion",
        GT2_ERR_TIMESTAMP => c"timestamp not increasing",
        GT2_ERR_FRAME => c"invalid frame",
        GT2_ERR_LIMIT => c"limit exceeded",
        GT2_ERR_UNKNOWN_ALGORITHM => c"unknown algorithm",
        GT2_ERR_UNKNOWN_PARAMETER => c"unknown parameter",
        GT2_ERR_PARAMETER_VALUE => c"invalid parameter value",
        GT2_ERR_CONFIG_SYNTAX => c"invalid configuration text",
        GT2_ERR_SNAPSHOT => c"invalid snapshot",
        GT2_ERR_UNKNOWN_TRACK => c"unknown track",
        _ => c"unknown status",
    };
    text.as_ptr()
}

/// What went wrong in the last call on this thread that failed: one line that names the field, the row and the
/// range, such as "detections[3].width: is -2, must not be negative". "" if none has failed; calls that succeed
/// leave it alone. The pointer is valid, and always the same, until the thread ends; copy the text to keep it beyond
/// the next call that fails.
#[unsafe(no_mangle)]
pub extern "C" fn gt2_last_error_message() -> *const c_char {
    LAST_ERROR.with(|last| last.as_ptr().cast())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ffi::CStr;

    #[test]
    fn long_messages_are_cut_between_characters() {
        // 1022 bytes, then a character of two bytes that would take bytes 1022 and 1023, where the NUL must be.
        report(Failure::argument(format!("{}\u{e9}", "x".repeat(1022))));
        // SAFETY: the function returns a C string that stays valid until the next failing call.
        let message = unsafe { CStr::from_ptr(gt2_last_error_message()) };
        assert_eq!(message.to_str().unwrap(), "x".repeat(1022));
        report(Failure::argument("short"));
        // SAFETY: as above.
        assert_eq!(unsafe { CStr::from_ptr(gt2_last_error_message()) }, c"short");
    }
}
