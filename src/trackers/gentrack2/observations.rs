//! The detections of one frame as the steps use them: the usable ones, in an order that does not depend on the
//! caller's, with what they look like.

use crate::appearance::HogWorkspace;
use crate::buffers::{self, make_room};
use crate::candidates::OverlapSweep;
use crate::classes::ClassRule;
use crate::embedding::UnitRows;
use crate::frame::{Detection, Frame};
use crate::geometry::{Rect, State};
use crate::image::ImageView;

use super::appearance_model::Looks;
use super::removal::SMALLEST;

/// Score above which a detection counts as somebody else beside another one.
const SURE: f64 = 0.3;

/// One usable detection.
#[derive(Clone, Debug)]
pub struct Observed {
    /// Row in the frame.
    pub row: u32,
    /// The detection.
    pub detection: Detection,
    /// Its box as a state.
    pub state: State,
    /// The largest IoU with another detection of the frame that is sure enough; 0 before it is measured.
    pub crowd: f64,
    look: Look,
}

/// Whether a detection's looks are known.
#[derive(Clone, Copy, Debug)]
enum Look {
    NotYet,
    Unusable,
    Seen,
}

/// The usable detections of a frame.
#[derive(Clone, Debug, Default)]
pub struct Observations {
    list: Vec<Observed>,
    boxes: Vec<Rect>,
    sweep: OverlapSweep,
    // By index; valid where the look is `Seen`.
    looks: Vec<Looks>,
    embeddings: UnitRows,
}

impl Observations {
    /// Takes the detections of at least `min_score` and with an area worth the name. The order is by score, then box, so that
    /// permuting the caller's rows changes nothing.
    pub fn prepare(&mut self, frame: &Frame<'_>, min_score: f64) {
        self.list.clear();
        let has_area = |r: &Rect| r.width >= SMALLEST && r.height >= SMALLEST;
        let usable = |d: &Detection| d.score >= min_score && has_area(&d.rect);
        let rows = frame.detections.iter().enumerate().filter(|(_, d)| usable(d));
        self.list.extend(rows.map(|(row, d)| Observed {
            row: row as u32,
            detection: *d,
            state: State::from(d.rect),
            crowd: 0.0,
            look: Look::NotYet,
        }));
        self.list.sort_unstable_by(|a, b| {
            let key = |o: &Observed| [-o.detection.score, o.state.u, o.state.v, o.state.w, o.state.h];
            let boxes = key(a).iter().zip(&key(b)).map(|(x, y)| x.total_cmp(y)).find(|o| o.is_ne());
            let rest = |o: &Observed| (o.detection.class_id, o.detection.tag, o.row);
            boxes.unwrap_or_else(|| rest(a).cmp(&rest(b)))
        });
        self.embeddings.fill(frame.embeddings.as_ref(), frame.detections.len());
    }

    /// Sets `crowd` of all.
    pub fn measure_crowd(&mut self, rule: ClassRule) {
        buffers::collect(&mut self.boxes, self.list.iter().map(|o| o.detection.rect));
        for &(a, b) in self.sweep.pairs(&self.boxes, &self.boxes) {
            let (one, other) = (self.list[a as usize].detection, self.list[b as usize].detection);
            if a != b && other.score > SURE && rule.allows(one.class_id, other.class_id) {
                let crowd = &mut self.list[a as usize].crowd;
                *crowd = crowd.max(one.rect.iou(&other.rect));
            }
        }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Detection `index`.
    pub fn get(&self, index: usize) -> &Observed {
        &self.list[index]
    }

    /// The unit embedding of detection `index`; `None` without embeddings, or for a vector of zeros.
    pub fn embedding(&self, index: usize) -> Option<&[f64]> {
        self.embeddings.row(self.list[index].row as usize)
    }

    /// What detection `index` looks like, worked out when first asked for.
    pub fn looks(&mut self, index: usize, image: Option<&ImageView<'_>>, hog: &mut HogWorkspace) -> Option<&Looks> {
        if self.looks.len() <= index {
            make_room(&mut self.looks, self.list.len());
            self.looks.resize(self.list.len(), Looks::NONE);
        }
        let (observed, looks) = (&mut self.list[index], &mut self.looks[index]);
        if let Look::NotYet = observed.look {
            let rect = &observed.detection.rect;
            let seen = image.is_some_and(|i| hog.prepare(i, rect, 1.0))
                && hog.describe(rect, &mut looks.shape)
                && hog.tones(rect, &mut looks.tones);
            observed.look = if seen { Look::Seen } else { Look::Unusable };
        }
        matches!(observed.look, Look::Seen).then_some(&*looks)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Embeddings;

    #[test]
    fn unusable_detections_are_left_out_and_the_rest_is_in_a_fixed_order() {
        let a = Detection::new(5.0, 0.0, 10.0, 10.0, 0.8);
        let b = Detection::new(1.0, 0.0, 10.0, 10.0, 0.8);
        let best = Detection::new(9.0, 0.0, 10.0, 10.0, 0.9);
        let flat = Detection::new(9.0, 0.0, 10.0, 0.0, 0.9);
        let weak = Detection::new(9.0, 0.0, 10.0, 10.0, 0.01);
        let mut observations = Observations::default();
        for (detections, rows) in [([a, flat, b, weak, best], [4, 2, 0]), ([best, weak, b, flat, a], [0, 2, 4])] {
            observations.prepare(&Frame::new(&detections), 0.05);
            let order: Vec<u32> = observations.list.iter().map(|o| o.row).collect();
            assert_eq!(order, rows);
        }
    }

    #[test]
    fn embeddings_stay_with_their_detections() {
        let detections = [Detection::new(0.0, 0.0, 10.0, 10.0, 0.5), Detection::new(0.0, 0.0, 10.0, 10.0, 0.9)];
        let data = [0.0, 0.0, 0.0, 2.0];
        let frame = Frame { embeddings: Some(Embeddings::new(&data, 2)), ..Frame::new(&detections) };
        let mut observations = Observations::default();
        observations.prepare(&frame, 0.0);
        // The better scored detection, row 1, comes first.
        assert_eq!(observations.embedding(0), Some(&[0.0, 1.0][..]));
        assert_eq!(observations.embedding(1), None);
    }
}
