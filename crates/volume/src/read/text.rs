//! What the text headers have in common.

use std::io::Read;

use glam::DVec3;

use super::error::{Blame, ReadError};
use super::layout::dimension;

/// Text headers are short; what is longer is no header.
const LONGEST_HEADER: u64 = 1 << 20;

/// The first bytes of a file, as many as a text header may have.
pub(super) fn head(blame: Blame<'_>) -> Result<Vec<u8>, ReadError> {
    let mut bytes = Vec::new();
    let file = rayloom_files::open(blame.file).map_err(blame.io("open it"))?;
    file.take(LONGEST_HEADER).read_to_end(&mut bytes).map_err(blame.io("read its header"))?;
    Ok(bytes)
}

/// One line, and where the next begins. At the end of the bytes there is none.
pub(super) fn line(bytes: &[u8], from: usize) -> Option<(&str, usize)> {
    let rest = bytes.get(from..).filter(|rest| !rest.is_empty())?;
    let length = rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len());
    // What is not text cannot be a known field; an empty line would be taken for the end of a header.
    let text = std::str::from_utf8(&rest[..length]).unwrap_or("?");
    Some((text.trim_end_matches('\r'), from + (length + 1).min(rest.len())))
}

/// The fields of a header in the order of the file, with lower-case keys.
#[derive(Default)]
pub(super) struct Fields(Vec<(String, String)>);

impl Fields {
    pub fn push(&mut self, key: &str, value: &str) {
        self.0.push((key.trim().to_lowercase(), value.trim().to_owned()));
    }

    /// The value of the first of these keys that is there, with that key.
    pub fn find<'a>(&'a self, keys: &[&'a str]) -> Option<(&'a str, &'a str)> {
        keys.iter().find_map(|wanted| {
            self.0.iter().find(|(key, _)| key == wanted).map(|(key, value)| (key.as_str(), value.as_str()))
        })
    }

    pub fn get(&self, key: &str) -> Option<&str> {
        self.0.iter().find(|(k, _)| k == key).map(|(_, value)| value.as_str())
    }

    pub fn require(&self, blame: Blame<'_>, key: &str, expected: &str) -> Result<&str, ReadError> {
        self.get(key).ok_or_else(|| blame.header(format!("`{key}`"), "", expected))
    }
}

/// Numbers separated by white space.
pub(super) fn numbers(blame: Blame<'_>, key: &str, text: &str) -> Result<Vec<f64>, ReadError> {
    text.split_whitespace().map(|word| number(blame, key, word)).collect()
}

/// One finite number.
pub(super) fn number(blame: Blame<'_>, key: &str, word: &str) -> Result<f64, ReadError> {
    let parsed = word.trim().parse().ok().filter(|n: &f64| n.is_finite());
    parsed.ok_or_else(|| blame.header(format!("`{key}`"), word, "a finite number"))
}

/// One whole number.
pub(super) fn integer<T: std::str::FromStr>(blame: Blame<'_>, key: &str, word: &str) -> Result<T, ReadError> {
    word.trim().parse().map_err(|_| blame.header(format!("`{key}`"), word, "a whole number"))
}

/// Numbers of voxels, each at least one.
pub(super) fn dimensions(blame: Blame<'_>, key: &str, text: &str) -> Result<Vec<u32>, ReadError> {
    text.split_whitespace().map(|word| dimension(blame, &format!("`{key}`"), integer(blame, key, word)?)).collect()
}

/// Three finite numbers.
pub(super) fn vector(blame: Blame<'_>, key: &str, text: &str) -> Result<DVec3, ReadError> {
    let found = numbers(blame, key, text)?;
    let three: [f64; 3] = found.try_into().map_err(|_| blame.header(format!("`{key}`"), text, "three numbers"))?;
    Ok(DVec3::from_array(three))
}

/// Yes or no.
pub(super) fn truth(blame: Blame<'_>, key: &str, text: &str) -> Result<bool, ReadError> {
    match text.to_lowercase().as_str() {
        "true" | "t" | "yes" | "1" => Ok(true),
        "false" | "f" | "no" | "0" => Ok(false),
        _ => Err(blame.header(format!("`{key}`"), text, "True or False")),
    }
}
