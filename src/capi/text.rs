//! Texts in and out.

use std::ffi::{CStr, CString, c_char};

use super::pointer::{require, store};
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
    if capacity > 0 {
        require(buffer, "buffer")?;
    } else {
        require(needed, "needed (with capacity 0)")?;
    }
    let size = text.len() + 1;
    if !needed.is_null() {
        // SAFETY: the caller's promise.
        unsafe { store(needed, size) };
    }
    if capacity == 0 {
        return Ok(());
    }
    if capacity < size {
        let reason = format!("capacity: is {capacity}, {size} bytes are needed");
        return Err(Failure::new(GT2_ERR_BUFFER_TOO_SMALL, reason));
    }
    // SAFETY: the buffer has at least `size` bytes.
    unsafe {
        text.as_ptr().cast::<c_char>().copy_to_nonoverlapping(buffer, text.len());
        buffer.add(text.len()).write(0);
    }
    Ok(())
}

/// A text of ours as a C string.
pub(super) fn c_string(text: &str) -> CString {
    CString::new(text).expect("texts of the library have no NUL")
}
