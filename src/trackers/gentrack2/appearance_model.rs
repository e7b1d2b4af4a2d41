//! What a target remembers of its looks: learnt when a detection is taken, never while it is hidden.

use crate::appearance::{Descriptor, HogWorkspace, normalize};
use crate::image::ImageView;

use super::observations::Observations;
use super::parameters::GenTrack2Parameters;
use super::target::Target;

/// Learns from observation `index`: running means of HOG vector and embedding, kept at length 1.
pub fn learn(
    p: &GenTrack2Parameters,
    target: &mut Target,
    observations: &mut Observations,
    index: usize,
    image: Option<&ImageView<'_>>,
    hog: &mut HogWorkspace,
) {
    if let Some(seen) = observations.descriptor(index, image, hog) {
        match target.has_template {
            true => blend(&mut target.template, seen, p.template_momentum),
            false => *target.template = *seen,
        }
        target.has_template = true;
    }
    if let Some(seen) = observations.embedding(index) {
        target.embedding.learn(seen, p.template_momentum);
    }
}

fn blend(memory: &mut Descriptor, seen: &Descriptor, momentum: f64) {
    for (old, new) in memory.iter_mut().zip(seen) {
        *old = (momentum * *old as f64 + (1.0 - momentum) * *new as f64) as f32;
    }
    normalize(memory);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{Detection, Embeddings, Frame};

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
        assert!(!target.has_template);
    }
}
