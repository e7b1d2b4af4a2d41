//! Velocity regression (eq. 16): per component the median of slopes between pairs of past observed states.
//!
//! ```text
//! Gamma = { (X_j - X_i) / (t_j - t_i) : 0 < j - i <= F, both within the last H, |slope| <= tau }
//! V     = median of Gamma, 0 if empty
//! ```
//! times the share of it that is believed of a track seen for a short time.
//!
//! Of an even number the median is the mean of the middle two. Only states that a detection confirmed take part, so a
//! track that coasts does not learn from itself.

use crate::geometry::State;

use super::history::Observation;
use super::median::{OrderKey, median_near};
use super::parameters::{GenTrack2Parameters, RegressionLags};
use super::target::Target;

/// States from which on the sparse lags are used.
const SPARSE_FROM: usize = 12;
/// At low frame rates `H` and `F` shrink with the number of frames in their time, but not below these.
const FEWEST_STATES: f64 = 10.0;
const FEWEST_LAGS: f64 = 4.0;

/// The regression's reach in states for the present frame rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reach {
    /// Past states, `H`.
    pub states: usize,
    /// Longest lag, `F`.
    pub window: usize,
}

impl Reach {
    /// Of frames `ticks` apart.
    pub fn new(p: &GenTrack2Parameters, ticks: f64) -> Self {
        let scaled = |nominal: i64, fewest: f64| {
            let most = nominal as f64;
            (most / ticks).round().clamp(fewest.min(most), most) as usize
        };
        Self { states: scaled(p.history, FEWEST_STATES), window: scaled(p.regression_window, FEWEST_LAGS) }
    }
}

/// Buffers, shared by all targets: the slopes of each component, and keys to select by.
#[derive(Clone, Debug, Default)]
pub struct VelocityRegression {
    /// Times of the states, from the oldest on.
    times: Vec<f64>,
    slopes: [Vec<f32>; 4],
    keys: Vec<OrderKey>,
}

impl VelocityRegression {
    /// Adds the target's new state to its history and regresses its velocity.
    pub fn learn(&mut self, p: &GenTrack2Parameters, target: &mut Target, time: f64, reach: Reach) {
        target.history.push(time, &target.state, reach.states);
        let centre = p.slope_limit * target.state.diagonal();
        let (width, height) = (p.size_slope_limit * target.state.w, p.size_slope_limit * target.state.h);
        let limits = [centre, centre, width, height].map(|x| x as f32);
        self.collect_slopes(target.history.in_order(), p.regression_lags, reach.window, &limits);
        // From frame to frame few slopes come and go, so the velocity so far is near the middle.
        let before = [target.velocity.u, target.velocity.v, target.velocity.w, target.velocity.h];
        let middle = |i: usize| f64::from(median_near(&self.slopes[i], before[i] as f32, &mut self.keys));
        let [u, v, w, h] = std::array::from_fn(middle);
        let seen = self.times.last().copied().unwrap_or(0.0);
        target.velocity = State::new(u, v, w, h) * trust(p, seen);
    }

    fn collect_slopes(&mut self, history: &[Observation], lags: RegressionLags, window: usize, limits: &[f32; 4]) {
        self.times.clear();
        let mut time = 0.0;
        for (index, observation) in history.iter().enumerate() {
            time += if index > 0 { f64::from(observation.since) } else { 0.0 };
            self.times.push(time);
        }
        let lags = Lags::new(lags, window, history.len());
        let most = lags.iter().map(|lag| history.len().saturating_sub(lag)).sum();
        // Every slope is written, but the next one over it if it does not count: without a branch.
        self.slopes.iter_mut().for_each(|list| list.resize(most, 0.0));
        let mut counts = [0; 4];
        for lag in lags.iter() {
            let (later, later_times) =
                (history.get(lag..).unwrap_or_default(), self.times.get(lag..).unwrap_or_default());
            for (((from, to), begin), end) in history.iter().zip(later).zip(&self.times).zip(later_times) {
                let per_tick = 1.0 / (end - begin) as f32;
                for i in 0..4 {
                    let slope = (to.state[i] - from.state[i]) * per_tick;
                    self.slopes[i][counts[i]] = slope;
                    counts[i] += usize::from(slope.abs() <= limits[i]);
                }
            }
        }
        self.slopes.iter_mut().zip(counts).for_each(|(list, count)| list.truncate(count));
    }
}

/// The share of a velocity regressed over so many ticks that is believed: jitter of the boxes over a short time looks like
/// speed.
fn trust(p: &GenTrack2Parameters, seen: f64) -> f64 {
    if seen < p.velocity_doubt { (seen / p.velocity_doubt) * (seen / p.velocity_doubt) } else { 1.0 }
}

/// Lags in states: every one up to the window, or half the window and the window.
#[derive(Clone, Copy, Debug)]
struct Lags {
    step: usize,
    window: usize,
}

impl Lags {
    fn new(kind: RegressionLags, window: usize, states: usize) -> Self {
        let sparse = kind == RegressionLags::Sparse && states >= SPARSE_FROM && window >= 2;
        Self { step: if sparse { window / 2 } else { 1 }, window }
    }

