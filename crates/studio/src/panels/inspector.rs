//! Inspectors: data of an outport kept in sight, with layers, ranges, zoom, pixel values and comparison.

use std::collections::BTreeMap;
use std::sync::Arc;

use egui::{Color32, Pos2, Rect, Sense, Vec2};
use rayloom_network::{Address, ImageKind};
use rayloom_processors::{Data, Image};

use crate::display::{Layer, Look};
use crate::inspect::image::{CHECKER, channel_names, depth_range, facts, paint, table};
use crate::inspect::text::number;
use crate::inspect::{self, Pixel, Statistics};
use crate::pointer::dragged_by;
use crate::session::Session;
use crate::theme;

use super::probe;

/// Largest magnification of the fitted picture.
const MAX_ZOOM: f32 = 200.0;
/// Screen pixels for an image pixel from which on pixels are shown as squares.
const SHARP: f32 = 3.0;

/// Width of the list of what to compare with.
const COMPARE: f32 = 150.0;

/// How one inspector looks at its image.
struct View {
    layer: Layer,
    /// Values shown black and white; automatic when there are none.
    range: Option<[f32; 2]>,
    /// Magnification of the fitted picture, from 1.
    zoom: f32,
    /// Point of the image in the middle, 0 to 1.
    center: Vec2,
    /// Compared with this.
    other: Option<Address>,
    /// What differences are multiplied with.
    gain: f32,
    numbers: bool,
    /// Whether values that do not fit are marked.
    mark: bool,
    /// The pixel under the pointer.
    pixel: Option<Arc<Pixel>>,
}

impl Default for View {
    fn default() -> Self {
        Self {
            layer: Layer::Natural,
            range: None,
            zoom: 1.0,
            center: Vec2::splat(0.5),
            other: None,
            gain: 10.0,
            numbers: false,
            mark: false,
            pixel: None,
        }
    }
}

/// The inspectors, by what they look at.
#[derive(Default)]
pub struct Inspectors {
    views: BTreeMap<Address, View>,
}

impl Inspectors {
    /// Shows what is on an outport.
    pub fn show(&mut self, ui: &mut egui::Ui, session: &mut Session, outport: &Address) {
        session.watched.insert(outport.clone());
        let view = self.views.entry(outport.clone()).or_default();
        session.watched.extend(view.other.clone());
        match session.engine.results.outputs.get(outport).cloned() {
            Some(Data::Image(image)) => view.show(ui, session, outport, &image),
            _ => {
                egui::Frame::new().inner_margin(8).show(ui, |ui| {
                    inspect::heading(ui, session, outport);
                    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| inspect::show(ui, session, outport));
                });
            }
        }
    }
}

impl View {
    fn show(&mut self, ui: &mut egui::Ui, session: &mut Session, outport: &Address, image: &Arc<Image>) {
        let statistics = session.statistics(ui.ctx(), outport, image);
        let numbers = statistics.as_deref().and_then(|statistics| statistics.as_ref().ok());
        let margin = egui::Frame::new().inner_margin(egui::Margin::symmetric(8, 4));
        margin.show(ui, |ui| self.toolbar(ui, session, outport, image, numbers));
        egui::Panel::bottom(ui.id().with(("reading", outport))).resizable(false).show(ui, |ui| {
            self.readout(ui, session, outport, image);
            if self.numbers {
                facts(ui, image);
            }
            if let Some(statistics) = numbers.filter(|_| self.numbers) {
                table(ui, image, statistics);
            }
        });
        self.picture(ui, session, outport, image, numbers);
    }

    fn toolbar(
        &mut self,
        ui: &mut egui::Ui,
        session: &Session,
        outport: &Address,
        image: &Image,
        numbers: Option<&Statistics>,
    ) {
        ui.horizontal_wrapped(|ui| {
            // A difference is one of colours.
            if self.other.is_none() {
                self.choose_layer(ui, outport, image);
                if self.layer != Layer::Natural {
                    self.choose_range(ui, numbers);
                }
            }
            if ui.selectable_label(self.zoom == 1.0, "Fit").on_hover_text("Show all of the image.").clicked() {
                (self.zoom, self.center) = (1.0, Vec2::splat(0.5));
            }
            ui.toggle_value(&mut self.mark, "Mark").on_hover_text(
                "Blue: below the range; red: above it (0 to 1 for colours and coordinates); magenta: NaN or infinite.",
            );
            ui.toggle_value(&mut self.numbers, "Numbers").on_hover_text("Smallest, largest and mean values.");
            self.choose_other(ui, session, outport, image);
        });
    }

