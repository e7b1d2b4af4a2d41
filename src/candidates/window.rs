//! Overlapping boxes of not too many: columns are sorted along x, and each row looks at those in its reach. Rows come in
//! order, so that nothing has to be sorted afterwards, and no test is a branch.

use super::ordered;
use crate::geometry::Rect;

/// Up to so many pairs are all looked at, without sorting.
const ALL: usize = 512;

/// The search, with buffers that are reused from call to call.
#[derive(Clone, Debug, Default)]
pub struct Window {
    order: Vec<(i64, u32)>,
    columns: Vec<Column>,
    found: Vec<u32>,
}

/// A column's box.
#[derive(Clone, Copy, Debug)]
struct Column {
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
    index: u32,
    /// The farthest right edge up to this column.
    reach: f64,
}

impl Window {
    /// Adds the `(row, column)` whose boxes share an area, sorted by row, then column.
    pub fn add_pairs(&mut self, rows: &[Rect], columns: &[Rect], pairs: &mut Vec<(u32, u32)>) {
        let is_sorted = rows.len() * columns.len() > ALL;
        self.list(columns, is_sorted);
        for (row, rect) in (0..).zip(rows).filter(|(_, r)| r.area() > 0.0) {
            let (left, right, top, bottom) = (rect.left, rect.right(), rect.top, rect.bottom());
            let mut columns = &self.columns[..];
            if is_sorted {
                columns = &columns[columns.partition_point(|c| c.reach <= left)..];
                columns = &columns[..columns.partition_point(|c| c.left < right)];
            }
            self.found.resize(self.found.len().max(columns.len()), 0);
            let mut count = 0;
            for c in columns {
                let overlaps = (c.right > left) & (c.left < right) & (c.top < bottom) & (top < c.bottom);
                // Written in any case, and written over if it was none.
                self.found[count] = c.index;
                count += usize::from(overlaps);
            }
            let found = &mut self.found[..count];
            if is_sorted {
                found.sort_unstable();
            }
            pairs.extend(found.iter().map(|column| (row, *column)));
        }
    }

    fn list(&mut self, columns: &[Rect], is_sorted: bool) {
        self.order.clear();
        let present = (0..).zip(columns).filter(|(_, c)| c.area() > 0.0);
        self.order.extend(present.map(|(index, c)| (ordered(c.left), index)));
        if is_sorted {
            self.order.sort_unstable();
        }
        self.columns.clear();
        let mut reach = f64::NEG_INFINITY;
        self.columns.extend(self.order.iter().map(|&(_, index)| {
            let c = &columns[index as usize];
            reach = reach.max(c.right());
            Column { left: c.left, right: c.right(), top: c.top, bottom: c.bottom(), index, reach }
        }));
    }
}
