//! Polynomials on the unit interval in Bernstein form.
//!
//! Values lie between the smallest and the largest coefficient, products and sums of them round benignly, and a derivative
//! without a change of sign among its coefficients has no root: what makes "no root is missed" cheap to know.

/// The largest degree: three cubic kernels multiplied.
const MAX_DEGREE: usize = 9;

/// Binomial coefficients by degree.
const BINOMIALS: [[f64; MAX_DEGREE + 1]; MAX_DEGREE + 1] = {
    let mut rows = [[0.0; MAX_DEGREE + 1]; MAX_DEGREE + 1];
    let mut n = 0;
    while n <= MAX_DEGREE {
        rows[n][0] = 1.0;
        let mut k = 1;
        while k <= n {
            rows[n][k] = rows[n - 1][k - 1] + if k < n { rows[n - 1][k] } else { 0.0 };
            k += 1;
        }
        n += 1;
    }
    rows
};

/// A polynomial on `0..1`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bernstein {
    degree: usize,
    coefficients: [f64; MAX_DEGREE + 1],
}

/// A few ascending places in `0..1`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Places {
    count: usize,
    places: [f64; MAX_DEGREE + 2],
}

impl Places {
    fn starting_at(place: f64) -> Self {
        Self { count: 1, places: [place; MAX_DEGREE + 2] }
    }

    fn push(&mut self, place: f64) {
        self.places[self.count] = place;
        self.count += 1;
    }

    pub(super) fn as_slice(&self) -> &[f64] {
        &self.places[..self.count]
    }

    /// The intervals between the places.
    pub(super) fn intervals(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.as_slice().windows(2).map(|pair| (pair[0], pair[1]))
    }
}

impl Bernstein {
    /// The polynomial with these coefficients, one more than its degree and at most [`MAX_DEGREE`] more than one.
    pub(super) fn new(coefficients: &[f64]) -> Self {
        let mut polynomial = Self { degree: coefficients.len() - 1, coefficients: [0.0; MAX_DEGREE + 1] };
        polynomial.coefficients[..coefficients.len()].copy_from_slice(coefficients);
        polynomial
    }

    pub(super) fn constant(value: f64) -> Self {
        Self::new(&[value])
    }

    fn as_slice(&self) -> &[f64] {
        &self.coefficients[..=self.degree]
    }

    /// Whether the coefficients leave no room for change.
    pub(super) fn is_constant(&self) -> bool {
        self.as_slice().iter().all(|&c| c == self.coefficients[0])
    }

    /// Bounds of the values on `0..1`, not always reached.
    pub(super) fn bounds(&self) -> (f64, f64) {
        let fold = |f: fn(f64, f64) -> f64| self.as_slice().iter().copied().reduce(f).unwrap_or(0.0);
        (fold(f64::min), fold(f64::max))
    }

    /// Adds `factor` times a polynomial of the same degree.
    pub(super) fn add(&mut self, other: &Self, factor: f64) {
        self.degree = self.degree.max(other.degree);
        for (sum, c) in self.coefficients.iter_mut().zip(other.coefficients) {
            *sum += factor * c;
        }
    }

    /// The product with another polynomial; both degrees together are at most [`MAX_DEGREE`].
    pub(super) fn times(&self, other: &Self) -> Self {
        let degree = self.degree + other.degree;
        let mut product = Self { degree, coefficients: [0.0; MAX_DEGREE + 1] };
        for (i, a) in self.as_slice().iter().enumerate() {
            for (j, b) in other.as_slice().iter().enumerate() {
                let weight = BINOMIALS[self.degree][i] * BINOMIALS[other.degree][j] / BINOMIALS[degree][i + j];
                product.coefficients[i + j] += weight * a * b;
            }
        }
        product
    }

    pub(super) fn at(&self, u: f64) -> f64 {
        self.with_slope(u).0
    }

    /// Value and derivative, by de Casteljau's construction.
    fn with_slope(&self, u: f64) -> (f64, f64) {
        let mut c = self.coefficients;
        let mut slope = 0.0;
        for level in (1..=self.degree).rev() {
            if level == 1 {
                slope = self.degree as f64 * (c[1] - c[0]);
            }
            for i in 0..level {
                c[i] = (1.0 - u) * c[i] + u * c[i + 1];
            }
        }
        (c[0], slope)
    }

    /// The mean over `0..1`.
    pub(super) fn mean(&self) -> f64 {
        self.as_slice().iter().sum::<f64>() / (self.degree + 1) as f64
    }

    /// The derivative up to a positive factor: all that matters for its sign.
    fn differences(&self) -> Self {
        let mut differences = Self { degree: self.degree.saturating_sub(1), coefficients: [0.0; MAX_DEGREE + 1] };
        for i in 0..self.degree {
            differences.coefficients[i] = self.coefficients[i + 1] - self.coefficients[i];
        }
        differences
    }

