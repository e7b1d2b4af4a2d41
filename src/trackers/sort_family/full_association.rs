//! Association over all pairs, the bad ones dropped afterwards (specifications: SORT section 7, OC-SORT section 8).
//!
//! The optimum is that of the sum over *all* pairs, also those that overlap too little or not at all, with the whole
//! smaller side assigned. Where the value of a pair is its IoU, pairs that do not overlap add nothing, so the best set
//! of overlapping pairs is part of the optimum and the others need not be looked at. Where something is added to the
//! IoU, [`FullAssociation::best_sum`] looks at the pairs that can matter.

use crate::assignment::{Assignment, Edge, UNMATCHED, refill};
use crate::geometry::Rect;
use crate::trackers::overlaps::{Extent, Overlap, Overlaps, fill_edges};

/// Price of leaving a detection out: more than any pair can be worth, so that the smaller side is assigned as a whole.
const LEFT_OUT: f64 = 1e3;

/// Most pairs looked at besides those that overlap. No scene has that many, but hostile input has, and all its pairs
/// do not fit into memory.
const MOST_EXTRA: usize = 1 << 22;

/// Whether there are too many pairs to look at them all.
pub fn too_many(detections: usize, tracks: usize) -> bool {
    detections.saturating_mul(tracks) > MOST_EXTRA
}

/// The association of detections (rows) with tracks (columns), with buffers that are reused from call to call.
#[derive(Default)]
pub struct FullAssociation {
    overlaps: Overlaps,
    threshold: f64,
    tracks: usize,
    /// The allowed overlapping pairs, by row.
    pairs: Vec<Overlap>,
    /// For each detection and each track how many IoUs exceed the threshold.
    row_hits: Vec<u32>,
    column_hits: Vec<u32>,
    /// Whether all pairs of a detection are looked at.
    is_whole: Vec<bool>,
    edges: Vec<Edge>,
    solver: Assignment,
    partners: Vec<u32>,
}

impl FullAssociation {
    /// Finds the overlapping pairs that are `allowed`; nobody is matched yet.
    pub fn begin(
        &mut self,
        detections: impl ExactSizeIterator<Item = Rect>,
        tracks: impl ExactSizeIterator<Item = Rect>,
        threshold: f64,
        allowed: impl Fn(u32, u32) -> bool,
    ) {
        let sizes = (detections.len(), tracks.len());
        let pairs = self.overlaps.between(Extent::Continuous, detections, tracks);
        self.pairs.clear();
        self.pairs.extend(pairs.iter().filter(|p| allowed(p.row, p.column)));
        self.count_hits(sizes, threshold);
    }

    /// The same with another measure than the IoU, in `[0, 1]`. All allowed pairs count, or, where there are absurdly
    /// many, the overlapping ones.
    pub fn begin_with(
        &mut self,
        detections: impl ExactSizeIterator<Item = Rect> + Clone,
        tracks: impl ExactSizeIterator<Item = Rect> + Clone,
        value: impl Fn(&Rect, &Rect) -> f64,
        threshold: f64,
        allowed: impl Fn(u32, u32) -> bool,
    ) {
        if too_many(detections.len(), tracks.len()) {
            return self.begin(detections, tracks, threshold, allowed);
        }
        self.pairs.clear();
        for (row, detection) in (0..).zip(detections.clone()) {
            let pairs = (0..).zip(tracks.clone()).filter(|(column, _)| allowed(row, *column));
            self.pairs.extend(pairs.map(|(column, track)| Overlap { row, column, iou: value(&detection, &track) }));
        }
        self.count_hits((detections.len(), tracks.len()), threshold);
    }

    fn count_hits(&mut self, (rows, tracks): (usize, usize), threshold: f64) {
        self.tracks = tracks;
        self.threshold = threshold;
        refill(&mut self.row_hits, rows, 0);
        refill(&mut self.column_hits, tracks, 0);
        refill(&mut self.partners, rows, UNMATCHED);
        for p in self.pairs.iter().filter(|p| p.iou > threshold) {
            self.row_hits[p.row as usize] += 1;
            self.column_hits[p.column as usize] += 1;
        }
    }

