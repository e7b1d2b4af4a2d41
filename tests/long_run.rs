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
