//! How alike boxes are in the rounds after the first (specifications: OC-SORT section 2, `asso_func`).

use std::f64::consts::PI;

use super::parameters::Similarity;
use crate::geometry::{Rect, State};
use crate::trackers::sort_family::{FullAssociation, too_many};

/// Begins an association of detections with tracks by this measure.
pub fn begin(
    similarity: Similarity,
    association: &mut FullAssociation,
    detections: impl ExactSizeIterator<Item = Rect> + Clone,
    tracks: impl ExactSizeIterator<Item = Rect> + Clone,
    threshold: f64,
    allowed: impl Fn(u32, u32) -> bool,
) {
    let value: fn(&Rect, &Rect) -> f64 = match similarity {
        Similarity::Iou => return association.begin(detections, tracks, threshold, allowed),
        Similarity::Giou => giou,
        Similarity::Diou => diou,
        Similarity::Ciou => ciou,
        // Of absurdly many pairs there is no looking for the farthest.
        Similarity::CentreDistance if too_many(detections.len(), tracks.len()) => {
            return association.begin(detections, tracks, threshold, allowed);
        }
        Similarity::CentreDistance => {
            let pairs = detections.clone().flat_map(|d| tracks.clone().map(move |t| centre_distance(&d, &t)));
            let largest = pairs.fold(0.0, f64::max);
            let near = |a: &Rect, b: &Rect| if largest > 0.0 { 1.0 - centre_distance(a, b) / largest } else { 1.0 };
            return association.begin_with(detections, tracks, near, threshold, allowed);
        }
    };
    association.begin_with(detections, tracks, value, threshold, allowed);
}

fn centre_distance(a: &Rect, b: &Rect) -> f64 {
    squared_distance(a, b).sqrt()
}

fn squared_distance(a: &Rect, b: &Rect) -> f64 {
    let (a, b) = (State::from(*a), State::from(*b));
    (a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v)
}

/// Width and height of the smallest box around both.
fn hull(a: &Rect, b: &Rect) -> (f64, f64) {
    (a.right().max(b.right()) - a.left.min(b.left), a.bottom().max(b.bottom()) - a.top.min(b.top))
}

fn rescaled(x: f64) -> f64 {
    if x.is_finite() { (0.5 * (x + 1.0)).clamp(0.0, 1.0) } else { 0.0 }
}

/// Rezatofighi et al., "Generalized Intersection over Union", CVPR 2019.
fn giou(a: &Rect, b: &Rect) -> f64 {
    let (width, height) = hull(a, b);
    let union = a.area() + b.area() - a.intersection(b);
    rescaled(a.iou(b) - (width * height - union) / (width * height))
}

fn plain_diou(a: &Rect, b: &Rect) -> f64 {
    let (width, height) = hull(a, b);
    a.iou(b) - squared_distance(a, b) / (width * width + height * height)
}

/// Zheng et al., "Distance-IoU Loss", AAAI 2020.
fn diou(a: &Rect, b: &Rect) -> f64 {
    rescaled(plain_diou(a, b))
}

/// Zheng et al., "Distance-IoU Loss", AAAI 2020.
fn ciou(a: &Rect, b: &Rect) -> f64 {
    // The library's own arc tangent has the same bits on every platform.
    let angle = libm::atan2(a.width, a.height) - libm::atan2(b.width, b.height);
    let v = 4.0 / (PI * PI) * angle * angle;
    let doubt = 1.0 - a.iou(b) + v;
    let weight = if doubt > 0.0 { v / doubt } else { 0.0 };
    rescaled(plain_diou(a, b) - weight * v)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_by_hand() {
        let (a, b) = (Rect::new(0.0, 0.0, 10.0, 10.0), Rect::new(20.0, 0.0, 10.0, 10.0));
        // Apart by a box: IoU 0, hull 30 x 10 of which 200 are covered, centres 20 apart, hull diagonal^2 1000.
        assert!((giou(&a, &b) - 0.5 * (1.0 - 1.0 / 3.0)).abs() < 1e-12);
        assert!((diou(&a, &b) - 0.5 * (1.0 - 0.4)).abs() < 1e-12);
        // The same shape costs nothing more.
        assert_eq!(ciou(&a, &b), diou(&a, &b));
        for same in [giou, diou, ciou] {
            assert_eq!(same(&a, &a), 1.0);
        }
        // 10 x 10 and 10 x 30 with the same centre: IoU 1/3, angles 45 and 18.43 degrees.
        let tall = Rect::new(0.0, -10.0, 10.0, 30.0);
        let v = 4.0 / (PI * PI) * (0.25 * PI - (1.0f64 / 3.0).atan()).powi(2);
        let expected = 0.5 * (1.0 + 1.0 / 3.0 - v * v / (2.0 / 3.0 + v));
        assert!((ciou(&a, &tall) - expected).abs() < 1e-12);
    }

    #[test]
    fn the_farthest_pair_sets_the_scale_of_centre_distances() {
        let at = |x: f64| Rect::new(x, 0.0, 10.0, 10.0);
        let mut association = FullAssociation::default();
        let (detections, tracks) = ([at(0.0), at(60.0)], [at(40.0), at(100.0)]);
        // Distances 40, 100; 20, 40: similarities .6, 0; .8, .6. The best sum is .6 + .6, not .8 + 0.
        let (d, t) = (detections.iter().copied(), tracks.iter().copied());
        begin(Similarity::CentreDistance, &mut association, d, t, 0.5, |_, _| true);
        assert!(association.has_hits());
        association.best_overlap();
        assert_eq!(association.partners(), [0, 1]);
    }
}
