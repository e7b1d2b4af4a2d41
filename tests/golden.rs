//! Results are what they were, to the last bit: every tracker on every scene gives the hash in
//! `tests/fixtures/golden/hashes.txt`, whose README says what is hashed. `ctest/golden.c` demands the same of the
//! released libraries.

mod oracles;

use std::collections::BTreeSet;
use std::path::PathBuf;

use gentrack2::{Algorithm, Config, Embeddings, Frame, ImageView, Output, PixelFormat, Track, TrackState, Tracker};
use oracles::place;
use oracles::sequence::{DIMENSION, Sequence};

/// A sequence, and what its frames have besides boxes and scores.
const SCENES: [(&str, &str); 14] = [
    ("syn_a1", "-"),
    ("syn_a2", "-"),
    ("syn_a3", "-"),
    ("syn_a4", "-"),
    ("syn_b1", "-"),
    ("syn_b2", "-"),
    ("syn_b3", "-"),
    ("syn_a2", "embeddings"),
    ("syn_b2", "camera"),
    ("syn_b1", "images"),
    ("syn_a1", "times"),
    ("syn_a3", "rests"),
    ("syn_b3", "separate"),
    ("syn_b1", "embeddings+camera+images+times+rests+separate"),
];
/// One more for gentrack2.
const PAPER: (&str, &str) = ("syn_a1", "paper");

const WIDTH: usize = 1920;
const HEIGHT: usize = 1080;
const STRIDE: usize = 2048;
const ROWS: usize = 1200;
const FRAMES_WITH_IMAGES: usize = 60;

fn hashes() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/golden/hashes.txt")
}

fn texture() -> Vec<u8> {
    let pixel = |i: usize| {
        let (x, y) = (i % STRIDE, i / STRIDE);
        ((x / 7) * (y / 5 + 3) * 37 + 2 * x + y) as u8
    };
    (0..STRIDE * ROWS).map(pixel).collect()
}

/// FNV-1a over 64-bit words.
struct Hash(u64);

impl Hash {
    fn add(&mut self, word: u64) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(1_099_511_628_211);
        }
    }

    fn add_track(&mut self, track: &Track) {
        let (r, v) = (&track.rect, &track.velocity);
        let state = match track.state {
            TrackState::Tentative => 1,
            TrackState::Confirmed => 2,
            TrackState::Lost => 3,
        };
        self.add(track.id);
        let numbers = [r.left, r.top, r.width, r.height, v.u, v.v, v.w, v.h, track.score];
        numbers.iter().for_each(|x| self.add(x.to_bits()));
        self.add(track.detection_index.map_or(u64::MAX, |row| row as u64));
        self.add(track.tag);
        self.add(i64::from(track.class_id) as u64);
        [state, track.age, track.hits, track.frames_since_match].iter().for_each(|n| self.add(u64::from(*n)));
    }

    fn add_output(&mut self, output: &Output) {
        for list in [&output.reported, &output.tentative, &output.lost] {
            self.add(list.len() as u64);
            list.iter().for_each(|track| self.add_track(track));
        }
        for ids in [&output.ended, &output.track_of_detection] {
            self.add(ids.len() as u64);
            ids.iter().for_each(|id| self.add(*id));
        }
    }
}

fn tracker(algorithm: Algorithm, given: &BTreeSet<&str>) -> Tracker {
    let mut config = Config::of(algorithm);
    if given.contains("paper") {
        config.set_text("preset", "paper").unwrap();
    }
    if given.contains("separate") {
        config.set_text("class_policy", "separate").unwrap();
    }
    if given.contains("camera") && config.get("use_camera_motion").is_ok() {
        config.set_text("use_camera_motion", "true").unwrap();
    }
    Tracker::new(&config).unwrap()
}

fn timestamp(t: usize) -> i64 {
    let t = t as i64;
    33_333_333 * t + 4_000_000 * (7 * t % 5) + if t >= 150 { 700_000_000 } else { 0 }
}

