//! The search region of one target: gradients around its predicted box, ready to describe any candidate box inside.
//!
//! The region is resampled (nearest pixel: no whole frame is ever converted, and averaging separates people no better)
//! to a grid in which the reference box is [`REFERENCE_X`] x [`REFERENCE_Y`] samples. Central differences vote for
//! orientations at every sample, and the votes are summed up from the left-top corner, all bins of one corner side by
//! side. The votes inside any rectangle of samples are then four look-ups of one vector register each.

use super::descriptor::{CELLS_X, CELLS_Y, Descriptor, EMPTY, normalize};
use super::gray::sample_row;
use super::orientation::{BINS, Directions, MAX_VOTE};
use super::tones::{ASIDE, LEVELS, STRIPES, Stripe, Tones};
use crate::faults::{self, Stage};
use crate::geometry::Rect;
use crate::image::ImageView;

/// Least width of a box that can be described, in pixels.
pub const MIN_WIDTH: f64 = 8.0;
/// Least height of a box that can be described, in pixels.
pub const MIN_HEIGHT: f64 = 16.0;
/// Largest margin factor of a search region.
pub const MAX_MARGIN: f64 = 2.0;

/// Samples across and down the reference box: cells of 6 x 6 samples. Cells of 8 x 8 separate people no better and cost
/// nearly twice as much.
const REFERENCE_X: usize = 6 * CELLS_X;
const REFERENCE_Y: usize = 6 * CELLS_Y;
/// Shortest side of a cell in samples: a box of a quarter of the reference's side.
const MIN_CELL: f64 = 1.5;
/// Longest side of a cell in samples: 12 in a region of twice the reference, and 1 for rounding.
const MAX_CELL: usize = 13;
const _: () = assert!(MAX_CELL * MAX_CELL * (MAX_VOTE as usize) < 1 << 16, "the votes of a cell fit 16 bits");
/// Samples across and down the largest region.
const MAX_X: usize = 2 * REFERENCE_X;
const MAX_Y: usize = 2 * REFERENCE_Y;
/// A row of brightness has one more sample on either side for the differences.
const GRAY_STRIDE: usize = MAX_X + 2;
/// How far a candidate may stick out of the image, as a share of its own side: half a cell. Detectors often overhang a
/// little. The missing part repeats the border pixel and so has no gradient across it.
const OVERHANG_X: f64 = 0.5 / CELLS_X as f64;
const OVERHANG_Y: f64 = 0.5 / CELLS_Y as f64;

/// Positions of cell edges are stepped in fixed point.
const FIXED_BITS: u32 = 32;
const FIXED_ONE: f64 = (1u64 << FIXED_BITS) as f64;

/// `1 / n` for the sides of a cell in samples.
const INVERSE: [f32; MAX_CELL + 1] = {
    let mut inverse = [0.0; MAX_CELL + 1];
    let mut n = 1;
    while n < inverse.len() {
        inverse[n] = 1.0 / n as f32;
        n += 1;
    }
    inverse
};

/// Votes summed up over all samples left of and above one corner of the grid, modulo 65536: the votes of
/// one cell sum to less, so differences are exact although the sums wrap.
type Corner = [u16; BINS];

