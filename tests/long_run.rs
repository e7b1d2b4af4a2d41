//! What rounding and counters add up to over hours.

use gentrack2::{Algorithm, CameraMotion, Config, Detection, Embeddings, Frame, Tracker};

/// Somebody stands for half an hour before a camera that turns and zooms a little, back and forth, and is seen in
/// every frame: one identity, one place.
fn stands_before_a_moving_camera(algorithm: Algorithm) {
    let mut config = Config::of(algorithm);
    if config.get("use_camera_motion").is_ok() {
        config.set_text("use_camera_motion", "true").unwrap();
    }
    let mut tracker = Tracker::new(&config).unwrap();
    let detections = [Detection::new(900.0, 440.0, 80.0, 200.0, 0.9)];
    let looks = [0.6f32, 0.8];
    let mut id = 0;
    for frame in 0..50_000u32 {
        let (angle, zoom) = if frame % 2 == 0 { (1e-3, 1.0) } else { (-1e-3, 1.0 / (1.0 + 1e-6)) };
        // About the middle of the image, so that who stands there stays.
        let (a, b) = (zoom, zoom * angle);
        let motion = CameraMotion([a, -b, 940.0 - a * 940.0 + b * 540.0, b, a, 540.0 - b * 940.0 - a * 540.0]);
        let input = Frame {
            camera_motion: (frame > 0).then_some(motion),
            embeddings: Some(Embeddings::new(&looks, 2)),
            size: Some((1920, 1080)),
            ..Frame::new(&detections)
        };
        let output = tracker.step(&input).unwrap();
        if frame < 5 {
            continue;
        }
        let [track] = output.reported[..] else { panic!("{algorithm:?}, frame {frame}: {output:?}") };
        id = if id == 0 { track.id } else { id };
        assert_eq!(track.id, id, "{algorithm:?}, frame {frame}");
        let (seen, shown) = (&detections[0].rect, &track.rect);
        let off = [shown.left - seen.left, shown.top - seen.top, shown.width - seen.width, shown.height - seen.height];
        assert!(off.iter().all(|x| x.abs() < 5.0), "{algorithm:?}, frame {frame}: {shown:?}");
    }
}

#[test]
fn who_stands_before_a_moving_camera_stays_who_and_where_they_are() {
    for &algorithm in Algorithm::ALL {
        stands_before_a_moving_camera(algorithm);
    }
}

/// Numbers of frames and matches have 32 bits, which are full after years. Identities have 64.
#[cfg(feature = "snapshot")]
mod counters {
    use gentrack2::Output;

    use super::*;

    const HEADER: usize = 20;
    const CHECKSUM: usize = 4;
    /// The walkers have been seen for so many frames more than the tracker has seen.
    const YEARS: u32 = u32::MAX - 60;
    /// Frames before and after these years.
    const BEFORE: usize = 30;
    const AFTER: usize = 60;
    const WALKERS: usize = 6;

    /// Six walkers; after the years they are missed for a moment, and somebody new comes in every ten frames.
    fn detections(frame: usize) -> Vec<Detection> {
        let walker = |lane: usize, age: usize| {
            let rect = Detection::new(30.0 + 2.0 * age as f64, 20.0 + 120.0 * lane as f64, 40.0, 100.0, 0.9);
            Detection { class_id: lane as i32, tag: (1000 * lane + age) as u64, ..rect }
        };
        let missed = (BEFORE + 20..BEFORE + 23).contains(&frame);
        let mut all: Vec<Detection> = (0..if missed { 0 } else { WALKERS }).map(|lane| walker(lane, frame)).collect();
        all.extend((0..5).filter(|n| frame >= BEFORE + 10 * n).map(|n| walker(WALKERS + n, frame)));
        all
    }

    fn tracker(algorithm: Algorithm) -> Tracker {
        let mut config = Config::of(algorithm);
        // The walkers' identities are the last that have 32 bits.
        config.set_text("first_id", &(u64::from(u32::MAX) - WALKERS as u64 + 1).to_string()).unwrap();
        if algorithm == Algorithm::Sort {
            config.set_text("max_age", "30").unwrap();
        }
        Tracker::new(&config).unwrap()
    }

