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

/// Stores a result.
///
/// # Safety
/// `out` can be written.
pub(super) unsafe fn store<T>(out: *mut T, value: T) {
    // SAFETY: the caller's promise; a caller's misaligned `out` is tolerated.
    unsafe { out.write_unaligned(value) }
}
