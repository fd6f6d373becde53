//! The menus of the canvas.

use egui::{Button, Pos2, ScrollArea, Ui};
use rayloom_network::{Address, Connection};

use super::action::Action;
use super::geometry::Geometry;
use crate::catalog;
use crate::session::Session;
use crate::wiring::{End, fits_into, fitting, followers};

/// A menu of the processors that a loose wire may end at.
pub struct LooseEnd {
    /// The other end.
    pub end: End,
    /// Where the wire was let go, on the canvas.
    pub at: Pos2,
    /// The same in the window.
    pub window: Pos2,
}

/// A menu of the properties that may follow one that was dropped on their node.
#[derive(Clone, Debug)]
pub struct LooseLink {
    /// The property that leads.
    pub leader: Address,
    /// The processor whose properties are offered.
    pub processor: String,
    /// Where it was dropped, in the window.
    pub window: Pos2,
}

fn item(ui: &mut Ui, text: &str, keys: &str) -> bool {
    let clicked = ui.add(Button::new(text).shortcut_text(keys)).clicked();
    if clicked {
        ui.close();
    }
    clicked
}

/// The menu of a node.
pub fn node(ui: &mut Ui, session: &Session, id: &str, actions: &mut Vec<Action>) {
    if item(ui, "Copy", "Ctrl+C") {
        actions.push(Action::Copy);
    }
    if item(ui, "Duplicate", "Ctrl+D") {
        actions.push(Action::Duplicate);
    }
    if item(ui, "Frame the selection", "G") {
        actions.push(Action::AddFrame(None));
    }
    ui.menu_button("Replace by", |ui| {
        types(ui, session, |type_id| actions.push(Action::Replace(id.to_owned(), type_id)));
    });
    ui.separator();
    if item(ui, "Delete", "Del") {
        actions.push(Action::Delete { reconnect: false });
    }
    if item(ui, "Delete and reconnect", "Shift+Del") {
        actions.push(Action::Delete { reconnect: true });
    }
}

/// The menu of a wire.
pub fn wire(ui: &mut Ui, session: &Session, wire: &Connection, geometry: &Geometry, actions: &mut Vec<Action>) {
    let network = session.network();
    let fitting: Vec<_> = session.registry.declarations().filter(|d| fits_into(network, d, wire).is_some()).collect();
    if !fitting.is_empty() {
        ui.menu_button("Insert", |ui| {
            for declaration in fitting {
                if item(ui, &declaration.label, "") {
                    let points = geometry.points(wire).unwrap_or_default();
                    let middle = points.get(points.len() / 2).copied().unwrap_or_default();
                    actions.push(Action::Insert(declaration.id.clone(), wire.clone(), middle));
                }
            }
        });
    }
    if item(ui, "Pin", "Middle click, P") {
        actions.push(Action::Pin(wire.from.clone()));
    }
    if item(ui, "Cut", "Alt+click") {
        actions.push(Action::Cut(wire.clone()));
    }
}

/// The properties that may follow one; `None` when one was chosen or the menu left.
pub fn loose_link(ui: &Ui, session: &Session, menu: LooseLink, actions: &mut Vec<Action>) -> Option<LooseLink> {
    let followers = followers(session.network(), &menu.leader, &menu.processor);
    let mut open = true;
    egui::Popup::new(ui.id().with("loose link"), ui.ctx().clone(), menu.window, ui.layer_id())
        .kind(egui::PopupKind::Menu)
        .layout(egui::Layout::top_down_justified(egui::Align::Min))
        .style(egui::containers::menu::menu_style)
        .open_bool(&mut open)
        .show(|ui| {
            ui.set_min_width(180.0);
            ui.weak(format!("follows {}", menu.leader));
            for (follower, decl) in &followers {
                if ui.button(&decl.label).on_hover_text(&decl.help).clicked() {
                    actions.push(Action::Link(menu.leader.clone(), follower.clone()));
                    ui.close();
                }
            }
            if followers.is_empty() {
                ui.label(format!("No property of {} can follow it.", menu.processor));
            }
        });
    open.then_some(menu)
}

/// The menu of the empty canvas; `at` is where it was opened.
pub fn canvas(ui: &mut Ui, session: &Session, at: Pos2, actions: &mut Vec<Action>) {
    ui.menu_button("Add", |ui| types(ui, session, |type_id| actions.push(Action::Add(type_id, at))));
    if item(ui, "Search...", "Space") {
        actions.push(Action::Palette);
    }
    if item(ui, "Add frame", "G") {
        actions.push(Action::AddFrame(Some(at)));
    }
    ui.separator();
    if item(ui, "Map", "M") {
        actions.push(Action::Map);
    }
    if item(ui, "Show all", "F") {
        actions.push(Action::Fit);
    }
    if item(ui, "Arrange", "L") {
        actions.push(Action::Arrange);
    }
    if item(ui, "Select all", "Ctrl+A") {
        actions.push(Action::SelectAll);
    }
}

/// All processor types, a menu for each task.
fn types(ui: &mut Ui, session: &Session, mut chosen: impl FnMut(String)) {
    for (task, declarations) in catalog::search(&session.registry, "") {
        ui.menu_button(task, |ui| {
            for declaration in declarations {
                if ui.button(&declaration.label).on_hover_text(&declaration.help).clicked() {
                    chosen(declaration.id.clone());
                    ui.close();
                }
            }
        });
    }
}

/// The processors that a loose wire may end at; `None` when one was chosen or the menu left.
pub fn loose_end(ui: &Ui, session: &Session, menu: LooseEnd, actions: &mut Vec<Action>) -> Option<LooseEnd> {
    let fits = fitting(&session.registry, session.network(), &menu.end);
    let mut open = true;
    egui::Popup::new(ui.id().with("loose end"), ui.ctx().clone(), menu.window, ui.layer_id())
        .kind(egui::PopupKind::Menu)
        .layout(egui::Layout::top_down_justified(egui::Align::Min))
        .style(egui::containers::menu::menu_style)
        .open_bool(&mut open)
        .show(|ui| {
            ui.set_min_width(180.0);
            let side = if matches!(menu.end, End::Outport(_)) { "into" } else { "from" };
            ui.weak(format!("{} {side}", menu.end.address()));
            ScrollArea::vertical().max_height(320.0).show(ui, |ui| {
                for fit in &fits {
                    if ui.button(format!("{}  ({})", fit.label, fit.port_label)).clicked() {
                        let (type_id, port) = (fit.declaration.to_owned(), fit.port.to_owned());
                        actions.push(Action::AddConnected(type_id, port, menu.end.clone(), menu.at));
                        ui.close();
                    }
                }
                if fits.is_empty() {
                    ui.label("No processor takes this.");
                }
            });
        });
    open.then_some(menu)
}
