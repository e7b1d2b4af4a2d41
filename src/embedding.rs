//! Re-identification embeddings: those of a frame as unit vectors, and what a track remembers of them.

use crate::faults::{self, Stage};
use crate::frame::Embeddings;

/// The embeddings of a frame, scaled to length 1.
#[derive(Clone, Debug, Default)]
pub struct UnitRows {
    data: Vec<f64>,
    dimension: usize,
}

impl UnitRows {
    /// Takes the embeddings of `rows` detections; without embeddings there are none.
    pub fn fill(&mut self, embeddings: Option<&Embeddings<'_>>, rows: usize) {
        self.data.clear();
        self.dimension = embeddings.map_or(0, |e| e.dimension);
        let Some(embeddings) = embeddings else { return };
        faults::point(Stage::Embeddings);
        for row in 0..rows {
            let start = self.data.len();
            self.data.extend(embeddings.row(row).iter().map(|x| *x as f64));
            to_unit(&mut self.data[start..]);
        }
    }

    /// The unit embedding of a detection; `None` without embeddings, or for a vector too short to have a direction.
    pub fn row(&self, row: usize) -> Option<&[f64]> {
        let start = row * self.dimension;
        let embedding = self.data.get(start..start + self.dimension)?;
        embedding.iter().any(|x| *x != 0.0).then_some(embedding)
    }
}

/// A running mean of unit embeddings, kept at length 1.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct MeanEmbedding(Vec<f64>);

impl MeanEmbedding {
    /// Forgets everything but the memory it occupies.
    pub fn clear(&mut self) {
        self.0.clear();
    }

    /// Learns a unit embedding; `momentum` is the share of what was known.
    pub fn learn(&mut self, seen: &[f64], momentum: f64) {
        if self.0.len() != seen.len() {
            self.0.clear();
            self.0.extend_from_slice(seen);
            return;
        }
        for (old, new) in self.0.iter_mut().zip(seen) {
            *old = momentum * *old + (1.0 - momentum) * *new;
        }
        to_unit(&mut self.0);
    }

    /// `1 - cosine`, in `[0, 2]`, to a unit embedding; `None` before anything was learnt.
    pub fn distance(&self, seen: &[f64]) -> Option<f64> {
        (self.0.len() == seen.len()).then(|| (1.0 - dot(&self.0, seen)).clamp(0.0, 2.0))
    }
}

/// The latest unit embeddings of a track, in 32 bits: a ring of whole rows, so that no sum depends on where it starts.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "snapshot", derive(serde::Serialize, serde::Deserialize))]
pub struct Gallery {
    rows: Vec<f32>,
    /// Where the oldest row begins once the ring is full.
    oldest: usize,
}

impl Gallery {
    /// Forgets everything but the memory it occupies.
    pub fn clear(&mut self) {
        self.rows.clear();
        self.oldest = 0;
    }

    /// Adds a unit embedding; it takes the place of the oldest if there are `budget` of them.
    pub fn add(&mut self, seen: &[f64], budget: usize) {
        if self.rows.len() < seen.len() * budget {
            self.rows.extend(seen.iter().map(|x| *x as f32));
            return;
        }
        let Some(row) = self.rows.get_mut(self.oldest..self.oldest + seen.len()) else { return };
        row.iter_mut().zip(seen).for_each(|(old, new)| *old = *new as f32);
        self.oldest = (self.oldest + seen.len()) % self.rows.len();
    }

    /// The smallest `1 - cosine`, in `[0, 2]`, to a unit embedding; `None` of an empty gallery.
    pub fn distance(&self, seen: &[f64]) -> Option<f64> {
        if self.rows.is_empty() || !self.rows.len().is_multiple_of(seen.len()) {
            return None;
        }
        let rows = self.rows.chunks_exact(seen.len());
        let best = rows.map(|row| dot_32(row, seen)).fold(f64::NEG_INFINITY, f64::max);
        Some((1.0 - best).clamp(0.0, 2.0))
    }
}

/// Memory of galleries whose tracks ended, the largest first. Short lives get the smallest, and who outgrows theirs gets a
/// larger one: else nearly every gallery had to grow to its full size before a tracker stopped allocating.
#[derive(Default)]
pub struct SpareGalleries(Vec<Gallery>);

impl SpareGalleries {
    /// Keeps the memory of a gallery.
    pub fn put(&mut self, mut gallery: Gallery) {
        gallery.clear();
        let size = gallery.rows.capacity();
        if size > 0 {
            self.0.insert(self.0.partition_point(|g| g.rows.capacity() >= size), gallery);
        }
    }

    /// An empty gallery.
    pub fn take(&mut self) -> Gallery {
        self.0.pop().unwrap_or_default()
    }

