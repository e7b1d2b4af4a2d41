//! Clocks that stand still or run backwards.

use gentrack2::{Algorithm, Error, Tracker};

use crate::for_every_algorithm;
use crate::lanes::{lanes, patient};
use crate::simulator::driver::exact;
use crate::stream::{Given, timed};

/// The exact results of a stream.
fn transcript(tracker: &mut Tracker, stream: &[Given]) -> Vec<String> {
    stream.iter().map(|given| exact(tracker.step(&given.frame()).unwrap())).collect()
}

/// The same with calls in between that must be refused for their time.
fn with_intruders(tracker: &mut Tracker, stream: &[Given], intruder: impl Fn(usize) -> Option<Given>) -> Vec<String> {
    let mut refused = 0;
    let results = stream.iter().enumerate().map(|(at, given)| {
        let result = exact(tracker.step(&given.frame()).unwrap());
        if let Some(intruder) = intruder(at) {
            let error = tracker.step(&intruder.frame()).map(exact).unwrap_err();
            assert!(matches!(error, Error::Timestamp(_)), "{error}");
            assert_eq!(exact(tracker.output()), result, "the results of the last good frame stay");
            refused += 1;
        }
        result
    });
    let results = results.collect();
    assert!(refused >= 15, "{refused} were refused");
    results
}

for_every_algorithm! {
    fn a_frame_from_the_past_is_refused_and_leaves_no_trace(algorithm: Algorithm) {
        let stream = timed(&lanes(1), false);
        let expected = transcript(&mut patient(algorithm, &[]), &stream);
        let late = |at: usize| (at % 7 == 5).then(|| stream[at - 1 - at % 4].clone());
        assert_eq!(with_intruders(&mut patient(algorithm, &[]), &stream, late), expected);
    }

    fn a_frame_given_twice_with_its_timestamp_is_refused_and_leaves_no_trace(algorithm: Algorithm) {
        let stream = timed(&lanes(2), false);
        let expected = transcript(&mut patient(algorithm, &[]), &stream);
        let twice = |at: usize| at.is_multiple_of(3).then(|| stream[at].clone());
        assert_eq!(with_intruders(&mut patient(algorithm, &[]), &stream, twice), expected);
    }
}
