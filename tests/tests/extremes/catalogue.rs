//! docs/EXTREMES.md says for each of E1 to E70 what happens here, and where that is tested.

use std::path::Path;

use rayloom_tests::root;

/// The text of every Rust file below a folder.
fn sources(folder: &Path, text: &mut String) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for path in entries.flatten().map(|entry| entry.path()) {
        if path.is_dir() {
            sources(&path, text);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            *text += &std::fs::read_to_string(&path).unwrap_or_default();
        }
    }
}

#[test]
fn every_case_is_listed_and_every_test_that_is_named_exists() {
    let page = std::fs::read_to_string(root().join("docs/EXTREMES.md")).expect("the page");
    let mut source = String::new();
    for folder in ["crates", "tests/tests"] {
        sources(&root().join(folder), &mut source);
    }
    let rows: Vec<&str> = page.lines().filter(|line| line.starts_with("| E")).collect();
    let cases: Vec<&str> = rows.iter().filter_map(|row| row[2..].split_whitespace().next()).collect();
    let expected: Vec<String> = (1..=70).map(|number| format!("E{number}")).collect();
    assert_eq!(cases, expected);
    for row in rows {
        let tests = row.trim_end_matches('|').rsplit('|').next().unwrap_or_default();
        assert!(!tests.trim().is_empty(), "{row}");
        for name in tests.split('`').skip(1).step_by(2) {
            assert!(source.contains(&format!("fn {name}(")), "no test is called `{name}`: {row}");
        }
    }
    // And the other way round: tests that carry a number are listed.
    for name in source.lines().filter_map(|line| line.trim().strip_prefix("fn e")?.split('(').next()) {
        let numbered = name.starts_with(|c: char| c.is_ascii_digit());
        assert!(!numbered || page.contains(&format!("`e{name}`")), "`e{name}` is not listed in docs/EXTREMES.md");
    }
}
