//! Where the samples of a ray lie.

/// How far, in steps, a ray may exceed a whole number of steps without a further sample: rounding must not decide it.
const SLACK: f64 = 1e-4;

/// Middles of equal steps from the anchor on, of which an interval is visible. The interval shortens (or, within the slack,
/// stretches) the first and the last of its steps and moves no other. A shift moves all steps towards the anchor.
///
/// All lengths are of one unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice {
    /// Length of a step.
    pub step: f64,
    /// Share of a step by which the steps are moved towards the anchor, at least 0 and less than 1.
    pub shift: f64,
    /// Distance of the entry from the anchor.
    pub from: f64,
    /// Distance of the exit from the anchor.
    pub to: f64,
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
    /// Distance from the anchor.
    pub position: f64,
    /// Length that the sample stands for.
    pub length: f64,
}

impl Lattice {
    /// The numbers of the steps that are visible, counted from the anchor; at least one.
    pub fn steps(self) -> std::ops::Range<i64> {
        let Self { step, shift, from, to } = self;
        let first = (from / step + shift + SLACK).floor() as i64;
        let end = (to / step + shift - SLACK).ceil() as i64;
        first..end.max(first + 1)
    }

    /// Where the visible steps begin and end, from front to back.
    pub fn segments(self) -> impl Iterator<Item = [f64; 2]> {
        let Self { step, shift, from, to } = self;
        let steps = self.steps();
        let (first, end) = (steps.start, steps.end);
        let start = move |i: i64| if i == first { from } else { (i as f64 - shift) * step };
        steps.map(move |i| [start(i), if i + 1 == end { to } else { start(i + 1) }])
    }

    /// The samples from front to back; their lengths sum to the length of the interval.
    pub fn samples(self) -> impl Iterator<Item = LatticeSample> {
        self.segments().map(|[start, end]| LatticeSample { position: 0.5 * (start + end), length: end - start })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_sum_to_the_interval() {
        let lengths = [1e-9, 0.3, 1.0, 1.00001, 1.5, 7.0, 7.25, 1000.9];
        let shifts = [0.0, 0.3, 0.999];
        let froms = [0.0, 0.00003, 0.4, 3.0, 5.99995];
        for (length, shift, from) in
            lengths.into_iter().flat_map(|l| shifts.into_iter().flat_map(move |s| froms.map(|f| (l, s, f))))
        {
            for step in [1.0, 0.37] {
                let lattice = Lattice { step, shift, from: from * step, to: (from + length) * step };
                let samples: Vec<_> = lattice.samples().collect();
                let sum: f64 = samples.iter().map(|s| s.length).sum();
                assert!((sum - step * length).abs() < 1e-12 * length.max(1.0));
                assert!(samples.windows(2).all(|w| w[0].position < w[1].position));
                assert!(samples.iter().all(|s| s.length > 0.0 && s.length < 1.0002 * step), "{lattice:?} {samples:?}");
                assert!(samples.iter().all(|s| s.position > lattice.from && s.position < lattice.to));
            }
        }
        let count = |from, to, step| Lattice { step, shift: 0.0, from, to }.steps().count();
        assert_eq!(count(0.0, 4.0, 0.5), 8);
        assert_eq!(count(0.0, 4.00004, 1.0), 4);
        assert_eq!(count(0.0, 4.001, 1.0), 5);
        assert_eq!(count(0.99995, 4.0, 1.0), 3);
        assert_eq!(count(0.999, 4.0, 1.0), 4);
    }

    #[test]
    fn intervals_move_no_sample_of_a_whole_step() {
        for shift in [0.0, 0.61] {
            let whole = Lattice { step: 0.3, shift, from: 0.0, to: 7.0 };
            let cut = Lattice { from: 1.234, to: 5.432, ..whole };
            let [all, some] = [whole, cut].map(|lattice| lattice.samples().collect::<Vec<_>>());
            let first = cut.steps().start - whole.steps().start;
            let (ends, inner) = ([some[0], some[some.len() - 1]], &some[1..some.len() - 1]);
            assert_eq!(inner, &all[first as usize + 1..][..inner.len()]);
            assert!(inner.len() > 10 && ends.iter().all(|end| end.length < 0.3));
        }
    }
}
