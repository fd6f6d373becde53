//! The window: menu bar, dockable panels, status line, keyboard.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use egui_tiles::{Tree, UiResponse};
use rayloom_network::Address;
use rayloom_processors::{Process, registry};

use crate::commands::{self, KeyList};
use crate::device::{Complaints, LOST};
use crate::dialogs::Chooser;
use crate::display::{Display, gpu_of};
use crate::engine::Engine;
use crate::files::{self, Files, Folders, Preferences, Settings};
use crate::inspect::text::number;
use crate::palette::{Chosen, Palette};
use crate::pane::Pane;
use crate::panels::{self, Panels};
use crate::probe::traversals;
use crate::screenshot::Screenshot;
use crate::session::{Mode, Session, Severity};
use crate::theme;
use crate::visualization::Application;
use crate::welcome::{self, Welcome};

/// How long the status line shows a message.
const MESSAGE_SHOWN: Duration = Duration::from_secs(10);

/// Makes processors.
pub type MoreProcessors = fn() -> Vec<Arc<dyn Process>>;

/// What to start with.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The network to open.
    pub network: Option<PathBuf>,
    /// The mode to start in; with none, an application is shown as such and any other network in development mode.
    pub mode: Option<Mode>,
    /// Whom to ask for files.
    pub chooser: Chooser,
    /// Where to keep what belongs to the user; with none, nothing is kept.
    pub folders: Option<Folders>,
    /// Where the networks are that come with the program.
    pub shipped: Option<PathBuf>,
    /// Whether to begin with the welcome page.
    pub welcome: bool,
    /// Makes processors that there are besides those of the program.
    pub more_processors: Option<MoreProcessors>,
}

