//! The welcome page: what comes with the program, what was opened lately, and an empty network.

mod gallery;
mod shipped;
mod thumbnail;

use std::path::{Path, PathBuf};

use egui::{
    Align, Button, Context, CornerRadius, Image, Layout, Rect, RichText, ScrollArea, Sense, Stroke, StrokeKind, Ui,
    Vec2,
};

use crate::files::Recent;
use crate::session::Session;
use gallery::{Entry, Gallery};

pub use shipped::folder as shipped_folder;

/// Width of the column on the left.
const COLUMN: f32 = 250.0;
/// Narrowest card.
const CARD: f32 = 208.0;
/// Space around and between cards.
const GAP: f32 = 16.0;

/// What the user wants.
pub enum Choice {
    /// An empty network.
    New,
    /// A network that is asked for.
    Choose,
    /// This network, in this mode.
    Open(PathBuf),
}

/// The welcome page.
pub struct Welcome {
    /// Where the shipped networks are.
    networks: Option<PathBuf>,
    /// Where their pictures are kept.
    cache: Option<PathBuf>,
    gallery: Option<Gallery>,
    /// The revision of the document that the page hides; another one is shown.
    hides: Option<u64>,
}

impl Welcome {
    /// A page that is not shown yet.
    pub fn new(networks: Option<PathBuf>, cache: Option<&Path>) -> Self {
        let cache = cache.map(|cache| cache.join("thumbnails"));
        Self { networks, cache, gallery: None, hides: None }
    }

    /// Shows the page over the document, until that changes.
    pub fn open(&mut self, session: &Session) {
        self.hides = Some(session.document.revision());
    }

    /// Shows the document again.
    pub fn close(&mut self) {
        self.hides = None;
        if let Some(gallery) = &mut self.gallery {
            gallery.rest();
        }
    }

    /// Whether the page is shown.
    pub fn is_open(&self) -> bool {
        self.hides.is_some()
    }

    /// To be called every frame: closes the page when the document changed, or when a volume is dropped, which is for the
    /// network panel.
    pub fn follow(&mut self, session: &Session, context: &Context) {
        let dropped = context.input(|input| !input.raw.dropped_files.is_empty());
        if self.hides.is_some_and(|revision| dropped || revision != session.document.revision()) {
            self.close();
        }
    }

    /// Shows the page; what the user chose.
    pub fn show(&mut self, ui: &mut Ui, session: &Session, recent: &[Recent]) -> Option<Choice> {
        if self.gallery.as_mut().is_none_or(Gallery::ended_early)
            && let Some(folder) = &self.networks
        {
            let (folder, cache, registry) = (folder.clone(), self.cache.clone(), session.registry.clone());
            let gpu = session.display.gpu().clone();
            self.gallery = Some(Gallery::start(folder, cache, registry, gpu, ui.ctx()));
        }
        if let Some(gallery) = &mut self.gallery {
            gallery.listen(ui.ctx());
        }
        let mut choice = None;
        ui.painter().rect_filled(ui.max_rect(), 0.0, ui.visuals().panel_fill);
        let whole = ui.max_rect().shrink2(Vec2::new(36.0, 28.0));
        let (left, right) = whole.split_left_right_at_x(whole.left() + COLUMN);
        let top_down = Layout::top_down(Align::Min);
        ui.scope_builder(egui::UiBuilder::new().max_rect(left).layout(top_down), |ui| {
            beginnings(ui, recent, &mut choice);
        });
        let right = right.with_min_x(right.left() + 36.0);
        ui.scope_builder(egui::UiBuilder::new().max_rect(right).layout(top_down), |ui| {
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| match &self.gallery {
                Some(gallery) => cards(ui, &gallery.entries, &mut choice),
                None => drop(ui.weak("The networks that come with Rayloom are not beside the program.")),
            });
        });
        choice
    }
}

