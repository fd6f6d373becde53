//! Where the samples of a ray lie.

/// How far, in steps, a ray may exceed a whole number of steps without a further sample: rounding must not decide it.
const SLACK: f64 = 1e-4;

/// Midpoints of equal steps from the entry on; the last step is shortened (or, within the slack, stretched) to end at the exit.
/// A shift moves the steps towards the entry, so that the first is shortened, too.
///
/// Positions and lengths are in steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice {
    /// Length of the ray.
    pub length: f64,
    /// Share of a step by which the steps are moved towards the entry, at least 0 and less than 1.
    pub shift: f64,
    /// Number of samples, at least one.
    pub count: u64,
}

/// The shift of the lattice of a pixel: 24 bits of the integer hash PCG3D (Jarzynski and Olano, Hash Functions for GPU
/// Rendering, 2020) of its place and the seed, the same as on the device.
pub fn jitter(x: u32, y: u32, seed: u32) -> f64 {
    let mut v = [x, y, seed].map(|word| word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    let mix =
        |v: &mut [u32; 3], into: usize, a: usize, b: usize| v[into] = v[into].wrapping_add(v[a].wrapping_mul(v[b]));
    mix(&mut v, 0, 1, 2);
    mix(&mut v, 1, 2, 0);
    mix(&mut v, 2, 0, 1);
    v = v.map(|word| word ^ (word >> 16));
    mix(&mut v, 0, 1, 2);
    f64::from(v[0] >> 8) / f64::from(1 << 24)
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
    pub fn new(voxels: f64, rate: f64, shift: f64) -> Self {
        let length = voxels * rate;
        Self { length, shift, count: ((length + shift - SLACK).ceil() as u64).max(1) }
    }

    /// The samples from front to back; their lengths sum to the length of the ray.
    pub fn samples(self) -> impl Iterator<Item = LatticeSample> {
        let Self { length, shift, count } = self;
        let end = move |i: u64| if i + 1 == count { length } else { (i + 1) as f64 - shift };
        (0..count).map(move |i| {
            let (start, end) = (if i == 0 { 0.0 } else { i as f64 - shift }, end(i));
            LatticeSample { position: 0.5 * (start + end), length: end - start }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_sum_to_the_ray() {
        let lengths = [1e-9, 0.3, 1.0, 1.00001, 1.5, 7.0, 7.25, 1000.9];
        for (length, shift) in lengths.into_iter().flat_map(|length| [0.0, 0.3, 0.999].map(|shift| (length, shift))) {
            let samples: Vec<_> = Lattice::new(length, 1.0, shift).samples().collect();
            let sum: f64 = samples.iter().map(|s| s.length).sum();
            assert!((sum - length).abs() < 1e-12 * length.max(1.0));
            assert!(samples.windows(2).all(|w| w[0].position < w[1].position));
            assert!(samples.iter().all(|s| s.length > 0.0 && s.position > 0.0 && s.position < length));
        }
        assert_eq!(Lattice::new(4.0, 2.0, 0.0).count, 8);
        assert_eq!(Lattice::new(4.00004, 1.0, 0.0).count, 4);
        assert_eq!(Lattice::new(4.001, 1.0, 0.0).count, 5);
    }
}
