//! The properties that are shown, in groups.

use egui::{DragValue, Frame, Margin, RichText, ScrollArea, Ui};
use rayloom_network::{Address, Network, PropertyDecl, PropertyKind};

use super::list::{self, List};
use super::{heading, line, mark};
use crate::theme;
use crate::visualization::{Application, Change, Exposed, Group, declared};

/// Ends of ranges beyond this are not offered.
const ENDLESS: f64 = 1e9;

/// How far from the value the first range of a logarithmic slider reaches.
const FACTOR: f64 = 4.0;

/// Shows the groups.
pub fn show(ui: &mut Ui, network: &Network, application: &Application, changes: &mut Vec<Change>) {
    heading(ui, "Properties", |ui| {
        if ui.button("Add group").clicked() {
            changes.push(Change::AddGroup(format!("Group {}", application.groups.len() + 1)));
        }
    });
    if application.groups.is_empty() {
        ui.weak("None yet. Choose some below, or \"Show in the application\" in the menu of a property's name.");
        picker(ui, network, application, 0, changes);
    }
    for (index, group) in application.groups.iter().enumerate() {
        ui.push_id(index, |ui| show_group(ui, network, application, (index, group), changes));
    }
}

fn show_group(
    ui: &mut Ui,
    network: &Network,
    application: &Application,
    (index, group): (usize, &Group),
    changes: &mut Vec<Change>,
) {
    let frame = Frame::new().fill(ui.visuals().faint_bg_color).corner_radius(4).inner_margin(Margin::symmetric(6, 5));
    let shown = frame.show(ui, |ui| {
        let head = ui.horizontal(|ui| {
            let name = format!("group {}", index + 1);
            if let Some(step) = list::handle(ui, List::Groups, (index, 0), &name) {
                changes.extend(index.checked_add_signed(step).map(|to| Change::MoveGroup(index, to)));
            }
            let width = ui.available_width() - 24.0;
            let title = line(ui, &format!("Title of {name}"), &group.title, "Title", width);
            changes.extend(title.map(|title| Change::TitleGroup(index, title)));
            if mark(ui, "✖", &format!("Remove {name}")) {
                changes.push(Change::RemoveGroup(index));
            }
        });
        let mut target = list::drop_at(ui, head.response.rect, List::Properties).map(|(from, _)| (from, 0));
        for (item, exposed) in group.properties.iter().enumerate() {
            let row =
                ui.push_id(exposed.property.to_string(), |ui| property(ui, network, (index, item), exposed, changes));
            let dropped = list::drop_at(ui, row.response.rect, List::Properties);
            target = target.or(dropped.map(|(from, after)| (from, item + usize::from(after))));
        }
        if let Some((from, item)) = target {
            changes.push(Change::MoveProperty(from, (index, item)));
        }
        picker(ui, network, application, index, changes);
    });
    if let Some(((from, _), after)) = list::drop_at(ui, shown.response.rect, List::Groups) {
        changes.push(Change::MoveGroup(from, list::landing(from, index, after)));
    }
}

/// A property: its label, and below it which one it is and what its slider reaches.
fn property(ui: &mut Ui, network: &Network, place: (usize, usize), exposed: &Exposed, changes: &mut Vec<Change>) {
    let address = &exposed.property;
    let decl = declared(network, address);
    ui.horizontal(|ui| {
        if let Some(step) = list::handle(ui, List::Properties, place, &address.to_string()) {
            // Before the one above, or before the one after the next.
            let before = if step < 0 { place.1.checked_sub(1) } else { Some(place.1 + 2) };
            changes.extend(before.map(|item| Change::MoveProperty(place, (place.0, item))));
        }
        let hint = decl.as_ref().map_or(address.item.as_str(), |decl| decl.label.as_str());
        let label = exposed.label.as_deref().unwrap_or_default();
        let typed = line(ui, &format!("Label of {address}"), label, hint, ui.available_width() - 24.0);
        changes.extend(typed.map(|label| Change::Label(place, Some(label).filter(|label| !label.is_empty()))));
        if mark(ui, "✖", &format!("Hide {address}")) {
            changes.push(Change::Hide(address.clone()));
        }
    });
    ui.horizontal_wrapped(|ui| {
        ui.add_space(20.0);
        ui.label(RichText::new(address.to_string()).weak().monospace().size(11.0));
        match &decl {
            Ok(decl) => range(ui, network, place, exposed, decl, changes),
            Err(problem) => drop(theme::colored(ui, theme::WARNING, problem)),
        }
    });
}

