//! Where the samples of a ray lie.

/// How far, in steps, a ray may exceed a whole number of steps without a further sample: rounding must not decide it.
const SLACK: f64 = 1e-4;

/// Midpoints of equal steps from the entry on; the last step is shortened (or, within the slack, stretched) to end at the exit.
///
/// Positions and lengths are in steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice {
    /// Length of the ray.
    pub length: f64,
    /// Number of samples, at least one.
    pub count: u64,
}

/// One sample of a ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LatticeSample {
    /// Distance from the entry in steps.
    pub position: f64,
    /// Length that the sample stands for, in steps.
    pub length: f64,
}

impl Lattice {
    /// The lattice on a ray of `voxels` voxels at `rate` samples per voxel.
    pub fn new(voxels: f64, rate: f64) -> Self {
        let length = voxels * rate;
        Self { length, count: ((length - SLACK).ceil() as u64).max(1) }
    }

    /// The samples from front to back; their lengths sum to the length of the ray.
    pub fn samples(self) -> impl Iterator<Item = LatticeSample> {
        let whole = self.count - 1;
        let last = LatticeSample { position: 0.5 * (whole as f64 + self.length), length: self.length - whole as f64 };
        (0..whole).map(|i| LatticeSample { position: i as f64 + 0.5, length: 1.0 }).chain(std::iter::once(last))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_sum_to_the_ray() {
        for length in [1e-9, 0.3, 1.0, 1.00001, 1.5, 7.0, 7.25, 1000.9] {
            let samples: Vec<_> = Lattice::new(length, 1.0).samples().collect();
            let sum: f64 = samples.iter().map(|s| s.length).sum();
            assert!((sum - length).abs() < 1e-12 * length.max(1.0));
            assert!(samples.windows(2).all(|w| w[0].position < w[1].position));
            assert!(samples.iter().all(|s| s.length > 0.0 && s.position > 0.0 && s.position < length));
        }
        assert_eq!(Lattice::new(4.0, 2.0).count, 8);
        assert_eq!(Lattice::new(4.00004, 1.0).count, 4);
        assert_eq!(Lattice::new(4.001, 1.0).count, 5);
    }
}
