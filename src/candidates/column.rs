//! A box to be looked at, as its edges.

use crate::geometry::Rect;

/// A column's box.
#[derive(Clone, Copy, Debug, Default)]
pub struct Column {
    pub left: f64,
    pub right: f64,
    top: f64,
    bottom: f64,
    pub index: u32,
    /// Whatever else a search has to know of it.
    pub mark: u8,
}

impl Column {
    pub fn of((index, c): (u32, &Rect)) -> Self {
        Self { left: c.left, right: c.right(), top: c.top, bottom: c.bottom(), index, mark: 0 }
    }

    /// Whether they share an area, without a branch.
    pub fn overlaps(&self, rect: &Rect) -> bool {
        (self.right > rect.left) & (self.left < rect.right()) & (self.top < rect.bottom()) & (rect.top < self.bottom)
    }
}
