//! The handle: one video stream tracked by one algorithm.

use crate::classes::ClassRule;
use crate::config::Config;
use crate::error::Error;
use crate::faults::{self, Stage};
use crate::frame::Frame;
#[cfg(feature = "snapshot")]
use crate::snapshot::{self, Decoder, Encoder, SavedConfig};
use crate::track::{Neighbourhood, Output, Particle};
use crate::trackers::{Algorithm, TrackingAlgorithm};
use crate::validation::{History, check_frame};

/// What an algorithm gets besides the frame.
#[derive(Debug)]
pub struct StepContext<'a> {
    /// Time since the previous frame in nominal frame intervals: 1 without timestamps.
    pub elapsed: f64,
    /// Time since the detector last ran, this frame's included, in nominal frame intervals.
    pub since_detector: f64,
    /// Frames on which the detector ran, this one included.
    pub detector_frames: u64,
    /// Nominal frames per second.
    pub frame_rate: f64,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Most live tracks.
    pub max_tracks: usize,
    /// Which classes may be taken for each other.
    pub classes: ClassRule,
    /// Where identities come from.
    pub ids: &'a mut IdSource,
}

/// Clocks tick, and few frame intervals are a whole number of ticks: what is within this share of a frame of a whole
/// number of frames is that number, so that a stream at its nominal rate is the same with timestamps and without.
const CLOCK_TICK: f64 = 1e-3;

/// Hands out identities.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct IdSource {
    next: u64,
}

impl IdSource {
    /// Hands out this one first.
    pub fn starting_at(first: u64) -> Self {
        Self { next: first }
    }

    /// The next identity, never given out before.
    pub fn take(&mut self) -> u64 {
        let id = self.next;
        self.next += 1;
        id
    }
}

/// When the detector ran.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
struct DetectorClock {
    /// Time since it last ran, in nominal frame intervals.
    since: f64,
    /// Frames on which it ran.
    frames: u64,
}

impl DetectorClock {
    fn count(&mut self, elapsed: f64, ran: bool) {
        self.since += elapsed;
        self.frames += u64::from(ran);
    }
}

/// A tracker of one video stream.
pub struct Tracker {
    config: Config,
    inner: Box<dyn TrackingAlgorithm>,
    ids: IdSource,
    history: History,
    detector: DetectorClock,
    output: Output,
}

impl Tracker {
    /// A tracker with a copy of the configuration.
    pub fn new(config: &Config) -> Result<Self, Error> {
        let key = config.algorithm().name();
        faults::fallible(Stage::Building, |reason| Error::ParameterValue { key: key.to_string(), reason })?;
        Ok(Self {
            config: config.clone(),
            inner: config.parameters.build_for(config.common.class_policy)?,
            ids: IdSource::starting_at(config.common.first_id as u64),
            history: History::default(),
            detector: DetectorClock::default(),
            output: Output::default(),
        })
    }

    /// A tracker at the mercy of a test's algorithm.
    #[cfg(test)]
    pub(crate) fn with_algorithm(config: &Config, inner: Box<dyn TrackingAlgorithm>) -> Self {
        Self { inner, ..Self::new(config).expect("the test's config makes a tracker") }
    }

    /// The algorithm at work.
    pub fn algorithm(&self) -> Algorithm {
        self.config.algorithm()
    }

    /// Its configuration.
    pub fn config(&self) -> &Config {
        &self.config
    }

    /// Advances by one frame. On an error the tracker, its last output included, is as before the call.
    pub fn step(&mut self, frame: &Frame<'_>) -> Result<&Output, Error> {
        faults::fallible(Stage::Validation, |reason| Error::Frame { field: "detections", reason })?;
        check_frame(frame, &self.config.common, &self.history)?;
        let elapsed = self.elapsed_frames(frame.timestamp_ns);
        self.remember(frame, elapsed);
        self.detector.count(elapsed, !frame.detector_skipped);
        self.output.begin(frame.detections.len());
        let mut context = StepContext {
            elapsed,
            since_detector: self.detector.since,
            detector_frames: self.detector.frames,
            frame_rate: self.config.common.frame_rate,
            seed: self.config.common.seed as u64,
            max_tracks: self.config.common.max_tracks as usize,
            classes: ClassRule::of(self.config.common.class_policy),
            ids: &mut self.ids,
        };
        self.inner.step(frame, &mut context, &mut self.output);
        if !frame.detector_skipped {
            self.detector.since = 0.0;
        }
        Ok(&self.output)
    }

