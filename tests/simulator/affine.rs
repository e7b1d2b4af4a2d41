//! Affine maps `[m00 m01 tx; m10 m11 ty]`, row-major.

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine(pub [f64; 6]);

impl Affine {
    pub const IDENTITY: Affine = Affine([1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);

    pub fn apply(&self, x: f64, y: f64) -> (f64, f64) {
        let m = &self.0;
        (m[0] * x + m[1] * y + m[2], m[3] * x + m[4] * y + m[5])
    }

    /// The map that first applies `first`, then `self`.
    pub fn after(&self, first: &Affine) -> Affine {
        let (m, n) = (&self.0, &first.0);
        let (tx, ty) = self.apply(n[2], n[5]);
        Affine([
            m[0] * n[0] + m[1] * n[3],
            m[0] * n[1] + m[1] * n[4],
            tx,
            m[3] * n[0] + m[4] * n[3],
            m[3] * n[1] + m[4] * n[4],
            ty,
        ])
    }

    pub fn inverse(&self) -> Affine {
        let m = &self.0;
        let d = m[0] * m[4] - m[1] * m[3];
        let (a, b, c, e) = (m[4] / d, -m[1] / d, -m[3] / d, m[0] / d);
        Affine([a, b, -(a * m[2] + b * m[5]), c, e, -(c * m[2] + e * m[5])])
    }
}
