//! Whether the blend of prediction and detection follows too slowly or runs after the detector's noise.
//!
//! Where they are weighed right, successive prediction errors of a track have nothing to do with each other. If they
//! point the same way, the blend lags behind and detections deserve more weight; if they alternate, it follows their
//! noise and they deserve less. The correlation of successive errors, over all tracks of the scene, tells.

use crate::geometry::State;

use super::parameters::GenTrack2Parameters;

/// Slowest rate of the running means.
const RATE: f64 = 0.002;
/// Pairs of errors at which the scene weighs as much as what is assumed.
const DOUBT: f64 = 50.0;
/// Largest error, in box diagonals, that counts: beyond it a match is as likely a wrong one.
const LARGEST: f64 = 0.2;
/// Bounds of the factor.
const LEAST: f64 = 0.4;
const MOST: f64 = 1.4;

/// A running correlation of pairs.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
struct Correlation {
    product: f64,
    power: f64,
}

impl Correlation {
    fn learn(&mut self, rate: f64, before: (f64, f64), now: (f64, f64)) {
        let dot = |a: (f64, f64), b: (f64, f64)| a.0 * b.0 + a.1 * b.1;
        self.product += rate * (dot(before, now) - self.product);
        self.power += rate * (0.5 * (dot(before, before) + dot(now, now)) - self.power);
    }

    fn value(&self) -> f64 {
        if self.power > 0.0 { self.product / self.power } else { 0.0 }
    }
}

/// The scene's record of successive errors.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct Whiteness {
    centre: Correlation,
    size: Correlation,
    pairs: f64,
}

/// Factors of the weights of a detection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trust {
    /// Of its centre.
    pub centre: f64,
    /// Of its size.
    pub size: f64,
}

impl Trust {
    /// As configured.
    pub const NOMINAL: Trust = Trust { centre: 1.0, size: 1.0 };
}

impl Whiteness {
    /// Learns from two successive errors of a track, in box diagonals.
    pub fn learn(&mut self, before: &State, now: &State) {
        if before.norm() > LARGEST || now.norm() > LARGEST {
            return;
        }
        self.pairs += 1.0;
        let rate = RATE.max(1.0 / self.pairs);
        self.centre.learn(rate, (before.u, before.v), (now.u, now.v));
        self.size.learn(rate, (before.w, before.h), (now.w, now.h));
    }

    /// How much detections are to be trusted.
    pub fn trust(&self, p: &GenTrack2Parameters) -> Trust {
        let known = self.pairs / (self.pairs + DOUBT);
        let factor = |correlation: &Correlation, usual: f64| {
            (1.0 + p.blend_adaptation * known * (correlation.value() - usual)).clamp(LEAST, MOST)
        };
        Trust { centre: factor(&self.centre, p.usual_correlation), size: factor(&self.size, p.usual_correlation) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn errors(sign: f64, pairs: usize) -> Whiteness {
        let mut whiteness = Whiteness::default();
        for _ in 0..pairs {
            whiteness.learn(&State::new(0.03, 0.04, 0.0, 0.01), &State::new(sign * 0.03, sign * 0.04, 0.0, 0.01));
        }
        whiteness
    }

    #[test]
    fn who_lags_behind_trusts_more_and_who_runs_after_noise_less() {
        let p = GenTrack2Parameters { blend_adaptation: 0.5, usual_correlation: 0.4, ..Default::default() };
        assert_eq!(Whiteness::default().trust(&p), Trust::NOMINAL);
        // After 50 pairs half of the difference counts: 1 + .5 * .5 * (1 - .4) and 1 + .5 * .5 * (-1 - .4).
        assert!((errors(1.0, 50).trust(&p).centre - 1.15).abs() < 1e-12);
        assert!((errors(-1.0, 50).trust(&p).centre - 0.65).abs() < 1e-12);
        // Sizes have errors of their own.
        assert!((errors(-1.0, 50).trust(&p).size - 1.15).abs() < 1e-12);
    }

    #[test]
    fn large_errors_do_not_count() {
        let mut whiteness = Whiteness::default();
        whiteness.learn(&State::new(0.0, 0.21, 0.0, 0.0), &State::new(0.0, 0.1, 0.0, 0.0));
        assert_eq!(whiteness.pairs, 0.0);
    }
}