    fn choose_layer(&mut self, ui: &mut egui::Ui, outport: &Address, image: &Image) {
        let natural = match image.kind {
            ImageKind::EntryPoints | ImageKind::ExitPoints => "Coordinates",
            _ => "Colours",
        };
        let names = channel_names(image.kind);
        let mut layers = vec![(Layer::Natural, natural)];
        layers.extend((0..4).map(|channel| (Layer::Channel(channel), names[usize::from(channel)])));
        layers.extend(image.depth.is_some().then_some((Layer::Depth, "depth")));
        let chosen = layers.iter().find(|(layer, _)| *layer == self.layer).map_or(natural, |(_, name)| name);
        egui::ComboBox::from_id_salt(("layer", outport)).selected_text(chosen).width(92.0).show_ui(ui, |ui| {
            for (layer, name) in layers {
                if ui.selectable_value(&mut self.layer, layer, name).clicked() {
                    self.range = None;
                }
            }
        });
    }

    /// The values that are shown black and white where nothing else was chosen: those that occur.
    fn automatic_range(&self, numbers: Option<&Statistics>) -> Option<[f32; 2]> {
        match self.layer {
            Layer::Natural => None,
            Layer::Depth => depth_range(numbers),
            Layer::Channel(channel) => {
                numbers?.channels[usize::from(channel.min(3))].map(|channel| [channel.min.min(0.0), channel.max])
            }
        }
    }

    fn choose_range(&mut self, ui: &mut egui::Ui, numbers: Option<&Statistics>) {
        let automatic = self.automatic_range(numbers).unwrap_or([0.0, 1.0]);
        let mut range = self.range.unwrap_or(automatic);
        let speed = f64::from((range[1] - range[0]).abs().max(1e-6)) * 0.005;
        let black = ui.add(egui::DragValue::new(&mut range[0]).speed(speed)).on_hover_text("Shown black.");
        let white = ui.add(egui::DragValue::new(&mut range[1]).speed(speed)).on_hover_text("Shown white.");
        if black.changed() || white.changed() {
            self.range = Some(range);
        }
        if self.range.is_some() && ui.small_button("auto").on_hover_text("The values that occur.").clicked() {
            self.range = None;
        }
    }

    fn choose_other(&mut self, ui: &mut egui::Ui, session: &Session, outport: &Address, image: &Image) {
        let fits = |address: &Address, data: &Data| match data {
            Data::Image(other) => address != outport && other.size() == image.size(),
            _ => false,
        };
        let others = session.engine.results.outputs.iter().filter(|(address, data)| fits(address, data));
        let text = self.other.as_ref().map_or("Compare...".into(), |other| format!("minus {other}"));
        // Lists do not wrap by themselves.
        if ui.available_size_before_wrap().x < COMPARE + 24.0 {
            ui.end_row();
        }
        let list = egui::ComboBox::from_id_salt(("compare", outport)).selected_text(text).width(COMPARE).truncate();
        list.show_ui(ui, |ui| {
            ui.selectable_value(&mut self.other, None, "Nothing");
            for (address, _) in others {
                ui.selectable_value(&mut self.other, Some(address.clone()), address.to_string());
            }
        });
        if self.other.is_some() {
            if ui.available_size_before_wrap().x < 170.0 {
                ui.end_row();
            }
            let gain = egui::Slider::new(&mut self.gain, 1.0..=1000.0).logarithmic(true).prefix("x ");
            ui.add(gain).on_hover_text("What differences are multiplied with.");
        }
    }

