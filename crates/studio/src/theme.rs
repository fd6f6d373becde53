//! Colours and spacing: calm, one accent for each type of port.

use egui::{Color32, Theme, Visuals};
use rayloom_network::{ImageKind, PortType};

/// Something failed.
pub const ERROR: Color32 = Color32::from_rgb(0xe0, 0x6c, 0x60);
/// Something waits for the user.
pub const WARNING: Color32 = Color32::from_rgb(0xd9, 0xa4, 0x41);
/// A result of yesterday.
pub const STALE: Color32 = Color32::from_rgb(0x9a, 0x8a, 0x6a);
/// All is well.
pub const READY: Color32 = Color32::from_rgb(0x6f, 0xb0, 0x7f);

/// The accent of a port and of the wires from it.
pub fn port_color(port_type: PortType) -> Color32 {
    match port_type {
        PortType::Volume => Color32::from_rgb(0xe0, 0x8e, 0x45),
        PortType::Geometry => Color32::from_rgb(0x6f, 0xb0, 0x7f),
        PortType::Image(ImageKind::EntryPoints | ImageKind::ExitPoints) => Color32::from_rgb(0xa9, 0x86, 0xd6),
        PortType::Image(_) => Color32::from_rgb(0x5a, 0x9b, 0xd8),
    }
}

/// Applies the looks to both themes.
pub fn apply(context: &egui::Context) {
    let mut dark = Visuals::dark();
    dark.panel_fill = Color32::from_rgb(0x1d, 0x20, 0x25);
    dark.window_fill = Color32::from_rgb(0x24, 0x28, 0x2e);
    dark.extreme_bg_color = Color32::from_rgb(0x15, 0x17, 0x1b);
    dark.faint_bg_color = Color32::from_rgb(0x22, 0x26, 0x2b);
    dark.selection.bg_fill = Color32::from_rgb(0x2c, 0x4f, 0x70);
    context.set_visuals_of(Theme::Dark, dark);
    let mut light = Visuals::light();
    light.panel_fill = Color32::from_rgb(0xf4, 0xf3, 0xf0);
    light.window_fill = Color32::from_rgb(0xfb, 0xfa, 0xf8);
    context.set_visuals_of(Theme::Light, light);
    context.all_styles_mut(|style| {
        style.spacing.item_spacing = egui::vec2(8.0, 6.0);
        style.interaction.tooltip_delay = 0.3;
    });
}
