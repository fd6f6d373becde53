//! The window in visualization mode: canvases, and what the author exposed.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Duration;

use egui::{Rect, UiBuilder, Vec2};
use rayloom_network::{Address, Preset, PropertyDecl};
use serde_json::Value as Json;

use super::{Application, Layout};
use crate::panels::canvas::CanvasPanel;
use crate::panels::properties::PropertiesPanel;
use crate::session::Session;
use crate::theme;

/// Width of the side panel, points.
const SIDE: f32 = 320.0;
/// Gap between canvases, points.
const GAP: f32 = 2.0;

/// Share of the window that a large canvas takes.
const LARGE: f32 = 0.7;

/// How long a message stays.
const SHOWN: Duration = Duration::from_secs(8);

/// What the mode remembers.
#[derive(Default)]
pub struct Visualization {
    revision: Option<u64>,
    application: Application,
    problems: Vec<String>,
    groups: Vec<(String, Vec<(String, PropertyDecl)>)>,
    /// What the exposed properties were when the file was opened.
    first: Option<(Option<PathBuf>, BTreeMap<Address, Json>)>,
    canvases: BTreeMap<String, CanvasPanel>,
    properties: PropertiesPanel,
}

impl Visualization {
    /// Shows canvases in all of the window and the exposed properties beside them.
    pub fn show(&mut self, ui: &mut egui::Ui, session: &mut Session) {
        self.update(session);
        let is_empty = self.groups.is_empty() && self.application.presets.is_empty() && self.problems.is_empty();
        if !is_empty {
            egui::Panel::right("application").resizable(true).default_size(SIDE).show(ui, |ui| {
                egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                    egui::Frame::new().inner_margin(12).show(ui, |ui| self.side(ui, session));
                });
            });
        }
        let area = ui.available_rect_before_wrap();
        self.grid(ui, session);
        latest_message(ui, area, session);
    }

    /// Reads the application again when the network changed.
    fn update(&mut self, session: &Session) {
        let revision = session.document.revision();
        if self.revision == Some(revision)
            && self.first.as_ref().is_some_and(|(path, _)| path.as_deref() == session.document.path())
        {
            return;
        }
        self.revision = Some(revision);
        let network = session.network();
        (self.application, self.problems) = Application::of(network);
        let shown = |exposed: &super::Exposed| Some((exposed.property.processor.clone(), exposed.decl(network)?));
        let groups = self.application.groups.iter();
        self.groups = groups
            .map(|group| (group.title.clone(), group.properties.iter().filter_map(shown).collect::<Vec<_>>()))
            .filter(|(_, properties)| !properties.is_empty())
            .collect();
        let path = session.document.path().map(ToOwned::to_owned);
        if self.first.as_ref().is_none_or(|(known, _)| *known != path) {
            let exposed = self.application.groups.iter().flat_map(|group| &group.properties);
            let set = self.application.presets.iter().flat_map(|preset| preset.values.keys());
            let addresses = exposed.map(|exposed| &exposed.property).chain(set);
            let value = |address: &Address| {
                Some((address.clone(), network.value(&address.processor, &address.item)?.to_json()))
            };
            self.first = Some((path, addresses.filter_map(value).collect()));
        }
    }

    fn side(&mut self, ui: &mut egui::Ui, session: &mut Session) {
        let network = session.network();
        if !network.name.is_empty() {
            ui.heading(&network.name);
        }
        if !network.description.is_empty() {
            ui.weak(&network.description);
        }
        ui.add_space(8.0);
        self.presets(ui, session);
        for (title, properties) in &self.groups {
            ui.add_space(10.0);
            ui.strong(title);
            ui.add_space(2.0);
            self.properties.show_these(ui, session, properties);
        }
        ui.add_space(12.0);
        for problem in &self.problems {
            theme::colored(ui, theme::WARNING, problem);
        }
        for (id, error) in &session.engine.results.report.failed {
            theme::report(ui, theme::ERROR, &format!("{id}: {error}"));
        }
        for reason in crate::panels::causes(&session.engine.results.report) {
            theme::colored(ui, theme::WARNING, reason);
        }
    }

    fn presets(&self, ui: &mut egui::Ui, session: &mut Session) {
        let mut chosen = None;
        ui.horizontal_wrapped(|ui| {
            for preset in &self.application.presets {
                if ui.button(&preset.name).clicked() {
                    chosen = Some(preset.clone());
                }
            }
            if let Some((_, values)) = &self.first
                && ui.button("Reset").on_hover_text("As it was when the file was opened.").clicked()
            {
                chosen = Some(Preset { name: "as opened".into(), values: values.clone() });
            }
        });
        if let Some(preset) = chosen {
            session.edit(&format!("preset {}", preset.name), |network| preset.apply(network));
        }
    }

    /// The canvases, as the author arranged them.
    fn grid(&mut self, ui: &mut egui::Ui, session: &mut Session) {
        let canvases: Vec<String> =
            self.application.shown_canvases(session.network()).into_iter().map(ToOwned::to_owned).collect();
        let area = ui.available_rect_before_wrap();
        let cells = match self.application.layout {
            Layout::Grid => cells(area, canvases.len()),
            Layout::FirstLarge => first_large(area, canvases.len()),
        };
        for (canvas, cell) in canvases.into_iter().zip(cells) {
            let panel = self.canvases.entry(canvas.clone()).or_default();
            ui.scope_builder(UiBuilder::new().max_rect(cell).id_salt(&canvas), |ui| {
                panel.show_one(ui, session, &canvas)
            });
        }
    }
}

