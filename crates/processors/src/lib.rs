//! The processors of Rayloom, one file each, and what runs them.
//!
//! A processor type is a [`Process`]: its declaration (ports, properties, help) plus what it does with a
//! [`Context`] (the device and its caches) and a job (properties and inputs). [`registry`] lists all of them for the
//! network model; a [`Runner`] is the network's backend and runs them on one device.

mod background;
mod canvas;
mod clip;
mod clipped_proxy;
mod color_map;
mod compositor;
mod context;
mod cube_proxy;
mod data;
mod entry_exit_points;
mod explain;
mod gradient_volume;
mod image_export;
mod image_file;
mod image_pass;
mod process;
mod ray_traversal;
mod registry;
mod shader;
mod slice_view;
mod step;
pub mod types;
mod view;
mod volume_generator;
mod volume_source;
mod volume_texture;

pub use context::{Context, ProgressListener};
pub use data::{Data, Image, JobData, MISS, Mesh, Precision, VolumeData};
pub use explain::{Explanation, Ledger, Role};
pub use image_file::{ImageFileError, Picture, read_picture, write_exr, write_npy, write_picture, write_png};
pub use image_pass::{Bind, ImagePass};
pub use process::{PlainProcess, Process, Runner, Work};
pub use ray_traversal::{
    Trace, TraceOutput, TraceSample, reload_snippets, save_user_snippet, snippet_library, snippet_revision, user_folder,
};
pub use registry::{processors, registry};
pub use shader::plain_shader;
pub use step::step_length;
pub use view::{View, same_box};
pub use volume_texture::{GpuVolume, Storage};
