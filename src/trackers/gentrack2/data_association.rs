//! Data association: the cost matrix of eq. 7-8 averaged over the particles, its gates, and the assignment.

use crate::appearance::HogWorkspace;
use crate::assignment::{Assignment, Edge, UNMATCHED};
use crate::candidates::OverlapSweep;
use crate::classes::ClassRule;
use crate::geometry::{Rect, State};
use crate::image::ImageView;

use super::observations::{Observations, Observed};
use super::parameters::GenTrack2Parameters;
use super::residual::SceneResidual;
use super::returns::ReturnRecord;
use super::target::{Match, Target};

/// Buffers of the association.
#[derive(Default)]
pub struct DataAssociation {
    solver: Assignment,
    edges: Vec<Edge>,
    /// Whether each detection was taken.
    pub taken: Vec<bool>,
}

/// What the association may look at.
pub struct Sight<'a, 'i> {
    /// The frame's image.
    pub image: Option<&'a ImageView<'i>>,
    /// Where descriptors are computed.
    pub hog: &'a mut HogWorkspace,
}

/// What the scene has taught.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    /// How well it is predicted.
    pub residual: &'a SceneResidual,
    /// Cost per tick of a target's time without a match, beyond `lost_cost_after`.
    pub lost_cost: f64,
}

impl<'a> Scene<'a> {
    /// What these records say.
    pub fn new(p: &GenTrack2Parameters, residual: &'a SceneResidual, returns: &ReturnRecord) -> Self {
        Self { residual, lost_cost: returns.lost_cost(p) }
    }
}

impl Sight<'_, '_> {
    /// Whether looks take part in the cost of a target's pairs.
    fn speaks(&self, p: &GenTrack2Parameters, target: &Target) -> bool {
        p.hog_cost > 0.0 && self.image.is_some() && target.has_looks()
    }
}

impl DataAssociation {
    /// Matches targets with detections: sets `matched` of every target and fills `taken`.
    #[allow(clippy::too_many_arguments)]
    pub fn associate(
        &mut self,
        p: &GenTrack2Parameters,
        sweep: &mut OverlapSweep,
        targets: &mut [Target],
        observations: &mut Observations,
        scene: Scene<'_>,
        rule: ClassRule,
        sight: &mut Sight<'_, '_>,
    ) {
        // Where pairs need not overlap, boxes are widened so that pairs within the distance scale do.
        let reach = if p.min_iou > 0.0 { 0.0 } else { p.distance_scale_max };
        let rows = targets.iter().map(|t| widened(&t.predicted, reach));
        let columns = (0..observations.len()).map(|j| widened(&observations.get(j).state, reach));
        self.edges.clear();
        for &(row, column) in sweep.between(rows, columns).pairs {
            let target = &targets[row as usize];
            let cost = pair_cost(p, target, observations, column as usize, scene, rule, p.cost_gate, sight);
            self.edges.extend(cost.map(|cost| Edge { row, column, cost }));
        }
        let columns = self.solver.solve(targets.len(), observations.len(), &self.edges, p.cost_gate);
        self.taken.clear();
        self.taken.resize(observations.len(), false);
        for (target, &column) in targets.iter_mut().zip(columns) {
            target.matched = match column {
                UNMATCHED => Match::None,
                column => {
                    self.taken[column as usize] = true;
                    Match::Detection(column)
                }
            };
        }
    }
}

/// Before a detection starts a track, and so leaves a target and its successor side by side: of the `unseen` targets that
/// are still without a detection the one with which it costs least, up to `late_gate` beyond the gate.
#[allow(clippy::too_many_arguments)]
pub fn latecomer(
    p: &GenTrack2Parameters,
    targets: &[Target],
    unseen: &[u32],
    observations: &mut Observations,
    index: usize,
    scene: Scene<'_>,
    rule: ClassRule,
    sight: &mut Sight<'_, '_>,
) -> Option<usize> {
    if p.late_gate == 0.0 {
        return None;
    }
    let mut best = None;
    let mut gate = p.cost_gate + p.late_gate;
    for slot in unseen.iter().map(|slot| *slot as usize) {
        let target = &targets[slot];
        // It may have been found by now. Whoever is known by looks is recognised by them, or is not the one.
        if target.is_strong() || sight.speaks(p, target) {
            continue;
        }
        if let Some(cost) = pair_cost(p, target, observations, index, scene, rule, gate, sight)
            && (best.is_none() || cost < gate)
        {
            (best, gate) = (Some(slot), cost);
        }
    }
    best
}

