//! Golden outputs of the compared trackers' published reference implementations: what was fed to them, and how far a
//! tracker of this library reproduces what came out. Nothing here knows how a tracker works.

// Each test binary uses its own part of this module.
#![allow(dead_code)]

pub mod compare;
pub mod golden;
pub mod place;
pub mod sequence;
pub mod variants;
