//! The studio: the window in which networks are wired in development mode and run in visualization mode.
//!
//! It runs the same evaluator and the same networks as the command line. Data flows one way: panels show the
//! [`session`](Session) and edit its [`Document`]; after every frame the [`Engine`] is asked to evaluate what changed, on a
//! thread of its own; its results are what the panels show in the next frame.

mod app;
mod catalog;
mod commands;
mod comparison;
mod device;
mod dialogs;
mod display;
mod document;
mod engine;
mod files;
mod first_look;
mod history;
mod inspect;
mod later;
mod navigation;
mod palette;
mod pane;
mod panels;
mod pointer;
mod probe;
mod quality;
#[cfg(test)]
mod random_edits;
mod screenshot;
mod session;
mod task;
mod theme;
mod tuning;
mod upstream;
mod views;
mod visualization;
mod welcome;
mod wiring;

pub use app::{MoreProcessors, Options, Studio};
pub use device::setup as wgpu_setup;
pub use dialogs::{Choice, Chooser, Question};
pub use display::{Display, Layer, Look};
pub use document::Document;
pub use engine::{Engine, Photographer, Results};
pub use files::{Abandoned, Folders, Recovery};
pub use inspect::{ChannelStatistics, Inspection, Judgement, Pixel, Reading, Statistics, hover, statistics};
pub use navigation::Navigation;
pub use pane::Pane;
pub use probe::{Mark, Probe, Ray};
pub use quality::Quality;
pub use session::{Message, Mode, Session, Severity};
pub use visualization::{Application, Change, Exposed, Group, Layout};
pub use welcome::shipped_folder;

/// Opens the window and runs until it is closed.
///
/// # Errors
/// There is no display or no graphics device.
pub fn run(options: Options) -> Result<(), eframe::Error> {
    let (settings, _) = options.folders.as_ref().map(files::Settings::load).unwrap_or_default();
    let viewport = egui::ViewportBuilder::default()
        .with_inner_size(settings.window.unwrap_or([1280.0, 800.0]))
        .with_min_inner_size([640.0, 400.0])
        .with_maximized(settings.maximized);
    let native = eframe::NativeOptions {
        viewport,
        renderer: eframe::Renderer::Wgpu,
        wgpu_options: device::configuration(),
        ..Default::default()
    };
    eframe::run_native("Rayloom", native, Box::new(move |creation| Ok(Box::new(Studio::new(creation, &options)?))))
}
