//! Nothing panics across the ABI, and nothing is printed: a panic becomes a status with a message.

use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Once;

use super::handle::{Handle, Header, borrow, borrow_mut};
use super::status::*;

/// Runs the body of an exported function that takes no handle.
pub(super) fn guard(body: impl FnOnce() -> Result<(), Failure>) -> gt2_status {
    match catch(body) {
        Ok(()) => GT2_OK,
        Err(failure) => report(failure),
    }
}

/// Runs the body of an exported function on a handle that it only reads.
///
/// # Safety
/// See [`borrow`].
pub(super) unsafe fn guard_shared<H: Handle>(
    handle: *const H,
    body: impl FnOnce(&H) -> Result<(), Failure>,
) -> gt2_status {
    guard(|| {
        // SAFETY: passed on to the caller.
        let handle = unsafe { borrow(handle) }?;
        handle.header().refuse_poisoned(H::NAME)?;
        let result = catch(|| body(handle));
        poison_if_panicked(handle.header(), &result);
        result
    })
}

/// Runs the body of an exported function on a handle that it changes.
///
/// # Safety
/// See [`borrow_mut`].
pub(super) unsafe fn guard_exclusive<H: Handle>(
    handle: *mut H,
    body: impl FnOnce(&mut H) -> Result<(), Failure>,
) -> gt2_status {
    guard(|| {
        // SAFETY: passed on to the caller.
        let handle = unsafe { borrow_mut(handle) }?;
        handle.header().refuse_poisoned(H::NAME)?;
        let result = catch(|| body(handle));
        poison_if_panicked(handle.header(), &result);
        result
    })
}

/// Runs the body of an exported function that makes a handle as new, a poisoned one too.
///
/// # Safety
/// See [`borrow_mut`].
pub(super) unsafe fn guard_healing<H: Handle>(
    handle: *mut H,
    body: impl FnOnce(&mut H) -> Result<(), Failure>,
) -> gt2_status {
    guard(|| {
        // SAFETY: passed on to the caller.
        let handle = unsafe { borrow_mut(handle) }?;
        let result = catch(|| body(handle));
        match result {
            Ok(()) => handle.header().heal(),
            Err(_) => poison_if_panicked(handle.header(), &result),
        }
        result
    })
}

/// Runs a lookup that returns its result directly; on a failure that is `otherwise`.
pub(super) fn find<T>(otherwise: T, body: impl FnOnce() -> Result<T, Failure>) -> T {
    let mut found = None;
    guard(|| {
        found = Some(body()?);
        Ok(())
    });
    found.unwrap_or(otherwise)
}

/// The same on a handle.
///
/// # Safety
/// See [`borrow`].
pub(super) unsafe fn find_in<H: Handle, T>(
    handle: *const H,
    otherwise: T,
    body: impl FnOnce(&H) -> Result<T, Failure>,
) -> T {
    let mut found = None;
    // SAFETY: passed on to the caller.
    unsafe {
        guard_shared(handle, |h| {
            found = Some(body(h)?);
            Ok(())
        });
    }
    found.unwrap_or(otherwise)
}

fn poison_if_panicked(header: &Header, result: &Result<(), Failure>) {
    if result.as_ref().is_err_and(|f| f.status == GT2_ERR_PANIC) {
        header.poison();
    }
}

thread_local! {
    /// How many guards this thread is in; the panic hook is silent inside of one.
    static DEPTH: Cell<u32> = const { Cell::new(0) };
    static PANIC_MESSAGE: RefCell<String> = const { RefCell::new(String::new()) };
}

fn catch(body: impl FnOnce() -> Result<(), Failure>) -> Result<(), Failure> {
    install_hook();
    let nesting = |by: i32| DEPTH.try_with(|d| d.set(d.get().wrapping_add_signed(by)));
    let _ = nesting(1);
    // What a panic leaves behind is not looked at again: the handle is poisoned.
    let result = catch_unwind(AssertUnwindSafe(body));
    let _ = nesting(-1);
    result.unwrap_or_else(|_| {
        let message = PANIC_MESSAGE.try_with(RefCell::take).unwrap_or_default();
        Err(Failure::new(GT2_ERR_PANIC, format!("internal error: {message}")))
    })
}

/// Keeps panics under a guard off the standard error and remembers what they said. Others, of a Rust program that
/// this library is part of, go to the hook that was there before.
fn install_hook() {
    static INSTALLED: Once = Once::new();
    INSTALLED.call_once(|| {
        let previous = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |info| {
            if DEPTH.try_with(Cell::get).unwrap_or(0) == 0 {
                return previous(info);
            }
            let payload = info.payload();
            let text = payload.downcast_ref::<&str>().copied();
            let text = text.or(payload.downcast_ref::<String>().map(String::as_str)).unwrap_or("unknown");
            let place = info.location().map(|l| format!(" at {}:{}", l.file(), l.line())).unwrap_or_default();
            let _ = PANIC_MESSAGE.try_with(|m| m.replace(format!("{text}{place}")));
        }));
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ffi::CStr;

    #[test]
    fn a_panic_becomes_a_status_and_a_message_with_its_place() {
        let status = guard(|| panic!("the sky fell"));
        assert_eq!(status, GT2_ERR_PANIC);
        // SAFETY: the function returns a C string that stays valid until the next failing call.
        let message = unsafe { CStr::from_ptr(gt2_last_error_message()) }.to_str().unwrap();
        assert!(message.starts_with("internal error: the sky fell at "), "{message}");
        assert!(message.contains("guard.rs:"), "{message}");
    }
}
