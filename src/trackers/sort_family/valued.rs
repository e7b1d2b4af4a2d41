//! An overlapping pair and what it is worth.

/// A detection (row) and a track (column) that overlap.
#[derive(Clone, Copy, Debug)]
pub struct Valued {
    /// Index of the detection.
    pub row: u32,
    /// Index of the track.
    pub column: u32,
    /// Intersection over union.
    pub iou: f64,
    /// The IoU with what is added to it.
    pub value: f64,
}
