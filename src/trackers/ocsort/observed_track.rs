//! One track: a filter, and the observations it is steered by.

use std::collections::VecDeque;

use super::heading::{Direction, Heading};
use super::reupdate::{FrozenPool, GapMemory};
use crate::frame::{CameraMotion, Detection};
use crate::geometry::{Rect, State};
use crate::kalman::{AreaRatio, Measurement};
use crate::track::Track;
use crate::trackers::life::{Life, presentable, presentable_velocity};
use crate::trackers::sort_family::Run;

/// Added to a box's height where its aspect ratio is measured.
const EPSILON: f64 = 1e-6;

/// The latest observations, by the track's age.
#[derive(Default)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct Observations {
    list: VecDeque<(u64, Rect, f64)>,
}

impl Observations {
    /// The box of the latest; one without a size before the first.
    pub fn last_box(&self) -> Rect {
        self.list.back().map_or(Rect::default(), |(_, rect, _)| *rect)
    }

    /// The oldest of the last `delta_t` frames, or else the latest of all.
    fn look_back(&self, age: u64, delta_t: u64) -> Option<Rect> {
        let recent = self.list.iter().find(|(at, ..)| at + delta_t >= age);
        recent.or(self.list.back()).map(|(_, rect, _)| *rect)
    }

    fn add(&mut self, age: u64, detection: &Detection, delta_t: u64) {
        while self.list.front().is_some_and(|(at, ..)| at + delta_t < age) {
            self.list.pop_front();
        }
        self.list.push_back((age, detection.rect, detection.score));
    }

    /// The reference tells whether there is an observation by the sign of this sum, so a box far outside the image to
    /// the left or above counts as none in some places.
    fn counts(&self) -> bool {
        let sum = |(_, r, score): &(u64, Rect, f64)| r.left + r.top + r.right() + r.bottom() + score;
        self.list.back().is_some_and(|last| sum(last) >= 0.0)
    }
}

/// Memory for observations, of tracks that ended. Most tracks of a crowd are never matched and need none.
#[derive(Default)]
pub struct Spare(Vec<Observations>);

impl Spare {
    /// Keeps what a track leaves.
    pub fn put(&mut self, observations: Observations) {
        if observations.list.capacity() > 0 {
            self.0.push(observations);
        }
    }

    /// Memory for somebody who has none yet.
    fn lend(&mut self, observations: &mut Observations) {
        if observations.list.capacity() == 0
            && let Some(mut spare) = self.0.pop()
        {
            spare.list.clear();
            *observations = spare;
        }
    }
}

/// A track.
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct ObservedTrack {
    pub life: Life,
    pub run: Run,
    pub filter: AreaRatio,
    pub observations: Observations,
    gap: GapMemory,
    direction: Option<Direction>,
    age: u64,
}

impl ObservedTrack {
    /// The detection of the birth is no observation.
    pub fn born(id: u64, row: u32, detection: &Detection) -> Self {
        Self {
            life: Life::begin(id, row, detection),
            run: Run::default(),
            filter: AreaRatio::new(&Measurement::of(&detection.rect, EPSILON)),
            observations: Observations::default(),
            gap: GapMemory::default(),
            direction: None,
            age: 0,
        }
    }

    /// Moves on by `dt` frames.
    pub fn predict(&mut self, dt: f64) {
        self.life.next_frame();
        self.filter.clamp_area(dt);
        self.filter.predict(dt);
        self.gap.step(dt);
        self.age += 1;
    }

    /// Goes along with the camera.
    pub fn follow_camera(&mut self, motion: &CameraMotion) {
        self.filter.follow_camera(motion);
        self.gap.follow_camera(motion);
        for (_, rect, _) in &mut self.observations.list {
            *rect = motion.apply_state(&State::from(*rect)).into();
        }
        self.direction = self.direction.map(|d| d.turned(motion));
    }

    /// Where directions are reckoned from, and the track's own, once it has one.
    pub fn heading(&self, delta_t: u64) -> Option<Heading> {
        Some(Heading::new(&self.observations.look_back(self.age, delta_t)?, self.direction?))
    }

    /// Takes a detection.
    pub fn take(&mut self, row: u32, detection: &Detection, delta_t: u64, spare: &mut Spare, pool: &mut FrozenPool) {
        if self.observations.counts()
            && let Some(from) = self.observations.look_back(self.age, delta_t)
        {
            self.direction = Some(Direction::between(&from, &detection.rect));
        }
        spare.lend(&mut self.observations);
        self.observations.add(self.age, detection, delta_t);
        self.life.take(row, detection);
        self.run.matched();
        self.gap.correct(&mut self.filter, &Measurement::of(&detection.rect, EPSILON), pool);
    }

    /// Was not matched on a frame on which the detector ran.
    pub fn miss(&mut self, pool: &mut FrozenPool) {
        self.gap.miss(&self.filter, pool);
    }

    /// Ends; what it holds serves the next ones.
    pub fn retire(mut self, pool: &mut FrozenPool) -> Observations {
        self.gap.forget(pool);
        self.observations
    }

    /// As its caller sees it: seen, it is where it was observed.
    pub fn shown(&self, frame_rate: f64, detector_ran: bool) -> (Track, bool) {
        let observed = detector_ran && self.run.is_seen() && self.observations.counts();
        let rect = match observed {
            true => self.observations.last_box(),
            false => presentable(&self.filter.state(), &self.life.last),
        };
        let velocity = presentable_velocity(self.filter.velocity(), frame_rate);
        (self.life.track(rect, velocity, self.run.state()), self.run.is_reported())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_is_lent_to_who_is_matched_and_kept_of_who_was() {
        let detection = Detection::new(10.0, 20.0, 30.0, 40.0, 0.9);
        let (mut spare, mut frozen) = (Spare::default(), FrozenPool::default());
        let mut seen = ObservedTrack::born(1, 0, &detection);
        seen.take(0, &detection, 3, &mut spare, &mut frozen);
        spare.put(seen.retire(&mut frozen));
        spare.put(ObservedTrack::born(2, 0, &detection).retire(&mut frozen));
        assert_eq!(spare.0.len(), 1);
        let place = spare.0[0].list.as_slices().0.as_ptr();
        let mut next = ObservedTrack::born(3, 0, &detection);
        next.take(0, &detection, 3, &mut spare, &mut frozen);
        assert!(spare.0.is_empty());
        assert_eq!(next.observations.list.len(), 1);
        assert_eq!(next.observations.list.as_slices().0.as_ptr(), place);
    }
}
