//! The documents are true: generated pages are up to date and links lead somewhere.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::program::{rayloom, root};

/// All files below a folder with their texts, by path.
fn texts(folder: &Path) -> BTreeMap<PathBuf, String> {
    let mut texts = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(&next).unwrap_or_else(|error| panic!("{}: {error}", next.display())) {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension() == Some("md".as_ref()) {
                let text = fs::read_to_string(&path).expect("a text");
                texts.insert(path.strip_prefix(folder).expect("a file below").to_owned(), text);
            }
        }
    }
    texts
}

#[test]
fn generated_pages_are_up_to_date() {
    for what in ["processors", "snippets"] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        rayloom(["list", what, "--pages", folder.path().to_str().expect("a path in UTF-8")]).output();
        let (now, stored) = (texts(folder.path()), texts(&root().join("docs").join(what)));
        let names = |texts: &BTreeMap<PathBuf, String>| texts.keys().cloned().collect::<Vec<_>>();
        assert_eq!(names(&now), names(&stored), "run `cargo xtask docs`");
        for (path, text) in now {
            assert!(stored[&path] == text, "docs/{what}/{} is not up to date; run `cargo xtask docs`", path.display());
        }
    }
}

#[test]
fn links_between_documents_lead_somewhere() {
    let read = |name: &str| (PathBuf::from(name), fs::read_to_string(root().join(name)).expect("a text"));
    let mut documents: Vec<(PathBuf, String)> = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md"].map(read).into();
    documents.extend(texts(&root().join("docs")).into_iter().map(|(path, text)| (Path::new("docs").join(path), text)));
    for (document, text) in documents {
        let folder = root().join(document.parent().expect("a folder"));
        let targets = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        for target in targets.filter(|target| !target.contains("://") && !target.starts_with('#')) {
            let path = target.split('#').next().unwrap_or(target);
            assert!(folder.join(path).exists(), "{}: there is no {target}", document.display());
        }
    }
}
