//! An X server without a monitor, its pointer and its keys.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::picture::Picture;
use crate::command::program;

/// Longest time that moving the pointer or pressing keys may take.
const PATIENCE: Duration = Duration::from_secs(30);

/// The server; it ends with this value.
pub struct Screen {
    server: Child,
    name: String,
    /// Where the server keeps its pixels, in the format of `xwd`.
    pixels: PathBuf,
}

impl Screen {
    /// Starts a server whose screen has a size in pixels and is kept in a folder.
    ///
    /// # Errors
    /// The server cannot be started.
    pub fn start([width, height]: [u32; 2], folder: &Path) -> Result<Self, String> {
        // By default the server starts afresh, and refuses others meanwhile, whenever its last client leaves.
        let size = format!("{width}x{height}x24");
        let mut server =
            program("Xvfb", &["-displayfd", "1", "-screen", "0", &size, "-nolisten", "tcp", "-noreset", "-fbdir"])
                .arg(folder)
                .stdin(Stdio::null())
                .stdout(Stdio::piped())
                .stderr(Stdio::null())
                .spawn()
                .map_err(|error| format!("Xvfb cannot be started: {error}"))?;
        let mut number = String::new();
        if let Some(output) = server.stdout.take() {
            // The server ends the line when it is ready; it closes its output when it fails.
            let _ = BufReader::new(output).read_line(&mut number);
        }
        let screen = Self { server, name: format!(":{}", number.trim()), pixels: folder.join("Xvfb_screen0") };
        match number.trim().is_empty() {
            true => Err("Xvfb ended at once".into()),
            false => Ok(screen),
        }
    }

    /// What `DISPLAY` must be for programs to use it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What is on the screen.
    ///
    /// # Errors
    /// The server keeps its pixels in an unknown format.
    pub fn picture(&self) -> Result<Picture, String> {
        let bytes = std::fs::read(&self.pixels).map_err(|error| format!("{}: {error}", self.pixels.display()))?;
        Picture::from_xwd(&bytes).ok_or_else(|| format!("{} is in an unknown format", self.pixels.display()))
    }

    /// The window with a text in its title, if there is one.
    pub fn find(&self, title: &str) -> Option<String> {
        let found = self.xdotool(&["search", "--onlyvisible", "--name", title]).ok()?;
        found.lines().next().map(str::to_owned)
    }

    /// Lets a window have the keys: there is no window manager to do it.
    pub fn focus(&self, window: &str) -> Result<(), String> {
        self.xdotool(&["windowfocus", window]).map(drop)
    }

    /// Presses keys, such as `ctrl+z`, and lets them go.
    pub fn keys(&self, keys: &str) -> Result<(), String> {
        self.xdotool(&["key", keys]).map(drop)
    }

    /// Moves the pointer from one pixel to another with the left button down.
    pub fn drag(&self, from: [i32; 2], to: [i32; 2]) -> Result<(), String> {
        const STEPS: i32 = 6;
        self.xdotool(&["mousemove", &from[0].to_string(), &from[1].to_string(), "sleep", "0.5", "mousedown", "1"])?;
        for step in 1..=STEPS {
            let [x, y] = [0, 1].map(|axis| (from[axis] + (to[axis] - from[axis]) * step / STEPS).to_string());
            self.xdotool(&["sleep", "0.2", "mousemove", &x, &y])?;
        }
        self.xdotool(&["sleep", "0.5", "mouseup", "1"]).map(drop)
    }

    fn xdotool(&self, arguments: &[&str]) -> Result<String, String> {
        output(program("xdotool", arguments).env("DISPLAY", &self.name))
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

/// What a command prints, which is little; it is ended when it takes too long.
fn output(command: &mut Command) -> Result<String, String> {
    let name = command.get_program().display().to_string();
    let piped = command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::null()).spawn();
    let mut child = piped.map_err(|error| format!("{name} cannot be started: {error}"))?;
    let start = Instant::now();
    while child.try_wait().map_err(|error| error.to_string())?.is_none() {
        if start.elapsed() > PATIENCE {
            // It may have ended just now.
            let _ = child.kill();
            let _ = child.wait();
            return Err(format!("{name} took too long"));
        }
        sleep(Duration::from_millis(20));
    }
    let output = child.wait_with_output().map_err(|error| error.to_string())?;
    match output.status.success() {
        true => Ok(String::from_utf8_lossy(&output.stdout).into_owned()),
        false => Err(format!("{name} failed ({})", output.status)),
    }
}
