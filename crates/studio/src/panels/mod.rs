//! The panels: each shows one aspect of the session and edits it.

mod canvas;
mod messages;

use egui_tiles::{Tiles, Tree};

use crate::session::Session;

/// Which panel a tile holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Pane {
    /// The picture of the canvas, or of the first one.
    Canvas,
    /// What the user was told.
    Messages,
}

impl Pane {
    /// Text on the tab.
    pub fn title(&self) -> &'static str {
        match self {
            Self::Canvas => "Canvas",
            Self::Messages => "Messages",
        }
    }
}

/// What the panels remember from frame to frame.
#[derive(Default)]
pub struct Panels {
    canvas: canvas::CanvasPanel,
}

impl Panels {
    /// Shows one panel.
    pub fn show(&mut self, pane: &Pane, ui: &mut egui::Ui, session: &mut Session) {
        match pane {
            Pane::Canvas => self.canvas.show(ui, session),
            Pane::Messages => messages::show(ui, session),
        }
    }

    /// Shows canvases and exposed properties, nothing of the network.
    pub fn visualization(&mut self, ui: &mut egui::Ui, session: &mut Session) {
        self.canvas.show(ui, session);
    }
}

/// The layout that a new user meets.
pub fn default_layout() -> Tree<Pane> {
    let mut tiles = Tiles::default();
    let canvas = tiles.insert_pane(Pane::Canvas);
    let messages = tiles.insert_pane(Pane::Messages);
    let root = tiles.insert_vertical_tile(vec![canvas, messages]);
    Tree::new("panels", root, tiles)
}
