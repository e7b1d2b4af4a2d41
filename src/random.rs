//! Random numbers that are the same on every platform: a named generator and our own way from its bits to numbers.

use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// A stream of random numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct Random(Xoshiro256PlusPlus);

impl Random {
    /// The stream of `seed` and `stream`: different streams of one seed are independent.
    pub fn new(seed: u64, stream: u64) -> Self {
        // Multiplying by an odd constant keeps distinct streams distinct; seeding expands the sum by SplitMix64.
        Self(Xoshiro256PlusPlus::seed_from_u64(seed.wrapping_add(stream.wrapping_mul(0x9E37_79B9_7F4A_7C15))))
    }

    /// Uniform in `[0, 1)`, with 53 random bits.
    pub fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }

    /// Four numbers uniform in `[0, 1)`, with 16 random bits each: for a quarter of the price where that is fine enough.
    pub fn unit_quad(&mut self) -> [f64; 4] {
        const SCALE: f64 = 1.0 / (1u64 << 16) as f64;
        let bits = self.0.next_u64();
        [48, 32, 16, 0].map(|shift| f64::from((bits >> shift) as u16) * SCALE)
    }

    /// Uniform in `[-bound, bound)`.
    pub fn symmetric(&mut self, bound: f64) -> f64 {
        (2.0 * self.unit() - 1.0) * bound
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn golden_values_hold_on_every_platform() {
        let mut random = Random::new(1, 2);
        let drawn: Vec<u64> = (0..3).map(|_| random.unit().to_bits()).collect();
        assert_eq!(drawn, GOLDEN);
    }

    const GOLDEN: [u64; 3] = [4601542274839127056, 4596439488580453296, 4593733170227320252];

    #[test]
    fn quads_are_the_quarters_of_one_draw() {
        // The golden first draw in full: its first quarter is the leading 16 of the 53 bits of `unit`.
        let quad = Random::new(1, 2).unit_quad();
        let whole = Random::new(1, 2).unit();
        assert!(whole >= quad[0] && whole - quad[0] < 1.0 / (1u64 << 16) as f64);
        assert!(quad.iter().all(|x| (0.0..1.0).contains(x)));
        assert!(quad[1..].iter().all(|x| *x != quad[0]));
    }

    #[test]
    fn numbers_fill_their_interval() {
        let mut random = Random::new(7, 0);
        let drawn: Vec<f64> = (0..10_000).map(|_| random.symmetric(2.0)).collect();
        assert!(drawn.iter().all(|x| (-2.0..2.0).contains(x)));
        let mean = drawn.iter().sum::<f64>() / drawn.len() as f64;
        // The mean of 10 000 such draws has standard deviation 2 / sqrt(3 * 10 000) = 0.012.
        assert!(mean.abs() < 0.05, "{mean}");
    }
}
