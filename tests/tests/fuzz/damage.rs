//! Random numbers and random damage, the same for the same seed.

/// What readers of numbers, JSON, headers and WGSL stumble over.
const TOKENS: [&str; 40] = [
    "0",
    "-1",
    "1e308",
    "-1e-320",
    "1e999",
    "NaN",
    "inf",
    "4294967296",
    "9223372036854775808",
    "2147483647",
    "65536",
    "256",
    "{",
    "}",
    "[",
    "]",
    "\"",
    "\\",
    "\\u0000",
    "null",
    "true",
    ":",
    ",",
    "\n",
    "\0",
    "\u{feff}",
    "ö",
    "../",
    "/",
    ".",
    "(",
    ")",
    "<",
    ">",
    "@",
    "array<f32, 9>",
    "loop {",
    "vec4f(",
    "// ",
    "/*",
];

/// Random numbers (xorshift64*).
pub struct Random(u64);

impl Random {
    /// All that follows from a number.
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    /// A number below `end`; 0 if that is 0.
    pub fn below(&mut self, end: usize) -> usize {
        (self.next() >> 11) as usize % end.max(1)
    }

    /// A copy with one to six changes; `other` is what parts may be taken from.
    pub fn damaged(&mut self, bytes: &[u8], other: &[u8]) -> Vec<u8> {
        let mut bytes = bytes.to_vec();
        for _ in 0..=self.below(6) {
            self.change(&mut bytes, other);
        }
        bytes
    }

    fn change(&mut self, bytes: &mut Vec<u8>, other: &[u8]) {
        let at = self.below(bytes.len() + 1);
        let end = (at + self.length()).min(bytes.len());
        match self.below(8) {
            0 | 1 if at < bytes.len() => bytes[at] ^= 1 << self.below(8),
            2 => drop(bytes.drain(at..end)),
            3 => {
                let part = bytes[at..end].to_vec();
                let to = self.below(bytes.len() + 1);
                drop(bytes.splice(to..to, part));
            }
            4 => {
                let from = self.below(other.len() + 1);
                let part = other[from..(from + self.length()).min(other.len())].to_vec();
                drop(bytes.splice(at..end, part));
            }
            5 => drop(bytes.splice(at..at, TOKENS[self.below(TOKENS.len())].bytes())),
            6 => self.change_number(bytes, at),
            _ if self.below(4) == 0 => bytes.truncate(at),
            _ if at < bytes.len() => bytes[at] = self.next() as u8,
            _ => {}
        }
    }

    /// Puts a token in place of the next number in a text.
    fn change_number(&mut self, bytes: &mut Vec<u8>, from: usize) {
        let Some(start) = (from..bytes.len()).find(|at| bytes[*at].is_ascii_digit()) else { return };
        let end = (start..bytes.len()).find(|at| !bytes[*at].is_ascii_digit()).unwrap_or(bytes.len());
        drop(bytes.splice(start..end, TOKENS[self.below(12)].bytes()));
    }

    /// A length that is mostly short.
    fn length(&mut self) -> usize {
        let most = 1 << self.below(9);
        1 + self.below(most)
    }
}
