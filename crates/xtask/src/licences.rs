//! Whether the licences of all dependencies are among those that `deny.toml` allows.
//!
//! Compiling cargo-deny takes longer than all other checks together, so that this much of it is done here. The words of licences
//! are those of SPDX expressions: `OR`, `AND`, parentheses, and `/` in old crates.

use std::collections::BTreeSet;

use crate::command::{cargo, root};

/// Checks all dependencies on all platforms, or those of this platform where the others have not been fetched.
///
/// # Errors
/// A dependency has a licence that is not allowed, or none.
pub fn check() -> Result<(), String> {
    let path = root().join("deny.toml");
    let rules = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let allowed = allowed(&rules);
    let tree = tree(&["--target", "all"]).or_else(|_| tree(&[]))?;
    let refused: BTreeSet<&str> = tree.lines().filter(|line| !is_fine(line, &allowed)).collect();
    match refused.is_empty() {
        true => Ok(()),
        false => Err(format!(
            "licences that deny.toml does not allow: {}",
            refused.into_iter().collect::<Vec<_>>().join(", ").replace('\t', " under ")
        )),
    }
}

/// A line for every dependency: name and version, a tab, licence.
fn tree(more: &[&str]) -> Result<String, String> {
    let mut command = cargo(&["tree", "--workspace", "--offline", "--locked", "--prefix", "none", "--no-dedupe"]);
    let output = command.args(["--format", "{p}\t{l}"]).args(more).output();
    let output = output.map_err(|error| format!("cargo tree cannot be started: {error}"))?;
    match output.status.success() {
        true => Ok(String::from_utf8_lossy(&output.stdout).into_owned()),
        false => Err(String::from_utf8_lossy(&output.stderr).into_owned()),
    }
}

fn is_fine(line: &str, allowed: &[&str]) -> bool {
    line.trim().is_empty() || line.split_once('\t').is_some_and(|(_, licence)| permits(licence, allowed))
}

/// The texts in the list `allow` of the licences.
fn allowed(rules: &str) -> Vec<&str> {
    let list = rules.split_once("[licenses]").and_then(|(_, rest)| rest.split_once("allow = ["));
    let list = list.and_then(|(_, rest)| rest.split_once(']')).map_or("", |(list, _)| list);
    list.split('"').skip(1).step_by(2).collect()
}

/// Whether an expression can be met with allowed licences alone.
fn permits(expression: &str, allowed: &[&str]) -> bool {
    let spaced = expression.replace('(', " ( ").replace(')', " ) ").replace('/', " OR ");
    let words: Vec<&str> = spaced.split_whitespace().collect();
    let mut reader = Reader { words: &words, allowed };
    reader.any() == Some(true) && reader.words.is_empty()
}

struct Reader<'a> {
    words: &'a [&'a str],
    allowed: &'a [&'a str],
}

impl<'a> Reader<'a> {
    fn next_is(&mut self, word: &str) -> bool {
        let is = self.words.first() == Some(&word);
        self.words = &self.words[usize::from(is)..];
        is
    }

    fn any(&mut self) -> Option<bool> {
        let mut fine = self.all()?;
        while self.next_is("OR") {
            fine |= self.all()?;
        }
        Some(fine)
    }

    fn all(&mut self) -> Option<bool> {
        let mut fine = self.one()?;
        while self.next_is("AND") {
            fine &= self.one()?;
        }
        Some(fine)
    }

    fn one(&mut self) -> Option<bool> {
        if self.next_is("(") {
            let fine = self.any()?;
            return self.next_is(")").then_some(fine);
        }
        let (name, rest) = self.words.split_first()?;
        self.words = rest;
        let mut name = (*name).to_owned();
        if self.next_is("WITH") {
            let (exception, rest) = self.words.split_first()?;
            self.words = rest;
            name += &format!(" WITH {exception}");
        }
        Some(self.allowed.contains(&name.as_str()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_are_met_by_allowed_licences_alone() {
        let allowed = allowed("[licenses]\nallow = [\n \"MIT\",\n \"A WITH e\",\n]\n[bans]\nallow = [\"GPL\"]");
        assert_eq!(allowed, ["MIT", "A WITH e"]);
        for fine in ["MIT", "GPL OR MIT", "GPL/MIT", "(GPL OR MIT) AND MIT", "A WITH e", "GPL AND GPL OR MIT"] {
            assert!(permits(fine, &allowed), "{fine}");
        }
        for refused in
            ["", "GPL", "GPL AND MIT", "(MIT OR GPL) AND GPL", "A", "MIT WITH e", "(MIT", "MIT MIT", "OR MIT"]
        {
            assert!(!permits(refused, &allowed), "{refused}");
        }
    }
}
