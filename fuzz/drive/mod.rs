//! What is fuzzed, as functions of bytes: `fuzz/fuzz_targets` runs them under a coverage-guided fuzzer, and
//! `tests/fuzzed.rs` on the committed corpus and on seeded random bytes, with any compiler.

// Each target uses its own part.
#![allow(dead_code)]

mod bytes;
pub mod c_abi;
pub mod snapshot;
pub mod toml;
