//! The menu of a property: reset, links with properties of other processors, whether visualization mode shows it.

use egui::Ui;
use rayloom_network::{Address, Network, PropertyDecl};

use super::action::Action;
use super::editor::Surroundings;
use crate::session::Severity;
use crate::theme;
use crate::visualization::{Application, Change};

/// The menu behind a property's name.
pub(super) fn menu(ui: &mut Ui, decl: &PropertyDecl, address: &Address, surroundings: &mut Surroundings<'_>) {
    let changed = surroundings.properties.get(&decl.id) != Some(&decl.default);
    if ui.add_enabled(changed, egui::Button::new("Back to the default")).clicked() {
        surroundings.actions.push(Action::Reset(address.clone()));
        ui.close();
    }
    if ui.button("Copy the address").on_hover_text(format!("{address}, as `--set` takes it")).clicked() {
        ui.ctx().copy_text(address.to_string());
        ui.close();
    }
    if ui.button("Edit as text").on_hover_text("Type or paste the value").clicked() {
        super::as_text::open(decl, surroundings);
        ui.close();
    }
    if !surroundings.authoring {
        return;
    }
    ui.separator();
    expose(ui, address, surroundings);
    ui.separator();
    for link in surroundings.network.links() {
        if let Some(other) = link.other(address)
            && ui.button(format!("Cut the link with {other}")).clicked()
        {
            surroundings.actions.push(Action::Unlink(address.clone(), other.clone()));
            ui.close();
        }
    }
    ui.menu_button("Link with", |ui| {
        let fitting = fitting(surroundings.network, address, decl);
        if fitting.is_empty() {
            ui.weak("No other processor has a property that fits.");
        }
        for other in fitting {
            if ui.button(other.to_string()).on_hover_text("Takes the value from there and stays equal to it").clicked()
            {
                surroundings.actions.push(Action::Link(address.clone(), other));
                ui.close();
            }
        }
    });
}

/// Lets the name of a property be dragged onto another, here or on a node, which follows it then.
pub(super) fn drag(
    ui: &Ui,
    decl: &PropertyDecl,
    address: &Address,
    response: &egui::Response,
    surroundings: &mut Surroundings<'_>,
) {
    response.dnd_set_drag_payload(address.clone());
    if response.dragged() {
        let layer = ui.layer_id();
        let tooltip = egui::Tooltip::always_open(
            ui.ctx().clone(),
            layer,
            response.id.with("carried"),
            egui::PopupAnchor::Pointer,
        );
        tooltip.gap(12.0).show(|ui| ui.label(format!("{} leads; drop it on what follows", decl.label)));
    }
    let Some(leader) = response.dnd_hover_payload::<Address>().filter(|leader| **leader != *address) else { return };
    let verdict = surroundings.network.can_link(&leader, address);
    let color = if verdict.is_ok() { theme::READY } else { theme::ERROR };
    ui.painter().rect_stroke(response.rect, 3.0, egui::Stroke::new(1.5, color), egui::StrokeKind::Outside);
    if response.dnd_release_payload::<Address>().is_some() {
        surroundings.actions.push(match verdict {
            Ok(()) => Action::Link(address.clone(), (*leader).clone()),
            Err(refusal) => Action::Tell(Severity::Error, refusal.to_string()),
        });
    }
}

/// Shows the property in visualization mode, in a group to choose where there are several, or hides it there.
fn expose(ui: &mut Ui, address: &Address, surroundings: &mut Surroundings<'_>) {
    let (application, _) = Application::of(surroundings.network);
    let mut change = None;
    if application.shows(address) {
        if ui.button("Hide in the application").clicked() {
            change = Some(Change::Hide(address.clone()));
        }
    } else if application.groups.len() < 2 {
        if ui.button("Show in the application").on_hover_text("Users of visualization mode can set it").clicked() {
            change = Some(Change::Expose(address.clone(), 0));
        }
    } else {
        ui.menu_button("Show in the application", |ui| {
            for (index, group) in application.groups.iter().enumerate() {
                if ui.button(&group.title).clicked() {
                    change = Some(Change::Expose(address.clone(), index));
                }
            }
        });
    }
    if let Some(change) = change {
        let verb = if matches!(change, Change::Hide(_)) { "hides" } else { "shows" };
        let text = format!("Visualization mode {verb} {address} now (View > Show application).");
        surroundings.actions.extend([Action::Author(change), Action::Tell(Severity::Note, text)]);
        ui.close();
    }
}

/// Properties of other processors that this one may be linked with; those of the same name first.
fn fitting(network: &Network, address: &Address, decl: &PropertyDecl) -> Vec<Address> {
    let others = network.processors().filter(|processor| processor.id() != address.processor);
    let mut found: Vec<Address> = others
        .flat_map(|processor| {
            let same_kind =
                |other: &PropertyDecl| std::mem::discriminant(&other.kind) == std::mem::discriminant(&decl.kind);
            let decls = processor.property_decls().into_iter().filter(move |other| same_kind(other));
            decls.map(|other| Address::new(processor.id(), other.id))
        })
        .filter(|other| network.can_link(other, address).is_ok())
        .collect();
    found.sort_by_key(|other| other.item != address.item);
    found
}
