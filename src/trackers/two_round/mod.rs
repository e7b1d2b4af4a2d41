//! Association in rounds, detections of a high score first: what ByteTrack, BoT-SORT and SMILEtrack have in common
//! (specifications: ByteTrack sections 4-6, BoT-SORT 4-7, SMILEtrack 3-6).
//!
//! | round | tracks | detections | cost |
//! |---|---|---|---|
//! | 1 | confirmed and lost | high scores | IoU, with score or looks |
//! | 2 | confirmed, left over | low scores | IoU |
//! | 3 | unconfirmed | high scores, left over | IoU, with score or looks |

mod cost;
mod member;
mod parameters;

pub use cost::Looks;
pub(super) use parameters::two_round_parameters;

use crate::buffers;
use crate::embedding::{MeanEmbedding, UnitRows};
use crate::faults::{self, Stage};
use crate::frame::Frame;
use crate::kalman::{BoxFilter, is_sane};
#[cfg(feature = "snapshot")]
use crate::snapshot::{Decoder, Encoder};
use crate::track::Output;
use crate::tracker::StepContext;
use crate::trackers::TrackingAlgorithm;
use crate::trackers::life::{SMALLEST, is_beyond};
use crate::trackers::overlaps::{Extent, Overlaps};
use crate::trackers::pairing::Pairing;

use member::{Fate, Member};

/// Which tracks meet which detections.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Round {
    HighScores,
    LowScores,
    Unconfirmed,
}

/// What the trackers of the family differ in.
#[derive(Clone, Debug)]
pub struct Rules {
    /// Detections above this score are high, ...
    pub high_score: f64,
    /// ... those between this one and `high_score` are low.
    pub low_score: f64,
    /// Smallest score that starts a track.
    pub new_track_score: f64,
    /// Largest cost of a pair in rounds 1 to 3.
    pub limits: [f64; 3],
    /// Lost tracks live this many frames at 30 frames per second.
    pub buffer: f64,
    /// Whether the IoU counts in proportion to the score.
    pub fuse_score: bool,
    /// Tracked and lost ones with a smaller IoU distance are one object.
    pub duplicate_distance: f64,
    /// Whether unconfirmed tracks are reported.
    pub report_unconfirmed: bool,
    /// Whether tracks go along with the camera.
    pub follow_camera: bool,
    /// What embeddings are used for.
    pub looks: Looks,
    /// Share of the old embedding when a track learns a new one.
    pub momentum: f64,
    /// Smallest width of a usable detection: a filter may divide by it.
    pub smallest_width: f64,
}

impl Rules {
    /// What BoT-SORT changes, and SMILEtrack with it: embeddings count, and new tracks are reported at once.
    pub fn with_looks(self, looks: Looks, momentum: f64) -> Self {
        Self { report_unconfirmed: true, looks, momentum, smallest_width: SMALLEST, ..self }
    }
}

/// A tracker of the family.
pub struct TwoRound<F> {
    rules: Rules,
    /// The tracked members, then the lost ones.
    members: Vec<Member<F>>,
    /// How many are tracked.
    tracked: usize,
    /// Frames since the first one, up to that on which the detector last ran.
    now: f64,
    work: Workspace<F>,
}

/// Buffers that are only there to be reused.
struct Workspace<F> {
    embeddings: UnitRows,
    high: Vec<u32>,
    low: Vec<u32>,
    pool: Vec<u32>,
    pairing: Pairing,
    overlaps: Overlaps,
    next: Vec<Member<F>>,
    spare: Vec<MeanEmbedding>,
    duplicates: Vec<u32>,
}

impl<F> Default for Workspace<F> {
    fn default() -> Self {
        Self {
            embeddings: UnitRows::default(),
            high: Vec::new(),
            low: Vec::new(),
            pool: Vec::new(),
            pairing: Pairing::default(),
            overlaps: Overlaps::default(),
            next: Vec::new(),
            spare: Vec::new(),
            duplicates: Vec::new(),
        }
    }
}

impl<F: BoxFilter> TwoRound<F> {
    /// A tracker without tracks.
    pub fn new(rules: Rules) -> Self {
        Self { rules, members: Vec::new(), tracked: 0, now: 0.0, work: Workspace::default() }
    }

