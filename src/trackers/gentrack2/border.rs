//! The image's border: who is beyond it, and boxes that it cuts off. The detector has guessed the part beyond it, so that
//! they start a track, and are reported, only where scores vouch for them.

use crate::frame::Detection;
use crate::geometry::Rect;

use super::parameters::GenTrack2Parameters;
use super::target::Target;

/// Whether the centre lies outside the frame.
pub fn is_outside(target: &Target, frame_size: Option<(u32, u32)>) -> bool {
    frame_size.is_some_and(|size| !image(size).contains(target.state.u, target.state.v))
}

/// Whether a detection is sure enough, for where it is, to start a track.
pub fn may_start(p: &GenTrack2Parameters, detection: &Detection, frame_size: Option<(u32, u32)>) -> bool {
    detection.score >= (p.birth_score * p.border_birth_factor).min(1.0)
        || share_within(&detection.rect, frame_size) >= p.border_birth_share
}

/// Whether a target is sure enough, for where it is, to be reported.
pub fn may_be_reported(p: &GenTrack2Parameters, target: &Target, frame_size: Option<(u32, u32)>) -> bool {
    target.mean_score >= p.birth_score || share_within(&target.state.into(), frame_size) >= p.border_report_share
}

/// Share of a box that is within the image, or of the image that is within the box if that is the larger of the two; 1
/// if the image's size is not known.
fn share_within(rect: &Rect, frame_size: Option<(u32, u32)>) -> f64 {
    let Some(image) = frame_size.map(image) else { return 1.0 };
    // Rounding must not make less than all of a box that is wholly within.
    if rect.left >= 0.0 && rect.top >= 0.0 && rect.right() <= image.width && rect.bottom() <= image.height {
        return 1.0;
    }
    rect.intersection(&image) / rect.area().min(image.area())
}

fn image((width, height): (u32, u32)) -> Rect {
    Rect::new(0.0, 0.0, width as f64, height as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: Option<(u32, u32)> = Some((100, 80));

    fn parameters() -> GenTrack2Parameters {
        GenTrack2Parameters {
            border_birth_share: 0.5,
            birth_score: 0.75,
            border_birth_factor: 1.125,
            border_report_share: 0.25,
            ..Default::default()
        }
    }

    fn may_start_at(left: f64, top: f64, score: f64, frame_size: Option<(u32, u32)>) -> bool {
        may_start(&parameters(), &Detection::new(left, top, 20.0, 40.0, score), frame_size)
    }

    fn may_be_reported_at(left: f64, top: f64, mean_score: f64, frame_size: Option<(u32, u32)>) -> bool {
        let mut target = Target::born(&Detection::new(left, top, 20.0, 40.0, 0.9), 0, 1);
        target.mean_score = mean_score;
        may_be_reported(&parameters(), &target, frame_size)
    }

    #[test]
    fn the_more_is_beyond_the_border_the_better_the_score_must_be() {
        // 20 of 40 rows are within, a half; then 19. .75 * 1.125 = .84375.
        assert!(may_start_at(40.0, -20.0, 0.84, SIZE));
        assert!(!may_start_at(40.0, -21.0, 0.84, SIZE));
        assert!(may_start_at(40.0, -21.0, 0.844, SIZE));
        // A quarter; then 9 of 40 rows.
        assert!(may_be_reported_at(40.0, -30.0, 0.74, SIZE));
        assert!(!may_be_reported_at(40.0, -31.0, 0.74, SIZE));
        assert!(may_be_reported_at(40.0, -31.0, 0.75, SIZE));
    }

    #[test]
    fn every_border_is_one() {
        // 4 of 20 columns at the right and at the left, 8 rows at the bottom, a corner, nothing at all.
        for (left, top) in [(96.0, 20.0), (-16.0, 20.0), (40.0, 72.0), (90.0, -25.0), (300.0, 20.0)] {
            assert!(!may_start_at(left, top, 0.5, SIZE), "{left} {top}");
            assert!(!may_be_reported_at(left, top, 0.5, SIZE), "{left} {top}");
        }
    }

    #[test]
    fn who_fills_the_image_is_not_beyond_its_border() {
        let close = |left| Rect::new(left, -300.0, 400.0, 800.0);
        assert_eq!(share_within(&close(-150.0), SIZE), 1.0);
        assert_eq!(share_within(&close(75.0), SIZE), 0.25);
    }

    #[test]
    fn a_centre_on_the_far_edges_is_outside() {
        let outside = |u: f64, v: f64, size| {
            is_outside(&Target::born(&Detection::new(u - 10.0, v - 20.0, 20.0, 40.0, 0.9), 0, 1), size)
        };
        assert!(!outside(0.0, 0.0, SIZE) && !outside(99.5, 79.5, SIZE));
        for (u, v) in [(100.0, 40.0), (50.0, 80.0), (-0.5, 40.0), (50.0, -0.5)] {
            assert!(outside(u, v, SIZE) && !outside(u, v, None), "{u} {v}");
        }
    }

    #[test]
    fn all_of_a_box_within_is_all_of_it() {
        for k in 0..1000 {
            let x = f64::from(k) * 0.0317;
            assert_eq!(share_within(&Rect::new(x, 0.7 * x, 20.1 + 1.3 * x, 10.3 + x), SIZE), 1.0, "{x}");
        }
    }

    #[test]
    fn a_factor_beyond_every_score_asks_for_the_best() {
        let p = GenTrack2Parameters { border_birth_factor: 10.0, ..parameters() };
        let score = |score| may_start(&p, &Detection::new(-15.0, 20.0, 20.0, 40.0, score), SIZE);
        assert!(!score(0.99) && score(1.0));
    }

    #[test]
    fn without_a_size_of_the_image_there_is_no_border() {
        assert!(may_start_at(40.0, -31.0, 0.1, None));
        assert!(may_be_reported_at(40.0, -31.0, 0.1, None));
    }
}
