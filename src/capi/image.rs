//! Images on their way in.

use super::pointer::require;
use super::status::*;
use super::structs::{self, SizedStruct};
use crate::error::Error;
use crate::image::{ImageView, PixelFormat};
use crate::validation::Limits;

/// One byte of brightness per pixel.
pub const GT2_PIXEL_GRAY8: i32 = 0;
/// Three bytes per pixel: red, green, blue.
pub const GT2_PIXEL_RGB24: i32 = 1;
/// Three bytes per pixel: blue, green, red (OpenCV's order).
pub const GT2_PIXEL_BGR24: i32 = 2;
/// Four bytes per pixel: red, green, blue, alpha (not read).
pub const GT2_PIXEL_RGBA32: i32 = 3;
/// Four bytes per pixel: blue, green, red, alpha (not read).
pub const GT2_PIXEL_BGRA32: i32 = 4;
/// A plane of one byte of brightness per pixel; the chroma plane is never read and need not be there.
pub const GT2_PIXEL_NV12: i32 = 5;
/// A plane of one byte of brightness per pixel; the chroma planes are never read and need not be there.
pub const GT2_PIXEL_I420: i32 = 6;

/// An image in the caller's memory, read during `gt2_tracker_step` only. Start from `GT2_IMAGE_INIT`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gt2_image {
    /// `sizeof(gt2_image)`; 0 stands for the first published layout of this struct.
    pub struct_size: usize,
    /// The left-top pixel; of planar formats that of the luma plane. The memory must reach to the last pixel of the
    /// last row, `stride * (height - 1) + width * bytes per pixel`.
    pub data: *const u8,
    /// Bytes from the start of a row to the start of the next; 0 for rows without padding.
    pub stride: usize,
    /// Width in pixels, in 1..=65535; width times height at most the parameter max_image_pixels.
    pub width: u32,
    /// Height in pixels, in 1..=65535.
    pub height: u32,
    /// One of `GT2_PIXEL_...`.
    pub format: i32,
    /// Must be 0.
    pub reserved: i32,
}

// SAFETY: repr(C), size first, raw pointers and integers only.
unsafe impl SizedStruct for gt2_image {
    const NAME: &'static str = "image";
    const FIRST_SIZE: usize = size_of::<gt2_image>();
}

/// Checks and borrows the caller's image.
///
/// # Safety
/// `image` can be read up to its stated size, and its memory as stated in the struct does not change during `'a`.
pub(super) unsafe fn read_image<'a>(image: *const gt2_image, limits: &Limits) -> Result<ImageView<'a>, Failure> {
    // SAFETY: the caller's promise.
    let image = unsafe { structs::read(image) }?;
    let refuse = |field, reason| Error::Image { field, reason };
    let format = pixel_format(image.format)
        .ok_or_else(|| refuse("format", format!("is {}, must be one of GT2_PIXEL_...", image.format)))?;
    if image.reserved != 0 {
        return Err(refuse("reserved", format!("is {}, must be 0", image.reserved)).into());
    }
    let (stride, span) = ImageView::layout(image.width, image.height, image.stride, format)?;
    limits.check_image(image.width, image.height)?;
    require(image.data, "image.data")?;
    // SAFETY: not NULL, of a possible size; the rest is the caller's promise.
    let data = unsafe { std::slice::from_raw_parts(image.data, span) };
    Ok(ImageView::new(data, image.width, image.height, stride, format)?)
}

fn pixel_format(number: i32) -> Option<PixelFormat> {
    Some(match number {
        GT2_PIXEL_GRAY8 => PixelFormat::Gray8,
        GT2_PIXEL_RGB24 => PixelFormat::Rgb24,
        GT2_PIXEL_BGR24 => PixelFormat::Bgr24,
        GT2_PIXEL_RGBA32 => PixelFormat::Rgba32,
        GT2_PIXEL_BGRA32 => PixelFormat::Bgra32,
        GT2_PIXEL_NV12 => PixelFormat::Nv12,
        GT2_PIXEL_I420 => PixelFormat::I420,
        _ => return None,
    })
}
