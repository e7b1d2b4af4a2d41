//! What a target remembers of its looks: learnt when a detection is taken, never while it is hidden.

use crate::appearance::{
    CELLS_Y, DESCRIPTOR_LEN, Descriptor, HogWorkspace, STRIPES, TONES_LEN, Tones, cosine, normalize,
};
use crate::image::ImageView;

use super::fitness::appearance;
use super::observations::Observations;
use super::parameters::GenTrack2Parameters;
use super::target::Target;

/// Rows of which both parts of the looks are made, from the top down.
pub const ROWS: usize = CELLS_Y;
const _: () = assert!(CELLS_Y == STRIPES, "rows of cells and stripes are the same parts of a box");

/// What a box looks like in the image.
#[derive(Clone, Debug)]
pub struct Looks {
    /// HOG vector.
    pub shape: Descriptor,
    /// Histogram of brightness.
    pub tones: Tones,
}

/// Looks as a target keeps them: with images they are most of what it takes. All numbers are in `[0, 1]`, and a unit is
/// cut into as many steps as 16 bits tell apart.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct LearntLooks {
    #[cfg_attr(feature = "snapshot", serde(with = "crate::snapshot::numbers"))]
    shape: [u16; DESCRIPTOR_LEN],
    #[cfg_attr(feature = "snapshot", serde(with = "crate::snapshot::numbers"))]
    tones: [u16; TONES_LEN],
}

impl LearntLooks {
    pub fn new(seen: &Looks) -> Self {
        Self { shape: packed(&seen.shape), tones: packed(&seen.tones) }
    }

    pub fn recall(&self) -> Looks {
        Looks { shape: unpacked(&self.shape), tones: unpacked(&self.tones) }
    }

    /// Blends in what is seen; `momentum` is the share of what was known.
    pub fn blend(&mut self, seen: &Looks, momentum: f64) {
        let mut known = self.recall();
        blend(&mut known.shape, &seen.shape, momentum);
        blend(&mut known.tones, &seen.tones, momentum);
        *self = Self::new(&known);
    }
}

/// Steps in a unit.
const STEPS: f32 = u16::MAX as f32;

fn packed<const N: usize>(numbers: &[f32; N]) -> [u16; N] {
    numbers.map(|x| (x * STEPS + 0.5) as u16)
}

fn unpacked<const N: usize>(steps: &[u16; N]) -> [f32; N] {
    steps.map(|x| f32::from(x) / STEPS)
}

impl Looks {
    /// Those of nothing.
    pub const NONE: Looks = Looks { shape: [0.0; DESCRIPTOR_LEN], tones: [0.0; TONES_LEN] };

    /// How little alike two boxes look, in `[0, 1]`: by shape as in eq. 5, and by brightness likewise.
    pub fn unlikeness(&self, p: &GenTrack2Parameters, other: &Looks) -> f64 {
        let shape = appearance(cosine(&self.shape, &other.shape) as f64, p.hog_offset);
        let tones = appearance(cosine(&self.tones, &other.tones) as f64, p.tone_offset);
        1.0 - ((1.0 - p.tone_share) * shape + p.tone_share * tones)
    }

    /// What is left of them when only some of the rows, from the top down, can be seen.
    pub fn of_rows(&self, visible: &[bool; ROWS]) -> Looks {
        let mut part = self.clone();
        hide(&mut part.shape, visible);
        hide(&mut part.tones, visible);
        part
    }
}

/// Learns from observation `index`: running means of looks and embedding, kept at length 1.
pub fn learn(
    p: &GenTrack2Parameters,
    target: &mut Target,
    observations: &mut Observations,
    index: usize,
    image: Option<&ImageView<'_>>,
    hog: &mut HogWorkspace,
) {
    if let Some(seen) = observations.looks(index, image, hog) {
        target.learn_looks(seen, p.template_momentum);
    }
    if let Some(seen) = observations.embedding(index) {
        target.embedding.learn(seen, p.template_momentum);
    }
}

fn hide<const N: usize>(vector: &mut [f32; N], visible: &[bool; ROWS]) {
    let rows = vector.chunks_exact_mut(N / ROWS).zip(visible);
    rows.filter(|(_, visible)| !**visible).for_each(|(row, _)| row.fill(0.0));
    normalize(vector);
}

