//! New tracks: unmatched detections of enough confidence start a target (eq. 10).

use crate::classes::ClassRule;
use crate::frame::Detection;
use crate::geometry::Rect;

use super::border;
use super::observations::Observations;
use super::parameters::GenTrack2Parameters;
use super::target::Target;

/// A place that a track with a detection holds.
#[derive(Clone, Copy, Debug)]
struct Claim {
    rect: Rect,
    class: i32,
}

/// Decides which detections start a track.
#[derive(Clone, Debug, Default)]
pub struct Births {
    // Boxes of tracks that have a detection in this frame, by their left edge.
    claimed: Vec<Claim>,
    widest: f64,
    /// The observations that start a track, best score first.
    pub chosen: Vec<u32>,
}

impl Births {
    /// Chooses at most `room` of the detections that were not taken. A detection on top of a strong or new track is a
    /// second look at the same object, not another one.
    #[allow(clippy::too_many_arguments)]
    pub fn choose(
        &mut self,
        p: &GenTrack2Parameters,
        targets: &[Target],
        observations: &Observations,
        taken: &[bool],
        frame_size: Option<(u32, u32)>,
        rule: ClassRule,
        room: usize,
    ) {
        self.chosen.clear();
        self.claimed.clear();
        let strong = targets.iter().filter(|t| t.is_strong());
        self.claimed.extend(strong.map(|t| Claim { rect: t.state.into(), class: t.life.last.class_id }));
        self.claimed.sort_unstable_by(|a, b| a.rect.left.total_cmp(&b.rect.left));
        self.widest = self.claimed.iter().map(|c| c.rect.width).fold(0.0, f64::max);
        let check = p.birth_iou < 1.0;
        for index in (0..observations.len()).filter(|i| !taken[*i]) {
            let detection = &observations.get(index).detection;
            if detection.score < p.birth_score || self.chosen.len() >= room {
                break;
            }
            if !border::may_start(p, detection, frame_size) {
                continue;
            }
            if check && self.overlaps(detection, p.birth_iou, rule) {
                continue;
            }
            self.chosen.push(index as u32);
            if check {
                self.claim(Claim { rect: detection.rect, class: detection.class_id });
            }
        }
    }

    fn overlaps(&self, detection: &Detection, limit: f64, rule: ClassRule) -> bool {
        let rect = &detection.rect;
        let from = self.claimed.partition_point(|c| c.rect.left < rect.left - self.widest);
        let near = self.claimed[from..].iter().take_while(|c| c.rect.left < rect.right());
        near.into_iter().any(|c| rule.allows(c.class, detection.class_id) && c.rect.iou(rect) > limit)
    }

    fn claim(&mut self, claim: Claim) {
        let at = self.claimed.partition_point(|c| c.rect.left < claim.rect.left);
        self.claimed.insert(at, claim);
        self.widest = self.widest.max(claim.rect.width);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{Detection, Frame};

    const SIZE: Option<(u32, u32)> = Some((200, 100));

    fn chosen_rows(p: &GenTrack2Parameters, targets: &[Target], detections: &[Detection], room: usize) -> Vec<u32> {
        let mut observations = Observations::default();
        observations.prepare(&Frame::new(detections), 0.0);
        let mut births = Births::default();
        births.choose(p, targets, &observations, &vec![false; detections.len()], SIZE, ClassRule::default(), room);
        births.chosen.iter().map(|i| observations.get(*i as usize).row).collect()
    }

    #[test]
    fn equation_10_asks_for_confidence() {
        let detections = [
            Detection::new(0.0, 0.0, 10.0, 10.0, 0.69),
            Detection::new(50.0, 0.0, 10.0, 10.0, 0.7),
            Detection::new(90.0, 0.0, 10.0, 10.0, 0.95),
        ];
        let p = GenTrack2Parameters { birth_score: 0.7, ..Default::default() };
        assert_eq!(chosen_rows(&p, &[], &detections, 10), [2, 1]);
        assert_eq!(chosen_rows(&p, &[], &detections, 1), [2]);
    }

    #[test]
    fn at_the_border_more_confidence_is_asked() {
        // 4 of 10 columns are within the image.
        let detections = [Detection::new(196.0, 0.0, 10.0, 10.0, 0.84), Detection::new(-6.0, 50.0, 10.0, 10.0, 0.85)];
        let p = GenTrack2Parameters {
            birth_score: 0.75,
            border_birth_share: 0.5,
            border_birth_factor: 1.125,
            ..Default::default()
        };
        assert_eq!(chosen_rows(&p, &[], &detections, 10), [1]);
        let off = GenTrack2Parameters { border_birth_factor: 1.0, ..p };
        assert_eq!(chosen_rows(&off, &[], &detections, 10), [1, 0]);
    }

    #[test]
    fn nothing_is_born_on_top_of_a_strong_or_new_track() {
        let strong = Target::born(&Detection::new(100.0, 0.0, 10.0, 10.0, 0.9), 0, 1);
        let detections = [
            // IoU with the strong track 90/110 = .82.
            Detection::new(101.0, 0.0, 10.0, 10.0, 0.9),
            // Two looks at one object.
            Detection::new(0.0, 0.0, 10.0, 10.0, 0.8),
            Detection::new(2.0, 0.0, 10.0, 10.0, 0.75),
        ];
        let p = GenTrack2Parameters { birth_iou: 0.5, ..Default::default() };
        assert_eq!(chosen_rows(&p, std::slice::from_ref(&strong), &detections, 10), [1]);
        let off = GenTrack2Parameters { birth_iou: 1.0, ..Default::default() };
        assert_eq!(chosen_rows(&off, &[strong], &detections, 10), [0, 1, 2]);
    }
}
