//! What a caller may hand in is limited, by parameters where that is a matter of taste: a limit's worth is taken, one more is
//! refused by name, and whatever is claimed is refused before memory is taken for it, or read.

// The C ABI is called as C does.
#![allow(unsafe_code)]

mod counting;
mod simulator;

use std::ffi::{CStr, CString};
use std::ptr::null_mut;

use counting::largest_allocation;
use gentrack2::capi::*;
use gentrack2::parameters::{CommonParameters, ParameterSet};
use gentrack2::{Algorithm, Config, Detection, Embeddings, Frame, ImageView, PixelFormat, Tracker};
use simulator::driver::tracker_of;

const LIMITS: [&str; 4] = ["max_detections", "max_tracks", "max_embedding_dimension", "max_image_pixels"];
/// Room for a message; what is claimed below is far more.
const A_LITTLE: usize = 1 << 14;

fn row_of(count: usize) -> Vec<Detection> {
    (0..count).map(|i| Detection::new(100.0 * i as f64, 50.0, 30.0, 60.0, 0.9)).collect()
}

fn refusal(tracker: &mut Tracker, frame: &Frame<'_>) -> String {
    tracker.step(frame).expect_err("it is beyond the limit").to_string()
}

#[test]
fn entrance_areas_are_a_thousand_at_most() {
    let mut config = Config::new("gentrack2").unwrap();
    let areas = |count: usize| vec!["0,0,10,10"; count].join(";");
    config.set_text("entrance_areas", &areas(1000)).unwrap();
    let error = config.set_text("entrance_areas", &areas(1001)).unwrap_err().to_string();
    assert!(error.contains("entrance_areas") && error.contains("1001 areas are more than 1000"), "{error}");
    let rows = vec!["[0.0, 0.0, 10.0, 10.0]"; 1001].join(", ");
    let error = config.load_toml(&format!("entrance_areas = [{rows}]")).unwrap_err().to_string();
    assert!(error.contains("1001 areas are more than 1000"), "{error}");
}

#[test]
fn limits_have_limits() {
    let common = CommonParameters::default();
    for key in LIMITS {
        let spec = &common.specs()[common.find(key).unwrap()];
        let (least, most) = (spec.minimum as i64, spec.maximum as i64);
        let mut config = Config::new("sort").unwrap();
        for good in [least, most] {
            config.set_text(key, &good.to_string()).unwrap();
            Tracker::new(&config).unwrap();
        }
        for bad in [least - 1, most + 1] {
            let error = config.set_text(key, &bad.to_string()).unwrap_err().to_string();
            assert_eq!(error, format!("parameter {key}: {bad} is outside {least}..={most}"));
        }
    }
}

