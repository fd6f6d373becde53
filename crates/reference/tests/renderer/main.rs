//! The reference renderer against closed forms, geometry and invariances.

mod cache;
mod closed_forms;
mod exact;
mod exact_extremes;
mod invariances;
mod labels;
mod march;
mod ray_box;
mod reconstruction;
mod scenes;
mod surfaces;
