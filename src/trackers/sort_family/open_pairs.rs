//! The largest sum over the detections and tracks whose pairs do not go without saying: each with each, but only as many
//! of them looked at as it takes to know that no other could matter.

use crate::assignment::{Assignment, Edge, UNMATCHED};

use super::full_association::Extra;
use super::numbering;
use super::valued::Valued;

/// Price of leaving a detection out: more than any pair can be worth, so that the smaller side is assigned as a whole.
const LEFT_OUT: f64 = 1e3;

/// Most pairs looked at besides those that overlap. No scene has that many, but hostile input has, and all its pairs
/// neither fit into memory nor can be looked at in time.
pub const MOST_EXTRA: usize = 1 << 22;

/// Tracks that a detection is offered besides those it overlaps, before all are; in tests so few that they run out.
const CHOICES: usize = if cfg!(test) { 2 } else { 4 };

/// What was looked at of a detection's pairs with tracks that it does not overlap.
#[derive(Clone, Copy)]
struct Choices {
    /// Where they are in the list.
    start: u32,
    end: u32,
    /// What none of the others exceeds.
    rest: f64,
}

/// The search, with buffers that are reused from call to call.
#[derive(Default)]
pub struct OpenPairs {
    /// The detections without partners, and what was looked at of theirs.
    rows: Vec<u32>,
    choices: Vec<Choices>,
    /// The tracks without partners, but for those that stand for any other, and their number among them.
    columns: Vec<u32>,
    number_of: Vec<u32>,
    /// Numbers of those that more is to be known of than the pairs that overlap.
    open: Vec<u32>,
    /// Tracks by ascending number, and what is added for the pair.
    list: Vec<(u32, f64)>,
    /// Pairs looked at so far.
    looked: usize,
    best: Vec<(f64, u32)>,
    edges: Vec<Edge>,
    solver: Assignment,
}

impl OpenPairs {
    /// Finds the partners of the detections that have none among so many `tracks`. `pairs` are those that overlap and whose
    /// members have no partners yet, sorted by detection; detections that are `eager` overlap no track well.
    pub fn solve<B, R, L, P, A>(
        &mut self,
        pairs: &[Valued],
        tracks: usize,
        eager: impl Fn(u32) -> bool,
        extra: &Extra<B, R, L, P, A>,
        partners: &mut [u32],
    ) where
        B: Fn(u32, u32) -> f64,
        R: Fn(u32, u32, f64) -> Option<f64>,
        L: Fn(u32) -> f64,
        P: Fn(u32) -> bool,
        A: Fn(u32, u32) -> bool,
    {
        self.rows.clear();
        self.rows.extend((0..).zip(partners.iter()).filter(|(_, partner)| **partner == UNMATCHED).map(|(row, _)| row));
        let left_out = self.list_columns(pairs, tracks, &extra.is_plain, partners);
        self.list.clear();
        self.looked = 0;
        self.choices.clear();
        for number in 0..self.rows.len() {
            let row = self.rows[number];
            self.choices.push(Choices { start: 0, end: 0, rest: (extra.bound)(row) });
            if eager(row) {
                self.look_further(number, extra, left_out);
            }
        }
        loop {
            self.collect_edges(pairs, left_out);
            self.solver.solve(self.rows.len(), self.columns.len(), &self.edges, left_out);
            // The solution is that of all pairs if the solver's prices leave no pair that was left out a gain, which a
            // detection's own price tells: those of the tracks are never positive.
            let mut is_best = true;
            for number in 0..self.rows.len() {
                if self.solver.row_potential()[number] > -self.choices[number].rest {
                    is_best &= !self.look_further(number, extra, left_out);
                }
            }
            if is_best {
                break;
            }
        }
        for (row, number) in self.rows.iter().zip(self.solver.column_of_row()).filter(|(_, n)| **n != UNMATCHED) {
            partners[*row as usize] = self.columns[*number as usize];
        }
    }

