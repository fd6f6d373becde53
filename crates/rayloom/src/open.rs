//! `rayloom open`, and `rayloom` without a command: the studio.

use std::path::{Path, PathBuf};

use rayloom_studio::{Folders, Mode, Options};

use crate::args::StartMode;
use crate::failure::Failure;

/// Opens the window and returns when it is closed.
pub fn run(network: Option<&PathBuf>, mode: Option<StartMode>) -> Result<String, Failure> {
    if let Some(path) = network
        && !path.is_file()
    {
        return Err(Failure::new(format!("there is no network file `{}`", path.display())));
    }
    if !has_display() {
        return Err(Failure::new(
            "there is no display to open a window on; render without one: rayloom render NETWORK -o picture.png",
        ));
    }
    let mode = mode.map(|mode| match mode {
        StartMode::Development => Mode::Development,
        StartMode::Visualization => Mode::Visualization,
    });
    let options = Options {
        network: network.map(|path| Path::to_owned(path)),
        mode,
        folders: Folders::of_user(),
        shipped: rayloom_studio::shipped_folder(),
        welcome: network.is_none(),
        ..Options::default()
    };
    rayloom_studio::run(options).map_err(|error| Failure::new(format!("the window cannot be opened: {error}")))?;
    Ok(String::new())
}

/// Whether this system says that it has a display. Others than X11 and Wayland always have one.
fn has_display() -> bool {
    let set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !cfg!(all(unix, not(target_os = "macos"))) || set("DISPLAY") || set("WAYLAND_DISPLAY") || set("WAYLAND_SOCKET")
}
