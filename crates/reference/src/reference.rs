//! The choice between the two renderers.

use crate::image::{Image, Rectangle};
use crate::progress::{Progress, RenderError};
use crate::scene::Scene;
use crate::{exact, same_samples};

/// What a picture is measured against.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Reference {
    /// What the scene stands for, without samples: shows the whole error.
    Exact,
    /// The samples of the GPU in float64: shows its arithmetic alone.
    SameSamples,
}

impl Reference {
    /// Both, in the order in which they are offered.
    pub const ALL: [Self; 2] = [Self::Exact, Self::SameSamples];

    /// The name of this choice in commands and files.
    pub fn id(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::SameSamples => "same-samples",
        }
    }

    /// The choice of that name.
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|reference| reference.id() == id)
    }

    /// Renders a scene, or `part` of it, in parallel.
    ///
    /// # Errors
    /// The scene or the part makes no sense, or `progress` cancelled the picture.
    pub fn render(
        self,
        scene: &Scene<'_>,
        part: Option<Rectangle>,
        progress: Progress<'_>,
    ) -> Result<Image, RenderError> {
        match self {
            Self::Exact => exact::Renderer::new(scene)?.render(part, progress),
            Self::SameSamples => same_samples::Renderer::new(scene)?.render(part, progress),
        }
    }
}
