//! Particle sampling: the random motion model (eq. 3), with noise bounded by the box size.
//!
//! ```text
//! V_t = V_{t-1} + epsilon_V U_V
//! X_t = X_{t-1} + lambda_V V_t + lambda_X epsilon_X U_X
//! ```
//! per tick; a step of several ticks moves so many times as far and is so many times as uncertain.

use crate::geometry::State;
use crate::random::Random;

use super::parameters::{GenTrack2Parameters, ParticleSource};
use super::target::{Hypothesis, Target};

/// Noise of the size relative to that of the centre.
const SIZE_NOISE_SHARE: f64 = 0.25;
/// Smallest size of a particle relative to its target: noise may shrink a box but not invert it.
const SMALLEST_SIZE: f64 = 0.1;

/// Bounds of a target's velocity per tick, `V^max`.
pub fn velocity_bound(p: &GenTrack2Parameters, state: &State) -> State {
    let centre = p.max_velocity * state.w;
    State::new(centre, centre, p.max_size_velocity * state.w, p.max_size_velocity * state.h)
}

/// Clips a velocity to its bounds.
pub fn bounded(velocity: State, bound: &State) -> State {
    State::new(
        velocity.u.clamp(-bound.u, bound.u),
        velocity.v.clamp(-bound.v, bound.v),
        velocity.w.clamp(-bound.w, bound.w),
        velocity.h.clamp(-bound.h, bound.h),
    )
}

/// Bounds of a random perturbation of `share` box widths: `U^max`.
pub fn noise_bound(share: f64, state: &State) -> State {
    let centre = share * state.w;
    State::new(centre, centre, SIZE_NOISE_SHARE * share * state.w, SIZE_NOISE_SHARE * share * state.h)
}

/// `X_{t-1} + lambda_V V_{t-1}` over `ticks`; the size is left to detections.
pub fn predict(p: &GenTrack2Parameters, state: &State, velocity: &State, ticks: f64) -> State {
    let step = *velocity * (p.velocity_gain * ticks);
    State::new(
        state.u + step.u,
        state.v + step.v,
        at_least(state.w + step.w, state.w),
        at_least(state.h + step.h, state.h),
    )
}

/// Draws the particles of a target for this frame.
pub fn sample(p: &GenTrack2Parameters, target: &mut Target, ticks: f64) {
    if p.particle_source == ParticleSource::PriorParticles {
        anchor_prior(p, target);
    }
    let bound = velocity_bound(p, &target.state);
    let state_noise = noise_bound(p.state_noise * p.noise_gain, &target.state);
    let velocity_noise = noise_bound(p.velocity_noise, &target.state);
    let count = target.particles.len();
    let mut drawn = (State::default(), State::default());
    for index in 0..count {
        let (dx, dv) = if p.antithetic {
            // Particle 0 is the prediction; 1 and 2, 3 and 4, ... mirror each other; a left-over one is the prediction.
            match index {
                0 => Default::default(),
                i if i % 2 == 0 => (drawn.0 * -1.0, drawn.1 * -1.0),
                i if i + 1 == count => Default::default(),
                _ => {
                    drawn = draw(&mut target.random, &state_noise, &velocity_noise);
                    drawn
                }
            }
        } else {
            draw(&mut target.random, &state_noise, &velocity_noise)
        };
        let (from, velocity) = match p.particle_source {
            ParticleSource::OptimalState => (target.state, target.velocity),
            ParticleSource::PriorParticles => (target.particles[index].state, target.particles[index].velocity),
        };
        let velocity = bounded(velocity + dv * ticks, &bound);
        let moved = predict(p, &from, &velocity, ticks) + dx * ticks;
        let state = State::new(moved.u, moved.v, at_least(moved.w, target.state.w), at_least(moved.h, target.state.h));
        target.particles[index] = Hypothesis { state, velocity, fitness: 0.0 };
    }
}

/// Moves the prior particles so that their mean is the target's state and velocity, and draws them together: random
/// motion of every particle would let them diverge.
fn anchor_prior(p: &GenTrack2Parameters, target: &mut Target) {
    if p.prior_spread >= 1.0 {
        return;
    }
    let share = 1.0 / target.particles.len() as f64;
    let (state, velocity) = target
        .particles
        .iter()
        .fold((State::default(), State::default()), |(x, v), s| (x + s.state * share, v + s.velocity * share));
    for particle in &mut target.particles {
        particle.state = target.state + (particle.state - state) * p.prior_spread;
        particle.velocity = target.velocity + (particle.velocity - velocity) * p.prior_spread;
    }
}