/// The hash of a scene, and how many tracks were reported in it.
fn play(algorithm: Algorithm, sequence: &Sequence, words: &str, texture: &[u8]) -> (u64, usize) {
    let given: BTreeSet<&str> = words.split('+').collect();
    let mut tracker = tracker(algorithm, &given);
    let (mut hash, mut reported, mut rows) = (Hash(14_695_981_039_346_656_037), 0, 0);
    let frames = if given.contains("images") { FRAMES_WITH_IMAGES } else { sequence.frames.len() };
    for (t, input) in (1..).zip(&sequence.frames[..frames]) {
        let mut detections = input.detections.clone();
        for (detection, row) in detections.iter_mut().zip(rows..) {
            (detection.tag, detection.class_id) = (row as u64, row % 3);
        }
        rows += detections.len() as i32;
        let rests = given.contains("rests") && t % 4 == 3;
        let shown = if rests { &[] } else { &detections[..] };
        let start = 2 * t % 100 * STRIDE + 3 * t % 100;
        let image =
            || ImageView::new(&texture[start..], WIDTH as u32, HEIGHT as u32, STRIDE, PixelFormat::Gray8).unwrap();
        let output = tracker.step(&Frame {
            detector_skipped: rests,
            embeddings: (given.contains("embeddings") && !rests).then(|| Embeddings::new(&input.embeddings, DIMENSION)),
            image: given.contains("images").then(image),
            size: Some((WIDTH as u32, HEIGHT as u32)),
            camera_motion: input.camera_motion.filter(|_| given.contains("camera")),
            timestamp_ns: given.contains("times").then(|| timestamp(t)),
            ..Frame::new(shown)
        });
        let output = output.unwrap();
        reported += output.reported.len();
        hash.add_output(output);
    }
    (hash.0, reported)
}

/// The lines of one tracker.
fn lines_of(algorithm: Algorithm) -> Vec<String> {
    let texture = texture();
    let paper = (algorithm == Algorithm::GenTrack2).then_some(PAPER);
    let scenes = SCENES.into_iter().chain(paper);
    let line = |(name, words): (&str, &str)| {
        let (hash, reported) = play(algorithm, &place::synthetic(name).unwrap(), words, &texture);
        assert!(reported > 30, "{name} {words}: there is something to compare");
        format!("{} {name} {words} {hash:016x}", algorithm.name())
    };
    scenes.map(line).collect()
}

macro_rules! golden {
    ($($name:ident)+) => {$(
        #[test]
        fn $name() {
            let text = std::fs::read_to_string(hashes()).unwrap();
            let expected: Vec<&str> = text.lines().filter(|l| l.starts_with(concat!(stringify!($name), " "))).collect();
            assert_eq!(lines_of(Algorithm::from_name(stringify!($name)).unwrap()), expected);
        }
    )+};
}

golden! { gentrack2 sort deepsort bytetrack ocsort botsort smiletrack conftrack }

#[test]
fn what_a_frame_has_matters() {
    // Were it not to, the scenes would be one. Only gentrack2 looks at images.
    let texture = texture();
    let (a, b) = (place::synthetic("syn_a2").unwrap(), place::synthetic("syn_b1").unwrap());
    let hash = |sequence, words| play(Algorithm::GenTrack2, sequence, words, &texture).0;
    let all = ["-", "embeddings", "times", "rests", "separate", "paper"].map(|words| hash(&a, words));
    assert_eq!(BTreeSet::from(all).len(), all.len());
    let moving = ["images", "images+camera", "images+times", "images+camera+times"].map(|words| hash(&b, words));
    assert_eq!(BTreeSet::from(moving).len(), moving.len());
}

/// Writes the hashes anew: `cargo test --test golden write_hashes -- --ignored`.
#[test]
#[ignore = "writes a file"]
fn write_hashes() {
    let lines: Vec<String> = Algorithm::ALL.iter().flat_map(|algorithm| lines_of(*algorithm)).collect();
    std::fs::write(hashes(), lines.join("\n") + "\n").unwrap();
}
