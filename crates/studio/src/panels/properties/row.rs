//! One row a property: name with help and menu, editor, what is wrong with it, reset.

use egui::{Align, Layout, RichText, Sense, Ui, UiBuilder, Vec2};
use rayloom_network::{Address, PropertyDecl, PropertyKind};

use super::action::Action;
use super::editor::{self, Surroundings};
use super::link;
use super::outline::{Entry, IDLE};

/// Height of a row.
pub(super) const HEIGHT: f32 = 20.0;
/// Share of the width that names take.
const NAMES: f32 = 0.38;
/// Width kept for the mark that resets.
const MARK: f32 = 16.0;
/// Width of the button that opens a text.
const TOGGLE: f32 = 20.0;
/// How far parameters of a snippet are moved in.
const INDENT: f32 = 10.0;

/// A headed part that can be closed.
pub(super) fn section(ui: &mut Ui, title: &str, body: impl FnOnce(&mut Ui)) {
    ui.add_space(4.0);
    let heading = RichText::new(title).size(11.5).color(ui.visuals().weak_text_color());
    egui::CollapsingHeader::new(heading).id_salt(title).default_open(title != IDLE).show_unindented(ui, body);
}

/// A property with what belongs to it.
pub(super) fn show_entry(ui: &mut Ui, entry: &Entry, surroundings: &mut Surroundings<'_>) {
    show(ui, &entry.decl, entry.text.as_ref(), 0.0, surroundings);
    if entry.parameters.is_empty() {
        return;
    }
    let left = ui.cursor().left() + 3.0;
    let top = ui.cursor().top();
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        ui.add_space(INDENT);
        ui.vertical(|ui| {
            ui.spacing_mut().item_spacing.x = 6.0;
            for decl in &entry.parameters {
                show(ui, decl, None, INDENT, surroundings);
            }
        });
    });
    let bottom = ui.cursor().top() - ui.spacing().item_spacing.y;
    ui.painter().vline(left, top..=bottom, ui.visuals().widgets.noninteractive.bg_stroke);
}

/// A property, moved in by `indent`; `text` is the one that holds an edited text for the same slot.
fn show(
    ui: &mut Ui,
    decl: &PropertyDecl,
    text: Option<&PropertyDecl>,
    indent: f32,
    surroundings: &mut Surroundings<'_>,
) {
    let Some(value) = surroundings.properties.get(&decl.id).cloned() else { return };
    let address = Address::new(surroundings.processor, &decl.id);
    let changed = value != decl.default;
    ui.push_id(&decl.id, |ui| {
        let wide = is_wide(&decl.kind);
        let row = ui.horizontal(|ui| {
            ui.set_min_height(HEIGHT);
            let width = ui.available_width();
            let name_width = (NAMES * (width + indent)).clamp(70.0, 180.0) - indent;
            name(ui, decl, &address, if wide { width - MARK - 6.0 } else { name_width }, surroundings);
            if !wide {
                let toggle = if text.is_some() { TOGGLE + 6.0 } else { 0.0 };
                let width = ui.available_width() - MARK - 6.0 - toggle;
                let place = ui.available_rect_before_wrap().with_max_x(ui.cursor().left() + width);
                let layout = Layout::left_to_right(Align::Center);
                let edited = ui.scope_builder(UiBuilder::new().max_rect(place).layout(layout), |ui| {
                    ui.set_min_size(Vec2::new(width, HEIGHT));
                    editor::show(ui, decl, &value, surroundings)
                });
                surroundings.actions.extend(edited.inner.map(|value| Action::Set(address.clone(), value)));
            }
            if let Some(text) = text {
                super::shader_text::toggle(ui, text, TOGGLE, surroundings);
            }
            reset(ui, decl, &address, changed, surroundings);
        });
        if wide {
            let edited = editor::show(ui, decl, &value, surroundings);
            surroundings.actions.extend(edited.map(|value| Action::Set(address.clone(), value)));
        }
        let typed = super::as_text::show(ui, decl, surroundings);
        surroundings.actions.extend(typed.map(|value| Action::Set(address.clone(), value)));
        editor::complaint(ui, decl, row.response.rect, surroundings);
    });
}

