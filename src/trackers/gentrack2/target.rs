//! One target: the tracklet `{K, X, V, X^pen, X^age}` of the paper and what is kept with it.

use crate::embedding::MeanEmbedding;
use crate::frame::{CameraMotion, Detection};
use crate::geometry::State;
use crate::random::Random;

use crate::trackers::life::Life;

use super::appearance_model::{LearntLooks, Looks};
use super::history::History;
use super::residual::Residual;

/// A particle: a hypothesis of the target's state, `{X^s, V^s}`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct Hypothesis {
    /// State in pixels.
    pub state: State,
    /// Velocity in pixels per tick.
    pub velocity: State,
    /// Fitness (eq. 4) after the swarm optimisation.
    pub fitness: f64,
}

/// What a track's detection of this frame was.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub enum Match {
    /// None.
    #[default]
    None,
    /// The association gave it this one of the frame's [`super::observations::Observations`].
    Detection(u32),
    /// It was born from this one.
    Birth(u32),
}

impl Match {
    /// Index of the observation.
    pub fn index(self) -> Option<usize> {
        match self {
            Match::None => None,
            Match::Detection(index) | Match::Birth(index) => Some(index as usize),
        }
    }
}

/// A target.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct Target {
    /// Identity `K`, ages, and the detection last taken.
    pub life: Life,
    /// State `X_t`; during a step, until its update, `X_{t-1}` in this frame's coordinates.
    pub state: State,
    /// `X_{t-1}` in this frame's coordinates.
    pub previous: State,
    /// `X_{t-1} + V_{t-1}`.
    pub predicted: State,
    /// Velocity `V` in pixels per tick.
    pub velocity: State,
    /// Penalty `X^pen` in `[0, 1]`.
    pub penalty: f64,
    /// Age `X^age` in ticks.
    pub age: f64,
    /// Time without a match in ticks.
    pub missed: f64,
    /// The same at the pace of [`super::ageing::pace`]: the paper's `l`.
    pub blamed: f64,
    /// The largest share of its box that another, seen target covered since the last match.
    pub covered: f64,
    /// Frames without a match on which the detector ran.
    pub missed_frames: u32,
    /// Whether it was given up, and is kept for its looks alone.
    pub dormant: bool,
    /// Whether the track is trusted.
    pub confirmed: bool,
    /// Whether the track was reported in the last step.
    pub reported: bool,
    /// The detection of this frame.
    pub matched: Match,
    /// Observed states.
    pub history: History,
    /// How well its motion is predicted.
    pub residual: Residual,
    /// What the last prediction missed by, in box diagonals, if it met a detection.
    pub last_error: Option<State>,
    /// What speaks for the track: scores of its detections above `evidence_score`, added up.
    pub evidence: f64,
    /// Running mean of its detections' scores.
    pub mean_score: f64,
    /// The particles.
    pub particles: Vec<Hypothesis>,
    /// State of the swarm's global best, `X_g`.
    pub global_best: State,
    /// History fitness of the global best, `f_g,PSO^h`.
    pub global_fitness: f64,
    /// Whether the swarm of this frame could compare looks.
    pub looked_at: bool,
    /// Memory for looks, from when the first image came.
    looks: Option<Box<LearntLooks>>,
    /// Whether its looks are known.
    has_looks: bool,
    /// Embedding learnt from strong updates.
    pub embedding: MeanEmbedding,
    /// Its own random numbers: they do not depend on the other targets.
    pub random: Random,
}

impl Target {
    /// An empty shell, to be filled by [`Target::begin`].
    pub fn blank() -> Self {
        Self {
            life: Life::default(),
            state: State::default(),
            previous: State::default(),
            predicted: State::default(),
            velocity: State::default(),
            penalty: 0.0,
            age: 0.0,
            missed: 0.0,
            blamed: 0.0,
            covered: 0.0,
            missed_frames: 0,
            dormant: false,
            confirmed: false,
            reported: false,
            matched: Match::None,
            history: History::default(),
            residual: Residual::default(),
            last_error: None,
            evidence: 0.0,
            mean_score: 0.0,
            particles: Vec::new(),
            global_best: State::default(),
            global_fitness: 1.0,
            looked_at: false,
            looks: None,
            has_looks: false,
            embedding: MeanEmbedding::default(),
            random: Random::new(0, 0),
        }
    }

