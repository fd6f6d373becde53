//! The reference renderer against closed forms, geometry and invariances.

mod closed_forms;
mod invariances;
mod ray_box;
mod reconstruction;
mod scenes;
mod surfaces;
