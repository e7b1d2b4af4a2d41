//! Pairs that outweigh all that their members could have instead: most pairs of most scenes, told without solving anything.
//!
//! Let any pair that does not overlap be worth at most `b` in amount, and let `F` be a best assignment of the whole smaller
//! side without the pair `p` of a row and a column. Put `p` into `F` in place of what these two have there: what is lost is
//! worth no more than the row's best other pair or `b`, and the column's, and whoever they had take each other, worth at
//! least `-b`. So if `p` is worth more than these two and `b`, `F` gains, which it cannot: `p` is part of every best
//! assignment. Its members are taken then, and others may be without alternatives.

use super::valued::Valued;
use crate::assignment::UNMATCHED;
use crate::buffers::refill;

/// By how much a pair must be better than its alternatives: far more than rounding, far less than any overlap.
pub const CLEAR: f64 = 1e-9;

/// Passes over the pairs; later ones find hardly any.
const PASSES: usize = 3;

/// The two largest values of a row's or a column's pairs.
#[derive(Clone, Copy)]
struct Best {
    first: f64,
    second: f64,
}

impl Best {
    fn add(&mut self, value: f64) {
        if value > self.first {
            *self = Self { first: value, second: self.first };
        } else if value > self.second {
            self.second = value;
        }
    }
}

/// The search, with buffers that are reused from call to call.
#[derive(Default)]
pub struct DominantPairs {
    rows: Vec<Best>,
    columns: Vec<Best>,
    is_taken: Vec<bool>,
}

impl DominantPairs {
    /// Gives rows their columns, of so many, where their pair outweighs all others, and leaves in `pairs` those whose members
    /// have none. `bound` is what a pair that is not listed can be worth.
    pub fn take_from(&mut self, pairs: &mut Vec<Valued>, columns: usize, bound: f64, partners: &mut [u32]) {
        // Without a pair that overlaps there is always one that does not.
        let none = Best { first: bound, second: bound };
        refill(&mut self.is_taken, columns, false);
        for _ in 0..PASSES {
            refill(&mut self.rows, partners.len(), none);
            refill(&mut self.columns, columns, none);
            for p in pairs.iter() {
                self.rows[p.row as usize].add(p.value);
                self.columns[p.column as usize].add(p.value);
            }
            let mut is_over = true;
            for p in pairs.iter() {
                let (row, column) = (&self.rows[p.row as usize], &self.columns[p.column as usize]);
                let is_best = p.value >= row.first.max(column.first);
                if is_best && p.value > row.second + column.second + bound + CLEAR {
                    partners[p.row as usize] = p.column;
                    self.is_taken[p.column as usize] = true;
                    is_over = false;
                }
            }
            if is_over {
                break;
            }
            pairs.retain(|p| partners[p.row as usize] == UNMATCHED && !self.is_taken[p.column as usize]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(values: &[(u32, u32, f64)]) -> (Vec<u32>, usize) {
        let mut pairs = values.iter().map(|&(row, column, value)| Valued { row, column, iou: value, value }).collect();
        let mut partners = [UNMATCHED; 3];
        DominantPairs::default().take_from(&mut pairs, 3, 0.1, &mut partners);
        (partners.to_vec(), pairs.len())
    }

    #[test]
    fn a_pair_must_outweigh_what_both_members_could_have_and_a_bad_pair_of_the_others() {
        // Row 0 gives up .2, column 0 .3, and .1 for row 1 with column 1.
        let rivals = |value: f64| found(&[(0, 0, value), (0, 1, 0.2), (1, 0, 0.3)]);
        assert_eq!(rivals(0.61), (vec![0, UNMATCHED, UNMATCHED], 0));
        assert_eq!(rivals(0.59), (vec![UNMATCHED; 3], 3));
        // Alone, it must outweigh pairs that do not overlap.
        assert_eq!(found(&[(2, 1, 0.31)]), (vec![UNMATCHED, UNMATCHED, 1], 0));
        assert_eq!(found(&[(2, 1, 0.29)]), (vec![UNMATCHED; 3], 1));
    }

    #[test]
    fn who_is_taken_is_no_rival_any_more() {
        // Row 1's .5 could lose against .3 and .1 of column 0, if that were not row 0's.
        assert_eq!(found(&[(0, 0, 0.9), (1, 0, 0.3), (1, 1, 0.5)]), (vec![0, 1, UNMATCHED], 0));
    }

    #[test]
    fn equals_dominate_nobody() {
        assert_eq!(found(&[(0, 0, 0.9), (0, 1, 0.9)]), (vec![UNMATCHED; 3], 2));
    }
}
