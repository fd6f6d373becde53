//! Makes sure that there is a graphics adapter to render on.

use std::path::Path;

use crate::command::{program, run, succeeds};

/// What Debian and Ubuntu call the Vulkan loader and Mesa's drivers, the software one among them.
const PACKAGES: [&str; 2] = ["mesa-vulkan-drivers", "libvulkan1"];

/// Installs Mesa's drivers if `rayloom` (a built program) finds no adapter.
///
/// # Errors
/// There is no adapter and none could be installed; the message says what to install.
pub fn ensure(rayloom: &Path) -> Result<(), String> {
    let adapter = || succeeds(&mut program(&rayloom.to_string_lossy(), &["adapter"]));
    if adapter() {
        return Ok(());
    }
    if !Path::new("/etc/debian_version").exists() {
        return Err(elsewhere().to_owned());
    }
    install()?;
    if adapter() {
        return Ok(());
    }
    Err(format!("{} are installed, but `rayloom adapter` still finds no graphics adapter", PACKAGES.join(" and ")))
}

fn install() -> Result<(), String> {
    let line = format!("apt-get install {}", PACKAGES.join(" "));
    let root = succeeds(program("sh", &["-c", "test \"$(id -u)\" = 0"]).env_remove("ENV"));
    eprintln!("No Vulkan adapter was found. The packages {} will be installed now:", PACKAGES.join(" and "));
    eprintln!("Mesa's Vulkan drivers, which render on the processor where there is no graphics card.");
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
    arguments.extend(PACKAGES);
    apt_get(&arguments)
}

/// What to do on a system without apt-get.
fn elsewhere() -> &'static str {
    "no Vulkan adapter was found; install a driver and run this again:\n  \
     Fedora:  sudo dnf install mesa-vulkan-drivers vulkan-loader\n  \
     Arch:    sudo pacman -S vulkan-swrast vulkan-icd-loader\n  \
     Alpine:  sudo apk add mesa-vulkan-swrast vulkan-loader\n  \
     openSUSE: sudo zypper install libvulkan_lvp libvulkan1\n  \
     macOS and Windows have Metal and Direct3D 12; an adapter is missing only without a graphics driver"
}
