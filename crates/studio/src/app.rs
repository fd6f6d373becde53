//! The window: menu bar, dockable panels, status line, keyboard.

use std::path::PathBuf;
use std::sync::Arc;

use egui::{Key, KeyboardShortcut, Modifiers};
use egui_tiles::{Tree, UiResponse};
use rayloom_processors::registry;

use crate::device::Complaints;
use crate::dialogs::Chooser;
use crate::display::{Display, gpu_of};
use crate::engine::Engine;
use crate::files::{self, Files, Folders};
use crate::panels::{self, Pane, Panels};
use crate::session::{Mode, Session, Severity};
use crate::theme;
use crate::visualization::Application;

const NEW: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::N);
const OPEN: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::O);
const SAVE: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::S);
const SAVE_AS: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::S);
const UNDO: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Z);
const REDO: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
const REDO_TOO: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Y);
const QUIT: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Q);
const SWITCH_MODE: KeyboardShortcut = KeyboardShortcut::new(Modifiers::NONE, Key::F5);

/// What to start with.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The network to open.
    pub network: Option<PathBuf>,
    /// The mode to start in.
    pub mode: Mode,
    /// Whom to ask for files.
    pub chooser: Chooser,
    /// Where to keep what belongs to the user; with none, nothing is kept.
    pub folders: Option<Folders>,
}

/// The application.
pub struct Studio {
    /// What the panels share.
    pub session: Session,
    files: Files,
    panels: Panels,
    tiles: Tree<Pane>,
    complaints: Complaints,
}

impl Studio {
    /// The application on a window's device.
    ///
    /// # Errors
    /// The window has no device, or it cannot be used.
    pub fn new(
        creation: &eframe::CreationContext<'_>,
        options: &Options,
    ) -> Result<Self, Box<dyn std::error::Error + Send + Sync>> {
        let renderer = creation.wgpu_render_state.as_ref().ok_or("the window has no graphics device")?;
        let gpu = gpu_of(renderer);
        let complaints = Complaints::of(&gpu.device);
        let context = creation.egui_ctx.clone();
        let engine = Engine::start(gpu.clone(), move || context.request_repaint())?;
        let display = Display::new(gpu, renderer.clone());
        theme::apply(&creation.egui_ctx);
        let mut session = Session::new(Arc::new(registry()), engine, display);
        session.mode = options.mode;
        session.chooser = options.chooser.clone();
        let (document, warnings, failure) = files::first_document(options.network.as_deref(), &session.registry);
        session.show(document, &warnings);
        if let Some(failure) = failure {
            session.tell(Severity::Error, failure.to_string());
        }
        let files = Files::new(options.folders.as_ref(), &mut session, &creation.egui_ctx);
        let tiles = panels::default_layout();
        Ok(Self { session, files, panels: Panels::default(), tiles, complaints })
    }

    fn shortcuts(&mut self, context: &egui::Context) {
        if self.files.is_asking() {
            return;
        }
        let pressed = |shortcut| context.input_mut(|input| input.consume_shortcut(&shortcut));
        // Those with Shift first: a shortcut also matches when more modifiers are held.
        if pressed(REDO) || pressed(REDO_TOO) {
            self.session.document.redo();
        }
        if pressed(UNDO) {
            self.session.document.undo();
        }
        if pressed(SAVE_AS) {
            self.files.save_as(&mut self.session, context);
        }
        if pressed(SAVE) {
            self.files.save(&mut self.session, context);
        }
        if pressed(NEW) {
            self.files.new_network(&mut self.session, context);
        }
        if pressed(OPEN) {
            self.files.choose(&mut self.session, context);
        }
        if pressed(QUIT) {
            self.files.quit(&mut self.session, context);
        }
        if pressed(SWITCH_MODE) {
            self.switch_mode();
        }
    }

    fn switch_mode(&mut self) {
        self.session.mode = match self.session.mode {
            Mode::Development => Mode::Visualization,
            Mode::Visualization if Application::of(self.session.network()).0.locked => {
                self.session
                    .tell(Severity::Note, "this file is locked in visualization mode; open it in development mode");
                Mode::Visualization
            }
            Mode::Visualization => Mode::Development,
        };
    }

