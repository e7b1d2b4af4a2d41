//! Post-PSO resampling: what becomes of the particles of lowest fitness.

use super::parameters::{GenTrack2Parameters, Resampling};
use super::target::{Hypothesis, Target};

/// Replaces or drops the configured share of particles of lowest fitness. The best one always stays. Particles that
/// were dropped are filled up again at the next sampling.
pub fn resample(p: &GenTrack2Parameters, target: &mut Target) {
    let count = target.particles.len();
    let low = ((count as f64 * p.resampling_fraction) as usize).min(count.saturating_sub(1));
    if p.resampling == Resampling::None || low == 0 {
        return;
    }
    // Stable, so that equal fitness keeps the order of drawing.
    target.particles.sort_by(|a, b| b.fitness.total_cmp(&a.fitness));
    match p.resampling {
        Resampling::None => {}
        Resampling::Global => {
            let best = target.particles[0];
            target.particles[count - low..].fill(best);
        }
        Resampling::Discard => target.particles.truncate(count - low),
    }
}

/// Brings a set that lost particles back to its full number with copies of its best ones.
pub fn refill(target: &mut Target, count: usize) {
    let kept = target.particles.len();
    for index in kept..count {
        let copy: Hypothesis = target.particles[(index - kept) % kept];
        target.particles.push(copy);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Detection;

    fn target() -> Target {
        let mut target = Target::born(&Detection::new(0.0, 0.0, 10.0, 10.0, 0.9), 0, 4);
        for (particle, fitness) in target.particles.iter_mut().zip([0.2, 0.9, 0.1, 0.5]) {
            particle.fitness = fitness;
            particle.state.u = fitness;
        }
        target
    }

    fn fitness_after(resampling: Resampling, resampling_fraction: f64) -> Vec<f64> {
        let mut target = target();
        resample(&GenTrack2Parameters { resampling, resampling_fraction, ..Default::default() }, &mut target);
        target.particles.iter().map(|s| s.fitness).collect()
    }

    #[test]
    fn each_way_treats_the_low_half_as_named() {
        assert_eq!(fitness_after(Resampling::None, 0.5), [0.2, 0.9, 0.1, 0.5]);
        assert_eq!(fitness_after(Resampling::Global, 0.5), [0.9, 0.5, 0.9, 0.9]);
        assert_eq!(fitness_after(Resampling::Discard, 0.5), [0.9, 0.5]);
    }

    #[test]
    fn one_particle_always_stays() {
        assert_eq!(fitness_after(Resampling::Discard, 1.0), [0.9]);
    }

    #[test]
    fn a_thinned_set_is_refilled_from_its_best() {
        let mut target = target();
        resample(
            &GenTrack2Parameters { resampling: Resampling::Discard, resampling_fraction: 0.5, ..Default::default() },
            &mut target,
        );
        refill(&mut target, 5);
        let fitness: Vec<f64> = target.particles.iter().map(|s| s.fitness).collect();
        assert_eq!(fitness, [0.9, 0.5, 0.9, 0.5, 0.9]);
    }
}
