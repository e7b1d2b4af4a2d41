//! A borrowed view of the caller's image. Only brightness is ever read, so the planar formats need their luma plane
//! alone.

use crate::error::Error;

/// How pixels lie in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PixelFormat {
    /// One byte of brightness per pixel.
    Gray8,
    /// Three bytes per pixel: red, green, blue.
    Rgb24,
    /// Three bytes per pixel: blue, green, red (OpenCV's order).
    Bgr24,
    /// Four bytes per pixel: red, green, blue, alpha.
    Rgba32,
    /// Four bytes per pixel: blue, green, red, alpha.
    Bgra32,
    /// Luma plane, then interleaved chroma, which is not read.
    Nv12,
    /// Luma plane, then two chroma planes, which are not read.
    I420,
}

impl PixelFormat {
    /// Bytes per pixel of the plane that is read.
    pub const fn bytes_per_pixel(self) -> usize {
        match self {
            PixelFormat::Gray8 | PixelFormat::Nv12 | PixelFormat::I420 => 1,
            PixelFormat::Rgb24 | PixelFormat::Bgr24 => 3,
            PixelFormat::Rgba32 | PixelFormat::Bgra32 => 4,
        }
    }
}

/// Largest width and height of an image in pixels.
pub const MAX_IMAGE_SIDE: u32 = 65_535;

/// A borrowed image.
#[derive(Clone, Copy, Debug)]
pub struct ImageView<'a> {
    data: &'a [u8],
    width: u32,
    height: u32,
    stride: usize,
    format: PixelFormat,
}

impl<'a> ImageView<'a> {
    /// A view of `height` rows of `width` pixels, `stride` bytes from row to row (0: rows are packed). `data` starts
    /// at the left-top pixel (of the luma plane) and holds at least up to the last pixel of the last row.
    pub fn new(data: &'a [u8], width: u32, height: u32, stride: usize, format: PixelFormat) -> Result<Self, Error> {
        let (stride, needed) = Self::layout(width, height, stride, format)?;
        if data.len() < needed {
            return Err(image_error("data", format!("holds {} bytes, {needed} are needed", data.len())));
        }
        Ok(Self { data, width, height, stride, format })
    }

    /// The stride in force and the number of bytes that an image of this layout spans.
    pub fn layout(width: u32, height: u32, stride: usize, format: PixelFormat) -> Result<(usize, usize), Error> {
        for (field, side) in [("width", width), ("height", height)] {
            if side == 0 || side > MAX_IMAGE_SIDE {
                return Err(image_error(field, format!("is {side}, must be in 1..={MAX_IMAGE_SIDE}")));
            }
        }
        let row = width as usize * format.bytes_per_pixel();
        let stride = if stride == 0 { row } else { stride };
        if stride < row {
            return Err(image_error("stride", format!("is {stride} bytes, a row of this width takes {row}")));
        }
        let span = stride.checked_mul(height as usize - 1).and_then(|n| n.checked_add(row));
        match span {
            Some(bytes) if bytes <= isize::MAX as usize => Ok((stride, bytes)),
            _ => Err(image_error("stride", format!("is {stride} bytes, too large for {height} rows"))),
        }
    }

    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Layout of the pixels.
    pub fn format(&self) -> PixelFormat {
        self.format
    }

    /// The bytes of row `y`, exactly `width` pixels.
    pub fn row(&self, y: u32) -> &'a [u8] {
        let start = y as usize * self.stride;
        &self.data[start..start + self.width as usize * self.format.bytes_per_pixel()]
    }
}

fn image_error(field: &'static str, reason: String) -> Error {
    Error::Image { field, reason }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_view_needs_its_last_row_but_not_its_padding() {
        // 2 rows of 3 BGR pixels, 12 bytes apart: 12 + 9 = 21 bytes.
        let data = [0u8; 21];
        let view = ImageView::new(&data, 3, 2, 12, PixelFormat::Bgr24).unwrap();
        assert_eq!(view.row(1).len(), 9);
        let error = ImageView::new(&data[..20], 3, 2, 12, PixelFormat::Bgr24).unwrap_err();
        assert_eq!(error.to_string(), "image.data: holds 20 bytes, 21 are needed");
    }

    #[test]
    fn sizes_and_strides_that_do_not_fit_are_refused() {
        let data = [0u8; 64];
        assert!(ImageView::new(&data, 0, 2, 0, PixelFormat::Gray8).is_err());
        assert!(ImageView::new(&data, 4, 70_000, 0, PixelFormat::Gray8).is_err());
        assert!(ImageView::new(&data, 4, 4, 3, PixelFormat::Gray8).is_err());
        assert!(ImageView::new(&data, 4, 4, usize::MAX / 2, PixelFormat::Gray8).is_err());
    }
}
