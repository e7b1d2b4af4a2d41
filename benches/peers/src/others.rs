//! The trackers of other crates, with the parameters of the library's own.

use std::hint::black_box;
use std::time::{Duration, Instant};

use edgefirst_tracker::bytetrack::{ByteTrack as EdgeByteTrack, ByteTrackBuilder};
use edgefirst_tracker::{DetectionBox, Tracker as _};
use gentrack2::{Algorithm, Detection};
use norfair_rs::{Detection as NorfairDetection, Tracker as Norfair, TrackerConfig};
use scenes::Video;
use similari::trackers::sort::PositionalMetricType;
use similari::trackers::sort::simple_api::Sort as SimilariSort;
use similari::utils::bbox::Universal2DBox;
use trackforge::trackers::botsort::BotSort;
use trackforge::trackers::byte_track::ByteTrack;
use trackforge::trackers::ocsort::OcSort;
use trackforge::trackers::sort::Sort;

use crate::contest::{Contestant, Entry};

/// A tracker as functions: one that makes it, one that brings a frame into its form, and one that steps.
struct Other<T, I, O> {
    tracker: T,
    make: fn() -> T,
    convert: fn(&[Detection]) -> I,
    step: fn(&mut T, I, usize) -> O,
}

impl<T, I, O> Contestant for Other<T, I, O> {
    fn begin(&mut self, _: &Video) {
        self.tracker = (self.make)();
    }

    fn step(&mut self, video: &Video, frame: usize) -> Duration {
        let input = (self.convert)(&video.frames[frame]);
        let start = Instant::now();
        let output = black_box((self.step)(&mut self.tracker, input, frame));
        let time = start.elapsed();
        drop(output);
        time
    }
}

fn entry<T: 'static, I: 'static, O: 'static>(
    name: &'static str,
    make: fn() -> T,
    convert: fn(&[Detection]) -> I,
    step: fn(&mut T, I, usize) -> O,
) -> Entry {
    Entry { name, tracker: Box::new(Other { tracker: make(), make, convert, step }) }
}

type Tuples = Vec<([f32; 4], f32, i64)>;

fn corner_and_size(d: &Detection) -> [f32; 4] {
    [d.rect.left as f32, d.rect.top as f32, d.rect.width as f32, d.rect.height as f32]
}

fn tuples(detections: &[Detection]) -> Tuples {
    detections.iter().map(|d| (corner_and_size(d), d.score as f32, 0)).collect()
}

#[derive(Clone, Debug)]
struct Corners([f32; 4], f32);

impl DetectionBox for Corners {
    fn bbox(&self) -> [f32; 4] {
        self.0
    }
    fn score(&self) -> f32 {
        self.1
    }
    fn label(&self) -> usize {
        0
    }
}

fn corners(detections: &[Detection]) -> Vec<Corners> {
    let both = |d: &Detection| [d.rect.left, d.rect.top, d.rect.right(), d.rect.bottom()].map(|x| x as f32);
    detections.iter().map(|d| Corners(both(d), d.score as f32)).collect()
}

fn universal(detections: &[Detection]) -> Vec<(Universal2DBox, Option<i64>)> {
    let boxed = |d: &Detection| {
        let [left, top, width, height] = corner_and_size(d);
        Universal2DBox::ltwh_with_confidence(left, top, width, height, d.score as f32)
    };
    detections.iter().map(|d| (boxed(d), None)).collect()
}

fn points(detections: &[Detection]) -> Vec<NorfairDetection> {
    let pair = |d: &Detection| [d.rect.left, d.rect.top, d.rect.right(), d.rect.bottom()];
    detections.iter().map(|d| NorfairDetection::from_slice(&pair(d), 2, 2).expect("two points")).collect()
}

/// A frame at 30 frames per second in nanoseconds.
const FRAME: u64 = 33_333_333;

/// What the other crates have for an algorithm.
pub fn entries(algorithm: Algorithm) -> Vec<Entry> {
    match algorithm {
        Algorithm::Sort => vec![
            entry("trackforge", || Sort::new(1, 3, 0.3), tuples, |t, input, _| t.update(input)),
            entry(
                "similari",
                || SimilariSort::new(1, 1, 1, PositionalMetricType::IoU(0.3), 0.05, None),
                universal,
                |t, input, _| t.predict(&input),
            ),
            // Made of the same parts, a Kalman filter and IoU, but matched greedily.
            entry(
                "norfair-rs (not SORT)",
                || Norfair::new(TrackerConfig::from_distance_name("iou", 0.7)).expect("a valid configuration"),
                points,
                |t, input, _| t.update(input, 1, None).len(),
            ),
        ],
        Algorithm::ByteTrack => vec![
            entry("trackforge", || ByteTrack::new(0.6, 30, 0.8, 0.7), tuples, |t, input, _| t.update(input)),
            entry(
                "edgefirst-tracker",
                || -> EdgeByteTrack<Corners> {
                    ByteTrackBuilder::new().track_high_conf(0.6).track_extra_lifespan(1_000_000_000).build()
                },
                corners,
                |t, input, frame| t.update(&input, frame as u64 * FRAME),
            ),
        ],
        Algorithm::OcSort => {
            vec![entry("trackforge", || OcSort::new(30, 3, 0.3, 3, 0.2), tuples, |t, input, _| t.update(input))]
        }
        Algorithm::BotSort => vec![entry(
            "trackforge",
            || BotSort::new(0.6, 30, 0.8, 0.7, 0.5, 0.25),
            tuples,
            |t, input, _| t.update(input, &[]),
        )],
        _ => Vec::new(),
    }
}
