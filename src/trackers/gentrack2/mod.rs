//! GenTrack2, one file per step of the paper's Algorithm 1.
//!
//! | step | file |
//! |---|---|
//! | camera motion | [`target`] |
//! | neighbour search | [`neighbours`] |
//! | particle sampling, eq. 3 | [`particle_sampling`] |
//! | swarm guidance, eq. 4-6 | [`swarm`], [`fitness`], [`resampling`] |
//! | data association, eq. 7-8 | [`data_association`], [`observations`], [`residual`] |
//! | strong tracks, eq. 9 | [`strong_update`], [`whiteness`], [`appearance_model`] |
//! | new tracks, eq. 10 | [`new_tracks`], [`reacquisition`], [`recognition`] |
//! | weak tracks, eq. 11-14 | [`weak_motion`], [`common_motion`], [`ageing`], [`covering`] |
//! | removal, eq. 15 | [`removal`] |
//! | velocity regression, eq. 16 | [`velocity_regression`] |
//! | what is reported | [`coasting`], [`reporting`], [`neighbourhoods`] |

mod ageing;
mod appearance_model;
mod border;
mod coasting;
mod common_motion;
mod covering;
mod data_association;
mod fitness;
mod flight;
mod history;
mod lent_particles;
mod median;
mod neighbourhoods;
mod neighbours;
mod new_tracks;
mod observations;
mod parameters;
mod particle_sampling;
mod reacquisition;
mod recognition;
mod removal;
mod reporting;
mod resampling;
mod residual;
mod returns;
mod running_share;
mod strong_update;
mod swarm;
mod target;
mod velocity_regression;
mod weak_motion;
mod whiteness;

pub use parameters::*;

use crate::buffers;
use crate::candidates::OverlapSweep;
use crate::classes::ClassRule;
use crate::faults::{self, Stage};
use crate::frame::Frame;
use crate::geometry::State;
#[cfg(feature = "snapshot")]
use crate::snapshot::{Decoder, Encoder};
use crate::track::{Neighbourhood, Output, Particle};
use crate::tracker::StepContext;
use crate::trackers::TrackingAlgorithm;
use crate::trackers::life::Life;

use coasting::CoastRecord;
use common_motion::CommonMotion;
use covering::Covering;
use data_association::{DataAssociation, Scene, Sight};
use lent_particles::LentParticles;
use neighbourhoods::Neighbourhoods;
use neighbours::Neighbours;
use new_tracks::Births;
use observations::Observations;
use residual::SceneResidual;
use returns::ReturnRecord;
use swarm::{SEARCH_MARGIN, Swarm};
use target::{Match, Target};
use velocity_regression::{Reach, VelocityRegression};
use weak_motion::TrustedMedian;
use whiteness::{Trust, Whiteness};

/// Ticks in a second: the unit of time of all parameters.
const TICKS_PER_SECOND: f64 = 30.0;

/// The tracker.
pub struct GenTrack2 {
    parameters: GenTrack2Parameters,
    memory: Memory,
    work: Workspace,
}

/// What is kept from frame to frame.
#[derive(Default)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
struct Memory {
    /// Live targets, by ascending identity.
    targets: Vec<Target>,
    /// Now, in ticks since the first frame.
    time: f64,
    scene: SceneResidual,
    whiteness: Whiteness,
    record: CoastRecord,
    returns: ReturnRecord,
}

/// Buffers that are only there to be reused.
#[derive(Default)]
struct Workspace {
    /// Ended targets, whose buffers serve the next ones.
    spare: Vec<Target>,
    observations: Observations,
    /// For what is compared among targets, which one search after the other can share.
    sweep: OverlapSweep,
    swarm: Swarm,
    neighbours: Neighbours,
    expanded: Neighbours,
    association: DataAssociation,
    births: Births,
    /// Slots of the confirmed targets that the association left without a detection.
    unseen: Vec<u32>,
    regression: VelocityRegression,
    trusted: TrustedMedian,
    covering: Covering,
    common_motion: CommonMotion,
    states: Vec<State>,
    particles: LentParticles,
    neighbourhoods: Neighbourhoods,
}

