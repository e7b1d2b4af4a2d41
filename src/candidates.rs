//! Which boxes of two lists overlap, found by a sweep along x instead of by trying all pairs.
//!
//! With more than about a thousand boxes in both lists a row has a limited number of partners, the nearest ones: all pairs
//! of tens of thousands of boxes on one spot do not fit into memory.

use crate::geometry::Rect;

/// Pairs for which there is always room; rows share it.
const ROOM: usize = 1 << 20;
/// Partners that each row may have in any case.
const LEAST_PER_ROW: usize = 32;

/// The sweep, with buffers that are reused from call to call.
#[derive(Clone, Debug, Default)]
pub struct OverlapSweep {
    order: Vec<Entry>,
    active: [Vec<u32>; 2],
    pairs: Vec<(u32, u32)>,
    // For each row the rank from which partners are out: that of its last one, once it had too many.
    reach: Vec<(f64, u32)>,
    ranked: Vec<(f64, u32)>,
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    left: f64,
    list: u8,
    index: u32,
}

impl OverlapSweep {
    /// The `(row, column)` whose boxes share an area, sorted by row, then column.
    pub fn pairs(&mut self, rows: &[Rect], columns: &[Rect]) -> &[(u32, u32)] {
        self.limited_pairs(rows, columns, LEAST_PER_ROW.max(ROOM / rows.len().max(1)))
    }

    /// The same with at most so many partners per row.
    fn limited_pairs(&mut self, rows: &[Rect], columns: &[Rect], most: usize) -> &[(u32, u32)] {
        self.pairs.clear();
        self.reach.clear();
        self.reach.resize(rows.len(), (f64::INFINITY, 0));
        self.fill_order(rows, columns);
        let most_pairs = 2 * most * rows.len();
        let lists = [rows, columns];
        for at in 0..self.order.len() {
            let entry = self.order[at];
            let (own, other) = (entry.list as usize, 1 - entry.list as usize);
            let rect = &lists[own][entry.index as usize];
            let (first, mut kept) = (self.pairs.len(), 0);
            for k in 0..self.active[other].len() {
                let candidate = self.active[other][k];
                let box_ = &lists[other][candidate as usize];
                if box_.right() <= rect.left {
                    continue;
                }
                self.active[other][kept] = candidate;
                kept += 1;
                if box_.top < rect.bottom() && rect.top < box_.bottom() {
                    let pair = if own == 0 { (entry.index, candidate) } else { (candidate, entry.index) };
                    if is_before((distance(rows, columns, pair), pair.1), self.reach[pair.0 as usize]) {
                        self.pairs.push(pair);
                    }
                }
            }
            self.active[other].truncate(kept);
            self.active[own].push(entry.index);
            if own == 0 && self.pairs.len() - first > most {
                // At once, as else the pairs of a crowd would be sorted over and over.
                self.rank(first..self.pairs.len(), rows, columns, most);
                self.pairs.truncate(first);
                self.pairs.extend(self.ranked.iter().map(|ranked| (entry.index, ranked.1)));
            }
            if self.pairs.len() > most_pairs {
                self.keep_nearest(rows, columns, most);
            }
        }
        self.keep_nearest(rows, columns, most);
        &self.pairs
    }

    /// Sorts the pairs and leaves each row its nearest partners, the first of equally near ones.
    fn keep_nearest(&mut self, rows: &[Rect], columns: &[Rect], most: usize) {
        self.pairs.sort_unstable();
        let (mut from, mut kept) = (0, 0);
        while from < self.pairs.len() {
            let row = self.pairs[from].0;
            let count = self.pairs[from..].iter().take_while(|p| p.0 == row).count();
            if count > most {
                self.rank(from..from + count, rows, columns, most);
                for ranked in &self.ranked {
                    self.pairs[kept] = (row, ranked.1);
                    kept += 1;
                }
            } else {
                self.pairs.copy_within(from..from + count, kept);
                kept += count;
            }
            from += count;
        }
        self.pairs.truncate(kept);
    }

