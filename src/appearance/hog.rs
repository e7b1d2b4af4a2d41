//! The search region of one target: gradients around its predicted box, ready to describe any candidate box inside.
//!
//! The region is resampled (nearest pixel: no whole frame is ever converted, and averaging separates people no better)
//! to a grid in which the reference box is [`REFERENCE_X`] x [`REFERENCE_Y`] samples. Central differences vote for
//! orientations at every sample, and the votes are summed up from the left-top corner, all bins of one corner side by
//! side. The votes inside any rectangle of samples are then four look-ups of one vector register each.

use super::descriptor::{CELLS_X, CELLS_Y, Descriptor, normalize};
use super::gray::sample_row;
use super::orientation::{BINS, votes};
use crate::geometry::Rect;
use crate::image::ImageView;

/// Least width of a box that can be described, in pixels.
pub const MIN_WIDTH: f64 = 8.0;
/// Least height of a box that can be described, in pixels.
pub const MIN_HEIGHT: f64 = 16.0;
/// Largest margin factor of a search region.
pub const MAX_MARGIN: f64 = 2.0;

/// Samples across and down the reference box: cells of 8 x 8 samples.
const REFERENCE_X: usize = 8 * CELLS_X;
const REFERENCE_Y: usize = 8 * CELLS_Y;
/// Samples across and down the largest region.
const MAX_X: usize = 2 * REFERENCE_X;
const MAX_Y: usize = 2 * REFERENCE_Y;
/// A row of brightness has one more sample on either side for the differences.
const GRAY_STRIDE: usize = MAX_X + 2;
/// How far a candidate may stick out of the image, as a share of its own side: half a cell. Detectors often overhang a
/// little. The missing part repeats the border pixel and so has no gradient across it.
const OVERHANG_X: f64 = 0.5 / CELLS_X as f64;
const OVERHANG_Y: f64 = 0.5 / CELLS_Y as f64;

/// Votes summed up over all samples left of and above one corner of the grid, modulo 65536: a rectangle of up to 256
/// samples has a smaller sum, so differences are exact although the sums wrap.
type Corner = [u16; BINS];

/// Reusable buffers that hold the search region of one target at a time. About 145 KiB, allocated by the first
/// [`prepare`](Self::prepare); nothing is allocated later.
#[derive(Clone, Debug, Default)]
pub struct HogWorkspace {
    gray: Vec<u8>,
    integral: Vec<Corner>,
    frame: Option<Placement>,
}

/// Where the grid lies in the image.
#[derive(Clone, Copy, Debug)]
struct Placement {
    horizontal: Axis,
    vertical: Axis,
}

/// One axis of the grid: `samples` samples of `pitch` pixels, the first one starting at `origin`.
#[derive(Clone, Copy, Debug)]
struct Axis {
    origin: f64,
    pitch: f64,
    samples: usize,
    image_side: f64,
}

impl Axis {
    /// The axis on which the reference `start..start + length` takes `reference` samples, or `None` when no candidate
    /// near the reference can lie inside the image. Written so that NaN is refused.
    fn new(start: f64, length: f64, reference: usize, margin: f64, image_side: u32) -> Option<Self> {
        let image_side = f64::from(image_side);
        let meets_image = start < image_side && start + length > 0.0 && length <= 1.5 * image_side;
        if !meets_image {
            return None;
        }
        let border = (0.5 * (margin - 1.0) * reference as f64).ceil() as usize;
        let pitch = length / reference as f64;
        Some(Self { origin: start - border as f64 * pitch, pitch, samples: reference + 2 * border, image_side })
    }

    /// The image's pixel nearest to sample `index`; -1 and `samples` are the samples next to the grid.
    fn pixel(&self, index: isize) -> usize {
        let position = self.origin + (index as f64 + 0.5) * self.pitch;
        // The cast rounds down: the position is not negative.
        position.clamp(0.0, self.image_side - 1.0) as usize
    }

    /// Grid lines nearest to the edges of `N - 1` equal cells of a candidate, or `None` when the candidate leaves the
    /// grid or the image. Written so that NaN is refused.
    fn cell_edges<const N: usize>(&self, start: f64, length: f64, overhang: f64) -> Option<[usize; N]> {
        let cells = (N - 1) as f64;
        let slack = overhang * length;
        let inside_image = start >= -slack && start + length <= self.image_side + slack;
        // Half a sample of tolerance: edges are rounded to grid lines. Two samples per cell at least.
        let first = (start - self.origin) / self.pitch + 0.5;
        let step = length / self.pitch / cells;
        let inside_grid = first >= 0.0 && first + step * cells < (self.samples + 1) as f64;
        if !(inside_image && inside_grid && step >= 2.0) {
            return None;
        }
        Some(std::array::from_fn(|k| (first + step * k as f64) as usize))
    }
}

impl HogWorkspace {
    /// A workspace without a region.
    pub fn new() -> Self {
        Self::default()
    }

    /// Reads the image around `reference` (pixels), so that candidates inside `margin` times the reference's width and
    /// height, around the same centre, can be described. `margin` is in `1..=`[`MAX_MARGIN`] (a number outside counts
    /// as the nearest one inside); 1 describes the reference alone.
    ///
    /// Returns false, and describes nothing, when the reference is smaller than [`MIN_WIDTH`] x [`MIN_HEIGHT`], larger
    /// than 1.5 times the image, outside the image, or not finite.
    pub fn prepare(&mut self, image: &ImageView, reference: &Rect, margin: f64) -> bool {
        self.frame = Placement::new(image, reference, margin);
        let Some(frame) = self.frame else { return false };
        self.gray.resize(GRAY_STRIDE * (MAX_Y + 2), 0);
        self.integral.resize((MAX_X + 1) * (MAX_Y + 1), [0; BINS]);
        self.sample(image, &frame);
        self.accumulate(frame.horizontal.samples, frame.vertical.samples);
        true
    }

