//! The panels: each shows one aspect of the session and edits it.

mod accuracy;
mod application;
mod budget;
pub(crate) mod canvas;
mod dock;
mod inspector;
mod messages;
mod network;
mod probe;
mod processors;
pub(crate) mod properties;
mod ray_probe;
mod shader_editor;
mod tuning;

use egui_tiles::{Linear, LinearDir, TileId, Tiles, Tree};

use rayloom_network::Report;

use crate::pane::Pane;
use crate::session::Session;
use crate::visualization::Visualization;

pub use dock::open;
pub use network::Action as NetworkAction;

/// What the pointer and keys do that no command says: where, and for what.
pub const GESTURES: &[(&str, &[(&str, &str)])] =
    &[("On the node canvas", network::GESTURES), ("On a picture", canvas::GESTURES)];

/// What keeps processors waiting, each cause once: not again for all that wait on its account, nor for a failure.
pub(crate) fn causes(report: &Report) -> impl Iterator<Item = &str> {
    report.not_ready.iter().flat_map(|(id, reasons)| {
        let own = format!("{id}: ");
        reasons.iter().filter(move |reason| reason.starts_with(&own)).map(String::as_str)
    })
}

/// What the panels remember from frame to frame.
#[derive(Default)]
pub struct Panels {
    processors: processors::ProcessorsPanel,
    pub(crate) network: network::NetworkPanel,
    canvas: canvas::CanvasPanel,
    accuracy: accuracy::AccuracyPanel,
    inspectors: inspector::Inspectors,
    ray_probe: ray_probe::RayProbePanel,
    shader_editors: shader_editor::ShaderEditors,
    properties: properties::PropertiesPanel,
    application: application::ApplicationPanel,
    visualization: Visualization,
}

impl Panels {
    /// Forgets the last document.
    pub(crate) fn forget(&mut self) {
        let accuracy = std::mem::take(&mut self.accuracy).anew();
        *self = Self { accuracy, ..Self::default() };
    }

    /// Shows one panel.
    pub fn show(&mut self, pane: &Pane, ui: &mut egui::Ui, session: &mut Session) {
        match pane {
            Pane::Processors => {
                if let Some(type_id) = self.processors.show(ui, session) {
                    self.network.add_in_the_middle(&type_id, ui.ctx(), session);
                }
            }
            Pane::Network => self.network.show(ui, session),
            Pane::Canvas => self.canvas.show(ui, session),
            Pane::Messages => messages::show(ui, session),
            Pane::Properties => self.properties.show(ui, session),
            Pane::Accuracy => self.accuracy.show(ui, session),
            Pane::Budget => budget::show(ui, session),
            Pane::Application => self.application.show(ui, session),
            Pane::RayProbe => self.ray_probe.show(ui, session),
            Pane::Shader(text) => self.shader_editors.show(ui, session, text),
            Pane::Inspector(outport) => self.inspectors.show(ui, session, outport),
        }
    }

    /// Shows canvases and exposed properties, nothing of the network.
    pub fn visualization(&mut self, ui: &mut egui::Ui, session: &mut Session) {
        self.visualization.show(ui, session);
    }
}

/// The layout that a new user meets: what there is on the left, how it is wired and what it
/// shows in the middle, the properties of the selection on the right.
pub fn default_layout() -> Tree<Pane> {
    let mut tiles = Tiles::default();
    let [processors, network, canvas, messages, properties] =
        [Pane::Processors, Pane::Network, Pane::Canvas, Pane::Messages, Pane::Properties]
            .map(|pane| tiles.insert_pane(pane));
    let middle = share(&mut tiles, LinearDir::Vertical, &[(network, 0.42), (canvas, 0.58)]);
    let left = share(&mut tiles, LinearDir::Vertical, &[(processors, 0.75), (messages, 0.25)]);
    let columns = [(left, 0.16), (middle, 0.57), (properties, 0.27)];
    let root = share(&mut tiles, LinearDir::Horizontal, &columns);
    Tree::new("panels", root, tiles)
}

/// Puts tiles side by side or over one another, each with its share of the space.
fn share(tiles: &mut Tiles<Pane>, direction: LinearDir, parts: &[(TileId, f32)]) -> TileId {
    let mut linear = Linear::new(direction, parts.iter().map(|(tile, _)| *tile).collect());
    for (tile, part) in parts {
        linear.shares.set_share(*tile, *part);
    }
    tiles.insert_container(linear)
}