/// The cost of a pair, `None` if it is inadmissible or beyond the gate.
#[allow(clippy::too_many_arguments)]
fn pair_cost(
    p: &GenTrack2Parameters,
    target: &Target,
    observations: &mut Observations,
    column: usize,
    scene: Scene<'_>,
    rule: ClassRule,
    gate: f64,
    sight: &mut Sight<'_, '_>,
) -> Option<f64> {
    let observed = observations.get(column);
    if target.dormant || !rule.allows(target.life.last.class_id, observed.detection.class_id) {
        return None;
    }
    // Where looks speak, motion need not be taken less seriously.
    let softness = if sight.speaks(p, target) { 1.0 } else { softness(p, target, scene.residual) };
    let mut cost = motion_part(p, target, observed, scene, softness)?;
    cost += embedding_part(p, target, observations, column);
    // Looking is dear: not where the pair is out already.
    if cost <= gate + p.hog_gate {
        cost += looks_part(p, target, observations, column, sight);
    }
    (cost <= gate).then_some(cost)
}

fn widened(state: &State, reach: f64) -> Rect {
    let half = 0.5 * reach * state.diagonal();
    let (half_width, half_height) = (half.max(0.5 * state.w), half.max(0.5 * state.h));
    Rect::new(state.u - half_width, state.v - half_height, 2.0 * half_width, 2.0 * half_height)
}

/// Eq. 7 and the foot term, or `None` for an inadmissible pair.
fn motion_part(
    p: &GenTrack2Parameters,
    target: &Target,
    observed: &Observed,
    scene: Scene<'_>,
    softness: f64,
) -> Option<f64> {
    let detection = &observed.detection;
    let doubtful = !target.confirmed || target.missed >= p.doubt_after;
    if doubtful && detection.score < p.doubt_score {
        return None;
    }
    if overlap(p, &target.predicted, &observed.state) < p.min_iou {
        return None;
    }
    let scale = distance_scale(p, target, scene.residual) * 0.5 * (target.state.diagonal() + observed.state.diagonal());
    let sum: f64 = target.particles.iter().map(|s| motion_cost(p, &s.state, &observed.state, scale)).sum();
    let motion = sum / target.particles.len() as f64;
    if detection.score < p.low_score && motion > p.low_score_gate {
        return None;
    }
    let foot = (target.predicted.v + 0.5 * target.predicted.h) - (observed.state.v + 0.5 * observed.state.h);
    let foot = (foot.abs() / observed.state.h).min(1.0);
    let lost = scene.lost_cost * (target.missed - p.lost_cost_after).max(0.0);
    Some(
        total_cost(p, softness * motion, detection.score, target.penalty)
            + p.lambda_foot * foot
            + p.crowd_cost * observed.crowd
            + lost,
    )
}

/// Eq. 7 from the particle-averaged motion cost.
fn total_cost(p: &GenTrack2Parameters, motion: f64, score: f64, penalty: f64) -> f64 {
    p.lambda_p * motion + p.lambda_d * (1.0 - score) + p.lambda_h * penalty
}

/// `C_m` of eq. 8.
fn motion_cost(p: &GenTrack2Parameters, particle: &State, detected: &State, scale: f64) -> f64 {
    (1.0 - overlap(p, particle, detected)) * (particle.distance(detected).min(scale) / scale)
}

/// `d_o,d` in mean diagonals: adapts to how well the track is predicted.
fn distance_scale(p: &GenTrack2Parameters, target: &Target, scene: &SceneResidual) -> f64 {
    // Without a velocity the prediction is as far off as the target is fast.
    if !target.motion_is_known() {
        return p.distance_scale_max;
    }
    (p.distance_scale_gain * target.residual.value(scene)).clamp(p.distance_scale_min, p.distance_scale_max)
}

/// What is left of the motion cost of a track whose motion is hard to predict: it says the less about who is who.
fn softness(p: &GenTrack2Parameters, target: &Target, scene: &SceneResidual) -> f64 {
    (p.soft_residual / target.residual.value(scene)).clamp(p.soft_least, 1.0)
}

/// IoU, with `height_overlap` times the square root of the overlap of the vertical extents: people side by side have
/// the same height and foot, people behind each other have not.
fn overlap(p: &GenTrack2Parameters, a: &State, b: &State) -> f64 {
    let (a, b) = (Rect::from(*a), Rect::from(*b));
    let iou = a.iou(&b);
    if !p.height_overlap || iou <= 0.0 {
        return iou;
    }
    let shared = a.bottom().min(b.bottom()) - a.top.max(b.top);
    let whole = a.bottom().max(b.bottom()) - a.top.min(b.top);
    iou * (shared / whole).sqrt()
}