/// The application.
pub struct Studio {
    /// What the panels share.
    pub session: Session,
    pub(crate) files: Files,
    pub(crate) panels: Panels,
    pub(crate) tiles: Tree<Pane>,
    pub(crate) palette: Palette,
    pub(crate) key_list: KeyList,
    preferences: Preferences,
    pub(crate) welcome: Welcome,
    pub(crate) screenshot: Screenshot,
    complaints: Complaints,
    shown_title: String,
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
        let more = options.more_processors.map(|make| make()).unwrap_or_default();
        let mut registry = registry();
        more.iter().try_for_each(|process| registry.add(process.clone()))?;
        let engine = Engine::start(gpu.clone(), more, move || context.request_repaint())?;
        let display = Display::new(gpu, renderer.clone());
        theme::apply(&creation.egui_ctx);
        // Its keys are commands of the table like all others.
        creation.egui_ctx.options_mut(|options| options.zoom_with_keyboard = false);
        let mut session = Session::new(Arc::new(registry), engine, display);
        session.chooser = options.chooser.clone();
        let (document, warnings, failure) = files::first_document(options.network.as_deref(), &session.registry);
        session.show(document, &warnings);
        session.mode = options.mode.unwrap_or_else(|| Application::mode_of(session.network()));
        if let Some(failure) = failure {
            session.tell(Severity::Error, failure.to_string());
        }
        let files = Files::new(options.folders.as_ref(), &mut session, &creation.egui_ctx);
        let (settings, problems) = options.folders.as_ref().map(Settings::load).unwrap_or_default();
        problems.into_iter().for_each(|problem| session.tell(Severity::Note, problem));
        if options.folders.is_some() {
            settings.apply(&creation.egui_ctx);
        }
        let tiles = settings.layout.clone().unwrap_or_else(panels::default_layout);
        let cache = options.folders.as_ref().map(|folders| folders.cache.as_path());
        let mut welcome = Welcome::new(options.shipped.clone(), cache);
        if options.welcome {
            welcome.open(&session);
        }
        let preferences = Preferences::new(settings, options.folders.as_ref());
        Ok(Self {
            session,
            files,
            panels: Panels::default(),
            tiles,
            palette: Palette::default(),
            key_list: KeyList::default(),
            preferences,
            welcome,
            screenshot: Screenshot::default(),
            complaints,
            shown_title: String::new(),
        })
    }

    /// Whether a dialog lies over everything else: keys are meant for it.
    pub(crate) fn is_asking(&self, context: &egui::Context) -> bool {
        self.files.is_asking() || context.memory(|memory| memory.top_modal_layer().is_some())
    }

    pub(crate) fn switch_mode(&mut self) {
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

    /// Shows what lies over the panels, and does what was chosen there.
    fn overlays(&mut self, context: &egui::Context) {
        if std::mem::take(&mut self.session.wants_palette) {
            self.palette.open();
        }
        match Palette::show(self, context) {
            Some(Chosen::Processor(type_id)) => {
                self.panels.network.add_at_pointer(type_id, context, &mut self.session);
            }
            Some(Chosen::Command(command)) => command.run(self, context),
            None => {}
        }
        self.key_list.show(context);
        self.screenshot.show(context, &mut self.session);
        self.files.show(&mut self.session, context);
        self.session.chooser.show(context);
    }

    fn welcome_page(&mut self, ui: &mut egui::Ui) {
        let context = ui.ctx().clone();
        let recent = self.files.recent(&context);
        let choice = self.welcome.show(ui, &self.session, recent);
        let (files, session) = (&mut self.files, &mut self.session);
        match choice {
            Some(welcome::Choice::New) if session.network().processors().next().is_none() => self.welcome.close(),
            Some(welcome::Choice::New) => files.new_network(session, &context),
            Some(welcome::Choice::Choose) => files.choose(session, &context),
            Some(welcome::Choice::Open(path)) => files.open(&path, session, &context),
            None => {}
        }
    }

    fn status_line(&mut self, ui: &mut egui::Ui) {
        ui.horizontal(|ui| {
            let engine = &self.session.engine;
            let report = &engine.results.report;
            let failed = report.failed.len();
            if let Some((id, unfinished)) = engine.refining() {
                ui.spinner();
                let percent = (100.0 * unfinished.share).floor();
                ui.label(format!("refining {id}: {percent} %")).on_hover_text(&unfinished.message);
            } else if engine.is_busy() {
                ui.spinner();
                if let Some((id, progress)) = engine.progress.iter().next() {
                    ui.label(format!("{id}: {} %", 100 * progress.done / progress.total.max(1)));
                }
            } else if failed > 0 {
                theme::colored(ui, theme::ERROR, format!("{failed} failed"));
            } else if !report.not_ready.is_empty() {
                theme::colored(ui, theme::WARNING, format!("{} not ready", report.not_ready.len()));
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
            self.judgement(ui);
            if let Some(message) = self.session.messages.last()
                && let Some(rest) = MESSAGE_SHOWN.checked_sub(message.when.elapsed())
            {
                ui.ctx().request_repaint_after(rest);
                ui.separator();
                ui.label(message.text.lines().next().unwrap_or_default());
            }
        });
    }

    /// The estimated error of the picture in the first canvas in sight, and how many of its samples count.
    fn judgement(&mut self, ui: &mut egui::Ui) {
        let session = &mut self.session;
        let canvas = session.engine.results.canvases.keys().next();
        let traversal = canvas.and_then(|canvas| traversals(session.network(), canvas).into_iter().next());
        let Some(traversal) = traversal.filter(|_| session.estimating) else { return };
        // Where there is no estimate, the failure of the same traversal is told as such.
        let Some(Ok(judgement)) = session.judgement(ui.ctx(), &Address::new(traversal, "image")) else { return };
        ui.separator();
        let error = number(judgement.estimate.rmse);
        let text = format!("error about {error}, {:.0} % of the samples count", 100.0 * judgement.contributing);
        let help = "Root mean square error of the picture, estimated from pictures with half and twice the sampling rate; \
                    click to compare it with an exact one.";
        if ui.add(egui::Label::new(text).sense(egui::Sense::click())).on_hover_text(help).clicked() {
            session.to_open.push(Pane::Accuracy);
        }
    }

    fn title(&self) -> String {
        let document = &self.session.document;
        // Drawn by the window manager, so it is seen even when nothing else is.
        if self.complaints.is_lost() {
            return format!("{} - graphics device lost, save and restart - Rayloom", document.title());
        }
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
        matches!(
            tiles.get_pane(&tile),
            Some(
                Pane::Inspector(_)
                    | Pane::Accuracy
                    | Pane::RayProbe
                    | Pane::Shader(_)
                    | Pane::Budget
                    | Pane::Application
            )
        )
    }

    fn simplification_options(&self) -> egui_tiles::SimplificationOptions {
        egui_tiles::SimplificationOptions { all_panes_must_have_tabs: true, ..Default::default() }
    }
}

impl eframe::App for Studio {
    fn ui(&mut self, ui: &mut egui::Ui, _: &mut eframe::Frame) {
        let context = ui.ctx().clone();
        self.session.begin_frame();
        self.session.look_first(&context);
        self.files.begin_frame(&mut self.session, &context);
        if std::mem::take(&mut self.session.is_new) {
            self.panels.forget();
        }
        for complaint in self.complaints.take() {
            self.session.tell(Severity::Error, format!("graphics: {complaint}"));
        }
        commands::run_pressed(self, &context);
        if self.session.mode == Mode::Development {
            let chosen = egui::Panel::top("menu").show(ui, |ui| commands::menu_bar(ui, self)).inner;
            if let Some(command) = chosen {
                command.run(self, &context);
            }
            egui::Panel::bottom("status").show(ui, |ui| self.status_line(ui));
        }
        if self.complaints.is_lost() {
            egui::Panel::top("lost").show(ui, |ui| theme::colored(ui, theme::ERROR, format!("Error: {LOST}.")));
        }
        self.files.bars(ui, &mut self.session);
        self.welcome.follow(&self.session, &context);
        egui::CentralPanel::default().frame(egui::Frame::new()).show(ui, |ui| match self.session.mode {
            Mode::Development if self.welcome.is_open() => self.welcome_page(ui),
            Mode::Development => {
                let mut behavior = Behavior { session: &mut self.session, panels: &mut self.panels };
                self.tiles.ui(&mut behavior, ui);
            }
            Mode::Visualization => self.panels.visualization(ui, &mut self.session),
        });
        self.overlays(&context);
        for pane in std::mem::take(&mut self.session.to_open) {
            panels::open(&mut self.tiles, pane);
        }
        self.files.end_frame(&mut self.session);
        if let Some(problem) = self.preferences.follow(&context, &self.tiles) {
            self.session.tell(Severity::Error, problem);
        }
        self.session.end_frame(&context);
        let title = self.title();
        // A command for the window brings about another frame: one in every frame would never let it rest.
        if title != self.shown_title {
            context.send_viewport_cmd(egui::ViewportCommand::Title(title.clone()));
            self.shown_title = title;
        }
    }
}
