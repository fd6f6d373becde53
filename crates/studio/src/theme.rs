//! Colours and spacing: calm, one accent for each type of port.

use egui::{Color32, FontFamily, FontId, Response, RichText, Stroke, TextStyle, Theme, Ui, Visuals};
use rayloom_network::{ImageKind, PortType};

/// Something failed.
pub const ERROR: Color32 = Color32::from_rgb(0xe0, 0x6c, 0x60);
/// Something waits for the user.
pub const WARNING: Color32 = Color32::from_rgb(0xd9, 0xa4, 0x41);
/// A result of yesterday.
pub const STALE: Color32 = Color32::from_rgb(0x9a, 0x8a, 0x6a);
/// All is well.
pub const READY: Color32 = Color32::from_rgb(0x6f, 0xb0, 0x7f);

/// A colour for text: what stands out as a mark on a light panel is too faint for letters there.
pub fn ink(visuals: &Visuals, color: Color32) -> Color32 {
    if visuals.dark_mode { color } else { color.lerp_to_gamma(Color32::BLACK, 0.4) }
}

/// Text in a colour.
pub fn colored(ui: &mut Ui, color: Color32, text: impl Into<RichText>) -> Response {
    let color = ink(ui.visuals(), color);
    ui.colored_label(color, text)
}

/// A message in a colour; what follows its first line is text of a program, whose columns stand below one another.
pub fn report(ui: &mut Ui, color: Color32, text: &str) -> Response {
    let Some((first, excerpt)) = text.split_once('\n') else { return colored(ui, color, text) };
    ui.vertical(|ui| {
        colored(ui, color, first);
        let ink = ink(ui.visuals(), color);
        ui.add(egui::Label::new(RichText::new(excerpt).monospace().size(11.0).color(ink)).extend());
    })
    .response
}

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
    letters(&mut dark, Color32::from_gray(0xb6), Color32::from_rgb(0x8b, 0x90, 0x97));
    context.set_visuals_of(Theme::Dark, dark);
    let mut light = Visuals::light();
    light.panel_fill = Color32::from_rgb(0xf4, 0xf3, 0xf0);
    light.window_fill = Color32::from_rgb(0xfb, 0xfa, 0xf8);
    light.faint_bg_color = Color32::from_rgb(0xec, 0xea, 0xe6);
    letters(&mut light, Color32::from_gray(0x2c), Color32::from_rgb(0x6a, 0x69, 0x66));
    context.set_visuals_of(Theme::Light, light);
    context.all_styles_mut(|style| {
        style.spacing.item_spacing = egui::vec2(8.0, 6.0);
        style.interaction.tooltip_delay = 0.3;
        // Always in sight where there is more than fits.
        style.spacing.scroll = egui::style::ScrollStyle { handle_min_length: 24.0, ..egui::style::ScrollStyle::thin() };
        style.text_styles.insert(TextStyle::Small, FontId::new(10.0, FontFamily::Proportional));
    });
}

/// Colours of text and of what matters less; both are told apart from a panel at least 4.5 to 1.
fn letters(visuals: &mut Visuals, text: Color32, weak: Color32) {
    visuals.weak_text_color = Some(weak);
    visuals.widgets.noninteractive.fg_stroke = Stroke::new(1.0, text);
    visuals.widgets.inactive.fg_stroke = Stroke::new(1.0, text);
}
