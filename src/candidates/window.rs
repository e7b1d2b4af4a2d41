//! Overlapping boxes of not too many: columns are put into bins along x, and each row looks at those in its reach. Rows
//! come in order, so that nothing has to be sorted afterwards, and neither the search for the reach nor a test is a branch.

use crate::buffers::{append, make_room, refill};
use crate::geometry::Rect;

use super::column::Column;
use super::intervals::Intervals;

/// Up to so many pairs are all looked at, without bins.
const ALL: usize = 512;

/// The search, with buffers that are reused from call to call.
#[derive(Clone, Debug, Default)]
pub struct Window {
    columns: Vec<Column>,
    /// For each bin the first column whose left edge is in a later one, ...
    end: Vec<u32>,
    /// ... and the first one that, or one before it, reaches into the bin or beyond.
    start: Vec<u32>,
    found: Vec<u32>,
}

/// Bins for these columns, by their left edges.
fn bins_for(columns: &[Rect]) -> Intervals {
    let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
    for c in columns {
        left = left.min(c.left);
        right = right.max(c.left);
    }
    let count = 2 * columns.len();
    Intervals { from: left, per_pixel: count as f64 / (right - left), last: count - 1 }
}

impl Window {
    /// Adds the `(row, column)` whose boxes share an area, sorted by row, then column; gives up, and returns false, at a row
    /// with more than `most` of them.
    pub fn add_pairs(&mut self, rows: &[Rect], columns: &[Rect], most: usize, pairs: &mut Vec<(u32, u32)>) -> bool {
        if rows.is_empty() || columns.is_empty() {
            return true;
        }
        let bins = (rows.len() * columns.len() > ALL).then(|| bins_for(columns));
        match &bins {
            Some(bins) => self.list_by_bin(columns, bins),
            None => self.list(columns),
        }
        refill(&mut self.found, columns.len() + 1, 0);
        for (row, rect) in (0..).zip(rows).filter(|(_, r)| r.area() > 0.0) {
            let reach = match &bins {
                Some(bins) => self.start[bins.of(rect.left)] as usize..self.end[bins.of(rect.right())] as usize,
                None => 0..self.columns.len(),
            };
            let mut count = 0;
            for c in self.columns.get(reach).unwrap_or_default() {
                // Written in any case, and written over if it was none.
                self.found[count] = c.index;
                count += usize::from(c.overlaps(rect));
            }
            if count > most {
                return false;
            }
            let found = &mut self.found[..count];
            if bins.is_some() {
                found.sort_unstable();
            }
            append(pairs, found.iter().map(|column| (row, *column)));
        }
        true
    }

    fn list(&mut self, columns: &[Rect]) {
        self.columns.clear();
        self.columns.extend((0..).zip(columns).filter(|(_, c)| c.area() > 0.0).map(Column::of));
    }

    /// Lists the columns by the bins of their left edges.
    fn list_by_bin(&mut self, columns: &[Rect], bins: &Intervals) {
        let present = || (0..).zip(columns).filter(|(_, c)| c.area() > 0.0);
        refill(&mut self.end, bins.last + 1, 0);
        present().for_each(|(_, c)| self.end[bins.of(c.left)] += 1);
        let mut total = 0;
        for n in &mut self.end {
            total += std::mem::replace(n, total);
        }
        refill(&mut self.columns, total as usize, Column::default());
        for column in present() {
            let next = &mut self.end[bins.of(column.1.left)];
            self.columns[*next as usize] = Column::of(column);
            *next += 1;
        }
        // Now each bin's number says where it ends.
        self.start.clear();
        make_room(&mut self.start, bins.last + 1);
        let mut reach = f64::NEG_INFINITY;
        for (index, c) in (0..).zip(&self.columns) {
            reach = reach.max(c.right);
            let bins = bins.of(reach) + 1;
            if bins > self.start.len() {
                self.start.resize(bins, index);
            }
        }
        self.start.resize(bins.last + 1, total);
    }
}
