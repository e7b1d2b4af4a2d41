//! Which pairs belong to *every* largest sum over all pairs, told from the overlapping pairs alone.
//!
//! Let a pair that overlaps have the value `v`, and any other pair one of at most `b` in amount. Let `M` be a matching of
//! overlapping pairs, `F` a best assignment of the whole smaller side, and `D` a component of the symmetric difference of
//! `M` and the overlapping pairs in `F`, with at least one pair of `M`. Put `M`'s pairs of `D` into `F` in place of `F`'s
//! own: whoever of `D`'s members was elsewhere leaves a pair worth at most `b`, and whoever is left over takes another,
//! worth at least `-b`, so that the smaller side stays whole. Where there are spare columns, worth 0 with every row and at
//! least as many as rows that `M` leaves out, who is left over takes one of these. Counting them, `F` gains if the pairs of
//! `M` are worth more than those of `F` with these values:
//!
//! | pair | value | with spare columns |
//! |---|---|---|
//! | of `M` | `v - 3b` | `v - 2b` |
//! | another one, both of whose members `M` matches | `v - 3b` | `v - 2b` |
//! | one of whose members `M` matches | `v - b` | `v - b` |
//!
//! `F` is best and cannot gain. So where `M` is the only best matching by these values, it is part of every `F`. That is
//! tested by solving once more with the pairs of `M` made a trifle worse; what comes out otherwise is struck off `M`, and
//! the rest is tested again. What remains are pairs neither of whose members `M` matches; they are no concern where they
//! are dropped for overlapping too little anyway.

use crate::assignment::{Assignment, Edge, UNMATCHED, refill};
use crate::trackers::overlaps::Overlap;

/// By how much pairs must be better than their alternatives: far more than rounding, far less than any overlap.
const CLEAR: f64 = 1e-9;

/// Tests after which nothing is certain. A scene needs three or four.
const MOST_TESTS: usize = 12;

/// Overlapping pairs per row beyond which the search is not worth its while: so little is certain in such a throng.
const MOST_PER_ROW: usize = 16;

/// The search, with buffers that are reused from call to call.
#[derive(Default)]
pub struct CertainPairs {
    solver: Assignment,
    edges: Vec<Edge>,
    column_is_chosen: Vec<bool>,
}

impl CertainPairs {
    /// Finds for each row its certain column, or [`UNMATCHED`]; true if no pair that matters is open. `pairs` are sorted by
    /// row, `values` are theirs, and those from `threshold` on matter. So many columns of `sizes` are `spare`.
    #[allow(clippy::too_many_arguments)]
    pub fn find(
        &mut self,
        sizes: (usize, usize),
        pairs: &[Overlap],
        values: &[f64],
        bound: f64,
        spare: usize,
        threshold: f64,
        certain: &mut Vec<u32>,
    ) -> bool {
        if pairs.len() > MOST_PER_ROW * sizes.0 {
            refill(certain, sizes.0, UNMATCHED);
            return false;
        }
        let left_out = |certain: &[u32]| certain.iter().filter(|c| **c == UNMATCHED).count();
        // At least the rows that overlap nothing are left out.
        let with_pairs = pairs.chunk_by(|a, b| a.row == b.row).count();
        let mut is_done = false;
        if spare >= sizes.0 - with_pairs {
            self.choose(sizes, pairs, values, [bound, 2.0 * bound], certain);
            is_done = spare >= left_out(certain);
        }
        if !is_done {
            self.choose(sizes, pairs, values, [bound, 3.0 * bound], certain);
        }
        let is_open = |p: &Overlap| certain[p.row as usize] == UNMATCHED && !self.column_is_chosen[p.column as usize];
        !pairs.iter().any(|p| p.iou >= threshold && is_open(p))
    }

    /// Chooses pairs and strikes off until what is left passes the test. `bounds` are what a pair must outweigh one or both
    /// of whose members are chosen.
    fn choose(
        &mut self,
        sizes: (usize, usize),
        pairs: &[Overlap],
        values: &[f64],
        bounds: [f64; 2],
        chosen: &mut Vec<u32>,
    ) {
        self.edges.clear();
        self.edges.extend(edges(pairs, values, |_, v| v - bounds[1]));
        chosen.clear();
        chosen.extend_from_slice(self.solver.solve(sizes.0, sizes.1, &self.edges, 0.0));
        let mut tests = 0;
        while !self.test(sizes, pairs, values, bounds, chosen) {
            tests += 1;
            if tests == MOST_TESTS {
                refill(chosen, sizes.0, UNMATCHED);
            }
        }
    }

    /// Whether what was chosen is the only best matching; strikes off what is not in another one that is as good.
    fn test(
        &mut self,
        (rows, columns): (usize, usize),
        pairs: &[Overlap],
        values: &[f64],
        [one, both]: [f64; 2],
        chosen: &mut [u32],
    ) -> bool {
        refill(&mut self.column_is_chosen, columns, false);
        for column in chosen.iter().filter(|c| **c != UNMATCHED) {
            self.column_is_chosen[*column as usize] = true;
        }
        let matched = |p: &Overlap| (chosen[p.row as usize] != UNMATCHED, self.column_is_chosen[p.column as usize]);
        self.edges.clear();
        self.edges.extend(edges(pairs, values, |p, v| match matched(p) {
            _ if chosen[p.row as usize] == p.column => v - both - CLEAR,
            (true, true) => v - both,
            (false, false) => f64::NEG_INFINITY,
            _ => v - one,
        }));
        let best = self.solver.solve(rows, columns, &self.edges, 0.0);
        let differs = best != chosen;
        for (chosen, _) in chosen.iter_mut().zip(best).filter(|(chosen, best)| chosen != best) {
            *chosen = UNMATCHED;
        }
        !differs
    }
}

/// The pairs with a gain.
fn edges(pairs: &[Overlap], values: &[f64], gain: impl Fn(&Overlap, f64) -> f64) -> impl Iterator<Item = Edge> {
    let priced = pairs.iter().zip(values).map(move |(p, v)| (p, gain(p, *v)));
    priced.filter(|(_, gain)| *gain > 0.0).map(|(p, gain)| Edge { row: p.row, column: p.column, cost: -gain })
}
