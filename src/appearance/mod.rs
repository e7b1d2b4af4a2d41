//! What targets look like: HOG descriptors of many candidate boxes, and how bright the boxes are, taken straight from the
//! caller's image.
//!
//! The appearance fitness of the paper (eq. 5) is `f_s = <X_i, X_j> / (|X_i| |X_j|)`, the cosine of the non-negative HOG
//! vectors of a particle's box and of its target. A target's particles overlap heavily, so the gradients around it are
//! computed once ([`HogWorkspace::prepare`]); each particle then costs a few table look-ups
//! ([`HogWorkspace::describe`]).
//!
//! ```
//! use gentrack2::appearance::{Descriptor, EMPTY, HogWorkspace, cosine};
//! use gentrack2::{ImageView, PixelFormat, Rect};
//!
//! // A 64 x 128 picture of vertical stripes, 8 pixels wide.
//! let pixels: Vec<u8> = (0..64 * 128).map(|i| if i / 8 % 2 == 0 { 30 } else { 200 }).collect();
//! let image = ImageView::new(&pixels, 64, 128, 0, PixelFormat::Gray8)?;
//! let target = Rect::new(16.0, 32.0, 32.0, 64.0);
//!
//! let mut hog = HogWorkspace::new();
//! assert!(hog.prepare(&image, &target, 1.6));
//! let (mut template, mut candidate): (Descriptor, Descriptor) = (EMPTY, EMPTY);
//! assert!(hog.describe(&target, &mut template));
//! assert!(hog.describe(&Rect::new(16.0, 34.0, 32.0, 64.0), &mut candidate));
//! assert!(cosine(&template, &candidate) > 0.999);
//! # Ok::<(), gentrack2::Error>(())
//! ```

mod descriptor;
mod gray;
mod hog;
mod orientation;
mod tones;

pub use descriptor::{CELLS_X, CELLS_Y, DESCRIPTOR_LEN, Descriptor, EMPTY, cosine, normalize};
pub use hog::{HogWorkspace, MAX_MARGIN, MIN_HEIGHT, MIN_WIDTH};
pub use orientation::BINS;
pub use tones::{LEVELS, STRIPES, TONES_LEN, Tones};
