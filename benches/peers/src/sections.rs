//! What is measured, with what each measure should be.

use std::time::Duration;

use gentrack2::Algorithm;
use scenes::{Canvas, Crowd, STRONG, Video, mot17_04, wants_strong};

use crate::contest::{Entry, Plan, exponent, run};
use crate::table::{Line, Table, Target};
use crate::{Readings, others, ours};

/// Frames of a crowd in which trackers are compared.
const FRAMES: usize = 40;
const PLAN: Plan = Plan { rounds: 3, warm_up: 8, budget: Duration::from_millis(600) };
/// A peer that takes longer per step sits out larger crowds.
const TOO_SLOW: f64 = 250_000.0;

/// Algorithms that another crate has, too.
const SHARED: [Algorithm; 4] = [Algorithm::Sort, Algorithm::ByteTrack, Algorithm::OcSort, Algorithm::BotSort];

/// A line from the entries and their times, the first of which is the library's.
fn line(what: String, entries: &[Entry], times: &[f64], target: Target) -> Line {
    let peers = entries.iter().zip(times).skip(1).map(|(entry, time)| (entry.name.to_string(), *time));
    Line { what, ours: times[0], unit: "", peers: peers.collect(), target }
}

/// What a detector gives: one round of association does without the weak ones.
fn fed(algorithm: Algorithm, video: &Video) -> Video {
    let strong = wants_strong(algorithm) || algorithm == Algorithm::OcSort;
    if strong { video.scored_from(STRONG) } else { video.clone() }
}

/// MOT17-04 with YOLOX detections.
pub fn mot17(table: &mut Table) {
    table.section("MOT17-04, about 45 tracks");
    let Some(video) = mot17_04() else {
        return table.skip("GENTRACK2_SHARED names no directory with mot17/");
    };
    let plan = Plan { rounds: 5, warm_up: 30, budget: Duration::from_millis(1500) };
    for &algorithm in Algorithm::ALL {
        let mut entries = vec![ours::entry(algorithm)];
        let mut target = Target::None;
        if SHARED.contains(&algorithm) {
            target = Target::Faster(4.0);
            entries.extend(others::entries(algorithm));
        } else if algorithm == Algorithm::GenTrack2 {
            target = Target::AtMostTimes(2.0);
            entries.extend(others::entries(Algorithm::ByteTrack));
        }
        let what = match algorithm {
            Algorithm::GenTrack2 => "gentrack2 without images, peers: ByteTrack".to_string(),
            algorithm => algorithm.name().to_string(),
        };
        let times = run(&fed(algorithm, &video), &mut entries, &plan);
        table.add(line(what, &entries, &times, target));
    }
}

/// Crowds on one canvas, against the peers.
pub fn crowds(table: &mut Table) {
    table.section("Crowds: boxes on 3840 x 2160, 10 % missed, 5 % clutter");
    for &algorithm in &SHARED {
        let mut is_slow = vec![false; others::entries(algorithm).len()];
        for boxes in [10, 100, 200, 1000, 2000] {
            let video = Crowd::new(boxes, Canvas::Fixed, 1).video(FRAMES);
            let mut entries = vec![ours::entry(algorithm)];
            let peers = others::entries(algorithm);
            let names: Vec<&str> = peers.iter().map(|peer| peer.name).collect();
            entries.extend(peers.into_iter().zip(&is_slow).filter(|(_, slow)| !**slow).map(|(peer, _)| peer));
            let times = run(&video, &mut entries, &PLAN);
            for (entry, time) in entries.iter().zip(&times).filter(|(_, time)| **time > TOO_SLOW / 10.0) {
                // From here on the next crowd is at least four times as dear.
                if let Some(peer) = names.iter().position(|name| *name == entry.name) {
                    is_slow[peer] |= *time > TOO_SLOW || boxes < 1000;
                }
            }
            let target = if boxes == 1000 { Target::Faster(25.0) } else { Target::None };
            table.add(line(format!("{}, {boxes} boxes", algorithm.name()), &entries, &times, target));
        }
    }
}

/// Growth where the canvas grows with the number of boxes.
pub fn growth(table: &mut Table) {
    table.section("Growth: 100 to 2000 boxes, 1000 per 3840 x 2160");
    let plan = Plan { rounds: 5, warm_up: 30, budget: Duration::from_secs(3) };
    for &algorithm in Algorithm::ALL {
        let mut points = Vec::new();
        for boxes in [100, 200, 500, 1000, 2000] {
            let video = Crowd::new(boxes, Canvas::Growing, 1).video(60);
            points.push((boxes as f64, run(&video, &mut [ours::entry(algorithm)], &plan)[0]));
        }
        let times: Vec<String> = points.iter().map(|(_, time)| crate::table::number(*time)).collect();
        table.add(Line {
            what: format!("{}: {}", algorithm.name(), times.join(", ")),
            ours: exponent(&points),
            unit: "(exponent)",
            peers: Vec::new(),
            target: Target::AtMost(1.15),
        });
    }
}

