//! Errors as colours.

/// Errors are told apart from this one on, in decades up to 1.
pub const FAINTEST_ERROR: f64 = 1e-5;
/// Colours from [`FAINTEST_ERROR`] to 1, evenly spaced: dark to light, told apart by all eyes.
const SCALE: [[f64; 3]; 6] = [
    [10.0, 12.0, 28.0],
    [59.0, 28.0, 110.0],
    [140.0, 41.0, 129.0],
    [222.0, 73.0, 104.0],
    [254.0, 159.0, 109.0],
    [252.0, 253.0, 191.0],
];

/// The colour of an error, by its logarithm: sRGB.
pub fn error_color(error: f64) -> [u8; 3] {
    color(share(error))
}

/// The colours of the scale from [`FAINTEST_ERROR`] to 1, evenly spaced: sRGB.
pub fn error_colors() -> impl Iterator<Item = [u8; 3]> {
    SCALE.into_iter().map(|color| color.map(byte))
}

/// Where an error lies on the scale, 0 to 1.
fn share(error: f64) -> f64 {
    if error > 0.0 { (1.0 - error.log10() / FAINTEST_ERROR.log10()).clamp(0.0, 1.0) } else { 0.0 }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_rise_along_the_scale() {
        assert_eq!([0.0, 1e-6, 1e-5, 1.0, 7.0].map(share), [0.0, 0.0, 0.0, 1.0, 1.0]);
        assert!((share(10f64.powf(-2.5)) - 0.5).abs() < 1e-12);
        assert_eq!((error_color(1.0), error_colors().last()), ([252, 253, 191], Some([252, 253, 191])));
    }
}
