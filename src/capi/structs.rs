//! Structs that start with their size, so that they can grow: a shorter one of an older header is extended by zeros,
//! a longer one of a newer header is accepted if what is not known here is zero.

use std::mem::MaybeUninit;

use super::pointer::require;
use super::status::*;

/// The size field itself.
const MIN_SIZE: usize = size_of::<usize>();

/// No struct will ever be larger; a larger size is an uninitialised one.
const MAX_SIZE: usize = 4096;

/// A struct that starts with `size_t struct_size`.
///
/// # Safety
/// `repr(C)`, `usize` first, and valid for any bits whose size field has been checked.
pub(super) unsafe trait SizedStruct: Copy {
    /// What messages call it.
    const NAME: &'static str;
    /// Size of its first published layout, which `struct_size` 0 stands for. Never changes.
    const FIRST_SIZE: usize;
}

/// The size that the caller's struct really has.
///
/// # Safety
/// `pointer` is NULL or its first field can be read.
unsafe fn checked_size<T: SizedStruct>(pointer: *const T) -> Result<usize, Failure> {
    require(pointer, T::NAME)?;
    // SAFETY: not NULL; the rest is the caller's promise.
    match unsafe { pointer.cast::<usize>().read_unaligned() } {
        0 => Ok(T::FIRST_SIZE),
        size @ MIN_SIZE..=MAX_SIZE => Ok(size),
        size => Err(Failure::new(
            GT2_ERR_STRUCT_SIZE,
            format!("{}.struct_size: is {size}, must be 0 or in {MIN_SIZE}..={MAX_SIZE}", T::NAME),
        )),
    }
}

/// Reads a caller's struct.
///
/// # Safety
/// `pointer` is NULL or can be read up to the size that the struct states.
pub(super) unsafe fn read<T: SizedStruct>(pointer: *const T) -> Result<T, Failure> {
    // SAFETY: the caller's promise.
    let size = unsafe { checked_size(pointer) }?;
    let known = size.min(size_of::<T>());
    let mut copy = MaybeUninit::<T>::zeroed();
    // SAFETY: `known` bytes can be read and fit; zeros and the caller's bytes are both valid for a `SizedStruct`.
    let copy = unsafe {
        pointer.cast::<u8>().copy_to_nonoverlapping(copy.as_mut_ptr().cast(), known);
        copy.assume_init()
    };
    // SAFETY: `size` bytes can be read.
    let tail = unsafe { std::slice::from_raw_parts(pointer.cast::<u8>().add(known), size - known) };
    match tail.iter().position(|byte| *byte != 0) {
        None => Ok(copy),
        Some(at) => Err(Failure::new(
            GT2_ERR_STRUCT_SIZE,
            format!(
                "{}: byte {} is set, but this library ({}) knows only {} bytes",
                T::NAME,
                known + at,
                env!("CARGO_PKG_VERSION"),
                size_of::<T>()
            ),
        )),
    }
}

/// Fills a caller's struct as far as it goes, and with zeros beyond what is known here; the size field stays.
///
/// # Safety
/// `pointer` is NULL or can be written up to the size that the struct states.
pub(super) unsafe fn write<T: SizedStruct>(pointer: *mut T, value: &T) -> Result<(), Failure> {
    // SAFETY: the caller's promise.
    let size = unsafe { checked_size(pointer.cast_const()) }?;
    // SAFETY: `size` bytes can be written, of which the first are the size field.
    unsafe { write_row(pointer.cast(), size, (&raw const *value).cast(), size_of::<T>(), size_of::<usize>()) };
    Ok(())
}

/// Copies a row of `known` bytes to one of `size` bytes from byte `from` on: cut short or extended by zeros.
///
/// # Safety
/// Both rows have their stated sizes and do not overlap; `from` is within both.
pub(super) unsafe fn write_row(row: *mut u8, size: usize, value: *const u8, known: usize, from: usize) {
    let shared = size.min(known);
    // SAFETY: all offsets are within the rows.
    unsafe {
        value.add(from).copy_to_nonoverlapping(row.add(from), shared - from);
        row.add(shared).write_bytes(0, size - shared);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    struct Pair {
        struct_size: usize,
        a: u64,
        b: u64,
    }

    // SAFETY: integers only.
    unsafe impl SizedStruct for Pair {
        const NAME: &'static str = "pair";
        // As if `b` had been added later.
        const FIRST_SIZE: usize = 16;
    }

    /// A newer header's `Pair`.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    struct Triple {
        pair: Pair,
        c: u64,
    }

    fn triple(struct_size: usize, c: u64) -> Triple {
        Triple { pair: Pair { struct_size, a: 1, b: 2 }, c }
    }

    fn read_triple(t: &Triple) -> Result<Pair, gt2_status> {
        // SAFETY: a triple can be read up to 32 bytes, and no test states more without being refused.
        unsafe { read((&raw const *t).cast::<Pair>()) }.map_err(|f| f.status)
    }

    #[test]
    fn shorter_structs_are_extended_by_zeros() {
        assert_eq!(read_triple(&triple(24, 9)).map(|p| (p.a, p.b)), Ok((1, 2)));
        assert_eq!(read_triple(&triple(16, 9)).map(|p| (p.a, p.b)), Ok((1, 0)));
        assert_eq!(read_triple(&triple(8, 9)).map(|p| (p.a, p.b)), Ok((0, 0)));
        // Size 0 is the first layout, which had no `b`.
        assert_eq!(read_triple(&triple(0, 9)).map(|p| (p.a, p.b)), Ok((1, 0)));
    }

    #[test]
    fn longer_structs_are_refused_if_they_use_what_is_unknown() {
        assert_eq!(read_triple(&triple(32, 0)).map(|p| (p.a, p.b)), Ok((1, 2)));
        assert_eq!(read_triple(&triple(32, 1 << 63)), Err(GT2_ERR_STRUCT_SIZE));
        for size in [1, 7, 4097, usize::MAX] {
            assert_eq!(read_triple(&triple(size, 0)), Err(GT2_ERR_STRUCT_SIZE), "{size}");
        }
        // SAFETY: NULL is allowed.
        assert_eq!(unsafe { read::<Pair>(std::ptr::null()) }.unwrap_err().status, GT2_ERR_NULL_POINTER);
    }

    #[test]
    fn results_fill_what_the_caller_has_and_no_more() {
        for (size, expected) in [(24, (7, 8, 3)), (16, (7, 2, 3)), (32, (7, 8, 0)), (0, (7, 2, 3))] {
            let mut t = triple(size, 3);
            let value = Pair { struct_size: 24, a: 7, b: 8 };
            // SAFETY: a triple can be written up to 32 bytes.
            unsafe { write((&raw mut t).cast::<Pair>(), &value) }.unwrap();
            assert_eq!((t.pair.a, t.pair.b, t.c), expected, "size {size}");
            assert_eq!(t.pair.struct_size, size);
        }
    }
}
