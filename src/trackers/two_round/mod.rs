//! Association in rounds, detections of a high score first: what ByteTrack, BoT-SORT and SMILEtrack have in common
//! (`specs`: ByteTrack sections 4-6, BoT-SORT 4-7, SMILEtrack 3-6).
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

use crate::assignment::{Assignment, Edge, UNMATCHED};
use crate::embedding::{MeanEmbedding, UnitRows};
use crate::frame::{Detection, Frame};
use crate::kalman::{BoxFilter, is_sane};
use crate::track::Output;
use crate::tracker::StepContext;
use crate::trackers::TrackingAlgorithm;
use crate::trackers::life::SMALLEST;
use crate::trackers::overlaps::{Extent, Overlap, Overlaps, fill_edges};

use member::{Fate, Member};

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
    association: Association,
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
            association: Association::default(),
            next: Vec::new(),
            spare: Vec::new(),
            duplicates: Vec::new(),
        }
    }
}

/// One round's search for pairs.
#[derive(Default)]
struct Association {
    overlaps: Overlaps,
    edges: Vec<Edge>,
    solver: Assignment,
    /// `(member, row)` of the pairs.
    pairs: Vec<(u32, u32)>,
}

impl Association {
    /// Pairs the members of `pool` with the detections of `rows`; what is paired is taken out of both lists.
    fn pair<F: BoxFilter>(
        &mut self,
        members: &[Member<F>],
        pool: &mut Vec<u32>,
        detections: &[Detection],
        rows: &mut Vec<u32>,
        limit: f64,
        cost: impl Fn(&Member<F>, usize, f64) -> f64,
        allowed: impl Fn(i32, i32) -> bool,
    ) {
        let boxes = pool.iter().map(|m| members[*m as usize].rect());
        let pairs = self.overlaps.between(Extent::Inclusive, boxes, rows.iter().map(|r| detections[*r as usize].rect));
        fill_edges(&mut self.edges, pairs, |p: &Overlap| {
            let member = &members[pool[p.row as usize] as usize];
            let row = rows[p.column as usize] as usize;
            let same = allowed(member.life.last.class_id, detections[row].class_id);
            Some(cost(member, row, p.iou)).filter(|cost| same && *cost <= limit)
        });
        let columns = self.solver.solve(pool.len(), rows.len(), &self.edges, limit);
        self.pairs.clear();
        let matched = columns.iter().zip(pool.iter()).filter(|(column, _)| **column != UNMATCHED);
        self.pairs.extend(matched.map(|(column, member)| (*member, rows[*column as usize])));
        let (mut at, mut column) = (0, 0);
        let columns = self.solver.row_of_column();
        pool.retain(|_| {
            at += 1;
            self.solver.column_of_row()[at - 1] == UNMATCHED
        });
        rows.retain(|_| {
            column += 1;
            columns[column - 1] == UNMATCHED
        });
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
        let (work, tracked) = (&mut self.work, &mut self.tracked);
        let mut index = 0;
        let was_tracked = *tracked;
        for member in self.members.extract_if(.., |m| {
            index += 1;
            let insane = !is_sane(&m.filter.state());
            *tracked -= usize::from(insane && index <= was_tracked);
            insane
        }) {
            output.ended.push(member.life.id);
            work.retire(member);
        }
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

    /// The three rounds.
    fn associate(&mut self, frame: &Frame<'_>, context: &StepContext<'_>) {
        let detections = frame.detections;
        let (rules, work) = (&self.rules, &mut self.work);
        let classes = context.classes;
        let allowed = |a, b| classes.allows(a, b);
        work.pool.clear();
        let pool = self.members.iter().zip(0..).filter(|(m, _)| m.activated).map(|(_, i)| i);
        work.pool.extend(pool);
        let Workspace { association, embeddings, pool, high, low, .. } = work;

        let first = |m: &Member<F>, row: usize, iou| rules.first_cost(m, &detections[row], embeddings.row(row), iou);
        association.pair(&self.members, pool, detections, high, rules.limits[0], first, allowed);
        for &(member, row) in &association.pairs {
            let (member, detection) = (&mut self.members[member as usize], &detections[row as usize]);
            member.take(row, detection, self.now);
            member.learn(embeddings.row(row as usize), rules.momentum);
        }

        pool.retain(|m| self.members[*m as usize].fate == Fate::Tracked);
        association.pair(&self.members, pool, detections, low, rules.limits[1], |_, _, iou| 1.0 - iou, allowed);
        for &(member, row) in &association.pairs {
            self.members[member as usize].take(row, &detections[row as usize], self.now);
        }
        for member in pool.drain(..) {
            self.members[member as usize].fate = Fate::NewlyLost;
        }

        pool.extend(self.members.iter().zip(0..).filter(|(m, _)| !m.activated).map(|(_, i)| i));
        let third = |m: &Member<F>, row: usize, iou| rules.third_cost(m, &detections[row], embeddings.row(row), iou);
        association.pair(&self.members, pool, detections, high, rules.limits[2], third, allowed);
        for &(member, row) in &association.pairs {
            let (member, detection) = (&mut self.members[member as usize], &detections[row as usize]);
            member.take(row, detection, self.now);
            member.learn(embeddings.row(row as usize), rules.momentum);
        }
        for member in pool.drain(..) {
            self.members[member as usize].fate = Fate::Gone;
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
            self.members.push(member);
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
            member.given_up |= member.fate == Fate::Lost && self.now - member.last > max_lost;
        }
        let work = &mut self.work;
        for fate in [Fate::Tracked, Fate::New, Fate::Found, Fate::Lost, Fate::NewlyLost] {
            work.next.extend(self.members.extract_if(.., |m| m.fate == fate));
            if fate == Fate::Found {
                self.tracked = work.next.len();
            }
        }
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
        let overlaps = &mut work.association.overlaps;
        work.duplicates.clear();
        for p in overlaps.between(Extent::Inclusive, tracked.iter().map(Member::rect), lost.iter().map(Member::rect)) {
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
        let removed_tracked = self.members[..self.tracked].iter().filter(|m| m.fate == Fate::Gone).count();
        self.tracked -= removed_tracked;
        for member in self.members.extract_if(.., |m| m.fate == Fate::Gone) {
            // Nobody has heard of one that goes in the frame of its birth.
            if member.life.frames > 1 {
                output.ended.push(member.life.id);
            }
            work.retire(member);
        }
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
}