    /// 0, the places where the polynomial turns, and 1: it is monotone in between.
    pub(super) fn monotone_places(&self) -> Places {
        let mut places = Places::starting_at(0.0);
        let derivative = self.differences();
        let (low, high) = derivative.bounds();
        if low < 0.0 && high > 0.0 {
            for (from, to) in derivative.monotone_places().intervals() {
                if let Some(root) = derivative.crossing(0.0, from, to)
                    && root > places.as_slice()[places.count - 1]
                    && root < 1.0
                {
                    places.push(root);
                }
            }
        }
        places.push(1.0);
        places
    }

    /// Where the polynomial, monotone from `from` to `to`, passes `value`; `None` if the ends are not on two sides of it.
    pub(super) fn crossing(&self, value: f64, from: f64, to: f64) -> Option<f64> {
        let (start, end) = (self.at(from) - value, self.at(to) - value);
        if (start < 0.0) == (end < 0.0) {
            return None;
        }
        let rising = end >= 0.0;
        let (mut low, mut high) = (from, to);
        // Newton's method, held in the bracket, from where the chord crosses.
        let chord = from + (to - from) * (start / (start - end));
        let mut u = if chord > from && chord < to { chord } else { 0.5 * (from + to) };
        for _ in 0..200 {
            let (at_u, slope) = self.with_slope(u);
            let excess = at_u - value;
            if excess == 0.0 {
                break;
            }
            if (excess > 0.0) == rising {
                high = u;
            } else {
                low = u;
            }
            let newton = u - excess / slope;
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - u).abs() <= f64::EPSILON * 0.25 {
                return Some(next);
            }
            u = next;
        }
        Some(u)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The polynomial `Σ p_k u^k`.
    fn from_powers(powers: &[f64]) -> Bernstein {
        let n = powers.len() - 1;
        let coefficient = |i: usize| (0..=i).map(|k| BINOMIALS[i][k] / BINOMIALS[n][k] * powers[k]).sum::<f64>();
        Bernstein::new(&(0..=n).map(coefficient).collect::<Vec<_>>())
    }

    fn product(roots: &[f64]) -> Bernstein {
        roots.iter().fold(Bernstein::constant(1.0), |p, &r| p.times(&Bernstein::new(&[-r, 1.0 - r])))
    }

    /// All places where `p` changes its side of `value`.
    fn crossings(p: &Bernstein, value: f64) -> Vec<f64> {
        p.monotone_places().intervals().filter_map(|(a, b)| p.crossing(value, a, b)).collect()
    }

    #[test]
    fn arithmetic() {
        let p = from_powers(&[1.0, -3.0, 0.5, 2.0]);
        let q = from_powers(&[-2.0, 1.0, 4.0]);
        for u in [0.0, 0.3, 0.77, 1.0] {
            let (pu, qu) = (1.0 - 3.0 * u + 0.5 * u * u + 2.0 * u * u * u, -2.0 + u + 4.0 * u * u);
            assert!((p.at(u) - pu).abs() < 1e-15 && (p.times(&q).at(u) - pu * qu).abs() < 1e-14);
            assert!((p.with_slope(u).1 - (-3.0 + u + 6.0 * u * u)).abs() < 1e-14);
        }
        assert!((p.mean() - (1.0 - 1.5 + 0.5 / 3.0 + 0.5)).abs() < 1e-15);
        let mut sum = p;
        sum.add(&p, -2.0);
        assert_eq!(sum.at(0.4), -p.at(0.4));
    }

    #[test]
    fn every_root_of_a_product_is_found() {
        for roots in
            [vec![0.5], vec![0.1, 0.100001, 0.9], vec![0.2, 0.4, 0.6], (1..10).map(|i| f64::from(i) / 10.0).collect()]
        {
            let found = crossings(&product(&roots), 0.0);
            assert_eq!(found.len(), roots.len(), "{roots:?} {found:?}");
            assert!(found.iter().zip(&roots).all(|(a, b)| (a - b).abs() < 1e-9), "{roots:?} {found:?}");
        }
        assert!(crossings(&product(&[-0.5, 1.5]), 0.0).is_empty());
        assert!(crossings(&Bernstein::constant(1.0), 1.0).is_empty());
    }

    #[test]
    fn close_pairs_of_roots_are_not_missed() {
        // (u - r)² - h²: a chord of 2 h.
        for h in [1e-2, 1e-4, 1e-6] {
            for r in [0.3, 0.5, 0.712_345] {
                let found = crossings(&product(&[r, r]), h * h);
                assert_eq!(found.len(), 2);
                assert!((found[0] - (r - h)).abs() < 1e-9 && (found[1] - (r + h)).abs() < 1e-9);
            }
        }
        // A double root is a turning point, and no crossing.
        let square = from_powers(&[0.25, -1.0, 1.0]);
        assert_eq!(square.monotone_places().as_slice(), [0.0, 0.5, 1.0]);
        // A threefold root.
        let found = crossings(&product(&[0.4, 0.4, 0.4]), 0.0);
        assert!(found.len() == 1 && (found[0] - 0.4).abs() < 1e-4);
    }
}
