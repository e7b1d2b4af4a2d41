//! The oracles: which tracker with which settings must reproduce them, fed with what.

use gentrack2::{Config, Embeddings, Frame, Tracker};

use super::golden::{Row, Rows};
use super::sequence::{DIMENSION, Sequence};

/// A run of a reference implementation.
#[derive(Clone, Debug)]
pub struct Variant {
    /// Where its outputs lie.
    pub folder: &'static str,
    /// The name by which this library's tracker is chosen.
    pub tracker: &'static str,
    /// What differs from the tracker's defaults.
    pub settings: Vec<(&'static str, &'static str)>,
    /// Detections of this score and above are fed.
    pub minimum_score: f64,
    /// Whether camera motion is fed.
    pub camera_motion: bool,
    /// Whether embeddings are fed.
    pub embeddings: bool,
    /// Sequences of the fixtures.
    pub synthetic: &'static [&'static str],
    /// Sequences of the measurement data.
    pub mot17: &'static [&'static str],
}

const CORNER_CASES: &[&str] = &["syn_a1", "syn_a2", "syn_a3", "syn_a4"];
const MOVING_CAMERA: &[&str] = &["syn_b1", "syn_b2", "syn_b3"];
const FIVE: &[&str] = &["MOT17-02", "MOT17-04", "MOT17-05", "MOT17-09", "MOT17-11"];
const FOUR: &[&str] = &["MOT17-02", "MOT17-05", "MOT17-09", "MOT17-11"];

