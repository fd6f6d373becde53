//! The graphics device as Rayloom uses it: one [`Gpu`] with what it can and cannot do, [`Texture`]s whose size is
//! checked before anything is allocated, a [`TexturePool`] for render targets, a [`PipelineCache`] keyed by WGSL text,
//! read-back in plain numbers and a [`Timer`] on timestamp queries.
//!
//! Nothing here knows about volumes, rays or processors, and nothing here panics on what a user can cause: shader
//! errors, textures over a limit and exhausted memory all come back as a [`GpuError`].

mod buffer;
mod device;
mod error;
mod pipeline;
mod pool;
mod readback;
mod texture;
mod timer;

pub use device::{Features, Gpu, GpuOptions, Hidden};
pub use error::GpuError;
pub use pipeline::{CacheCounts, PipelineCache, RenderState, VertexLayout};
pub use pool::{PoolCounts, TexturePool};
pub use texture::Texture;
pub use timer::Timer;

// Every crate that records passes uses the same wgpu as the device.
pub use wgpu;
