//! PSO guidance: moves a target's particles towards the mode of its state distribution.
//!
//! Kennedy and Eberhart's swarm: a particle keeps a share of its swarm velocity and is pulled towards its own best and
//! the swarm's best position, best by the fitness of eq. 4. All move before any is rated anew, so that what is done for
//! one is done for several at once.

use crate::appearance::{Descriptor, HogWorkspace, cosine};
use crate::geometry::State;

use super::fitness::{Social, Weights, appearance, motion, similarity};
use super::flight::{Columns, Flight};
use super::parameters::{GenTrack2Parameters, HistoryReference};
use super::particle_sampling::{noise_bound, velocity_bound};
use super::target::Target;

/// How far beyond the predicted box, in multiples of its size, a target's particles can be looked at.
pub const SEARCH_MARGIN: f64 = 1.6;

/// Buffers of the optimisation, shared by all targets.
#[derive(Default)]
pub struct Swarm {
    /// Descriptors of candidate boxes.
    pub hog: HogWorkspace,
    neighbours: Vec<(State, State)>,
    flight: Flight,
    ratings: Ratings,
    looks: Vec<Looks>,
}

/// What one particle looks like: its box, if it can be seen, and how that compares with the template and with itself
/// before its last move.
#[derive(Clone, Copy, Default)]
struct Looks {
    seen: Option<Descriptor>,
    with_history: Option<f64>,
    with_before: Option<f64>,
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
        self.flight.begin(&target.particles);

        let bound = velocity_bound(p, &target.state);
        let template = target.looks().filter(|_| looking).map(|looks| looks.recall().shape);
        let reference = reference(p, target, &bound, template);
        // Descriptors are large: none are set up where there is nothing to see.
        self.looks.clear();
        if reference.template.is_some() {
            self.looks.resize(target.particles.len(), Looks::default());
        }
        let mut best = 0;
        let mut best_rating = (f64::NEG_INFINITY, 0.0);
        for iteration in 0..=p.pso_iterations {
            if iteration > 0 {
                let size = (target.state.w, target.state.h);
                self.flight.advance(p, size, best, ticks, &bound, &mut target.random);
            }
            self.look(&reference);
            self.ratings.rate(&reference, &self.flight, &self.neighbours, &self.looks);
            for (index, own_best) in target.particles.iter_mut().enumerate() {
                let rating = self.ratings.total[index];
                if iteration == 0 || rating > own_best.fitness {
                    *own_best = self.flight.keep(index, rating);
                }
                if rating > best_rating.0 {
                    best = index;
                    best_rating = (rating, self.ratings.history[index]);
                }
            }
        }
        target.global_best = target.particles[best].state;
        target.looked_at = reference.template.is_some();
        target.global_fitness = if reference.template.is_some() { best_rating.1 } else { p.blind_fitness };
    }

    /// Compares what the particles look like, if there is something to look at.
    fn look(&mut self, reference: &Reference) {
        let Some(template) = &reference.template else { return };
        let scaled = |a: &Descriptor, b: &Descriptor| appearance(cosine(a, b) as f64, reference.hog_offset);
        for (index, looks) in self.looks.iter_mut().enumerate() {
            let mut descriptor = [0.0; _];
            let here = self.flight.state(index);
            let seen = self.hog.describe(&here.into(), &mut descriptor).then_some(descriptor);
            let with_history = seen.as_ref().map(|s| scaled(s, template));
            let mut with_before = seen.as_ref().zip(looks.seen.as_ref()).map(|(s, b)| scaled(s, b));
            if with_before.is_none() && seen.is_some() && self.flight.before(index) == here {
                with_before = Some(1.0);
            }
            *looks = Looks { seen, with_history, with_before };
        }
    }
}

/// Ratings of all particles of one target.
#[derive(Default)]
struct Ratings {
    /// The fitness.
    total: Vec<f64>,
    /// Its history term.
    history: Vec<f64>,
    exploration: Vec<f64>,
    distance: Vec<f64>,
    position: Vec<f64>,
    velocity: Vec<f64>,
}

impl Ratings {
    /// Eq. 4 for all; `looks` is empty where nothing is seen.
    fn rate(&mut self, reference: &Reference, flight: &Flight, neighbours: &[(State, State)], looks: &[Looks]) {
        let count = flight.len();
        for list in [&mut self.total, &mut self.history, &mut self.exploration, &mut self.distance] {
            list.resize(count, 0.0);
        }
        for sums in [&mut self.position, &mut self.velocity] {
            sums.clear();
            sums.resize(count, 0.0);
        }
        let limit = reference.distance_limit;
        flight.here.distances_to(&reference.state, &mut self.history);
        self.history.iter_mut().for_each(|x| *x = motion(*x, limit));
        flight.here.distances(&flight.before, &mut self.exploration);
        self.exploration.iter_mut().for_each(|x| *x = motion(*x, limit));
        let social = &reference.social;
        for (state, velocity) in neighbours {
            add_distances(&flight.here, state, social.position_limit, &mut self.distance, &mut self.position);
            add_distances(&flight.velocity, velocity, social.velocity_limit, &mut self.distance, &mut self.velocity);
        }
        for index in 0..count {
            let (with_history, with_before) =
                looks.get(index).map_or((None, None), |l| (l.with_history, l.with_before));
            let history = similarity(reference.lambda_s, with_history, self.history[index]);
            let exploration = similarity(reference.lambda_s, with_before, self.exploration[index]);
            let kept = social.fitness(self.position[index], self.velocity[index], neighbours.len());
            self.history[index] = history;
            self.total[index] = reference.weights.combine(history, exploration, kept);
        }
    }
}

/// Adds the distances to a point, up to a limit.
fn add_distances(from: &Columns, point: &State, limit: f64, distance: &mut [f64], sums: &mut [f64]) {
    from.distances_to(point, distance);
    sums.iter_mut().zip(distance).for_each(|(sum, d)| *sum += if *d < limit { *d } else { limit });
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
