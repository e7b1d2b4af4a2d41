//! The knobs of GenTrack2, with the paper's symbols.
//!
//! Nothing is in pixels: distances are multiples of the target's box. Times are in *ticks* of 1/30 s, so that one set
//! of defaults serves every frame rate: at the default `frame_rate` of 30 a tick is a frame.

use crate::error::Error;
use crate::geometry::Rect;
use crate::parameters::{choice, parameters};
use crate::trackers::TrackingAlgorithm;

choice! {
    /// Where the particles of a frame start.
    pub enum ParticleSource {
        /// At the target's previous optimal state.
        OptimalState = "optimal_state",
        /// At the previous frame's particles.
        PriorParticles = "prior_particles",
    }
}

choice! {
    /// What happens to particles of low fitness after the swarm optimisation.
    pub enum Resampling {
        /// Nothing.
        None = "none",
        /// They are replaced by the global best.
        Global = "global",
        /// They are dropped.
        Discard = "discard",
    }
}

choice! {
    /// The previous state that the history fitness compares with.
    pub enum HistoryReference {
        /// Moved on by its velocity.
        Predicted = "predicted",
        /// As it was: the paper's text.
        Previous = "previous",
    }
}

choice! {
    /// How a matched track takes its detection.
    pub enum StrongUpdate {
        /// Prediction and detection are blended by the detection's confidence.
        Blend = "blend",
        /// The detection replaces the state: the paper's text (eq. 9).
        Replace = "replace",
    }
}

choice! {
    /// How an unmatched track moves.
    pub enum WeakMotion {
        /// By its own velocity alone (eq. 12).
        Own = "own",
        /// With its trustworthy neighbours (eq. 12-14).
        Neighbours = "neighbours",
    }
}

choice! {
    /// Which pairs of past states give slopes.
    pub enum RegressionLags {
        /// Two lags, half and the whole of the window: as accurate as all, at a fraction of the cost.
        Sparse = "sparse",
        /// Every lag up to the window: the paper's text.
        All = "all",
    }
}

