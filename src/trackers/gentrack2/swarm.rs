//! PSO guidance: moves a target's particles towards the mode of its state distribution.
//!
//! Kennedy and Eberhart's swarm: a particle keeps a share of its swarm velocity and is pulled towards its own best and
//! the swarm's best position, best by the fitness of eq. 4.

use crate::appearance::{Descriptor, HogWorkspace, cosine};
use crate::geometry::State;

use super::fitness::{Social, Weights, appearance, motion, similarity};
use super::parameters::{GenTrack2Parameters, HistoryReference};
use super::particle_sampling::{bounded, noise_bound, velocity_bound};
use super::target::{Hypothesis, Target};

/// How far beyond the predicted box, in multiples of its size, a target's particles can be looked at.
pub const SEARCH_MARGIN: f64 = 1.6;

/// Buffers of the optimisation, shared by all targets.
#[derive(Default)]
pub struct Swarm {
    /// Descriptors of candidate boxes.
    pub hog: HogWorkspace,
    neighbours: Vec<(State, State)>,
    motion: Vec<State>,
    current: Vec<Hypothesis>,
    descriptors: Vec<Option<Descriptor>>,
}

/// A particle's fitness and the history term of it.
#[derive(Clone, Copy)]
struct Rating {
    total: f64,
    history: f64,
}

/// What all particles of one target are compared with.
struct Reference {
    state: State,
    distance_limit: f64,
    template: Option<Descriptor>,
    social: Social,
    weights: Weights,
    lambda_s: f64,
    hog_offset: f64,
}

impl Swarm {
    /// Optimises the particles of a target in place and records its global best. `neighbours` are predicted states
    /// and velocities; `looking` says that `self.hog` holds the target's surroundings in this frame's image.
    pub fn guide(
        &mut self,
        p: &GenTrack2Parameters,
        target: &mut Target,
        neighbours: impl Iterator<Item = (State, State)>,
        ticks: f64,
        looking: bool,
    ) {
        self.neighbours.clear();
        self.neighbours.extend(neighbours);
        let count = target.particles.len();
        self.current.clear();
        self.current.extend_from_slice(&target.particles);
        self.motion.clear();
        self.motion.resize(count, State::default());
        self.descriptors.clear();
        self.descriptors.resize(count, None);

        let bound = velocity_bound(p, &target.state);
        let template = if looking && target.has_looks { Some(target.looks.shape) } else { None };
        let reference = reference(p, target, &bound, template);
        let mut best = (0, Rating { total: f64::NEG_INFINITY, history: 0.0 });
        for iteration in 0..=p.pso_iterations {
            for index in 0..count {
                let before = self.current[index].state;
                if iteration > 0 {
                    self.fly(p, target, index, best.0, ticks, &bound);
                }
                let rating = self.rate(&reference, index, &before);
                let own_best = &mut target.particles[index];
                if iteration == 0 || rating.total > own_best.fitness {
                    *own_best = Hypothesis { fitness: rating.total, ..self.current[index] };
                }
                if rating.total > best.1.total {
                    best = (index, rating);
                }
            }
        }
        target.global_best = target.particles[best.0].state;
        target.looked_at = reference.template.is_some();
        target.global_fitness = if reference.template.is_some() { best.1.history } else { p.blind_fitness };
    }

    /// One move of one particle.
    fn fly(
        &mut self,
        p: &GenTrack2Parameters,
        target: &mut Target,
        index: usize,
        best: usize,
        ticks: f64,
        bound: &State,
    ) {
        let here = self.current[index];
        let to_own = target.particles[index].state - here.state;
        let to_best = target.particles[best].state - here.state;
        let mut pull = |towards: f64, everyone: f64| {
            let (own, social) = target.random.unit_pair();
            p.pso_cognitive * own * towards + p.pso_social * social * everyone
        };
        let pulled = State::new(
            pull(to_own.u, to_best.u),
            pull(to_own.v, to_best.v),
            pull(to_own.w, to_best.w),
            pull(to_own.h, to_best.h),
        );
        let motion = self.motion[index] * p.pso_inertia + pulled;
        self.motion[index] = motion;
        let mut state = here.state + motion;
        // A box never turns inside out.
        state.w = state.w.max(0.1 * target.state.w);
        state.h = state.h.max(0.1 * target.state.h);
        // The particle got here faster, or slower, than its velocity said.
        let velocity = bounded(here.velocity + motion * (1.0 / ticks), bound);
        self.current[index] = Hypothesis { state, velocity, fitness: 0.0 };
    }

