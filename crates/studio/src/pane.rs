//! The panes that the window is divided into.

use rayloom_network::Address;
use serde::{Deserialize, Serialize};

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
