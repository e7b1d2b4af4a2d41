//! Steps one tracker for some seconds, for a profiler to look at.
//!
//! ```text
//! profile ALGORITHM fixed|growing|mot17 BOXES [SECONDS]
//! ```

use std::hint::black_box;
use std::time::{Duration, Instant};

use gentrack2::{Config, Frame, Tracker};
use scenes::{Canvas, Crowd, STRONG, mot17_04, wants_strong};

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [algorithm, scene, boxes, rest @ ..] = &arguments[..] else {
        panic!("usage: profile ALGORITHM fixed|growing|mot17 BOXES [SECONDS]")
    };
    let config = Config::new(algorithm).expect("an algorithm's name");
    let boxes = boxes.parse().expect("a number of boxes");
    let seconds = rest.first().map_or(3.0, |s| s.parse().expect("seconds"));
    let video = match scene.as_str() {
        "fixed" => Crowd::new(boxes, Canvas::Fixed, 1).video(40),
        "growing" => Crowd::new(boxes, Canvas::Growing, 1).video(40),
        _ => mot17_04().expect("GENTRACK2_SHARED names a directory with mot17/"),
    };
    let video = if wants_strong(config.algorithm()) { video.scored_from(STRONG) } else { video };
    let (start, mut fastest, mut total, mut steps) = (Instant::now(), Duration::MAX, Duration::ZERO, 0u32);
    while start.elapsed().as_secs_f64() < seconds {
        let mut tracker = Tracker::new(&config).expect("a valid configuration");
        let begin = Instant::now();
        for detections in &video.frames {
            let frame = Frame { size: Some(video.size), ..Frame::new(detections) };
            black_box(tracker.step(&frame)).expect("a valid frame");
        }
        total += begin.elapsed();
        fastest = fastest.min(begin.elapsed());
        steps += video.frames.len() as u32;
    }
    println!(
        "{algorithm} {scene} {boxes}: mean step {:.1} us, in the fastest round {:.1} us",
        total.as_secs_f64() * 1e6 / f64::from(steps),
        fastest.as_secs_f64() * 1e6 / video.frames.len() as f64
    );
}
