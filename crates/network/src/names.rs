//! Ids, addresses (`processor.port`, `processor.property`) and the closest names for a mistyped one.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

/// Longest id that is accepted, in bytes.
const MAX_ID_LENGTH: usize = 64;

/// Whether `id` can name a processor or a port: 1 to 64 ASCII letters, digits, `_` or `-`.
pub fn is_valid_id(id: &str) -> bool {
    (1..=MAX_ID_LENGTH).contains(&id.len()) && id.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_' || b == b'-')
}

/// Whether `id` can name a property: dot-separated ids, so that parameters of a snippet may be grouped (`shading.ambient`).
pub(crate) fn is_valid_property_id(id: &str) -> bool {
    id.len() <= MAX_ID_LENGTH && id.split('.').all(is_valid_id)
}

/// A port or property of a processor, written `processor.item`. The processor's id has no dot; the item may have some.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Address {
    /// Id of the processor.
    pub processor: String,
    /// Id of its port or property.
    pub item: String,
}

impl Address {
    /// The address `processor.item`; nothing is checked.
    pub fn new(processor: impl Into<String>, item: impl Into<String>) -> Self {
        Self { processor: processor.into(), item: item.into() }
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.processor, self.item)
    }
}

impl<P: Into<String>, I: Into<String>> From<(P, I)> for Address {
    fn from((processor, item): (P, I)) -> Self {
        Self::new(processor, item)
    }
}

impl From<&Address> for Address {
    fn from(address: &Address) -> Self {
        address.clone()
    }
}

/// A text that is not an [`Address`].
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("`{0}` is not an address; write `processor.item`, each of letters, digits, `_` or `-`")]
pub struct AddressError(pub String);

impl FromStr for Address {
    type Err = AddressError;

    fn from_str(text: &str) -> Result<Self, AddressError> {
        match text.split_once('.') {
            Some((processor, item)) if is_valid_id(processor) && is_valid_property_id(item) => {
                Ok(Self::new(processor, item))
            }
            _ => Err(AddressError(text.to_owned())),
        }
    }
}

/// The up to three candidates most like `name`, best first; empty when none is close.
pub fn closest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let name = name.to_lowercase();
    let limit = (name.chars().count() / 2).max(2);
    let mut ranked: Vec<(usize, &str)> = candidates
        .into_iter()
        .filter_map(|candidate| {
            let lower = candidate.to_lowercase();
            let part = name.len() >= 3 && (lower.contains(&name) || name.contains(&lower));
            let distance = if part { 1 } else { edit_distance(&name, &lower) };
            (distance <= limit).then_some((distance, candidate))
        })
        .collect();
    ranked.sort();
    ranked.dedup();
    ranked.into_iter().take(3).map(|(_, candidate)| candidate).collect()
}

/// Levenshtein distance in characters.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, ca) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, cb) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(ca != *cb);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

/// " Did you mean `a` or `b`?", else " There are: `x`, `y`.", else that there are none: the end of an error about a name.
pub(crate) fn hint<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> String {
    /// More names than this are not listed.
    const LISTED: usize = 12;
    let candidates: Vec<&str> = candidates.into_iter().collect();
    let near = closest(name, candidates.iter().copied());
    if !near.is_empty() {
        return format!(" Did you mean {}?", quoted(&near, " or "));
    }
    match candidates.len() {
        0 => " There are none.".to_owned(),
        n if n <= LISTED => format!(" There are: {}.", quoted(&candidates, ", ")),
        n => format!(" There are {n}, beginning with {}.", quoted(&candidates[..LISTED], ", ")),
    }
}

/// The names in backticks, joined.
pub(crate) fn quoted<S: AsRef<str>>(names: &[S], separator: &str) -> String {
    names.iter().map(|name| format!("`{}`", name.as_ref())).collect::<Vec<_>>().join(separator)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn closest_names_are_found_and_strangers_left_out() {
        let names = ["camera", "canvas", "isovalue", "step"];
        assert_eq!(closest("camrea", names), ["camera"]);
        assert_eq!(closest("iso", names), ["isovalue"]);
        assert!(closest("transfer_function", names).is_empty());
    }

    #[test]
    fn addresses_split_at_the_first_dot() {
        assert_eq!("a.shading.ambient".parse(), Ok(Address::new("a", "shading.ambient")));
        for bad in ["", "a", "a.", ".b", "a b.c", "a..b", "ä.b"] {
            assert!(bad.parse::<Address>().is_err(), "{bad}");
        }
    }
}
