//! Where the files lie: the synthetic sequences and their oracles in the project, those of MOT17 outside of it, because
//! its terms do not allow it in here.

use std::path::{Path, PathBuf};

use super::compare::Report;
use super::golden;
use super::sequence::{Files, SYNTHETIC_LENGTH, Sequence, length_of};
use super::variants::Variant;

/// Names the directory with the measurement data.
pub const SHARED: &str = "GENTRACK2_SHARED";

/// The committed synthetic inputs and oracles.
pub fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/oracles")
}

/// The measurement data, if the environment names it.
pub fn shared() -> Option<PathBuf> {
    std::env::var_os(SHARED).filter(|value| !value.is_empty()).map(PathBuf::from)
}

/// A sequence of the fixtures.
pub fn synthetic(name: &str) -> Result<Sequence, String> {
    let directory = fixtures().join("synthetic");
    let files = Files {
        detections: directory.join(format!("{name}.det.txt")),
        embeddings: directory.join(format!("{name}.f32")),
        camera_motion: Some(directory.join(format!("{name}.gmc.txt"))).filter(|path| path.exists()),
    };
    files.read(SYNTHETIC_LENGTH)
}

/// A sequence of the measurement data.
pub fn mot17(shared: &Path, name: &str) -> Result<Sequence, String> {
    let directory = shared.join("mot17").join(name);
    let files = Files {
        detections: directory.join("det.txt"),
        embeddings: directory.join("embeddings.f32"),
        camera_motion: Some(directory.join("gmc.txt")),
    };
    files.read(length_of(&directory.join("seqinfo.ini"))?)
}

/// How far a variant reproduces its oracle for a sequence of the fixtures.
pub fn reproduce_synthetic(variant: &Variant, name: &str) -> Result<Report, String> {
    reproduce(variant, &synthetic(name)?, &fixtures(), name)
}

/// The same for one of the measurement data.
pub fn reproduce_mot17(variant: &Variant, shared: &Path, name: &str) -> Result<Report, String> {
    reproduce(variant, &mot17(shared, name)?, &shared.join("oracles"), name)
}

fn reproduce(variant: &Variant, sequence: &Sequence, oracles: &Path, name: &str) -> Result<Report, String> {
    let golden = golden::read(&oracles.join(variant.folder).join(format!("{name}.csv")), sequence.frames.len())?;
    Ok(Report::new(&golden, &variant.play(sequence)?))
}
