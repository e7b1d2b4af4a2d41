//! MOT17-04, where it is at hand. The data may be measured with but is no part of the project.

use std::path::PathBuf;

use gentrack2::Detection;

use crate::Video;

/// Lowest score that is fed to anybody.
const LEAST_SCORE: f64 = 0.1;
const SIZE: (u32, u32) = (1920, 1080);

fn detections() -> Option<PathBuf> {
    let shared = std::env::var_os("GENTRACK2_SHARED")?;
    Some(PathBuf::from(shared).join("mot17/MOT17-04/det.txt")).filter(|path| path.is_file())
}

/// Whether `GENTRACK2_SHARED` names a directory with MOT17.
pub fn has_mot17() -> bool {
    detections().is_some()
}

/// Its frames with all detections of a score of 0.1 or more; `None` where it is not at hand.
pub fn mot17_04() -> Option<Video> {
    let path = detections()?;
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut frames = Vec::new();
    for line in text.lines() {
        let fields: Vec<f64> = line.split(',').map_while(|field| field.trim().parse().ok()).collect();
        let [number, _, left, top, width, height, score, ..] = fields[..] else { panic!("{}: {line}", path.display()) };
        // Frames count from 1.
        let number = number as usize;
        if frames.len() < number {
            frames.resize(number, Vec::new());
        }
        if score >= LEAST_SCORE {
            frames[number - 1].push(Detection::new(left, top, width, height, score));
        }
    }
    Some(Video { size: SIZE, frames })
}
