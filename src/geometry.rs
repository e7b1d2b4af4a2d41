//! Boxes and the distances between them.

/// An axis-aligned box by its left-top corner and size, in pixels. The form in which boxes enter and leave the
/// library.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct Rect {
    /// Left edge.
    pub left: f64,
    /// Top edge (y points down).
    pub top: f64,
    /// Width, never negative.
    pub width: f64,
    /// Height, never negative.
    pub height: f64,
}

impl Rect {
    /// A box from its left-top corner and size.
    pub const fn new(left: f64, top: f64, width: f64, height: f64) -> Self {
        Self { left, top, width, height }
    }

    /// Right edge.
    pub fn right(&self) -> f64 {
        self.left + self.width
    }

    /// Bottom edge.
    pub fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// Area in square pixels.
    pub fn area(&self) -> f64 {
        self.width * self.height
    }

    /// Whether the point lies inside, the left and top edges included.
    pub fn contains(&self, x: f64, y: f64) -> bool {
        x >= self.left && y >= self.top && x < self.right() && y < self.bottom()
    }

    /// Area shared with another box, in square pixels.
    pub fn intersection(&self, other: &Rect) -> f64 {
        let width = self.right().min(other.right()) - self.left.max(other.left);
        let height = self.bottom().min(other.bottom()) - self.top.max(other.top);
        if width <= 0.0 || height <= 0.0 { 0.0 } else { width * height }
    }

    /// Intersection over union in `[0, 1]`; 0 when both boxes are empty.
    pub fn iou(&self, other: &Rect) -> f64 {
        let intersection = self.intersection(other);
        if intersection <= 0.0 {
            return 0.0;
        }
        intersection / (self.area() + other.area() - intersection)
    }
}

/// A box by its centre and size: the state `X = (u, v, w, h)` of the paper, in pixels. Also used for its time
/// derivative `V`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct State {
    /// Horizontal centre.
    pub u: f64,
    /// Vertical centre.
    pub v: f64,
    /// Width.
    pub w: f64,
    /// Height.
    pub h: f64,
}

impl State {
    /// A state from its four components.
    pub const fn new(u: f64, v: f64, w: f64, h: f64) -> Self {
        Self { u, v, w, h }
    }

    /// Length of the box's diagonal: the size unit of every adaptive threshold.
    pub fn diagonal(&self) -> f64 {
        self.w.hypot_exact(self.h)
    }

    /// The paper's `|X_i - X_j|`: Euclidean norm over all four components.
    pub fn distance(&self, other: &State) -> f64 {
        (*self - *other).norm()
    }

    /// Euclidean norm over all four components.
    pub fn norm(&self) -> f64 {
        (self.u * self.u + self.v * self.v + self.w * self.w + self.h * self.h).sqrt()
    }

    /// Euclidean norm of the centre components.
    pub fn centre_norm(&self) -> f64 {
        self.u.hypot_exact(self.v)
    }
}

/// `sqrt(a^2 + b^2)` from correctly rounded operations only, so that every platform computes the same bits
/// (the platform's `hypot` does not promise that).
trait HypotExact {
    fn hypot_exact(self, other: f64) -> f64;
}

impl HypotExact for f64 {
    fn hypot_exact(self, other: f64) -> f64 {
        (self * self + other * other).sqrt()
    }
}

impl From<Rect> for State {
    fn from(r: Rect) -> Self {
        State::new(r.left + 0.5 * r.width, r.top + 0.5 * r.height, r.width, r.height)
    }
}

impl From<State> for Rect {
    fn from(s: State) -> Self {
        Rect::new(s.u - 0.5 * s.w, s.v - 0.5 * s.h, s.w, s.h)
    }
}

impl std::ops::Add for State {
    type Output = State;
    fn add(self, o: State) -> State {
        State::new(self.u + o.u, self.v + o.v, self.w + o.w, self.h + o.h)
    }
}

impl std::ops::Sub for State {
    type Output = State;
    fn sub(self, o: State) -> State {
        State::new(self.u - o.u, self.v - o.v, self.w - o.w, self.h - o.h)
    }
}

impl std::ops::Mul<f64> for State {
    type Output = State;
    fn mul(self, k: f64) -> State {
        State::new(self.u * k, self.v * k, self.w * k, self.h * k)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn iou_of_half_shifted_boxes_is_one_third() {
        // Intersection 5*10 = 50, union 100 + 100 - 50 = 150.
        let a = Rect::new(0.0, 0.0, 10.0, 10.0);
        let b = Rect::new(5.0, 0.0, 10.0, 10.0);
        assert_eq!(a.iou(&b), 50.0 / 150.0);
    }

    #[test]
    fn iou_of_touching_or_empty_boxes_is_zero() {
        let a = Rect::new(0.0, 0.0, 10.0, 10.0);
        assert_eq!(a.iou(&Rect::new(10.0, 0.0, 10.0, 10.0)), 0.0);
        let empty = Rect::new(3.0, 3.0, 0.0, 0.0);
        assert_eq!(empty.iou(&empty), 0.0);
        assert_eq!(a.iou(&empty), 0.0);
    }

    #[test]
    fn rect_and_state_are_inverse() {
        let r = Rect::new(10.0, 20.0, 30.0, 40.0);
        let s = State::from(r);
        assert_eq!(s, State::new(25.0, 40.0, 30.0, 40.0));
        assert_eq!(Rect::from(s), r);
        // A 30 x 40 box has diagonal 50.
        assert_eq!(s.diagonal(), 50.0);
    }

    #[test]
    fn distance_counts_all_four_components() {
        // Differences (1, 2, 2, 4): 1 + 4 + 4 + 16 = 25.
        let d = State::new(0.0, 0.0, 10.0, 10.0).distance(&State::new(1.0, 2.0, 12.0, 14.0));
        assert_eq!(d, 5.0);
    }
}
