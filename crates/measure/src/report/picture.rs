//! Pictures inside a page: PNG in a `data:` address.

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageError};

/// The ground on which pictures are shown: premultiplied colours are laid over it.
const GROUND: [f64; 3] = [0.08, 0.09, 0.12];
/// Errors are shown from this one on, in decades up to 1.
const FAINTEST: f64 = 1e-5;
/// Colours of the error map from [`FAINTEST`] to 1: dark to light, told apart by all eyes.
const SCALE: [[f64; 3]; 6] = [
    [10.0, 12.0, 28.0],
    [59.0, 28.0, 110.0],
    [140.0, 41.0, 129.0],
    [222.0, 73.0, 104.0],
    [254.0, 159.0, 109.0],
    [252.0, 253.0, 191.0],
];

/// A premultiplied picture over a dark ground.
pub(super) fn picture(size: [u32; 2], pixels: &[[f64; 4]]) -> Result<String, ImageError> {
    let code = |pixel: &[f64; 4]| [0, 1, 2].map(|i| byte(255.0 * (pixel[i] + (1.0 - pixel[3]) * GROUND[i])));
    address(size, pixels.iter().flat_map(code).collect())
}

/// Errors in colours, by their logarithm.
pub(super) fn map(size: [u32; 2], errors: &[f32]) -> Result<String, ImageError> {
    address(size, errors.iter().flat_map(|&error| color(share(f64::from(error)))).collect())
}

/// The colours of [`map`] from left to right, as a CSS gradient.
pub(super) fn scale() -> String {
    let stop = |color: &[f64; 3]| format!("rgb({:.0} {:.0} {:.0})", color[0], color[1], color[2]);
    format!("linear-gradient(to right, {})", SCALE.iter().map(stop).collect::<Vec<_>>().join(", "))
}

/// Where an error lies on the scale, 0 to 1.
fn share(error: f64) -> f64 {
    if error > 0.0 { (1.0 - error.log10() / FAINTEST.log10()).clamp(0.0, 1.0) } else { 0.0 }
}

fn color(share: f64) -> [u8; 3] {
    let at = share * (SCALE.len() - 1) as f64;
    let i = (at as usize).min(SCALE.len() - 2);
    let t = at - i as f64;
    [0, 1, 2].map(|c| byte(SCALE[i][c] + t * (SCALE[i + 1][c] - SCALE[i][c])))
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

    #[test]
    fn errors_rise_along_the_scale() {
        assert_eq!([0.0, 1e-6, 1e-5, 1.0, 7.0].map(share), [0.0, 0.0, 0.0, 1.0, 1.0]);
        assert!((share(10f64.powf(-2.5)) - 0.5).abs() < 1e-12);
        assert_eq!(color(1.0), [252, 253, 191]);
    }
}
