//! Gives the shared library its SONAME, which cargo does not.

/// Number in the SONAME: the version of the binary interface, the same as `GT2_ABI_VERSION` of the header.
const ABI_VERSION: u32 = 0;

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rustc-env=GENTRACK2_ABI_VERSION={ABI_VERSION}");
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libgentrack2.so.{ABI_VERSION}");
    }
}
