//! The reader of snapshots.

use std::panic::{AssertUnwindSafe, catch_unwind};

use gentrack2::{Algorithm, Config, Detection, Frame, Tracker};

use super::bytes::Bytes;

/// As they come from a file, the bytes are refused or load; forged, with a right checksum, they may make a tracker that
/// knows nonsense, but it comes to an end.
pub fn run(data: &[u8]) {
    let _ = Tracker::load(data);
    let mut bytes = Bytes::new(data);
    let mut snapshot = played(&mut bytes).save();
    let end = snapshot.len() - 4;
    for _ in 0..bytes.below(8) {
        // The header says how long the payload is and what it is: that is checked by the bytes as they come.
        let at = 20 + bytes.word() as usize % (end - 20);
        snapshot[at] = bytes.byte();
    }
    let checksum = crc32fast::hash(&snapshot[..end]);
    snapshot[end..].copy_from_slice(&checksum.to_le_bytes());
    if let Ok(mut forged) = Tracker::load(&snapshot) {
        // A panic is what the C ABI turns into a status.
        let _ = catch_unwind(AssertUnwindSafe(|| {
            for _ in 0..3 {
                let _ = forged.step(&frame(&detections(&mut bytes)));
            }
        }));
    }
}

fn played(bytes: &mut Bytes) -> Tracker {
    let algorithm = *bytes.pick(Algorithm::ALL);
    let mut config = Config::of(algorithm);
    let policy: &&str = bytes.pick(&["ignore", "same_class", "separate"]);
    config.set_text("class_policy", policy).expect("these exist");
    let mut tracker = Tracker::new(&config).expect("defaults are fine");
    for _ in 0..bytes.below(6) {
        tracker.step(&frame(&detections(bytes))).expect("these are good detections");
    }
    tracker
}

fn detections(bytes: &mut Bytes) -> Vec<Detection> {
    (0..bytes.below(8))
        .map(|_| Detection {
            class_id: bytes.below(3) as i32,
            ..Detection::new(640.0 * bytes.share(), 480.0 * bytes.share(), 40.0, 90.0, 0.4 + 0.6 * bytes.share())
        })
        .collect()
}

fn frame(detections: &[Detection]) -> Frame<'_> {
    Frame { size: Some((640, 480)), ..Frame::new(detections) }
}