/// The name of the program, how to begin, and what was opened lately.
fn beginnings(ui: &mut Ui, recent: &[Recent], choice: &mut Option<Choice>) {
    ui.spacing_mut().item_spacing.y = 8.0;
    ui.label(RichText::new("Rayloom").size(30.0).strong());
    ui.label(RichText::new("A workbench for pictures of volumes").weak());
    ui.add_space(18.0);
    let wide = egui::vec2(ui.available_width(), 32.0);
    let fill = ui.visuals().selection.bg_fill;
    if ui.add_sized(wide, Button::new(RichText::new("New network").strong()).fill(fill)).clicked() {
        *choice = Some(Choice::New);
    }
    if ui.add_sized(wide, Button::new("Open a network...")).clicked() {
        *choice = Some(Choice::Choose);
    }
    ui.weak("or drop a network or a volume here");
    ui.add_space(22.0);
    heading(ui, "Recent");
    if recent.is_empty() {
        ui.weak("Nothing was opened yet.");
    }
    ui.spacing_mut().item_spacing.y = 4.0;
    for file in recent {
        let name = file.path.file_name().unwrap_or_default().to_string_lossy();
        let button = Button::new(name.as_ref()).frame(false).truncate();
        let response = ui.add_enabled(file.exists, button);
        let path = file.path.display().to_string();
        let gone = format!("{path}\nThe file is no longer there.");
        if response.on_hover_text(&path).on_disabled_hover_text(gone).clicked() {
            *choice = Some(Choice::Open(file.path.clone()));
        }
    }
}

fn heading(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).size(15.0).strong());
    ui.add_space(2.0);
}

/// The networks as cards, in as many columns as fit.
fn cards(ui: &mut Ui, entries: &[Entry], choice: &mut Option<Choice>) {
    // Room for the scroll bar.
    let width = ui.available_width() - 14.0;
    let columns = ((width + GAP) / (CARD + GAP)).floor().max(1.0);
    let card = (width + GAP) / columns - GAP;
    for (title, applications) in [("Applications", true), ("Networks", false)] {
        let shown: Vec<&Entry> = entries.iter().filter(|entry| entry.network.is_application == applications).collect();
        if shown.is_empty() {
            continue;
        }
        heading(ui, title);
        ui.add_space(4.0);
        for row in shown.chunks(columns as usize) {
            ui.horizontal_top(|ui| {
                ui.spacing_mut().item_spacing.x = GAP;
                for entry in row {
                    if show_card(ui, entry, card) {
                        *choice = Some(Choice::Open(entry.network.path.clone()));
                    }
                }
            });
            ui.add_space(GAP - ui.spacing().item_spacing.y);
        }
        ui.add_space(GAP);
    }
}

/// One network; whether it was clicked.
fn show_card(ui: &mut Ui, entry: &Entry, width: f32) -> bool {
    let aspect = thumbnail::SIZE[1] as f32 / thumbnail::SIZE[0] as f32;
    let picture = Vec2::new(width, (width * aspect).round());
    let (rect, response) = ui.allocate_exact_size(picture + Vec2::new(0.0, 26.0), Sense::click());
    let name = &entry.network.name;
    response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Button, true, name));
    if ui.is_rect_visible(rect) {
        let place = Rect::from_min_size(rect.min, picture);
        let rounding = CornerRadius::same(6);
        ui.painter().rect_filled(place, rounding, ui.visuals().extreme_bg_color);
        if let Some(texture) = &entry.picture {
            Image::from_texture(texture).corner_radius(rounding).paint_at(ui, place);
        }
        let lit = response.hovered() || response.has_focus();
        let color =
            if lit { ui.visuals().hyperlink_color } else { ui.visuals().widgets.noninteractive.bg_stroke.color };
        let stroke = Stroke::new(if lit { 2.0 } else { 1.0 }, color);
        ui.painter().rect_stroke(place, rounding, stroke, StrokeKind::Outside);
        let color = if lit { ui.visuals().strong_text_color() } else { ui.visuals().text_color() };
        let font = egui::TextStyle::Body.resolve(ui.style());
        let job = egui::text::LayoutJob::simple_singleline(name.clone(), font, color);
        let text = egui::WidgetText::from(job).into_galley(
            ui,
            Some(egui::TextWrapMode::Truncate),
            width,
            egui::TextStyle::Body,
        );
        ui.painter().galley(place.left_bottom() + egui::vec2(2.0, 6.0), text, color);
    }
    response.on_hover_cursor(egui::CursorIcon::PointingHand).on_hover_text(&entry.network.description).clicked()
}
