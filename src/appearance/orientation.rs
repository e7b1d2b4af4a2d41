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

/// No vote is larger: `255 * sqrt(2)` and what the rounding of the directions adds.
pub const MAX_VOTE: u16 = 366;

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

/// Directions of the neighbours of every bin, scaled.
#[derive(Clone, Copy, Debug)]
pub struct Directions {
    next_cosine: [i16; BINS],
    next_sine: [i16; BINS],
    previous_cosine: [i16; BINS],
    previous_sine: [i16; BINS],
}

const DIRECTIONS: Directions = Directions {
    next_cosine: scaled_cosines(1),
    next_sine: scaled_cosines(1 + 12),
    previous_cosine: scaled_cosines(15),
    previous_sine: scaled_cosines(15 + 12),
};

impl Directions {
    /// The table, hidden from constant folding: a compiler that sees the zeros and powers of two in it replaces those
    /// products by other operations, and then no longer recognises eight equal lanes.
    pub fn opaque() -> Self {
        std::hint::black_box(DIRECTIONS)
    }

    /// Votes of the gradient `(gx, gy)`, each component in `-255..=255`, in gray levels: at most
    /// [`MAX_VOTE`].
    #[inline(always)]
    #[allow(clippy::needless_range_loop, reason = "six arrays in step: eight equal lanes for the vectoriser")]
    pub fn votes(&self, gx: i16, gy: i16) -> [u16; BINS] {
        let mut out = [0; BINS];
        for b in 0..BINS {
            let from_previous =
                self.previous_cosine[b].wrapping_mul(gy).wrapping_sub(self.previous_sine[b].wrapping_mul(gx));
            let to_next = self.next_sine[b].wrapping_mul(gx).wrapping_sub(self.next_cosine[b].wrapping_mul(gy));
            let inside = from_previous.min(to_next).max(0i16.wrapping_sub(from_previous.max(to_next))).max(0);
            out[b] = (inside.wrapping_add(1 << (FRACTION_BITS - 1)) >> FRACTION_BITS) as u16;
        }
        out
    }
}

const fn scaled_cosines(shift: usize) -> [i16; BINS] {
    let mut out = [0; BINS];
    let mut b = 0;
    while b < BINS {
        out[b] = scaled_cosine(b + shift);
        b += 1;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn votes(gx: i16, gy: i16) -> [u16; BINS] {
        DIRECTIONS.votes(gx, gy)
    }

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
        for gx in (-255i16..=255).step_by(5) {
            for gy in (-255i16..=255).step_by(5) {
                let v = votes(gx, gy);
                let (mut x, mut y) = (0.0, 0.0);
                for (b, &vote) in v.iter().enumerate() {
                    let angle = (b as f64 * 22.5).to_radians();
                    let sign = if angle.cos() * f64::from(gx) + angle.sin() * f64::from(gy) < 0.0 { -1.0 } else { 1.0 };
                    x += sign * f64::from(vote) * angle.cos();
                    y += sign * f64::from(vote) * angle.sin();
                }
                let error = (x - f64::from(gx)).abs().max((y - f64::from(gy)).abs());
                assert!(error <= 5.0, "({gx}, {gy}) -> {v:?}: off by {error}");
                assert!(v.iter().filter(|&&vote| vote > 5).count() <= 2, "({gx}, {gy}) -> {v:?}");
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
    fn the_strongest_gradients_do_not_overflow() {
        for gx in -255..=255 {
            for gy in [-255, 255] {
                let v = votes(gx, gy);
                assert!(v.iter().all(|&vote| vote <= MAX_VOTE), "({gx}, {gy}) -> {v:?}");
                assert!(v.iter().sum::<u16>() >= 250, "({gx}, {gy}) -> {v:?}");
            }
        }
    }
}
