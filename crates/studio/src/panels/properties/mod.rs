//! The property panel: what the selected processors are, how they fare, and an editor for each of their properties,
//! generated from the declarations.

mod action;
mod as_text;
mod camera;
mod choice;
mod editor;
mod exchange;
mod exposed;
mod file;
mod header;
mod histograms;
mod labels;
mod light;
mod link;
mod number;
mod outline;
mod row;
mod shader_text;
mod text;
mod transfer_function;
mod transfer_function_2d;
mod vector;

use egui::{RichText, ScrollArea};
use rayloom_network::{Network, Processor, Properties, PropertyDecl};

use crate::session::Session;
use crate::upstream;
use action::Action;
use editor::{Surroundings, Tools};
use outline::{Entry, Section};

/// Declarations and values of the shown processors: asking a processor for them is not free.
#[derive(Default)]
struct Cache {
    revision: u64,
    processors: Vec<(String, Resolved)>,
}

/// A processor's properties in the order of the panel.
struct Resolved {
    sections: Vec<Section>,
    properties: Properties,
}

/// What the panel remembers.
#[derive(Default)]
pub struct PropertiesPanel {
    cache: Cache,
    tools: Tools,
    /// Whether a value is being dragged.
    dragging: bool,
}

impl PropertiesPanel {
    /// Shows the properties of the selected processors and lets the user edit them.
    pub fn show(&mut self, ui: &mut egui::Ui, session: &mut Session) {
        self.cache.update(session);
        self.tools.begin_frame(ui.ctx());
        let mut actions = Vec::new();
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            egui::Frame::new().inner_margin(egui::Margin { left: 10, right: 12, top: 8, bottom: 12 }).show(ui, |ui| {
                ui.spacing_mut().item_spacing = egui::vec2(6.0, 4.0);
                if self.cache.processors.is_empty() {
                    nothing_selected(ui, session.network(), &mut actions);
                }
                for (index, (id, resolved)) in self.cache.processors.iter().enumerate() {
                    if index > 0 {
                        ui.add_space(6.0);
                        ui.separator();
                    }
                    ui.push_id(id, |ui| show_processor(ui, session, id, resolved, &mut self.tools, &mut actions));
                }
            });
        });
        self.apply(ui, session, actions);
    }

    /// Pictures follow a dragged value more readily when they are small.
    fn apply(&mut self, ui: &egui::Ui, session: &mut Session, actions: Vec<Action>) {
        let held = ui.input(|input| input.pointer.any_down());
        self.dragging = held && (self.dragging || actions.iter().any(|action| matches!(action, Action::Set(..))));
        session.interacting |= self.dragging;
        action::apply(ui, session, actions);
    }
}

impl Cache {
    /// Resolves the selected processors again when the network or the selection changed.
    fn update(&mut self, session: &Session) {
        let revision = session.document.revision();
        let wanted = || session.selection.iter().filter(|id| session.network().processor(id).is_some());
        if self.revision == revision && wanted().eq(self.processors.iter().map(|(id, _)| id)) {
            return;
        }
        let network = session.network();
        let resolve = |id: &String| Some((id.clone(), Resolved::of(network, network.processor(id)?)));
        *self = Self { revision, processors: session.selection.iter().filter_map(resolve).collect() };
    }
}

impl Resolved {
    fn of(network: &Network, processor: &Processor) -> Self {
        let used = network.outputs(processor.id()).map(|connection| connection.from.item.clone()).collect();
        let idle = processor.idle_properties(&used);
        Self { sections: outline::sections(processor.property_decls(), &idle), properties: processor.properties() }
    }

    /// The processor's declared properties in the order of the panel.
    fn decls(&self) -> impl Iterator<Item = &PropertyDecl> {
        self.sections.iter().flat_map(|section| &section.entries).flat_map(Entry::decls)
    }
}

fn nothing_selected(ui: &mut egui::Ui, network: &Network, actions: &mut Vec<Action>) {
    ui.add_space(4.0);
    let mut processors = network.processors().peekable();
    if processors.peek().is_none() {
        ui.weak("The network is empty.");
        return;
    }
    ui.weak("Select a processor to see its properties.");
    ui.add_space(4.0);
    for processor in processors {
        let name = processor.label().unwrap_or(processor.id());
        let kind = processor.declaration().map_or(processor.type_id(), |declaration| &declaration.label);
        ui.horizontal(|ui| {
            if ui.link(RichText::new(name).strong()).clicked() {
                actions.push(Action::Select(processor.id().to_owned()));
            }
            ui.weak(kind);
        });
    }
}

fn show_processor(
    ui: &mut egui::Ui,
    session: &Session,
    id: &str,
    resolved: &Resolved,
    tools: &mut Tools,
    actions: &mut Vec<Action>,
) {
    header::show(ui, session, id, actions);
    let mut surroundings = Surroundings {
        processor: id,
        network: session.network(),
        properties: &resolved.properties,
        volume: upstream::volume(session.network(), &session.engine.results.outputs, id),
        marker: session.probe.marker(id),
        failure: session.engine.results.report.failed.get(id),
        folder: session.document.path().and_then(std::path::Path::parent),
        chooser: &session.chooser,
        authoring: true,
        tools,
        actions,
    };
    let titled = resolved.sections.len() > 1;
    for section in &resolved.sections {
        let body = |ui: &mut egui::Ui, surroundings: &mut Surroundings<'_>| {
            for entry in &section.entries {
                row::show_entry(ui, entry, surroundings);
            }
        };
        match titled {
            true => row::section(ui, section.title, |ui| body(ui, &mut surroundings)),
            false => body(ui, &mut surroundings),
        }
    }
    if resolved.decls().next().is_none() {
        ui.weak("It has no properties.");
    }
}
