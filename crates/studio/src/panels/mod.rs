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
use rayloom_network::Address;
use serde::{Deserialize, Serialize};

use crate::session::Session;
use crate::visualization::Visualization;

pub use canvas::Navigation;
pub use dock::open;
pub use network::Action as NetworkAction;

/// What the pointer and keys do that no command says: where, and for what.
pub const GESTURES: &[(&str, &[(&str, &str)])] =
    &[("On the node canvas", network::GESTURES), ("On a picture", canvas::GESTURES)];

/// Which panel a tile holds.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Pane {
    /// The processors that can be added.
    Processors,
    /// The network.
    Network,
    /// The picture of the canvas, or of the first one.
    Canvas,
    /// What the user was told.
    Messages,
    /// The properties of what is selected.
    Properties,
    /// How far the picture is from what it should be.
    Accuracy,
    /// What the processors took for the last picture.
    Budget,
    /// What visualization mode shows.
    Application,
    /// What a traversal meets along the ray of a pixel.
    RayProbe,
    /// The text of a slot, by the property that holds it.
    #[serde(skip)]
    Shader(Address),
    /// What is on an outport, kept in sight.
    #[serde(skip)]
    Inspector(Address),
}

impl Pane {
    /// Whether it makes sense with any network, and so belongs to the layout that is kept.
    pub fn is_lasting(&self) -> bool {
        !matches!(self, Self::Inspector(_))
    }

    /// Text on the tab.
    pub fn title(&self) -> String {
        match self {
            Self::Processors => "Processors".into(),
            Self::Network => "Network".into(),
            Self::Canvas => "Canvas".into(),
            Self::Messages => "Messages".into(),
            Self::Properties => "Properties".into(),
            Self::Accuracy => "Accuracy".into(),
            Self::Budget => "Frame budget".into(),
            Self::Application => "Application".into(),
            Self::RayProbe => "Ray probe".into(),
            Self::Shader(text) => {
                let slot = text.item.split('.').next().unwrap_or_default();
                format!("{} of {}", slot, text.processor)
            }
            Self::Inspector(outport) => outport.to_string(),
        }
    }
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
