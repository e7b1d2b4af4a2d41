//! The largest sum over the detections and tracks whose pairs do not go without saying: each with each, but only as many
//! of them looked at as it takes to know that no other could matter.

use crate::assignment::{Assignment, Edge, UNMATCHED, refill};

use super::full_association::Extra;
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
    /// Tracks with a certain pair.
    is_taken: Vec<bool>,
    /// Tracks that overlap an open detection.
    is_touched: Vec<bool>,
    /// The tracks whose pair is not certain, but for those that stand for any other.
    open: Vec<u32>,
    plain: Vec<u32>,
    choices: Vec<Choices>,
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
        eager: impl Fn(usize) -> bool,
        extra: &Extra<B, R, L, P, A>,
        partners: &mut [u32],
    ) where
        B: Fn(u32, u32) -> f64,
        R: Fn(u32, u32, f64) -> Option<f64>,
        L: Fn(u32) -> f64,
        P: Fn(u32) -> bool,
        A: Fn(u32, u32) -> bool,
    {
        let left_out = self.list_open(pairs, tracks, &extra.is_plain, partners);
        self.list.clear();
        self.looked = 0;
        self.choices.clear();
        for (row, partner) in partners.iter().enumerate() {
            self.choices.push(Choices { start: 0, end: 0, rest: (extra.bound)(row as u32) });
            if *partner == UNMATCHED && eager(row) {
                self.look_further(row, extra, left_out);
            }
        }
        loop {
            self.collect_edges(pairs, partners, left_out);
            self.solver.solve(partners.len(), tracks, &self.edges, left_out);
            // The solution is that of all pairs if the solver's prices leave no pair that was left out a gain, which a
            // detection's own price tells: those of the tracks are never positive.
            let mut is_best = true;
            for (row, _) in partners.iter().enumerate().filter(|(_, partner)| **partner == UNMATCHED) {
                if self.solver.row_potential()[row] > -self.choices[row].rest {
                    is_best &= !self.look_further(row, extra, left_out);
                }
            }
            if is_best {
                break;
            }
        }
        for (partner, column) in partners.iter_mut().zip(self.solver.column_of_row()) {
            *partner = (*partner).min(*column);
        }
    }

    /// Lists the open tracks, and returns the price of leaving a detection out. Where the plain tracks that overlap no
    /// open detection would do for all detections, each can have one at a price of 0: they need not be listed.
    fn list_open(&mut self, pairs: &[Valued], tracks: usize, is_plain: &impl Fn(u32) -> bool, partners: &[u32]) -> f64 {
        refill(&mut self.is_taken, tracks, false);
        partners.iter().filter(|c| **c != UNMATCHED).for_each(|c| self.is_taken[*c as usize] = true);
        refill(&mut self.is_touched, tracks, false);
        pairs.iter().for_each(|p| self.is_touched[p.column as usize] = true);
        let is_open = |c: &u32| !self.is_taken[*c as usize];
        self.plain.clear();
        self.plain.extend((0..tracks as u32).filter(|c| is_open(c) && is_plain(*c)));
        let free = self.plain.iter().filter(|c| !self.is_touched[**c as usize]).count();
        let enough = free >= partners.iter().filter(|c| **c == UNMATCHED).count();
        self.open.clear();
        self.open.extend((0..tracks as u32).filter(|c| is_open(c) && !(enough && is_plain(*c))));
        if enough { 0.0 } else { LEFT_OUT }
    }

    /// Looks at a detection's best choices, or, if these were seen, at all open tracks, as far as there is room; false if
    /// there is none. Where it can be left out at no price, only gains are of interest.
    fn look_further<B, R, L, P, A>(&mut self, row: usize, extra: &Extra<B, R, L, P, A>, left_out: f64) -> bool
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
        let seen = self.choices[row];
        let all = left_out > 0.0 || seen.start < seen.end;
        let detection = row as u32;
        let allowed = |c: u32| (extra.allowed)(detection, c);
        let mut rest = f64::NEG_INFINITY;
        if all {
            let of_use = |c: u32| allowed(c) && (left_out > 0.0 || (extra.rank)(detection, c, 0.0).is_some());
            let of_use = self.open.iter().filter(|c| of_use(**c));
            self.list.extend(of_use.map(|&c| (c, (extra.bonus)(detection, c))));
        } else {
            self.best.clear();
            // What a newcomer has to beat.
            let mut least = 0.0;
            for &column in &self.open {
                if let Some(rank) = (extra.rank)(detection, column, least).filter(|_| allowed(column)) {
                    if self.best.len() == CHOICES {
                        self.best.pop();
                    }
                    let at = self.best.partition_point(|(better, _)| *better >= rank);
                    self.best.insert(at, (rank, column));
                    if self.best.len() == CHOICES {
                        least = self.best[CHOICES - 1].0;
                    }
                }
            }
            if self.best.len() == CHOICES {
                rest = (extra.bonus)(detection, self.best[CHOICES - 1].1);
            }
            self.best.sort_unstable_by_key(|(_, column)| *column);
            self.list.extend(self.best.iter().map(|&(_, c)| (c, (extra.bonus)(detection, c))));
        }
        self.choices[row] = Choices { start: start as u32, end: self.list.len() as u32, rest };
        true
    }

    /// The pairs of the open detections with open tracks: those that overlap, and those that were looked at.
    fn collect_edges(&mut self, pairs: &[Valued], partners: &[u32], left_out: f64) {
        self.edges.clear();
        let mut pairs = pairs.iter().peekable();
        for row in (0..partners.len() as u32).filter(|row| partners[*row as usize] == UNMATCHED) {
            let overlapping = std::iter::from_fn(|| pairs.next_if(|p| p.row == row));
            let mut overlapping = overlapping.map(|p| Edge { row, column: p.column, cost: -p.value }).peekable();
            let choices = self.choices[row as usize];
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