    /// A target that was just born, for tests.
    #[cfg(test)]
    pub fn born(detection: &Detection, seed: u64, particles: usize) -> Self {
        let mut target = Self::blank();
        target.begin(Life::begin(1, 0, detection), 0, seed, particles);
        target
    }

    /// Starts a life at the observation `index`, keeping the buffers of an earlier one.
    pub fn begin(&mut self, life: Life, index: u32, seed: u64, particles: usize) {
        let state = State::from(life.last.rect);
        self.random = Random::new(seed, life.id);
        self.mean_score = life.last.score;
        self.life = life;
        self.state = state;
        self.previous = state;
        self.predicted = state;
        self.velocity = State::default();
        self.penalty = 0.0;
        self.age = 0.0;
        self.missed = 0.0;
        self.blamed = 0.0;
        self.covered = 0.0;
        self.missed_frames = 0;
        self.dormant = false;
        self.confirmed = false;
        self.reported = false;
        self.matched = Match::Birth(index);
        self.history.clear();
        self.residual = Residual::default();
        self.last_error = None;
        self.evidence = 0.0;
        self.particles.clear();
        self.particles.resize(particles, Hypothesis { state, velocity: State::default(), fitness: 1.0 });
        self.global_best = state;
        self.global_fitness = 1.0;
        self.looked_at = false;
        self.has_looks = false;
        self.embedding.clear();
    }

    /// What it looks like, learnt from strong updates.
    pub fn looks(&self) -> Option<&LearntLooks> {
        self.looks.as_deref().filter(|_| self.has_looks)
    }

    /// Whether it is known what it looks like.
    pub fn has_looks(&self) -> bool {
        self.looks().is_some()
    }

    /// Learns what it looks like; `momentum` is the share of what was known.
    pub fn learn_looks(&mut self, seen: &Looks, momentum: f64) {
        match &mut self.looks {
            Some(looks) if self.has_looks => looks.blend(seen, momentum),
            Some(looks) => **looks = LearntLooks::new(seen),
            none => *none = Some(Box::new(LearntLooks::new(seen))),
        }
        self.has_looks = true;
    }

    /// Forgets what it looks like.
    #[cfg(test)]
    pub fn forget_looks(&mut self) {
        self.has_looks = false;
    }

    /// Puts a target at a detection where its motion did not lead: what was known of it is forgotten.
    pub fn restart_motion(&mut self, detection: &Detection, index: u32) {
        self.matched = Match::Detection(index);
        self.state = State::from(detection.rect);
        self.previous = self.state;
        self.predicted = self.state;
        self.history.clear();
    }

    /// Whether a detection was taken in this frame: a strong (or new) track.
    pub fn is_strong(&self) -> bool {
        self.matched != Match::None
    }

    /// Whether enough detections were taken to tell how it moves: two boxes' jitter looks like speed.
    pub fn motion_is_known(&self) -> bool {
        self.life.hits > 2
    }

    /// Moves everything that is in image coordinates along with the camera.
    pub fn follow_camera(&mut self, motion: &CameraMotion) {
        self.state = motion.apply_state(&self.state);
        self.velocity = motion.apply_velocity(&self.velocity);
        self.history.follow_camera(motion);
        for particle in &mut self.particles {
            particle.state = motion.apply_state(&particle.state);
            particle.velocity = motion.apply_velocity(&particle.velocity);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_in_pixels_follows_the_camera() {
        // Twice as large, turned by 90 degrees: (x, y) goes to (-2 y + 7, 2 x + 5).
        let motion = CameraMotion([0.0, -2.0, 7.0, 2.0, 0.0, 5.0]);
        let before = State::new(10.0, 20.0, 4.0, 6.0);
        let mut target = Target::born(&Detection { rect: before.into(), score: 0.9, ..Default::default() }, 0, 2);
        target.velocity = State::new(1.0, 3.0, 0.5, 0.25);
        target.particles[1].velocity = target.velocity;
        target.history.push(3.0, &before, 1);
        target.follow_camera(&motion);
        let centre = |s: &State| (s.u, s.v);
        assert_eq!(centre(&target.state), (-33.0, 25.0));
        assert_eq!(centre(&target.velocity), (-6.0, 2.0));
        assert_eq!(target.history.last(), Some(target.state));
        assert_eq!(centre(&target.particles[1].state), (-33.0, 25.0));
        assert_eq!(centre(&target.particles[1].velocity), (-6.0, 2.0));
        // Sizes grow with the columns of the map, whichever way it turns.
        assert_eq!((target.state.w, target.state.h), (8.0, 12.0));
    }
}
