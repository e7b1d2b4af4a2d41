//! What every opaque handle carries: a tag that tells its type and that it is alive, and whether it is poisoned.

use std::sync::atomic::{AtomicBool, Ordering};

use super::status::*;

/// First bytes of a handle as this file sees them.
#[repr(C)]
pub(super) struct Header {
    tag: u64,
    poisoned: AtomicBool,
}

impl Header {
    pub const fn new(tag: u64) -> Self {
        Self { tag, poisoned: AtomicBool::new(false) }
    }

    pub fn poison(&self) {
        self.poisoned.store(true, Ordering::Relaxed);
    }

    pub fn heal(&self) {
        self.poisoned.store(false, Ordering::Relaxed);
    }

    pub fn refuse_poisoned(&self, name: &str) -> Result<(), Failure> {
        match self.poisoned.load(Ordering::Relaxed) {
            false => Ok(()),
            true => Err(Failure::new(GT2_ERR_POISONED, format!("{name} met an internal error before"))),
        }
    }
}

/// A type behind an opaque pointer.
///
/// # Safety
/// It begins with the [`Header`] that `header` returns, made with `TAG`. (At its beginning, so that looking at the
/// tag of another type's handle reads nothing beyond that.)
pub(super) unsafe trait Handle: Sized {
    /// Any number that is unlikely elsewhere in memory, one per type.
    const TAG: u64;
    /// What messages call it.
    const NAME: &'static str;

    fn header(&self) -> &Header;
}

/// Checks a handle pointer as far as that is possible.
///
/// # Safety
/// `pointer` is NULL or points to memory that can be read.
unsafe fn check<H: Handle>(pointer: *const H) -> Result<(), Failure> {
    if pointer.is_null() {
        return Err(Failure::new(GT2_ERR_NULL_POINTER, format!("{} is NULL", H::NAME)));
    }
    let invalid = || Failure::new(GT2_ERR_INVALID_HANDLE, format!("{} is not a live gt2_{0} handle", H::NAME));
    if !pointer.is_aligned() {
        return Err(invalid());
    }
    // SAFETY: readable by the caller's promise; volatile, as it may be memory that has been given back.
    let tag = unsafe { pointer.cast::<u64>().read_volatile() };
    if tag == H::TAG { Ok(()) } else { Err(invalid()) }
}

/// # Safety
/// `pointer` is NULL, or memory that can be read; if it is a live handle, nobody changes it meanwhile.
pub(super) unsafe fn borrow<'a, H: Handle>(pointer: *const H) -> Result<&'a H, Failure> {
    // SAFETY: the tag says that this is a live handle, made by `give`; the rest is the caller's promise.
    unsafe {
        check(pointer)?;
        Ok(&*pointer)
    }
}

/// # Safety
/// `pointer` is NULL, or memory that can be read; if it is a live handle, nobody else uses it meanwhile.
pub(super) unsafe fn borrow_mut<'a, H: Handle>(pointer: *mut H) -> Result<&'a mut H, Failure> {
    // SAFETY: the tag says that this is a live handle, made by `give`; the rest is the caller's promise.
    unsafe {
        check(pointer)?;
        Ok(&mut *pointer)
    }
}

/// Moves a handle to the heap.
pub(super) fn give<H: Handle>(handle: H) -> *mut H {
    Box::into_raw(Box::new(handle))
}

/// Takes a handle back; NULL is none.
///
/// # Safety
/// As for [`borrow_mut`], and the handle is not used afterwards.
pub(super) unsafe fn take<H: Handle>(pointer: *mut H) -> Result<Option<Box<H>>, Failure> {
    if pointer.is_null() {
        return Ok(None);
    }
    // SAFETY: `check` says that this is a live handle, made by `give`, whose tag can be written.
    unsafe {
        check(pointer)?;
        // Volatile, or it would be dropped as a store to dying memory.
        pointer.cast::<u64>().write_volatile(0);
        Ok(Some(Box::from_raw(pointer)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[repr(C)]
    struct Lamp {
        header: Header,
        _light: u8,
    }

    // SAFETY: repr(C), header first, and the test makes it with this tag.
    unsafe impl Handle for Lamp {
        const TAG: u64 = 0x1234_5678_9abc_def0;
        const NAME: &'static str = "lamp";
        fn header(&self) -> &Header {
            &self.header
        }
    }

    #[test]
    fn a_taken_handle_has_lost_its_tag() {
        let lamp = give(Lamp { header: Header::new(Lamp::TAG), _light: 0 });
        // SAFETY: `lamp` was just made; the box keeps the memory alive while it is looked at again.
        unsafe {
            assert!(borrow(lamp).is_ok());
            let taken = take(lamp).unwrap().unwrap();
            let again = Box::into_raw(taken);
            assert_eq!(borrow(again).err().unwrap().status, GT2_ERR_INVALID_HANDLE);
            drop(Box::from_raw(again));
            assert!(take::<Lamp>(std::ptr::null_mut()).unwrap().is_none());
        }
    }

    #[test]
    fn foreign_and_misaligned_pointers_are_not_followed() {
        let foreign = [0u64; 16];
        let pointer = foreign.as_ptr().cast::<Lamp>();
        // SAFETY: the memory is readable.
        unsafe {
            assert_eq!(borrow(pointer).err().unwrap().status, GT2_ERR_INVALID_HANDLE);
            let error = borrow(pointer.byte_add(1)).err().unwrap();
            assert_eq!((error.status, &*error.message), (GT2_ERR_INVALID_HANDLE, "lamp is not a live gt2_lamp handle"));
        }
    }
}
