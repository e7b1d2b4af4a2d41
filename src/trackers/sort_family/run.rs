//! The current run of matches of a track, and its time without.

use crate::track::TrackState;
use crate::trackers::life::is_beyond;

/// Counters that decide what is reported and who goes.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct Run {
    /// Matches since the last miss; the birth is none.
    streak: i64,
    /// Frames since the last match on which the detector ran.
    missed_frames: u32,
    /// Time since the last match in frames.
    missed: f64,
    /// Whether the track is reported.
    reported: bool,
    /// Whether it ever was.
    known: bool,
}

impl Run {
    /// A frame on which the detector ran, `since` frames after the last one. The run of a missed track ends here, a
    /// frame after the miss.
    pub fn next_frame(&mut self, since: f64) {
        if self.missed_frames > 0 {
            self.streak = 0;
        }
        self.missed_frames = self.missed_frames.saturating_add(1);
        self.missed += since;
    }

    /// A detection was taken.
    pub fn matched(&mut self) {
        self.streak += 1;
        self.missed_frames = 0;
        self.missed = 0.0;
    }

    /// Decides after the frame's matches whether the track is reported: in a run of `min_hits`, or, in the first
    /// `min_hits` frames, if it was seen at all.
    pub fn judge(&mut self, min_hits: i64, detector_frames: u64) {
        let in_run = self.streak >= min_hits || detector_frames <= min_hits as u64;
        self.reported = self.missed_frames == 0 && in_run;
        self.known |= self.reported;
    }

    /// Whether the track has not been seen for more than `max_age` frames.
    pub fn is_over(&self, max_age: i64) -> bool {
        is_beyond(self.missed, max_age as f64)
    }

    /// Whether a detection was taken on the last frame on which the detector ran.
    pub fn is_seen(&self) -> bool {
        self.missed_frames == 0
    }

    /// Whether the track is reported.
    pub fn is_reported(&self) -> bool {
        self.reported
    }

    /// Seen, but without its run of matches, a track is tentative (again).
    pub fn state(&self) -> TrackState {
        match (self.reported, self.is_seen(), self.known) {
            (true, ..) => TrackState::Confirmed,
            (false, false, true) => TrackState::Lost,
            _ => TrackState::Tentative,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_miss_asks_for_a_new_run_and_shows_a_frame_late() {
        let mut run = Run::default();
        let mut frame = |seen: bool, number: u64| {
            run.next_frame(1.0);
            if seen {
                run.matched();
            }
            run.judge(3, number);
            (run.streak, run.state())
        };
        use TrackState::{Confirmed, Lost, Tentative};
        assert_eq!(frame(true, 4), (1, Tentative));
        assert_eq!(frame(true, 5), (2, Tentative));
        assert_eq!(frame(true, 6), (3, Confirmed));
        assert_eq!(frame(false, 7), (3, Lost));
        assert_eq!(frame(true, 8), (1, Tentative));
        assert_eq!(frame(true, 9), (2, Tentative));
        assert_eq!(frame(true, 10), (3, Confirmed));
    }

    #[test]
    fn in_the_first_frames_whatever_is_seen_is_reported() {
        let mut run = Run::default();
        run.judge(3, 1);
        assert_eq!(run.state(), TrackState::Confirmed);
        run.next_frame(1.0);
        run.matched();
        run.judge(3, 4);
        assert_eq!(run.state(), TrackState::Tentative);
    }

    #[test]
    fn time_counts_where_the_detector_runs_now_and_then() {
        let mut run = Run::default();
        run.next_frame(5.0);
        run.next_frame(5.0);
        assert!(!run.is_over(10) && run.is_over(9));
    }

    #[test]
    fn a_frame_that_comes_a_little_late_is_a_frame() {
        let mut run = Run::default();
        run.next_frame(1.02);
        assert!(!run.is_over(1) && run.is_over(0));
    }
}