impl Workspace {
    /// Lets a target learn looks and velocity from its detection.
    fn learn(
        &mut self,
        p: &GenTrack2Parameters,
        target: &mut Target,
        index: usize,
        frame: &Frame<'_>,
        time: f64,
        ticks: f64,
    ) {
        let image = frame.image.as_ref();
        appearance_model::learn(p, target, &mut self.observations, index, image, &mut self.swarm.hog);
        self.regression.learn(p, target, time, Reach::new(p, ticks));
    }
}

impl GenTrack2 {
    /// A tracker without tracks.
    pub fn new(parameters: GenTrack2Parameters) -> Self {
        Self { parameters, memory: Memory::default(), work: Workspace::default() }
    }

    /// Starts the frame: moves everything with the camera and predicts.
    fn begin_frame(&mut self, frame: &Frame<'_>, ticks: f64) {
        self.work.particles.recall();
        self.memory.time += ticks;
        self.memory.record.decay(ticks);
        self.memory.returns.decay(ticks);
        for target in &mut self.memory.targets {
            if let Some(motion) = &frame.camera_motion {
                target.follow_camera(motion);
            }
            target.previous = target.state;
            target.predicted = particle_sampling::predict(&self.parameters, &target.state, &target.velocity, ticks);
            target.matched = Match::None;
            target.life.next_frame();
        }
    }

    /// Particle sampling of Algorithm 1: initial particles, then swarm guidance.
    fn sample_particles(&mut self, frame: &Frame<'_>, ticks: f64) {
        let (p, work) = (&self.parameters, &mut self.work);
        let targets = &mut self.memory.targets;
        buffers::collect(&mut work.states, targets.iter().map(|t| t.state));
        work.neighbours.search(&mut work.sweep, &work.states, p.neighbour_radius, |_| true);
        for index in 0..targets.len() {
            let (before, rest) = targets.split_at_mut(index);
            let Some((target, after)) = rest.split_first_mut().filter(|(target, _)| !target.dormant) else { continue };
            faults::point(Stage::Particles);
            resampling::refill(target, p.particles as usize);
            particle_sampling::sample(p, target, ticks);
            let looking = p.lambda_s > 0.0
                && target.has_looks()
                && frame.image.is_some_and(|i| work.swarm.hog.prepare(&i, &target.predicted.into(), SEARCH_MARGIN));
            // Nobody is a neighbour of itself, and what is read of the others does not change here.
            let neighbours = work.neighbours.of(index).iter().map(|j| match *j as usize {
                j if j < index => &before[j],
                j => &after[j - index - 1],
            });
            let neighbours = neighbours.map(|other| (other.predicted, other.velocity));
            work.swarm.guide(p, target, neighbours, ticks, looking);
            resampling::resample(p, target);
        }
    }

    fn associate(&mut self, frame: &Frame<'_>, rule: ClassRule) {
        faults::point(Stage::Association);
        let work = &mut self.work;
        if self.parameters.crowd_cost > 0.0 {
            work.observations.measure_crowd(rule);
        }
        let mut sight = Sight { image: frame.image.as_ref(), hog: &mut work.swarm.hog };
        let memory = &mut self.memory;
        let scene = Scene::new(&self.parameters, &memory.scene, &memory.returns);
        let targets = &mut memory.targets;
        let (sweep, observations) = (&mut work.sweep, &mut work.observations);
        work.association.associate(&self.parameters, sweep, targets, observations, scene, rule, &mut sight);
    }

