//! Linear assignment on a sparse, gated, rectangular problem.
//!
//! A row left without a column costs exactly the limit, so the optimum is over matched *and* unmatched rows: the
//! solution minimises the sum of `cost - limit` over its pairs. Shortest augmenting paths with potentials
//! (Kuhn-Munkres, in the Jonker-Volgenant form) explore only the neighbourhood of each row, so well separated
//! objects cost next to nothing however many there are.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use crate::buffers::refill;
use crate::faults::{self, Stage};

/// A pair that may be matched, and its price.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// Row index.
    pub row: u32,
    /// Column index.
    pub column: u32,
    /// Finite cost, of any sign.
    pub cost: f64,
}

/// What an index without a partner is matched to.
pub const UNMATCHED: u32 = u32::MAX;

/// The solver, with buffers that are reused from call to call.
#[derive(Clone, Debug, Default)]
pub struct Assignment {
    column_of_row: Vec<u32>,
    row_of_column: Vec<u32>,
    first_edge: Vec<u32>,
    row_potential: Vec<f64>,
    column_potential: Vec<f64>,
    distance: Vec<f64>,
    // The row from which each column was reached best.
    parent: Vec<u32>,
    // Columns reached and columns finished in the current search, and whether each column is finished.
    reached: Vec<u32>,
    finished: Vec<u32>,
    is_finished: Vec<bool>,
    heap: BinaryHeap<Reverse<Candidate>>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Candidate {
    distance: f64,
    column: u32,
}

impl Eq for Candidate {}

impl Ord for Candidate {
    // Equal distances are settled by the column's index: the result never depends on the heap's inner order.
    fn cmp(&self, other: &Self) -> Ordering {
        self.distance.total_cmp(&other.distance).then(self.column.cmp(&other.column))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Assignment {
    /// Solves for `rows` rows and `columns` columns; pairs that `edges` does not list, or that cost more than
    /// `limit`, are inadmissible. `edges` must be sorted by row. Returns for each row its column or [`UNMATCHED`].
    pub fn solve(&mut self, rows: usize, columns: usize, edges: &[Edge], limit: f64) -> &[u32] {
        faults::point(Stage::Assignment);
        debug_assert!(edges.is_sorted_by_key(|e| e.row));
        self.prepare(rows, columns, edges);
        for row in 0..rows as u32 {
            if !self.augment_at_once(row, edges, limit) {
                self.augment(row, edges, limit);
            }
        }
        &self.column_of_row
    }

    /// For each row of the last problem its column or [`UNMATCHED`].
    pub fn column_of_row(&self) -> &[u32] {
        &self.column_of_row
    }

    /// For each row of the last problem its price: with the columns', which are never positive, it adds up to at most
    /// the cost of each pair, exactly for the pairs matched.
    pub fn row_potential(&self) -> &[f64] {
        &self.row_potential
    }

    /// For each column of the last problem its row or [`UNMATCHED`].
    pub fn row_of_column(&self) -> &[u32] {
        &self.row_of_column
    }

    fn prepare(&mut self, rows: usize, columns: usize, edges: &[Edge]) {
        refill(&mut self.column_of_row, rows, UNMATCHED);
        refill(&mut self.row_of_column, columns, UNMATCHED);
        refill(&mut self.row_potential, rows, 0.0);
        refill(&mut self.column_potential, columns, 0.0);
        refill(&mut self.distance, columns, f64::INFINITY);
        refill(&mut self.parent, columns, UNMATCHED);
        refill(&mut self.is_finished, columns, false);
        refill(&mut self.first_edge, rows + 1, 0);
        for edge in edges {
            self.first_edge[edge.row as usize + 1] += 1;
        }
        for row in 0..rows {
            self.first_edge[row + 1] += self.first_edge[row];
        }
    }

    /// Does what `augment` does where it would not get farther than the row's nearest column: that is free, or so far
    /// that the row is left out. So it is with most rows, and nothing has to be set up for it.
    fn augment_at_once(&mut self, source: u32, edges: &[Edge], limit: f64) -> bool {
        let row = source as usize;
        let mut nearest = Candidate { distance: f64::INFINITY, column: UNMATCHED };
        for edge in &edges[self.first_edge[row] as usize..self.first_edge[row + 1] as usize] {
            // A cost of -0 ranks as 0, as it does in `relax`.
            let distance = 0.0 + edge.cost - self.column_potential[edge.column as usize];
            let candidate = Candidate { distance, column: edge.column };
            if edge.cost <= limit && candidate < nearest {
                nearest = candidate;
            }
        }
        if nearest.distance < limit {
            let column = nearest.column as usize;
            if self.row_of_column[column] != UNMATCHED {
                return false;
            }
            self.row_of_column[column] = source;
            self.column_of_row[row] = nearest.column;
            self.row_potential[row] = nearest.distance;
        } else {
            self.row_potential[row] = limit;
        }
        true
    }

    /// Brings one more row into the solution along the shortest augmenting path. The path ends in a free column, or
    /// in a row that gives up its place because leaving it out at the limit is cheaper.
    fn augment(&mut self, source: u32, edges: &[Edge], limit: f64) {
        self.relax(source, 0.0, edges, limit);
        let mut give_up = (limit, source);
        let (end, reached_end) = loop {
            let next = self.pop_nearest();
            let Some(Candidate { distance, column }) = next.filter(|n| n.distance < give_up.0) else {
                break (give_up.0, End::Row(give_up.1));
            };
            let row = self.row_of_column[column as usize];
            if row == UNMATCHED {
                break (distance, End::Column(column));
            }
            self.finished.push(column);
            self.is_finished[column as usize] = true;
            let leave = distance + limit - self.row_potential[row as usize];
            if leave < give_up.0 {
                give_up = (leave, row);
            }
            self.relax(row, distance, edges, limit);
        };
        self.update_potentials(source, end);
        self.flip_path(source, reached_end);
        self.forget_search();
    }

    fn relax(&mut self, row: u32, base: f64, edges: &[Edge], limit: f64) {
        let range = self.first_edge[row as usize] as usize..self.first_edge[row as usize + 1] as usize;
        for edge in &edges[range] {
            let column = edge.column as usize;
            // A finished column is never reached again, not even where rounding makes a way of length 0 look shorter:
            // the parents must not form a ring. (The row's own column is finished.)
            if edge.cost > limit || self.is_finished[column] {
                continue;
            }
            let distance = base + edge.cost - self.row_potential[row as usize] - self.column_potential[column];
            if distance < self.distance[column] {
                if self.distance[column] == f64::INFINITY {
                    self.reached.push(edge.column);
                }
                self.distance[column] = distance;
                self.parent[column] = row;
                self.heap.push(Reverse(Candidate { distance, column: edge.column }));
            }
        }
    }

    fn pop_nearest(&mut self) -> Option<Candidate> {
        while let Some(Reverse(candidate)) = self.heap.pop() {
            // A column whose distance was lowered after it was pushed stands in the heap twice.
            if candidate.distance == self.distance[candidate.column as usize] {
                return Some(candidate);
            }
        }
        None
    }

    fn update_potentials(&mut self, source: u32, end: f64) {
        self.row_potential[source as usize] += end;
        for &column in &self.finished {
            let slack = end - self.distance[column as usize];
            self.column_potential[column as usize] -= slack;
            self.row_potential[self.row_of_column[column as usize] as usize] += slack;
        }
    }

    fn flip_path(&mut self, source: u32, end: End) {
        let mut column = match end {
            End::Column(column) => column,
            // The row that gives up frees its column; a source that gives up never had one.
            End::Row(row) => std::mem::replace(&mut self.column_of_row[row as usize], UNMATCHED),
        };
        while column != UNMATCHED {
            let row = self.parent[column as usize];
            self.row_of_column[column as usize] = row;
            let previous = std::mem::replace(&mut self.column_of_row[row as usize], column);
            if row == source {
                break;
            }
            column = previous;
        }
    }

    fn forget_search(&mut self) {
        for column in self.reached.drain(..) {
            self.distance[column as usize] = f64::INFINITY;
            self.parent[column as usize] = UNMATCHED;
            self.is_finished[column as usize] = false;
        }
        self.finished.clear();
        self.heap.clear();
    }
}

enum End {
    Column(u32),
    Row(u32),
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn edges_of(matrix: &[Vec<f64>]) -> Vec<Edge> {
        let mut edges = Vec::new();
        for (row, costs) in matrix.iter().enumerate() {
            for (column, &cost) in costs.iter().enumerate() {
                if cost.is_finite() {
                    edges.push(Edge { row: row as u32, column: column as u32, cost });
                }
            }
        }
        edges
    }

    fn total(matrix: &[Vec<f64>], assignment: &[u32], limit: f64) -> f64 {
        let cost = |(row, &column): (usize, &u32)| match column {
            UNMATCHED => limit,
            column => matrix[row][column as usize],
        };
        assignment.iter().enumerate().map(cost).sum()
    }

    /// Tries every assignment.
    fn best(matrix: &[Vec<f64>], row: usize, used: u32, limit: f64) -> f64 {
        if row == matrix.len() {
            return 0.0;
        }
        let mut lowest = limit + best(matrix, row + 1, used, limit);
        for (column, &cost) in matrix[row].iter().enumerate() {
            if used & (1 << column) == 0 && cost <= limit {
                lowest = lowest.min(cost + best(matrix, row + 1, used | (1 << column), limit));
            }
        }
        lowest
    }

    #[test]
    fn the_greedy_choice_is_not_taken_when_it_costs_more() {
        // Greedy: (0,0) = 1 then (1,1) = 10, together 11. Optimal: (0,1) = 2 and (1,0) = 3, together 5.
        let matrix = vec![vec![1.0, 2.0], vec![3.0, 10.0]];
        assert_eq!(Assignment::default().solve(2, 2, &edges_of(&matrix), 20.0), [1, 0]);
    }

    #[test]
    fn leaving_a_row_out_costs_the_limit() {
        // Both rows: .1 + .55 = .65. Row 0 alone at .1 and row 1 left out at .3 is .4 and therefore better, although
        // it matches less.
        let matrix = vec![vec![0.1, 0.28], vec![0.05, f64::INFINITY]];
        // (0,1) + (1,0) = .33 beats (0,0) + out = .4 and out + (1,0) = .35.
        assert_eq!(Assignment::default().solve(2, 2, &edges_of(&matrix), 0.3), [1, 0]);
        // With the limit at .2 the .28 is inadmissible: out + (1,0) = .25 beats (0,0) + out = .3.
        assert_eq!(Assignment::default().solve(2, 2, &edges_of(&matrix), 0.2), [UNMATCHED, 0]);
    }

    #[test]
    fn empty_sides_are_normal() {
        let mut solver = Assignment::default();
        assert_eq!(solver.solve(0, 5, &[], 1.0), [0u32; 0]);
        assert_eq!(solver.row_of_column(), [UNMATCHED; 5]);
        assert_eq!(solver.solve(3, 0, &[], 1.0), [UNMATCHED; 3]);
    }

    /// Solves and compares with exhaustive search.
    fn check(solver: &mut Assignment, matrix: &[Vec<f64>], limit: f64) -> Result<(), TestCaseError> {
        let columns = matrix.first().map_or(0, Vec::len);
        let assignment = solver.solve(matrix.len(), columns, &edges_of(matrix), limit).to_vec();
        for (row, &column) in assignment.iter().enumerate().filter(|(_, c)| **c != UNMATCHED) {
            prop_assert!(matrix[row][column as usize] <= limit);
            prop_assert_eq!(solver.row_of_column()[column as usize], row as u32);
        }
        let matched = assignment.iter().filter(|c| **c != UNMATCHED).count();
        prop_assert_eq!(solver.row_of_column().iter().filter(|r| **r != UNMATCHED).count(), matched);
        let (found, lowest) = (total(matrix, &assignment, limit), best(matrix, 0, 0, limit));
        prop_assert!((found - lowest).abs() < 1e-9, "{} instead of {}", found, lowest);
        Ok(())
    }

    proptest! {
        #[test]
        fn matches_exhaustive_search(
            rows in 0usize..6,
            columns in 0usize..6,
            limit in -0.5f64..1.0,
            raw in proptest::collection::vec(prop_oneof![3 => -1.0f64..1.0, 1 => Just(f64::INFINITY)], 36),
        ) {
            let matrix: Vec<Vec<f64>> = (0..rows).map(|r| raw[r * 6..r * 6 + columns].to_vec()).collect();
            let mut solver = Assignment::default();
            // A first problem leaves its traces in the buffers; the second must not see them.
            solver.solve(2, 2, &edges_of(&[vec![0.1, 0.2], vec![0.2, 0.1]]), 1.0);
            check(&mut solver, &matrix, limit)?;
        }

        /// The same object reported twice, or two tracks at one place: equal columns, equal rows, sums that rounding
        /// makes a little less than equal.
        #[test]
        fn ties_do_not_lead_it_in_circles(
            size in 1usize..6,
            hundredths in proptest::collection::vec(1u32..31, 36),
            equal_columns in any::<bool>(),
        ) {
            let cost = |row: usize, column: usize| {
                let at = if equal_columns { 6 * row } else { column };
                hundredths[at + (row * column) % 2] as f64 / 100.0
            };
            let matrix: Vec<Vec<f64>> =
                (0..size).map(|row| (0..size).map(|column| cost(row, column)).collect()).collect();
            check(&mut Assignment::default(), &matrix, 0.3)?;
        }
    }

    #[test]
    fn three_equal_columns_are_shared_out() {
        // Rounding makes a finished column look nearer here; once this ran for ever.
        let matrix = [vec![0.27; 3], vec![0.21; 3], vec![0.05; 3]];
        let mut columns = Assignment::default().solve(3, 3, &edges_of(&matrix), 0.3).to_vec();
        columns.sort_unstable();
        assert_eq!(columns, [0, 1, 2]);
    }
}
