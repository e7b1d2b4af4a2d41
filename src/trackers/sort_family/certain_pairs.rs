//! Which pairs belong to *every* largest sum over all pairs, told from the overlapping pairs alone, of which no single one
//! dominates the others.
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

use super::dominant_pairs::CLEAR;
use super::numbering;
use super::valued::Valued;
use crate::assignment::{Assignment, Edge, UNMATCHED};
use crate::buffers::refill;

/// Tests after which nothing is certain. A scene needs three or four.
const MOST_TESTS: usize = 12;

/// Overlapping pairs per row beyond which the search is not worth its while: so little is certain in such a throng.
const MOST_PER_ROW: usize = 16;

/// The search, with buffers that are reused from call to call.
#[derive(Default)]
pub struct CertainPairs {
    solver: Assignment,
    edges: Vec<Edge>,
    /// The pairs with numbers of their own for rows and columns, of which they have few, and whose these are.
    pairs: Vec<Valued>,
    rows: Vec<u32>,
    columns: Vec<u32>,
    number_of_column: Vec<u32>,
    chosen: Vec<u32>,
    column_is_chosen: Vec<bool>,
}

impl CertainPairs {
    /// Gives rows the columns, of so many, that are certain, and leaves in `pairs` those whose members have none; true if
    /// none of these matters, which those from `threshold` on do. `pairs` are sorted by row, and their members have no
    /// partners yet; a pair that is not listed can be worth `bound`, and nothing at all in `plain` columns.
    pub fn take_from(
        &mut self,
        pairs: &mut Vec<Valued>,
        columns: usize,
        bound: f64,
        is_plain: impl Fn(u32) -> bool,
        threshold: f64,
        partners: &mut [u32],
    ) -> bool {
        let matters = |pairs: &[Valued]| pairs.iter().any(|p| p.iou >= threshold);
        if !matters(pairs) || pairs.len() > MOST_PER_ROW * partners.len() {
            return !matters(pairs);
        }
        self.number(pairs, columns, partners);
        let spare = numbering::spare(&self.number_of_column, is_plain);
        let open = partners.iter().filter(|c| **c == UNMATCHED).count();
        let left_out = |chosen: &[u32]| open - chosen.iter().filter(|c| **c != UNMATCHED).count();
        let mut is_done = false;
        // At least the rows that overlap nothing are left out.
        if spare >= open - self.rows.len() {
            self.choose([bound, 2.0 * bound]);
            is_done = spare >= left_out(&self.chosen);
        }
        if !is_done {
            self.choose([bound, 3.0 * bound]);
        }
        for (row, chosen) in self.rows.iter().zip(&self.chosen).filter(|(_, chosen)| **chosen != UNMATCHED) {
            partners[*row as usize] = self.columns[*chosen as usize];
        }
        let is_chosen = |column: u32| self.column_is_chosen[self.number_of_column[column as usize] as usize];
        pairs.retain(|p| partners[p.row as usize] == UNMATCHED && !is_chosen(p.column));
        !matters(pairs)
    }

    /// Numbers the members of the pairs.
    fn number(&mut self, pairs: &[Valued], columns: usize, partners: &[u32]) {
        numbering::begin(&mut self.number_of_column, columns, partners);
        self.pairs.clear();
        self.rows.clear();
        self.columns.clear();
        for p in pairs {
            if self.rows.last() != Some(&p.row) {
                self.rows.push(p.row);
            }
            let number = &mut self.number_of_column[p.column as usize];
            if *number == UNMATCHED {
                *number = self.columns.len() as u32;
                self.columns.push(p.column);
            }
            self.pairs.push(Valued { row: self.rows.len() as u32 - 1, column: *number, ..*p });
        }
    }

    /// Chooses pairs and strikes off until what is left passes the test. `bounds` are what a pair must outweigh one or both
    /// of whose members are chosen.
    fn choose(&mut self, bounds: [f64; 2]) {
        self.edges.clear();
        self.edges.extend(edges(&self.pairs, |p| p.value - bounds[1]));
        let best = self.solver.solve(self.rows.len(), self.columns.len(), &self.edges, 0.0);
        self.chosen.clear();
        self.chosen.extend_from_slice(best);
        let mut tests = 0;
        while !self.test(bounds) {
            tests += 1;
            if tests == MOST_TESTS {
                self.chosen.fill(UNMATCHED);
            }
        }
    }

    /// Whether what was chosen is the only best matching; strikes off what is not in another one that is as good.
    fn test(&mut self, [one, both]: [f64; 2]) -> bool {
        let chosen = &mut self.chosen;
        refill(&mut self.column_is_chosen, self.columns.len(), false);
        for column in chosen.iter().filter(|c| **c != UNMATCHED) {
            self.column_is_chosen[*column as usize] = true;
        }
        let matched = |p: &Valued| (chosen[p.row as usize] != UNMATCHED, self.column_is_chosen[p.column as usize]);
        self.edges.clear();
        self.edges.extend(edges(&self.pairs, |p| match matched(p) {
            _ if chosen[p.row as usize] == p.column => p.value - both - CLEAR,
            (true, true) => p.value - both,
            (false, false) => f64::NEG_INFINITY,
            _ => p.value - one,
        }));
        let best = self.solver.solve(self.rows.len(), self.columns.len(), &self.edges, 0.0);
        let mut differs = false;
        for (chosen, _) in chosen.iter_mut().zip(best).filter(|(chosen, best)| chosen != best) {
            *chosen = UNMATCHED;
            differs = true;
        }
        !differs
    }
}

/// The pairs with a gain.
fn edges(pairs: &[Valued], gain: impl Fn(&Valued) -> f64) -> impl Iterator<Item = Edge> {
    let priced = pairs.iter().map(move |p| (p, gain(p)));
    priced.filter(|(_, gain)| *gain > 0.0).map(|(p, gain)| Edge { row: p.row, column: p.column, cost: -gain })
}
