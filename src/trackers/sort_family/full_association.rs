//! Association over all pairs, the bad ones dropped afterwards (specifications: SORT section 7, OC-SORT section 8).
//!
//! The optimum is that of the sum over *all* pairs, also those that overlap too little or not at all, with the whole
//! smaller side assigned. Where the value of a pair is its IoU, pairs that do not overlap add nothing, so the best set
//! of overlapping pairs is part of the optimum and the others need not be looked at. Where something is added to the
//! IoU, [`FullAssociation::best_sum`] looks at the pairs that can matter: most follow from the overlaps alone,
//! at once ([`DominantPairs`]) or by solving ([`CertainPairs`]), and only if some do not are those left over compared
//! ([`OpenPairs`]).

use crate::assignment::{Assignment, Edge, UNMATCHED};
use crate::buffers::refill;
use crate::geometry::Rect;
use crate::trackers::overlaps::{Extent, Overlap, Overlaps, fill_edges};

use super::certain_pairs::CertainPairs;
use super::dominant_pairs::DominantPairs;
use super::open_pairs::{MOST_EXTRA, OpenPairs};
use super::valued::Valued;

/// Whether there are too many pairs to look at them all.
pub fn too_many(detections: usize, tracks: usize) -> bool {
    detections.saturating_mul(tracks) > MOST_EXTRA
}

/// What is added to the IoU.
pub struct Extra<B, R, L, P, A> {
    /// The addition, for a detection and a track.
    pub bonus: B,
    /// What it grows with, for a detection over the tracks, and has the sign of, if that exceeds a limit that is not
    /// negative: quicker to tell.
    pub rank: R,
    /// Its largest amount over all tracks, for a detection.
    pub bound: L,
    /// Whether it is 0 for a track and every detection, and every detection is allowed.
    pub is_plain: P,
    /// Whether a detection and a track may be a pair: whether they are of one class.
    pub allowed: A,
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
    /// The pairs that do not go without saying.
    rest: Vec<Valued>,
    dominant: DominantPairs,
    certain: CertainPairs,
    open: OpenPairs,
    best: Vec<u32>,
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
        let best = self.solver.solve(self.partners.len(), self.tracks, &self.edges, 0.0);
        keep_overlapping(&self.pairs, self.threshold, best, &mut self.partners);
    }

    /// Matches by the largest sum of IoU and `bonus`.
    pub fn best_sum<B, R, L, P, A>(&mut self, extra: &Extra<B, R, L, P, A>)
    where
        B: Fn(u32, u32) -> f64,
        R: Fn(u32, u32, f64) -> Option<f64>,
        L: Fn(u32) -> f64,
        P: Fn(u32) -> bool,
        A: Fn(u32, u32) -> bool,
    {
        let Self { rest, best, .. } = self;
        let value = |p: &Overlap| p.iou + (extra.bonus)(p.row, p.column);
        rest.clear();
        rest.extend(self.pairs.iter().map(|p| Valued { row: p.row, column: p.column, iou: p.iou, value: value(p) }));
        let most = (0..self.partners.len() as u32).map(&extra.bound).fold(0.0, f64::max);
        refill(best, self.partners.len(), UNMATCHED);
        self.dominant.take_from(rest, self.tracks, most, best);
        if !self.certain.take_from(rest, self.tracks, most, &extra.is_plain, self.threshold, best) {
            let eager = |row: u32| self.row_hits[row as usize] == 0;
            self.open.solve(rest, self.tracks, eager, extra, best);
        }
        keep_overlapping(&self.pairs, self.threshold, best, &mut self.partners);
    }

    /// For each detection its track or [`UNMATCHED`].
    pub fn partners(&self) -> &[u32] {
        &self.partners
    }
}

/// Drops the pairs that overlap too little.
fn keep_overlapping(pairs: &[Overlap], threshold: f64, best: &[u32], partners: &mut [u32]) {
    for p in pairs.iter().filter(|p| p.iou >= threshold && best[p.row as usize] == p.column) {
        partners[p.row as usize] = p.column;
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
        #![proptest_config(ProptestConfig::with_cases(2000))]

        /// Against the sum over all assignments of the whole smaller side: there is a best one that has exactly these
        /// partners.
        #[test]
        fn the_partners_are_those_of_the_largest_sum_over_all_pairs(
            detections in proptest::collection::vec(0u32..60, 1..6),
            tracks in proptest::collection::vec(0u32..60, 1..8),
            plain in 0u32..256,
            raw in proptest::collection::vec(-0.1f64..0.1, 48),
            hundredths in 1u32..50,
        ) {
            let place = |list: &[u32]| list.iter().map(|x| *x as f64).collect::<Vec<_>>();
            let (detections, tracks) = (place(&detections), place(&tracks));
            let threshold = hundredths as f64 / 100.0;
            let is_plain = |t: u32| plain & (1 << t) != 0;
            let bonus = |d: u32, t: u32| if is_plain(t) { 0.0 } else { raw[8 * d as usize + t as usize] };
            let mut association = FullAssociation::default();
            association.begin(boxes(&detections), boxes(&tracks), threshold, |_, _| true);
            association.best_sum(&Extra { bonus, rank: |d, t, limit| Some(bonus(d, t)).filter(|b| *b > limit), bound: |_| 0.1, is_plain, allowed: |_, _| true });
            let iou = |d: usize, t: usize| {
                Rect::new(detections[d], 0.0, 10.0, 10.0).iou(&Rect::new(tracks[t], 0.0, 10.0, 10.0))
            };
            let value = |d: usize, t: usize| iou(d, t) + bonus(d as u32, t as u32);
            let table = |value: &dyn Fn(usize, usize) -> f64| -> Vec<Vec<f64>> {
                (0..detections.len()).map(|d| (0..tracks.len()).map(|t| value(d, t)).collect()).collect()
            };
            // Partners are worth a fortune, other pairs that would be kept a ruin.
            let partners = association.partners();
            let forced = |d: usize, t: usize| match partners[d] == t as u32 {
                true => value(d, t) + 100.0,
                false if iou(d, t) >= threshold => value(d, t) - 1000.0,
                false => value(d, t),
            };
            let fortune = 100.0 * partners.iter().filter(|p| **p != UNMATCHED).count() as f64;
            let to_leave = detections.len().saturating_sub(tracks.len());
            let most = best(&table(&value), 0, 0, to_leave);
            let found = best(&table(&forced), 0, 0, to_leave) - fortune;
            prop_assert!((found - most).abs() < 1e-9, "{} instead of {}", found, most);
        }
    }
}