    /// Puts the nearest partners of a row with too many, whose pairs are `range`, into `ranked`, by index.
    fn rank(&mut self, range: std::ops::Range<usize>, rows: &[Rect], columns: &[Rect], most: usize) {
        let of_row = &self.pairs[range];
        let row = of_row[0].0 as usize;
        self.ranked.clear();
        self.ranked.extend(of_row.iter().map(|pair| (distance(rows, columns, *pair), pair.1)));
        let by_distance = |a: &(f64, u32), b: &(f64, u32)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
        self.ranked.select_nth_unstable_by(most - 1, by_distance);
        self.reach[row] = self.ranked[most - 1];
        self.ranked.truncate(most);
        self.ranked.sort_unstable_by_key(|ranked| ranked.1);
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

/// Partners rank by their distance, equally far ones by their index.
fn is_before(a: (f64, u32), b: (f64, u32)) -> bool {
    a.0 < b.0 || (a.0 == b.0 && a.1 < b.1)
}

/// How far apart the centres of a pair are: the sum of both components.
fn distance(rows: &[Rect], columns: &[Rect], (row, column): (u32, u32)) -> f64 {
    let (a, b) = (&rows[row as usize], &columns[column as usize]);
    0.5 * ((a.left + a.right() - b.left - b.right()).abs() + (a.top + a.bottom() - b.top - b.bottom()).abs())
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

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        /// Few places and large boxes, so that many partners are equally far, in crowds large enough to be thinned out
        /// on the way.
        #[test]
        fn the_nearest_partners_are_those_of_all_pairs(
            rows in proptest::collection::vec((0i32..9, 0i32..9, 10i32..12), 1..150),
            columns in proptest::collection::vec((0i32..9, 0i32..9, 10i32..12), 1..150),
        ) {
            let boxes = |list: &[(i32, i32, i32)]| -> Vec<Rect> {
                list.iter().map(|(l, t, side)| Rect::new(*l as f64, *t as f64, *side as f64, *side as f64)).collect()
            };
            let (rows, columns) = (boxes(&rows), boxes(&columns));
            let mut expected = Vec::new();
            for row in 0..rows.len() as u32 {
                let partners = (0..columns.len() as u32).filter(|c| rows[row as usize].iou(&columns[*c as usize]) > 0.0);
                let mut ranked: Vec<_> = partners.map(|c| (distance(&rows, &columns, (row, c)), c)).collect();
                ranked.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                ranked.truncate(LEAST_PER_ROW);
                ranked.sort_by_key(|ranked| ranked.1);
                expected.extend(ranked.iter().map(|ranked| (row, ranked.1)));
            }
            let mut sweep = OverlapSweep::default();
            prop_assert_eq!(sweep.limited_pairs(&rows, &columns, LEAST_PER_ROW), &expected[..]);
        }
    }

    #[test]
    fn up_to_a_thousand_boxes_have_all_their_partners() {
        let rects = vec![Rect::new(0.0, 0.0, 10.0, 10.0); 1000];
        assert_eq!(OverlapSweep::default().pairs(&rects, &rects).len(), 1_000_000);
    }

    #[test]
    fn a_row_keeps_its_nearest_partners_where_too_many_lie_on_top_of_it() {
        // Three rows at 0, 100 and 1000; 300 columns at 0, 1, 2, ... 299, all overlapping the first two.
        let at = |left: f64| Rect::new(left, 0.0, 400.0, 10.0);
        let rows = [at(0.0), at(100.0), at(1000.0)];
        let columns: Vec<Rect> = (0..300).map(|i| at(i as f64)).collect();
        let mut sweep = OverlapSweep::default();
        let pairs = sweep.limited_pairs(&rows, &columns, LEAST_PER_ROW);
        // 0..=31 for the first; for the second 100 and 15 to each side, and of 84 and 116, equally far, the first.
        let expected = (0..32).map(|c| (0, c)).chain((84..116).map(|c| (1, c)));
        assert_eq!(pairs, expected.collect::<Vec<(u32, u32)>>());
    }

    #[test]
    fn memory_stays_bounded_where_everything_overlaps() {
        let rects = vec![Rect::new(0.0, 0.0, 10.0, 10.0); 3000];
        let mut sweep = OverlapSweep::default();
        assert_eq!(sweep.limited_pairs(&rects, &rects, LEAST_PER_ROW).len(), LEAST_PER_ROW * 3000);
        assert!(sweep.pairs.capacity() < 4 * 2 * LEAST_PER_ROW * 3000, "{}", sweep.pairs.capacity());
    }
}
