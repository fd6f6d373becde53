//! The editor of a slot's text, with what the compiler says and the assembled shader beside it.

mod assembled;
pub(super) mod code;
mod save;

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use egui::{Button, RichText, Ui};
use rayloom_network::{Address, Mark, ProcessError, Properties, PropertyKind, Value};
use rayloom_processors::snippet_library;
use rayloom_wgsl::Slot;

use crate::session::Session;
use crate::theme;
use save::Saving;

/// Pause in typing after which a live text is applied.
const PAUSE: Duration = Duration::from_millis(400);

/// A place in the text that an error is about.
pub(super) struct Problem {
    /// The file.
    pub source: String,
    line: u32,
    column: u32,
    message: String,
}

impl std::fmt::Display for Problem {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { source, line, column, message } = self;
        write!(f, "{source}:{line}:{column}: {message}")
    }
}

/// One text being edited.
#[derive(Default)]
struct Editor {
    text: String,
    /// What was in use when the text was last the same.
    base: String,
    /// Whether it is applied while the user types.
    live: bool,
    /// When the user typed last, until that is applied.
    typed: Option<Instant>,
    /// Whether the assembled shader is shown beside it.
    assembled: Option<bool>,
    /// Line of the cursor, from 1.
    line: u32,
    /// Where to put the cursor: line and column, from 1.
    jump: Option<(u32, u32)>,
    saving: Saving,
}

/// What the panes remember, by the property that holds the text.
#[derive(Default)]
pub struct ShaderEditors {
    editors: BTreeMap<Address, Editor>,
}

impl ShaderEditors {
    /// Shows the text of a slot: the user's own in this processor, or that of the chosen snippet.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session, address: &Address) {
        let Some(known) = Place::find(session, address) else {
            ui.weak(format!("There is no `{address}` any more."));
            return;
        };
        let editor = self.editors.entry(address.clone()).or_default();
        editor.follow(&known);
        editor.apply_when_live(ui, session, address);
        egui::Frame::new().inner_margin(6).show(ui, |ui| editor.show(ui, session, address, &known));
    }
}

/// The slot that a text fills.
struct Place {
    slot: Slot,
    /// The property that chooses the snippet.
    chooser: String,
    label: String,
    /// The user's own text; empty when there is none.
    own: String,
    /// Path of what is in use in the library, and its text.
    path: String,
    source: String,
}

impl Place {
    fn find(session: &Session, address: &Address) -> Option<Self> {
        let processor = session.network().processor(&address.processor)?;
        let decl = processor.declaration()?.properties.iter().find(|decl| decl.id == address.item)?;
        let PropertyKind::ShaderText { slot } = &decl.kind else { return None };
        let slot = Slot::from_id(slot)?;
        let chooser = address.item.split('.').next()?.to_owned();
        let own = processor.properties().text(&address.item).ok()?.to_owned();
        let (path, source) = in_use(slot, &address.item, &own, &processor.properties());
        Some(Self { slot, chooser, label: decl.label.clone(), own, path, source })
    }
}

/// Path in the library and text of what fills a slot: the user's own text, or the chosen snippet.
pub(super) fn in_use(slot: Slot, property: &str, own: &str, properties: &Properties) -> (String, String) {
    let chooser = property.split('.').next().unwrap_or_default();
    if !own.trim().is_empty() {
        return (format!("edited/{chooser}.wgsl"), own.to_owned());
    }
    let library = snippet_library().0;
    let id = properties.text(chooser).unwrap_or_default();
    // One that is not known can only be the user's.
    let path = library.path(slot, id).map_or_else(|| format!("user/{id}.wgsl"), |path| path.to_string());
    let text = library.source(&path).map(|source| source.text.to_string()).unwrap_or_default();
    (path, text)
}

impl Editor {
    /// Takes in what was changed elsewhere: another snippet, its file, undo. What was typed and is not applied stays, and so does
    /// the text of a file that is no snippet at the moment.
    fn follow(&mut self, place: &Place) {
        if place.source != self.base && !place.source.is_empty() {
            let untouched = self.text == self.base;
            self.base.clone_from(&place.source);
            if untouched {
                self.text.clone_from(&place.source);
            }
        }
    }

    fn apply_when_live(&mut self, ui: &Ui, session: &mut Session, address: &Address) {
        let Some(typed) = self.typed.filter(|_| self.live) else { return };
        match PAUSE.checked_sub(typed.elapsed()) {
            Some(rest) if !rest.is_zero() => ui.ctx().request_repaint_after(rest),
            _ => self.apply(session, address),
        }
    }

