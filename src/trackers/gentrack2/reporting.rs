//! From targets to the tracks that a caller sees.

use crate::geometry::Rect;
use crate::track::{Output, TrackState};

use super::TICKS_PER_SECOND;
use super::target::Target;

/// Puts a target into the list of `output` that it belongs to.
pub fn report(target: &Target, output: &mut Output) {
    let state = match (target.confirmed, target.missed > 0.0) {
        (false, _) => TrackState::Tentative,
        (true, false) => TrackState::Confirmed,
        (true, true) => TrackState::Lost,
    };
    let track = target.life.track(Rect::from(target.state), target.velocity * TICKS_PER_SECOND, state);
    output.list(track, target.reported);
}
