//! Which detections lie within the gate of which tracks, by the squared Mahalanobis distance.

use crate::candidates::OverlapSweep;
use crate::geometry::{Rect, State};
use crate::kalman::{AspectHeight, BoxFilter};

/// Half the side of the box that stands for a point in the sweep, in pixels.
const POINT: f64 = 0.5;

/// The search, with buffers that are reused from call to call.
#[derive(Default)]
pub struct GatedPairs {
    sweep: OverlapSweep,
    reach: Vec<Rect>,
    rows: Vec<u32>,
    rects: Vec<Rect>,
    points: Vec<Rect>,
    first: Vec<u32>,
    list: Vec<(u32, f64)>,
}

impl GatedPairs {
    /// Finds for each filter the rows whose boxes are within the gate.
    pub fn find<'a>(
        &mut self,
        filters: impl Iterator<Item = &'a AspectHeight> + Clone,
        detections: impl Iterator<Item = (u32, Rect)>,
        gate: f64,
    ) {
        let around = |u: f64, v: f64, du: f64, dv: f64| Rect::new(u - du, v - dv, 2.0 * du, 2.0 * dv);
        self.reach.clear();
        self.reach.extend(filters.clone().map(|filter| {
            let (s, (du, dv)) = (filter.state(), filter.reach(gate));
            around(s.u, s.v, du + POINT, dv + POINT)
        }));
        self.rows.clear();
        self.rects.clear();
        for (row, rect) in detections {
            self.rows.push(row);
            self.rects.push(rect);
        }
        self.points.clear();
        self.points.extend(self.rects.iter().map(|r| State::from(*r)).map(|s| around(s.u, s.v, POINT, POINT)));
        let pairs = self.sweep.pairs(&self.reach, &self.points);
        self.first.clear();
        self.list.clear();
        let mut at = 0;
        for (index, filter) in (0..).zip(filters) {
            self.first.push(self.list.len() as u32);
            while let Some(&(_, column)) = pairs.get(at).filter(|p| p.0 == index) {
                let far = filter.gating_distance(&self.rects[column as usize]);
                if far <= gate {
                    self.list.push((self.rows[column as usize], far));
                }
                at += 1;
            }
        }
        self.first.push(self.list.len() as u32);
    }

    /// Row and distance of those within the gate of a filter, by row.
    pub fn of(&self, filter: usize) -> &[(u32, f64)] {
        &self.list[self.first[filter] as usize..self.first[filter + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gate_is_an_ellipse_in_position_and_shape() {
        // Height 100: standard deviation of the centre at birth 10 and of a measurement 5, together sqrt(125).
        let filters = [AspectHeight::new(&Rect::new(0.0, 0.0, 50.0, 100.0))];
        let gate = 9.4877;
        let edge = (gate * 125.0f64).sqrt();
        let inside = |dx: f64, dy: f64, width: f64| {
            let mut pairs = GatedPairs::default();
            pairs.find(filters.iter(), [(7, Rect::new(dx - 0.5 * (width - 50.0), dy, width, 100.0))].into_iter(), gate);
            pairs.of(0) == [(7, filters[0].gating_distance(&Rect::new(dx - 0.5 * (width - 50.0), dy, width, 100.0)))]
        };
        assert!(inside(edge - 0.01, 0.0, 50.0) && !inside(edge + 0.01, 0.0, 50.0));
        assert!(inside(0.0, edge - 0.01, 50.0) && !inside(0.0, edge + 0.01, 50.0));
        assert!(!inside(0.8 * edge, 0.8 * edge, 50.0));
        // Aspect .5 with deviations .01 and .1: .31 is as far as it goes.
        assert!(inside(0.0, 0.0, 80.0) && !inside(0.0, 0.0, 82.0));
    }

    #[test]
    fn a_distance_of_exactly_the_gate_is_within() {
        // Height 100: variances 100 at birth and 25 of a measurement; 25 px aside 625/125 = 5, without rounding.
        let filters = [AspectHeight::new(&Rect::new(0.0, 0.0, 50.0, 100.0))];
        let mut pairs = GatedPairs::default();
        let mut found = |gate: f64| {
            pairs.find(filters.iter(), [(7, Rect::new(25.0, 0.0, 50.0, 100.0))].into_iter(), gate);
            pairs.of(0).to_vec()
        };
        assert_eq!(found(5.0), [(7, 5.0)]);
        assert_eq!(found(5.0f64.next_down()), []);
    }
}
