//! Several numbers side by side; picture sizes with usual ones to choose from.

use egui::Ui;
use rayloom_network::{PropertyDecl, PropertyKind, Value};

use super::editor::Surroundings;
use super::number::Number;

/// Usual picture sizes.
const SIZES: [[f64; 2]; 6] =
    [[512.0, 512.0], [1024.0, 1024.0], [1280.0, 800.0], [1920.0, 1080.0], [2560.0, 1440.0], [3840.0, 2160.0]];

/// Shows the components of a vector; the new vector if the user changed one.
pub(super) fn show(
    ui: &mut Ui,
    decl: &PropertyDecl,
    components: &[f64],
    surroundings: &mut Surroundings<'_>,
) -> Option<Value> {
    let PropertyKind::Vector { range, unit, whole, .. } = &decl.kind else { return None };
    let is_size = decl.id == "size" && components.len() == 2 && *whole;
    let menu = if is_size { 20.0 } else { 0.0 };
    let labels: Vec<_> = (1..=components.len()).map(|number| format!("{} {number}", decl.label)).collect();
    let width = ui.available_width() - menu;
    let unit = if components.len() == 1 { unit.as_str() } else { "" };
    let mut changed = None;
    ui.spacing_mut().item_spacing.x = 3.0;
    let share = (width + 3.0) / components.len().max(1) as f32 - 3.0;
    for (index, (component, label)) in components.iter().zip(&labels).enumerate() {
        let field = Number { label, range: *range, slider: None, unit, logarithmic: false, whole: *whole };
        let entered = field.show(ui, *component, share);
        if let Some(number) = surroundings.number(decl, entered) {
            let mut components = components.to_vec();
            components[index] = number;
            changed = Some(Value::Vector(components));
        }
    }
    if is_size {
        ui.menu_button("⏷", |ui| {
            for size in SIZES {
                if ui.button(format!("{} x {}", size[0], size[1])).clicked() {
                    changed = Some(Value::Vector(size.to_vec()));
                    ui.close();
                }
            }
        });
    }
    changed
}

/// Three numbers in a row; the new ones if the user changed one.
pub(super) fn triple(
    ui: &mut Ui,
    decl: &PropertyDecl,
    label: &str,
    values: [f64; 3],
    surroundings: &mut Surroundings<'_>,
) -> Option<[f64; 3]> {
    let mut changed = None;
    ui.spacing_mut().item_spacing.x = 3.0;
    let share = (ui.available_width() - 6.0) / 3.0;
    for (index, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let label = format!("{label} {axis}");
        let range = [f64::NEG_INFINITY, f64::INFINITY];
        let field = Number { label: &label, range, slider: None, unit: axis, logarithmic: false, whole: false };
        let entered = field.show(ui, values[index], share);
        if let Some(number) = surroundings.number(decl, entered) {
            let mut values = values;
            values[index] = number;
            changed = Some(values);
        }
    }
    changed
}
