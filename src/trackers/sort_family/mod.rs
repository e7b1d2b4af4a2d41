//! What SORT and OC-SORT have in common: runs of matches that decide what is reported, and an association over all
//! pairs from which those that overlap too little are dropped afterwards.

mod certain_pairs;
mod dominant_pairs;
mod full_association;
mod numbering;
mod open_pairs;
mod run;
mod valued;

pub use full_association::{Extra, FullAssociation, too_many};
pub use run::Run;

use crate::faults::{self, Stage};
use crate::track::{Output, Track};

/// Judges the tracks from the newest to the oldest: lists those that stay, ends those that go. One walk, for in a large
/// scene it is the walks over the tracks that take time.
pub fn list_and_remove<T>(
    tracks: &mut Vec<T>,
    output: &mut Output,
    judge: impl Fn(&mut T),
    is_over: impl Fn(&T) -> bool,
    shown: impl Fn(&T) -> (Track, bool),
    mut retire: impl FnMut(T),
) {
    let mut all_stay = true;
    for track in tracks.iter_mut().rev() {
        judge(track);
        if is_over(track) {
            all_stay = false;
        } else {
            let (track, reported) = shown(track);
            output.list(track, reported);
        }
    }
    if all_stay {
        return;
    }
    faults::point(Stage::Removal);
    for track in tracks.extract_if(.., |t| is_over(t)) {
        output.ended.push(shown(&track).0.id);
        retire(track);
    }
}
