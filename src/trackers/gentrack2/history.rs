//! The states in which detections confirmed a target: what velocity is regressed from, and where it was last seen.
//!
//! They are most of what a track takes, so they are kept in single precision, as offsets from a place near by: however far
//! from the origin of coordinates a scene is, and wherever target and camera go, they are as exact.

use std::collections::VecDeque;

use crate::frame::CameraMotion;
use crate::geometry::State;

/// A confirmed state, in the coordinates of the current frame.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct Observation {
    /// Ticks since the one before.
    pub since: f32,
    /// Centre from the history's origin, width and height, in pixels.
    pub state: [f32; 4],
}

/// Diagonals of the box that a state may be from the origin: so far offsets are exact to a millionth of the box.
const FARTHEST: f64 = 64.0;

/// Observations, oldest first.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct History {
    list: VecDeque<Observation>,
    /// What offsets are from: the centre of one of the states, moved along with the camera.
    origin: (f64, f64),
    /// Time of the last one in ticks.
    time: f64,
}

impl History {
    /// Adds a state, and forgets the oldest beyond so many.
    pub fn push(&mut self, time: f64, state: &State, most: usize) {
        while self.list.len() >= most {
            self.list.pop_front();
        }
        if self.list.is_empty() {
            (self.origin, self.time) = ((state.u, state.v), time);
        }
        // To the last one, not to the next power of two.
        self.list.reserve_exact(most - self.list.len());
        let (u, v) = (state.u - self.origin.0, state.v - self.origin.1);
        if u.abs().max(v.abs()) > FARTHEST * state.diagonal() {
            self.move_origin(state);
        }
        let (u, v) = (state.u - self.origin.0, state.v - self.origin.1);
        let state = [u, v, state.w, state.h].map(|x| x as f32);
        self.list.push_back(Observation { since: (time - self.time) as f32, state });
        self.time = time;
    }

    fn move_origin(&mut self, to: &State) {
        for Observation { state: [u, v, ..], .. } in &mut self.list {
            *u = (f64::from(*u) + self.origin.0 - to.u) as f32;
            *v = (f64::from(*v) + self.origin.1 - to.v) as f32;
        }
        self.origin = (to.u, to.v);
    }

    pub fn clear(&mut self) {
        self.list.clear();
    }

    /// The newest.
    pub fn last(&self) -> Option<State> {
        let [u, v, w, h] = self.list.back()?.state.map(f64::from);
        Some(State::new(self.origin.0 + u, self.origin.1 + v, w, h))
    }

    /// All of them.
    pub fn in_order(&mut self) -> &[Observation] {
        self.list.make_contiguous()
    }

    /// Moves them along with the camera.
    pub fn follow_camera(&mut self, motion: &CameraMotion) {
        self.origin = motion.apply_point(self.origin.0, self.origin.1);
        for observation in &mut self.list {
            let [u, v, w, h] = observation.state.map(f64::from);
            // Offsets and sizes change as differences do.
            let moved = motion.apply_velocity(&State::new(u, v, w, h));
            observation.state = [moved.u, moved.v, moved.w, moved.h].map(|x| x as f32);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Far from the origin of coordinates, where single precision knows only every other pixel.
    const FAR: f64 = 2e7;

    #[test]
    fn states_are_kept_as_offsets_and_times_as_gaps() {
        let mut history = History::default();
        assert_eq!(history.last(), None);
        for (time, step) in [(1e9, 0.0), (1e9 + 1.0, 0.25), (1e9 + 4.0, 0.75)] {
            history.push(time, &State::new(FAR + step, FAR - step, 30.0, 40.0), 10);
        }
        let kept: Vec<_> = history.in_order().iter().map(|o| (o.since, o.state)).collect();
        assert_eq!(
            kept,
            [(0.0, [0.0, 0.0, 30.0, 40.0]), (1.0, [0.25, -0.25, 30.0, 40.0]), (3.0, [0.75, -0.75, 30.0, 40.0])]
        );
        assert_eq!(history.last(), Some(State::new(FAR + 0.75, FAR - 0.75, 30.0, 40.0)));
    }

    #[test]
    fn the_oldest_are_forgotten() {
        let mut history = History::default();
        for step in 0..5 {
            history.push(step as f64, &State::new(step as f64, 0.0, 30.0, 40.0), 3);
        }
        assert_eq!(history.in_order().iter().map(|o| o.state[0]).collect::<Vec<_>>(), [2.0, 3.0, 4.0]);
        // Nor are there more when a lower frame rate asks for fewer.
        history.push(5.0, &State::new(5.0, 0.0, 30.0, 40.0), 2);
        assert_eq!(history.in_order().len(), 2);
    }

    #[test]
    fn after_clearing_it_starts_elsewhere() {
        let mut history = History::default();
        history.push(0.0, &State::new(FAR, FAR, 30.0, 40.0), 3);
        history.clear();
        history.push(1.0, &State::new(0.125, 0.0, 30.0, 40.0), 3);
        history.push(2.0, &State::new(0.375, 0.0, 30.0, 40.0), 3);
        assert_eq!(history.last(), Some(State::new(0.375, 0.0, 30.0, 40.0)));
    }

    #[test]
    fn wherever_target_and_camera_go_offsets_stay_exact() {
        // A camera that drifts inwards by a ten-thousandth a frame: what stood still long ago would be light years away.
        let (scale, steps) = (1.0001, 400_000);
        let zoom = CameraMotion([scale, 0.0, 960.0 * (1.0 - scale), 0.0, scale, 540.0 * (1.0 - scale)]);
        let mut history = History::default();
        let mut walked = History::default();
        for step in 0..steps {
            let side = 300.0 + (step % 7) as f64;
            history.follow_camera(&zoom);
            history.push(step as f64, &State::new(side, 540.0, 30.0, 40.0), 3);
            walked.push(step as f64, &State::new(3.3 * step as f64, 0.0, 30.0, 40.0), 3);
        }
        let last = history.last().unwrap();
        let side = 300.0 + ((steps - 1) % 7) as f64;
        assert!((last.u - side).abs() < 1e-3 && (last.v - 540.0).abs() < 1e-3, "{last:?}");
        let rises: Vec<f32> = walked.in_order().windows(2).map(|pair| pair[1].state[0] - pair[0].state[0]).collect();
        assert!(rises.iter().all(|rise| (rise - 3.3).abs() < 1e-3), "{rises:?}");
    }

    #[test]
    fn all_follow_the_camera() {
        // Twice as large, turned by 90 degrees: (x, y) goes to (-2 y + 7, 2 x + 5).
        let motion = CameraMotion([0.0, -2.0, 7.0, 2.0, 0.0, 5.0]);
        let states = [State::new(10.0, 20.0, 4.0, 6.0), State::new(11.0, 23.0, 4.0, 6.0)];
        let mut history = History::default();
        for (time, state) in states.iter().enumerate() {
            history.push(time as f64, state, 3);
            assert_eq!(history.last(), Some(*state));
        }
        history.follow_camera(&motion);
        assert_eq!(history.last(), Some(motion.apply_state(&states[1])));
        // Three down and one to the right, before.
        assert_eq!(history.in_order()[1].state[..2], [-6.0, 2.0]);
    }
}