    fn rate(&mut self, reference: &Reference, index: usize, before: &State) -> Rating {
        let here = self.current[index];
        let (mut with_history, mut with_before) = (None, None);
        if let Some(template) = &reference.template {
            let mut descriptor = [0.0; _];
            let seen = self.hog.describe(&here.state.into(), &mut descriptor).then_some(descriptor);
            let scaled = |a: &Descriptor, b: &Descriptor| appearance(cosine(a, b) as f64, reference.hog_offset);
            with_history = seen.as_ref().map(|s| scaled(s, template));
            with_before = seen.as_ref().zip(self.descriptors[index].as_ref()).map(|(s, b)| scaled(s, b));
            if with_before.is_none() && seen.is_some() && *before == here.state {
                with_before = Some(1.0);
            }
            self.descriptors[index] = seen;
        }
        let compare = |appearance, other: &State| {
            similarity(reference.lambda_s, appearance, motion(&here.state, other, reference.distance_limit))
        };
        let history = compare(with_history, &reference.state);
        let exploration = compare(with_before, before);
        let social = reference.social.fitness(&here.state, &here.velocity, self.neighbours.iter());
        Rating { total: reference.weights.combine(history, exploration, social), history }
    }
}

fn reference(p: &GenTrack2Parameters, target: &Target, bound: &State, template: Option<Descriptor>) -> Reference {
    let diagonal = target.state.diagonal();
    let noise = noise_bound(p.velocity_noise, &target.state);
    Reference {
        state: match p.history_reference {
            HistoryReference::Predicted => target.predicted,
            HistoryReference::Previous => target.state,
        },
        distance_limit: p.fitness_distance * diagonal,
        template,
        social: Social {
            position_share: p.xi_p,
            position_limit: 2.0 * p.neighbour_radius * diagonal,
            velocity_limit: (*bound + noise).norm(),
        },
        weights: Weights::new(p),
        lambda_s: p.lambda_s,
        hog_offset: p.hog_offset,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Detection;

    fn target_with(particles: &[State]) -> Target {
        let mut target = Target::born(&Detection::new(80.0, 60.0, 40.0, 80.0, 0.9), 3, particles.len());
        for (particle, state) in target.particles.iter_mut().zip(particles) {
            particle.state = *state;
        }
        target
    }

    #[test]
    fn without_iterations_the_particles_stay_and_are_rated_by_equation_4() {
        let p = GenTrack2Parameters { pso_iterations: 0, ..Default::default() };
        // The box is 40 x 80 at (100, 100); its diagonal, the scale of f_m, is sqrt(8000) = 89.44.
        let mut target = target_with(&[State::new(100.0, 100.0, 40.0, 80.0), State::new(130.0, 140.0, 40.0, 80.0)]);
        Swarm::default().guide(&p, &mut target, std::iter::empty(), 1.0, false);
        // Particle 0: all terms 1. Particle 1: history 1 - 50/89.44 = .4410, exploration 1, social 1:
        // .5 * .4410 + .2 + .3 = .7205.
        assert_eq!(target.particles[0].fitness, 1.0);
        let expected = 0.5 * (1.0 - 50.0 / 8000f64.sqrt()) + 0.5;
        assert!((target.particles[1].fitness - expected).abs() < 1e-12);
        assert_eq!(target.global_best, target.particles[0].state);
        assert_eq!(target.particles[1].state, State::new(130.0, 140.0, 40.0, 80.0));
    }

    #[test]
    fn the_swarm_draws_together_around_the_mode() {
        let p = GenTrack2Parameters { pso_iterations: 20, ..Default::default() };
        let corners = [(80.0, 80.0), (120.0, 80.0), (80.0, 120.0), (120.0, 120.0), (101.0, 99.0)];
        let start: Vec<State> = corners.iter().map(|(u, v)| State::new(*u, *v, 40.0, 80.0)).collect();
        let mut target = target_with(&start);
        Swarm::default().guide(&p, &mut target, std::iter::empty(), 1.0, false);
        let mode = State::new(100.0, 100.0, 40.0, 80.0);
        let mean_distance =
            |states: &mut dyn Iterator<Item = State>| states.map(|s| s.distance(&mode)).sum::<f64>() / 5.0;
        let (before, after) =
            (mean_distance(&mut start.iter().copied()), mean_distance(&mut target.particles.iter().map(|s| s.state)));
        assert!(after < 0.3 * before, "mean distance to the mode {before} -> {after}");
        assert!(target.global_best.distance(&mode) <= start[4].distance(&mode));
    }

    #[test]
    fn neighbours_push_the_best_particle_away() {
        let p = GenTrack2Parameters { pso_iterations: 0, ..Default::default() };
        // Two particles equally far from the prediction, a neighbour on the right.
        let mut target = target_with(&[State::new(110.0, 100.0, 40.0, 80.0), State::new(90.0, 100.0, 40.0, 80.0)]);
        let neighbour = (State::new(150.0, 100.0, 40.0, 80.0), State::default());
        Swarm::default().guide(&p, &mut target, [neighbour].into_iter(), 1.0, false);
        assert_eq!(target.global_best.u, 90.0);
    }
}
