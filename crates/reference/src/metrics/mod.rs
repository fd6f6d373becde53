//! How far one picture is from another.
//!
//! - [`Comparison`] measures linear premultiplied pixels, before any tone curve: what an error bound can promise.
//! - [`DisplayComparison`] measures what a viewer has on the screen, sRGB in 8 bits: what can be seen.
//! - [`SurfaceComparison`] measures surfaces where rays meet them: distance, normal and silhouette.

mod ciede2000;
mod color;
mod display;
mod filter;
mod flip;
mod linear;
mod ssim;
mod surface;

pub use ciede2000::ciede2000;
pub use color::{Lab, srgb_decode, srgb_encode};
pub use display::{DisplayComparison, DisplayPicture};
pub use flip::{Flip, PIXELS_PER_DEGREE};
pub use linear::{CompareError, Comparison, ErrorStatistics, Pixel, TRANSMITTANCE_FLOOR, VISIBLE_ERROR};
pub use ssim::ssim;
pub use surface::{SurfaceComparison, SurfacePoint};
