//! What every output must satisfy, whatever the input.

use std::collections::BTreeSet;

use gentrack2::{Algorithm, Detection, Output, Track, TrackState};

/// Whether a tentative track may be among the reported ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TentativeReports {
    /// What is reported is trusted.
    #[default]
    Never,
    /// Those of the first frame with detections, until the detector runs again.
    Firstborn,
    /// The published algorithm reports whatever it tracks.
    Always,
}

impl TentativeReports {
    fn of(algorithm: Algorithm) -> Self {
        match algorithm {
            Algorithm::BotSort | Algorithm::SmileTrack => Self::Always,
            Algorithm::ConfTrack => Self::Firstborn,
            _ => Self::Never,
        }
    }
}

/// Watches the outputs of one tracker from its first step on.
#[derive(Default)]
pub struct Contract {
    tentative_reports: TentativeReports,
    /// Frames since the first one with a track, that one included.
    frames: u32,
    live: BTreeSet<u64>,
    ended: BTreeSet<u64>,
}

impl Contract {
    /// That of an algorithm; the default is GenTrack2's, the strictest.
    pub fn of(algorithm: Algorithm) -> Self {
        Self { tentative_reports: TentativeReports::of(algorithm), ..Self::default() }
    }

    /// Checks one output; panics with what is wrong.
    pub fn check(&mut self, detections: &[Detection], output: &Output) {
        let mut live = BTreeSet::new();
        for track in all_tracks(output) {
            check_numbers(track);
            assert!(track.id > 0 && live.insert(track.id), "id {} is listed twice", track.id);
            assert!(!self.ended.contains(&track.id), "id {} is back after its end", track.id);
            check_detection_of(track, detections, output);
        }
        self.frames += u32::from(self.frames > 0 || !live.is_empty());
        self.check_states(output);
        for &id in &output.ended {
            assert!(self.ended.insert(id), "id {id} ended twice");
            assert!(self.live.contains(&id), "id {id} ended without having lived");
            assert!(!live.contains(&id), "id {id} ended and is listed");
        }
        for id in &self.live {
            assert!(live.contains(id) || self.ended.contains(id), "id {id} vanished without an end");
        }
        check_rows(detections, output, &live);
        self.live = live;
    }

    fn check_states(&self, output: &Output) {
        let may_be_reported = |t: &Track| match self.tentative_reports {
            TentativeReports::Never => false,
            TentativeReports::Firstborn => t.age == self.frames && t.hits == 1,
            TentativeReports::Always => true,
        };
        for track in &output.reported {
            assert!(track.state != TrackState::Tentative || may_be_reported(track), "reported: {track:?}");
        }
        assert!(output.tentative.iter().all(|t| t.state == TrackState::Tentative), "{:?}", output.tentative);
        assert!(
            output.lost.iter().all(|t| t.state == TrackState::Lost && t.detection_index.is_none()),
            "{:?}",
            output.lost
        );
    }

    /// Identities alive after the last output.
    pub fn live(&self) -> &BTreeSet<u64> {
        &self.live
    }

    /// All identities that have ended.
    pub fn ended(&self) -> &BTreeSet<u64> {
        &self.ended
    }
}

/// The reported, tentative and lost tracks.
pub fn all_tracks(output: &Output) -> impl Iterator<Item = &Track> {
    output.reported.iter().chain(&output.tentative).chain(&output.lost)
}

fn check_numbers(track: &Track) {
    let (r, v) = (&track.rect, &track.velocity);
    let numbers = [r.left, r.top, r.width, r.height, v.u, v.v, v.w, v.h, track.score];
    assert!(numbers.iter().all(|x| x.is_finite()), "not finite: {track:?}");
    assert!(r.width >= 0.0 && r.height >= 0.0 && (0.0..=1.0).contains(&track.score), "out of range: {track:?}");
    assert!(track.hits >= 1 && track.hits <= track.age && track.frames_since_match < track.age, "ages: {track:?}");
}

/// A matched track carries what came with its detection.
fn check_detection_of(track: &Track, detections: &[Detection], output: &Output) {
    assert_eq!(track.detection_index.is_some(), track.frames_since_match == 0, "{track:?}");
    let Some(row) = track.detection_index else { return };
    let detection = &detections[row];
    assert_eq!(output.track_of_detection[row], track.id, "row {row} and {track:?} disagree");
    assert_eq!(track.class_id, detection.class_id, "class of {track:?}");
    assert_eq!(track.tag, detection.tag, "tag of {track:?}");
    assert_eq!(track.score, detection.score, "score of {track:?}");
}

fn check_rows(detections: &[Detection], output: &Output, live: &BTreeSet<u64>) {
    assert_eq!(output.track_of_detection.len(), detections.len());
    let mut taken = BTreeSet::new();
    for (row, &id) in output.track_of_detection.iter().enumerate().filter(|(_, id)| **id != 0) {
        assert!(live.contains(&id), "row {row} was taken by {id}, which is not listed");
        assert!(taken.insert(id), "{id} took two rows");
    }
    let matched = all_tracks(output).filter(|t| t.detection_index.is_some()).count();
    assert_eq!(matched, taken.len());
}
