//! Gauss-Lobatto collocation: an integral, and its course at the nodes.

use std::f64::consts::PI;
use std::sync::LazyLock;

/// Number of nodes, both ends among them; the integral over the interval is exact for polynomials of degree `2 NODES - 3`.
pub(super) const NODES: usize = 9;

/// The rule on `0..1`.
pub(super) static LOBATTO: LazyLock<Lobatto> = LazyLock::new(Lobatto::new);

/// Nodes, weights and partial integrals on `0..1`.
///
/// The ends are nodes, so that a bend of the integrand close to an end does not hide beyond the last node.
#[derive(Debug)]
pub(super) struct Lobatto {
    pub(super) nodes: [f64; NODES],
    pub(super) weights: [f64; NODES],
    /// Row `i`: weights of the integral from 0 to node `i`.
    pub(super) partial: [[f64; NODES]; NODES],
}

impl Lobatto {
    /// Nodes are the ends and the roots of `P'`, weights `2 / (n (n-1) P²)` with `P` the Legendre polynomial of degree `n - 1`;
    /// partial integrals follow from the expansion of the interpolating polynomial in Legendre polynomials.
    fn new() -> Self {
        let n = NODES as f64;
        let nodes: [f64; NODES] = std::array::from_fn(node);
        let degree = NODES - 1;
        let weights = nodes.map(|x| 2.0 / (n * (n - 1.0) * legendre(x)[degree].powi(2)));
        let mut partial = [[0.0; NODES]; NODES];
        for (row, &x) in partial.iter_mut().zip(&nodes) {
            let integrals = legendre_integrals(x);
            for ((entry, &at), weight) in row.iter_mut().zip(&nodes).zip(weights) {
                let values = legendre(at);
                let term = |k: usize| {
                    let norm = if k == degree { 2.0 / (n - 1.0) } else { 2.0 / (2 * k + 1) as f64 };
                    values[k] / norm * integrals[k]
                };
                *entry = 0.5 * weight * (0..NODES).map(term).sum::<f64>();
            }
        }
        Self { nodes: nodes.map(|x| 0.5 + 0.5 * x), weights: weights.map(|w| 0.5 * w), partial }
    }
}

/// Node `i` on `-1..1`: the roots of `P'` by Newton's method from Chebyshev's nodes.
fn node(i: usize) -> f64 {
    let degree = NODES - 1;
    let mut x = -(PI * i as f64 / degree as f64).cos();
    if i == 0 || i == degree {
        return x.signum();
    }
    let n = degree as f64;
    for _ in 0..50 {
        let p = legendre(x);
        // (1 - x²) P' = n (P_{n-1} - x P_n) and (1 - x²) P'' = 2 x P' - n (n+1) P.
        let slope = n * (p[degree - 1] - x * p[degree]) / (1.0 - x * x);
        let bend = (2.0 * x * slope - n * (n + 1.0) * p[degree]) / (1.0 - x * x);
        x -= slope / bend;
    }
    x
}

/// Legendre polynomials of degree `0 ..= NODES` at `x`.
fn legendre(x: f64) -> [f64; NODES + 1] {
    let mut p = [1.0; NODES + 1];
    p[1] = x;
    for k in 1..NODES {
        let n = k as f64;
        p[k + 1] = ((2.0 * n + 1.0) * x * p[k] - n * p[k - 1]) / (n + 1.0);
    }
    p
}

/// `∫ P_k` from -1 to `x`.
fn legendre_integrals(x: f64) -> [f64; NODES] {
    let p = legendre(x);
    std::array::from_fn(|k| if k == 0 { x + 1.0 } else { (p[k + 1] - p[k - 1]) / (2 * k + 1) as f64 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_integrated_exactly() {
        let rule = &*LOBATTO;
        for power in 0..2 * NODES as i32 - 2 {
            let whole: f64 = rule.nodes.iter().zip(rule.weights).map(|(x, w)| w * x.powi(power)).sum();
            assert!((whole - 1.0 / f64::from(power + 1)).abs() < 1e-15, "{power}");
            if power < NODES as i32 {
                for (x, row) in rule.nodes.iter().zip(rule.partial) {
                    let part: f64 = rule.nodes.iter().zip(row).map(|(x, w)| w * x.powi(power)).sum();
                    assert!((part - x.powi(power + 1) / f64::from(power + 1)).abs() < 1e-15, "{power} {x}");
                }
            }
        }
    }
}
