//! The C ABI. One file per C type; `guard`, `handle`, `pointer`, `structs` and `text` are the kit they share.
//!
//! `include/gentrack2.h` is generated from these files (see `tests/header.rs`), so their documentation is written
//! for a reader of C. This is the only part of the crate with unsafe code.

// The header is the manual of these functions: what a caller must guarantee is said there once for all of them.
#![allow(unsafe_code, non_camel_case_types, clippy::missing_safety_doc)]
// In C's documentation brackets are indices.
#![allow(rustdoc::broken_intra_doc_links)]

mod algorithm;
mod config;
mod detection;
mod frame;
mod guard;
mod handle;
mod image;
mod neighbourhood;
mod parameter_info;
mod particle;
mod pointer;
mod snapshot;
mod status;
mod structs;
mod tables;
mod text;
mod track;
mod tracker;
mod version;

pub use algorithm::*;
pub use config::*;
pub use detection::*;
pub use frame::*;
pub use image::*;
pub use neighbourhood::*;
pub use parameter_info::*;
pub use particle::*;
pub use snapshot::*;
pub use status::*;
pub use track::*;
pub use tracker::*;
pub use version::*;