for_every_algorithm! {
    fn as_many_detections_as_the_limit(algorithm: Algorithm) {
        let mut tracker = tracker_of(algorithm, &[("max_detections", "3")]);
        tracker.step(&Frame::new(&row_of(3))).unwrap();
        let error = refusal(&mut tracker, &Frame::new(&row_of(4)));
        assert_eq!(error, "detections: 4 exceeds the limit of 3 (parameter max_detections)");
        tracker.step(&Frame::new(&row_of(3))).unwrap();
    }

    fn as_many_tracks_as_the_limit(algorithm: Algorithm) {
        for detections in [2, 3, 4, 50] {
            let mut tracker = tracker_of(algorithm, &[("max_tracks", "3")]);
            let output = tracker.step(&Frame::new(&row_of(detections))).unwrap();
            let live = output.reported.len() + output.tentative.len() + output.lost.len();
            assert_eq!(live, detections.min(3));
        }
    }

    fn embeddings_as_long_as_the_limit(algorithm: Algorithm) {
        let mut tracker = tracker_of(algorithm, &[("max_embedding_dimension", "5")]);
        let (detections, numbers) = (row_of(2), [0.5; 12]);
        let with = |dimension: usize| Frame {
            embeddings: Some(Embeddings::new(&numbers[..2 * dimension], dimension)),
            ..Frame::new(&detections)
        };
        let error = refusal(&mut tracker, &with(6));
        let expected = "frame.embedding_dimension: 6 exceeds the limit of 5 (parameter max_embedding_dimension)";
        assert_eq!(error, expected);
        tracker.step(&with(5)).unwrap();
        assert_eq!(refusal(&mut tracker, &with(6)), expected);
        tracker.step(&with(5)).unwrap();
    }

    fn images_as_large_as_the_limit(algorithm: Algorithm) {
        let mut tracker = tracker_of(algorithm, &[("max_image_pixels", "4800")]);
        let (detections, pixels) = (row_of(2), [7; 4960]);
        let with = |width: u32, height: u32| Frame {
            image: Some(ImageView::new(&pixels, width, height, 0, PixelFormat::Gray8).unwrap()),
            ..Frame::new(&detections)
        };
        tracker.step(&with(80, 60)).unwrap();
        let expected = "image.width times image.height: 4801 exceeds the limit of 4800 (parameter max_image_pixels)";
        assert_eq!(refusal(&mut tracker, &with(4801, 1)), expected);
        assert!(refusal(&mut tracker, &with(80, 61)).contains(" 4880 exceeds "));
        tracker.step(&with(60, 80)).unwrap();
    }

    fn what_is_only_claimed_is_refused_before_memory_is_taken_or_read(algorithm: Algorithm) {
        let limits = [(c"max_image_pixels", c"76800"), (c"max_tracks", c"1000000"), (c"max_detections", c"1000000")];
        let tracker = c_tracker(algorithm, &limits);
        // SAFETY: all zero is a legal frame and detection.
        let (mut frame, one): (gt2_frame, gt2_detection) = unsafe { (std::mem::zeroed(), std::mem::zeroed()) };
        let (number, pixel) = (0.5f32, 7u8);
        frame.detections = &one;
        frame.detection_count = 1;
        let image = |width, height| gt2_image {
            struct_size: size_of::<gt2_image>(),
            data: &pixel,
            stride: 0,
            width,
            height,
            format: GT2_PIXEL_BGRA32,
            reserved: 0,
        };
        let refused = |frame: &gt2_frame, status: gt2_status, expected: &str| {
            // SAFETY: a live handle; what the frame claims and does not have is beyond limits, so nobody reads it.
            let (got, most) = largest_allocation(|| unsafe { gt2_tracker_step(tracker, frame) });
            assert_eq!(got, status, "{}", message());
            assert!(message().contains(expected), "{}", message());
            assert!(most < A_LITTLE, "{most} bytes for what was refused: {}", message());
        };
        for count in [1_000_001, usize::MAX / size_of::<gt2_detection>(), usize::MAX] {
            refused(&gt2_frame { detection_count: count, ..frame }, GT2_ERR_LIMIT, "parameter max_detections");
        }
        for dimension in [16_385, usize::MAX / 3, usize::MAX] {
            let claim = gt2_frame { embeddings: &number, embedding_dimension: dimension, ..frame };
            refused(&claim, GT2_ERR_LIMIT, "parameter max_embedding_dimension");
        }
        for (width, height) in [(320, 241), (76_801 / 2, 3), (65_535, 65_535)] {
            refused(&gt2_frame { image: &image(width, height), ..frame }, GT2_ERR_LIMIT, "parameter max_image_pixels");
        }
        for side in [65_536, u32::MAX] {
            refused(&gt2_frame { image: &image(side, 1), ..frame }, GT2_ERR_IMAGE, "image.width: ");
            refused(&gt2_frame { image: &image(1, side), ..frame }, GT2_ERR_IMAGE, "image.height: ");
        }
        // SAFETY: a live handle, not used again.
        unsafe { gt2_tracker_free(tracker) };
    }
}

/// Lengths in a snapshot are believed no further than its bytes reach.
#[cfg(feature = "snapshot")]
#[test]
fn what_a_forged_snapshot_claims_takes_no_memory() {
    // What serde reserves at once, at most, before it has seen the elements.
    const CAUTIOUS: usize = 1 << 20;
    for &algorithm in Algorithm::ALL {
        let mut tracker = tracker_of(algorithm, &[]);
        let detections = row_of(3);
        let numbers = [0.5; 6];
        for _ in 0..4 {
            let embeddings = Some(Embeddings::new(&numbers, 2));
            tracker.step(&Frame { embeddings, ..Frame::new(&detections) }).unwrap();
        }
        let good = tracker.save();
        let (mut refused, end) = (0, good.len() - 4);
        for at in 20..end - 5 {
            let mut forged = good.clone();
            // A variable-length integer of 2^35 - 1: of bytes it would be 32 GiB.
            forged[at..at + 5].copy_from_slice(&[0xff, 0xff, 0xff, 0xff, 0x7f]);
            let checksum = crc32fast::hash(&forged[..end]);
            forged[end..].copy_from_slice(&checksum.to_le_bytes());
            let (loaded, most) = largest_allocation(|| Tracker::load(&forged).map(drop));
            refused += usize::from(loaded.is_err());
            assert!(most <= CAUTIOUS, "{}, byte {at}: {most} bytes at once", algorithm.name());
        }
        assert!(refused > 100, "{}: {refused} of {} refused", algorithm.name(), good.len());
    }
}

fn c_tracker(algorithm: Algorithm, settings: &[(&CStr, &CStr)]) -> *mut gt2_tracker {
    let name = CString::new(algorithm.name()).unwrap();
    let (mut config, mut tracker) = (null_mut(), null_mut());
    // SAFETY: live texts and outputs.
    unsafe {
        assert_eq!(gt2_config_new(name.as_ptr(), &mut config), GT2_OK);
        for (key, value) in settings {
            assert_eq!(gt2_config_set(config, key.as_ptr(), value.as_ptr()), GT2_OK);
        }
        assert_eq!(gt2_tracker_new(config, &mut tracker), GT2_OK);
        gt2_config_free(config);
    }
    tracker
}

fn message() -> String {
    // SAFETY: the text is valid until the next failing call.
    unsafe { CStr::from_ptr(gt2_last_error_message()) }.to_str().unwrap().to_string()
}
