//! Why something cannot be measured or drawn.

use std::path::PathBuf;

use rayloom_gpu::GpuError;
use rayloom_network::{EditError, PropertyError};
use rayloom_reference::metrics::CompareError;
use rayloom_reference::{RenderError, SceneError};
use thiserror::Error;

/// Why the float64 reference cannot draw what a ray traversal shows.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("The float64 reference cannot draw this: {0}.")]
pub struct Refusal(pub String);

/// Why a network cannot be measured.
#[derive(Debug, Error)]
pub enum MeasureError {
    /// The reference cannot draw it.
    #[error(transparent)]
    Refusal(#[from] Refusal),
    /// There is nothing to measure, or no telling which.
    #[error("{0}")]
    Subject(String),
    /// The network could not be evaluated: what failed, or is not ready, a line each.
    #[error("{0}")]
    Evaluation(String),
    /// A property refuses a value.
    #[error(transparent)]
    Edit(#[from] EditError),
    /// A property of another type than a ray traversal has.
    #[error(transparent)]
    Property(#[from] PropertyError),
    /// The device failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The reference could not be rendered.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// Pictures that cannot be compared.
    #[error(transparent)]
    Compare(#[from] CompareError),
    /// What is to be varied makes no sense.
    #[error("{0}")]
    Plan(String),
    /// Nothing could be rendered.
    #[error("None of the settings can be rendered.\n{0}")]
    AllRefused(String),
    /// A file could not be written.
    #[error("{}: cannot be written: {source}", path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// The reason.
        source: std::io::Error,
    },
    /// An error map could not be coded.
    #[error("A picture of the report cannot be coded: {0}")]
    Picture(#[from] image::ImageError),
    /// The measurements could not be coded.
    #[error("The measurements cannot be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
}

impl From<SceneError> for MeasureError {
    fn from(error: SceneError) -> Self {
        Self::Render(error.into())
    }
}
