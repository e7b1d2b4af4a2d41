//! The particles as callers see them, made when one asks for them: most never do, and they take a good part of a track's
//! memory.

use std::ops::Range;
use std::sync::{Mutex, OnceLock, PoisonError};

use crate::buffers::make_room;
use crate::geometry::Rect;
use crate::track::Particle;

use super::TICKS_PER_SECOND;
use super::target::Target;

/// The particles of all targets after a step.
#[derive(Default)]
pub struct LentParticles {
    list: OnceLock<List>,
    /// The list of an earlier step, whose memory serves again.
    spare: Mutex<List>,
}

#[derive(Default)]
struct List {
    owners: Vec<(u64, Range<usize>)>,
    particles: Vec<Particle>,
}

impl LentParticles {
    /// Forgets what was asked for: the targets are about to change.
    pub fn recall(&mut self) {
        if let Some(list) = self.list.take() {
            self.spare = Mutex::new(list);
        }
    }

    /// The particles of the target `id`, of targets by ascending identity that have not changed since the last
    /// [`LentParticles::recall`].
    pub fn of(&self, id: u64, targets: &[Target]) -> &[Particle] {
        let list = self.list.get_or_init(|| {
            let mut list = std::mem::take(&mut *self.spare.lock().unwrap_or_else(PoisonError::into_inner));
            list.fill(targets);
            list
        });
        match list.owners.binary_search_by_key(&id, |(owner, _)| *owner) {
            Ok(at) => &list.particles[list.owners[at].1.clone()],
            Err(_) => &[],
        }
    }
}

impl List {
    fn fill(&mut self, targets: &[Target]) {
        self.owners.clear();
        self.particles.clear();
        make_room(&mut self.owners, targets.len());
        make_room(&mut self.particles, targets.iter().map(|t| t.particles.len()).sum());
        for target in targets {
            let start = self.particles.len();
            self.particles.extend(target.particles.iter().map(|s| Particle {
                rect: Rect::from(s.state),
                velocity: s.velocity * TICKS_PER_SECOND,
                fitness: s.fitness,
            }));
            self.owners.push((target.life.id, start..self.particles.len()));
        }
    }
}
