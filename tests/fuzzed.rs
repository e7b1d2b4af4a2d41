//! What the fuzzers of `fuzz/` run, on the committed corpus and on seeded random bytes: with any compiler, in a moment.

// The C ABI is called as C does.
#![allow(unsafe_code)]
#![cfg(feature = "snapshot")]

#[path = "../fuzz/drive/mod.rs"]
mod drive;
mod simulator;

use std::path::Path;

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
    run("c_abi", drive::c_abi::run, 3000);
}

#[test]
fn configurations_are_read_or_refused() {
    run("toml", drive::toml::run, 3000);
}

#[test]
fn snapshots_are_loaded_or_refused() {
    run("snapshot", drive::snapshot::run, 1000);
}
