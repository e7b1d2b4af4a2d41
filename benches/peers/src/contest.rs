//! The contest: trackers in turns over the same frames, several rounds, and the median of the rounds.

use std::time::{Duration, Instant};

use scenes::Video;

/// A tracker that takes part.
pub trait Contestant {
    /// A new tracker for the video.
    fn begin(&mut self, video: &Video);
    /// The time of a step on this frame. What it takes to bring the frame into the tracker's own form, and to drop what
    /// it returns, does not count.
    fn step(&mut self, video: &Video, frame: usize) -> Duration;
}

/// A contestant by name.
pub struct Entry {
    /// Whose tracker.
    pub name: &'static str,
    /// The tracker.
    pub tracker: Box<dyn Contestant>,
}

/// How long to run.
#[derive(Clone, Copy, Debug)]
pub struct Plan {
    /// Rounds.
    pub rounds: usize,
    /// Frames before the clock runs.
    pub warm_up: usize,
    /// A contestant's round ends early, but not before two frames, after this time. One that takes twice as long gets no
    /// other round.
    pub budget: Duration,
}

/// Microseconds per step of each contestant, in their order: the mean over the frames of the medians over the rounds, which
/// a disturbance of some rounds does not touch.
pub fn run(video: &Video, entries: &mut [Entry], plan: &Plan) -> Vec<f64> {
    let mut times: Vec<Vec<Vec<f64>>> = entries.iter().map(|_| Vec::new()).collect();
    let mut is_slow = vec![false; entries.len()];
    for _ in 0..plan.rounds {
        for ((entry, rounds), is_slow) in entries.iter_mut().zip(&mut times).zip(&mut is_slow) {
            if !*is_slow {
                let start = Instant::now();
                rounds.push(round(video, entry, plan));
                *is_slow = start.elapsed() > 2 * plan.budget;
            }
        }
    }
    times.iter().map(|rounds| mean_of_medians(rounds)).collect()
}

/// Microseconds of each step after the warm-up.
fn round(video: &Video, entry: &mut Entry, plan: &Plan) -> Vec<f64> {
    let start = Instant::now();
    let mut times = Vec::with_capacity(video.frames.len());
    entry.tracker.begin(video);
    for frame in 0..video.frames.len() {
        let time = entry.tracker.step(video, frame);
        if frame >= plan.warm_up {
            times.push(time.as_secs_f64() * 1e6);
            if times.len() >= 2 && start.elapsed() > plan.budget {
                break;
            }
        }
    }
    times
}

fn mean_of_medians(rounds: &[Vec<f64>]) -> f64 {
    let frames = rounds.iter().map(Vec::len).min().unwrap_or_default();
    let of_frame = |frame: usize| median(&mut rounds.iter().map(|times| times[frame]).collect::<Vec<_>>());
    (0..frames).map(of_frame).sum::<f64>() / frames as f64
}

/// The median, the mean of the middle two of an even number.
pub fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    if values.len() % 2 == 1 { values[middle] } else { 0.5 * (values[middle - 1] + values[middle]) }
}

/// The exponent `b` of `y = a x^b` that fits best where both are logarithmic.
pub fn exponent(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let (x, y) = (logs.iter().map(|l| l.0).sum::<f64>() / n, logs.iter().map(|l| l.1).sum::<f64>() / n);
    let covariance: f64 = logs.iter().map(|l| (l.0 - x) * (l.1 - y)).sum();
    covariance / logs.iter().map(|l| (l.0 - x) * (l.0 - x)).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_has_the_exponent_two() {
        assert!((exponent(&[(1.0, 3.0), (2.0, 12.0), (10.0, 300.0)]) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn the_median_is_in_the_middle() {
        assert_eq!(median(&mut [5.0, 1.0, 3.0]), 3.0);
        assert_eq!(median(&mut [5.0, 1.0, 3.0, 4.0]), 3.5);
    }
}
