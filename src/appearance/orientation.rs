//! Votes of one gradient for the orientation bins, in integers and without `atan2`.
//!
//! Bin `b` stands for the unsigned direction `u_b = (cos, sin)(b * 180 / BINS degrees)`. A gradient `g` between `u_b` and
//! `u_(b+1)` is split as `g = p u_b + q u_(b+1)`: the two nearest bins receive `p` and `q`, both non-negative. This takes
//! the place of the linear interpolation of Dalal & Triggs (Histograms of Oriented Gradients for Human Detection, CVPR
//! 2005): it is continuous in the angle too, its sum exceeds `|g|` by at most 2 %, and it needs only cross products:
//! the vote of bin `b` is the positive part of `min(u_(b-1) x g, g x u_(b+1)) / sin(180 / BINS degrees)`, for `g` or for
//! `-g`.

/// Orientation bins over 180 degrees. Eight 16-bit numbers fill one vector register; nine bins separate people no better.
pub const BINS: usize = 8;

/// A vote counts gray levels in whole numbers; the products below count in 1/32.
const FRACTION_BITS: u32 = 5;

/// Votes saturate here, so that a cell of 256 samples still sums to less than 65536.
const MAX_VOTE: u16 = 255;

/// `32 * cos(22.5 degrees * b) / sin(22.5 degrees)`, rounded; a quarter turn (4 bins) on is the sine's negative. The
/// largest product is `84 * 255 * sqrt(2) < 32767`.
const fn scaled_cosine(b: usize) -> i16 {
    const QUARTER: [i16; 5] = [84, 77, 59, 32, 0];
    match b % 16 {
        k @ 0..=4 => QUARTER[k],
        k @ 5..=8 => -QUARTER[8 - k],
        k @ 9..=12 => -QUARTER[k - 8],
        k => QUARTER[16 - k],
    }
}

/// Directions of the bins, each moved on by `shift` bins: (cosines, sines).
const fn directions(shift: usize) -> ([i16; BINS], [i16; BINS]) {
    let (mut cos, mut sin) = ([0; BINS], [0; BINS]);
    let mut b = 0;
    while b < BINS {
        cos[b] = scaled_cosine(b + shift);
        sin[b] = scaled_cosine(b + shift + 12);
        b += 1;
    }
    (cos, sin)
}

const NEXT: ([i16; BINS], [i16; BINS]) = directions(1);
const PREVIOUS: ([i16; BINS], [i16; BINS]) = directions(2 * BINS - 1);

/// Votes of the gradient `(gx, gy)`, each component in `-255..=255`, in gray levels.
#[inline(always)]
pub fn votes(gx: i16, gy: i16) -> [u16; BINS] {
    let mut out = [0; BINS];
    for b in 0..BINS {
        let from_previous = PREVIOUS.0[b].wrapping_mul(gy).wrapping_sub(PREVIOUS.1[b].wrapping_mul(gx));
        let to_next = NEXT.1[b].wrapping_mul(gx).wrapping_sub(NEXT.0[b].wrapping_mul(gy));
        let inside = from_previous.min(to_next).max(-from_previous.max(to_next)).max(0);
        let rounded = (inside + (1 << (FRACTION_BITS - 1))) >> FRACTION_BITS;
        out[b] = rounded.min(MAX_VOTE as i16) as u16;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gradient_along_a_bin_votes_for_it_alone() {
        assert_eq!(votes(100, 0), [100, 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!(votes(-100, 0), [100, 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!(votes(0, 100), [0, 0, 0, 0, 100, 0, 0, 0]);
        assert_eq!(votes(0, -7), [0, 0, 0, 0, 7, 0, 0, 0]);
        // |(100, 100)| = 141.4.
        for (gx, gy, bin) in [(100, 100, 2), (-100, -100, 2), (-100, 100, 6)] {
            let v = votes(gx, gy);
            assert!(v[bin].abs_diff(141) <= 1, "{v:?}");
            assert_eq!(v.iter().sum::<u16>(), v[bin]);
        }
    }

    #[test]
    fn votes_rebuild_the_gradient() {
        // Independent check in floating point: the two votes times their directions are g or -g again.
        for gx in (-170..=170).step_by(5) {
            for gy in (-170..=170).step_by(5) {
                let v = votes(gx, gy);
                let (mut x, mut y) = (0.0, 0.0);
                for (b, &vote) in v.iter().enumerate() {
                    let angle = (b as f64 * 22.5).to_radians();
                    let sign = if angle.cos() * f64::from(gx) + angle.sin() * f64::from(gy) < 0.0 { -1.0 } else { 1.0 };
                    x += sign * f64::from(vote) * angle.cos();
                    y += sign * f64::from(vote) * angle.sin();
                }
                let error = (x - f64::from(gx)).abs().max((y - f64::from(gy)).abs());
                assert!(error <= 3.0, "({gx}, {gy}) -> {v:?}: off by {error}");
                assert!(v.iter().filter(|&&vote| vote > 3).count() <= 2, "({gx}, {gy}) -> {v:?}");
            }
        }
    }

    #[test]
    fn a_quarter_turn_moves_votes_by_four_bins() {
        for (gx, gy) in [(3, 4), (120, -7), (-60, 59), (255, 255), (0, 1), (33, 80)] {
            let mut turned = votes(gx, gy);
            turned.rotate_right(BINS / 2);
            assert_eq!(votes(-gy, gx), turned);
        }
    }

    #[test]
    fn the_strongest_gradients_saturate_without_overflow() {
        for gx in -255..=255 {
            for gy in [-255, 255] {
                let v = votes(gx, gy);
                assert!(v.iter().all(|&vote| vote <= MAX_VOTE));
                assert!(v.iter().sum::<u16>() >= 250, "({gx}, {gy}) -> {v:?}");
            }
        }
    }
}
