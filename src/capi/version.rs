//! Versions of the library and of its ABI.

use std::ffi::c_char;

/// Version of this header: the library's major version. `gt2_version` is the version of the library at run time.
pub const GT2_VERSION_MAJOR: u32 = 0;
/// Version of this header: the library's minor version.
pub const GT2_VERSION_MINOR: u32 = 1;
/// Version of this header: the library's patch version.
pub const GT2_VERSION_PATCH: u32 = 0;

/// Version of the binary interface described by this header. A program works with every library whose
/// `gt2_abi_version` is equal: functions and struct fields are only ever added, at the end. It is also the number in
/// the shared library's SONAME (`libgentrack2.so.0`).
pub const GT2_ABI_VERSION: u32 = 0;

const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");

// The numbers above are written out for the header's sake; the package and the build script must agree with them.
const _: () = {
    assert!(GT2_VERSION_MAJOR == number(env!("CARGO_PKG_VERSION_MAJOR")));
    assert!(GT2_VERSION_MINOR == number(env!("CARGO_PKG_VERSION_MINOR")));
    assert!(GT2_VERSION_PATCH == number(env!("CARGO_PKG_VERSION_PATCH")));
    assert!(GT2_ABI_VERSION == number(env!("GENTRACK2_ABI_VERSION")));
};

const fn number(text: &str) -> u32 {
    match u32::from_str_radix(text, 10) {
        Ok(number) => number,
        Err(_) => panic!("not a number"),
    }
}

/// Version of the library at run time, such as "0.1.0". Static.
#[unsafe(no_mangle)]
pub extern "C" fn gt2_version() -> *const c_char {
    VERSION.as_ptr().cast()
}

/// Version of the binary interface of the library at run time; compare with `GT2_ABI_VERSION`.
#[unsafe(no_mangle)]
pub extern "C" fn gt2_abi_version() -> u32 {
    GT2_ABI_VERSION
}
