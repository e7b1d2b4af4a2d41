//! Streams as they come from worn cameras, busy detectors and bad networks: what is promised of each in
//! `docs/degraded-input.md`, for every tracker, on scenes in which it is known who is who.

#[path = "../simulator/mod.rs"]
mod simulator;

mod clock;
mod crowds;
mod lanes;
mod pause;
mod pictures;
mod rate;
mod stream;
