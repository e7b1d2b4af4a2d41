//! Multi-object tracking: per frame, detections go in and identities that last come out.
//!
//! ```
//! use gentrack2::{Config, Detection, Frame, Tracker};
//!
//! let mut tracker = Tracker::new(&Config::new("gentrack2")?)?;
//! for t in 0..10 {
//!     let detections = [Detection::new(10.0 + 3.0 * t as f64, 20.0, 40.0, 80.0, 0.9)];
//!     let output = tracker.step(&Frame::new(&detections))?;
//!     for track in &output.reported {
//!         println!("{} {:?}", track.id, track.rect);
//!     }
//! }
//! # Ok::<(), gentrack2::Error>(())
//! ```
//!
//! [`Algorithm`] lists the algorithms: GenTrack2 and the seven it is compared with. The same library has a C ABI;
//! `include/gentrack2.h` is its manual.
//!
//! Every algorithm is a cargo feature of its name, and so is reading a [`Config`] from TOML (`toml`); all are on by
//! default.

// A library of a few trackers has no use for all that they could share.
#![cfg_attr(not(feature = "default"), allow(dead_code, unused_imports, unused_macros))]

pub mod appearance;
pub mod assignment;
mod buffers;
pub mod candidates;
pub mod classes;
pub mod config;
pub mod embedding;
pub mod error;
#[cfg(feature = "fault-injection")]
pub mod faults;
#[cfg(not(feature = "fault-injection"))]
mod faults;
pub mod frame;
pub mod geometry;
pub mod image;
#[cfg(feature = "_kalman")]
pub mod kalman;
pub mod parameters;
#[cfg(feature = "gentrack2")]
pub mod random;
#[cfg(feature = "snapshot")]
pub mod snapshot;
pub mod track;
pub mod tracker;
pub mod trackers;
mod validation;

pub mod capi;

/// The Rust of README and manual, for documentation tests.
#[cfg(doctest)]
mod manual {
    #[doc = include_str!("../README.md")]
    mod readme {}
    #[doc = include_str!("../docs/recipes.md")]
    mod recipes {}
}

#[cfg(all(feature = "fault-injection", not(debug_assertions)))]
compile_error!(
    "fault-injection is for tests, which are debug builds: no library for use can be made to fail on demand"
);

#[cfg(not(any(feature = "gentrack2", feature = "_kalman")))]
compile_error!("a library without any tracker: enable the feature of at least one, such as gentrack2 or sort");

pub use config::Config;
pub use error::Error;
pub use frame::{CameraMotion, Detection, Embeddings, Frame};
pub use geometry::Rect;
pub use image::{ImageView, PixelFormat};
pub use track::{NeighbourMotion, Neighbourhood, Output, Particle, Track, TrackState, WeakMove};
pub use tracker::Tracker;
pub use trackers::Algorithm;