/// Weighted embedding dissimilarity less the room that the gate gives for it.
pub fn embedding_part(p: &GenTrack2Parameters, target: &Target, observations: &Observations, column: usize) -> f64 {
    let distance = observations.embedding(column).and_then(|seen| target.embedding.distance(seen));
    distance.map_or(0.0, |distance| p.embedding_cost * 0.5 * distance - p.embedding_gate)
}

/// Weighted unlikeness less the room that the gate gives for it.
fn looks_part(
    p: &GenTrack2Parameters,
    target: &Target,
    observations: &mut Observations,
    column: usize,
    sight: &mut Sight<'_, '_>,
) -> f64 {
    if p.hog_cost == 0.0 {
        return 0.0;
    }
    let unlike = unlikeness(p, target, observations, column, sight);
    unlike.map_or(0.0, |unlike| p.hog_cost * unlike - p.hog_gate)
}

/// How little a detection looks like a target; `None` where that cannot be told.
pub fn unlikeness(
    p: &GenTrack2Parameters,
    target: &Target,
    observations: &mut Observations,
    column: usize,
    sight: &mut Sight<'_, '_>,
) -> Option<f64> {
    let looks = target.looks()?.recall();
    let seen = observations.looks(column, sight.image, sight.hog)?;
    Some(looks.unlikeness(p, seen))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{Detection, Frame};

    fn literal() -> GenTrack2Parameters {
        GenTrack2Parameters {
            height_overlap: false,
            lambda_d: 0.1,
            lambda_h: 0.1,
            lambda_foot: 0.0,
            soft_least: 1.0,
            ..Default::default()
        }
    }

    /// One that has taught nothing yet.
    fn scene(p: &GenTrack2Parameters) -> Scene<'static> {
        Scene { residual: &SceneResidual::UNKNOWN, lost_cost: p.lost_cost }
    }

    fn target_at(state: State, particles: &[State]) -> Target {
        let mut target =
            Target::born(&Detection { rect: state.into(), score: 0.9, ..Default::default() }, 0, particles.len());
        target.confirmed = true;
        for (particle, state) in target.particles.iter_mut().zip(particles) {
            particle.state = *state;
        }
        target
    }

    #[test]
    fn equation_8_multiplies_iou_cost_and_distance_cost() {
        // 30 x 40 boxes 15 px apart: IoU = 15*40 / (2*1200 - 600) = 1/3; distance 15 of 50: (2/3) * .3 = .2.
        let (a, b) = (State::new(0.0, 0.0, 30.0, 40.0), State::new(15.0, 0.0, 30.0, 40.0));
        assert!((motion_cost(&literal(), &a, &b, 50.0) - 0.2).abs() < 1e-12);
        // Beyond the scale the distance cost is 1.
        assert!((motion_cost(&literal(), &a, &b, 10.0) - 2.0 / 3.0).abs() < 1e-12);
    }

    #[test]
    fn height_overlap_scales_the_iou() {
        // Same left and width, shifted down by half the height: IoU 1/3, vertical overlap 20/60: sqrt(1/3).
        let (a, b) = (State::new(0.0, 0.0, 30.0, 40.0), State::new(0.0, 20.0, 30.0, 40.0));
        let expected = (1.0 / 3.0) * (1.0f64 / 3.0).sqrt();
        assert!((overlap(&GenTrack2Parameters::default(), &a, &b) - expected).abs() < 1e-12);
    }

    #[test]
    fn equation_7_averages_over_particles_and_adds_confidence_and_penalty() {
        let p = GenTrack2Parameters { distance_scale_min: 1.0, distance_scale_max: 1.0, ..literal() };
        let state = State::new(0.0, 0.0, 30.0, 40.0);
        // Particles at 0 and 15 px from the detection: C_m = 0 and .2, mean .1 (the scale is the diagonal, 50 px).
        let mut target = target_at(state, &[state, State::new(15.0, 0.0, 30.0, 40.0)]);
        target.penalty = 0.5;
        let detections = [Detection { rect: state.into(), score: 0.8, ..Default::default() }];
        let mut observations = Observations::default();
        observations.prepare(&Frame::new(&detections), 0.0);
        let cost = motion_part(&p, &target, observations.get(0), scene(&p), 1.0).unwrap();
        // .7 * .1 + .1 * .2 + .1 * .5 = .14.
        assert!((cost - 0.14).abs() < 1e-12, "{cost}");
    }

    #[test]
    fn the_foot_term_tells_boxes_apart_whose_bottoms_differ() {
        let p = GenTrack2Parameters { lambda_foot: 0.2, ..Default::default() };
        let state = State::new(0.0, 0.0, 30.0, 40.0);
        let target = target_at(state, &[state]);
        // Same centre, 8 px taller: the foot differs by 4 px of 48.
        let taller = State::new(0.0, 0.0, 30.0, 48.0);
        let detections = [Detection { rect: taller.into(), score: 1.0, ..Default::default() }];
        let mut observations = Observations::default();
        observations.prepare(&Frame::new(&detections), 0.0);
        let with = motion_part(&p, &target, observations.get(0), scene(&p), 1.0).unwrap();
        let without = GenTrack2Parameters { lambda_foot: 0.0, ..p };
        let without = motion_part(&without, &target, observations.get(0), scene(&without), 1.0).unwrap();
        assert!((with - without - 0.2 * 4.0 / 48.0).abs() < 1e-12);
    }

    #[test]
    fn motion_counts_less_where_it_is_unpredictable() {
        // The scene's residual is .08 of the diagonal: .04/.08 of the motion cost is left, or the least.
        let p = GenTrack2Parameters { soft_residual: 0.04, soft_least: 0.3, ..literal() };
        let target = target_at(State::new(0.0, 0.0, 30.0, 40.0), &[]);
        assert!((softness(&p, &target, &SceneResidual::default()) - 0.5).abs() < 1e-12);
        let p = GenTrack2Parameters { soft_residual: 0.01, ..p };
        assert_eq!(softness(&p, &target, &SceneResidual::default()), 0.3);
        let p = GenTrack2Parameters { soft_residual: 1.0, ..p };
        assert_eq!(softness(&p, &target, &SceneResidual::default()), 1.0);
    }

    #[test]
    fn crowds_and_long_losses_cost() {
        let state = State::new(0.0, 0.0, 30.0, 40.0);
        let mut target = target_at(state, &[state]);
        let cost = |p: &GenTrack2Parameters, target: &Target| {
            // Another one 15 px beside: IoU 1/3.
            let beside = State::new(15.0, 0.0, 30.0, 40.0);
            let detections = [
                Detection::new(-15.0, -20.0, 30.0, 40.0, 1.0),
                Detection { rect: beside.into(), score: 0.9, ..Default::default() },
            ];
            let mut observations = Observations::default();
            observations.prepare(&Frame::new(&detections), 0.0);
            observations.measure_crowd(ClassRule::default());
            motion_part(p, target, observations.get(0), scene(p), 1.0).unwrap()
        };
        let p = GenTrack2Parameters { crowd_cost: 0.0, lost_cost: 0.0, doubt_score: 0.0, ..literal() };
        assert_eq!(cost(&p, &target), 0.0);
        let crowded = GenTrack2Parameters { crowd_cost: 0.3, ..p.clone() };
        assert!((cost(&crowded, &target) - 0.1).abs() < 1e-12);
        // 5 ticks beyond 10.
        target.missed = 15.0;
        let lost = GenTrack2Parameters { lost_cost: 0.02, lost_cost_after: 10.0, ..p };
        assert!((cost(&lost, &target) - 0.1).abs() < 1e-12);
    }

    #[test]
    fn gates_refuse_what_they_name() {
        let p = GenTrack2Parameters::default();
        let state = State::new(0.0, 0.0, 30.0, 40.0);
        let mut target = target_at(state, &[state]);
        target.life.hits = 3;
        let cost = |target: &Target, u: f64, score: f64| {
            let rect = State::new(u, 0.0, 30.0, 40.0).into();
            let mut observations = Observations::default();
            observations.prepare(&Frame::new(&[Detection { rect, score, ..Default::default() }]), 0.0);
            motion_part(&p, target, observations.get(0), scene(&p), 1.0)
        };
        assert!(cost(&target, 2.0, 0.9).is_some());
        // IoU below .1: 26 px apart leaves 4*40 / (2400 - 160) = .07.
        assert!(cost(&target, 26.0, 0.9).is_none());
        // A low score is admissible near by, not from where C_m exceeds .2: 12 px: IoU .4286, d/d_o = 12/24 (the scale
        // is 6 * .08 = .48 diagonals): .2857.
        assert!(cost(&target, 2.0, 0.3).is_some());
        assert!(cost(&target, 12.0, 0.3).is_none());
        assert!(cost(&target, 12.0, 0.9).is_some());
        // Before its velocity is known the scale is a whole diagonal: d/d_o = 12/50, .1371.
        target.life.hits = 2;
        assert!(cost(&target, 12.0, 0.3).is_some());
        // A doubtful track needs a score.
        target.life.hits = 3;
        target.missed = 4.0;
        assert!(cost(&target, 2.0, 0.3).is_none());
        assert!(cost(&target, 2.0, 0.5).is_some());
        target.missed = 0.0;
        target.confirmed = false;
        assert!(cost(&target, 2.0, 0.3).is_none());
    }

    #[test]
    fn confidence_orders_detections_that_lie_equally_well() {
        let p = GenTrack2Parameters::default();
        let state = State::new(0.0, 0.0, 30.0, 40.0);
        let mut targets = [target_at(state, &[state])];
        let at =
            |u: f64, score: f64| Detection { rect: State::new(u, 0.0, 30.0, 40.0).into(), score, ..Default::default() };
        let mut observations = Observations::default();
        observations.prepare(&Frame::new(&[at(3.0, 0.7), at(-3.0, 0.9)]), 0.0);
        let mut association = DataAssociation::default();
        let mut sight = Sight { image: None, hog: &mut HogWorkspace::default() };
        association.associate(
            &p,
            &mut OverlapSweep::default(),
            &mut targets,
            &mut observations,
            scene(&p),
            ClassRule::default(),
            &mut sight,
        );
        let row = targets[0].matched.index().map(|i| observations.get(i).row);
        assert_eq!(row, Some(1));
        assert_eq!(association.taken, [true, false]);
    }

    #[test]
    fn a_latecomer_is_the_cheapest_of_the_unseen_a_little_beyond_the_gate() {
        let state = State::new(0.0, 0.0, 30.0, 40.0);
        let at = |u: f64| State::new(u, 0.0, 30.0, 40.0);
        let unseen = |u: f64| {
            let mut target = target_at(at(u), &[at(u)]);
            target.matched = Match::None;
            target
        };
        let mut observations = Observations::default();
        observations.prepare(&Frame::new(&[Detection { rect: state.into(), score: 1.0, ..Default::default() }]), 0.0);
        let p = GenTrack2Parameters { distance_scale_min: 1.0, cost_gate: 0.05, late_gate: 0.1, ..literal() };
        let mut find = |p: &GenTrack2Parameters, targets: &[Target]| {
            let slots: Vec<u32> = (0..targets.len() as u32).collect();
            let mut sight = Sight { image: None, hog: &mut HogWorkspace::default() };
            latecomer(p, targets, &slots, &mut observations, 0, scene(p), ClassRule::default(), &mut sight)
        };
        // At 12 px the IoU is 3/7 and the distance 12 of 50: .7 * 4/7 * .24 = .096; at 15 px .7 * 2/3 * .3 = .14; at
        // 18 px .7 * 3/4 * .36 = .189, beyond .15.
        let targets = [unseen(18.0), unseen(15.0), unseen(-12.0)];
        assert_eq!(find(&p, &targets), Some(2));
        assert_eq!(find(&p, &targets[..2]), Some(1));
        assert_eq!(find(&p, &targets[..1]), None);
        assert_eq!(find(&GenTrack2Parameters { late_gate: 0.0, ..p.clone() }, &targets), None);
        // One that has been found in the meantime.
        let found = [unseen(15.0), target_at(at(-12.0), &[at(-12.0)])];
        assert_eq!(find(&p, &found), Some(0));
    }

    #[test]
    fn without_an_overlap_gate_pairs_match_up_to_the_distance_scale() {
        let p = GenTrack2Parameters { min_iou: 0.0, cost_gate: 1.0, distance_scale_min: 1.0, ..literal() };
        let state = State::new(0.0, 0.0, 30.0, 40.0);
        let mut association = DataAssociation::default();
        let mut matched = |u: f64| {
            let mut targets = [target_at(state, &[state])];
            let mut observations = Observations::default();
            let rect = State::new(u, 0.0, 30.0, 40.0).into();
            observations.prepare(&Frame::new(&[Detection { rect, score: 0.9, ..Default::default() }]), 0.0);
            let mut sight = Sight { image: None, hog: &mut HogWorkspace::default() };
            association.associate(
                &p,
                &mut OverlapSweep::default(),
                &mut targets,
                &mut observations,
                scene(&p),
                ClassRule::default(),
                &mut sight,
            );
            targets[0].is_strong()
        };
        assert!(matched(45.0));
        assert!(!matched(55.0));
    }
}
