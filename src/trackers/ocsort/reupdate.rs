//! Observation-centric re-update (specifications: OC-SORT section 6): a track found again goes back to where it was lost and
//! relives the gap along a straight line between the two observations.

use crate::frame::CameraMotion;
use crate::geometry::State;
use crate::kalman::{AreaRatio, Measurement};

/// The filter as it was predicted to the first missed frame, with steps and time at that frame.
type Frozen = (AreaRatio, u32, f64);

/// Memory for frozen filters. They are large and few: beside the tracks, whose list is walked several times a step, they are
/// out of the way.
#[derive(Default)]
pub struct FrozenPool(#[allow(clippy::vec_box, reason = "the boxes are what is kept")] Vec<Box<Frozen>>);

impl FrozenPool {
    fn put(&mut self, frozen: Frozen) -> Box<Frozen> {
        match self.0.pop() {
            Some(mut place) => {
                *place = frozen;
                place
            }
            None => Box::new(frozen),
        }
    }
}

/// What a filter needs to remember for it.
#[derive(Debug, Default)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct GapMemory {
    /// The last measurement given to the filter.
    last: Option<State>,
    /// Steps and time since then.
    steps: u32,
    time: f64,
    frozen: Option<Box<Frozen>>,
}

impl GapMemory {
    /// The filter was moved on by `dt` frames.
    pub fn step(&mut self, dt: f64) {
        self.steps = self.steps.saturating_add(1);
        self.time += dt;
    }

    /// The track was missed.
    pub fn miss(&mut self, filter: &AreaRatio, pool: &mut FrozenPool) {
        if self.last.is_some() && self.frozen.is_none() {
            self.frozen = Some(pool.put((*filter, self.steps, self.time)));
        }
    }

    /// The gap is over: gives back what was frozen.
    pub fn forget(&mut self, pool: &mut FrozenPool) {
        pool.0.extend(self.frozen.take());
    }

    /// Gives a measurement to the filter, after reliving the gap if there was one.
    pub fn correct(&mut self, filter: &mut AreaRatio, z: &Measurement, pool: &mut FrozenPool) {
        if let (Some(frozen), Some(from)) = (&self.frozen, self.last) {
            *filter = frozen.0;
            self.relive(filter, &from, &z.state(), (frozen.1, frozen.2));
        }
        self.forget(pool);
        // After a gap the measurement counts twice: the last of the line is the same.
        filter.correct(z);
        *self = Self { last: Some(z.state()), ..Self::default() };
    }

    /// Corrections and steps in turns, from the first missed frame to this one. The corrections lie on a line in centre,
    /// width and height.
    fn relive(&self, filter: &mut AreaRatio, from: &State, to: &State, (steps, time): (u32, f64)) {
        let more = self.steps - steps;
        let dt = if more > 0 { (self.time - time) / more as f64 } else { 0.0 };
        for i in 0..=more {
            let share = (time + i as f64 * dt) / self.time;
            let s = *from + (*to - *from) * share;
            filter.correct(&Measurement { u: s.u, v: s.v, area: s.w * s.h, ratio: s.w / s.h });
            if i < more {
                filter.predict(dt);
            }
        }
    }

    /// Goes along with the camera.
    pub fn follow_camera(&mut self, motion: &CameraMotion) {
        if let Some(last) = &mut self.last {
            *last = motion.apply_state(last);
        }
        if let Some(frozen) = &mut self.frozen {
            frozen.0.follow_camera(motion);
        }
    }
}
