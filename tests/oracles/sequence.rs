//! What was fed to the reference implementations: detections, embeddings, camera motion.

use std::path::{Path, PathBuf};

use gentrack2::{CameraMotion, Detection};

/// Numbers per embedding.
pub const DIMENSION: usize = 16;
/// Frames of a synthetic sequence, some of the last ones without detections.
pub const SYNTHETIC_LENGTH: usize = 300;

/// Everything there is about one frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Input {
    /// In the order of the file, boxes and scores as they were read.
    pub detections: Vec<Detection>,
    /// One row of `DIMENSION` numbers per detection.
    pub embeddings: Vec<f32>,
    /// From the previous frame to this one.
    pub camera_motion: Option<CameraMotion>,
}

impl Input {
    /// The detections from a score on, that score included, each with its embedding.
    pub fn scored_from(&self, minimum: f64) -> Input {
        let mut kept = Input { camera_motion: self.camera_motion, ..Input::default() };
        for (detection, embedding) in self.detections.iter().zip(self.embeddings.chunks_exact(DIMENSION)) {
            if detection.score >= minimum {
                kept.detections.push(*detection);
                kept.embeddings.extend(embedding);
            }
        }
        kept
    }
}

/// All frames of a sequence, also those without detections.
#[derive(Clone, Debug)]
pub struct Sequence {
    pub frames: Vec<Input>,
}

/// The files of a sequence.
pub struct Files {
    /// MOTChallenge rows: frame, anything, left, top, width, height, score.
    pub detections: PathBuf,
    /// Little-endian 32-bit floats, one embedding per row of `detections`.
    pub embeddings: PathBuf,
    /// Per frame a line of a counter and six numbers, row-major.
    pub camera_motion: Option<PathBuf>,
}

impl Files {
    /// Reads a sequence of so many frames.
    pub fn read(&self, length: usize) -> Result<Sequence, String> {
        let mut frames = vec![Input::default(); length];
        let (rows, embeddings) = (read_text(&self.detections)?, read_floats(&self.embeddings)?);
        if embeddings.len() != rows.lines().count() * DIMENSION {
            return Err(format!("{}: not one embedding per detection", self.embeddings.display()));
        }
        for (number, (line, embedding)) in rows.lines().zip(embeddings.chunks_exact(DIMENSION)).enumerate() {
            let wrong = || format!("{}: line {}: {line}", self.detections.display(), number + 1);
            let (frame, detection) = parse_detection(line).ok_or_else(wrong)?;
            // Frames count from 1.
            let input = frame.checked_sub(1).and_then(|at| frames.get_mut(at)).ok_or_else(wrong)?;
            input.detections.push(detection);
            input.embeddings.extend(embedding);
        }
        if let Some(path) = &self.camera_motion {
            let text = read_text(path)?;
            if text.lines().count() != length {
                return Err(format!("{}: not one line per frame", path.display()));
            }
            for (number, (line, input)) in text.lines().zip(&mut frames).enumerate() {
                let motion = parse_motion(line);
                input.camera_motion =
                    Some(motion.ok_or_else(|| format!("{}: line {}: {line}", path.display(), number + 1))?);
            }
        }
        Ok(Sequence { frames })
    }
}

/// The number of frames that a `seqinfo.ini` states.
pub fn length_of(seqinfo: &Path) -> Result<usize, String> {
    let text = read_text(seqinfo)?;
    let value = text.lines().find_map(|line| line.strip_prefix("seqLength="));
    value.and_then(|v| v.trim().parse().ok()).ok_or_else(|| format!("{}: no seqLength", seqinfo.display()))
}

fn read_text(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))
}

fn read_floats(path: &Path) -> Result<Vec<f32>, String> {
    let bytes = std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
    Ok(bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect())
}

fn parse_detection(line: &str) -> Option<(usize, Detection)> {
    let fields: Vec<&str> = line.split(',').collect();
    let number = |at: usize| fields.get(at)?.parse::<f64>().ok();
    let frame = fields.first()?.parse().ok()?;
    Some((frame, Detection::new(number(2)?, number(3)?, number(4)?, number(5)?, number(6)?)))
}

fn parse_motion(line: &str) -> Option<CameraMotion> {
    let numbers: Vec<f64> = line.split_whitespace().skip(1).map(|f| f.parse().ok()).collect::<Option<_>>()?;
    numbers.try_into().ok().map(CameraMotion)
}
