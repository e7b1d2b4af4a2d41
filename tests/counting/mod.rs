//! An allocator that counts, per thread, so that what the test harness does meanwhile does not count.

// Each test binary uses its own part.
#![allow(dead_code)]
// A global allocator cannot be written without.
#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    /// Bytes that are allocated.
    pub static LIVE_BYTES: Cell<i64> = const { Cell::new(0) };
    /// How often something was.
    pub static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
    /// The most bytes asked for at once.
    pub static LARGEST: Cell<usize> = const { Cell::new(0) };
}

/// Counts in this thread; a thread at its end no longer counts.
fn count(bytes: i64, allocations: u64) {
    let _ = LIVE_BYTES.try_with(|live| live.set(live.get() + bytes));
    let _ = ALLOCATIONS.try_with(|n| n.set(n.get() + allocations));
    let _ = LARGEST.try_with(|most| most.set(most.get().max(bytes.max(0) as usize)));
}

struct Counting;

// SAFETY: every call is passed on unchanged to the system's allocator, which keeps the contract.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as i64, 1);
        // SAFETY: the caller keeps `alloc`'s contract.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count(-(layout.size() as i64), 0);
        // SAFETY: the pointer came from `alloc` with this layout, and so from the system's allocator.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Runs `body`; the most bytes that it asked for at once.
pub fn largest_allocation<T>(body: impl FnOnce() -> T) -> (T, usize) {
    LARGEST.set(0);
    let result = body();
    (result, LARGEST.get())
}