    fn iter(self) -> impl Iterator<Item = usize> {
        (1..).map(move |k| k * self.step).take_while(move |lag| *lag <= self.window)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Detection;

    fn regress(p: &GenTrack2Parameters, track: &[(f64, f64)]) -> State {
        let mut target = Target::born(&Detection::new(0.0, 0.0, 30.0, 40.0, 0.9), 0, 1);
        let reach = Reach::new(p, 1.0);
        let mut regression = VelocityRegression::default();
        for &(time, u) in track {
            target.state.u = u;
            regression.learn(p, &mut target, time, reach);
        }
        target.velocity
    }

    fn all(history: i64, regression_window: i64) -> GenTrack2Parameters {
        let regression_lags = RegressionLags::All;
        GenTrack2Parameters { history, regression_window, regression_lags, velocity_doubt: 0.0, ..Default::default() }
    }

    #[test]
    fn equation_16_takes_the_middle_of_an_odd_number_of_slopes() {
        // u = 0, 2, 3 at t = 0, 1, 2, F = 2: slopes 2, 1 (lag 1), 1.5 (lag 2): sorted 1, 1.5, 2.
        assert_eq!(regress(&all(10, 2), &[(0.0, 0.0), (1.0, 2.0), (2.0, 3.0)]).u, 1.5);
    }

    #[test]
    fn equation_16_takes_the_mean_of_the_middle_two_of_an_even_number() {
        // F = 1: slopes 2 and 1.
        assert_eq!(regress(&all(10, 1), &[(0.0, 0.0), (1.0, 2.0), (2.0, 3.0)]).u, 1.5);
        // u = 0, 1, 3, 6, 10: slopes 1, 2, 3, 4: (2 + 3) / 2.
        let track = [(0.0, 0.0), (1.0, 1.0), (2.0, 3.0), (3.0, 6.0), (4.0, 10.0)];
        assert_eq!(regress(&all(10, 1), &track).u, 2.5);
    }

    #[test]
    fn equation_16_without_slopes_is_zero() {
        assert_eq!(regress(&all(10, 5), &[(0.0, 7.0)]).u, 0.0);
    }

    #[test]
    fn slopes_beyond_tau_do_not_count() {
        // tau = .2 * 50 = 10 px/tick: the jump by 200 and back leaves slopes 2, 2 and 2 of lag 1.
        let track = [(0.0, 0.0), (1.0, 2.0), (2.0, 4.0), (3.0, 204.0), (4.0, 8.0), (5.0, 10.0)];
        assert_eq!(regress(&all(10, 1), &track).u, 2.0);
    }

    #[test]
    fn gaps_divide_by_their_time_and_old_states_are_forgotten() {
        // 3 px/tick throughout, seen at irregular times.
        let track = [(0.0, 0.0), (1.0, 3.0), (4.0, 12.0), (5.0, 15.0), (9.0, 27.0)];
        assert_eq!(regress(&all(10, 4), &track).u, 3.0);
        // H = 3: only the last three states, which stand still, are left.
        let track = [(0.0, 0.0), (1.0, 5.0), (2.0, 10.0), (3.0, 10.0), (4.0, 10.0)];
        assert_eq!(regress(&all(3, 2), &track).u, 0.0);
    }

    #[test]
    fn sparse_lags_agree_on_a_straight_line() {
        let track: Vec<(f64, f64)> = (0..30).map(|t| (t as f64, 1.5 * t as f64)).collect();
        let p = GenTrack2Parameters { velocity_doubt: 0.0, ..Default::default() };
        assert_eq!(regress(&p, &track).u, 1.5);
    }

    #[test]
    fn a_track_seen_for_a_short_time_is_believed_in_part() {
        // Slopes 2, 1 and 1.5, seen over 2 ticks: with a doubt of 4, (2 / 4)^2 of 1.5; with one of 2 or less, all.
        let track = [(0.0, 0.0), (1.0, 2.0), (2.0, 3.0)];
        let with = |velocity_doubt| regress(&GenTrack2Parameters { velocity_doubt, ..all(10, 2) }, &track).u;
        assert_eq!(with(4.0), 0.375);
        assert_eq!(with(2.0), 1.5);
        assert_eq!(with(1.0), 1.5);
    }

    #[test]
    fn reach_shrinks_with_the_frame_rate_but_not_to_nothing() {
        let p = GenTrack2Parameters::default();
        // H = 40, F = 10 at 30 frames/s; at 15: 20 and 5; at 7.5 (4 ticks): 10 and max(2.5, 4) = 4.
        assert_eq!(Reach::new(&p, 1.0), Reach { states: 40, window: 10 });
        assert_eq!(Reach::new(&p, 2.0), Reach { states: 20, window: 5 });
        assert_eq!(Reach::new(&p, 4.0), Reach { states: 10, window: 4 });
        // At 120 frames/s they stay at what was configured.
        assert_eq!(Reach::new(&p, 0.25), Reach { states: 40, window: 10 });
    }
}