impl Variant {
    /// A tracker's defaults, fed with what all have.
    fn plain(tracker: &'static str, minimum_score: f64, synthetic: &'static [&'static str]) -> Self {
        Self {
            folder: tracker,
            tracker,
            settings: Vec::new(),
            minimum_score,
            camera_motion: false,
            embeddings: false,
            synthetic,
            mot17: FIVE,
        }
    }

    fn named(self, folder: &'static str) -> Self {
        Self { folder, ..self }
    }

    /// With a parameter set, on top of those before.
    pub fn with(mut self, key: &'static str, value: &'static str) -> Self {
        self.settings.push((key, value));
        self
    }

    /// With or without camera motion.
    pub fn with_camera_motion(self, camera_motion: bool) -> Self {
        Self { camera_motion, ..self }
    }

    /// With or without embeddings.
    pub fn with_embeddings(self, embeddings: bool) -> Self {
        Self { embeddings, ..self }
    }

    fn without_mot17_04(self) -> Self {
        Self { mot17: FOUR, ..self }
    }

    /// What the tracker reports, frame by frame.
    pub fn play(&self, sequence: &Sequence) -> Result<Rows, String> {
        self.play_interrupted(sequence, |_, tracker| tracker)
    }

    /// The same with what `between` makes of the tracker before each frame, by its index.
    pub fn play_interrupted(
        &self,
        sequence: &Sequence,
        between: impl Fn(usize, Tracker) -> Tracker,
    ) -> Result<Rows, String> {
        let tracker = || -> Result<Tracker, gentrack2::Error> {
            let mut config = Config::new(self.tracker)?;
            for (key, value) in &self.settings {
                config.set_text(key, value)?;
            }
            Tracker::new(&config)
        };
        let mut tracker = tracker().map_err(|e| e.to_string())?;
        let mut rows = Vec::new();
        for (index, input) in sequence.frames.iter().enumerate() {
            let input = input.scored_from(self.minimum_score);
            if self.camera_motion && input.camera_motion.is_none() {
                return Err(format!("frame {}: no camera motion to feed", index + 1));
            }
            let frame = Frame {
                embeddings: self.embeddings.then(|| Embeddings::new(&input.embeddings, DIMENSION)),
                camera_motion: input.camera_motion.filter(|_| self.camera_motion),
                ..Frame::new(&input.detections)
            };
            tracker = between(index, tracker);
            let output = tracker.step(&frame).map_err(|e| format!("frame {}: {e}", index + 1))?;
            rows.push(output.reported.iter().map(|t| Row { id: t.id, rect: t.rect }).collect());
        }
        Ok(rows)
    }
}

/// GenTrack2 with all that the sequences have; it has no oracle.
pub fn gentrack2() -> Variant {
    Variant::plain("gentrack2", 0.0, MOVING_CAMERA).with_camera_motion(true).with_embeddings(true)
}

/// All of them.
pub fn all() -> Vec<Variant> {
    let sort = Variant::plain("sort", 0.6, CORNER_CASES);
    let deepsort = Variant::plain("deepsort", 0.6, CORNER_CASES).with_embeddings(true);
    let ocsort = Variant::plain("ocsort", 0.1, CORNER_CASES);
    let bytetrack = Variant::plain("bytetrack", 0.1, MOVING_CAMERA);
    let botsort = Variant::plain("botsort", 0.1, MOVING_CAMERA).with_camera_motion(true);
    let smiletrack = Variant::plain("smiletrack", 0.1, MOVING_CAMERA).with_camera_motion(true).with_embeddings(true);
    // The tracker's defaults are those of its paper; the oracle `conftrack` is the configuration it was shipped with.
    let full = Variant::plain("conftrack", 0.1, MOVING_CAMERA).named("conftrack-full").with_camera_motion(true);
    let shipped = full
        .clone()
        .named("conftrack")
        .with("confidence_weighting", "false")
        .with("noise_scaling", "false")
        .with("constant_size", "false")
        .with("confidence_fusion", "true")
        .with("low_confidence_matching", "false")
        .with("new_track_thresh", "0.7");
    vec![
        sort.clone().named("sort-age30").with("max_age", "30").without_mot17_04(),
        sort,
        deepsort,
        ocsort.clone().named("ocsort-byte").with("use_byte", "true").without_mot17_04(),
        ocsort,
        bytetrack,
        botsort.clone().named("botsort-reid").with_embeddings(true),
        botsort.clone().named("botsort-nogmc").with_camera_motion(false).without_mot17_04(),
        botsort,
        smiletrack.clone().named("smiletrack-nogmc").with_camera_motion(false).without_mot17_04(),
        smiletrack,
        shipped.clone().named("conftrack-noreid").without_mot17_04(),
        shipped.with_embeddings(true),
        full.clone().named("conftrack-full-reid").with_embeddings(true).without_mot17_04(),
        full.clone().named("conftrack-full-nogmc").with_camera_motion(false).without_mot17_04(),
        full,
    ]
}

/// The variant whose outputs lie in a folder.
pub fn named(folder: &str) -> Variant {
    all().into_iter().find(|v| v.folder == folder).unwrap_or_else(|| panic!("there is no oracle {folder}"))
}

/// A way to be wrong that an oracle must notice.
#[derive(Clone, Debug)]
pub struct Mistake {
    pub name: String,
    pub wrong: Variant,
    pub sequence: &'static str,
}

/// Wrong settings for every tracker, and inputs left out where they matter.
pub fn mistakes() -> Vec<Mistake> {
    let setting = |folder: &'static str, sequence, key: &'static str, value: &'static str| Mistake {
        name: format!("{folder}, {key} = {value}"),
        wrong: named(folder).with(key, value),
        sequence,
    };
    let left_out = |folder: &'static str, what: &str, sequence, leave_out: fn(Variant) -> Variant| Mistake {
        name: format!("{folder}, without {what}"),
        wrong: leave_out(named(folder)),
        sequence,
    };
    let no_camera = |variant: Variant| variant.with_camera_motion(false);
    let no_embeddings = |variant: Variant| variant.with_embeddings(false);
    vec![
        setting("sort", "syn_a1", "max_age", "2"),
        setting("sort-age30", "syn_a4", "max_age", "29"),
        setting("deepsort", "syn_a4", "max_age", "29"),
        setting("ocsort", "syn_a4", "max_age", "29"),
        setting("ocsort-byte", "syn_a1", "use_byte", "false"),
        setting("bytetrack", "syn_b1", "track_buffer", "28"),
        setting("botsort", "syn_b1", "track_buffer", "28"),
        setting("smiletrack", "syn_b1", "track_buffer", "28"),
        setting("conftrack", "syn_b3", "max_age", "28"),
        setting("conftrack-full", "syn_b1", "confidence_weighting", "false"),
        setting("conftrack-full", "syn_b1", "noise_scaling", "false"),
        setting("conftrack-full", "syn_b2", "constant_size", "false"),
        setting("conftrack-full", "syn_b3", "confidence_fusion", "false"),
        setting("conftrack-full", "syn_b3", "low_confidence_matching", "false"),
        setting("conftrack-full", "syn_b3", "new_track_thresh", "0.7"),
        left_out("deepsort", "embeddings", "syn_a2", no_embeddings),
        left_out("botsort", "camera motion", "syn_b2", no_camera),
        left_out("botsort-reid", "embeddings", "syn_b2", no_embeddings),
        left_out("smiletrack", "camera motion", "syn_b2", no_camera),
        left_out("smiletrack", "embeddings", "syn_b2", no_embeddings),
        left_out("conftrack", "camera motion", "syn_b2", no_camera),
        left_out("conftrack", "embeddings", "syn_b2", no_embeddings),
    ]
}