    /// Moves a gallery that is about to grow by one of its `budget` embeddings, of this length, into larger memory, if
    /// there is some.
    pub fn make_room(&mut self, gallery: &mut Gallery, dimension: usize, budget: usize) {
        let needed = gallery.rows.len() + dimension;
        if gallery.rows.capacity() >= needed || needed > dimension * budget {
            return;
        }
        let Some(smallest) = self.0.partition_point(|g| g.rows.capacity() >= needed).checked_sub(1) else { return };
        let mut larger = self.0.remove(smallest);
        larger.rows.extend_from_slice(&gallery.rows);
        larger.oldest = gallery.oldest;
        self.put(std::mem::replace(gallery, larger));
    }
}

/// Scales a vector to length 1; one too short to have a direction becomes zeros.
fn to_unit(vector: &mut [f64]) {
    let norm = dot(vector, vector).sqrt();
    let scale = if norm > 1e-20 { 1.0 / norm } else { 0.0 };
    vector.iter_mut().for_each(|x| *x *= scale);
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    sum_of_products(a.len().min(b.len()), |i| a[i] * b[i])
}

fn dot_32(a: &[f32], b: &[f64]) -> f64 {
    sum_of_products(a.len().min(b.len()), |i| a[i] as f64 * b[i])
}

/// Four sums side by side, which a compiler can compute at once, in an order that does not depend on the machine.
#[inline(always)]
fn sum_of_products(length: usize, product: impl Fn(usize) -> f64) -> f64 {
    let mut sums = [0.0; 4];
    let whole = length - length % 4;
    for i in (0..whole).step_by(4) {
        for (lane, sum) in sums.iter_mut().enumerate() {
            *sum += product(i + lane);
        }
    }
    let rest: f64 = (whole..length).map(product).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_outgrows_a_gallery_gets_the_smallest_of_the_larger_ones() {
        let of_size = |numbers: usize| Gallery { rows: Vec::with_capacity(numbers), oldest: 0 };
        let mut spare = SpareGalleries::default();
        for numbers in [8, 64, 0, 16, 32] {
            spare.put(of_size(numbers));
        }
        let mut gallery = spare.take();
        let sizes = |spare: &SpareGalleries| spare.0.iter().map(|g| g.rows.capacity()).collect::<Vec<_>>();
        assert_eq!((gallery.rows.capacity(), sizes(&spare)), (8, vec![64, 32, 16]));
        for _ in 0..3 {
            spare.make_room(&mut gallery, 4, 5);
            gallery.add(&[0.5; 4], 5);
        }
        assert_eq!((gallery.rows.capacity(), sizes(&spare)), (16, vec![64, 32, 8]));
        assert_eq!(gallery.rows, [0.5; 12]);
        gallery.add(&[0.5; 4], 5);
        spare.make_room(&mut gallery, 4, 4);
        assert_eq!(gallery.rows.capacity(), 16, "a full ring grows no more");
    }

    #[test]
    fn rows_are_scaled_to_length_one_and_zeros_are_none() {
        let data = [0.0, 0.0, 3.0, 4.0];
        let mut rows = UnitRows::default();
        rows.fill(Some(&Embeddings::new(&data, 2)), 2);
        assert_eq!(rows.row(0), None);
        let unit = rows.row(1).unwrap();
        assert!((unit[0] - 0.6).abs() + (unit[1] - 0.8).abs() < 1e-15, "{unit:?}");
        rows.fill(None, 2);
        assert_eq!(rows.row(1), None);
    }

    #[test]
    fn the_mean_is_kept_at_length_one() {
        let mut mean = MeanEmbedding::default();
        assert_eq!(mean.distance(&[1.0, 0.0]), None);
        mean.learn(&[1.0, 0.0], 0.5);
        mean.learn(&[0.0, 1.0], 0.5);
        // The mean of (1, 0) and (0, 1), normalised: both components sqrt(1/2).
        let distance = mean.distance(&[1.0, 0.0]).unwrap();
        assert!((distance - (1.0 - 0.5f64.sqrt())).abs() < 1e-15, "{distance}");
    }

    #[test]
    fn a_gallery_keeps_the_newest_and_finds_the_nearest() {
        // Directions of 0, 10, 20, ... degrees in the first two of five components; a budget of 3.
        let at = |degrees: f64| {
            let (sin, cos) = libm::sincos(degrees.to_radians());
            [cos, sin, 0.0, 0.0, 0.0]
        };
        let mut gallery = Gallery::default();
        assert_eq!(gallery.distance(&at(0.0)), None);
        for newest in 0..40 {
            gallery.add(&at(10.0 * newest as f64), 3);
            let oldest = 10.0 * (newest - 2).max(0) as f64;
            // 30 degrees before the oldest one that is kept: 1 - cos(30).
            let distance = gallery.distance(&at(oldest - 30.0)).unwrap();
            assert!((distance - (1.0 - 0.75f64.sqrt())).abs() < 1e-6, "after {newest}: {distance}");
            assert!(gallery.distance(&at(oldest)).unwrap() < 1e-6);
        }
    }
}
