//! Which boxes of two lists overlap, found by a sweep along x instead of by trying all pairs.

use crate::geometry::Rect;

/// The sweep, with buffers that are reused from call to call.
#[derive(Clone, Debug, Default)]
pub struct OverlapSweep {
    order: Vec<Entry>,
    active: [Vec<u32>; 2],
    pairs: Vec<(u32, u32)>,
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    left: f64,
    list: u8,
    index: u32,
}

impl OverlapSweep {
    /// All `(row, column)` whose boxes share an area, sorted by row, then column.
    pub fn pairs(&mut self, rows: &[Rect], columns: &[Rect]) -> &[(u32, u32)] {
        self.pairs.clear();
        self.fill_order(rows, columns);
        let lists = [rows, columns];
        for entry in &self.order {
            let (own, other) = (entry.list as usize, 1 - entry.list as usize);
            let rect = &lists[own][entry.index as usize];
            let mut kept = 0;
            for k in 0..self.active[other].len() {
                let candidate = self.active[other][k];
                let box_ = &lists[other][candidate as usize];
                if box_.right() <= rect.left {
                    continue;
                }
                self.active[other][kept] = candidate;
                kept += 1;
                if box_.top < rect.bottom() && rect.top < box_.bottom() {
                    self.pairs.push(if own == 0 { (entry.index, candidate) } else { (candidate, entry.index) });
                }
            }
            self.active[other].truncate(kept);
            self.active[own].push(entry.index);
        }
        self.pairs.sort_unstable();
        &self.pairs
    }

    fn fill_order(&mut self, rows: &[Rect], columns: &[Rect]) {
        self.order.clear();
        self.active.iter_mut().for_each(Vec::clear);
        for (list, rects) in [rows, columns].into_iter().enumerate() {
            let entries = rects.iter().enumerate().filter(|(_, r)| r.area() > 0.0);
            self.order.extend(entries.map(|(index, r)| Entry { left: r.left, list: list as u8, index: index as u32 }));
        }
        self.order
            .sort_unstable_by(|a, b| a.left.total_cmp(&b.left).then(a.list.cmp(&b.list)).then(a.index.cmp(&b.index)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn rect() -> impl Strategy<Value = Rect> {
        // Whole numbers make touching and equal edges common.
        (0i32..40, 0i32..40, 0i32..12, 0i32..12)
            .prop_map(|(l, t, w, h)| Rect::new(l as f64, t as f64, w as f64, h as f64))
    }

    proptest! {
        #[test]
        fn finds_exactly_the_pairs_with_a_positive_iou(
            rows in proptest::collection::vec(rect(), 0..30),
            columns in proptest::collection::vec(rect(), 0..30),
        ) {
            let mut expected = Vec::new();
            for (i, a) in rows.iter().enumerate() {
                for (j, b) in columns.iter().enumerate() {
                    if a.iou(b) > 0.0 {
                        expected.push((i as u32, j as u32));
                    }
                }
            }
            let mut sweep = OverlapSweep::default();
            sweep.pairs(&columns, &rows);
            prop_assert_eq!(sweep.pairs(&rows, &columns), &expected[..]);
        }
    }
}
