//! Colours as displays and eyes see them.

/// Linear sRGB to CIE XYZ with the white D65, from the primaries of IEC 61966-2-1 in full precision.
const RGB_TO_XYZ: [[f64; 3]; 3] = [
    [10_135_552.0 / 24_577_794.0, 8_788_810.0 / 24_577_794.0, 4_435_075.0 / 24_577_794.0],
    [2_613_072.0 / 12_288_897.0, 8_788_810.0 / 12_288_897.0, 887_015.0 / 12_288_897.0],
    [1_425_312.0 / 73_733_382.0, 8_788_810.0 / 73_733_382.0, 70_074_185.0 / 73_733_382.0],
];

/// The inverse of [`RGB_TO_XYZ`].
const XYZ_TO_RGB: [[f64; 3]; 3] = [
    [3.241_003_232_976_358, -1.537_398_969_488_785_7, -0.498_615_881_996_362_8],
    [-0.969_224_252_202_516_4, 1.875_929_983_695_175_8, 0.041_554_226_340_084_71],
    [0.055_639_419_851_975_45, -0.204_011_206_123_910_5, 1.057_148_977_187_533],
];

/// A colour in CIE L*a*b*, relative to the white of the display.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lab {
    /// L*, 0 to 100.
    pub lightness: f64,
    /// a*, green to red.
    pub a: f64,
    /// b*, blue to yellow.
    pub b: f64,
}

/// The 8-bit sRGB code of a linear component; what lies outside of 0 to 1 is clamped, what is not a number becomes black.
pub fn srgb_encode(linear: f64) -> u8 {
    let x = linear.clamp(0.0, 1.0);
    let encoded = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
    (encoded * 255.0).round() as u8
}

/// The linear component, 0 to 1, of an 8-bit sRGB code.
pub fn srgb_decode(code: u8) -> f64 {
    let x = f64::from(code) / 255.0;
    if x <= 0.040_45 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}

fn multiply(matrix: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// CIE XYZ relative to the white of the display: linear white is `(1, 1, 1)`.
pub(super) fn relative_xyz(rgb: [f64; 3]) -> [f64; 3] {
    let white = multiply(&RGB_TO_XYZ, [1.0; 3]);
    let xyz = multiply(&RGB_TO_XYZ, rgb);
    [0, 1, 2].map(|i| xyz[i] / white[i])
}

/// The linear sRGB colour of XYZ relative to the white of the display.
pub(super) fn rgb_of(relative_xyz: [f64; 3]) -> [f64; 3] {
    let white = multiply(&RGB_TO_XYZ, [1.0; 3]);
    multiply(&XYZ_TO_RGB, [0, 1, 2].map(|i| relative_xyz[i] * white[i]))
}

impl Lab {
    /// The colour of a linear sRGB colour.
    pub fn of_linear(rgb: [f64; 3]) -> Self {
        const DELTA: f64 = 6.0 / 29.0;
        let curve = |t: f64| if t > DELTA.powi(3) { t.cbrt() } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 };
        let [x, y, z] = relative_xyz(rgb).map(curve);
        Self { lightness: 116.0 * y - 16.0, a: 500.0 * (x - y), b: 200.0 * (y - z) }
    }

    /// The colour of an 8-bit sRGB pixel.
    pub fn of_srgb(pixel: [u8; 3]) -> Self {
        Self::of_linear(pixel.map(srgb_decode))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_colors() {
        for (pixel, expected) in [
            ([255, 255, 255], [100.0, 0.0, 0.0]),
            ([0, 0, 0], [0.0, 0.0, 0.0]),
            ([255, 0, 0], [53.2406, 80.0923, 67.2028]),
            ([12, 200, 99], [71.0669, -63.4583, 38.8503]),
        ] {
            let found = Lab::of_srgb(pixel);
            let differences = [found.lightness - expected[0], found.a - expected[1], found.b - expected[2]];
            // Published values use the matrix rounded to four digits.
            assert!(differences.iter().all(|d| d.abs() < 0.02), "{pixel:?}: {found:?}");
        }
    }

    #[test]
    fn codes_and_colors_come_back() {
        assert!((0..=255).all(|code| srgb_encode(srgb_decode(code)) == code));
        assert_eq!([-1.0, 2.0, f64::NAN].map(srgb_encode), [0, 255, 0]);
        let rgb = [0.2, 0.7, 0.05];
        assert!(rgb_of(relative_xyz(rgb)).iter().zip(rgb).all(|(a, b)| (a - b).abs() < 1e-12));
    }
}