parameters! {
    /// Parameters of GenTrack2.
    pub struct GenTrack2Parameters {
        // Particle sampling (eq. 3).
        /// Particles per target.
        particles: i64 = 8, [1, 256], "particles", "S";
        /// Where particles start: the previous optimal state, or the prior particles.
        particle_source: ParticleSource = ParticleSource::OptimalState, [], "", "";
        /// With prior particles: the share of their spread around the target's state that is kept from frame to
        /// frame. Below 1 they are pulled back to the target; 1 is the paper's text, which diverges.
        prior_spread: f64 = 0.3, [0.0, 1.0], "", "";
        /// Contribution of the velocity to the motion.
        velocity_gain: f64 = 1.0, [0.0, 2.0], "", "lambda_V";
        /// Contribution of the random displacement to the motion.
        noise_gain: f64 = 1.0, [0.0, 10.0], "", "lambda_X";
        /// Bound of the random displacement per tick: of the centre in box widths; of the size a quarter of it, in
        /// widths and heights.
        state_noise: f64 = 0.014, [0.0, 1.0], "box widths/tick", "epsilon_X U_X^max";
        /// Bound of the random change of velocity per tick, in the same proportions.
        velocity_noise: f64 = 0.0025, [0.0, 1.0], "box widths/tick", "epsilon_V U_V^max";
        /// Bound of the centre's velocity.
        max_velocity: f64 = 0.5, [0.01, 10.0], "box widths/tick", "V^max (u, v)";
        /// Bound of the size's velocity.
        max_size_velocity: f64 = 0.05, [0.0, 1.0], "box sizes/tick", "V^max (w, h)";
        /// One particle is the prediction itself, the others are drawn in pairs mirrored about it: the noise then
        /// does not shift their mean. Off: independent draws, the paper's text.
        antithetic: bool = true, [], "", "";

        // Swarm optimisation (eq. 4-6).
        /// Swarm iterations per frame; 0 leaves the particles where they were drawn. More than one were not worth their
        /// time on any data set.
        pso_iterations: i64 = 1, [0, 100], "iterations", "";
        /// Share of its swarm velocity that a particle keeps.
        pso_inertia: f64 = 0.5, [0.0, 1.0], "", "";
        /// Pull towards a particle's own best.
        pso_cognitive: f64 = 1.0, [0.0, 4.0], "", "";
        /// Pull towards the swarm's best.
        pso_social: f64 = 1.0, [0.0, 4.0], "", "";
        /// Weight of the history fitness. The three weights are divided by their sum.
        sigma_h: f64 = 0.5, [0.0, 1.0], "", "sigma_h";
        /// Weight of the exploration fitness.
        sigma_p: f64 = 0.2, [0.0, 1.0], "", "sigma_p";
        /// Weight of the social fitness.
        sigma_i: f64 = 0.3, [0.0, 1.0], "", "sigma_i";
        /// Share of appearance in a fitness; motion has the rest, and all of it without an image.
        lambda_s: f64 = 0.8, [0.0, 1.0], "", "lambda_s = 1 - lambda_m";
        /// Distance at which the motion fitness is 0.
        fitness_distance: f64 = 1.0, [0.01, 10.0], "box diagonals", "d_o,m";
        /// Which previous state the history fitness compares with.
        history_reference: HistoryReference = HistoryReference::Predicted, [], "", "";
        /// Share of position in the social fitness; velocity has the rest.
        xi_p: f64 = 0.5, [0.0, 1.0], "", "xi_p = 1 - xi_V";
        /// What happens to particles of low fitness after the optimisation.
        resampling: Resampling = Resampling::Global, [], "", "";
        /// The share of particles that counts as of low fitness; at least one particle always stays.
        resampling_fraction: f64 = 0.25, [0.0, 1.0], "", "";

        // Appearance.
        /// Cosine similarity of HOG vectors that counts as no similarity: they are non-negative, so cosines crowd
        /// near 1. 0 is the raw cosine.
        hog_offset: f64 = 0.3, [0.0, 0.95], "", "";
        /// Share of the old template when a strong track learns its new appearance. Templates have steps of 1/65535: beyond
        /// 0.99 what changes them by less is lost, and with 0.9999 they hardly learn.
        template_momentum: f64 = 0.9, [0.0, 1.0], "", "";
        /// Weight of the unlikeness of looks in the association cost; 0 keeps appearance to the swarm, the paper's
        /// text.
        hog_cost: f64 = 1.0, [0.0, 2.0], "", "";
        /// Added to `cost_gate` where looks take part in the cost.
        hog_gate: f64 = 0.55, [0.0, 2.0], "", "";
        /// Share of brightness, stripe by stripe from head to foot, in the unlikeness of looks; HOG has the rest. It
        /// tells people apart better than HOG does. 0 is the paper's text. The swarm looks at HOG alone.
        tone_share: f64 = 0.6, [0.0, 1.0], "", "";
        /// Bhattacharyya coefficient of brightness histograms that counts as no similarity.
        tone_offset: f64 = 0.65, [0.0, 0.95], "", "";
        /// Before a detection starts a track, targets lost for up to this time whose looks are known are asked whether
        /// it is one of them; such targets are kept so long, wherever they went. 0 turns it off.
        recognition_time: f64 = 120.0, [0.0, 1e6], "ticks", "";
        /// Largest unlikeness at which a lost target is recognised, ...
        recognition_unlikeness: f64 = 0.34, [0.0, 1.0], "", "";
        /// ... by how much everybody else who could be there must be less alike, ...
        recognition_margin: f64 = 0.05, [0.0, 1.0], "", "";
        /// ... and how fast it may have gone.
        recognition_speed: f64 = 0.03, [0.0, 10.0], "box diagonals/tick", "";
        /// Weight of embedding dissimilarity, `(1 - cosine)/2`, in the association cost.
        embedding_cost: f64 = 0.5, [0.0, 2.0], "", "";
        /// Added to `cost_gate` where embeddings take part in the cost.
        embedding_gate: f64 = 0.25, [0.0, 2.0], "", "";

        // Neighbours.
        /// Distance within which another target is a neighbour.
        neighbour_radius: f64 = 0.5, [0.0, 20.0], "box diagonals", "epsilon_nei";
        /// The same for a weak track that found none.
        neighbour_radius_expanded: f64 = 2.0, [0.0, 40.0], "box diagonals", "epsilon_nei^exp";

        // Association (eq. 7-8).
        /// Weight of the motion cost. The paper's three weights sum to 1; here `cost_gate` sets their scale.
        lambda_p: f64 = 0.7, [0.0, 1.0], "", "lambda_p";
        /// Weight of the detection's lack of confidence.
        lambda_d: f64 = 0.14, [0.0, 1.0], "", "lambda_d";
        /// Weight of the track's penalty.
        lambda_h: f64 = 0.08, [0.0, 1.0], "", "lambda_h";
        /// Weight of the difference of the boxes' bottom edges over the detection's height.
        lambda_foot: f64 = 0.14, [0.0, 1.0], "", "";
        /// Multiply the IoU by the square root of the overlap of the boxes' vertical extents.
        height_overlap: bool = true, [], "", "";
        /// Distance cost scale in mean diagonals of track and detection: the smallest ...
        distance_scale_min: f64 = 0.38, [0.01, 10.0], "box diagonals", "d_o,d";
        /// ... and the largest; in between it is `distance_scale_gain` times the track's prediction residual.
        distance_scale_max: f64 = 1.0, [0.01, 10.0], "box diagonals", "d_o,d";
        /// Prediction residuals per distance scale.
        distance_scale_gain: f64 = 8.3, [0.0, 100.0], "", "";
        /// Residual, in box diagonals, from which on the motion cost counts less, in proportion: where targets move
        /// unpredictably it says less about who is who, unless their looks tell ...
        soft_residual: f64 = 0.067, [0.001, 10.0], "box diagonals", "";
        /// ... but never less than this share of it. 1 is the paper's text.
        soft_least: f64 = 0.5, [0.0, 1.0], "", "";
        /// Cost of a detection that overlaps another, times their IoU: in a crowd a box fits several targets.
        crowd_cost: f64 = 0.06, [0.0, 2.0], "", "";
        /// Cost per tick of a track's time without a match, ...
        lost_cost: f64 = 0.0056, [0.0, 1.0], "per tick", "";
        /// ... beyond this time.
        lost_cost_after: f64 = 12.0, [0.0, 1e6], "ticks", "";
        /// How much lost_cost follows the scene: it is multiplied by this power of twice the share of hidden targets that
        /// do not come back. 0: not at all.
        lost_cost_returns: f64 = 0.5, [0.0, 4.0], "", "";
        /// Largest cost of an admissible pair, and the price of leaving a track unmatched.
        cost_gate: f64 = 0.3, [0.0, 2.0], "", "";
        /// Smallest (height-aware) IoU of prediction and detection of an admissible pair. With 0 pairs that do not
        /// overlap are admissible, up to the distance scale.
        min_iou: f64 = 0.12, [0.0, 1.0], "", "";
        /// Detections below this score are ignored.
        min_score: f64 = 0.1, [0.0, 1.0], "", "";
        /// Detections below this score are low ...
        low_score: f64 = 0.68, [0.0, 1.0], "", "";
        /// ... and admissible only up to this motion cost.
        low_score_gate: f64 = 0.2, [0.0, 1.0], "", "";
        /// Tentative tracks, and tracks missed for `doubt_after`, take only detections of at least this score.
        doubt_score: f64 = 0.5, [0.0, 1.0], "", "";
        /// Time without a match after which `doubt_score` applies.
        doubt_after: f64 = 4.0, [0.0, 1e6], "ticks", "";

        // Births (eq. 10).
        /// Smallest score of a detection that starts a track.
        birth_score: f64 = 0.69, [0.0, 1.0], "", "";
        /// A detection of which less than this share is within the image (where its size is known) starts a track ...
        border_birth_share: f64 = 0.5, [0.0, 1.0], "", "";
        /// ... only if its score is at least birth_score times this (but no more than 1): the rest of its box is a guess. 1
        /// turns it off.
        border_birth_factor: f64 = 1.14, [1.0, 10.0], "", "";
        /// A detection that would start a track goes to a confirmed target without one instead if their cost is at most
        /// this much beyond `cost_gate`: that it lives on is likelier than that another is born where it should be. 0
        /// turns it off.
        late_gate: f64 = 0.05, [0.0, 2.0], "", "";
        /// No birth where a track matched or born in this frame overlaps by more than this IoU; 1 turns it off.
        birth_iou: f64 = 0.51, [0.0, 1.0], "", "";
        /// Before a detection starts a track, targets that went out of sight behind another are asked whether it is one
        /// of them: it is if its distance from where they were last seen is within their speed, times this, times the
        /// time they were gone. 0 turns it off.
        reacquire_reach: f64 = 0.5, [0.0, 100.0], "", "";
        /// That is asked only where at least this share of the scene's hidden targets comes back where they are expected:
        /// where most do not, whoever appears is somebody else. 0: everywhere.
        reacquire_returns: f64 = 0.5, [0.0, 1.0], "", "";
        /// Matches in a row, the birth counted, from which a track is confirmed. Births in the first frame are
        /// confirmed at once.
        confirm_hits: i64 = 3, [1, 100], "hits", "";
        /// Evidence that a track needs to be confirmed besides: what its detections' scores exceed evidence_score by,
        /// added up.
        confirm_evidence: f64 = 0.89, [0.0, 100.0], "", "";
        /// Score that is no evidence.
        evidence_score: f64 = 0.45, [0.0, 1.0], "", "";

        // Strong updates (eq. 9).
        /// How a matched track takes its detection.
        strong_update: StrongUpdate = StrongUpdate::Blend, [], "", "";
        /// Weight of a detection of score 1 in the blended centre.
        blend_centre: f64 = 0.78, [0.0, 1.0], "", "";
        /// Weight of a detection of score 1 in the blended size.
        blend_size: f64 = 0.6, [0.0, 1.0], "", "";
        /// How much the two weights adapt to the detector: they grow by this much times the correlation of successive
        /// prediction errors beyond usual_correlation, for errors that point the same way show that the blend lags
        /// behind, and alternating ones that it follows the detector's noise. 0: not at all.
        blend_adaptation: f64 = 0.86, [0.0, 5.0], "", "";
        /// The correlation at which the weights are as they stand.
        usual_correlation: f64 = 0.4, [-1.0, 1.0], "", "";
        /// Distance from the previous state from which a detection is taken half-way only.
        jump_distance: f64 = 1.0, [0.0, 100.0], "box diagonals", "d_o";
        /// Penalty of a match with a detection of score 0; it falls to 0 at score 1. 0 is the paper's text.
        strong_penalty: f64 = 0.27, [0.0, 1.0], "", "X^m,pen";

        // Weak updates (eq. 11-14).
        /// How an unmatched track moves.
        weak_motion: WeakMotion = WeakMotion::Neighbours, [], "", "";
        /// Speed below which a track, or its neighbours' median, counts as standing.
        still_speed: f64 = 0.003, [0.0, 1.0], "box diagonals/tick", "tau_V";
        /// Cosine between the velocities of track and neighbours from which they move together.
        delta_d: f64 = 0.95, [-1.0, 1.0], "", "delta_d";
        /// Ratio of their speeds, the lower over the higher, from which they do: the one who overtakes goes its own
        /// way. 0 is the paper's text.
        speed_ratio: f64 = 0.85, [0.0, 1.0], "", "";
        /// Trust of a weak track in its swarm's global best.
        sigma_g: f64 = 0.3, [0.0, 1.0], "", "sigma_g";
        /// Strength of the push away from neighbours that move otherwise; never more than the track's own speed.
        epsilon_s: f64 = 0.05, [0.0, 1.0], "", "epsilon_s";
        /// Where the frame brings no camera motion, carry weak tracks along with the shift that strong tracks share
        /// beyond their own velocities.
        common_motion: bool = true, [], "", "";
        /// Age at which a weak track ends. With the other defaults max_missed comes first.
        max_age: f64 = 400.0, [1.0, 1e6], "ticks", "partial_max";
        /// History fitness of the global best where there is no image to tell.
        blind_fitness: f64 = 0.9, [0.0, 1.0], "", "f_g,PSO^h";
        /// Least history fitness that ageing reckons with where there is an image: a hidden target looks like what
        /// hides it, which is no reason to end it sooner. 0 is the paper's text.
        fitness_floor: f64 = 0.9, [0.0, 1.0], "", "";
        /// History fitness from which a weak track beside a strong one recovers instead of ageing; 1 turns
        /// recovery off. Needs an image.
        recovery_threshold: f64 = 1.0, [0.0, 1.0], "", "rho_re";
        /// Time without a match, at the paces below, after which a track ends whatever its age.
        max_missed: f64 = 39.0, [0.0, 1e6], "ticks", "";
        /// Pace at which time without a match passes for a weak track that is wholly behind a strong one; 1 for one
        /// in the open, in proportion in between. 1 is the paper's text.
        covered_pace: f64 = 0.57, [0.0, 1.0], "", "";
        /// The same for one whose centre is outside the image (where its size is known), which will hardly come back.
        outside_pace: f64 = 2.0, [0.0, 1000.0], "", "";
        /// Places where targets enter and leave, 1000 at most: weak tracks centred in them age faster.
        entrance_areas: Vec<Rect> = Vec::new(), [], "px", "";
        /// How much faster.
        entrance_penalty: f64 = 0.5, [0.0, 1.0], "", "Delta_e";

        /// Whether targets go along with the camera, where its motion is given.
        use_camera_motion: bool = true, [], "", "";

        // Velocity regression (eq. 16).
        /// Past states used.
        history: i64 = 40, [2, 256], "states", "H";
        /// Longest lag between two of them.
        regression_window: i64 = 10, [1, 256], "states", "F";
        /// Which lags are used once there are enough states.
        regression_lags: RegressionLags = RegressionLags::Sparse, [], "", "";
        /// Largest slope of the centre that counts, ...
        slope_limit: f64 = 0.2, [0.0, 10.0], "box diagonals/tick", "tau (u, v)";
        /// ... and of the size.
        size_slope_limit: f64 = 0.1, [0.0, 10.0], "box sizes/tick", "tau (w, h)";
        /// Time over which a track must have been seen for its velocity to be believed in full: the boxes' jitter over
        /// a few frames looks like speed. The share grows with the square of the time. 0 is the paper's text.
        velocity_doubt: f64 = 5.0, [0.0, 1e3], "ticks", "";

        // Reporting.
        /// A track of whose box less than this share is within the image (where its size is known) is reported only while
        /// the mean score of its last detections is at least birth_score. 0 turns it off.
        border_report_share: f64 = 0.25, [0.0, 1.0], "", "";
        /// Frames without a match for which a confirmed track is still reported.
        report_missed: i64 = 1, [0, 1000], "frames", "";
        /// The same for tracks whose motion has proved predictable.
        coast: f64 = 18.0, [0.0, 1e6], "ticks", "";
        /// Matches such a track must have had.
        coast_hits: i64 = 10, [0, 1_000_000], "hits", "";
        /// Largest prediction residual of such a track, growing by a tenth per tick without a match.
        coast_residual: f64 = 0.22, [0.0, 10.0], "box diagonals", "";
        /// Smallest share of past predictions of lost tracks that proved right for coasting to go on.
        coast_success: f64 = 0.5, [0.0, 1.0], "", "";
    }
}

