//! What guided the weak tracks of a step, kept for whoever asks.

use std::ops::Range;

use crate::buffers::{self, make_room};
use crate::track::{NeighbourMotion, Neighbourhood, WeakMove};

use super::TICKS_PER_SECOND;
use super::target::Target;
use super::weak_motion::Trusted;

/// The neighbourhoods of a step's weak tracks, in one flat list.
#[derive(Clone, Debug, Default)]
pub struct Neighbourhoods {
    rows: Vec<Row>,
    ids: Vec<u64>,
}

#[derive(Clone, Debug)]
struct Row {
    owner: u64,
    ids: Range<usize>,
    trusted: usize,
    motion: Option<NeighbourMotion>,
    rule: WeakMove,
}

impl Neighbourhoods {
    /// Forgets the last step.
    pub fn clear(&mut self) {
        self.rows.clear();
        self.ids.clear();
    }

    /// Keeps what moved the weak track `index`; their indices ascend.
    pub fn note(
        &mut self,
        targets: &[Target],
        index: usize,
        neighbours: &[u32],
        trusted: Option<&Trusted>,
        rule: WeakMove,
    ) {
        let of_kind = |strong: bool| {
            let all = neighbours.iter().map(|j| &targets[*j as usize]);
            all.filter(move |t| t.is_strong() == strong).map(|t| t.life.id)
        };
        let start = self.ids.len();
        make_room(&mut self.ids, start + neighbours.len());
        self.ids.extend(of_kind(true));
        let trusted_count = self.ids.len() - start;
        self.ids.extend(of_kind(false));
        let row = Row {
            owner: targets[index].life.id,
            ids: start..self.ids.len(),
            trusted: trusted_count,
            motion: trusted.map(|t| NeighbourMotion {
                centre: t.position,
                displacement: t.displacement,
                velocity: (t.velocity.0 * TICKS_PER_SECOND, t.velocity.1 * TICKS_PER_SECOND),
            }),
            rule,
        };
        buffers::push(&mut self.rows, row);
    }

    /// What moved the track `id`; empty for one that was not noted.
    pub fn of(&self, id: u64) -> Neighbourhood<'_> {
        let Ok(at) = self.rows.binary_search_by_key(&id, |row| row.owner) else { return Neighbourhood::default() };
        let Row { ids, trusted, motion, rule, .. } = &self.rows[at];
        Neighbourhood { neighbours: &self.ids[ids.clone()], trusted: *trusted, motion: *motion, rule: *rule }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Detection;
    use crate::trackers::gentrack2::target::Match;

    #[test]
    fn trustworthy_neighbours_come_first_and_velocities_are_per_second() {
        let mut targets: Vec<Target> =
            (0..4).map(|k| Target::born(&Detection::new(20.0 * k as f64, 0.0, 10.0, 20.0, 0.9), 0, 1)).collect();
        for (target, id) in targets.iter_mut().zip(11..) {
            target.life.id = id;
        }
        (targets[0].matched, targets[1].matched) = (Match::None, Match::None);
        let trusted = Trusted { position: (55.0, 10.0), displacement: (1.0, 2.0), velocity: (3.0, 4.0) };
        let mut all = Neighbourhoods::default();
        all.note(&targets, 0, &[1, 2, 3], Some(&trusted), WeakMove::WithNeighbours);
        all.note(&targets, 1, &[0], None, WeakMove::Own);
        let motion = NeighbourMotion { centre: (55.0, 10.0), displacement: (1.0, 2.0), velocity: (90.0, 120.0) };
        let expected = Neighbourhood {
            neighbours: &[13, 14, 12],
            trusted: 2,
            motion: Some(motion),
            rule: WeakMove::WithNeighbours,
        };
        assert_eq!(all.of(11), expected);
        assert_eq!(all.of(12), Neighbourhood { neighbours: &[11], rule: WeakMove::Own, ..Default::default() });
        assert_eq!(all.of(13), Neighbourhood::default());
        all.clear();
        assert_eq!(all.of(11), Neighbourhood::default());
    }
}
