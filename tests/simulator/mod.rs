//! A seeded world to test trackers in: textured rectangles walk through a textured scene, hide each other by depth, are
//! rendered into real images and seen by a noisy detector. Everything is known: the true boxes, the visible shares, the
//! camera's movement and which object each detection came from.
//!
//! Time is in seconds and lengths in pixels, so one scene can be played at any frame rate.

// Each test binary uses its own part of this module.
#![allow(dead_code)]

pub mod affine;
pub mod camera;
pub mod contract;
pub mod detector;
pub mod driver;
pub mod everyone;
pub mod noise;
pub mod path;
pub mod render;
pub mod scene;
pub mod stage;
pub mod verdict;
pub mod watched;
