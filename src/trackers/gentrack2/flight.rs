//! The flight of a target's particles: where each is, was before its last move, and flies to. Column by column, for loops
//! over particles are what a compiler can do for several at once.

use crate::geometry::State;
use crate::random::Random;

use super::parameters::GenTrack2Parameters;
use super::target::Hypothesis;

/// Smallest size of a particle relative to its target: a box never turns inside out.
const SMALLEST_SIZE: f64 = 0.1;

/// One component of all particles.
type Column = Vec<f64>;

/// States or velocities of all particles.
#[derive(Clone, Debug, Default)]
pub struct Columns([Column; 4]);

impl Columns {
    fn fill(&mut self, states: impl Iterator<Item = State> + Clone) {
        let components: [fn(&State) -> f64; 4] = [|s| s.u, |s| s.v, |s| s.w, |s| s.h];
        for (column, component) in self.0.iter_mut().zip(components) {
            column.clear();
            column.extend(states.clone().map(|s| component(&s)));
        }
    }

    fn get(&self, index: usize) -> State {
        let [u, v, w, h] = &self.0;
        State::new(u[index], v[index], w[index], h[index])
    }

    /// Distance of every one to a point, in `out`, which has the right length.
    pub fn distances_to(&self, point: &State, out: &mut [f64]) {
        let [u, v, w, h] = self.0.each_ref().map(|column| &column[..out.len()]);
        for (index, out) in out.iter_mut().enumerate() {
            *out = State::new(u[index] - point.u, v[index] - point.v, w[index] - point.w, h[index] - point.h).norm();
        }
    }

    /// Distance of every one to its counterpart.
    pub fn distances(&self, other: &Columns, out: &mut [f64]) {
        let [u, v, w, h] = self.0.each_ref().map(|column| &column[..out.len()]);
        let [a, b, c, d] = other.0.each_ref().map(|column| &column[..out.len()]);
        for (i, out) in out.iter_mut().enumerate() {
            *out = State::new(u[i] - a[i], v[i] - b[i], w[i] - c[i], h[i] - d[i]).norm();
        }
    }
}

/// All particles of one target in flight.
#[derive(Clone, Debug, Default)]
pub struct Flight {
    /// Where they are.
    pub here: Columns,
    /// Where they were before the last move.
    pub before: Columns,
    /// Their velocities.
    pub velocity: Columns,
    /// Where each was best.
    best: Columns,
    /// Their swarm velocities.
    motion: Columns,
    own_pull: Column,
    social_pull: Column,
}

impl Flight {
    /// Starts where the particles are.
    pub fn begin(&mut self, particles: &[Hypothesis]) {
        self.here.fill(particles.iter().map(|s| s.state));
        self.before.fill(particles.iter().map(|s| s.state));
        self.best.fill(particles.iter().map(|s| s.state));
        self.velocity.fill(particles.iter().map(|s| s.velocity));
        self.motion.fill(particles.iter().map(|_| State::default()));
    }

    /// Remembers that a particle was never better than here.
    pub fn keep(&mut self, index: usize, fitness: f64) -> Hypothesis {
        for (best, here) in self.best.0.iter_mut().zip(&self.here.0) {
            best[index] = here[index];
        }
        Hypothesis { state: self.here.get(index), velocity: self.velocity.get(index), fitness }
    }

    /// How many particles fly.
    pub fn len(&self) -> usize {
        self.here.0[0].len()
    }

    /// Where a particle is.
    pub fn state(&self, index: usize) -> State {
        self.here.get(index)
    }

    /// Where a particle was before its last move.
    pub fn before(&self, index: usize) -> State {
        self.before.get(index)
    }

    /// One move of all: each towards its own best and that of the leader.
    pub fn advance(
        &mut self,
        p: &GenTrack2Parameters,
        size: (f64, f64),
        leader: usize,
        ticks: f64,
        bound: &State,
        random: &mut Random,
    ) {
        let bound = [bound.u, bound.v, bound.w, bound.h];
        let least = [f64::NEG_INFINITY, f64::NEG_INFINITY, SMALLEST_SIZE * size.0, SMALLEST_SIZE * size.1];
        let per_tick = 1.0 / ticks;
        for i in 0..4 {
            self.draw(p, random);
            let count = self.here.0[i].len();
            let (here, before) = (&mut self.here.0[i][..count], &mut self.before.0[i][..count]);
            let (motion, velocity) = (&mut self.motion.0[i][..count], &mut self.velocity.0[i][..count]);
            let (best, own, social) = (&self.best.0[i][..count], &self.own_pull[..count], &self.social_pull[..count]);
            let (leader, least, bound) = (best[leader], least[i], bound[i]);
            for k in 0..count {
                let moved = motion[k] * p.pso_inertia + (own[k] * (best[k] - here[k]) + social[k] * (leader - here[k]));
                motion[k] = moved;
                before[k] = here[k];
                here[k] = at_least(here[k] + moved, least);
                // The particle got here faster, or slower, than its velocity said.
                velocity[k] = at_most(at_least(velocity[k] + moved * per_tick, -bound), bound);
            }
        }
    }

    /// Draws the pulls on one component of all particles.
    fn draw(&mut self, p: &GenTrack2Parameters, random: &mut Random) {
        let count = self.here.0[0].len();
        self.own_pull.clear();
        self.social_pull.clear();
        while self.own_pull.len() < count {
            let [a, b, c, d] = random.unit_quad();
            self.own_pull.extend([p.pso_cognitive * a, p.pso_cognitive * b]);
            self.social_pull.extend([p.pso_social * c, p.pso_social * d]);
        }
    }
}

/// As `max` and `min`, but that they need not care for numbers that are none.
fn at_least(x: f64, least: f64) -> f64 {
    if x < least { least } else { x }
}

fn at_most(x: f64, most: f64) -> f64 {
    if x > most { most } else { x }
}
