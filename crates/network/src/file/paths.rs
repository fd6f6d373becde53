//! Paths of files beside a network: relative to its folder in the file, absolute in memory.

use std::path::{Component, Path, PathBuf};

/// A stored path as it is used: joined to the folder of the network file if it is relative. Empty stays empty.
pub(crate) fn resolve(stored: &str, folder: Option<&Path>) -> String {
    match folder {
        Some(folder) if !stored.is_empty() => text(&tidy(&folder.join(stored))),
        _ => stored.to_owned(),
    }
}

/// A path as it is stored: relative to the folder of the network file, with `/` between the parts; absolute if the two have
/// nothing in common.
pub(crate) fn relate(used: &str, folder: Option<&Path>) -> String {
    let Some(folder) = folder.filter(|_| !used.is_empty()) else {
        return used.to_owned();
    };
    let (Ok(folder), Ok(path)) = (std::path::absolute(folder), std::path::absolute(used)) else {
        return used.to_owned();
    };
    let (folder, path) = (tidy(&folder), tidy(&path));
    let from: Vec<Component<'_>> = folder.components().collect();
    let to: Vec<Component<'_>> = path.components().collect();
    let shared = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    let levels = from.len() - shared;
    // Relative paths let a network move together with its data. What shares no folder does not move together.
    if shared == 0 || (shared == 1 && levels > 1) {
        return text(&path);
    }
    let up = std::iter::repeat_n("..".to_owned(), levels);
    let down = to[shared..].iter().map(|part| part.as_os_str().to_string_lossy().into_owned());
    let relative = up.chain(down).collect::<Vec<_>>().join("/");
    if relative.is_empty() { ".".to_owned() } else { relative }
}

/// Without `.` and `name/..`, by the text alone.
fn tidy(path: &Path) -> PathBuf {
    let mut tidy = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if matches!(tidy.components().next_back(), Some(Component::Normal(_))) => {
                tidy.pop();
            }
            Component::ParentDir if tidy.has_root() => {}
            other => tidy.push(other),
        }
    }
    tidy
}

fn text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn paths_go_out_relative_and_come_back_absolute() {
        let folder = Some(Path::new("/home/ann/networks"));
        for (used, stored) in [
            ("/home/ann/networks/head.nrrd", "head.nrrd"),
            ("/home/ann/data/head.nrrd", "../data/head.nrrd"),
            ("/home/ann/networks/../data/./x", "../data/x"),
            ("/mnt/scans/head.nrrd", "/mnt/scans/head.nrrd"),
            ("", ""),
        ] {
            assert_eq!(relate(used, folder), stored);
            assert_eq!(
                resolve(stored, folder),
                if used.is_empty() { String::new() } else { text(&tidy(Path::new(used))) }
            );
        }
        assert_eq!(resolve("../../../../../etc", folder), "/etc");
    }
}
