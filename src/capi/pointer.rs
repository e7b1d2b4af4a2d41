//! Checked use of a caller's pointers.

use super::status::*;

/// Refuses NULL.
pub(super) fn require<T>(pointer: *const T, name: &str) -> Result<(), Failure> {
    if pointer.is_null() {
        return Err(Failure::new(GT2_ERR_NULL_POINTER, format!("{name} is NULL")));
    }
    Ok(())
}

/// Refuses NULL and pointers that are misaligned for their type.
pub(super) fn require_aligned<T>(pointer: *const T, name: &str) -> Result<(), Failure> {
    require(pointer, name)?;
    if !pointer.is_aligned() {
        return Err(Failure::argument(format!("{name} is not aligned to {} bytes", align_of::<T>())));
    }
    Ok(())
}

/// A caller's array; NULL is fine if it has no elements.
///
/// # Safety
/// A `pointer` that is not NULL points to `count` elements that do not change during `'a`.
pub(super) unsafe fn slice<'a, T>(pointer: *const T, count: usize, name: &str) -> Result<&'a [T], Failure> {
    if count == 0 {
        return Ok(&[]);
    }
    require_aligned(pointer, name)?;
    if count.checked_mul(size_of::<T>()).is_none_or(|bytes| bytes > isize::MAX as usize) {
        return Err(Failure::argument(format!("{name}: {count} elements do not fit into memory")));
    }
    // SAFETY: not NULL, aligned, of a possible size; the rest is the caller's promise.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// Where a list starts, NULL if it is empty.
pub(super) fn start<T>(list: &[T]) -> *const T {
    if list.is_empty() { std::ptr::null() } else { list.as_ptr() }
}

/// Copies bytes into a caller's buffer, or nothing if it is too small. Asking with no buffer tells the size alone.
///
/// # Safety
/// `buffer` is NULL or has `capacity` bytes; `needed` is NULL or can be written.
pub(super) unsafe fn copy_bytes(
    bytes: &[u8],
    buffer: *mut u8,
    capacity: usize,
    needed: *mut usize,
) -> Result<(), Failure> {
    if capacity > 0 {
        require(buffer, "buffer")?;
    } else {
        require(needed, "needed (with capacity 0)")?;
    }
    if !needed.is_null() {
        // SAFETY: the caller's promise.
        unsafe { store(needed, bytes.len()) };
    }
    if capacity == 0 {
        return Ok(());
    }
    if capacity < bytes.len() {
        let reason = format!("capacity: is {capacity}, {} bytes are needed", bytes.len());
        return Err(Failure::new(GT2_ERR_BUFFER_TOO_SMALL, reason));
    }
    // SAFETY: the buffer has at least as many bytes.
    unsafe { bytes.as_ptr().copy_to_nonoverlapping(buffer, bytes.len()) };
    Ok(())
}

/// Stores a result.
///
/// # Safety
/// `out` can be written.
pub(super) unsafe fn store<T>(out: *mut T, value: T) {
    // SAFETY: the caller's promise; a caller's misaligned `out` is tolerated.
    unsafe { out.write_unaligned(value) }
}