    fn picture(
        &mut self,
        ui: &mut egui::Ui,
        session: &mut Session,
        outport: &Address,
        image: &Arc<Image>,
        numbers: Option<&Statistics>,
    ) {
        let (area, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        ui.painter().rect_filled(area, 0.0, ui.visuals().extreme_bg_color);
        self.navigate(ui, &response, area, image);
        let placed = self.placed(area, image);
        let pixel_size = placed.width() / image.size()[0] as f32 * ui.ctx().pixels_per_point();
        let sharp = pixel_size >= SHARP;
        let range = self.range.or(self.automatic_range(numbers));
        let look = Look { layer: self.layer, range, checker: CHECKER, sharp, mark: self.mark };
        let picture = match self.compared(session, image) {
            Some(other) => session.display.difference([image, &other], self.gain, sharp),
            None => session.display.picture(image, look),
        };
        ui.scope_builder(egui::UiBuilder::new().max_rect(area), |ui| {
            ui.set_clip_rect(area.intersect(ui.clip_rect()));
            paint(ui, placed, picture);
        });
        self.pixel_under(&response, placed, image);
        probe::pick(ui, &response, placed, session, &outport.processor, &outport.to_string());
        if let Some(pixel) = &self.pixel {
            let side = placed.width() / image.size()[0] as f32;
            let corner = placed.min + Vec2::new(pixel.at[0] as f32, pixel.at[1] as f32) * side;
            let square = Rect::from_min_size(corner, Vec2::splat(side.max(3.0)));
            let stroke = egui::Stroke::new(1.0, Color32::from_white_alpha(200));
            ui.painter().with_clip_rect(area).rect_stroke(square, 0.0, stroke, egui::StrokeKind::Outside);
        }
    }

    /// The image compared with, as long as it fits.
    fn compared(&self, session: &Session, image: &Image) -> Option<Arc<Image>> {
        match session.engine.results.outputs.get(self.other.as_ref()?) {
            Some(Data::Image(other)) if other.size() == image.size() => Some(other.clone()),
            _ => None,
        }
    }

    /// Where all of the image lies, beyond the area where it is enlarged.
    fn placed(&self, area: Rect, image: &Image) -> Rect {
        let size = Vec2::from(image.size().map(|pixels| pixels as f32));
        let size = size * (area.width() / size.x).min(area.height() / size.y) * self.zoom;
        Rect::from_min_size(area.center() - self.center * size, size)
    }

    /// The wheel magnifies around the pointer, dragging moves, a double click fits.
    fn navigate(&mut self, ui: &egui::Ui, response: &egui::Response, area: Rect, image: &Image) {
        if response.double_clicked() {
            (self.zoom, self.center) = (1.0, Vec2::splat(0.5));
        }
        let before = self.placed(area, image);
        self.center -= dragged_by(response) / before.size();
        let scroll = ui.input(|input| input.smooth_scroll_delta.y);
        if let Some(pointer) = response.hover_pos().filter(|_| scroll != 0.0) {
            let held = (pointer - before.min) / before.size();
            self.zoom = (self.zoom * (scroll * 0.005).exp()).clamp(1.0, MAX_ZOOM);
            self.center = held - (pointer - area.center()) / self.placed(area, image).size();
        }
        self.center = self.center.clamp(Vec2::ZERO, Vec2::splat(1.0));
        if self.zoom == 1.0 {
            self.center = Vec2::splat(0.5);
        }
    }

    /// Remembers the pixel under the pointer; the last one stays when the pointer leaves.
    fn pixel_under(&mut self, response: &egui::Response, placed: Rect, image: &Arc<Image>) {
        let [width, height] = image.size();
        let under = |pointer: Pos2| {
            let at = (pointer - placed.min) / placed.size() * Vec2::new(width as f32, height as f32);
            let inside = at.x >= 0.0 && at.y >= 0.0 && at.x < width as f32 && at.y < height as f32;
            inside.then_some([at.x as u32, at.y as u32])
        };
        let kept = self.pixel.as_ref().map(|pixel| pixel.at).filter(|at| at[0] < width && at[1] < height);
        let at = response.hover_pos().and_then(under).or(kept);
        let pixel = at.map(|at| Pixel { image: image.clone(), at });
        let same = pixel.as_ref().zip(self.pixel.as_ref()).is_some_and(|(new, old)| new.is(old));
        if !same {
            self.pixel = pixel.map(Arc::new);
        }
    }

    /// The value of the pixel under the pointer.
    fn readout(&self, ui: &mut egui::Ui, session: &mut Session, outport: &Address, image: &Image) {
        let Some(pixel) = &self.pixel else {
            ui.weak("Point at a pixel to read it.")
                .on_hover_text("The wheel magnifies, a drag moves, a double click fits.");
            return;
        };
        match session.reading(ui.ctx(), &outport.to_string(), pixel).as_deref() {
            None => {
                ui.weak("reading...");
            }
            Some(Err(error)) => {
                theme::colored(ui, theme::ERROR, error.to_string());
            }
            Some(Ok(reading)) => {
                let values = channel_names(image.kind).into_iter().zip(reading.color);
                let mut parts: Vec<_> =
                    values.map(|(name, value)| format!("{name} {}", number(value.into()))).collect();
                parts.extend(reading.depth.map(|depth| format!("depth {}", number(depth.into()))));
                parts.insert(0, format!("({}, {})", reading.at[0], reading.at[1]));
                ui.horizontal_wrapped(|ui| {
                    for part in parts {
                        ui.monospace(part);
                    }
                });
            }
        }
    }
}
