//! The yardstick of Rayloom: a float64 raycaster on the CPU, closed forms and error metrics.
//!
//! Nothing here shares code with the GPU ray loop but the definitions of volumes and transfer functions; agreement between
//! the two is evidence.
//!
//! - [`exact`] takes no samples: it is what the scene stands for, to about 1e-13. What a picture differs from it is its error.
//! - [`same_samples`] takes the very samples the GPU takes, in float64: what remains between the two pictures is the
//!   arithmetic of the GPU. Refining its step shows the discretisation error.
//! - [`closed_forms`] are scenes whose exact value is a formula: they judge both.
//! - [`metrics`] measure how far two pictures are apart: as numbers, on a display, and by the surfaces they show.
//! - [`Cache`] keeps the pictures of either renderer on disk, by what they show.
//!
//! [`scene`], [`camera`], [`ray`], [`field`] and [`gradient`] say what is rendered and are independent of how the integral
//! along a ray is taken: both renderers stand on the same five.
//!
//! # Spaces
//! *World*: physical units of the volume. *Texture*: the volume box is `0..1` on each axis. *Index*: voxel centres at
//! integers, `index = texture · dims - 0.5`.

mod cache;
pub mod camera;
mod classification;
pub mod closed_forms;
pub mod exact;
pub mod field;
pub mod gradient;
pub mod image;
pub mod metrics;
mod prepared;
mod progress;
pub mod ray;
mod reference;
pub mod same_samples;
pub mod scene;
pub mod shading;
pub mod special;
mod spline;
mod surface;

pub use cache::{Cache, Cached, Source};
pub use camera::{Camera, Projection};
pub use classification::{Classification, Labels};
pub use image::{Image, MISS, Rectangle};
pub use metrics::{Comparison, DisplayComparison, DisplayPicture, SurfaceComparison, SurfacePoint};
pub use prepared::SurfaceHit;
pub use progress::{Progress, RenderError, unattended};
pub use reference::Reference;
pub use scene::{FirstHit, Layer, Method, Refinement, Scene, SceneError};
pub use surface::surface_points;