    /// The output of the last step; empty before the first.
    pub fn output(&self) -> &Output {
        &self.output
    }

    /// The particles of a live track, as they were used in the last step; empty for algorithms without particles.
    pub fn particles(&self, id: u64) -> Result<&[Particle], Error> {
        self.check_live(id)?;
        Ok(self.inner.particles(id))
    }

    /// What guided the live track `id` in the last step if it has no detection: its neighbours and their motion. Empty
    /// for tracks with one, for algorithms without neighbours, and after [`Tracker::load`] until the next step.
    pub fn neighbourhood(&self, id: u64) -> Result<Neighbourhood<'_>, Error> {
        self.check_live(id)?;
        Ok(self.inner.neighbourhood(id))
    }

    fn check_live(&self, id: u64) -> Result<(), Error> {
        let mut live = [&self.output.reported, &self.output.tentative, &self.output.lost].into_iter().flatten();
        if live.any(|t| t.id == id) { Ok(()) } else { Err(Error::UnknownTrack(id)) }
    }

    /// Forgets everything but the configuration: the next step is as the first of a new tracker.
    pub fn reset(&mut self) {
        self.inner.reset();
        self.ids = IdSource::starting_at(self.config.common.first_id as u64);
        self.history = History::default();
        self.detector = DetectorClock::default();
        self.output.begin(0);
    }

    /// Everything that the tracker knows, as bytes that [`Tracker::load`] makes a tracker of which goes on as this one
    /// would. They are the same on every machine.
    #[cfg(feature = "snapshot")]
    pub fn save(&self) -> Vec<u8> {
        let mut state = Encoder::default();
        state.put(&SavedConfig::of(&self.config));
        state.put(&(&self.ids, &self.history, &self.detector, &self.output));
        faults::point(Stage::Saving);
        self.inner.save(&mut state);
        snapshot::seal(&state.into_bytes())
    }

    /// The tracker of a snapshot, configuration included.
    ///
    /// # Errors
    /// [`Error::Snapshot`] for bytes that are no snapshot, a damaged one, or one of a later version of the library.
    #[cfg(feature = "snapshot")]
    pub fn load(bytes: &[u8]) -> Result<Self, Error> {
        faults::fallible(Stage::Loading, Error::Snapshot)?;
        let mut state = Decoder::new(snapshot::open(bytes)?);
        let config = state.take::<SavedConfig>()?.restore()?;
        let mut tracker = Self::new(&config).map_err(snapshot::refused_config)?;
        (tracker.ids, tracker.history, tracker.detector, tracker.output) = state.take()?;
        faults::fallible(Stage::Loading, Error::Snapshot)?;
        tracker.inner.load(&mut state)?;
        state.finish()?;
        Ok(tracker)
    }

    fn elapsed_frames(&self, now: Option<i64>) -> f64 {
        match (now, self.history.timestamp_ns) {
            (Some(now), Some(before)) => {
                let elapsed = now.abs_diff(before) as f64 * 1e-9 * self.config.common.frame_rate;
                let whole = elapsed.round();
                if (elapsed - whole).abs() < CLOCK_TICK && whole > 0.0 { whole } else { elapsed }
            }
            _ => 1.0,
        }
    }

    fn remember(&mut self, frame: &Frame<'_>, elapsed: f64) {
        if let Some(embeddings) = &frame.embeddings {
            self.history.embedding_dimension = Some(embeddings.dimension);
        }
        let interval = (elapsed / self.config.common.frame_rate * 1e9) as i64;
        // A frame without a timestamp among frames with them moves the clock by one nominal interval.
        self.history.timestamp_ns =
            frame.timestamp_ns.or(self.history.timestamp_ns.map(|before| before.saturating_add(interval)));
    }
}

impl std::fmt::Debug for Tracker {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Tracker").field("algorithm", &self.algorithm()).finish_non_exhaustive()
    }
}