    fn update_strong(&mut self, frame: &Frame<'_>, ticks: f64) {
        let (p, work, memory) = (&self.parameters, &mut self.work, &mut self.memory);
        let trust = memory.whiteness.trust(p);
        for target in &mut memory.targets {
            let Some(index) = target.matched.index() else { continue };
            let observed = work.observations.get(index);
            let (row, detection, detected) = (observed.row, observed.detection, observed.state);
            let telling = residual::is_telling(target, &detection);
            let error = telling.then(|| residual::error(&target.predicted, &detected));
            if target.missed > 0.0 {
                memory.record.found(target, &detection.rect);
                memory.returns.found(target);
            }
            if let Some(error) = &error {
                target.residual.learn(&mut memory.scene, error);
                if let Some(before) = &target.last_error {
                    memory.whiteness.learn(before, error);
                }
            }
            target.last_error = error;
            strong_update::update(p, target, row, &detection, &trust);
            work.learn(p, target, index, frame, memory.time, ticks);
        }
    }

    /// `since_detector` is 0 if the detector did not run.
    fn update_weak(&mut self, frame: &Frame<'_>, ticks: f64, since_detector: f64) {
        let (p, work, targets) = (&self.parameters, &mut self.work, &mut self.memory.targets);
        let (neighbours, states) = (&work.neighbours, &work.states);
        let lonely = |i: usize| !targets[i].is_strong() && neighbours.of(i).is_empty();
        work.expanded.search(&mut work.sweep, states, p.neighbour_radius_expanded, lonely);
        work.neighbourhoods.clear();
        let covered = work.covering.shares(&mut work.sweep, targets);
        let guess_motion = p.common_motion && frame.camera_motion.is_none();
        let shift = if guess_motion { work.common_motion.shift(targets) } else { (0.0, 0.0) };
        for index in 0..targets.len() {
            if targets[index].is_strong() {
                continue;
            }
            let near = match neighbours.of(index) {
                [] => work.expanded.of(index),
                near => near,
            };
            let trusted = work.trusted.over(targets, near);
            if !targets[index].dormant {
                let (state, rule) = weak_motion::moved(p, &targets[index], trusted.as_ref(), ticks);
                work.neighbourhoods.note(targets, index, near, trusted.as_ref(), rule);
                targets[index].state = state;
            }
            let target = &mut targets[index];
            target.state.u += shift.0;
            target.state.v += shift.1;
            target.covered = target.covered.max(covered[index]);
            if since_detector > 0.0 {
                let blamed = since_detector * ageing::pace(p, covered[index], border::is_outside(target, frame.size()));
                target.missed += since_detector;
                target.blamed += blamed;
                target.missed_frames = target.missed_frames.saturating_add(1);
                ageing::age(p, target, trusted.is_some(), blamed);
            }
        }
    }

    fn start_tracks(&mut self, frame: &Frame<'_>, context: &mut StepContext<'_>, ticks: f64, since_detector: f64) {
        let (p, work, memory) = (&self.parameters, &mut self.work, &mut self.memory);
        let rule = context.classes;
        let room = context.max_tracks.saturating_sub(memory.targets.len());
        work.births.choose(p, &memory.targets, &work.observations, &work.association.taken, frame.size(), rule, room);
        // Those born in this frame are not asked whether they are somebody else.
        let known = memory.targets.len();
        work.unseen.clear();
        if !work.births.chosen.is_empty() {
            let slots = memory.targets.iter().zip(0..).filter(|(t, _)| t.confirmed && !t.is_strong());
            work.unseen.extend(slots.map(|(_, slot)| slot));
        }
        for nth in 0..work.births.chosen.len() {
            let index = work.births.chosen[nth];
            let observed = work.observations.get(index as usize);
            let (row, detection) = (observed.row, observed.detection);
            let mut sight = Sight { image: frame.image.as_ref(), hog: &mut work.swarm.hog };
            let (lost, seen, number) = (&memory.targets[..known], &mut work.observations, index as usize);
            let scene = Scene::new(p, &memory.scene, &memory.returns);
            if let Some(found) =
                data_association::latecomer(p, lost, &work.unseen, seen, number, scene, rule, &mut sight)
            {
                let target = &mut memory.targets[found];
                memory.record.found(target, &detection.rect);
                memory.returns.found(target);
                target.matched = Match::Detection(index);
                strong_update::update(p, target, row, &detection, &memory.whiteness.trust(p));
                work.learn(p, target, number, frame, memory.time, ticks);
                continue;
            }
            // Where nobody has looked for a lifetime, who was hidden can be anywhere, or gone.
            let are_about = since_detector <= p.max_missed && memory.returns.is_worth_asking(p);
            let hidden = if are_about { &work.unseen[..] } else { &[] };
            let found = reacquisition::find(p, lost, hidden, seen, number, rule, &mut sight)
                .or_else(|| recognition::find(p, lost, seen, number, rule, &mut sight));
            if let Some(found) = found {
                let target = &mut memory.targets[found];
                if !target.dormant {
                    memory.record.found(target, &detection.rect);
                }
                target.restart_motion(&detection, index);
                strong_update::update(p, target, row, &detection, &Trust::NOMINAL);
                work.learn(p, target, index as usize, frame, memory.time, ticks);
                continue;
            }
            let mut target = work.spare.pop().unwrap_or_else(Target::blank);
            let life = Life::begin(context.ids.take(), row, &detection);
            target.begin(life, index, context.seed, p.particles as usize);
            strong_update::weigh_evidence(p, &mut target);
            target.confirmed |= context.detector_frames == 1;
            work.learn(p, &mut target, index as usize, frame, memory.time, ticks);
            buffers::push(&mut memory.targets, target);
        }
    }

