//! A parade: boxes that move at constant speeds, seen by a perfect detector, for what every algorithm must be able to do.
//! Time is in seconds and lengths in pixels.

// Each test binary uses its own part of this module.
#![allow(dead_code)]

use std::collections::{BTreeMap, BTreeSet};

use gentrack2::{Algorithm, Config, Detection, Frame, Output, Rect, Track, Tracker};

/// Frames per second unless a test has its own.
pub const RATE: f64 = 30.0;

/// Somebody in the parade.
#[derive(Clone, Debug)]
pub struct Walker {
    /// Box at time 0.
    pub start: Rect,
    /// Pixels per second.
    pub speed: (f64, f64),
    pub class: i32,
    pub score: f64,
    /// From when to when it is seen.
    pub seen: (f64, f64),
    /// From when to when it is hidden in between.
    pub hidden: (f64, f64),
}

impl Walker {
    pub fn new(left: f64, top: f64, speed: (f64, f64)) -> Self {
        let start = Rect::new(left, top, 40.0, 90.0);
        Self { start, speed, class: 0, score: 0.9, seen: (0.0, f64::INFINITY), hidden: (0.0, 0.0) }
    }

    pub fn of_class(self, class: i32) -> Self {
        Self { class, ..self }
    }

    pub fn hidden(self, from: f64, to: f64) -> Self {
        Self { hidden: (from, to), ..self }
    }

    pub fn seen(self, from: f64, to: f64) -> Self {
        Self { seen: (from, to), ..self }
    }

    pub fn at(&self, time: f64) -> Rect {
        let Rect { left, top, .. } = self.start;
        Rect { left: left + self.speed.0 * time, top: top + self.speed.1 * time, ..self.start }
    }

    pub fn detection(&self, time: f64) -> Option<Detection> {
        let within = |(from, to): (f64, f64)| time >= from && time < to;
        (within(self.seen) && !within(self.hidden)).then(|| Detection {
            rect: self.at(time),
            score: self.score,
            class_id: self.class,
            tag: 0,
        })
    }
}

/// Three who never come near each other.
pub fn three() -> Vec<Walker> {
    vec![
        Walker::new(100.0, 100.0, (60.0, 0.0)),
        Walker::new(800.0, 300.0, (-45.0, 15.0)),
        Walker::new(300.0, 600.0, (30.0, -6.0)),
    ]
}

/// What is seen at a time; the tag says whom it is of.
pub fn look(walkers: &[Walker], time: f64) -> Vec<Detection> {
    let tagged = walkers.iter().zip(1..).map(|(w, tag)| w.detection(time).map(|d| Detection { tag, ..d }));
    tagged.flatten().collect()
}

pub fn frame_time(frame: usize) -> f64 {
    frame as f64 / RATE
}

/// A tracker of this algorithm.
pub fn tracker(algorithm: Algorithm, settings: &[(&str, &str)]) -> Tracker {
    let mut config = Config::of(algorithm);
    for (key, value) in settings {
        config.set_text(key, value).unwrap_or_else(|e| panic!("{}: {e}", algorithm.name()));
    }
    Tracker::new(&config).unwrap_or_else(|e| panic!("{}: {e}", algorithm.name()))
}

/// The settings with which lost tracks are kept for about a second: SORT's own are for one frame.
pub fn patient(algorithm: Algorithm) -> &'static [(&'static str, &'static str)] {
    if algorithm == Algorithm::Sort { &[("max_age", "30")] } else { &[] }
}

/// Whether the algorithm has a parameter.
pub fn has(algorithm: Algorithm, key: &str) -> bool {
    Config::of(algorithm).get(key).is_ok()
}

/// Runs a test for every algorithm, whose name it is given for its messages.
pub fn for_all(test: impl Fn(Algorithm, &str)) {
    for &algorithm in Algorithm::ALL {
        test(algorithm, algorithm.name());
    }
}

/// All live tracks.
pub fn live(output: &Output) -> impl Iterator<Item = &Track> {
    output.reported.iter().chain(&output.tentative).chain(&output.lost)
}

/// The live track of an identity.
pub fn find(output: &Output, id: u64) -> Option<&Track> {
    live(output).find(|t| t.id == id)
}

/// The live track whose box is the nearest to this one, if they overlap.
pub fn nearest<'a>(output: &'a Output, rect: &Rect) -> Option<&'a Track> {
    let overlapping = live(output).filter(|t| t.rect.iou(rect) > 0.0);
    overlapping.max_by(|a, b| a.rect.iou(rect).total_cmp(&b.rect.iou(rect)))
}

/// Distance of two boxes' centres.
pub fn distance(a: &Rect, b: &Rect) -> f64 {
    let along = |a0: f64, a1: f64, b0: f64, b1: f64| 0.5 * (a0 + a1 - b0 - b1);
    along(a.left, a.right(), b.left, b.right()).hypot(along(a.top, a.bottom(), b.top, b.bottom()))
}

/// Watches births and ends.
#[derive(Default)]
pub struct Register {
    pub live: BTreeSet<u64>,
    pub ended: BTreeSet<u64>,
}

impl Register {
    /// Every track in one list, and every end named once, when it happens.
    pub fn check(&mut self, name: &str, output: &Output) {
        let now: BTreeSet<u64> = live(output).map(|t| t.id).collect();
        assert_eq!(now.len(), live(output).count(), "{name}: a track is in two lists");
        assert!(now.is_disjoint(&self.ended), "{name}: a track is back after its end");
        let gone: BTreeSet<u64> = self.live.difference(&now).copied().collect();
        let named: BTreeSet<u64> = output.ended.iter().copied().collect();
        assert_eq!(named.len(), output.ended.len(), "{name}: an end is named twice");
        assert_eq!(named, gone, "{name}: ends that were named and those that happened");
        self.ended.extend(named);
        self.live = now;
    }
}

/// A renaming of identities, one to one.
#[derive(Debug, Default)]
pub struct Renaming {
    there: BTreeMap<u64, u64>,
    back: BTreeMap<u64, u64>,
}

impl Renaming {
    /// Whether the two are one, now and before. 0, which is no identity, is itself.
    pub fn agrees(&mut self, here: u64, there: u64) -> bool {
        if here == 0 || there == 0 {
            return here == there;
        }
        *self.there.entry(here).or_insert(there) == there && *self.back.entry(there).or_insert(here) == here
    }
}

/// Plays frames of this many steps per second to a tracker; the detector runs on one in `every`.
pub fn play<'t>(
    tracker: &'t mut Tracker,
    walkers: &[Walker],
    frames: std::ops::Range<usize>,
    every: usize,
    mut watch: impl FnMut(usize, &Output),
) -> &'t Output {
    for index in frames {
        let seen = look(walkers, frame_time(index));
        let frame = if index.is_multiple_of(every) { Frame::new(&seen) } else { Frame::skipped() };
        watch(index, tracker.step(&frame).unwrap());
    }
    tracker.output()
}
