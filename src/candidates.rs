//! Which boxes of two lists overlap, found without trying all pairs: of not too many by looking from each along x
//! ([`window`]), of more by cells ([`grid`]), and of those for which neither is of use by sweeps along x, one in each of
//! many horizontal strips. In a strip only a few boxes lie above each other, however many there are in all.
//!
//! With more than about a thousand boxes in both lists a row has a limited number of partners, the nearest ones: all pairs
//! of tens of thousands of boxes on one spot do not fit into memory.

mod column;
mod grid;
mod intervals;
mod window;

use crate::buffers::{self, refill};
use crate::faults::{self, Stage};
use crate::geometry::Rect;

use grid::Grid;
use window::Window;

/// Up to so many pairs there is no need of a grid.
const NOT_MANY: usize = 1 << 20;

/// Pairs for which there is always room; rows share it.
const ROOM: usize = 1 << 20;
/// Partners that each row may have in any case.
const LEAST_PER_ROW: usize = 32;
/// Fewer boxes than this are one strip.
const FEW: usize = 48;
/// Height of a strip in mean heights of a box: lower strips have shorter lists but share more boxes.
const STRIP_HEIGHT: f64 = 2.0;

/// The sweep, with buffers that are reused from call to call.
#[derive(Clone, Debug, Default)]
pub struct OverlapSweep {
    window: Window,
    grid: Grid,
    /// The boxes to be compared, where the caller does not keep them.
    boxes: [Vec<Rect>; 2],
    /// The boxes of all strips, strip by strip, and where each strip begins.
    entries: Vec<Entry>,
    first: Vec<u32>,
    active: [Vec<Active>; 2],
    pairs: Vec<(u32, u32)>,
    // For each row the rank from which partners are out: that of its last one, once it had too many.
    reach: Vec<(f64, u32)>,
    ranked: Vec<(f64, u32)>,
    /// Where each row's partners begin when the pairs are put into order, and the partners.
    slots: Vec<u32>,
    partners: Vec<u32>,
}

/// Overlapping pairs, and the boxes they are of.
#[derive(Clone, Copy, Debug)]
pub struct OverlappingPairs<'a> {
    /// `(row, column)`, sorted by row, then column.
    pub pairs: &'a [(u32, u32)],
    /// The rows' boxes.
    pub rows: &'a [Rect],
    /// The columns' boxes.
    pub columns: &'a [Rect],
}

/// A box in a strip.
#[derive(Clone, Copy, Debug, Default)]
struct Entry {
    /// The left edge as an integer of the same order.
    left: i64,
    index: u32,
    list: u32,
}

/// A box that the sweep is over.
#[derive(Clone, Copy, Debug)]
struct Active {
    right: f64,
    top: f64,
    bottom: f64,
    index: u32,
    /// The strip in which it begins.
    begins: u32,
}

/// Horizontal strips of equal height; the first and the last go on for ever.
#[derive(Clone, Copy, Debug)]
struct Strips {
    top: f64,
    per_pixel: f64,
    count: usize,
}

impl Strips {
    /// Strips for these boxes: as many boxes as there are, each in about one and a half of them.
    fn new(lists: &[&[Rect]; 2]) -> Self {
        let (mut top, mut bottom, mut heights, mut count) = (f64::INFINITY, f64::NEG_INFINITY, 0.0, 0);
        for rect in lists.iter().copied().flatten().filter(|r| r.area() > 0.0) {
            top = top.min(rect.top);
            bottom = bottom.max(rect.top);
            heights += rect.height;
            count += 1;
        }
        let per_pixel = count as f64 / (STRIP_HEIGHT * heights);
        let strips = (bottom - top) * per_pixel;
        if count < FEW || !(per_pixel.is_finite() && strips >= 1.0) {
            return Self { top: 0.0, per_pixel: 0.0, count: 1 };
        }
        // Boxes far away must not make more strips than there are boxes.
        let most = count as f64;
        let per_pixel = if strips > most { per_pixel * (most / strips) } else { per_pixel };
        Self { top, per_pixel, count: strips.min(most) as usize + 1 }
    }