    /// What a snapshot says of a track that took `detection` in the last frame, after so many frames and matches.
    fn life(id: u64, row: usize, detection: &Detection, frames: u32, hits: u32) -> Vec<u8> {
        let r = &detection.rect;
        let rect = (r.left, r.top, r.width, r.height);
        let taken = (rect, detection.score, detection.class_id, detection.tag);
        postcard::to_allocvec(&(id, taken, Some(row as u32), frames, hits, 0u32)).unwrap()
    }

    fn replace_once(bytes: &mut Vec<u8>, old: &[u8], new: &[u8]) {
        let places: Vec<usize> = (0..bytes.len()).filter(|at| bytes[*at..].starts_with(old)).collect();
        let [at] = places[..] else { panic!("{} places", places.len()) };
        bytes.splice(at..at + old.len(), new.iter().copied());
    }

    /// The tracker as it would be had it seen the same for years.
    fn years_later(tracker: &Tracker, detections: &[Detection]) -> Tracker {
        let bytes = tracker.save();
        let payload = &bytes[HEADER..bytes.len() - CHECKSUM];
        type Settings = (String, Vec<(String, String)>);
        type Clocks = (u64, (Option<u64>, Option<i64>), (f64, u64));
        let (_, rest) = postcard::take_from_bytes::<Settings>(payload).unwrap();
        let ((next, history, (since, frames)), state) = postcard::take_from_bytes::<Clocks>(rest).unwrap();
        assert_eq!((next, frames), (u64::from(u32::MAX) + 1, BEFORE as u64));
        let mut aged = payload[..payload.len() - rest.len()].to_vec();
        let clocks: Clocks = (next, history, (since, frames + u64::from(YEARS)));
        aged.extend(postcard::to_allocvec(&clocks).unwrap());
        aged.extend(state);
        for track in &tracker.output().reported {
            let row = track.detection_index.unwrap();
            let life = |more| life(track.id, row, &detections[row], track.age + more, track.hits + more);
            replace_once(&mut aged, &life(0), &life(YEARS));
        }
        let mut whole = bytes[..HEADER - 8].to_vec();
        whole.extend((aged.len() as u64).to_le_bytes());
        whole.extend(aged);
        whole.extend(crc32fast::hash(&whole).to_le_bytes());
        Tracker::load(&whole).unwrap()
    }

    /// An output with the ages that the tracks would have had they lived through the years.
    fn aged(output: &Output) -> Output {
        let mut output = output.clone();
        let lists = [&mut output.reported, &mut output.tentative, &mut output.lost];
        for track in lists.into_iter().flatten().filter(|track| track.id <= u64::from(u32::MAX)) {
            track.age = track.age.saturating_add(YEARS);
            track.hits = track.hits.saturating_add(YEARS);
        }
        output
    }

    fn goes_on(algorithm: Algorithm) {
        let mut young = tracker(algorithm);
        for frame in 0..BEFORE {
            young.step(&Frame::new(&detections(frame))).unwrap();
        }
        assert_eq!(young.output().reported.len(), WALKERS, "{algorithm:?}");
        let mut old = years_later(&young, &detections(BEFORE - 1));
        for frame in BEFORE..BEFORE + AFTER {
            let seen = detections(frame);
            let expected = format!("{:?}", aged(young.step(&Frame::new(&seen)).unwrap()));
            assert_eq!(
                format!("{:?}", old.step(&Frame::new(&seen)).unwrap()),
                expected,
                "{algorithm:?}, frame {frame}"
            );
        }
        let reported = &old.output().reported;
        assert!(reported.iter().any(|track| track.age == u32::MAX), "{algorithm:?}: the counter is full");
        assert!(
            reported.iter().filter(|track| track.id > u64::from(u32::MAX)).count() == 5,
            "{algorithm:?}: {reported:?}"
        );
        assert_eq!(reported.len(), WALKERS + 5, "{algorithm:?}");
    }

    #[test]
    fn full_counters_stay_full_and_change_nothing() {
        Algorithm::ALL.iter().for_each(|algorithm| goes_on(*algorithm));
    }
}
