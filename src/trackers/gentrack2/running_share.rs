//! How often something was so lately, in a scene: a share that forgets, and that begins with what is assumed.

/// Share of the evidence that is kept per tick.
const MEMORY: f64 = 0.999;

/// Evidence for and against.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct RunningShare {
    so: f64,
    total: f64,
}

impl RunningShare {
    /// Forgets a little.
    pub fn decay(&mut self, ticks: f64) {
        let kept = libm::pow(MEMORY, ticks);
        self.so *= kept;
        self.total *= kept;
    }

    /// Learns from evidence of some weight, which is `so` or not.
    pub fn learn(&mut self, weight: f64, so: bool) {
        self.total += weight;
        self.so += if so { weight } else { 0.0 };
    }

    /// The share, of what was learnt and evidence of the weight `prior` that is assumed to be so by the share `assumed`.
    pub fn value(&self, prior: f64, assumed: f64) -> f64 {
        (prior * assumed + self.so) / (prior + self.total)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_learnt_outweighs_what_is_assumed_until_it_is_forgotten() {
        let mut share = RunningShare::default();
        assert_eq!(share.value(10.0, 0.65), 0.65);
        share.learn(5.0, true);
        share.learn(10.0, false);
        // (6.5 + 5) / (10 + 15).
        assert_eq!(share.value(10.0, 0.65), 0.46);
        // Half of it in 693 ticks: (6.5 + 2.5) / (10 + 7.5).
        share.decay(0.5f64.ln() / MEMORY.ln());
        assert!((share.value(10.0, 0.65) - 9.0 / 17.5).abs() < 1e-12);
        share.decay(1e6);
        assert_eq!(share.value(10.0, 0.65), 0.65);
    }
}
