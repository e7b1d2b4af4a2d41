//! One round of association: tracks not yet matched with detections not yet taken, by a cost with a limit. Leaving both
//! sides of a pair unmatched costs as much as the limit, so that the optimum is over who is matched, too.

use crate::assignment::{Assignment, Edge, UNMATCHED};
use crate::geometry::Rect;
use crate::trackers::overlaps::{Extent, Overlaps, fill_edges};

/// The round, with buffers that are reused from round to round.
#[derive(Default)]
pub struct Pairing {
    overlaps: Overlaps,
    edges: Vec<Edge>,
    solver: Assignment,
    pairs: Vec<(u32, u32)>,
}

impl Pairing {
    /// Pairs members of `tracks` with members of `others` whose boxes overlap, and strikes both off these lists.
    /// `cost` is asked for `(track, other, iou)`; pairs that cost more than `limit` are refused. Returns the pairs.
    #[allow(clippy::too_many_arguments)]
    pub fn pair(
        &mut self,
        extent: Extent,
        tracks: &mut Vec<u32>,
        track_box: impl Fn(u32) -> Rect,
        others: &mut Vec<u32>,
        other_box: impl Fn(u32) -> Rect,
        limit: f64,
        cost: impl Fn(u32, u32, f64) -> f64,
    ) -> &[(u32, u32)] {
        let rows = tracks.iter().map(|t| track_box(*t));
        let overlapping = self.overlaps.between(extent, rows, others.iter().map(|o| other_box(*o)));
        fill_edges(&mut self.edges, overlapping, |p| {
            let cost = cost(tracks[p.row as usize], others[p.column as usize], p.iou);
            (cost <= limit).then_some(cost)
        });
        self.match_edges(tracks, others, limit)
    }

    /// The same for costs that are known: `edges` between positions in both lists, sorted by row.
    pub fn pair_edges(
        &mut self,
        edges: &[Edge],
        tracks: &mut Vec<u32>,
        others: &mut Vec<u32>,
        limit: f64,
    ) -> &[(u32, u32)] {
        self.edges.clear();
        self.edges.extend_from_slice(edges);
        self.match_edges(tracks, others, limit)
    }

    fn match_edges(&mut self, tracks: &mut Vec<u32>, others: &mut Vec<u32>, limit: f64) -> &[(u32, u32)] {
        let columns = self.solver.solve(tracks.len(), others.len(), &self.edges, limit);
        self.pairs.clear();
        let matched = columns.iter().zip(tracks.iter()).filter(|(column, _)| **column != UNMATCHED);
        self.pairs.extend(matched.map(|(column, track)| (*track, others[*column as usize])));
        strike_off(tracks, self.solver.column_of_row());
        strike_off(others, self.solver.row_of_column());
        &self.pairs
    }
}

/// Leaves those without a partner.
fn strike_off(list: &mut Vec<u32>, partners: &[u32]) {
    let mut partners = partners.iter();
    list.retain(|_| partners.next() == Some(&UNMATCHED));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_are_struck_off_and_the_dear_ones_refused() {
        // Tracks 3, 5 and 7 at 0, 100 and 200; detections 0, 1, 2 at 2, 105 and 300, 10 px wide.
        let at = |left: f64| Rect::new(left, 0.0, 10.0, 10.0);
        let (mut tracks, mut rows) = (vec![3, 5, 7], vec![0, 1, 2]);
        let track_box = |t: u32| at(50.0 * (t as f64 - 3.0));
        let other_box = |r: u32| at([2.0, 105.0, 300.0][r as usize]);
        let mut pairing = Pairing::default();
        let cost = |_, _, iou: f64| 1.0 - iou;
        // IoU 8/12 and 5/15.
        let pairs = pairing.pair(Extent::Continuous, &mut tracks, track_box, &mut rows, other_box, 0.5, cost);
        assert_eq!(pairs, [(3, 0)]);
        assert_eq!((tracks, rows), (vec![5, 7], vec![1, 2]));
    }
}
