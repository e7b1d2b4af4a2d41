//! Memory per live track, counted by the allocator, and the resident size over many frames. Prints lines of a name and a
//! number.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicI64, Ordering};

use gentrack2::{Algorithm, Config, Detection, Frame, ImageView, PixelFormat, Tracker};
use scenes::{Canvas, Crowd, Video};

static LIVE: AtomicI64 = AtomicI64::new(0);

struct Counting;

// SAFETY: every call is passed on unchanged to the system's allocator, which keeps the contract.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        LIVE.fetch_add(layout.size() as i64, Ordering::Relaxed);
        // SAFETY: the caller keeps `alloc`'s contract.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        LIVE.fetch_sub(layout.size() as i64, Ordering::Relaxed);
        // SAFETY: the pointer came from `alloc` with this layout, and so from the system's allocator.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// People in a frame, each of whom is then remembered, in so many frames one after the other.
const PEOPLE: usize = 1024;
const GROUPS: usize = 5;
/// Pixels that a group of them takes.
const GROUP: (usize, usize) = (4000, 2200);

/// A picture with something to see everywhere, wide enough for so many groups.
fn picture(groups: usize) -> Vec<u8> {
    let pixels = GROUP.0 * groups * GROUP.1;
    (0..pixels as u64).map(|i| (i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 56) as u8).collect()
}

/// Live bytes of a tracker after each of so many groups of people who stand still, one group after the other: the more
/// groups, the more tracks, while frames are of one size.
fn live_bytes(algorithm: Algorithm, groups: usize, images: bool) -> Vec<f64> {
    let picture = if images { picture(groups) } else { Vec::new() };
    let (width, height) = ((GROUP.0 * groups) as u32, GROUP.1 as u32);
    let image = images.then(|| ImageView::new(&picture, width, height, 0, PixelFormat::Gray8).expect("it fits"));
    let mut detections = Vec::with_capacity(PEOPLE);
    let mut readings = Vec::with_capacity(groups);
    let before = LIVE.load(Ordering::Relaxed);
    let mut config = Config::of(algorithm);
    // Whoever was seen is remembered; every algorithm has one of these.
    for key in ["max_age", "track_buffer", "max_missed"] {
        let _ = config.set_text(key, "10000");
    }
    let mut tracker = Tracker::new(&config).expect("a long memory is fine");
    for group in 0..groups {
        // Side by side, so that none overlaps another: only tracks differ.
        let left = |i: usize| 60.0 * (i % 64) as f64 + (GROUP.0 * group) as f64;
        let at = |i: usize| Detection::new(left(i), 130.0 * (i / 64) as f64, 40.0, 100.0, 0.9);
        detections.clear();
        detections.extend((0..PEOPLE).map(at));
        let mut live = 0;
        for _ in 0..60 {
            let output = tracker.step(&Frame { image, ..Frame::new(&detections) }).expect("a valid frame");
            live = output.reported.len() + output.tentative.len() + output.lost.len();
        }
        assert_eq!(live, (group + 1) * PEOPLE, "{}: somebody was forgotten", algorithm.name());
        readings.push((LIVE.load(Ordering::Relaxed) - before) as f64);
    }
    readings
}

/// Bytes that one more live track costs: the most of several numbers of tracks, as lists have more room left over at one
/// than at another.
fn bytes_per_track(algorithm: Algorithm, images: bool) -> f64 {
    let readings = live_bytes(algorithm, GROUPS, images);
    let more = |groups: usize| (readings[groups - 1] - readings[0]) / ((groups - 1) * PEOPLE) as f64;
    (2..=GROUPS).map(more).fold(0.0, f64::max)
}

/// Pages in memory, in KiB.
fn resident_kib() -> f64 {
    let text = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    line.and_then(|l| l.trim().split(' ').next()?.parse().ok()).unwrap_or(f64::NAN)
}

fn resident_growth(algorithm: Algorithm, video: &Video) -> f64 {
    let mut tracker = Tracker::new(&Config::of(algorithm)).expect("defaults make a tracker");
    let mut early = f64::NAN;
    for frame in 0..200_000 {
        let detections = &video.frames[frame % video.frames.len()];
        tracker.step(&Frame { size: Some(video.size), ..Frame::new(detections) }).expect("a valid frame");
        if frame == 50_000 {
            early = resident_kib();
        }
    }
    resident_kib() - early
}

fn main() {
    let video = Crowd::new(12, Canvas::Fixed, 1).video(1000);
    for &algorithm in Algorithm::ALL {
        eprintln!("memory of {}", algorithm.name());
        println!("track_bytes.{} {:.0}", algorithm.name(), bytes_per_track(algorithm, false));
        if algorithm == Algorithm::GenTrack2 {
            // The others do not look at images.
            println!("looking_track_bytes.{} {:.0}", algorithm.name(), bytes_per_track(algorithm, true));
        }
        println!("resident_growth_kib.{} {:.0}", algorithm.name(), resident_growth(algorithm, &video));
    }
}
