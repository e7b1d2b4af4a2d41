//! Where an object's centre is: straight pieces between points in time.

#[derive(Clone, Debug)]
pub struct Path {
    /// Time, x, y; times grow.
    points: Vec<(f64, f64, f64)>,
}

impl Path {
    /// Starts at `(x, y)` at time `t`.
    pub fn from(t: f64, x: f64, y: f64) -> Self {
        Self { points: vec![(t, x, y)] }
    }

    /// Goes on with velocity `(vx, vy)` in px/s until time `t`.
    pub fn walk(mut self, vx: f64, vy: f64, t: f64) -> Self {
        let &(t0, x, y) = self.points.last().expect("a path has a start");
        assert!(t > t0, "a path goes forward in time");
        self.points.push((t, x + vx * (t - t0), y + vy * (t - t0)));
        self
    }

    /// The path with velocity `(vx, vy)` that is at `(x, y)` at time `t`, from time 0 to `end`.
    pub fn through(t: f64, x: f64, y: f64, vx: f64, vy: f64, end: f64) -> Self {
        Self::from(0.0, x - vx * t, y - vy * t).walk(vx, vy, end)
    }

    /// The position at time `t`; `None` before the start and after the end.
    pub fn at(&self, t: f64) -> Option<(f64, f64)> {
        self.points.windows(2).find(|w| t >= w[0].0 && t <= w[1].0).map(|w| {
            let share = (t - w[0].0) / (w[1].0 - w[0].0);
            (w[0].1 + share * (w[1].1 - w[0].1), w[0].2 + share * (w[1].2 - w[0].2))
        })
    }
}

impl Path {
    /// Reflects the path at the middle of an image of this width.
    pub fn mirror(&mut self, width: f64) {
        self.points.iter_mut().for_each(|p| p.1 = width - p.1);
    }
}