/// What the user was told just now, over the canvases: there is no status line.
fn latest_message(ui: &egui::Ui, area: Rect, session: &Session) {
    let Some(message) = session.messages.last() else { return };
    let Some(rest) = SHOWN.checked_sub(message.when.elapsed()) else { return };
    ui.ctx().request_repaint_after(rest);
    let text = message.text.lines().next().unwrap_or_default().to_owned();
    let font = egui::FontId::proportional(13.0);
    let galley = ui.painter().layout(text, font, egui::Color32::WHITE, area.width() - 60.0);
    let place = egui::Align2::CENTER_BOTTOM.align_size_within_rect(galley.size(), area.shrink(22.0));
    ui.painter().rect_filled(place.expand2(Vec2::new(10.0, 6.0)), 5.0, egui::Color32::from_black_alpha(190));
    ui.painter().galley(place.min, galley, egui::Color32::WHITE);
}

/// Cells for pictures: as many columns as make them largest when they are about square.
fn cells(area: Rect, count: usize) -> Vec<Rect> {
    let side = |columns: usize| {
        let rows = count.div_ceil(columns);
        (area.width() / columns as f32).min(area.height() / rows as f32)
    };
    let columns = (1..=count.max(1)).max_by(|&a, &b| side(a).total_cmp(&side(b))).unwrap_or(1);
    let rows = count.div_ceil(columns);
    let size = Vec2::new(area.width() / columns as f32, area.height() / rows.max(1) as f32);
    let cell = |index: usize| {
        let place = Vec2::new((index % columns) as f32, (index / columns) as f32);
        Rect::from_min_size(area.min + place * size, size).shrink(if count > 1 { GAP / 2.0 } else { 0.0 })
    };
    (0..count).map(cell).collect()
}

/// A large cell, and the others in a column beside it, or in a row below it where the area is tall.
fn first_large(area: Rect, count: usize) -> Vec<Rect> {
    if count < 2 {
        return cells(area, count);
    }
    let wide = area.width() >= area.height();
    let (large, rest) = match wide {
        true => area.split_left_right_at_fraction(LARGE),
        false => area.split_top_bottom_at_fraction(LARGE),
    };
    let share = rest.size() / (count - 1) as f32;
    let small = |index: usize| match wide {
        true => {
            Rect::from_min_size(rest.min + Vec2::new(0.0, share.y * index as f32), Vec2::new(rest.width(), share.y))
        }
        false => {
            Rect::from_min_size(rest.min + Vec2::new(share.x * index as f32, 0.0), Vec2::new(share.x, rest.height()))
        }
    };
    [large].into_iter().chain((0..count - 1).map(small)).map(|cell| cell.shrink(GAP / 2.0)).collect()
}