fn draw(random: &mut Random, state: &State, velocity: &State) -> (State, State) {
    (draw_within(random, state), draw_within(random, velocity))
}

fn draw_within(random: &mut Random, bound: &State) -> State {
    let u = random.symmetric(bound.u);
    let v = random.symmetric(bound.v);
    let w = random.symmetric(bound.w);
    let h = random.symmetric(bound.h);
    State::new(u, v, w, h)
}

fn at_least(size: f64, reference: f64) -> f64 {
    size.max(SMALLEST_SIZE * reference)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Detection;

    fn target(velocity: State, particles: usize) -> Target {
        // Centre (120, 240), 40 x 80.
        let mut target = Target::born(&Detection::new(100.0, 200.0, 40.0, 80.0, 0.9), 5, particles);
        target.velocity = velocity;
        target
    }

    #[test]
    fn equation_3_without_noise_is_the_prediction() {
        let p = GenTrack2Parameters { state_noise: 0.0, velocity_noise: 0.0, ..Default::default() };
        let mut target = target(State::new(3.0, -2.0, 0.0, 0.0), 8);
        sample(&p, &mut target, 2.0);
        // 120 + 2 * 3 = 126, 240 - 2 * 2 = 236.
        for particle in &target.particles {
            assert_eq!(particle.state, State::new(126.0, 236.0, 40.0, 80.0));
            assert_eq!(particle.velocity, State::new(3.0, -2.0, 0.0, 0.0));
        }
    }

    #[test]
    fn noise_stays_within_the_bounds_of_the_box() {
        let p = GenTrack2Parameters { state_noise: 0.1, velocity_noise: 0.05, antithetic: false, ..Default::default() };
        let mut target = target(State::default(), 256);
        sample(&p, &mut target, 1.0);
        for particle in &target.particles {
            // U_V^max = .05 * 40 = 2 px/tick and U_X^max = .1 * 40 = 4 px: together at most 6 px.
            let d = particle.state - State::new(120.0, 240.0, 40.0, 80.0);
            assert!(particle.velocity.u.abs() <= 2.0 && particle.velocity.v.abs() <= 2.0);
            assert!(d.u.abs() <= 6.0 && d.v.abs() <= 6.0);
            // Sizes: a quarter of the share, of 40 and of 80 px: (.1 + .05) / 4 * 40 = 1.5, * 80 = 3.
            assert!(d.w.abs() <= 1.5 && d.h.abs() <= 3.0);
        }
        let widest = target.particles.iter().map(|s| (s.state.u - 120.0).abs()).fold(0.0, f64::max);
        assert!(widest > 3.0, "256 draws reach well into the bounds, not {widest}");
    }

    #[test]
    fn velocities_are_clipped_to_v_max() {
        let p = GenTrack2Parameters { state_noise: 0.0, velocity_noise: 0.0, ..Default::default() };
        let mut target = target(State::new(500.0, -500.0, 50.0, -50.0), 1);
        sample(&p, &mut target, 1.0);
        // V^max = (.5 * 40, .5 * 40, .05 * 40, .05 * 80).
        assert_eq!(target.particles[0].velocity, State::new(20.0, -20.0, 2.0, -4.0));
    }

    #[test]
    fn antithetic_draws_leave_the_mean_at_the_prediction() {
        let p = GenTrack2Parameters { state_noise: 0.2, ..Default::default() };
        for count in [1, 2, 7, 8] {
            let mut target = target(State::new(1.0, 0.0, 0.0, 0.0), count);
            sample(&p, &mut target, 1.0);
            let mean: f64 = target.particles.iter().map(|s| s.state.u).sum::<f64>() / count as f64;
            assert!((mean - 121.0).abs() < 1e-9, "{count}: {mean}");
            assert_eq!(target.particles[0].state.u, 121.0);
        }
    }

    #[test]
    fn prior_particles_are_anchored_on_the_optimal_state() {
        let p = GenTrack2Parameters {
            particle_source: ParticleSource::PriorParticles,
            prior_spread: 0.5,
            state_noise: 0.0,
            velocity_noise: 0.0,
            ..Default::default()
        };
        let mut target = target(State::default(), 2);
        target.particles[0].state = State::new(90.0, 240.0, 40.0, 80.0);
        target.particles[1].state = State::new(110.0, 240.0, 40.0, 80.0);
        sample(&p, &mut target, 1.0);
        // Mean 100, deviations -10 and +10, halved about the state's 120.
        assert_eq!(target.particles[0].state.u, 115.0);
        assert_eq!(target.particles[1].state.u, 125.0);
    }
}