    /// `full` says that there is no room for new tracks: then nobody is only remembered.
    fn remove_expired(&mut self, frame_size: Option<(u32, u32)>, since_detector: f64, full: bool, output: &mut Output) {
        faults::point(Stage::Removal);
        let (p, work, memory) = (&self.parameters, &mut self.work, &mut self.memory);
        let (record, returns) = (&mut memory.record, &mut memory.returns);
        let ended = memory.targets.extract_if(.., |target| {
            if !target.dormant && !removal::is_given_up(p, target) {
                return false;
            }
            // Where nobody has looked for a lifetime, nobody knows who came back meanwhile.
            if !target.dormant && since_detector <= p.max_missed {
                returns.gone(target);
            }
            // Who went out of the image says nothing about predictions within.
            if !target.dormant && !border::is_outside(target, frame_size) {
                record.gone(p, target);
            }
            target.dormant = !full && !removal::is_void(target) && recognition::is_remembered(p, target);
            !target.dormant
        });
        work.spare.extend(ended.inspect(|target| output.ended.push(target.life.id)));
    }

    fn report(&mut self, frame_size: Option<(u32, u32)>, detector_ran: bool, output: &mut Output) {
        let (p, memory) = (&self.parameters, &mut self.memory);
        for target in &mut memory.targets {
            if detector_ran {
                let predicted = !target.dormant
                    && !border::is_outside(target, frame_size)
                    && coasting::is_reported(p, target, &memory.scene, &memory.record);
                target.reported = target.confirmed
                    && (target.is_strong() || predicted)
                    && border::may_be_reported(p, target, frame_size);
            }
            reporting::report(target, output);
        }
    }
}

impl TrackingAlgorithm for GenTrack2 {
    fn step(&mut self, frame: &Frame<'_>, context: &mut StepContext<'_>, output: &mut Output) {
        let frame =
            &Frame { camera_motion: frame.camera_motion.filter(|_| self.parameters.use_camera_motion), ..*frame };
        let ticks_per_frame = TICKS_PER_SECOND / context.frame_rate;
        let ticks = context.elapsed * ticks_per_frame;
        let detector_ran = !frame.detector_skipped;
        self.begin_frame(frame, ticks);
        self.work.observations.prepare(frame, self.parameters.min_score);
        self.sample_particles(frame, ticks);
        if detector_ran {
            self.associate(frame, context.classes);
            self.update_strong(frame, ticks);
        }
        let since_detector = if detector_ran { context.since_detector * ticks_per_frame } else { 0.0 };
        self.update_weak(frame, ticks, since_detector);
        if detector_ran {
            self.start_tracks(frame, context, ticks, since_detector);
        }
        let full = self.memory.targets.len() >= context.max_tracks;
        self.remove_expired(frame.size(), since_detector, full, output);
        self.report(frame.size(), detector_ran, output);
    }