    /// Writes the descriptor of `candidate` (pixels) and returns true; or returns false and leaves `out` alone when the
    /// candidate is smaller than [`MIN_WIDTH`] x [`MIN_HEIGHT`] or than a quarter of the reference's sides, leaves the
    /// region, sticks out of the image by more than half a cell (1/8 of its width, 1/16 of its height), is not finite,
    /// or when there is no region. The edges of the cells are rounded to the region's samples: 1/32 of the
    /// reference's width, 1/64 of its height.
    pub fn describe(&self, candidate: &Rect, out: &mut Descriptor) -> bool {
        let Some((columns, rows, stride)) = self.cells(candidate) else { return false };
        let mut above = self.strips(&columns, rows[0] * stride);
        for (y, cells) in out.chunks_exact_mut(CELLS_X * BINS).enumerate() {
            let below = self.strips(&columns, rows[y + 1] * stride);
            for (x, bins) in cells.chunks_exact_mut(BINS).enumerate() {
                let area = (columns[x + 1] - columns[x]) * (rows[y + 1] - rows[y]);
                let mean = 1.0 / area as f32;
                for b in 0..BINS {
                    bins[b] = f32::from(below[x][b].wrapping_sub(above[x][b])) * mean;
                }
            }
            above = below;
        }
        normalize(out);
        true
    }

    /// Grid lines of the candidate's cells, and the corners in a row of the grid.
    fn cells(&self, candidate: &Rect) -> Option<([usize; CELLS_X + 1], [usize; CELLS_Y + 1], usize)> {
        let frame = self.frame.as_ref().filter(|_| is_large_enough(candidate))?;
        let columns = frame.horizontal.cell_edges(candidate.left, candidate.width, OVERHANG_X)?;
        let rows = frame.vertical.cell_edges(candidate.top, candidate.height, OVERHANG_Y)?;
        Some((columns, rows, frame.horizontal.samples + 1))
    }

    /// Votes between neighbouring columns, from the top of the grid down to the corners that start at `row`.
    #[inline(always)]
    fn strips(&self, columns: &[usize; CELLS_X + 1], row: usize) -> [Corner; CELLS_X] {
        let corners = columns.map(|x| self.integral[row + x]);
        std::array::from_fn(|x| std::array::from_fn(|b| corners[x + 1][b].wrapping_sub(corners[x][b])))
    }

    fn sample(&mut self, image: &ImageView, frame: &Placement) {
        let (width, height) = (frame.horizontal.samples + 2, frame.vertical.samples + 2);
        let bytes = image.format().bytes_per_pixel();
        let mut offsets = [0; GRAY_STRIDE];
        for (i, offset) in offsets[..width].iter_mut().enumerate() {
            *offset = frame.horizontal.pixel(i as isize - 1) * bytes;
        }
        let mut previous = None;
        for i in 0..height {
            let y = frame.vertical.pixel(i as isize - 1);
            let start = i * GRAY_STRIDE;
            if previous == Some(y) {
                // A small box is magnified: the same row of pixels again.
                self.gray.copy_within(start - GRAY_STRIDE..start - GRAY_STRIDE + width, start);
            } else {
                let row = &mut self.gray[start..start + width];
                sample_row(image.row(y as u32), image.format(), &offsets[..width], row);
            }
            previous = Some(y);
        }
    }

    /// Fills the integral of the votes: `(nx + 1) * (ny + 1)` corners, row by row.
    fn accumulate(&mut self, nx: usize, ny: usize) {
        let stride = nx + 1;
        self.integral[..stride].fill([0; BINS]);
        for y in 0..ny {
            let (done, rest) = self.integral.split_at_mut((y + 1) * stride);
            let above = &done[y * stride..];
            let current = &mut rest[..stride];
            let up = &self.gray[y * GRAY_STRIDE + 1..][..nx];
            let middle = &self.gray[(y + 1) * GRAY_STRIDE..][..nx + 2];
            let down = &self.gray[(y + 2) * GRAY_STRIDE + 1..][..nx];
            accumulate_row(above, current, up, middle, down);
        }
    }
}

/// One row of the integral: the corners above plus the running sum of this row's votes.
fn accumulate_row(above: &[Corner], current: &mut [Corner], up: &[u8], middle: &[u8], down: &[u8]) {
    let Some((first, current)) = current.split_first_mut() else { return };
    *first = [0; BINS];
    let mut sum = [0u16; BINS];
    let gradients = middle.iter().zip(&middle[2..]).zip(up.iter().zip(down));
    for ((corner, above), ((&left, &right), (&up, &down))) in current.iter_mut().zip(&above[1..]).zip(gradients) {
        let vote = votes(i16::from(right) - i16::from(left), i16::from(down) - i16::from(up));
        for b in 0..BINS {
            sum[b] = sum[b].wrapping_add(vote[b]);
            corner[b] = above[b].wrapping_add(sum[b]);
        }
    }
}

impl Placement {
    fn new(image: &ImageView, reference: &Rect, margin: f64) -> Option<Self> {
        if !is_large_enough(reference) {
            return None;
        }
        // `max` turns NaN into 1.
        let margin = margin.max(1.0).min(MAX_MARGIN);
        Some(Self {
            horizontal: Axis::new(reference.left, reference.width, REFERENCE_X, margin, image.width())?,
            vertical: Axis::new(reference.top, reference.height, REFERENCE_Y, margin, image.height())?,
        })
    }
}

fn is_large_enough(rect: &Rect) -> bool {
    rect.width >= MIN_WIDTH && rect.height >= MIN_HEIGHT
}
