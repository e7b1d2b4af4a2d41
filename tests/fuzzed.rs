//! What the fuzzers of `fuzz/` run, on the committed corpus and on seeded random bytes: with any compiler, in a moment.

// The C ABI is called as C does.
#![allow(unsafe_code)]
#![cfg(feature = "snapshot")]

#[path = "../fuzz/drive/mod.rs"]
mod drive;
mod simulator;

use std::ffi::CStr;
use std::path::{Path, PathBuf};

use gentrack2::{Algorithm, Config};
use simulator::noise::Noise;

/// The corpus of a target.
fn corpus(target: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/seeds").join(target);
    let mut paths: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let seeds: Vec<Vec<u8>> = paths.iter().map(|path| std::fs::read(path).unwrap()).collect();
    assert!(!seeds.is_empty(), "{} is empty", folder.display());
    seeds
}

/// The corpus, then children of it and bytes at random.
fn run(target: &str, drive: fn(&[u8]), inputs: usize) {
    let seeds = corpus(target);
    seeds.iter().for_each(|seed| drive(seed));
    let mut noise = Noise::new(1, 0);
    for index in 0..inputs {
        let mut input = match index % 4 {
            0 => (0..noise.below(600)).map(|_| noise.bits() as u8).collect(),
            _ => seeds[noise.below(seeds.len())].clone(),
        };
        for _ in 0..noise.below(8) {
            let at = noise.below(input.len() + 1);
            match noise.below(3) {
                0 if at < input.len() => input[at] = noise.bits() as u8,
                1 => input.insert(at, noise.bits() as u8),
                _ => input.truncate(at.max(input.len() / 2)),
            }
        }
        drive(&input);
    }
}

#[test]
fn sequences_of_calls_keep_their_promises() {
    run(
        "c_abi",
        |bytes| {
            drive::c_abi::run(bytes);
        },
        3000,
    );
}

#[test]
fn configurations_are_read_or_refused() {
    run("toml", drive::toml::run, 3000);
}

#[test]
fn snapshots_are_loaded_or_refused() {
    run("snapshot", drive::snapshot::run, 1000);
}

/// What a frame can have gets past the checks in every tracker, or the fuzzers would know the checks alone.
#[test]
fn the_corpus_has_frames_with_everything_that_are_accepted() {
    for &algorithm in Algorithm::ALL {
        let accepted = drive::c_abi::run(&std::fs::read(everything(algorithm)).unwrap());
        let common = accepted.detections.min(accepted.embeddings).min(accepted.images).min(accepted.camera_motions);
        assert!(common >= 5, "{}: {accepted:?}", algorithm.name());
        let rare = accepted.timestamps.min(accepted.rests).min(accepted.snapshots);
        assert!(rare >= 1, "{}: {accepted:?}", algorithm.name());
    }
}

/// A seed for the C ABI in which a tracker is given everything.
fn everything(algorithm: Algorithm) -> PathBuf {
    let seeds = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/seeds/c_abi");
    seeds.join(format!("everything_{}", algorithm.name()))
}

/// Writes these seeds anew, as `fuzz/drive/c_abi.rs` reads them:
/// `cargo test --test fuzzed write_everything -- --ignored`.
#[test]
#[ignore = "writes files"]
fn write_everything() {
    for &algorithm in Algorithm::ALL {
        // Config 0 of this algorithm, use_camera_motion where it exists, tracker 0 of it.
        let is_it = |name: &&CStr| name.to_str() == Ok(algorithm.name());
        let index = drive::c_abi::ALGORITHMS.iter().position(is_it).expect("the fuzzer knows all trackers");
        let mut seed = vec![0, 0, index as u8];
        let config = Config::of(algorithm);
        if let Some(at) = config.specs().position(|spec| spec.key == "use_camera_motion") {
            seed.extend([0, 1, 0, at as u8, 0, 2]);
        }
        seed.extend([0, 5, 0]);
        for frame in 0..18u8 {
            let rests = frame % 6 == 5;
            step(&mut seed, frame, if rests { 0 } else { 2 });
            if frame % 8 == 7 {
                // Saved, loaded without damage; then looked at.
                seed.extend([0, 7, 0, 0, 8, 1, 4, 0, 1]);
            }
        }
        std::fs::write(everything(algorithm), seed).unwrap();
    }
}

/// A frame of walkers with all there is.
fn step(seed: &mut Vec<u8>, frame: u8, walkers: u8) {
    seed.extend([0, 9, 0, walkers]);
    for walker in 0..walkers {
        let (left, top) = (20 + 2 * frame, 20 + 90 * walker);
        // Four numbers and the score, each with its share; class, reserved, tag.
        seed.extend([left, 9, top, 60 * (frame % 3), 90, 3, 120, 5, 200 + walker, 0, walker, 0, frame]);
    }
    // Four numbers for each walker.
    seed.push(2);
    for walker in 0..walkers {
        (0..4).for_each(|at| seed.extend([if at == walker { 250 } else { 10 + frame }, 1]));
    }
    // An image of 120 x 100 GRAY8, and a shift to the right.
    seed.extend([2, 120, 100, 1, 0, 1, 0, 2, 2, 30, 0]);
    if walkers == 0 {
        seed.push(0);
    }
    // Strides as they are, no size but the image's, a timestamp one interval later, and whether the detector rests.
    seed.extend([1, 0, 2, 0, if walkers == 0 { 5 } else { 0 }]);
}