/// Crowds too large for the peers.
pub fn large_crowds(table: &mut Table) {
    table.section("Large crowds on the same canvas, all trackers");
    for boxes in [2000, 5000, 20_000] {
        let plan = match boxes {
            2000 => Plan { rounds: 3, warm_up: 30, budget: Duration::from_secs(2) },
            _ => Plan { rounds: 1, warm_up: 4, budget: Duration::from_secs(2) },
        };
        let video = Crowd::new(boxes, Canvas::Fixed, 1).video(plan.warm_up + 10);
        for &algorithm in Algorithm::ALL {
            let target = match (boxes, algorithm) {
                (2000, Algorithm::GenTrack2) => Target::AtMost(25_000.0),
                (2000, _) => Target::AtMost(10_000.0),
                _ => Target::None,
            };
            let mut entries = [ours::entry(algorithm)];
            let times = run(&video, &mut entries, &plan);
            table.add(line(format!("{}, {boxes} boxes", algorithm.name()), &entries, &times, target));
        }
    }
}

/// GenTrack2 with images against OpenCV.
pub fn images(table: &mut Table, readings: &Readings) {
    table
        .section("GenTrack2 with images, all included; peer: OpenCV's HOGDescriptor, as many descriptors as particles");
    for (name, what) in [("vtest", "vtest.avi, 768 x 576"), ("1080p", "45 targets of 100 x 240 on 1920 x 1080")] {
        let reading = |key: &str| readings.get(&format!("{name}.{key}")).copied();
        let (Some(step), Some(opencv), Some(count)) =
            (reading("step_us"), reading("opencv_us"), reading("descriptors"))
        else {
            table.skip(&format!("{what}: no reading"));
            continue;
        };
        table.add(Line {
            what: format!("{what}, {count:.0} descriptors"),
            ours: step,
            unit: "",
            peers: vec![("OpenCV".into(), opencv)],
            target: Target::Faster(10.0),
        });
        if name == "1080p" {
            let what = "the same, mean step".into();
            table.add(Line { what, ours: step, unit: "", peers: Vec::new(), target: Target::AtMost(2000.0) });
        }
    }
}

/// Many streams on one and two threads.
pub fn streams(table: &mut Table, readings: &Readings) {
    table.section("64 streams of gentrack2, 30 people each");
    let (Some(one), Some(two)) = (readings.get("streams.1"), readings.get("streams.2")) else {
        return table.skip("this machine has one core");
    };
    for (what, rate) in [("1 thread", one), ("2 threads", two)] {
        let what = what.into();
        table.add(Line { what, ours: *rate, unit: "frames/s", peers: Vec::new(), target: Target::None });
    }
    let what = "2 threads to 1".into();
    table.add(Line { what, ours: two / one, unit: "x", peers: Vec::new(), target: Target::AtLeast(1.8) });
}

/// Memory, and the library as a file.
pub fn memory_and_library(table: &mut Table, readings: &Readings) {
    table.section("Memory and the shared library");
    let growth = "resident size, growth from frame 50 000 to 200 000";
    for (algorithms, key, what, unit, target) in [
        (Algorithm::ALL, "track_bytes", "bytes per live track", "B", Target::AtMost(4096.0)),
        // The others do not look at images.
        (
            &[Algorithm::GenTrack2][..],
            "looking_track_bytes",
            "bytes per live track, with images",
            "B",
            Target::AtMost(4096.0),
        ),
        (Algorithm::ALL, "resident_growth_kib", growth, "KiB", Target::AtMost(64.0)),
    ] {
        for &algorithm in algorithms {
            match readings.get(&format!("{key}.{}", algorithm.name())) {
                Some(value) => {
                    let what = format!("{}: {what}", algorithm.name());
                    table.add(Line { what, ours: *value, unit, peers: Vec::new(), target });
                }
                None => table.skip(&format!("{}: {what}: no reading", algorithm.name())),
            }
        }
    }
    for (key, what, unit, target) in [
        ("stripped_kib", "shared library, stripped", "KiB", Target::AtMost(1536.0)),
        ("foreign_needs", "needed beside libc, libm, libgcc_s and ld-linux", "libraries", Target::AtMost(0.0)),
        ("load_us", "loading it", "us", Target::AtMost(1000.0)),
    ] {
        match readings.get(key) {
            Some(value) => table.add(Line { what: what.into(), ours: *value, unit, peers: Vec::new(), target }),
            None => table.skip(&format!("{what}: no reading")),
        }
    }
}