/// Whether the editor takes the whole width, below the name.
fn is_wide(kind: &PropertyKind) -> bool {
    matches!(
        kind,
        PropertyKind::TransferFunction
            | PropertyKind::TransferFunction2D
            | PropertyKind::Labels
            | PropertyKind::Camera
            | PropertyKind::Light
            | PropertyKind::ShaderText { .. }
            | PropertyKind::Text { multiline: true }
    )
}

/// The name: help when hovered, menu when clicked, a mark when linked.
fn name(ui: &mut Ui, decl: &PropertyDecl, address: &Address, width: f32, surroundings: &mut Surroundings<'_>) {
    let (area, response) = ui.allocate_exact_size(Vec2::new(width, HEIGHT), Sense::click_and_drag());
    response
        .widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Button, true, format!("Menu of {}", decl.label)));
    let linked = surroundings.network.links().iter().any(|link| link.other(address).is_some());
    let color = match response.hovered() {
        true => ui.visuals().strong_text_color(),
        false => ui.visuals().text_color(),
    };
    let mark = if linked { 15.0 } else { 0.0 };
    if linked {
        let font = egui::FontId::proportional(11.0);
        ui.painter().text(area.left_center(), egui::Align2::LEFT_CENTER, "🔗", font, ui.visuals().hyperlink_color);
    }
    let font = egui::TextStyle::Body.resolve(ui.style());
    let mut job = egui::text::LayoutJob::simple_singleline(decl.label.clone(), font, color);
    job.wrap = egui::text::TextWrapping::truncate_at_width(width - mark);
    let galley = ui.painter().layout_job(job);
    let at = egui::pos2(area.left() + mark, area.center().y - galley.size().y / 2.0);
    ui.painter().galley(at, galley, color);
    if surroundings.authoring {
        link::drag(ui, decl, address, &response, surroundings);
    }
    let response = response.on_hover_ui(|ui| help(ui, decl, address, surroundings));
    let clicked = response.clicked() || response.secondary_clicked();
    let menu = egui::Popup::menu(&response).open_memory(clicked.then_some(egui::SetOpenCommand::Toggle));
    menu.show(|ui| link::menu(ui, decl, address, surroundings));
}

fn help(ui: &mut Ui, decl: &PropertyDecl, address: &Address, surroundings: &Surroundings<'_>) {
    ui.set_max_width(320.0);
    ui.strong(&decl.label);
    // The help of a slot lists all its snippets; the list of choices tells them better.
    if !decl.help.is_empty() && !matches!(decl.kind, PropertyKind::Snippet { .. }) {
        ui.label(&decl.help);
    }
    if let Some(range) = editor::range_text(&decl.kind) {
        ui.weak(range);
    }
    for other in surroundings.network.linked_with(address).iter().skip(1) {
        ui.weak(format!("linked with {other}"));
    }
    ui.weak(RichText::new(address.to_string()).monospace().size(11.0));
}

fn reset(ui: &mut Ui, decl: &PropertyDecl, address: &Address, changed: bool, surroundings: &mut Surroundings<'_>) {
    if !changed {
        ui.allocate_exact_size(Vec2::new(MARK, HEIGHT), Sense::hover());
        return;
    }
    let button = egui::Button::new(RichText::new("⟲").size(13.0).color(ui.visuals().weak_text_color()));
    let response = ui.add_sized([MARK, HEIGHT], button.frame(false));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Button, true, format!("Reset {}", decl.label)));
    if response.on_hover_text("Back to the default").clicked() {
        surroundings.actions.push(Action::Reset(address.clone()));
    }
}