fn blend<const N: usize>(memory: &mut [f32; N], seen: &[f32; N], momentum: f64) {
    for (old, new) in memory.iter_mut().zip(seen) {
        *old = (momentum * *old as f64 + (1.0 - momentum) * *new as f64) as f32;
    }
    normalize(memory);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{Detection, Embeddings, Frame};

    /// Looks whose cosines with those of `looks(1.0, 1.0)` are the arguments.
    fn looks(shape: f32, tones: f32) -> Looks {
        let mut looks = Looks::NONE;
        (looks.shape[0], looks.shape[1]) = (shape, (1.0 - shape * shape).sqrt());
        (looks.tones[0], looks.tones[1]) = (tones, (1.0 - tones * tones).sqrt());
        looks
    }

    #[test]
    fn unlikeness_weighs_shape_and_brightness() {
        let p = GenTrack2Parameters { hog_offset: 0.5, tone_offset: 0.8, tone_share: 0.25, ..Default::default() };
        let one = looks(1.0, 1.0);
        assert!(one.unlikeness(&p, &one) < 1e-6);
        // Shape (.8 - .5) / .5 = .6, brightness (.85 - .8) / .2 = .25: 1 - (.75 * .6 + .25 * .25) = .4875.
        assert!((one.unlikeness(&p, &looks(0.8, 0.85)) - 0.4875).abs() < 1e-5);
        // Below the offset there is no likeness, however little there is.
        assert_eq!(one.unlikeness(&p, &looks(0.3, 0.1)), 1.0);
        let paper = GenTrack2Parameters { hog_offset: 0.0, tone_share: 0.0, ..p };
        assert!((one.unlikeness(&paper, &looks(0.8, 0.1)) - 0.2).abs() < 1e-6);
    }

    #[test]
    fn hidden_rows_do_not_count() {
        let p = GenTrack2Parameters { hog_offset: 0.0, tone_offset: 0.0, ..Default::default() };
        // Alike in the first row alone.
        let mut other = looks(1.0, 1.0);
        for looks in [&mut other.shape[..], &mut other.tones[..]] {
            *looks.last_mut().unwrap() = 3.0;
        }
        let head = std::array::from_fn(|row| row == 0);
        assert!(looks(1.0, 1.0).unlikeness(&p, &other.of_rows(&head)) < 1e-6);
        let foot = std::array::from_fn(|row| row == ROWS - 1);
        assert_eq!(looks(1.0, 1.0).unlikeness(&p, &other.of_rows(&foot)), 1.0);
        assert_eq!(looks(1.0, 1.0).unlikeness(&p, &other.of_rows(&[false; ROWS])), 1.0);
    }

    #[test]
    fn looks_are_averaged_and_kept_at_length_one() {
        let mut memory = LearntLooks::new(&looks(1.0, 1.0));
        memory.blend(&looks(0.0, 0.0), 0.75);
        // (.75, .25), of length sqrt(.625), to the nearest step.
        let known = memory.recall();
        for vector in [&known.shape[..2], &known.tones[..2]] {
            assert!((vector[0] - 0.75 / 0.625f32.sqrt()).abs() <= 0.5001 / STEPS);
            assert!((vector[1] - 0.25 / 0.625f32.sqrt()).abs() <= 0.5001 / STEPS);
        }
    }

    #[test]
    fn embeddings_are_averaged_and_kept_at_length_one() {
        let p = GenTrack2Parameters { template_momentum: 0.5, ..Default::default() };
        let detection = Detection::new(0.0, 0.0, 10.0, 10.0, 0.9);
        let mut target = Target::born(&detection, 0, 1);
        let mut hog = HogWorkspace::default();
        for data in [[2.0, 0.0], [0.0, 3.0]] {
            let detections = [detection];
            let frame = Frame { embeddings: Some(Embeddings::new(&data, 2)), ..Frame::new(&detections) };
            let mut observations = Observations::default();
            observations.prepare(&frame, 0.0);
            learn(&p, &mut target, &mut observations, 0, None, &mut hog);
        }
        let distance = target.embedding.distance(&[1.0, 0.0]).unwrap();
        // The mean of (1, 0) and (0, 1), normalised: both components sqrt(1/2).
        assert!((distance - (1.0 - 0.5f64.sqrt())).abs() < 1e-6, "{distance}");
        assert!(!target.has_looks());
    }
}