    /// The strip of a height in the image. The cast makes 0 of what is above all boxes, and of NaN.
    fn of(&self, y: f64) -> usize {
        (((y - self.top) * self.per_pixel) as usize).min(self.count - 1)
    }
}

impl OverlapSweep {
    /// The pairs of boxes that share an area, of boxes that are made for this.
    pub fn between(
        &mut self,
        rows: impl Iterator<Item = Rect>,
        columns: impl Iterator<Item = Rect>,
    ) -> OverlappingPairs<'_> {
        let mut boxes = std::mem::take(&mut self.boxes);
        let [a, b] = &mut boxes;
        buffers::collect(a, rows);
        buffers::collect(b, columns);
        self.pairs(a, b);
        self.boxes = boxes;
        OverlappingPairs { pairs: &self.pairs, rows: &self.boxes[0], columns: &self.boxes[1] }
    }

    /// The `(row, column)` whose boxes share an area, sorted by row, then column.
    pub fn pairs(&mut self, rows: &[Rect], columns: &[Rect]) -> &[(u32, u32)] {
        faults::point(Stage::Candidates);
        let most = LEAST_PER_ROW.max(ROOM / rows.len().max(1));
        let are_not_many = rows.len().saturating_mul(columns.len()) <= NOT_MANY;
        self.pairs.clear();
        let are_found = match are_not_many {
            true => self.window.add_pairs(rows, columns, most, &mut self.pairs),
            false => self.grid.add_pairs(rows, columns, most, &mut self.pairs),
        };
        if are_found {
            return &self.pairs;
        }
        self.limited_pairs(rows, columns, most)
    }

    /// The same with at most so many partners per row.
    fn limited_pairs(&mut self, rows: &[Rect], columns: &[Rect], most: usize) -> &[(u32, u32)] {
        self.pairs.clear();
        refill(&mut self.reach, rows.len(), (f64::INFINITY, 0));
        let lists = [rows, columns];
        let strips = Strips::new(&lists);
        self.fill_strips(&lists, &strips);
        for strip in 0..strips.count {
            self.sweep(&lists, &strips, strip, most);
        }
        self.keep_nearest(rows, columns, most);
        &self.pairs
    }

    /// Puts every box into the strips that it meets.
    fn fill_strips(&mut self, lists: &[&[Rect]; 2], strips: &Strips) {
        let boxes = || {
            (0..).zip(lists).flat_map(|(list, rects)| {
                let meets = |r: &Rect| (strips.of(r.top), strips.of(r.bottom()));
                let present = (0u32..).zip(*rects).filter(|(_, r)| r.area() > 0.0);
                present.map(move |(index, r)| (Entry { left: ordered(r.left), index, list }, meets(r)))
            })
        };
        refill(&mut self.first, strips.count + 1, 0);
        for (_, (from, to)) in boxes() {
            self.first[from..=to].iter_mut().for_each(|n| *n += 1);
        }
        let mut total = 0;
        for n in &mut self.first {
            total += std::mem::replace(n, total);
        }
        refill(&mut self.entries, total as usize, Entry::default());
        for (entry, (from, to)) in boxes() {
            for next in &mut self.first[from..=to] {
                self.entries[*next as usize] = entry;
                *next += 1;
            }
        }
        // Now each strip's number says where it ends, which is where the next one begins.
        self.first.rotate_right(1);
        self.first[0] = 0;
        for strip in self.first.windows(2) {
            self.entries[strip[0] as usize..strip[1] as usize].sort_unstable_by_key(|e| e.left);
        }
    }

    /// Finds the pairs of a strip. Boxes that share several strips are a pair in the first of them.
    fn sweep(&mut self, lists: &[&[Rect]; 2], strips: &Strips, strip: usize, most: usize) {
        let [rows, columns] = *lists;
        let most_pairs = 2 * most * rows.len();
        self.active.iter_mut().for_each(Vec::clear);
        for at in self.first[strip] as usize..self.first[strip + 1] as usize {
            let Entry { index, list, .. } = self.entries[at];
            let own = list as usize;
            let rect = &lists[own][index as usize];
            let (left, top, bottom, begins) = (rect.left, rect.top, rect.bottom(), strips.of(rect.top) as u32);
            let (before, mut kept) = (self.pairs.len(), 0);
            let others = &mut self.active[1 - own];
            for k in 0..others.len() {
                let other = others[k];
                if other.right <= left {
                    continue;
                }
                others[kept] = other;
                kept += 1;
                if other.top < bottom && top < other.bottom && other.begins.max(begins) == strip as u32 {
                    let pair = if own == 0 { (index, other.index) } else { (other.index, index) };
                    let reach = self.reach[pair.0 as usize];
                    if reach.0 == f64::INFINITY || is_before((distance(rows, columns, pair), pair.1), reach) {
                        self.pairs.push(pair);
                    }
                }
            }
            others.truncate(kept);
            self.active[own].push(Active { right: rect.right(), top, bottom, index, begins });
            if own == 0 && self.pairs.len() - before > most {
                // At once, as else the pairs of a crowd would be sorted over and over.
                self.rank(before..self.pairs.len(), rows, columns, most);
                self.pairs.truncate(before);
                self.pairs.extend(self.ranked.iter().map(|ranked| (index, ranked.1)));
            }
            if self.pairs.len() > most_pairs {
                self.keep_nearest(rows, columns, most);
            }
        }
    }

    /// Sorts the pairs and leaves each row its nearest partners, the first of equally near ones.
    fn keep_nearest(&mut self, rows: &[Rect], columns: &[Rect], most: usize) {
        self.sort_pairs(rows.len());
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

    /// Sorts the pairs by row, then column: dealt out to the rows, then each row's few by themselves.
    fn sort_pairs(&mut self, rows: usize) {
        refill(&mut self.slots, rows + 1, 0);
        for pair in &self.pairs {
            self.slots[pair.0 as usize + 1] += 1;
        }
        for row in 0..rows {
            self.slots[row + 1] += self.slots[row];
        }
        refill(&mut self.partners, self.pairs.len(), 0);
        for &(row, column) in &self.pairs {
            let slot = &mut self.slots[row as usize];
            self.partners[*slot as usize] = column;
            *slot += 1;
        }
        // Now each row's slot is where it ends.
        let mut from = 0;
        for (row, &to) in self.slots[..rows].iter().enumerate() {
            let (from, to) = (std::mem::replace(&mut from, to as usize), to as usize);
            self.partners[from..to].sort_unstable();
            for (pair, column) in self.pairs[from..to].iter_mut().zip(&self.partners[from..to]) {
                *pair = (row as u32, *column);
            }
        }
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
}

/// A number as an integer of the same order, which is quicker to sort by. -0 comes before 0, which does no harm: a box
/// that ends at 0 and began before is not over one that begins there.
fn ordered(x: f64) -> i64 {
    let bits = x.to_bits() as i64;
    bits ^ ((bits >> 63) as u64 >> 1) as i64
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
            rows in proptest::collection::vec(rect(), 0..60),
            columns in proptest::collection::vec(rect(), 0..60),
            giant in proptest::option::of(-1e12f64..1e12),
        ) {
            // One far away that reaches back over the others.
            let giant = giant.map(|top| Rect::new(0.0, top, 20.0, 2.0 * top.abs()));
            let rows: Vec<Rect> = rows.into_iter().chain(giant).collect();
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
            sweep.limited_pairs(&columns, &rows, 1000);
            prop_assert_eq!(sweep.limited_pairs(&rows, &columns, 1000), &expected[..]);
            let mut found = Vec::new();
            if sweep.grid.add_pairs(&rows, &columns, 1000, &mut found) {
                prop_assert_eq!(found, expected);
            }
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
