//! The overlapping pairs of two lists of boxes, with their IoU: where association starts.

use crate::assignment::Edge;
use crate::candidates::OverlapSweep;
use crate::geometry::Rect;

/// How the sides of a box are measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// From edge to edge.
    Continuous,
    /// As the number of pixels from the first to the last, both included: a pixel more.
    Inclusive,
}

/// A pair of overlapping boxes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overlap {
    /// Index in the first list.
    pub row: u32,
    /// Index in the second list.
    pub column: u32,
    /// Intersection over union, in `(0, 1]`.
    pub iou: f64,
}

/// The search, with buffers that are reused from call to call.
#[derive(Clone, Debug, Default)]
pub struct Overlaps {
    sweep: OverlapSweep,
    pairs: Vec<Overlap>,
}

impl Overlaps {
    /// The overlapping pairs, sorted by row, then column. Boxes of a negative or no size overlap nothing.
    pub fn between(
        &mut self,
        extent: Extent,
        rows: impl Iterator<Item = Rect>,
        columns: impl Iterator<Item = Rect>,
    ) -> &[Overlap] {
        let more = if extent == Extent::Inclusive { 1.0 } else { 0.0 };
        let measured = |r: Rect| match (r.width + more, r.height + more) {
            (width, height) if width > 0.0 && height > 0.0 => Rect { width, height, ..r },
            _ => Rect::default(),
        };
        let found = self.sweep.between(rows.map(measured), columns.map(measured));
        self.pairs.clear();
        self.pairs.extend(found.pairs.iter().map(|&(row, column)| Overlap {
            row,
            column,
            iou: found.rows[row as usize].iou(&found.columns[column as usize]),
        }));
        &self.pairs
    }
}

/// Fills `edges` with the pairs that have a cost.
pub fn fill_edges(edges: &mut Vec<Edge>, pairs: &[Overlap], cost: impl Fn(&Overlap) -> Option<f64>) {
    edges.clear();
    edges.extend(pairs.iter().filter_map(|p| Some(Edge { row: p.row, column: p.column, cost: cost(p)? })));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inclusive_boxes_are_a_pixel_wider_and_taller() {
        // 9 x 9 px apart by half a pixel: inclusive 10 x 10 with .5 x 10 in common.
        let (a, b) = (Rect::new(0.0, 0.0, 9.0, 9.0), Rect::new(9.5, 0.0, 9.0, 9.0));
        let mut overlaps = Overlaps::default();
        assert_eq!(overlaps.between(Extent::Continuous, [a].into_iter(), [b].into_iter()), []);
        let found = overlaps.between(Extent::Inclusive, [a].into_iter(), [b].into_iter());
        assert_eq!(found, [Overlap { row: 0, column: 0, iou: 5.0 / 195.0 }]);
    }

    #[test]
    fn boxes_turned_inside_out_overlap_nothing() {
        let (good, bad) = (Rect::new(0.0, 0.0, 9.0, 9.0), Rect::new(9.0, 9.0, -9.0, -9.0));
        let mut overlaps = Overlaps::default();
        assert_eq!(overlaps.between(Extent::Continuous, [good].into_iter(), [bad].into_iter()), []);
    }
}
