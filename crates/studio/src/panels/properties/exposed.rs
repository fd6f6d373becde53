//! Chosen properties of any processors, for visualization mode.

use std::path::Path;

use rayloom_network::PropertyDecl;

use super::editor::Surroundings;
use super::outline::Entry;
use super::{PropertiesPanel, row};
use crate::session::Session;
use crate::upstream;

impl PropertiesPanel {
    /// Shows properties, each by the id of its processor and a declaration, which may have a label and range of its own.
    pub fn show_these(&mut self, ui: &mut egui::Ui, session: &mut Session, properties: &[(String, PropertyDecl)]) {
        self.tools.begin_frame(ui.ctx());
        let mut actions = Vec::new();
        ui.spacing_mut().item_spacing = egui::vec2(6.0, 4.0);
        for (id, decl) in properties {
            let Some(processor) = session.network().processor(id) else { continue };
            let mut surroundings = Surroundings {
                processor: id,
                network: session.network(),
                properties: &processor.properties(),
                volume: upstream::volume(session.network(), &session.engine.results.outputs, id),
                marker: session.probe.marker(id),
                failure: session.engine.results.report.failed.get(id),
                folder: session.document.path().and_then(Path::parent),
                chooser: &session.chooser,
                authoring: false,
                tools: &mut self.tools,
                actions: &mut actions,
            };
            let entry = Entry { decl: decl.clone(), parameters: Vec::new(), text: None };
            ui.push_id(id, |ui| row::show_entry(ui, &entry, &mut surroundings));
        }
        self.apply(ui, session, actions);
    }
}
