//! A table of labels: number, name, colour, opacity.

use egui::{RichText, TextEdit, Ui};
use rayloom_network::{Address, PropertyDecl};
use rayloom_volume::{Knot, Label, LabelTable, TransferFunction};

use super::editor::{Surroundings, rgb_button};
use super::number::Number;

/// Colours that new labels take in turn.
const COLORS: [[f64; 3]; 8] = [
    [0.90, 0.45, 0.35],
    [0.40, 0.65, 0.90],
    [0.55, 0.80, 0.45],
    [0.95, 0.80, 0.40],
    [0.70, 0.50, 0.85],
    [0.40, 0.80, 0.75],
    [0.90, 0.55, 0.70],
    [0.75, 0.70, 0.60],
];

/// Shows a label table; the new one if the user changed it.
pub(super) fn show(
    ui: &mut Ui,
    decl: &PropertyDecl,
    table: &LabelTable,
    surroundings: &mut Surroundings<'_>,
) -> Option<LabelTable> {
    let mut after = table.clone();
    let rows = table.labels.len();
    let height = super::row::HEIGHT;
    let scroll =
        egui::ScrollArea::vertical().id_salt("labels").max_height(9.0 * (height + 4.0)).auto_shrink([false, true]);
    scroll.show_rows(ui, height, rows, |ui, shown| {
        for (number, label) in table.labels.iter().skip(shown.start).take(shown.len()) {
            ui.push_id(number, |ui| {
                ui.horizontal(|ui| match row(ui, decl, *number, label, surroundings) {
                    Edit::None => {}
                    Edit::Change(label) => {
                        after.labels.insert(*number, label);
                    }
                    Edit::Remove => {
                        after.labels.remove(number);
                    }
                });
            });
        }
    });
    ui.horizontal_wrapped(|ui| {
        if ui.button("Add a label").clicked() {
            let number = table.labels.keys().next_back().map_or(1, |last| last.saturating_add(1));
            after
                .labels
                .insert(number, uniform(format!("Label {number}"), COLORS[number as usize % COLORS.len()], 0.5));
        }
        if rows == 0 {
            ui.weak("Voxels with a label that is not listed are transparent.");
        }
    });
    (after != *table).then_some(after)
}

enum Edit {
    None,
    Change(Label),
    Remove,
}

fn row(ui: &mut Ui, decl: &PropertyDecl, number: u32, label: &Label, surroundings: &mut Surroundings<'_>) -> Edit {
    ui.spacing_mut().item_spacing.x = 4.0;
    let mut edit = Edit::None;
    ui.add_sized([26.0, super::row::HEIGHT], egui::Label::new(RichText::new(number.to_string()).weak().monospace()));
    let knots = &label.transfer_function.knots;
    let first = knots.first().map_or((COLORS[0], 0.0), |knot| (knot.color, knot.opacity));
    if let Some(color) = rgb_button(ui, &format!("Colour of label {number}"), first.0) {
        edit = Edit::Change(recolored(label, |_| color, |opacity| opacity));
    }
    let width = ui.available_width() - 92.0;
    if let Some(name) = name(ui, decl, number, label, width, surroundings) {
        edit = Edit::Change(Label { name, ..label.clone() });
    }
    let most = knots.iter().fold(0.0_f64, |most, knot| most.max(knot.opacity).max(knot.right_side().opacity));
    let title = format!("Opacity of label {number}");
    let range = [0.0, 1.0];
    let field = Number { label: &title, range, slider: Some(range), unit: "", logarithmic: false, whole: false };
    let entered = field.show(ui, most, 62.0);
    if let Some(opacity) = surroundings.number(decl, entered) {
        let scale = |own: f64| if most > 0.0 { own / most * opacity } else { opacity };
        edit = Edit::Change(match knots.is_empty() {
            true => uniform(label.name.clone(), first.0, opacity),
            false => recolored(label, |color| color, scale),
        });
    }
    if ui.add(egui::Button::new(RichText::new("✖").size(10.5).weak()).frame(false)).on_hover_text("Remove").clicked()
    {
        edit = Edit::Remove;
    }
    edit
}

fn name(
    ui: &mut Ui,
    decl: &PropertyDecl,
    number: u32,
    label: &Label,
    width: f32,
    surroundings: &mut Surroundings<'_>,
) -> Option<String> {
    let draft = Address::new(surroundings.processor, format!("{}.{number}", decl.id));
    let mut text = surroundings.tools.drafts.get(&draft).cloned().unwrap_or_else(|| label.name.clone());
    let edit = TextEdit::singleline(&mut text).desired_width(width.max(30.0)).margin(egui::Margin::symmetric(4, 1));
    let response = ui.add(edit);
    if response.has_focus() {
        surroundings.tools.drafts.insert(draft, text);
        return None;
    }
    surroundings.tools.drafts.remove(&draft);
    (response.lost_focus() && text != label.name).then_some(text)
}

/// A label that looks the same at every value.
fn uniform(name: String, color: [f64; 3], opacity: f64) -> Label {
    Label { name, transfer_function: TransferFunction { knots: vec![Knot::new(0.0, color, opacity)] } }
}

/// The label with every knot recoloured.
fn recolored(label: &Label, color: impl Fn([f64; 3]) -> [f64; 3], opacity: impl Fn(f64) -> f64) -> Label {
    let mut label = label.clone();
    if label.transfer_function.knots.is_empty() {
        label.transfer_function.knots.push(Knot::new(0.0, [1.0; 3], 0.0));
    }
    for knot in &mut label.transfer_function.knots {
        (knot.color, knot.opacity) = (color(knot.color), opacity(knot.opacity).clamp(0.0, 1.0));
        if let Some(right) = &mut knot.right {
            (right.color, right.opacity) = (color(right.color), opacity(right.opacity).clamp(0.0, 1.0));
        }
    }
    label
}