/// Reusable buffers that hold the search region of one target at a time. About 80 KiB, allocated by the first
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
    fn pixel(&self, index: isize) -> u32 {
        let position = self.origin + (index as f64 + 0.5) * self.pitch;
        // The cast rounds down: the position is not negative.
        position.clamp(0.0, self.image_side - 1.0) as u32
    }

    /// Grid lines nearest to the edges of `N - 1` equal cells of a candidate, or `None` when the candidate leaves the
    /// grid or the image. Written so that NaN is refused.
    fn cell_edges<const N: usize>(&self, start: f64, length: f64, overhang: f64) -> Option<[usize; N]> {
        let cells = (N - 1) as f64;
        let slack = overhang * length;
        let inside_image = start >= -slack && start + length <= self.image_side + slack;
        // Half a sample of tolerance: edges are rounded to grid lines.
        let first = (start - self.origin) / self.pitch + 0.5;
        let step = length / self.pitch / cells;
        let inside_grid = first >= 0.0 && first + step * cells < (self.samples + 1) as f64;
        if !(inside_image && inside_grid && step >= MIN_CELL) {
            return None;
        }
        let (first, step) = ((first * FIXED_ONE) as u64, (step * FIXED_ONE) as u64);
        Some(std::array::from_fn(|k| ((first + step * k as u64) >> FIXED_BITS) as usize))
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
        faults::point(Stage::Appearance);
        self.frame = Placement::new(image, reference, margin);
        let Some(frame) = self.frame else { return false };
        self.gray.resize(GRAY_STRIDE * (MAX_Y + 2), 0);
        self.integral.resize((MAX_X + 1) * (MAX_Y + 1), [0; BINS]);
        self.sample(image, &frame);
        self.accumulate(frame.horizontal.samples, frame.vertical.samples);
        true
    }

    /// Writes the descriptor of `candidate` (pixels) and returns true; or returns false where there is nothing to
    /// compare: without any texture, with `out` then [`EMPTY`]; or, with `out` left alone, when the candidate is
    /// smaller than [`MIN_WIDTH`] x [`MIN_HEIGHT`] or than a quarter of the reference's sides, leaves the region, sticks
    /// out of the image by more than half a cell (1/8 of its width, 1/16 of its height), is not finite, or when there
    /// is no region. The edges of the cells are rounded to the region's samples: 1/24 of the reference's width, 1/48 of
    /// its height.
    pub fn describe(&self, candidate: &Rect, out: &mut Descriptor) -> bool {
        let Some((columns, rows, stride)) = self.cells(candidate) else { return false };
        let mut above = self.strips(&columns, rows[0] * stride);
        for (y, cells) in out.chunks_exact_mut(CELLS_X * BINS).enumerate() {
            let below = self.strips(&columns, rows[y + 1] * stride);
            for (x, bins) in cells.chunks_exact_mut(BINS).enumerate() {
                let mean = INVERSE[columns[x + 1] - columns[x]] * INVERSE[rows[y + 1] - rows[y]];
                for b in 0..BINS {
                    bins[b] = f32::from(below[x][b].wrapping_sub(above[x][b])) * mean;
                }
            }
            above = below;
        }
        normalize(out);
        *out != EMPTY
    }

    /// Writes how bright `candidate` is, its sides left out, and returns true; or returns false, with `out` left alone,
    /// where [`describe`](Self::describe) would find no cells.
    pub fn tones(&self, candidate: &Rect, out: &mut Tones) -> bool {
        let Some((columns, rows)) = self.stripes(candidate) else { return false };
        for (y, levels) in out.chunks_exact_mut(LEVELS).enumerate() {
            let mut stripe = Stripe::default();
            for row in rows[y]..rows[y + 1] {
                // The gray samples have a border of one.
                stripe.add(&self.gray[(row + 1) * GRAY_STRIDE + columns[0] + 1..][..columns[1] - columns[0]]);
            }
            stripe.write((rows[y + 1] - rows[y]) * (columns[1] - columns[0]), levels);
        }
        true
    }

    /// Grid lines of the inner part of the candidate, and of its stripes.
    fn stripes(&self, candidate: &Rect) -> Option<([usize; 2], [usize; STRIPES + 1])> {
        self.cells(candidate)?;
        let frame = self.frame.as_ref()?;
        let (left, width) = (candidate.left + ASIDE * candidate.width, (1.0 - 2.0 * ASIDE) * candidate.width);
        let columns = frame.horizontal.cell_edges(left, width, OVERHANG_X)?;
        Some((columns, frame.vertical.cell_edges(candidate.top, candidate.height, OVERHANG_Y)?))
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
        let mut columns = [0; GRAY_STRIDE];
        for (i, column) in columns[..width].iter_mut().enumerate() {
            *column = frame.horizontal.pixel(i as isize - 1);
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
                sample_row(image.row(y), image.format(), &columns[..width], row);
            }
            previous = Some(y);
        }
    }

    /// Fills the integral of the votes: `(nx + 1) * (ny + 1)` corners, row by row.
    fn accumulate(&mut self, nx: usize, ny: usize) {
        let directions = Directions::opaque();
        let stride = nx + 1;
        self.integral[..stride].fill([0; BINS]);
        for y in 0..ny {
            let (done, rest) = self.integral.split_at_mut((y + 1) * stride);
            let above = &done[y * stride..];
            let current = &mut rest[..stride];
            let up = &self.gray[y * GRAY_STRIDE + 1..][..nx];
            let middle = &self.gray[(y + 1) * GRAY_STRIDE..][..nx + 2];
            let down = &self.gray[(y + 2) * GRAY_STRIDE + 1..][..nx];
            accumulate_row(&directions, above, current, [up, middle, down]);
        }
    }
}