impl GenTrack2Parameters {
    /// Names of the presets, the default first.
    pub const PRESETS: &'static [&'static str] = &["default", "paper"];

    /// The values of a preset. `paper` is the literal reading of the published equations; what the paper leaves open
    /// (a gate for the assignment, which tracks to report) is as in the defaults.
    pub fn preset(name: &str) -> Option<Self> {
        let defaults = Self::default();
        match name {
            "default" => Some(defaults),
            "paper" => Some(Self {
                prior_spread: 1.0,
                pso_iterations: 3,
                antithetic: false,
                history_reference: HistoryReference::Previous,
                hog_offset: 0.0,
                template_momentum: 0.0,
                hog_cost: 0.0,
                hog_gate: 0.0,
                tone_share: 0.0,
                recognition_time: 0.0,
                embedding_cost: 0.0,
                embedding_gate: 0.0,
                lambda_p: 0.8,
                lambda_d: 0.1,
                lambda_h: 0.1,
                state_noise: 0.01,
                neighbour_radius: 1.0,
                birth_score: 0.7,
                lambda_foot: 0.0,
                height_overlap: false,
                distance_scale_min: 0.4,
                distance_scale_max: 0.4,
                min_iou: 0.0,
                min_score: 0.0,
                low_score_gate: 1.0,
                doubt_score: 0.0,
                birth_iou: 1.0,
                border_birth_factor: 1.0,
                border_report_share: 0.0,
                late_gate: 0.0,
                reacquire_reach: 0.0,
                confirm_hits: 1,
                strong_update: StrongUpdate::Replace,
                strong_penalty: 0.0,
                weak_motion: WeakMotion::Neighbours,
                delta_d: 0.9,
                speed_ratio: 0.0,
                sigma_g: 0.3,
                fitness_floor: 0.0,
                covered_pace: 1.0,
                max_age: 100.0,
                max_missed: 1e6,
                outside_pace: 1.0,
                soft_least: 1.0,
                crowd_cost: 0.0,
                lost_cost: 0.0,
                confirm_evidence: 0.0,
                blend_adaptation: 0.0,
                epsilon_s: 0.05,
                common_motion: false,
                recovery_threshold: 0.8,
                history: 10,
                regression_window: 5,
                regression_lags: RegressionLags::All,
                velocity_doubt: 0.0,
                coast: 0.0,
                ..defaults
            }),
            _ => None,
        }
    }

    /// A tracker with these parameters; refuses combinations that make no sense.
    pub fn build(&self) -> Result<Box<dyn TrackingAlgorithm>, Error> {
        self.check_combinations()?;
        Ok(Box::new(super::GenTrack2::new(self.clone())))
    }

    fn check_combinations(&self) -> Result<(), Error> {
        let refuse = |key: &str, reason: String| Err(Error::ParameterValue { key: key.to_string(), reason });
        if self.sigma_h + self.sigma_p + self.sigma_i <= 0.0 {
            return refuse("sigma_h", "sigma_h, sigma_p and sigma_i must not all be 0".to_string());
        }
        if self.regression_window > self.history {
            let (window, history) = (self.regression_window, self.history);
            return refuse("regression_window", format!("{window} is more than history, {history}"));
        }
        if self.distance_scale_min > self.distance_scale_max {
            let (min, max) = (self.distance_scale_min, self.distance_scale_max);
            return refuse("distance_scale_min", format!("{min} is more than distance_scale_max, {max}"));
        }
        Ok(())
    }
}
