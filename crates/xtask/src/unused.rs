//! Whether every dependency that a crate names is used in its code: what cargo-machete looks for, without installing it.

use std::path::{Path, PathBuf};

use crate::command::root;

/// Checks all crates of the project.
///
/// # Errors
/// A dependency is not named anywhere in the crate's code, or a file cannot be read.
pub fn check() -> Result<(), String> {
    let mut crates = children(&root().join("crates"))?;
    crates.push(root().join("tests"));
    let mut unused = Vec::new();
    for folder in crates.iter().filter(|folder| folder.join("Cargo.toml").exists()) {
        let code = code(folder)?;
        let found = dependencies(&read(&folder.join("Cargo.toml"))?).into_iter().filter(|name| !names(&code, name));
        unused.extend(found.map(|name| format!("{name} of {}", folder.display())));
    }
    if unused.is_empty() { Ok(()) } else { Err(format!("dependencies that nothing uses: {}", unused.join(", "))) }
}

/// The names of all dependencies of a manifest, as code writes them.
fn dependencies(manifest: &str) -> Vec<String> {
    let mut inside = false;
    let mut names = Vec::new();
    for line in manifest.lines().map(str::trim) {
        if line.starts_with('[') {
            inside = line.ends_with("dependencies]");
        } else if inside && !line.starts_with('#') && line.contains('=') {
            let end = line.find(['.', '=', ' ']).unwrap_or(line.len());
            names.push(line[..end].replace('-', "_"));
        }
    }
    names
}

/// Whether code has a name as a word of its own.
fn names(code: &str, name: &str) -> bool {
    let part = |c: char| c.is_alphanumeric() || c == '_';
    code.match_indices(name).any(|(at, _)| {
        !code[..at].chars().next_back().is_some_and(part) && !code[at + name.len()..].chars().next().is_some_and(part)
    })
}

/// The code below a folder, without lines that are comments, and what lies beside a file that it takes from elsewhere
/// (`#[path = "..."]`).
fn code(folder: &Path) -> Result<String, String> {
    let mut text = String::new();
    for path in children(folder)? {
        if path.is_dir() {
            text += &code(&path)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let lines = read(&path)?;
            let elsewhere =
                lines.lines().filter_map(|line| line.trim().strip_prefix("#[path = \"")?.strip_suffix("\"]"));
            for folder in elsewhere.filter_map(|name| folder.join(name).parent().map(Path::to_owned)) {
                text += &code(&folder)?;
            }
            text.extend(
                lines.lines().filter(|line| !line.trim_start().starts_with("//")).flat_map(|line| [line, "\n"]),
            );
        }
    }
    Ok(text)
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

fn children(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let entries = std::fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    Ok(entries.flatten().map(|entry| entry.path()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dependencies_are_found_and_looked_for_as_words() {
        let manifest = "[package]\nname = \"x\"\n[dependencies]\nsome-crate.workspace = true\n# no = 1\nother = \"1\"\n[[bench]]\nname = \"y\"\n[dev-dependencies]\nthird = { version = \"2\" }\n";
        assert_eq!(dependencies(manifest), ["some_crate", "other", "third"]);
        assert!(names("use some_crate::x;", "some_crate"));
        assert!(!names("use awesome_crate::some_crates;", "some_crate"));
    }
}
