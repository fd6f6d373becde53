//! Installing what tests need from the distribution, where that is Debian or Ubuntu.

use std::path::Path;

use crate::command::{program, run, succeeds};

/// Whether there is an apt-get to install with.
pub fn can_install() -> bool {
    Path::new("/etc/debian_version").exists()
}

/// Installs packages, saying why first.
///
/// # Errors
/// There is nobody with the right to install, or it fails.
pub fn install(packages: &[&str], why: &str) -> Result<(), String> {
    let line = format!("apt-get install {}", packages.join(" "));
    let root = succeeds(program("sh", &["-c", "test \"$(id -u)\" = 0"]).env_remove("ENV"));
    eprintln!("{why}\nThe packages {} will be installed now.", packages.join(" and "));
    if !root && !succeeds(&mut program("sudo", &["--version"])) {
        return Err(format!("installing needs the rights of root and there is no sudo; run as root: {line}"));
    }
    let apt_get = |arguments: &[&str]| {
        let words: Vec<&str> = if root { vec!["apt-get"] } else { vec!["sudo", "apt-get"] };
        let words: Vec<&str> = words.into_iter().chain(arguments.iter().copied()).collect();
        run(program(words[0], &words[1..]).env("DEBIAN_FRONTEND", "noninteractive"))
    };
    // Old package lists may do as well: what counts is whether the packages can be installed.
    let _ = apt_get(&["update", "--quiet"]);
    let mut arguments = vec!["install", "--yes", "--quiet", "--no-install-recommends"];
    arguments.extend(packages);
    apt_get(&arguments)
}
