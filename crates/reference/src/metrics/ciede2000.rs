//! The colour difference CIEDE2000.

use super::color::Lab;

const TWENTY_FIVE_TO_THE_7TH: f64 = 6_103_515_625.0;

/// The colour difference ΔE₀₀ with all three weights one: about 1 is just noticeable.
///
/// After Sharma, Wu and Dalal, "The CIEDE2000 color-difference formula: implementation notes, supplementary test data, and
/// mathematical observations" (2005), and named as there.
pub fn ciede2000(a: Lab, b: Lab) -> f64 {
    let mean_chroma = 0.5 * (a.a.hypot(a.b) + b.a.hypot(b.b));
    let g = 0.5 * (1.0 - chroma_weight(mean_chroma));
    let polar = |color: Lab| {
        let red = (1.0 + g) * color.a;
        (red.hypot(color.b), color.b.atan2(red).to_degrees().rem_euclid(360.0))
    };
    let ((c1, h1), (c2, h2)) = (polar(a), polar(b));
    let grey = c1 * c2 == 0.0;
    let lightness = 0.5 * (a.lightness + b.lightness);
    let chroma = 0.5 * (c1 + c2);
    // A grey has no hue: the difference is none, and the mean is that of the other colour.
    let hue_step = match h2 - h1 {
        _ if grey => 0.0,
        step if step > 180.0 => step - 360.0,
        step if step < -180.0 => step + 360.0,
        step => step,
    };
    let hue = match h1 + h2 {
        sum if grey => sum,
        sum if (h1 - h2).abs() <= 180.0 => 0.5 * sum,
        sum if sum < 360.0 => 0.5 * (sum + 360.0),
        sum => 0.5 * (sum - 360.0),
    };
    let cosine = |degrees: f64| degrees.to_radians().cos();
    let t = 1.0 - 0.17 * cosine(hue - 30.0) + 0.24 * cosine(2.0 * hue) + 0.32 * cosine(3.0 * hue + 6.0)
        - 0.20 * cosine(4.0 * hue - 63.0);
    let from_middle = (lightness - 50.0).powi(2);
    let scale_lightness = 1.0 + 0.015 * from_middle / (20.0 + from_middle).sqrt();
    let scale_chroma = 1.0 + 0.045 * chroma;
    let scale_hue = 1.0 + 0.015 * chroma * t;
    let turn = 30.0 * (-((hue - 275.0) / 25.0).powi(2)).exp();
    let rotation = -(2.0 * turn).to_radians().sin() * 2.0 * chroma_weight(chroma);
    let l = (b.lightness - a.lightness) / scale_lightness;
    let c = (c2 - c1) / scale_chroma;
    let h = 2.0 * (c1 * c2).sqrt() * (0.5 * hue_step).to_radians().sin() / scale_hue;
    (l * l + c * c + h * h + rotation * c * h).max(0.0).sqrt()
}

/// `√(C⁷ / (C⁷ + 25⁷))`.
fn chroma_weight(chroma: f64) -> f64 {
    let seventh = chroma.powi(7);
    (seventh / (seventh + TWENTY_FIVE_TO_THE_7TH)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The supplementary test data of the paper.
    const PAIRS: [([f64; 3], [f64; 3], f64); 34] = [
        ([50.0, 2.6772, -79.7751], [50.0, 0.0, -82.7485], 2.0425),
        ([50.0, 3.1571, -77.2803], [50.0, 0.0, -82.7485], 2.8615),
        ([50.0, 2.8361, -74.02], [50.0, 0.0, -82.7485], 3.4412),
        ([50.0, -1.3802, -84.2814], [50.0, 0.0, -82.7485], 1.0),
        ([50.0, -1.1848, -84.8006], [50.0, 0.0, -82.7485], 1.0),
        ([50.0, -0.9009, -85.5211], [50.0, 0.0, -82.7485], 1.0),
        ([50.0, 0.0, 0.0], [50.0, -1.0, 2.0], 2.3669),
        ([50.0, -1.0, 2.0], [50.0, 0.0, 0.0], 2.3669),
        ([50.0, 2.49, -0.001], [50.0, -2.49, 0.0009], 7.1792),
        ([50.0, 2.49, -0.001], [50.0, -2.49, 0.001], 7.1792),
        ([50.0, 2.49, -0.001], [50.0, -2.49, 0.0011], 7.2195),
        ([50.0, 2.49, -0.001], [50.0, -2.49, 0.0012], 7.2195),
        ([50.0, -0.001, 2.49], [50.0, 0.0009, -2.49], 4.8045),
        ([50.0, -0.001, 2.49], [50.0, 0.001, -2.49], 4.8045),
        ([50.0, -0.001, 2.49], [50.0, 0.0011, -2.49], 4.7461),
        ([50.0, 2.5, 0.0], [50.0, 0.0, -2.5], 4.3065),
        ([50.0, 2.5, 0.0], [73.0, 25.0, -18.0], 27.1492),
        ([50.0, 2.5, 0.0], [61.0, -5.0, 29.0], 22.8977),
        ([50.0, 2.5, 0.0], [56.0, -27.0, -3.0], 31.903),
        ([50.0, 2.5, 0.0], [58.0, 24.0, 15.0], 19.4535),
        ([50.0, 2.5, 0.0], [50.0, 3.1736, 0.5854], 1.0),
        ([50.0, 2.5, 0.0], [50.0, 3.2972, 0.0], 1.0),
        ([50.0, 2.5, 0.0], [50.0, 1.8634, 0.5757], 1.0),
        ([50.0, 2.5, 0.0], [50.0, 3.2592, 0.335], 1.0),
        ([60.2574, -34.0099, 36.2677], [60.4626, -34.1751, 39.4387], 1.2644),
        ([63.0109, -31.0961, -5.8663], [62.8187, -29.7946, -4.0864], 1.263),
        ([61.2901, 3.7196, -5.3901], [61.4292, 2.248, -4.962], 1.8731),
        ([35.0831, -44.1164, 3.7933], [35.0232, -40.0716, 1.5901], 1.8645),
        ([22.7233, 20.0904, -46.694], [23.0331, 14.973, -42.5619], 2.0373),
        ([36.4612, 47.858, 18.3852], [36.2715, 50.5065, 21.2231], 1.4146),
        ([90.8027, -2.0831, 1.441], [91.1528, -1.6435, 0.0447], 1.4441),
        ([90.9257, -0.5406, -0.9208], [88.6381, -0.8985, -0.7239], 1.5381),
        ([6.7747, -0.2908, -2.4247], [5.8714, -0.0985, -2.2286], 0.6377),
        ([2.0776, 0.0795, -1.135], [0.9033, -0.0636, -0.5514], 0.9082),
    ];

    #[test]
    fn published_pairs() {
        let lab = |[lightness, a, b]: [f64; 3]| Lab { lightness, a, b };
        for (a, b, expected) in PAIRS {
            for (a, b) in [(a, b), (b, a)] {
                let found = ciede2000(lab(a), lab(b));
                assert!((found - expected).abs() <= 0.5001e-4, "{a:?} {b:?}: {found} {expected}");
            }
        }
        let color = lab([40.0, 3.0, -7.0]);
        assert_eq!(ciede2000(color, color), 0.0);
    }
}