    /// Whether some IoU exceeds the threshold.
    pub fn has_hits(&self) -> bool {
        self.row_hits.iter().any(|n| *n > 0)
    }

    /// If no detection and no track has two IoUs above the threshold (and any has one), these are the matches.
    /// Otherwise nothing happens.
    pub fn match_unambiguous(&mut self) -> bool {
        let hits = self.row_hits.iter().chain(&self.column_hits);
        if hits.copied().max() != Some(1) {
            return false;
        }
        for p in self.pairs.iter().filter(|p| p.iou > self.threshold) {
            self.partners[p.row as usize] = p.column;
        }
        true
    }

    /// Matches by the largest sum of IoUs.
    pub fn best_overlap(&mut self) {
        fill_edges(&mut self.edges, &self.pairs, |p| Some(-p.iou));
        self.solver.solve(self.partners.len(), self.tracks, &self.edges, 0.0);
        self.keep_overlapping();
    }

    /// Matches by the largest sum of IoU and `bonus`, whose amount is at most `bound` for all pairs of a detection.
    pub fn best_sum(
        &mut self,
        bonus: impl Fn(u32, u32) -> f64,
        bound: impl Fn(u32) -> f64,
        allowed: impl Fn(u32, u32) -> bool,
    ) {
        self.is_whole.clear();
        self.is_whole.extend(self.row_hits.iter().map(|hits| *hits == 0));
        loop {
            self.collect_edges(&bonus, &allowed);
            self.solver.solve(self.partners.len(), self.tracks, &self.edges, LEFT_OUT);
            // The solution is that of all pairs if the solver's prices leave no pair that was left out a gain, which a
            // detection's own price tells: those of the tracks are never positive.
            let mut is_best = true;
            for (row, price) in self.solver.row_potential().iter().enumerate() {
                let can_gain = !self.is_whole[row] && *price > -bound(row as u32);
                self.is_whole[row] |= can_gain;
                is_best &= !can_gain;
            }
            if is_best {
                break;
            }
        }
        self.keep_overlapping();
    }

    /// For each detection its track or [`UNMATCHED`].
    pub fn partners(&self) -> &[u32] {
        &self.partners
    }

    fn collect_edges(&mut self, bonus: &impl Fn(u32, u32) -> f64, allowed: &impl Fn(u32, u32) -> bool) {
        self.edges.clear();
        let (mut at, mut extra) = (0, 0);
        for row in 0..self.partners.len() as u32 {
            let whole = self.is_whole[row as usize] && extra + self.tracks <= MOST_EXTRA;
            let mut column = 0;
            let mut add_up_to = |end: u32, edges: &mut Vec<Edge>| {
                if whole {
                    edges.extend((column..end).filter(|c| allowed(row, *c)).map(|c| Edge {
                        row,
                        column: c,
                        cost: -bonus(row, c),
                    }));
                }
                column = end + 1;
            };
            while let Some(p) = self.pairs.get(at).filter(|p| p.row == row) {
                add_up_to(p.column, &mut self.edges);
                self.edges.push(Edge { row, column: p.column, cost: -(p.iou + bonus(row, p.column)) });
                at += 1;
            }
            add_up_to(self.tracks as u32, &mut self.edges);
            extra += if whole { self.tracks } else { 0 };
        }
    }

