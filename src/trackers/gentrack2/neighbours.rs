//! Neighbour search `Psi<(K, X), epsilon_nei>`: the targets within a distance that adapts to the size of the box.

use crate::buffers;
use crate::candidates::OverlapSweep;
use crate::geometry::{Rect, State};

/// For each target the indices of its neighbours, in one flat list.
#[derive(Clone, Debug, Default)]
pub struct Neighbours {
    first: Vec<u32>,
    list: Vec<u32>,
}

/// Half the side of the box that stands for a point in the sweep, in pixels.
const POINT: f64 = 0.5;

impl Neighbours {
    /// Finds for each state with `wanted` the others within `radius` diagonals of its own box, by the distance over
    /// all four components. The others get an empty list.
    pub fn search(&mut self, sweep: &mut OverlapSweep, states: &[State], radius: f64, wanted: impl Fn(usize) -> bool) {
        let square = |s: &State, half: f64| Rect::new(s.u - half, s.v - half, 2.0 * half, 2.0 * half);
        let areas = states.iter().enumerate().map(|(i, s)| match wanted(i) {
            true => square(s, radius * s.diagonal() + POINT),
            false => Rect::default(),
        });
        let pairs = sweep.between(areas, states.iter().map(|s| square(s, POINT))).pairs;
        self.first.clear();
        self.list.clear();
        let mut at = 0;
        for (i, state) in states.iter().enumerate() {
            buffers::push(&mut self.first, self.list.len() as u32);
            let limit = radius * state.diagonal();
            while let Some(&(_, j)) = pairs.get(at).filter(|(row, _)| *row as usize == i) {
                if j as usize != i && state.distance(&states[j as usize]) < limit {
                    buffers::push(&mut self.list, j);
                }
                at += 1;
            }
        }
        buffers::push(&mut self.first, self.list.len() as u32);
    }

    /// The neighbours of target `index`, ascending.
    pub fn of(&self, index: usize) -> &[u32] {
        &self.list[self.first[index] as usize..self.first[index + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_radius_adapts_to_the_size_of_the_box() {
        // Diagonals 50 (30 x 40) and 100 (60 x 80); distances: 0-1: sqrt(40^2 + 30^2 + 40^2) = 64.03; 0-2: 49 and
        // 51 around target 0's radius.
        let small = State::new(0.0, 0.0, 30.0, 40.0);
        let states = [
            small,
            State::new(40.0, 0.0, 60.0, 80.0),
            State::new(0.0, -49.0, 30.0, 40.0),
            State::new(-51.0, 0.0, 30.0, 40.0),
        ];
        let mut neighbours = Neighbours::default();
        neighbours.search(&mut OverlapSweep::default(), &states, 1.0, |_| true);
        // 0 sees 2 (49 < 50), not 1 (64) and not 3 (51); 1 sees 0 (64 < 100) and 2 (sqrt(40^2+49^2+30^2+40^2) = 80.6);
        // and 3 at sqrt(91^2+30^2+40^2) = 103.8 not.
        assert_eq!(neighbours.of(0), [2]);
        assert_eq!(neighbours.of(1), [0, 2]);
        assert_eq!(neighbours.of(2), [0]);
        assert_eq!(neighbours.of(3), [0u32; 0]);
    }

    #[test]
    fn the_expanded_search_finds_more_and_only_for_those_who_ask() {
        let states = [State::new(0.0, 0.0, 30.0, 40.0), State::new(60.0, 0.0, 30.0, 40.0)];
        let mut neighbours = Neighbours::default();
        neighbours.search(&mut OverlapSweep::default(), &states, 1.0, |_| true);
        assert!(neighbours.of(0).is_empty());
        neighbours.search(&mut OverlapSweep::default(), &states, 2.0, |i| i == 0);
        assert_eq!(neighbours.of(0), [1]);
        assert!(neighbours.of(1).is_empty());
    }
}
