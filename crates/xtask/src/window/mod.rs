//! The studio on a screen: a real window of the built program, on an X server without a monitor.

mod picture;
mod screen;

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::command::{program, root, succeeds};
use crate::packages;
use picture::Picture;
use screen::Screen;

/// Longest time that the window may take to appear, to draw or to close, on a slow machine without a graphics card.
const PATIENCE: Duration = Duration::from_secs(180);
/// A picture that stayed for so long has stopped changing.
const STILL: Duration = Duration::from_secs(4);
/// What Debian and Ubuntu call the X server and the program that moves its pointer.
const PACKAGES: [&str; 2] = ["xvfb", "xdotool"];
/// Size of the screen and of the window, pixels.
const SIZE: [u32; 2] = [1280, 800];
/// The part of the window in its middle that is looked at, pixels: canvases are there in visualization mode.
const MIDDLE: [u32; 4] = [440, 250, 400, 300];

/// How it went.
pub enum Outcome {
    /// The window did what it should.
    Passed,
    /// It could not be tried here; why.
    Skipped(String),
}

/// Opens the flagship network, turns it by dragging, closes the window.
///
/// # Errors
/// What the window did not do; pictures of the screen are in the folder that the message names.
pub fn check(rayloom: &Path) -> Result<Outcome, String> {
    if !cfg!(target_os = "linux") {
        return Ok(Outcome::Skipped("it needs an X server without a monitor, as there is on Linux".into()));
    }
    let has_tools = || succeeds(&mut program("sh", &["-c", "command -v Xvfb && command -v xdotool"]));
    if !has_tools() {
        if !packages::can_install() {
            return Ok(Outcome::Skipped("there is no Xvfb or no xdotool, and no apt-get to install them with".into()));
        }
        packages::install(&PACKAGES, "A window is tried on an X server without a monitor.")?;
    }
    let folder = root().join("target").join("window");
    // What an earlier run left.
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut window = Window::open(rayloom, &folder)?;
    window.try_out().map(|()| Outcome::Passed).map_err(|error| {
        let kept = window.screen.picture().and_then(|picture| picture.save(&folder.join("last.ppm")));
        let kept = kept.map_or_else(|error| error, |()| format!("the screen is in {}", folder.display()));
        format!("{error}; {kept}; the program said: {}", window.said())
    })
}

/// The program and its screen.
struct Window {
    program: Child,
    screen: Screen,
    stderr: PathBuf,
    folder: PathBuf,
}

impl Window {
    fn open(rayloom: &Path, folder: &Path) -> Result<Self, String> {
        let screen = Screen::start(SIZE, folder)?;
        let stderr = folder.join("stderr.txt");
        let file = File::create(&stderr).map_err(|error| format!("{}: {error}", stderr.display()))?;
        let program = program(&rayloom.to_string_lossy(), &["open", "networks/brain.json"])
            .env("DISPLAY", screen.name())
            .env_remove("WAYLAND_DISPLAY")
            .env_remove("WAYLAND_SOCKET")
            .env("RAYLOOM_HOME", folder.join("home"))
            .stdin(Stdio::null())
            .stderr(file)
            .spawn()
            .map_err(|error| format!("{} cannot be started: {error}", rayloom.display()))?;
        Ok(Self { program, screen, stderr, folder: folder.to_owned() })
    }

    fn try_out(&mut self) -> Result<(), String> {
        let window = self.wait("a window", |screen| screen.find("Rayloom"))?;
        let development = self.settled("a picture that stays")?;
        self.screen.focus(&window)?;
        self.screen.keys("F5")?;
        let middle = |screen: &Screen| screen.picture().ok().map(|picture| picture.part(MIDDLE));
        self.wait("visualization mode", |screen| middle(screen).filter(|now| now.differs(&development)))?;
        let before = self.settled("a picture that fills the window")?;
        self.screen.picture()?.save(&self.folder.join("before.ppm"))?;
        self.screen.drag([640, 400], [760, 340])?;
        self.wait("another picture after dragging", |screen| middle(screen).filter(|now| now.differs(&before)))?;
        // An undo while the pointer still moves would be no use.
        self.settled("a picture that stays after dragging")?;
        self.screen.picture()?.save(&self.folder.join("after.ppm"))?;
        // The picture as it was: nothing is left to be saved when the window closes.
        self.screen.keys("ctrl+z")?;
        self.wait("the first picture after undoing", |screen| middle(screen).filter(|now| !now.differs(&before)))?;
        self.screen.keys("ctrl+q")?;
        self.closed()
    }

    /// The middle of the window once there is a picture in it that has stopped changing.
    fn settled(&mut self, what: &str) -> Result<Picture, String> {
        let mut last: Option<(Picture, Instant)> = None;
        self.wait(what, |screen| {
            let now = screen.picture().ok()?.part(MIDDLE);
            match last.take() {
                Some((before, since)) if !now.differs(&before) => {
                    let still = since.elapsed() > STILL && now.is_rich();
                    last = Some((before, since));
                    still.then_some(now)
                }
                _ => {
                    last = Some((now, Instant::now()));
                    None
                }
            }
        })
    }

    /// Waits until something is there.
    fn wait<T>(&mut self, what: &str, mut found: impl FnMut(&Screen) -> Option<T>) -> Result<T, String> {
        let start = Instant::now();
        while start.elapsed() < PATIENCE {
            if let Some(thing) = found(&self.screen) {
                eprintln!("  {what}: after {:.1} s", start.elapsed().as_secs_f64());
                return Ok(thing);
            }
            if let Some(status) = self.program.try_wait().map_err(|error| error.to_string())? {
                return Err(format!("the program ended ({status}) before there was {what}"));
            }
            sleep(Duration::from_millis(500));
        }
        Err(format!("there was no {what} within {} s", PATIENCE.as_secs()))
    }

    /// Waits until the program has ended as it should.
    fn closed(&mut self) -> Result<(), String> {
        let start = Instant::now();
        while start.elapsed() < PATIENCE {
            if let Some(status) = self.program.try_wait().map_err(|error| error.to_string())? {
                let said = self.said();
                return match status.success() && !said.contains("panicked") {
                    true => Ok(()),
                    false => Err(format!("the program ended with {status}")),
                };
            }
            sleep(Duration::from_millis(100));
        }
        Err(format!("the window was not closed within {} s", PATIENCE.as_secs()))
    }

    /// What the program wrote to its standard error.
    fn said(&self) -> String {
        std::fs::read_to_string(&self.stderr).unwrap_or_default()
    }
}

impl Drop for Window {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}
