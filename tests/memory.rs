//! Memory is bounded: nothing about an ended track is kept, and once warm a step allocates nothing. Counted by the
//! allocator itself, hence a test binary of its own with a single test.

mod counting;

use counting::{ALLOCATIONS, LIVE_BYTES};
use gentrack2::{Algorithm, CameraMotion, Config, Detection, Embeddings, Frame, ImageView, PixelFormat, Tracker};

const WIDTH: u32 = 320;
const HEIGHT: u32 = 240;
/// Frames after which the same input comes again.
const PERIOD: usize = 500;
const DIMENSION: usize = 16;

/// A generator of pseudo-random numbers in `[0, 1)`.
fn noise(seed: usize) -> f64 {
    let mixed = (seed as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let mixed = (mixed ^ (mixed >> 31)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    (mixed >> 40) as f64 / (1u64 << 24) as f64
}

/// Walkers that come in on the left every 20 frames, in six lanes, cross the image in 100 frames and are missed now
/// and then, and one short-lived false detection in four frames.
fn fill_detections(frame: usize, detections: &mut Vec<Detection>) {
    detections.clear();
    for walker in 0..25 {
        let age = (frame + PERIOD - 20 * walker) % PERIOD;
        if age < 100 && noise(31 * frame + walker) > 0.1 {
            let left = -10.0 + 3.3 * age as f64 + noise(frame + 7 * walker);
            let top = 10.0 + 33.0 * (walker % 6) as f64;
            let score = 0.7 + 0.2 * noise(frame + walker);
            detections.push(Detection { class_id: walker as i32 % 3, ..Detection::new(left, top, 16.0, 40.0, score) });
        }
    }
    if frame.is_multiple_of(4) {
        let (left, top) = (300.0 * noise(frame), 200.0 * noise(frame + 1));
        detections.push(Detection::new(left, top, 16.0, 40.0, 0.75));
    }
}

/// What the tracker is given besides detections.
#[derive(Clone, Copy, Debug)]
struct Given {
    images: bool,
    embeddings_and_camera: bool,
    class_policy: &'static str,
}

const PLAIN: Given = Given { images: false, embeddings_and_camera: false, class_policy: "ignore" };
const SEPARATE: Given = Given { class_policy: "separate", ..PLAIN };
const LOOKS: Given = Given { embeddings_and_camera: true, ..PLAIN };
const IMAGES: Given = Given { images: true, ..PLAIN };
const EVERYTHING: Given = Given { images: true, ..LOOKS };

fn tracker(algorithm: Algorithm, class_policy: &str) -> Tracker {
    let mut config = Config::of(algorithm);
    config.set_text("class_policy", class_policy).unwrap();
    if config.get("use_camera_motion").is_ok() {
        config.set_text("use_camera_motion", "true").unwrap();
    }
    Tracker::new(&config).unwrap()
}

struct Readings {
    /// Live bytes after the frames asked for.
    live: Vec<i64>,
    /// Allocations in `step` between the last two of these frames.
    allocations: u64,
    /// Identities given out.
    identities: u64,
}

/// Runs up to the last of `marks`.
fn run(algorithm: Algorithm, given: Given, marks: &[usize]) -> Readings {
    let texture: Vec<u8> = (0..(WIDTH * HEIGHT) as usize).map(|i| (255.0 * noise(i / 5)) as u8).collect();
    let embeddings: Vec<f32> = (0..64 * DIMENSION).map(|i| noise(i) as f32 - 0.5).collect();
    let mut detections = Vec::with_capacity(64);
    let mut live = Vec::with_capacity(marks.len());
    let mut tracker = tracker(algorithm, given.class_policy);
    let (mut allocations, mut identities) = (0, 0);
    for frame in 0..=*marks.last().unwrap() {
        fill_detections(frame % PERIOD, &mut detections);
        let mut input = Frame { size: Some((WIDTH, HEIGHT)), ..Frame::new(&detections) };
        if given.images {
            input.image = Some(ImageView::new(&texture, WIDTH, HEIGHT, 0, PixelFormat::Gray8).unwrap());
        }
        if given.embeddings_and_camera {
            input.embeddings = Some(Embeddings::new(&embeddings, DIMENSION));
            input.camera_motion = Some(CameraMotion([1.0, 0.0, 0.3, 0.0, 1.0, -0.2]));
        }
        let before = ALLOCATIONS.get();
        let output = tracker.step(&input).unwrap();
        allocations += ALLOCATIONS.get() - before;
        identities = output.reported.iter().map(|t| t.id).fold(identities, u64::max);
        if marks.contains(&frame) {
            live.push(LIVE_BYTES.get());
            if live.len() < marks.len() {
                allocations = 0;
            }
        }
    }
    Readings { live, allocations, identities }
}

/// Steps with ever new classes, each tracked apart; the most live bytes in the first and in the second half.
fn ever_new_classes(algorithm: Algorithm) -> [i64; 2] {
    const HALF: i32 = 300;
    let mut tracker = tracker(algorithm, "separate");
    let mut detections = Vec::with_capacity(64);
    let mut most = [0; 2];
    for frame in 0..2 * HALF {
        detections.clear();
        detections.extend(
            (0..20).map(|i| Detection {
                class_id: 20 * frame + i,
                ..Detection::new(30.0 * i as f64, 50.0, 16.0, 40.0, 0.9)
            }),
        );
        tracker.step(&Frame::new(&detections)).unwrap();
        let half = &mut most[(frame / HALF) as usize];
        *half = LIVE_BYTES.get().max(*half);
    }
    most
}

// One test, so that no other thread's start allocates in between.
#[test]
fn live_bytes_do_not_grow_and_warm_steps_do_not_allocate() {
    for &algorithm in Algorithm::ALL {
        let name = algorithm.name();
        for given in [PLAIN, SEPARATE, LOOKS, IMAGES, EVERYTHING] {
            // Marks at the same point of the input's period, so that as many walkers are in the image, and late enough that
            // as many have been remembered at a time as ever are.
            let marks = [5_000, 10_000, 20_000];
            let readings = run(algorithm, given, &marks);
            println!(
                "{name}, {given:?}: live bytes {:?} after {marks:?} frames, {} identities, {} allocations",
                readings.live, readings.identities, readings.allocations
            );
            // A walker comes every 20 frames.
            assert!(readings.identities as usize >= marks[2] / 20, "{name}: {} identities", readings.identities);
            let growth = readings.live[2] - readings.live[0];
            assert_eq!(readings.allocations, 0, "{name}, {given:?}: every buffer has its size by now");
            assert!(growth <= 0, "{name}, {given:?}: {growth} bytes more, {:?} after {marks:?}", readings.live);
        }
        // There a new class needs memory, but those that are gone give theirs back.
        let [early, late] = ever_new_classes(algorithm);
        println!("{name}, ever new classes: at most {early} and {late} live bytes");
        assert!(late as f64 <= 1.05 * early as f64, "{name}, ever new classes: {early}, then {late} live bytes");
    }
}
