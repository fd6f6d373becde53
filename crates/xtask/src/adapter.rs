//! Makes sure that there is a graphics adapter to render on.

use std::path::Path;

use crate::command::{program, succeeds};
use crate::packages;

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
    if !packages::can_install() {
        return Err(elsewhere().to_owned());
    }
    let why = "No Vulkan adapter was found. Mesa's drivers render on the processor where there is no graphics card.";
    packages::install(&PACKAGES, why)?;
    if adapter() {
        return Ok(());
    }
    Err(format!("{} are installed, but `rayloom adapter` still finds no graphics adapter", PACKAGES.join(" and ")))
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