    fn menu_bar(&mut self, ui: &mut egui::Ui) {
        egui::MenuBar::new().ui(ui, |ui| {
            ui.menu_button("File", |ui| {
                let item = |ui: &mut egui::Ui, text: &str, shortcut: KeyboardShortcut| {
                    let shortcut = ui.ctx().format_shortcut(&shortcut);
                    ui.add(egui::Button::new(text).shortcut_text(shortcut)).clicked()
                };
                let context = ui.ctx().clone();
                let (files, session) = (&mut self.files, &mut self.session);
                if item(ui, "New", NEW) {
                    files.new_network(session, &context);
                }
                if item(ui, "Open...", OPEN) {
                    files.choose(session, &context);
                }
                ui.separator();
                if item(ui, "Save", SAVE) {
                    files.save(session, &context);
                }
                if item(ui, "Save as...", SAVE_AS) {
                    files.save_as(session, &context);
                }
                ui.separator();
                if item(ui, "Quit", QUIT) {
                    files.quit(session, &context);
                }
            });
            ui.menu_button("Edit", |ui| {
                let document = &mut self.session.document;
                let undo = document.undo_label().map(|label| format!("Undo {label}"));
                if ui.add_enabled(undo.is_some(), egui::Button::new(undo.as_deref().unwrap_or("Undo"))).clicked() {
                    document.undo();
                }
                let redo = document.redo_label().map(|label| format!("Redo {label}"));
                if ui.add_enabled(redo.is_some(), egui::Button::new(redo.as_deref().unwrap_or("Redo"))).clicked() {
                    document.redo();
                }
            });
            ui.menu_button("View", |ui| {
                if ui.button("Visualization mode (F5)").clicked() {
                    self.switch_mode();
                }
                if ui.button("Accuracy").on_hover_text("Compare the picture with an exact one.").clicked() {
                    self.session.to_open.push(Pane::Accuracy);
                }
                if ui.button("Frame budget").on_hover_text("What every processor took, and why it ran.").clicked() {
                    self.session.to_open.push(Pane::Budget);
                }
                if ui.button("Application").on_hover_text("What visualization mode shows").clicked() {
                    self.session.to_open.push(Pane::Application);
                }
                if ui.button("Default layout").clicked() {
                    self.tiles = panels::default_layout();
                }
                egui::global_theme_preference_buttons(ui);
            });
        });
    }

    fn status_line(&self, ui: &mut egui::Ui) {
        ui.horizontal(|ui| {
            let engine = &self.session.engine;
            let report = &engine.results.report;
            let failed = report.failed.len();
            if engine.is_busy() {
                ui.spinner();
                if let Some((id, progress)) = engine.progress.iter().next() {
                    ui.label(format!("{id}: {} %", 100 * progress.done / progress.total.max(1)));
                }
            } else if failed > 0 {
                ui.colored_label(theme::ERROR, format!("{failed} failed"));
            } else if !report.not_ready.is_empty() {
                ui.colored_label(theme::WARNING, format!("{} not ready", report.not_ready.len()));
            } else {
                ui.label("ready");
            }
            if let Some(working) = self.files.working() {
                ui.separator();
                ui.label(working);
            }
            ui.separator();
            ui.label(format!("{:.0} ms", report.elapsed.as_secs_f64() * 1e3));
            let divisor = self.session.quality.divisor();
            if divisor > 1 {
                ui.separator();
                ui.label(format!("1/{divisor} resolution while something moves"));
            }
            if let Some(message) = self.session.messages.last()
                && message.when.elapsed().as_secs() < 10
            {
                ui.separator();
                ui.label(message.text.lines().next().unwrap_or_default());
            }
        });
    }

    fn title(&self) -> String {
        let document = &self.session.document;
        let mark = if document.is_modified() { "*" } else { "" };
        format!("{}{mark} - Rayloom", document.title())
    }
}

/// Lets the tiles show their panes.
struct Behavior<'a> {
    session: &'a mut Session,
    panels: &'a mut Panels,
}

impl egui_tiles::Behavior<Pane> for Behavior<'_> {
    fn tab_title_for_pane(&mut self, pane: &Pane) -> egui::WidgetText {
        pane.title().into()
    }

    fn pane_ui(&mut self, ui: &mut egui::Ui, _: egui_tiles::TileId, pane: &mut Pane) -> UiResponse {
        ui.painter().rect_filled(ui.max_rect(), 0.0, ui.visuals().panel_fill);
        self.panels.show(pane, ui, self.session);
        UiResponse::None
    }

    fn is_tab_closable(&self, tiles: &egui_tiles::Tiles<Pane>, tile: egui_tiles::TileId) -> bool {
        matches!(tiles.get_pane(&tile), Some(Pane::Inspector(_) | Pane::Accuracy | Pane::Budget | Pane::Application))
    }

    fn simplification_options(&self) -> egui_tiles::SimplificationOptions {
        egui_tiles::SimplificationOptions { all_panes_must_have_tabs: true, ..Default::default() }
    }
}

impl eframe::App for Studio {
    fn ui(&mut self, ui: &mut egui::Ui, _: &mut eframe::Frame) {
        let context = ui.ctx().clone();
        self.session.begin_frame();
        self.files.begin_frame(&mut self.session, &context);
        if std::mem::take(&mut self.session.is_new) {
            self.panels = Panels::default();
        }
        for complaint in self.complaints.take() {
            self.session.tell(Severity::Error, format!("the graphics device complains: {complaint}"));
        }
        self.shortcuts(&context);
        if self.session.mode == Mode::Development {
            egui::Panel::top("menu").show(ui, |ui| self.menu_bar(ui));
            egui::Panel::bottom("status").show(ui, |ui| self.status_line(ui));
        }
        self.files.bars(ui, &mut self.session);
        egui::CentralPanel::default().frame(egui::Frame::new()).show(ui, |ui| match self.session.mode {
            Mode::Development => {
                let mut behavior = Behavior { session: &mut self.session, panels: &mut self.panels };
                self.tiles.ui(&mut behavior, ui);
            }
            Mode::Visualization => self.panels.visualization(ui, &mut self.session),
        });
        self.files.show(&mut self.session, &context);
        for pane in std::mem::take(&mut self.session.to_open) {
            panels::open(&mut self.tiles, pane);
        }
        self.files.end_frame(&mut self.session);
        self.session.end_frame(&context);
        context.send_viewport_cmd(egui::ViewportCommand::Title(self.title()));
    }
}
