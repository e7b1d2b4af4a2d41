//! How far the rows of a tracker are those of an oracle: per frame as sets, boxes within a tolerance, identities up to
//! a one-to-one renaming that holds for the whole sequence.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use gentrack2::Rect;

use super::golden::{Row, Rows};

/// Pixels by which left, top, width and height may each be off. The oracles have four decimals.
pub const TOLERANCE: f64 = 1e-3;
/// Differences that are kept to be shown; those that follow are mostly their consequences.
const SHOWN: usize = 12;
/// IoU from which two rows that agree in nothing are shown side by side.
const SIDE_BY_SIDE: f64 = 0.5;

/// Rows that differ; `None` on the side that has none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// From 1.
    pub frame: usize,
    pub golden: Option<Row>,
    pub ours: Option<Row>,
    /// What the golden identity is called on our side, if it has been seen before.
    pub renamed: Option<u64>,
}

/// The outcome of a comparison.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Rows of the oracle: the right, wrong and missing ones.
    pub golden: usize,
    /// Rows with the same box and identity on our side.
    pub right: usize,
    /// Rows with a counterpart of another box or identity.
    pub wrong: usize,
    /// Rows of the oracle without counterpart.
    pub missing: usize,
    /// Our rows without counterpart.
    pub surplus: usize,
    /// The first ones.
    pub differences: Vec<Difference>,
}

impl Report {
    /// Compares two sequences of frames.
    pub fn new(golden: &Rows, ours: &Rows) -> Self {
        let mut comparison =
            Comparison { agreements: agreements(golden, ours), renaming: Renaming::default(), report: Self::default() };
        let none = Vec::new();
        for frame in 0..golden.len().max(ours.len()) {
            comparison.frame(frame + 1, golden.get(frame).unwrap_or(&none), ours.get(frame).unwrap_or(&none));
        }
        comparison.report
    }

    /// Whether every row is right and there is none too many. An empty oracle proves nothing.
    pub fn is_exact(&self) -> bool {
        self.golden > 0 && self.right == self.golden && self.surplus == 0
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Rounded down: 100 % is said of nothing less.
        let share = (self.right as f64 / self.golden.max(1) as f64 * 1e4).floor() / 100.0;
        write!(f, "{share:.2} %: {} of {} rows right", self.right, self.golden)?;
        write!(f, ", {} wrong, {} missing, {} surplus", self.wrong, self.missing, self.surplus)
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let row = |row: Option<Row>| match row {
            Some(Row { id, rect: r }) => format!("{id} ({:.4} {:.4} {:.4} {:.4})", r.left, r.top, r.width, r.height),
            None => "nothing".to_string(),
        };
        write!(f, "frame {}: golden {}, ours {}", self.frame, row(self.golden), row(self.ours))?;
        match (self.golden, self.renamed) {
            (Some(golden), Some(ours)) => write!(f, "; {} has been {ours}", golden.id),
            _ => Ok(()),
        }
    }
}

/// A one-to-one relation between identities, fixed at the first meeting.
#[derive(Default)]
struct Renaming {
    ours_of_golden: BTreeMap<u64, u64>,
    taken: BTreeSet<u64>,
}

impl Renaming {
    /// Whether the two may be one identity.
    fn admits(&self, golden: u64, ours: u64) -> bool {
        match self.ours_of_golden.get(&golden) {
            Some(known) => *known == ours,
            None => !self.taken.contains(&ours),
        }
    }

    fn fix(&mut self, golden: u64, ours: u64) {
        self.ours_of_golden.insert(golden, ours);
        self.taken.insert(ours);
    }
}

struct Comparison {
    agreements: BTreeMap<(u64, u64), usize>,
    renaming: Renaming,
    report: Report,
}