    /// Predicts everybody but the unconfirmed, who are compared where they were born, and follows the camera.
    fn predict(&mut self, frame: &Frame<'_>, dt: f64) {
        let motion = frame.camera_motion.as_ref().filter(|_| self.rules.follow_camera);
        for member in &mut self.members {
            member.life.next_frame();
            if member.activated {
                if member.fate != Fate::Tracked {
                    member.filter.stop_growth();
                }
                member.filter.predict(dt);
            }
            if let Some(motion) = motion {
                member.filter.follow_camera(motion);
            }
        }
    }

    /// Those whose box is none any more end, which only absurd numbers bring about.
    fn end_the_insane(&mut self, output: &mut Output) {
        for member in self.members.extract_if(.., |m| !is_sane(&m.filter.state())) {
            output.ended.push(member.life.id);
            self.work.retire(member);
        }
        self.tracked = self.members.iter().filter(|m| m.fate == Fate::Tracked).count();
    }

    fn split_by_score(&mut self, frame: &Frame<'_>) {
        let (rules, work) = (&self.rules, &mut self.work);
        work.high.clear();
        work.low.clear();
        for (row, d) in frame.detections.iter().enumerate() {
            if d.rect.height < SMALLEST || d.rect.width < rules.smallest_width {
                continue;
            }
            if d.score > rules.high_score {
                work.high.push(row as u32);
            } else if d.score > rules.low_score && d.score < rules.high_score {
                work.low.push(row as u32);
            }
        }
        work.embeddings.fill(frame.embeddings.as_ref(), frame.detections.len());
    }

    fn associate(&mut self, frame: &Frame<'_>, context: &StepContext<'_>) {
        self.fill_pool(|m| m.activated);
        self.round(Round::HighScores, frame, context);
        let (members, pool) = (&mut self.members, &mut self.work.pool);
        pool.retain(|m| members[*m as usize].fate == Fate::Tracked);
        self.round(Round::LowScores, frame, context);
        for member in self.work.pool.drain(..) {
            self.members[member as usize].fate = Fate::NewlyLost;
        }
        self.fill_pool(|m| !m.activated);
        self.round(Round::Unconfirmed, frame, context);
        for member in self.work.pool.drain(..) {
            self.members[member as usize].fate = Fate::Gone;
        }
    }

    fn fill_pool(&mut self, wanted: impl Fn(&Member<F>) -> bool) {
        self.work.pool.clear();
        self.work.pool.extend((0..).zip(&self.members).filter(|(_, m)| wanted(m)).map(|(i, _)| i));
    }

    /// Lets the pool take detections; those without one stay in it.
    fn round(&mut self, round: Round, frame: &Frame<'_>, context: &StepContext<'_>) {
        faults::point(Stage::Association);
        let Self { rules, members, work, now, .. } = self;
        let Workspace { pairing, embeddings, pool, high, low, .. } = work;
        let detection = |row: u32| &frame.detections[row as usize];
        let cost = |member: u32, row: u32, iou: f64| {
            let (member, detection) = (&members[member as usize], detection(row));
            if !context.classes.allows(member.life.last.class_id, detection.class_id) {
                return f64::INFINITY;
            }
            let embedding = embeddings.row(row as usize);
            match round {
                Round::HighScores => rules.first_cost(member, detection, embedding, iou),
                Round::LowScores => 1.0 - iou,
                Round::Unconfirmed => rules.third_cost(member, detection, embedding, iou),
            }
        };
        let (rows, limit) = match round {
            Round::HighScores => (high, rules.limits[0]),
            Round::LowScores => (low, rules.limits[1]),
            Round::Unconfirmed => (high, rules.limits[2]),
        };
        let place = |member: u32| members[member as usize].rect();
        let pairs = pairing.pair(Extent::Inclusive, pool, place, rows, |row| detection(row).rect, limit, cost);
        for &(member, row) in pairs {
            let member = &mut members[member as usize];
            member.take(row, detection(row), *now);
            // Detections of a low score have no embedding worth learning.
            if round != Round::LowScores {
                member.learn(embeddings.row(row as usize), rules.momentum);
            }
        }
    }

    /// The high detections left over start tracks, which are confirmed at once in the first frame.
    fn start_tracks(&mut self, frame: &Frame<'_>, context: &mut StepContext<'_>) {
        let mut room = context.max_tracks.saturating_sub(self.members.len());
        for &row in &self.work.high {
            let detection = &frame.detections[row as usize];
            if detection.score < self.rules.new_track_score || room == 0 {
                continue;
            }
            room -= 1;
            let embedding = self.work.spare.pop().unwrap_or_default();
            let mut member = Member::born(context.ids.take(), row, detection, self.now, embedding);
            member.activated = context.detector_frames == 1;
            member.learn(self.work.embeddings.row(row as usize), self.rules.momentum);
            buffers::push(&mut self.members, member);
        }
    }

