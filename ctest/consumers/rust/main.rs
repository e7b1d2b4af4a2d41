//! Two people walk past each other; a tracker is saved half-way, and what is loaded goes on as it does.

use gentrack2::{Config, Detection, Error, Frame, Tracker};

fn main() -> Result<(), Error> {
    let mut config = Config::new("bytetrack")?;
    config.set_text("frame_rate", "25")?;
    let mut tracker = Tracker::new(&config)?;
    let mut loaded = None;
    for t in 0..60 {
        let x = 6.0 * f64::from(t);
        let detections =
            [Detection::new(100.0 + x, 100.0, 40.0, 100.0, 0.9), Detection::new(460.0 - x, 115.0, 40.0, 100.0, 0.9)];
        let frame = Frame::new(&detections);
        let output = tracker.step(&frame)?;
        assert_eq!(output.track_of_detection, [1, 2], "frame {t}");
        match &mut loaded {
            None if t == 30 => loaded = Some(Tracker::load(&tracker.save())?),
            None => {}
            Some(copy) => assert_eq!(copy.step(&frame)?.reported, output.reported, "frame {t}"),
        }
    }
    let refused = config.set_text("no_such_parameter", "1").unwrap_err();
    println!("gentrack2 from Rust: walkers 1 and 2, saved and loaded; {refused}");
    Ok(())
}
