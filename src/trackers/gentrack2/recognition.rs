//! Who comes back: before a detection starts a track, the targets that were lost, however, are compared with what it
//! looks like. Where nobody could have seen where a target went, its looks alone can tell.
//!
//! It must look like the lost target, and more so than like anybody else who could be there, seen or not.

use crate::classes::ClassRule;
use crate::geometry::State;

use super::data_association::{Sight, embedding_part, unlikeness};
use super::observations::{Observations, Observed};
use super::parameters::GenTrack2Parameters;
use super::target::Target;

/// Matches from which a target's looks are known.
const KNOWN_HITS: u32 = 5;
/// Largest ratio of heights of one and the same target.
const LARGEST_GROWTH: f64 = 1.4;
/// Where it was last seen, or is thought to be, a target's centre is known to this many of its diagonals ...
const SLACK: f64 = 0.5;
/// ... and somebody else with a detection is near enough to be taken for it.
const RIVAL: f64 = 1.0;

/// Whether a lost target can still be recognised.
pub fn is_remembered(p: &GenTrack2Parameters, target: &Target) -> bool {
    is_known(target) && target.missed <= p.recognition_time
}

fn is_known(target: &Target) -> bool {
    target.confirmed && target.has_looks() && target.life.hits >= KNOWN_HITS
}

/// The lost target that detection `index` looks like.
pub fn find(
    p: &GenTrack2Parameters,
    targets: &[Target],
    observations: &mut Observations,
    index: usize,
    rule: ClassRule,
    sight: &mut Sight<'_, '_>,
) -> Option<usize> {
    if p.recognition_time == 0.0 || sight.image.is_none() {
        return None;
    }
    let Observed { state: detected, detection, .. } = *observations.get(index);
    let mut best = None;
    // The least that tells it from the second best.
    let (mut least, mut second) = (f64::INFINITY, f64::INFINITY);
    for (slot, target) in targets.iter().enumerate() {
        let allowed = rule.allows(target.life.last.class_id, detection.class_id);
        if !allowed || !is_remembered(p, target) || !can_be(p, target, &detected) {
            continue;
        }
        let Some(unlike) = unlikeness(p, target, observations, index, sight) else { continue };
        if unlike < least {
            (least, second) = (unlike, least);
            let found = !target.is_strong() && embedding_part(p, target, observations, index) <= 0.0;
            best = found.then_some(slot);
        } else {
            second = second.min(unlike);
        }
    }
    best.filter(|_| least <= p.recognition_unlikeness && second - least >= p.recognition_margin)
}

