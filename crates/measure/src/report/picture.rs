//! Pictures inside a page: PNG in a `data:` address.

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageError};

use crate::errors::color::{error_color, error_colors};

/// The ground on which pictures are shown: premultiplied colours are laid over it.
const GROUND: [f64; 3] = [0.08, 0.09, 0.12];
/// A premultiplied picture over a dark ground.
pub(super) fn picture(size: [u32; 2], pixels: &[[f64; 4]]) -> Result<String, ImageError> {
    let code = |pixel: &[f64; 4]| [0, 1, 2].map(|i| byte(255.0 * (pixel[i] + (1.0 - pixel[3]) * GROUND[i])));
    address(size, pixels.iter().flat_map(code).collect())
}

/// Errors in colours, by their logarithm.
pub(super) fn map(size: [u32; 2], errors: &[f32]) -> Result<String, ImageError> {
    address(size, errors.iter().flat_map(|&error| error_color(error.into())).collect())
}

/// The colours of [`map`] from left to right, as a CSS gradient.
pub(super) fn scale() -> String {
    let stop = |[r, g, b]: [u8; 3]| format!("rgb({r} {g} {b})");
    format!("linear-gradient(to right, {})", error_colors().map(stop).collect::<Vec<_>>().join(", "))
}

/// Casts saturate, and turn NaN into 0.
fn byte(x: f64) -> u8 {
    x.round() as u8
}

fn address([width, height]: [u32; 2], bytes: Vec<u8>) -> Result<String, ImageError> {
    let mut png = Vec::new();
    PngEncoder::new(&mut png).write_image(&bytes, width, height, ExtendedColorType::Rgb8)?;
    Ok(format!("data:image/png;base64,{}", base64(&png)))
}

/// RFC 4648.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let at = |i: usize| u32::from(group.get(i).copied().unwrap_or(0));
        let word = at(0) << 16 | at(1) << 8 | at(2);
        for digit in 0..4 {
            let known = digit <= group.len();
            text.push(if known { char::from(DIGITS[(word >> (18 - 6 * digit) & 63) as usize]) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_of_the_standard() {
        let texts = ["", "f", "fo", "foo", "foob"].map(|text| base64(text.as_bytes()));
        assert_eq!(texts, ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg=="]);
    }
}
