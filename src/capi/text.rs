//! Texts in and out.

use std::ffi::{CStr, CString, c_char};

use super::pointer::{copy_bytes, require};
use super::status::*;

/// A caller's NUL-terminated text.
///
/// # Safety
/// `pointer` is NULL or a NUL-terminated text that does not change during `'a`.
pub(super) unsafe fn read<'a>(pointer: *const c_char, name: &str) -> Result<&'a str, Failure> {
    require(pointer, name)?;
    // SAFETY: not NULL; the rest is the caller's promise.
    utf8(unsafe { CStr::from_ptr(pointer) }.to_bytes(), name)
}

/// Bytes that should be text.
pub(super) fn utf8<'a>(bytes: &'a [u8], name: &str) -> Result<&'a str, Failure> {
    std::str::from_utf8(bytes).map_err(|e| {
        Failure::new(GT2_ERR_INVALID_TEXT, format!("{name} is not UTF-8 from byte {} on", e.valid_up_to()))
    })
}

/// Copies a text with its NUL into a caller's buffer. Asking with no buffer tells the size alone.
///
/// # Safety
/// `buffer` is NULL or has `capacity` bytes; `needed` is NULL or can be written.
pub(super) unsafe fn copy_out(
    text: &str,
    buffer: *mut c_char,
    capacity: usize,
    needed: *mut usize,
) -> Result<(), Failure> {
    // SAFETY: passed on to the caller.
    unsafe { copy_bytes(c_string(text).as_bytes_with_nul(), buffer.cast(), capacity, needed) }
}

/// A text of ours as a C string.
pub(super) fn c_string(text: &str) -> CString {
    CString::new(text).expect("texts of the library have no NUL")
}