/// Whether a target can have got to `detected`, at that size.
fn can_be(p: &GenTrack2Parameters, target: &Target, detected: &State) -> bool {
    let Some(last) = target.history.last() else { return false };
    let growth = detected.h / last.h;
    let reach = if target.is_strong() { RIVAL } else { SLACK + p.recognition_speed * target.missed };
    let within = |from: &State| (*detected - *from).centre_norm() <= reach * last.diagonal();
    (1.0 / LARGEST_GROWTH..=LARGEST_GROWTH).contains(&growth) && (within(&last) || within(&target.state))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::appearance::HogWorkspace;
    use crate::frame::{Detection, Embeddings, Frame};
    use crate::image::{ImageView, PixelFormat};
    use crate::trackers::gentrack2::target::Match;

    const SIDE: u32 = 200;

    /// Whoever is seen has this box: 30 x 40, diagonal 50.
    fn seen() -> State {
        State::new(100.0, 100.0, 30.0, 40.0)
    }

    /// A bright head, a dark body, some texture.
    fn picture() -> Vec<u8> {
        let brightness = |x: u32, y: u32| (if y < 95 { 180 } else { 60 }) + (x * 7 + y * 3) as u8 % 40;
        (0..SIDE * SIDE).map(|i| brightness(i % SIDE, i / SIDE)).collect()
    }

    fn parameters() -> GenTrack2Parameters {
        GenTrack2Parameters {
            recognition_time: 100.0,
            recognition_speed: 0.02,
            recognition_unlikeness: 0.3,
            recognition_margin: 0.1,
            hog_offset: 0.0,
            tone_offset: 0.0,
            tone_share: 0.5,
            ..Default::default()
        }
    }

    /// A scene with one detection in it.
    struct Scene {
        data: Vec<u8>,
        embedding: Option<[f32; 2]>,
    }

    impl Scene {
        fn find(&self, p: &GenTrack2Parameters, targets: &[Target]) -> Option<usize> {
            self.look(true, |observations, sight| find(p, targets, observations, 0, ClassRule::default(), sight))
        }

        fn look<T>(&self, image: bool, ask: impl FnOnce(&mut Observations, &mut Sight<'_, '_>) -> T) -> T {
            let detections = [Detection { rect: seen().into(), score: 0.9, ..Default::default() }];
            let embeddings = self.embedding.as_ref().map(|e| Embeddings::new(e, 2));
            let mut observations = Observations::default();
            observations.prepare(&Frame { embeddings, ..Frame::new(&detections) }, 0.0);
            let view = ImageView::new(&self.data, SIDE, SIDE, 0, PixelFormat::Gray8).unwrap();
            let mut hog = HogWorkspace::default();
            ask(&mut observations, &mut Sight { image: image.then_some(&view), hog: &mut hog })
        }

        /// Lost for 50 ticks, last seen and thought to be at `u`; it looks like the detection but for this share of
        /// its brightness that went elsewhere.
        fn lost(&self, u: f64, strange: f32) -> Target {
            let state = State { u, ..seen() };
            let mut target = Target::born(&Detection { rect: state.into(), score: 0.9, ..Default::default() }, 0, 1);
            target.history.push(0.0, &state, 1);
            target.matched = Match::None;
            target.confirmed = true;
            target.life.hits = 5;
            target.missed = 50.0;
            self.look(true, |observations, sight| {
                let mut looks = observations.looks(0, sight.image, sight.hog).unwrap().clone();
                looks.tones.iter_mut().for_each(|tone| *tone *= 1.0 - strange);
                target.learn_looks(&looks, 0.0);
            });
            target
        }
    }

    fn scene() -> Scene {
        Scene { data: picture(), embedding: None }
    }

    #[test]
    fn a_lost_target_is_recognised_by_its_looks_near_where_it_can_be() {
        let (p, scene) = (parameters(), scene());
        // .5 + .02 * 50 = 1.5 diagonals: 75 px.
        assert_eq!(scene.find(&p, &[scene.lost(174.0, 0.0)]), Some(0));
        assert_eq!(scene.find(&p, &[scene.lost(176.0, 0.0)]), None);
        // From where it is thought to be, too.
        let mut moved = scene.lost(176.0, 0.0);
        moved.state.u = 174.0;
        assert_eq!(scene.find(&p, &[moved]), Some(0));
        // Half of the unlikeness is that of brightness: .5 * .59 and .5 * .61 against .3.
        assert_eq!(scene.find(&p, &[scene.lost(100.0, 0.59)]), Some(0));
        assert_eq!(scene.find(&p, &[scene.lost(100.0, 0.61)]), None);
        // Where there is nothing to see nobody is recognised.
        let targets = [scene.lost(100.0, 0.0)];
        let blind =
            scene.look(false, |observations, sight| find(&p, &targets, observations, 0, ClassRule::default(), sight));
        assert_eq!(blind, None);
        assert_eq!(scene.find(&GenTrack2Parameters { recognition_time: 0.0, ..p }, &targets), None);
    }

    #[test]
    fn it_must_look_more_like_it_than_everybody_else_near_by() {
        let (p, scene) = (parameters(), scene());
        let strong = |u: f64, strange: f32| {
            let mut target = scene.lost(u, strange);
            target.matched = Match::Detection(7);
            target
        };
        // Unlikeness 0 against .11 and .09; the margin is .1.
        assert_eq!(scene.find(&p, &[scene.lost(120.0, 0.22), scene.lost(100.0, 0.0)]), Some(1));
        assert_eq!(scene.find(&p, &[scene.lost(100.0, 0.0), scene.lost(120.0, 0.18)]), None);
        // One that has a detection already is not it, but may be the better likeness or too good a one ...
        assert_eq!(scene.find(&p, &[scene.lost(100.0, 0.22), strong(120.0, 0.0)]), None);
        assert_eq!(scene.find(&p, &[strong(120.0, 0.18), scene.lost(100.0, 0.0)]), None);
        assert_eq!(scene.find(&p, &[strong(120.0, 0.22), scene.lost(100.0, 0.0)]), Some(1));
        // ... if it is within a diagonal.
        assert_eq!(scene.find(&p, &[strong(151.0, 0.0), scene.lost(100.0, 0.0)]), Some(1));
    }

    #[test]
    fn only_known_targets_are_remembered_for_a_time_and_at_their_size() {
        let (p, scene) = (parameters(), scene());
        let found = |change: fn(&mut Target)| {
            let mut target = scene.lost(100.0, 0.0);
            change(&mut target);
            scene.find(&p, &[target]).is_some()
        };
        assert!(found(|t| t.missed = 100.0));
        assert!(!found(|t| t.missed = 101.0));
        assert!(!found(|t| t.confirmed = false));
        assert!(!found(|t| t.life.hits = 4));
        assert!(!found(|t| t.forget_looks()));
        assert!(!found(|t| t.history.clear()));
        // 40 px against 28 and 29.
        assert!(!found(|t| t.history.push(0.0, &State { h: 28.0, ..t.state }, 1)));
        assert!(found(|t| t.history.push(0.0, &State { h: 29.0, ..t.state }, 1)));
    }

    #[test]
    fn embeddings_may_speak_against_it() {
        let scene = Scene { embedding: Some([1.0, 0.0]), ..scene() };
        let mut target = scene.lost(100.0, 0.0);
        assert_eq!(scene.find(&parameters(), std::slice::from_ref(&target)), Some(0));
        target.embedding.learn(&[-1.0, 0.0], 0.0);
        assert_eq!(scene.find(&parameters(), &[target]), None);
    }
}