/// What a slider reaches, for numbers.
fn range(
    ui: &mut Ui,
    network: &Network,
    place: (usize, usize),
    exposed: &Exposed,
    decl: &PropertyDecl,
    changes: &mut Vec<Change>,
) {
    let Some([least, most]) = declared_range(&decl.kind) else { return };
    let address = &exposed.property;
    let Some([low, high]) = exposed.range else {
        let help = "Narrows what users can reach with the slider";
        if ui.small_button("limit").on_hover_text(help).clicked() {
            changes.push(Change::Range(place, Some(first_range(network, address, decl, [least, most]))));
        }
        return;
    };
    let mut ends = [low, high];
    let speed = (high - low).abs() * 0.01;
    let limits = [(least..=high, "Smallest"), (low..=most, "Largest")];
    for (end, (limits, word)) in ends.iter_mut().zip(limits) {
        let response = ui.add(DragValue::new(end).speed(speed).range(limits).max_decimals(6));
        ui.ctx().accesskit_node_builder(response.id, |node| node.set_label(format!("{word} {address}")));
        response.on_hover_text(format!("{word} value that users can reach"));
    }
    if ends != [low, high] {
        changes.push(Change::Range(place, Some(ends)));
    }
    if mark(ui, "✖", &format!("No limits for {address}")) {
        changes.push(Change::Range(place, None));
    }
}

fn declared_range(kind: &PropertyKind) -> Option<[f64; 2]> {
    match kind {
        PropertyKind::Float { range, .. } | PropertyKind::Vector { range, .. } => Some(*range),
        PropertyKind::Int { range, .. } => Some(range.map(|end| end as f64)),
        _ => None,
    }
}

/// A range to begin with: for logarithmic sliders a factor around the value; else the declared one, or from 0 to twice the
/// value where that has no ends.
fn first_range(network: &Network, address: &Address, decl: &PropertyDecl, [least, most]: [f64; 2]) -> [f64; 2] {
    let value = network.value(&address.processor, &address.item).and_then(|value| value.to_json().as_f64());
    let value = value.unwrap_or(1.0);
    let [low, high] = match decl.kind {
        PropertyKind::Float { logarithmic: true, .. } if value > 0.0 => [value / FACTOR, value * FACTOR],
        _ if least.abs() < ENDLESS && most.abs() < ENDLESS => [least, most],
        _ if value < 0.0 => [2.0 * value, 0.0],
        _ => [0.0, if value > 0.0 { 2.0 * value } else { 1.0 }],
    };
    [low.max(least), high.min(most)]
}

/// A menu of all properties that are not shown yet, by processor.
fn picker(ui: &mut Ui, network: &Network, application: &Application, group: usize, changes: &mut Vec<Change>) {
    let response = ui.menu_button("Add property", |ui| {
        for processor in network.processors() {
            let decls = processor.property_decls();
            let decls: Vec<_> =
                decls.iter().filter(|decl| !application.shows(&Address::new(processor.id(), &decl.id))).collect();
            if decls.is_empty() {
                continue;
            }
            ui.menu_button(processor.label().unwrap_or(processor.id()), |ui| {
                ScrollArea::vertical().max_height(420.0).show(ui, |ui| {
                    for decl in decls {
                        let address = Address::new(processor.id(), &decl.id);
                        let button = egui::Button::new(&decl.label).shortcut_text(&decl.id);
                        if ui.add(button).on_hover_text(&decl.help).clicked() {
                            changes.push(Change::Expose(address, group));
                            ui.close();
                        }
                    }
                });
            });
        }
    });
    let name = format!("Add property to group {}", group + 1);
    response.response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Button, true, &name));
}
