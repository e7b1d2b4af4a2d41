//! The reader of snapshots.

use std::panic::{AssertUnwindSafe, catch_unwind};

use gentrack2::{Algorithm, CameraMotion, Config, Detection, Embeddings, Frame, ImageView, PixelFormat, Tracker};

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
        // With all there is to remember: a row of numbers per detection, and a picture.
        let detections = detections(bytes);
        let numbers: Vec<f32> =
            detections.iter().flat_map(|d| [d.rect.left as f32, d.rect.top as f32, 100.0]).collect();
        let pixels: Vec<u8> = (0..640 * 480).map(|i| (i / 7 % 251) as u8).collect();
        let everything = Frame {
            embeddings: Some(Embeddings::new(&numbers, 3)),
            image: Some(ImageView::new(&pixels, 640, 480, 0, PixelFormat::Gray8).expect("it is of this size")),
            camera_motion: Some(CameraMotion([1.0, 0.0, 0.5, 0.0, 1.0, -0.5])),
            ..frame(&detections)
        };
        tracker.step(&everything).expect("these are good frames");
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