/// One row of the integral: the corners above plus the running sum of this row's votes.
fn accumulate_row(directions: &Directions, above: &[Corner], current: &mut [Corner], [up, middle, down]: [&[u8]; 3]) {
    let Some((first, current)) = current.split_first_mut() else { return };
    *first = [0; BINS];
    let mut sum = [0u16; BINS];
    let gradients = middle.iter().zip(&middle[2..]).zip(up.iter().zip(down));
    for ((corner, above), ((&left, &right), (&up, &down))) in current.iter_mut().zip(&above[1..]).zip(gradients) {
        let vote = directions.votes(i16::from(right) - i16::from(left), i16::from(down) - i16::from(up));
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
        let margin = if margin.is_nan() { 1.0 } else { margin.clamp(1.0, MAX_MARGIN) };
        Some(Self {
            horizontal: Axis::new(reference.left, reference.width, REFERENCE_X, margin, image.width())?,
            vertical: Axis::new(reference.top, reference.height, REFERENCE_Y, margin, image.height())?,
        })
    }
}

fn is_large_enough(rect: &Rect) -> bool {
    rect.width >= MIN_WIDTH && rect.height >= MIN_HEIGHT
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::appearance::{DESCRIPTOR_LEN, EMPTY, cosine};
    use crate::image::PixelFormat;

    const WIDTH: usize = 96;
    const HEIGHT: usize = 160;
    /// A sample of the grid is one pixel.
    const BOX: Rect = Rect::new(30.0, 40.0, 24.0, 48.0);

    fn picture(brightness: impl Fn(usize, usize) -> u8) -> Vec<u8> {
        (0..WIDTH * HEIGHT).map(|i| brightness(i % WIDTH, i / WIDTH)).collect()
    }

    /// Smooth texture in every direction, 60..=180.
    fn texture(x: usize, y: usize) -> u8 {
        let (x, y) = (x as f64, y as f64);
        (120.0 + 30.0 * (0.31 * x + 0.002 * y * y).sin() + 30.0 * (0.23 * y - 0.003 * x * y).cos()) as u8
    }

    fn gray(data: &[u8]) -> ImageView<'_> {
        ImageView::new(data, WIDTH as u32, HEIGHT as u32, 0, PixelFormat::Gray8).unwrap()
    }

    fn described(image: &ImageView, reference: &Rect, margin: f64, candidate: &Rect) -> Option<Descriptor> {
        let mut hog = HogWorkspace::new();
        let mut out = EMPTY;
        (hog.prepare(image, reference, margin) && hog.describe(candidate, &mut out)).then_some(out)
    }

    fn energy_per_bin(d: &Descriptor) -> [f32; BINS] {
        std::array::from_fn(|b| d.iter().skip(b).step_by(BINS).map(|v| v * v).sum())
    }

    #[test]
    fn a_vertical_edge_is_a_horizontal_gradient_in_the_cells_it_crosses() {
        // Dark left of x = 39, i.e. 9 samples into the box: in the middle of the second column of cells.
        let data = picture(|x, _| if x < 39 { 20 } else { 120 });
        let d = described(&gray(&data), &BOX, 1.0, &BOX).unwrap();
        // Eight equal cells share the unit norm: 1 / sqrt(8) each, in bin 0.
        for (i, &value) in d.iter().enumerate() {
            let expected = if i % BINS == 0 && i / BINS % CELLS_X == 1 { 0.125f32.sqrt() } else { 0.0 };
            assert!((value - expected).abs() < 1e-6, "{i}: {value}");
        }
    }

    #[test]
    fn a_quarter_turn_swaps_horizontal_and_vertical_bins() {
        let upright = picture(|x, _| if x % 12 < 6 { 50 } else { 150 });
        let lying = picture(|_, y| if y % 12 < 6 { 50 } else { 150 });
        let upright = energy_per_bin(&described(&gray(&upright), &BOX, 1.0, &BOX).unwrap());
        let lying = energy_per_bin(&described(&gray(&lying), &BOX, 1.0, &BOX).unwrap());
        assert!((upright[0] - 1.0).abs() < 1e-5 && upright[1..].iter().all(|&e| e == 0.0), "{upright:?}");
        assert!((lying[BINS / 2] - 1.0).abs() < 1e-5, "{lying:?}");
    }

    #[test]
    fn brightness_and_contrast_do_not_matter() {
        let plain = picture(texture);
        let base = described(&gray(&plain), &BOX, 1.6, &BOX).unwrap();
        assert!((cosine(&base, &base) - 1.0).abs() < 1e-6);
        let brighter = picture(|x, y| texture(x, y) + 40);
        assert_eq!(described(&gray(&brighter), &BOX, 1.6, &BOX).unwrap(), base);
        let flatter = picture(|x, y| texture(x, y) / 2);
        let flatter = described(&gray(&flatter), &BOX, 1.6, &BOX).unwrap();
        assert!(cosine(&base, &flatter) > 0.995, "{}", cosine(&base, &flatter));
        // Another part of the picture does look different.
        let other = Rect::new(10.0, 90.0, 24.0, 48.0);
        assert!(cosine(&base, &described(&gray(&plain), &other, 1.6, &other).unwrap()) < 0.95);
    }

    #[test]
    fn without_texture_there_is_nothing_to_compare() {
        let data = picture(|_, _| 77);
        assert_eq!(described(&gray(&data), &BOX, 1.6, &BOX), None);
    }

    #[test]
    fn every_format_of_a_gray_picture_gives_the_same_descriptor_and_padding_is_not_read() {
        let base = described(&gray(&picture(texture)), &BOX, 1.6, &BOX).unwrap();
        let formats = [
            PixelFormat::Gray8,
            PixelFormat::Nv12,
            PixelFormat::I420,
            PixelFormat::Rgb24,
            PixelFormat::Bgr24,
            PixelFormat::Rgba32,
            PixelFormat::Bgra32,
        ];
        for format in formats {
            for (padding, filler) in [(0, 0), (7, 0), (7, 255)] {
                let bytes = format.bytes_per_pixel();
                let mut data = Vec::new();
                for i in 0..WIDTH * HEIGHT {
                    let v = texture(i % WIDTH, i / WIDTH);
                    // The fourth byte is alpha, which must not count.
                    data.extend_from_slice(&[v, v, v, filler][..bytes]);
                    if i % WIDTH == WIDTH - 1 {
                        data.extend(vec![filler; padding]);
                    }
                }
                let stride = WIDTH * bytes + padding;
                let image = ImageView::new(&data, WIDTH as u32, HEIGHT as u32, stride, format).unwrap();
                assert_eq!(described(&image, &BOX, 1.6, &BOX), Some(base), "{format:?} {padding} {filler}");
            }
        }
    }

    #[test]
    fn a_region_describes_its_reference_as_a_tight_region_does() {
        let data = picture(texture);
        for reference in [BOX, Rect::new(20.3, 31.7, 41.9, 77.7), Rect::new(40.0, 60.0, 9.0, 16.0)] {
            let tight = described(&gray(&data), &reference, 1.0, &reference).unwrap();
            for margin in [1.3, 1.6, 2.0] {
                let wide = described(&gray(&data), &reference, margin, &reference).unwrap();
                assert!(cosine(&tight, &wide) > 0.999, "{reference:?} x {margin}");
            }
            // Margins outside 1..=2 count as the nearest one inside.
            assert_eq!(described(&gray(&data), &reference, f64::NAN, &reference), Some(tight));
            assert_eq!(described(&gray(&data), &reference, -3.0, &reference), Some(tight));
        }
    }

    #[test]
    fn a_moved_picture_is_found_where_it_moved() {
        // The texture moved by (5, 3): the candidate moved likewise sees the template again, exactly.
        let template = described(&gray(&picture(texture)), &BOX, 1.6, &BOX).unwrap();
        let moved = picture(|x, y| texture((x + WIDTH - 5) % WIDTH, (y + HEIGHT - 3) % HEIGHT));
        let mut hog = HogWorkspace::new();
        assert!(hog.prepare(&gray(&moved), &BOX, 1.6));
        let mut out = EMPTY;
        assert!(hog.describe(&Rect::new(35.0, 43.0, 24.0, 48.0), &mut out));
        assert_eq!(out, template);
        assert!(hog.describe(&BOX, &mut out));
        assert!(cosine(&out, &template) < 0.95);
    }

    #[test]
    fn tones_go_from_head_to_foot_and_leave_the_sides_out() {
        // The upper half of the box is at 40, the middle of the third level; the lower half at 100, three quarters of
        // the way from the sixth (88) to the seventh (104). Beside the inner two thirds, x 34..50, all is white.
        let data = picture(|x, y| match (34..50).contains(&x) {
            true if y < 64 => 40,
            true => 100,
            false => 255,
        });
        let mut hog = HogWorkspace::new();
        assert!(hog.prepare(&gray(&data), &BOX, 1.6));
        let mut out = [0.0; _];
        assert!(hog.tones(&BOX, &mut out));
        for (i, &value) in out.iter().enumerate() {
            let share: f32 = match (i / LEVELS < STRIPES / 2, i % LEVELS) {
                (true, 2) => 1.0,
                (false, 5) => 0.25,
                (false, 6) => 0.75,
                _ => 0.0,
            };
            assert!((value - (share / STRIPES as f32).sqrt()).abs() < 1e-6, "{i}: {value}");
        }
        // A stripe further down one stripe less is dark.
        assert!(hog.tones(&Rect::new(30.0, 46.0, 24.0, 48.0), &mut out));
        let dark = out.chunks_exact(LEVELS).filter(|stripe| stripe[2] > 0.0).count();
        assert_eq!(dark, STRIPES / 2 - 1);
    }

    #[test]
    fn tones_are_refused_where_there_are_no_cells() {
        let data = picture(texture);
        let mut hog = HogWorkspace::new();
        let mut out = [7.0; _];
        assert!(!hog.tones(&BOX, &mut out));
        assert!(hog.prepare(&gray(&data), &BOX, 1.5));
        for candidate in [
            Rect::new(23.0, 28.0, 24.0, 48.0),
            Rect::new(30.0, 27.0, 24.0, 48.0),
            Rect::new(30.0, 40.0, 7.0, 16.0),
            Rect::new(30.0, f64::NAN, 32.0, 64.0),
        ] {
            assert!(!hog.tones(&candidate, &mut out), "{candidate:?}");
            assert!(out.iter().all(|&value| value == 7.0), "{candidate:?}");
        }
        assert!(hog.tones(&Rect::new(24.0, 28.0, 36.0, 72.0), &mut out));
        let norm: f32 = out.iter().map(|v| v * v).sum();
        assert!((norm - 1.0).abs() < 1e-5, "{norm}");
    }

    #[test]
    fn unusable_references_are_refused_and_leave_nothing_to_describe() {
        let data = picture(texture);
        let image = gray(&data);
        let mut hog = HogWorkspace::new();
        let mut out = EMPTY;
        assert!(!hog.describe(&BOX, &mut out));
        for reference in [
            Rect::new(30.0, 40.0, 0.0, 0.0),
            Rect::new(30.0, 40.0, 7.9, 64.0),
            Rect::new(30.0, 40.0, 32.0, 15.9),
            Rect::new(96.0, 40.0, 32.0, 64.0),
            Rect::new(30.0, -64.0, 32.0, 64.0),
            Rect::new(1e9, 1e9, 32.0, 64.0),
            Rect::new(-5e8, -5e8, 1e9, 1e9),
            Rect::new(f64::NAN, 40.0, 32.0, 64.0),
            Rect::new(30.0, 40.0, f64::INFINITY, 64.0),
            Rect::new(30.0, 40.0, 32.0, f64::NAN),
        ] {
            assert!(hog.prepare(&image, &BOX, 1.6));
            assert!(!hog.prepare(&image, &reference, 1.6), "{reference:?}");
            assert!(!hog.describe(&BOX, &mut out), "{reference:?}");
        }
    }

    #[test]
    fn unusable_candidates_are_refused_and_leave_the_output_alone() {
        let data = picture(texture);
        let mut hog = HogWorkspace::new();
        // Margin 1.5: 6 pixels more on the left and right, 12 above and below: x 24..60, y 28..100.
        assert!(hog.prepare(&gray(&data), &BOX, 1.5));
        for (candidate, usable) in [
            (Rect::new(24.0, 28.0, 24.0, 48.0), true),
            (Rect::new(36.0, 52.0, 24.0, 48.0), true),
            (Rect::new(24.0, 28.0, 36.0, 72.0), true),
            (Rect::new(23.0, 28.0, 24.0, 48.0), false),
            (Rect::new(37.0, 52.0, 24.0, 48.0), false),
            (Rect::new(36.0, 53.0, 24.0, 48.0), false),
            (Rect::new(30.0, 27.0, 24.0, 48.0), false),
            (Rect::new(30.0, 40.0, 8.0, 16.0), true),
            (Rect::new(30.0, 40.0, 7.0, 16.0), false),
            (Rect::new(30.0, 40.0, 0.0, 0.0), false),
            (Rect::new(1e9, 1e9, 32.0, 64.0), false),
            (Rect::new(-1e9, 40.0, 2e9, 64.0), false),
            (Rect::new(30.0, f64::NAN, 32.0, 64.0), false),
            (Rect::new(30.0, 40.0, f64::INFINITY, 64.0), false),
        ] {
            let mut out = EMPTY;
            assert_eq!(hog.describe(&candidate, &mut out), usable, "{candidate:?}");
            assert_eq!(out != EMPTY, usable, "{candidate:?}");
        }
    }

    #[test]
    fn a_box_may_stick_out_of_the_image_by_half_a_cell() {
        let data = picture(texture);
        // 32 / 8 = 4 pixels, 64 / 16 = 4 pixels.
        for (left, top, usable) in [
            (-4.0, 40.0, true),
            (-4.5, 40.0, false),
            (68.0, 40.0, true),
            (68.5, 40.0, false),
            (30.0, -4.0, true),
            (30.0, -4.5, false),
            (30.0, 100.0, true),
            (30.0, 100.5, false),
        ] {
            let rect = Rect::new(left, top, 32.0, 64.0);
            assert_eq!(described(&gray(&data), &rect, 1.6, &rect).is_some(), usable, "{rect:?}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        /// The integral against sums taken sample by sample, also where it wraps: full contrast on every sample.
        #[test]
        fn cells_are_the_brute_force_sums_of_votes(
            seed in any::<u64>(), strong in any::<bool>(), margin in 1.0f64..2.0,
            (dx, dy, sx, sy) in (-0.3f64..0.3, -0.3f64..0.3, 0.7f64..1.4, 0.7f64..1.4),
        ) {
            let noise = |x: usize, y: usize| {
                let z = (seed ^ (y * WIDTH + x) as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
                if strong { if x % 4 < 2 { 0 } else { 255 } } else { (z >> 56) as u8 }
            };
            let data = picture(noise);
            let mut hog = HogWorkspace::new();
            prop_assert!(hog.prepare(&gray(&data), &BOX, margin));
            let candidate = Rect::new(30.0 + 24.0 * dx, 40.0 + 48.0 * dy, 24.0 * sx, 48.0 * sy);
            let mut out = EMPTY;
            prop_assume!(hog.describe(&candidate, &mut out));
            // A sample is a pixel, so grid lines are whole pixels.
            let edge = |start: f64, length: f64, cells: usize, k: usize| {
                (start + length * k as f64 / cells as f64 + 0.5).floor() as usize
            };
            let mut expected = [0.0f64; DESCRIPTOR_LEN];
            for (i, value) in expected.iter_mut().enumerate() {
                let (b, x, y) = (i % BINS, i / BINS % CELLS_X, i / BINS / CELLS_X);
                let xs = edge(candidate.left, candidate.width, CELLS_X, x)..edge(candidate.left, candidate.width, CELLS_X, x + 1);
                let ys = edge(candidate.top, candidate.height, CELLS_Y, y)..edge(candidate.top, candidate.height, CELLS_Y, y + 1);
                let area = (xs.len() * ys.len()) as f64;
                for py in ys {
                    for px in xs.clone() {
                        let at = |x: usize, y: usize| i16::from(noise(x.min(WIDTH - 1), y.min(HEIGHT - 1)));
                        let left = at(px.saturating_sub(1), py);
                        let up = at(px, py.saturating_sub(1));
                        let votes = Directions::opaque().votes(at(px + 1, py) - left, at(px, py + 1) - up);
                        *value += f64::from(votes[b]) / area;
                    }
                }
            }
            let norm = expected.iter().map(|v| v * v).sum::<f64>().sqrt();
            for (i, (&got, want)) in out.iter().zip(expected).enumerate() {
                prop_assert!((f64::from(got) - want / norm).abs() < 1e-5, "{i}: {got} instead of {}", want / norm);
            }
        }
    }
}
