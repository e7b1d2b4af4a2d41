//! Equal intervals of a line.

/// Intervals, of which the first and the last go on for ever. A larger number never has a lower interval, whatever rounding
/// does, so that boxes that overlap meet in one.
#[derive(Clone, Copy, Debug)]
pub struct Intervals {
    pub from: f64,
    pub per_pixel: f64,
    pub last: usize,
}

impl Intervals {
    /// The cast makes 0 of what is before all, and of NaN.
    pub fn of(&self, x: f64) -> usize {
        (((x - self.from) * self.per_pixel) as usize).min(self.last)
    }
}
