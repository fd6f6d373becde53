//! Random numbers that are the same everywhere.

/// A linear congruential generator (Knuth's MMIX), its high bits.
pub struct Random(u64);

impl Random {
    /// A row of numbers of its own for every try of every seed.
    pub fn new(seed: u64, index: usize) -> Self {
        let mut random = Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ (index as u64) << 32);
        for _ in 0..8 {
            random.number(0.0, 1.0);
        }
        random
    }

    pub fn number(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 33) as f64 / (1u64 << 31) as f64)
    }

    pub fn of<'a, T>(&mut self, choices: &'a [T]) -> &'a T {
        &choices[(self.number(0.0, choices.len() as f64) as usize).min(choices.len() - 1)]
    }
}