    fn apply(&mut self, session: &mut Session, address: &Address) {
        self.typed = None;
        if self.text != self.base {
            session.set(&address.processor, &address.item, Value::Text(self.text.clone()));
            self.base.clone_from(&self.text);
        }
    }

    fn show(&mut self, ui: &mut Ui, session: &mut Session, address: &Address, place: &Place) {
        let problems = problems(session.engine.results.report.failed.get(&address.processor));
        self.bar(ui, session, address, place, &problems);
        self.saving.show(ui, session, address, place, &self.text);
        let shader = session.engine.results.shaders.get(&address.processor).cloned();
        let wide = ui.available_width() > 640.0;
        if let Some(shader) = shader.filter(|_| self.assembled.unwrap_or(wide)) {
            egui::Panel::right(ui.id().with(("assembled", address)))
                .default_size(0.45 * ui.available_width())
                .show(ui, |ui| assembled::show(ui, &shader.assembled, &place.path, self.line));
        }
        if !problems.is_empty() {
            egui::Panel::bottom(ui.id().with(("problems", address))).show(ui, |ui| self.list(ui, place, &problems));
        }
        let own: Vec<&Problem> = problems.iter().filter(|problem| problem.source == place.path).collect();
        if code::show(ui, &place.label, &mut self.text, &own, &mut self.line, self.jump.take()) {
            self.typed = Some(Instant::now());
        }
    }

    fn bar(&mut self, ui: &mut Ui, session: &mut Session, address: &Address, place: &Place, problems: &[Problem]) {
        ui.horizontal_wrapped(|ui| {
            let changed = self.text != self.base;
            let apply = ui.add_enabled(changed, Button::new("Apply"));
            if apply.on_hover_text("Use this text in this processor; it is stored in the network").clicked() {
                self.apply(session, address);
            }
            ui.toggle_value(&mut self.live, "Live").on_hover_text("Apply while typing, after a pause");
            if ui.add_enabled(changed, Button::new("Discard")).on_hover_text("Back to what is in use").clicked() {
                self.text.clone_from(&self.base);
                self.typed = None;
            }
            let revert = ui.add_enabled(!place.own.is_empty(), Button::new("Revert"));
            if revert.on_hover_text("Back to the chosen snippet").clicked() {
                self.typed = None;
                session.set(&address.processor, &address.item, Value::Text(String::new()));
            }
            self.saving.button(ui, place);
            let wide = ui.available_width() > 640.0;
            let mut assembled = self.assembled.unwrap_or(wide);
            if ui
                .toggle_value(&mut assembled, "Assembled")
                .on_hover_text("The shader that this text is a part of")
                .changed()
            {
                self.assembled = Some(assembled);
            }
            let (state, color) = match (problems.is_empty(), changed, place.own.is_empty()) {
                (false, _, _) => ("the last good picture stays", theme::ERROR),
                (true, true, _) => ("not applied", theme::WARNING),
                (true, false, true) => (place.path.as_str(), ui.visuals().weak_text_color()),
                (true, false, false) => ("in use in this processor", theme::READY),
            };
            ui.label(RichText::new(state).size(11.5).color(theme::ink(ui.visuals(), color)));
        });
    }

    /// The errors; a click goes to the place.
    fn list(&mut self, ui: &mut Ui, place: &Place, problems: &[Problem]) {
        egui::ScrollArea::vertical().max_height(84.0).show(ui, |ui| {
            for problem in problems {
                let text = RichText::new(problem.to_string())
                    .monospace()
                    .size(11.0)
                    .color(theme::ink(ui.visuals(), theme::ERROR));
                let label = egui::Label::new(text).sense(egui::Sense::click());
                if ui.add(label).clicked() && problem.source == place.path {
                    self.jump = Some((problem.line.max(1), problem.column.max(1)));
                }
            }
        });
    }
}

/// What the compiler says about a processor's shader.
pub(super) fn problems(failure: Option<&ProcessError>) -> Vec<Problem> {
    let problem = |mark: &Mark| Problem {
        source: mark.source.clone(),
        line: mark.line,
        column: mark.column,
        message: mark.message.clone(),
    };
    failure.iter().flat_map(|failure| &failure.marks).map(problem).collect()
}
