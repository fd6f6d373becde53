//! The list of all processors.

use std::sync::Arc;

use rayloom_network::Registry;

use crate::process::{PlainProcess, Process};
use crate::*;

/// All processors, in the order a user would meet them; one line each.
pub fn processors() -> Vec<Arc<dyn Process>> {
    vec![
        PlainProcess::shared(volume_source::declaration(), volume_source::process),
        Arc::new(volume_generator::VolumeGenerator::new()),
        PlainProcess::shared(gradient_volume::declaration(), gradient_volume::process),
        PlainProcess::shared(cube_proxy::declaration(), cube_proxy::process),
        PlainProcess::shared(clipped_proxy::declaration(), clipped_proxy::process),
        PlainProcess::shared(entry_exit_points::declaration(), entry_exit_points::process),
        Arc::new(ray_traversal::RayTraversal::new()),
        PlainProcess::shared(slice_view::declaration(), slice_view::process),
        PlainProcess::shared(background::declaration(), background::process),
        PlainProcess::shared(compositor::declaration(), compositor::process),
        PlainProcess::shared(color_map::declaration(), color_map::process),
        PlainProcess::shared(canvas::declaration(), canvas::process),
        PlainProcess::shared(image_export::declaration(), image_export::process),
    ]
}

/// The registry of all processor types, for the network model.
pub fn registry() -> Registry {
    let mut registry = Registry::new();
    for process in processors() {
        let added = registry.add(process);
        debug_assert!(added.is_ok(), "{added:?}");
    }
    registry
}