    /// Lists the tracks, and returns the price of leaving a detection out. Where the plain tracks that overlap no detection
    /// would do for all of these, each can have one at a price of 0: they need not be listed.
    fn list_columns(
        &mut self,
        pairs: &[Valued],
        tracks: usize,
        is_plain: &impl Fn(u32) -> bool,
        partners: &[u32],
    ) -> f64 {
        numbering::begin(&mut self.number_of, tracks, partners);
        // Any number will do until they get theirs.
        pairs.iter().for_each(|p| self.number_of[p.column as usize] = 0);
        let enough = numbering::spare(&self.number_of, is_plain) >= self.rows.len();
        self.columns.clear();
        self.open.clear();
        for (column, number) in (0..).zip(&mut self.number_of).filter(|(_, number)| **number != numbering::TAKEN) {
            let stands_for_any = enough && is_plain(column);
            if stands_for_any && *number == UNMATCHED {
                continue;
            }
            *number = self.columns.len() as u32;
            self.columns.push(column);
            if !stands_for_any {
                self.open.push(*number);
            }
        }
        if enough { 0.0 } else { LEFT_OUT }
    }

    /// Looks at a detection's best choices, or, if these were seen, at all open tracks, as far as there is room; false if
    /// there is none. Where it can be left out at no price, only gains are of interest.
    fn look_further<B, R, L, P, A>(&mut self, number: usize, extra: &Extra<B, R, L, P, A>, left_out: f64) -> bool
    where
        B: Fn(u32, u32) -> f64,
        R: Fn(u32, u32, f64) -> Option<f64>,
        A: Fn(u32, u32) -> bool,
    {
        let start = self.list.len();
        self.looked += self.open.len();
        if self.looked > MOST_EXTRA {
            return false;
        }
        let seen = self.choices[number];
        let all = left_out > 0.0 || seen.start < seen.end;
        let (row, columns) = (self.rows[number], &self.columns);
        let column = |number: u32| columns[number as usize];
        let allowed = |c: u32| (extra.allowed)(row, column(c));
        let bonus = |c: u32| (extra.bonus)(row, column(c));
        let rank = |c: u32, limit: f64| (extra.rank)(row, column(c), limit);
        let mut rest = f64::NEG_INFINITY;
        if all {
            let of_use = |c: u32| allowed(c) && (left_out > 0.0 || rank(c, 0.0).is_some());
            self.list.extend(self.open.iter().filter(|c| of_use(**c)).map(|&c| (c, bonus(c))));
        } else {
            self.best.clear();
            // What a newcomer has to beat.
            let mut least = 0.0;
            for &c in &self.open {
                if let Some(rank) = rank(c, least).filter(|_| allowed(c)) {
                    if self.best.len() == CHOICES {
                        self.best.pop();
                    }
                    let at = self.best.partition_point(|(better, _)| *better >= rank);
                    self.best.insert(at, (rank, c));
                    if self.best.len() == CHOICES {
                        least = self.best[CHOICES - 1].0;
                    }
                }
            }
            if self.best.len() == CHOICES {
                rest = bonus(self.best[CHOICES - 1].1);
            }
            self.best.sort_unstable_by_key(|(_, c)| *c);
            self.list.extend(self.best.iter().map(|&(_, c)| (c, bonus(c))));
        }
        self.choices[number] = Choices { start: start as u32, end: self.list.len() as u32, rest };
        true
    }

    /// The pairs that overlap, and those that were looked at.
    fn collect_edges(&mut self, pairs: &[Valued], left_out: f64) {
        self.edges.clear();
        let mut pairs = pairs.iter().peekable();
        for (row, (original, choices)) in (0..).zip(self.rows.iter().zip(&self.choices)) {
            let overlapping = std::iter::from_fn(|| pairs.next_if(|p| p.row == *original));
            let edge = |p: &Valued| Edge { row, column: self.number_of[p.column as usize], cost: -p.value };
            let mut overlapping = overlapping.map(edge).peekable();
            for &(column, bonus) in &self.list[choices.start as usize..choices.end as usize] {
                while let Some(edge) = overlapping.next_if(|e| e.column < column) {
                    self.edges.push(edge);
                }
                match overlapping.next_if(|e| e.column == column) {
                    Some(edge) => self.edges.push(edge),
                    None if -bonus <= left_out => self.edges.push(Edge { row, column, cost: -bonus }),
                    None => (),
                }
            }
            self.edges.extend(overlapping);
        }
    }
}