    /// Drops the pairs that overlap too little.
    fn keep_overlapping(&mut self) {
        let columns = self.solver.column_of_row();
        for p in self.pairs.iter().filter(|p| p.iou >= self.threshold) {
            if columns[p.row as usize] == p.column {
                self.partners[p.row as usize] = p.column;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Boxes of 10 x 10 at these places in a row.
    fn boxes(lefts: &[f64]) -> impl ExactSizeIterator<Item = Rect> {
        lefts.iter().map(|left| Rect::new(*left, 0.0, 10.0, 10.0))
    }

    #[test]
    fn the_sum_counts_pairs_that_are_dropped_afterwards() {
        // IoU: d0-t0 at 4 px apart 6/14 = .43, d0-t1 at 5: 1/3, d1-t0 at 6: 4/16 = .25, d1-t1 at 15: 0.
        // .43 + 0 < 1/3 + .25, so d0 goes to t1, and d1 with t0 is dropped at .3: a gate first would match d0 with t0.
        let mut association = FullAssociation::default();
        association.begin(boxes(&[4.0, -6.0]), boxes(&[0.0, 9.0]), 0.3, |_, _| true);
        assert!(!association.match_unambiguous());
        association.best_overlap();
        assert_eq!(association.partners(), [1, UNMATCHED]);
    }

    #[test]
    fn what_is_unambiguous_is_matched_as_it_is() {
        // Above .3 only d0-t0: the optimum of the sum (see above) is not asked.
        let mut association = FullAssociation::default();
        association.begin(boxes(&[4.0, -6.0]), boxes(&[0.0, 9.5]), 0.3, |_, _| true);
        assert!(association.match_unambiguous());
        assert_eq!(association.partners(), [0, UNMATCHED]);
    }

    /// 6 px apart 4 of 16 px are in common, an IoU of 1/4 without rounding.
    #[test]
    fn an_iou_of_exactly_the_threshold_does_not_make_a_pair_ambiguous() {
        // IoU of d0 with t0 9/11, with t1 1/4.
        let mut association = FullAssociation::default();
        association.begin(boxes(&[0.0]), boxes(&[1.0, 6.0]), 0.25, |_, _| true);
        assert!(association.match_unambiguous());
        assert_eq!(association.partners(), [0]);
    }

    #[test]
    fn an_iou_of_exactly_the_threshold_is_no_hit_but_is_not_rejected() {
        let mut association = FullAssociation::default();
        association.begin(boxes(&[0.0]), boxes(&[6.0]), 0.25, |_, _| true);
        assert!(!association.has_hits() && !association.match_unambiguous());
        assert_eq!(association.partners(), [UNMATCHED]);
        association.best_overlap();
        assert_eq!(association.partners(), [0]);
    }

    fn best(values: &[Vec<f64>], row: usize, used: u32, to_leave: usize) -> f64 {
        let Some(of_row) = values.get(row) else { return 0.0 };
        let mut most = f64::NEG_INFINITY;
        if to_leave > 0 {
            most = best(values, row + 1, used, to_leave - 1);
        }
        for (column, value) in of_row.iter().enumerate() {
            if used & (1 << column) == 0 {
                most = most.max(value + best(values, row + 1, used | (1 << column), to_leave));
            }
        }
        most
    }

    proptest! {
        /// Against the sum over all assignments of the whole smaller side.
        #[test]
        fn the_sum_with_a_bonus_is_the_largest_over_all_pairs(
            detections in proptest::collection::vec(0u32..60, 1..6),
            tracks in proptest::collection::vec(0u32..60, 1..6),
            raw in proptest::collection::vec(-0.1f64..0.1, 36),
        ) {
            let place = |list: &[u32]| list.iter().map(|x| *x as f64).collect::<Vec<_>>();
            let (detections, tracks) = (place(&detections), place(&tracks));
            let bonus = |d: u32, t: u32| raw[6 * d as usize + t as usize];
            let mut association = FullAssociation::default();
            association.begin(boxes(&detections), boxes(&tracks), 0.0, |_, _| true);
            association.best_sum(bonus, |_| 0.1, |_, _| true);
            let iou = |d: usize, t: usize| {
                Rect::new(detections[d], 0.0, 10.0, 10.0).iou(&Rect::new(tracks[t], 0.0, 10.0, 10.0))
            };
            let values: Vec<Vec<f64>> = (0..detections.len())
                .map(|d| (0..tracks.len()).map(|t| iou(d, t) + bonus(d as u32, t as u32)).collect())
                .collect();
            let columns = association.solver.column_of_row();
            let matched = columns.iter().enumerate().filter(|(_, c)| **c != UNMATCHED);
            let sum: f64 = matched.clone().map(|(d, t)| values[d][*t as usize]).sum();
            prop_assert_eq!(matched.count(), detections.len().min(tracks.len()));
            let most = best(&values, 0, 0, detections.len().saturating_sub(tracks.len()));
            prop_assert!((sum - most).abs() < 1e-9, "{} instead of {}", sum, most);
        }
    }
}
