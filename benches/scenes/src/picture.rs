//! A picture with texture everywhere, so that every box has something to be described by.

use gentrack2::{ImageView, PixelFormat};

/// Pixels in a patch of one brightness.
const GRAIN: u32 = 6;

/// A gray picture.
pub struct Picture {
    pixels: Vec<u8>,
    size: (u32, u32),
}

impl Picture {
    /// A picture of this size, moved to the left by `shift` pixels.
    pub fn new(size: (u32, u32), shift: u32) -> Self {
        let value = |x: u32, y: u32| {
            let patch = u64::from((x + shift) / GRAIN) << 32 | u64::from(y / GRAIN);
            crate::noise::Noise::new(patch).between(0.0, 256.0) as u8
        };
        let pixels = (0..size.1).flat_map(|y| (0..size.0).map(move |x| value(x, y))).collect();
        Self { pixels, size }
    }

    /// As trackers take it.
    pub fn view(&self) -> ImageView<'_> {
        ImageView::new(&self.pixels, self.size.0, self.size.1, 0, PixelFormat::Gray8).expect("the sizes fit")
    }
}
