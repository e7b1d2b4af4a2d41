//! Brightness of single pixels. Nothing but the pixels that are asked for is read or converted.

use crate::image::PixelFormat;

/// ITU-R BT.601 luma in 1/256: `(77 R + 150 G + 29 B) / 256`, rounded. The weights sum to 256, so a gray pixel keeps
/// its value exactly.
fn luma(red: u8, green: u8, blue: u8) -> u8 {
    ((77 * u32::from(red) + 150 * u32::from(green) + 29 * u32::from(blue) + 128) >> 8) as u8
}

/// Brightness at the given columns of one row of the image; columns beyond the row leave their place in `out` as it is.
pub fn sample_row(row: &[u8], format: PixelFormat, columns: &[u32], out: &mut [u8]) {
    match format {
        PixelFormat::Gray8 | PixelFormat::Nv12 | PixelFormat::I420 => gather::<1>(row, columns, out, |p| p[0]),
        PixelFormat::Rgb24 => gather::<3>(row, columns, out, |p| luma(p[0], p[1], p[2])),
        PixelFormat::Bgr24 => gather::<3>(row, columns, out, |p| luma(p[2], p[1], p[0])),
        PixelFormat::Rgba32 => gather::<4>(row, columns, out, |p| luma(p[0], p[1], p[2])),
        PixelFormat::Bgra32 => gather::<4>(row, columns, out, |p| luma(p[2], p[1], p[0])),
    }
}

fn gather<const BYTES: usize>(row: &[u8], columns: &[u32], out: &mut [u8], brightness: impl Fn(&[u8; BYTES]) -> u8) {
    let (pixels, _) = row.as_chunks::<BYTES>();
    for (value, &column) in out.iter_mut().zip(columns) {
        if let Some(pixel) = pixels.get(column as usize) {
            *value = brightness(pixel);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn luma_follows_bt601() {
        // 77*255 = 19635, +128 = 19763, /256 = 77.2; 150*255 = 38250, +128 = 38378, /256 = 149.9;
        // 29*255 = 7395, +128 = 7523, /256 = 29.4.
        assert_eq!([luma(255, 0, 0), luma(0, 255, 0), luma(0, 0, 255)], [77, 149, 29]);
        assert!((0..=255).all(|v| luma(v, v, v) == v));
    }

    #[test]
    fn every_format_finds_its_channels() {
        let sample = |row: &[u8], format: PixelFormat| {
            let mut out = [0];
            sample_row(row, format, &[1], &mut out);
            out[0]
        };
        // The second pixel is pure red: 77.
        assert_eq!(sample(&[9, 9, 9, 255, 0, 0], PixelFormat::Rgb24), 77);
        assert_eq!(sample(&[9, 9, 9, 0, 0, 255], PixelFormat::Bgr24), 77);
        assert_eq!(sample(&[9, 9, 9, 9, 255, 0, 0, 50], PixelFormat::Rgba32), 77);
        assert_eq!(sample(&[9, 9, 9, 9, 0, 0, 255, 50], PixelFormat::Bgra32), 77);
        for format in [PixelFormat::Gray8, PixelFormat::Nv12, PixelFormat::I420] {
            assert_eq!(sample(&[9, 123], format), 123);
        }
    }
}
