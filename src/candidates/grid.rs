//! Overlapping boxes of many, where few boxes lie above each other anywhere: columns are put into the cells of a grid that
//! they meet, and each row looks into its own. Rows come in order, so that only their few partners have to be sorted.

use std::ops::Range;

use crate::buffers::{append, refill};
use crate::geometry::Rect;

use super::column::Column;
use super::intervals::Intervals;

/// Sides of a cell in mean sides of a box: in smaller cells boxes are listed more often, in larger ones more are looked at.
const CELL: f64 = 1.5;
/// Cells per box, at most.
const CELLS_PER_BOX: f64 = 2.0;
/// Cells that a box may meet, on average, and boxes that a row may look at.
const MOST_CELLS: usize = 16;
const MOST_LOOKS: usize = 512;

/// The search, with buffers that are reused from call to call.
#[derive(Clone, Debug, Default)]
pub struct Grid {
    /// Where each cell's columns begin in the list.
    first: Vec<u32>,
    list: Vec<Column>,
    found: Vec<u32>,
}

// What is true of a cell among those that a box meets; columns are marked with it.
const NOT_LEFTMOST: u8 = 1;
const NOT_TOPMOST: u8 = 2;

/// Equal cells; the outermost go on for ever.
#[derive(Clone, Copy, Debug)]
struct Cells {
    x: Intervals,
    y: Intervals,
}

impl Cells {
    /// Cells for these boxes, all of them with an area; none if there are no boxes, or if they are too far apart to tell.
    fn new<'a>(boxes: impl Iterator<Item = &'a Rect>) -> Option<Self> {
        let (mut left, mut right, mut top, mut bottom) =
            (f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY);
        let (mut width, mut height, mut count) = (0.0, 0.0, 0.0);
        for rect in boxes {
            left = left.min(rect.left);
            right = right.max(rect.left);
            top = top.min(rect.top);
            bottom = bottom.max(rect.top);
            width += rect.width;
            height += rect.height;
            count += 1.0;
        }
        let sides = |length: f64, total: f64| (length * count / (CELL * total)).max(1.0);
        let (across, down) = (sides(right - left, width), sides(bottom - top, height));
        let coarser = (across * down / (CELLS_PER_BOX * count)).max(1.0).sqrt();
        let axis = |from: f64, length: f64, cells: f64| {
            let cells = (cells / coarser).max(1.0);
            Intervals { from, per_pixel: cells / length, last: cells as usize }
        };
        // A long row of boxes has its cells along it, not more of them.
        let cells = Self { x: axis(left, right - left, across), y: axis(top, bottom - top, down) };
        let is_sound = cells.x.per_pixel.is_finite() && cells.y.per_pixel.is_finite();
        // Not as whole numbers: slivers far apart would have more cells than these can count.
        let in_all = (cells.x.last as f64 + 1.0) * (cells.y.last as f64 + 1.0);
        (is_sound && in_all < 4.0 * CELLS_PER_BOX * count + 64.0).then_some(cells)
    }

    fn count(&self) -> usize {
        (self.x.last + 1) * (self.y.last + 1)
    }

    /// The cells that a box meets: of some lines of cells so many, one after the other; with each line what is true of it.
    fn of(&self, rect: &Rect) -> impl Iterator<Item = (Range<usize>, u8)> + use<> {
        let (left, right) = (self.x.of(rect.left), self.x.of(rect.right()));
        let (top, bottom) = (self.y.of(rect.top), self.y.of(rect.bottom()));
        let across = self.x.last + 1;
        let place = move |y| if y == top { 0 } else { NOT_TOPMOST };
        (top..=bottom).map(move |y| (y * across + left..y * across + right + 1, place(y)))
    }
}

