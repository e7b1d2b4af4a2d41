//! The HOG vector of one box, and how alike two of them are.

use super::orientation::BINS;

/// Columns of cells in a box.
pub const CELLS_X: usize = 4;
/// Rows of cells in a box.
pub const CELLS_Y: usize = 8;
/// Numbers in a descriptor: cells row by row from the left-top, [`BINS`] numbers each.
pub const DESCRIPTOR_LEN: usize = CELLS_X * CELLS_Y * BINS;

/// Mean gradient per cell and orientation, non-negative, scaled to unit Euclidean norm; all zero when the box has no
/// texture.
pub type Descriptor = [f32; DESCRIPTOR_LEN];

/// The descriptor of a box without texture.
pub const EMPTY: Descriptor = [0.0; DESCRIPTOR_LEN];

/// Cosine similarity of two unit-norm vectors (`f_s` of the paper's eq. 5) in `[0, 1]`; 0 when either is
/// [`EMPTY`].
pub fn cosine<const N: usize>(a: &[f32; N], b: &[f32; N]) -> f32 {
    dot(a, b).min(1.0)
}

/// Scales to unit Euclidean norm; an all-zero vector stays.
pub fn normalize<const N: usize>(descriptor: &mut [f32; N]) {
    let squared = dot(descriptor, descriptor);
    if squared > 0.0 {
        let scale = 1.0 / squared.sqrt();
        descriptor.iter_mut().for_each(|value| *value *= scale);
    }
}

/// Most sums that run side by side.
const MAX_LANES: usize = DESCRIPTOR_LEN / 8;

/// The sum of products. Flat loops that vectorise, in an order that does not depend on the machine.
fn dot<const N: usize>(a: &[f32; N], b: &[f32; N]) -> f32 {
    const { assert!(N.is_power_of_two() && N >= 8 && N <= 8 * MAX_LANES) };
    let lanes = N / 8;
    let mut sums = [0.0f32; MAX_LANES];
    for i in 0..lanes {
        let product = |part: usize| a[i + part * lanes] * b[i + part * lanes];
        let low = (product(0) + product(1)) + (product(2) + product(3));
        let high = (product(4) + product(5)) + (product(6) + product(7));
        sums[i] = low + high;
    }
    let mut width = lanes / 2;
    while width > 0 {
        let (left, right) = sums.split_at_mut(width);
        left.iter_mut().zip(right).for_each(|(l, r)| *l += *r);
        width /= 2;
    }
    sums[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn from_values(values: &[(usize, f32)]) -> Descriptor {
        let mut d = EMPTY;
        values.iter().for_each(|&(i, v)| d[i] = v);
        d
    }

    #[test]
    fn cosine_of_known_vectors() {
        let a = from_values(&[(0, 0.6), (100, 0.8)]);
        let b = from_values(&[(0, 0.8), (255, 0.6)]);
        assert!((cosine(&a, &a) - 1.0).abs() < 1e-6);
        assert!((cosine(&a, &b) - 0.48).abs() < 1e-6);
        assert_eq!(cosine(&a, &from_values(&[(7, 1.0)])), 0.0);
        assert_eq!(cosine(&a, &EMPTY), 0.0);
        assert_eq!(cosine(&EMPTY, &EMPTY), 0.0);
    }

    #[test]
    fn normalize_gives_unit_length() {
        // |(3, 4)| = 5.
        let mut d = from_values(&[(3, 3.0), (200, 4.0)]);
        normalize(&mut d);
        assert!((d[3] - 0.6).abs() < 1e-6 && (d[200] - 0.8).abs() < 1e-6);
        let mut zero = EMPTY;
        normalize(&mut zero);
        assert_eq!(zero, EMPTY);
    }
}