impl Comparison {
    fn frame(&mut self, frame: usize, golden: &[Row], ours: &[Row]) {
        self.report.golden += golden.len();
        let mut pairs = Pairs::new(golden.len(), ours.len());

        // Known identities first, whatever the box, so that a newcomer with the same box cannot take their place.
        for (g, row) in golden.iter().enumerate() {
            let Some(id) = self.renaming.ours_of_golden.get(&row.id) else { continue };
            let bearers = (0..ours.len()).filter(|o| ours[*o].id == *id && pairs.are_free(g, *o));
            // One at most, unless the tracker is broken.
            if let Some(o) = bearers.min_by_key(|o| !are_near(&row.rect, &ours[*o].rect)) {
                pairs.join(g, o);
            }
        }
        // Newcomers with the same box; of several, the pair that agrees in the most frames.
        let mut near = pairs.free(|g, o| are_near(&golden[g].rect, &ours[o].rect));
        near.sort_by_key(|&(g, o)| {
            let (golden, ours) = (golden[g].id, ours[o].id);
            let votes = self.agreements.get(&(golden, ours)).copied();
            (!self.renaming.admits(golden, ours), Reverse(votes))
        });
        for (g, o) in near {
            if pairs.are_free(g, o) {
                pairs.join(g, o);
                let (golden, ours) = (golden[g].id, ours[o].id);
                if !self.renaming.ours_of_golden.contains_key(&golden) && self.renaming.admits(golden, ours) {
                    self.renaming.fix(golden, ours);
                }
            }
        }
        // The rest is wrong already; those that are about the same object are shown together.
        for (g, o) in pairs.free(|g, o| golden[g].rect.iou(&ours[o].rect) >= SIDE_BY_SIDE) {
            if pairs.are_free(g, o) {
                pairs.join(g, o);
            }
        }
        self.count(frame, golden, ours, &pairs);
    }

    fn count(&mut self, frame: usize, golden: &[Row], ours: &[Row], pairs: &Pairs) {
        for (g, row) in golden.iter().enumerate() {
            let renamed = self.renaming.ours_of_golden.get(&row.id).copied();
            let partner = pairs.of_golden[g].map(|o| ours[o]);
            match partner {
                Some(other) if renamed == Some(other.id) && are_near(&row.rect, &other.rect) => {
                    self.report.right += 1;
                    continue;
                }
                Some(_) => self.report.wrong += 1,
                None => self.report.missing += 1,
            }
            self.show(Difference { frame, golden: Some(*row), ours: partner, renamed });
        }
        for (o, row) in ours.iter().enumerate() {
            if !pairs.ours_taken[o] {
                self.report.surplus += 1;
                self.show(Difference { frame, golden: None, ours: Some(*row), renamed: None });
            }
        }
    }

    fn show(&mut self, difference: Difference) {
        if self.report.differences.len() < SHOWN {
            self.report.differences.push(difference);
        }
    }
}

/// Which rows of a frame belong together.
struct Pairs {
    of_golden: Vec<Option<usize>>,
    ours_taken: Vec<bool>,
}

impl Pairs {
    fn new(golden: usize, ours: usize) -> Self {
        Self { of_golden: vec![None; golden], ours_taken: vec![false; ours] }
    }

    fn are_free(&self, g: usize, o: usize) -> bool {
        self.of_golden[g].is_none() && !self.ours_taken[o]
    }

    fn join(&mut self, g: usize, o: usize) {
        self.of_golden[g] = Some(o);
        self.ours_taken[o] = true;
    }

    /// The pairs of free rows of which something is true.
    fn free(&self, is_wanted: impl Fn(usize, usize) -> bool) -> Vec<(usize, usize)> {
        let all = (0..self.of_golden.len()).flat_map(|g| (0..self.ours_taken.len()).map(move |o| (g, o)));
        all.filter(|&(g, o)| self.are_free(g, o) && is_wanted(g, o)).collect()
    }
}

fn are_near(a: &Rect, b: &Rect) -> bool {
    let sides = [(a.left, b.left), (a.top, b.top), (a.width, b.width), (a.height, b.height)];
    sides.iter().all(|(a, b)| (a - b).abs() <= TOLERANCE)
}

/// For two identities the number of frames in which they have the same box.
fn agreements(golden: &Rows, ours: &Rows) -> BTreeMap<(u64, u64), usize> {
    let mut counts = BTreeMap::new();
    for (golden, ours) in golden.iter().zip(ours) {
        for row in golden {
            for other in ours.iter().filter(|other| are_near(&row.rect, &other.rect)) {
                *counts.entry((row.id, other.id)).or_default() += 1;
            }
        }
    }
    counts
}