impl Grid {
    /// Adds the `(row, column)` whose boxes share an area, sorted by row, then column; gives up, and returns false, at a row
    /// with more than `most` of them, or where boxes are so unlike, or lie so close, that cells are of no use.
    pub fn add_pairs(&mut self, rows: &[Rect], columns: &[Rect], most: usize, pairs: &mut Vec<(u32, u32)>) -> bool {
        let Some(cells) = Cells::new(columns.iter().filter(|c| c.area() > 0.0)) else { return false };
        if !self.list_by_cell(columns, &cells) {
            return false;
        }
        let mut looks = MOST_LOOKS * rows.len();
        for (row, rect) in (0..).zip(rows).filter(|(_, r)| r.area() > 0.0) {
            let mut count = 0;
            for (line, place) in cells.of(rect) {
                let [start, second, end] = [line.start, line.start + 1, line.end].map(|cell| self.first[cell] as usize);
                let Some(left_over) = looks.checked_sub(end - start) else { return false };
                looks = left_over;
                if self.found.len() < count + end - start {
                    self.found.resize(count + end - start, 0);
                }
                // Boxes may meet in several cells, and count in the first: where one or the other begins.
                for (cells, elsewhere) in [(start..second, place), (second..end, place | NOT_LEFTMOST)] {
                    for column in &self.list[cells] {
                        // Written in any case, and written over if it was none.
                        self.found[count] = column.index;
                        count += usize::from(column.overlaps(rect) & (column.mark & elsewhere == 0));
                    }
                }
            }
            if count > most {
                return false;
            }
            let found = &mut self.found[..count];
            found.sort_unstable();
            append(pairs, found.iter().map(|column| (row, *column)));
        }
        true
    }

    /// Lists the columns by cell; false if they meet too many.
    fn list_by_cell(&mut self, columns: &[Rect], cells: &Cells) -> bool {
        let present = || (0..).zip(columns).filter(|(_, c)| c.area() > 0.0);
        refill(&mut self.first, cells.count() + 1, 0);
        let most = MOST_CELLS * columns.len();
        let mut total = 0;
        for (_, rect) in present() {
            for (line, _) in cells.of(rect) {
                total += line.len();
                if total > most {
                    return false;
                }
                self.first[line].iter_mut().for_each(|n| *n += 1);
            }
        }
        // Each number says where its cell ends, and is counted down to where it begins.
        let mut before = 0;
        for n in &mut self.first {
            before += *n;
            *n = before;
        }
        refill(&mut self.list, total, Column::default());
        for present in present() {
            let mut column = Column::of(present);
            for (line, place) in cells.of(present.1) {
                column.mark = place;
                for next in &mut self.first[line] {
                    *next -= 1;
                    self.list[*next as usize] = column;
                    column.mark |= NOT_LEFTMOST;
                }
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// So many boxes of 10 x 10, as many in a line as there are lines, so far apart.
    fn field(boxes: usize, apart: f64) -> Vec<Rect> {
        let side = boxes.isqrt();
        let at = |i: usize| Rect::new(apart * (i % side) as f64, apart * (i / side) as f64, 10.0, 10.0);
        (0..boxes).map(at).collect()
    }

    #[test]
    fn neighbours_in_a_field_are_found() {
        // 8 apart each box meets itself and the eight around it.
        let (boxes, mut pairs) = (field(900, 8.0), Vec::new());
        assert!(Grid::default().add_pairs(&boxes, &boxes, 9, &mut pairs));
        let of = |row: u32| pairs.iter().filter(|p| p.0 == row).map(|p| p.1).collect::<Vec<_>>();
        assert_eq!(of(0), [0, 1, 30, 31]);
        assert_eq!(of(31), [0, 1, 2, 30, 31, 32, 60, 61, 62]);
        assert_eq!(pairs.len(), 9 * 28 * 28 + 4 * 6 * 28 + 4 * 4);
        // No box may have so few partners.
        assert!(!Grid::default().add_pairs(&boxes, &boxes, 8, &mut Vec::new()));
    }

    #[test]
    fn it_gives_up_where_cells_are_of_no_use() {
        let far = Rect::new(1e12, 1e12, 10.0, 10.0);
        let one_cell: Vec<Rect> = field(900, 8.0).into_iter().chain([far]).collect();
        assert!(!Grid::default().add_pairs(&one_cell, &one_cell, usize::MAX, &mut Vec::new()));
        for (width, height) in [(1e-30, 10.0), (10.0, 1e-30)] {
            let slivers: Vec<Rect> =
                (0..900).map(|i| 1e9 * i as f64).map(|at| Rect::new(at, at, width, height)).collect();
            assert!(!Grid::default().add_pairs(&slivers, &slivers, usize::MAX, &mut Vec::new()));
        }
        let wide = Rect::new(0.0, 0.0, 1e6, 1e6);
        let many_cells: Vec<Rect> = field(900, 1000.0).into_iter().chain([wide; 60]).collect();
        assert!(!Grid::default().add_pairs(&many_cells, &many_cells, usize::MAX, &mut Vec::new()));
    }
}
