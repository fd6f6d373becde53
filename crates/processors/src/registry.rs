//! The list of all processors.

use std::sync::Arc;

use rayloom_network::Registry;

use crate::process::{PlainProcess, Process};
use crate::*;

/// All processors, in the order a user would meet them; one line each.
pub fn processors() -> Vec<Arc<dyn Process>> {
    vec![
        PlainProcess::new(volume_source::declaration(), volume_source::process),
        Arc::new(volume_generator::VolumeGenerator::new()),
        PlainProcess::new(gradient_volume::declaration(), gradient_volume::process),
        PlainProcess::new(cube_proxy::declaration(), cube_proxy::process),
        PlainProcess::new(clipped_proxy::declaration(), clipped_proxy::process),
        PlainProcess::new(slice_view::declaration(), slice_view::process),
        PlainProcess::new(background::declaration(), background::process),
        PlainProcess::new(compositor::declaration(), compositor::process),
        PlainProcess::new(color_map::declaration(), color_map::process),
        PlainProcess::new(canvas::declaration(), canvas::process),
        PlainProcess::new(image_export::declaration(), image_export::process),
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
