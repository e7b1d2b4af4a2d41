//! From targets to the tracks that a caller sees.

use crate::geometry::Rect;
use crate::track::{Output, Track, TrackState};

use super::TICKS_PER_SECOND;
use super::observations::Observations;
use super::target::Target;

/// Puts a target into the list of `output` that it belongs to, and its identity beside its detection.
pub fn report(target: &Target, observations: &Observations, output: &mut Output) {
    let track = track(target, observations);
    if let Some(row) = track.detection_index {
        output.track_of_detection[row] = target.id;
    }
    match (track.state, target.reported) {
        (TrackState::Tentative, _) => output.tentative.push(track),
        (_, true) => output.reported.push(track),
        (_, false) => output.lost.push(track),
    }
}

fn track(target: &Target, observations: &Observations) -> Track {
    let state = match (target.confirmed, target.missed > 0.0) {
        (false, _) => TrackState::Tentative,
        (true, false) => TrackState::Confirmed,
        (true, true) => TrackState::Lost,
    };
    Track {
        id: target.id,
        rect: Rect::from(target.state),
        velocity: target.velocity * TICKS_PER_SECOND,
        state,
        score: target.last.score,
        class_id: target.last.class_id,
        tag: target.last.tag,
        detection_index: target.matched.index().map(|i| observations.get(i).row as usize),
        age: target.frames,
        hits: target.hits,
        frames_since_match: target.frames_since_match,
    }
}