    fn reset(&mut self) {
        self.work.spare.append(&mut self.memory.targets);
        self.memory = Memory::default();
        self.work.particles.recall();
        self.work.neighbourhoods.clear();
    }

    #[cfg(feature = "snapshot")]
    fn save(&self, state: &mut Encoder) {
        state.put(&self.memory);
    }

    #[cfg(feature = "snapshot")]
    fn load(&mut self, state: &mut Decoder<'_>) -> Result<(), crate::Error> {
        self.memory = state.take()?;
        self.work.particles.recall();
        self.work.neighbourhoods.clear();
        Ok(())
    }

    fn particles(&self, id: u64) -> &[Particle] {
        self.work.particles.of(id, &self.memory.targets)
    }

    fn neighbourhood(&self, id: u64) -> Neighbourhood<'_> {
        // Who was found again after weak tracks were moved is none of them any more.
        let found = self.memory.targets.binary_search_by_key(&id, |t| t.life.id);
        let weak = found.is_ok_and(|slot| !self.memory.targets[slot].is_strong());
        if weak { self.work.neighbourhoods.of(id) } else { Neighbourhood::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Detection;
    use crate::tracker::IdSource;

    struct Run {
        tracker: GenTrack2,
        ids: IdSource,
        since_detector: f64,
        detector_frames: u64,
    }

    impl Run {
        /// A frame of ten pairs of people, the back one half hidden by the front one; `None` if the detector rested.
        fn step(&mut self, people_per_pair: Option<usize>) {
            let boxes = |pair: usize| {
                let left = 100.0 * pair as f64;
                [Detection::new(left, 10.0, 40.0, 100.0, 0.9), Detection::new(left + 15.0, 0.0, 40.0, 100.0, 0.9)]
            };
            let shown = people_per_pair.unwrap_or(0);
            let detections: Vec<_> = (0..10).flat_map(|pair| boxes(pair).into_iter().take(shown)).collect();
            let frame = Frame { detector_skipped: people_per_pair.is_none(), ..Frame::new(&detections) };
            self.since_detector += 1.0;
            self.detector_frames += u64::from(!frame.detector_skipped);
            let mut context = StepContext {
                elapsed: 1.0,
                since_detector: self.since_detector,
                detector_frames: self.detector_frames,
                frame_rate: TICKS_PER_SECOND,
                seed: 1,
                max_tracks: 100,
                classes: ClassRule::default(),
                ids: &mut self.ids,
            };
            let mut output = Output::default();
            output.begin(detections.len());
            self.tracker.step(&frame, &mut context, &mut output);
            if !frame.detector_skipped {
                self.since_detector = 0.0;
            }
        }
    }

    fn after(frames: impl IntoIterator<Item = Option<usize>>) -> Memory {
        let tracker = GenTrack2::new(GenTrack2Parameters::default());
        let mut run = Run { tracker, ids: IdSource::starting_at(1), since_detector: 0.0, detector_frames: 0 };
        frames.into_iter().for_each(|shown| run.step(shown));
        run.tracker.memory
    }

    #[test]
    fn who_was_given_up_after_a_rest_of_the_detector_is_not_known_to_be_gone() {
        let seen = || std::iter::repeat_n(Some(2), 40);
        let missed = after(seen().chain(std::iter::repeat_n(Some(1), 80)));
        assert_eq!(missed.targets.len(), 10);
        assert_ne!(missed.returns, ReturnRecord::default());
        let rested = after(seen().chain(std::iter::repeat_n(None, 120)).chain([Some(1)]));
        assert_eq!(rested.targets.len(), 10);
        assert_eq!(rested.returns, ReturnRecord::default());
    }
}
