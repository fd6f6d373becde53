//! What the errors of some views say about those of others.

/// The error to reckon with is at least this many times the worst that was seen.
const LEAST: f64 = 1.1;
/// And at most this many times: errors of views spread evenly around a scene do not differ without bounds.
const MOST: f64 = 2.0;
/// Views with less than this share of the worst error show next to nothing, and must not widen the spread.
const NOTHING: f64 = 0.05;

/// The error that a further view exceeds with a chance of about one in a hundred: the one-sided prediction limit of a normal
/// distribution, on a logarithmic scale, since the errors of views differ by factors. Held between [`LEAST`] and [`MOST`] times
/// the worst of the errors.
pub(super) fn limit(errors: &[f64]) -> f64 {
    let worst = errors.iter().copied().fold(0.0, f64::max);
    if worst <= 0.0 || !worst.is_finite() || errors.len() < 2 {
        return MOST * worst;
    }
    let logarithms: Vec<f64> = errors.iter().map(|error| error.max(NOTHING * worst).ln()).collect();
    let count = logarithms.len() as f64;
    let mean = logarithms.iter().sum::<f64>() / count;
    let variance = logarithms.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (count - 1.0);
    let reach = student_99(count - 1.0) * (variance * (1.0 + 1.0 / count)).sqrt();
    (mean + reach).exp().clamp(LEAST * worst, MOST * worst)
}

/// The value that Student's t with so many degrees of freedom stays below in 99 of 100 cases (Abramowitz and Stegun 26.7.5).
fn student_99(freedom: f64) -> f64 {
    const NORMAL: f64 = 2.326_347_874;
    let z = NORMAL;
    let first = (z.powi(3) + z) / 4.0;
    let second = (5.0 * z.powi(5) + 16.0 * z.powi(3) + 3.0 * z) / 96.0;
    let third = (3.0 * z.powi(7) + 19.0 * z.powi(5) + 17.0 * z.powi(3) - 15.0 * z) / 384.0;
    z + first / freedom + second / freedom.powi(2) + third / freedom.powi(3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_tables() {
        for (freedom, expected) in [(4.0, 3.747), (5.0, 3.365), (7.0, 2.998), (12.0, 2.681), (30.0, 2.457)] {
            assert!((student_99(freedom) - expected).abs() < 0.03, "{freedom}: {}", student_99(freedom));
        }
    }

    #[test]
    fn wider_spreads_and_fewer_views_ask_for_more_room() {
        let even = limit(&[0.9e-3, 1e-3, 1.1e-3, 1e-3]);
        let wide = limit(&[0.5e-3, 1e-3, 0.7e-3, 1.1e-3]);
        assert!(even >= 1.1 * 1.1e-3 && even < wide && wide <= 2.0 * 1.1e-3, "{even} {wide}");
        let more = limit(&[0.9e-3, 1e-3, 1.1e-3, 1e-3, 0.95e-3, 1.05e-3, 1e-3, 1e-3]);
        assert!(more < even, "{more} {even}");
        assert_eq!(limit(&[0.0; 3]), 0.0);
        assert_eq!(limit(&[1.0]), 2.0);
    }
}