    /// Puts the members into the order of the reference's lists: tracked as they were, new, found again; lost as they
    /// were, newly lost.
    fn arrange(&mut self, max_lost: f64, output: &mut Output) {
        for member in &mut self.members[..] {
            // Who has been given up once is not kept when lost again.
            if member.given_up && matches!(member.fate, Fate::Lost | Fate::NewlyLost) {
                member.fate = Fate::Gone;
            }
            // Given up now: sought for one more frame.
            member.given_up |= member.fate == Fate::Lost && is_beyond(self.now - member.last, max_lost);
        }
        let work = &mut self.work;
        for fate in [Fate::Tracked, Fate::New, Fate::Found, Fate::Lost, Fate::NewlyLost] {
            work.next.extend(self.members.extract_if(.., |m| m.fate == fate));
            if fate == Fate::Found {
                self.tracked = work.next.len();
            }
        }
        faults::point(Stage::Removal);
        for member in self.members.drain(..) {
            output.ended.push(member.life.id);
            work.retire(member);
        }
        std::mem::swap(&mut self.members, &mut work.next);
        for (i, member) in self.members.iter_mut().enumerate() {
            member.fate = if i < self.tracked { Fate::Tracked } else { Fate::Lost };
        }
    }

    /// Of a tracked and a lost one in the same place the one with the longer life stays, the lost one if equal.
    fn drop_duplicates(&mut self, context: &StepContext<'_>, output: &mut Output) {
        let (tracked, lost) = self.members.split_at(self.tracked);
        let work = &mut self.work;
        work.duplicates.clear();
        for p in
            work.overlaps.between(Extent::Inclusive, tracked.iter().map(Member::rect), lost.iter().map(Member::rect))
        {
            let (a, b) = (&tracked[p.row as usize], &lost[p.column as usize]);
            let comparable = context.classes.allows(a.life.last.class_id, b.life.last.class_id);
            if comparable && 1.0 - p.iou < self.rules.duplicate_distance {
                let lost_goes = a.last - a.start > b.last - b.start;
                work.duplicates.push(if lost_goes { p.column + self.tracked as u32 } else { p.row });
            }
        }
        for &index in &work.duplicates {
            self.members[index as usize].fate = Fate::Gone;
        }
        for member in self.members.extract_if(.., |m| m.fate == Fate::Gone) {
            // Nobody has heard of one that goes in the frame of its birth.
            if member.life.frames > 1 {
                output.ended.push(member.life.id);
            }
            work.retire(member);
        }
        self.tracked = self.members.iter().filter(|m| m.fate == Fate::Tracked).count();
    }
}

impl<F> Workspace<F> {
    /// Keeps the buffers of an ended member.
    fn retire(&mut self, member: Member<F>) {
        let mut embedding = member.embedding;
        embedding.clear();
        self.spare.push(embedding);
    }
}

impl<F: BoxFilter> TrackingAlgorithm for TwoRound<F> {
    fn step(&mut self, frame: &Frame<'_>, context: &mut StepContext<'_>, output: &mut Output) {
        self.predict(frame, context.elapsed);
        self.end_the_insane(output);
        if !frame.detector_skipped {
            self.now += context.since_detector;
            self.split_by_score(frame);
            self.associate(frame, context);
            self.start_tracks(frame, context);
            self.arrange((context.frame_rate / 30.0 * self.rules.buffer).floor(), output);
            self.drop_duplicates(context, output);
        }
        for (index, member) in self.members.iter().enumerate() {
            let is_tracked = index < self.tracked;
            let track = member.track(is_tracked, context.frame_rate);
            output.list(track, is_tracked && (member.activated || self.rules.report_unconfirmed));
        }
    }

    fn reset(&mut self) {
        for member in self.members.drain(..) {
            self.work.retire(member);
        }
        self.tracked = 0;
        self.now = 0.0;
    }

    #[cfg(feature = "snapshot")]
    fn save(&self, state: &mut Encoder) {
        state.put(&(&self.members, self.tracked, self.now));
    }

    #[cfg(feature = "snapshot")]
    fn load(&mut self, state: &mut Decoder<'_>) -> Result<(), crate::Error> {
        (self.members, self.tracked, self.now) = state.take()?;
        if self.tracked > self.members.len() {
            return Err(crate::Error::Snapshot("has fewer tracks than it says".to_string()));
        }
        Ok(())
    }
}
