//! The editor of a 2-D transfer function: shapes over the histogram of values (across) and gradient magnitudes (up).

mod shapes;

use std::sync::Arc;

use egui::{Color32, ColorImage, CornerRadius, Key, Pos2, Rect, RichText, Sense, Stroke, TextureHandle, Ui, Vec2};
use rayloom_network::{PropertyDecl, Value};
use rayloom_volume::{Histogram2D, Primitive, TransferFunction2D, ValueRange};

use super::editor::{Surroundings, rgb_button, screen_color};
use super::exchange;
use super::number::{self, Number};
use super::row::HEIGHT;
use super::transfer_function::plot::{self, Plot};
use crate::pointer::dragged_by;
use crate::probe::Mark;
use crate::upstream;
use shapes::Point;

/// Height of the plane, points.
const PLANE: f32 = 190.0;
/// Height of the values below it.
const AXIS: f32 = 15.0;
/// Colours that new shapes take in turn.
const COLORS: [[f64; 3]; 4] = [[0.95, 0.80, 0.55], [0.85, 0.40, 0.35], [0.45, 0.65, 0.90], [0.60, 0.80, 0.50]];

/// What the editor remembers.
#[derive(Default)]
pub(super) struct State {
    selected: Option<usize>,
    /// The largest gradient magnitude shown and the values; they stay while something is dragged.
    shown: Option<(ValueRange, f64)>,
    /// The histogram as a texture.
    picture: Option<(Arc<Histogram2D>, TextureHandle)>,
}

/// The plane on the screen.
struct Plane {
    plot: Plot,
    gradient_max: f64,
}

impl Plane {
    fn to_screen(&self, [value, gradient]: Point) -> Pos2 {
        Pos2::new(self.plot.x(value), self.plot.y((gradient / self.gradient_max).clamp(-10.0, 11.0)))
    }

    fn point(&self, at: Pos2) -> Point {
        let up = f64::from((self.plot.area.bottom() - at.y) / self.plot.area.height());
        [self.plot.tidy(self.plot.value(at.x)), up * self.gradient_max]
    }
}

/// Shows a 2-D transfer function; the new one if the user changed it.
pub(super) fn show(
    ui: &mut Ui,
    decl: &PropertyDecl,
    function: &TransferFunction2D,
    surroundings: &mut Surroundings<'_>,
) -> Option<TransferFunction2D> {
    let address = surroundings.address(decl);
    let mut state = surroundings.tools.planes.remove(&address).unwrap_or_default();
    state.selected = state.selected.filter(|index| *index < function.primitives.len());
    let volume = surroundings.volume.clone();
    let counted = volume.as_ref().and_then(|volume| {
        let channel = upstream::channel(volume, surroundings.properties.int("channel").ok());
        surroundings.tools.histograms.plane(volume, channel)
    });
    state.look_at(ui, function, counted.as_deref());
    let (range, gradient_max) = state.shown.unwrap_or((ValueRange::new(0.0, 1.0), 1.0));
    let (area, _) = ui.allocate_exact_size(Vec2::new(ui.available_width(), PLANE + AXIS), Sense::hover());
    let area = Rect::from_min_size(area.min, Vec2::new(area.width(), PLANE));
    let plane = Plane { plot: Plot { area, range }, gradient_max };
    ui.painter().rect_filled(area, CornerRadius::same(3), ui.visuals().extreme_bg_color);
    if let Some(counted) = &counted {
        state.backdrop(ui, &plane, counted);
    }
    plot::axis(ui, &plane.plot, 60.0);
    let mut after = function.clone();
    bodies(ui, decl, &plane, &mut state, &mut after);
    reshape(ui, decl, &plane, &state, &mut after);
    if volume.is_some() && counted.is_none() {
        let (font, color) = (egui::FontId::proportional(11.0), ui.visuals().weak_text_color());
        ui.painter().text(area.center(), egui::Align2::CENTER_CENTER, "counting voxels...", font, color);
    }
    if let Some(mark) = surroundings.marker {
        marker(ui, &plane, mark);
    }
    shape_row(ui, decl, &mut state, &mut after, surroundings);
    let known = volume.is_none() || counted.is_some();
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        // Where new shapes belong is only known with the gradients.
        ui.add_enabled_ui(known, |ui| add(ui, &plane, &mut state, &mut after));
        files(ui, decl, &mut state, &mut after, surroundings);
    });
    surroundings.tools.planes.insert(address, state);
    (after != *function && after.check().is_ok()).then_some(after)
}

impl State {
    /// Chooses the part of the plane to show: that of the data and all shapes.
    fn look_at(&mut self, ui: &Ui, function: &TransferFunction2D, counted: Option<&Histogram2D>) {
        if self.shown.is_some() && ui.input(|input| input.pointer.any_down()) {
            return;
        }
        let points = function.primitives.iter().flat_map(|primitive| shapes::outline(&primitive.shape));
        let data = counted.map(|counted| counted.range);
        let start = data.map_or([f64::INFINITY, f64::NEG_INFINITY], |range| [range.min, range.max]);
        let [low, high] = points.fold(start, |[low, high], [value, _]| [low.min(value), high.max(value)]);
        let range = if low < high { ValueRange::new(low, high) } else { ValueRange::new(0.0, 1.0) };
        let steepest = counted.map_or(0.0, |counted| counted.gradient_max).max(function.gradient_maximum());
        self.shown = Some((range, if steepest > 0.0 { steepest } else { 1.0 }));
    }

    /// Paints the histogram, logarithmic in the counts.
    fn backdrop(&mut self, ui: &Ui, plane: &Plane, counted: &Arc<Histogram2D>) {
        if self.picture.as_ref().is_none_or(|(shown, _)| !Arc::ptr_eq(shown, counted)) {
            let options = egui::TextureOptions::LINEAR;
            self.picture = Some((counted.clone(), ui.ctx().load_texture("histogram", image(counted), options)));
        }
        let Some((_, texture)) = &self.picture else { return };
        let corners = [[counted.range.min, counted.gradient_max], [counted.range.max, 0.0]];
        let place = Rect::from_two_pos(plane.to_screen(corners[0]), plane.to_screen(corners[1]));
        let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
        let tint = ui.visuals().text_color();
        ui.painter().with_clip_rect(plane.plot.area).image(texture.id(), place, whole, tint);
    }
}

/// Counts as translucent white, the steepest gradients at the top.
fn image(counted: &Histogram2D) -> ColorImage {
    let [nx, ny] = counted.bins;
    let most = counted.counts.iter().copied().max().unwrap_or(1).max(1) as f64;
    let shade = |count: u64| Color32::from_white_alpha((230.0 * (count as f64).ln_1p() / most.ln_1p()) as u8);
    let pixels = (0..ny).rev().flat_map(|y| counted.counts[y * nx..(y + 1) * nx].iter().map(|count| shade(*count)));
    ColorImage::new([nx, ny], pixels.collect())
}

/// The shapes: click to select, drag to move, right-click or Delete to remove.
fn bodies(ui: &mut Ui, decl: &PropertyDecl, plane: &Plane, state: &mut State, function: &mut TransferFunction2D) {
    let response = ui.interact(plane.plot.area, ui.id().with("plane"), Sense::click_and_drag());
    response
        .widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Other, true, format!("Plane of {}", decl.label)));
    let at = |function: &TransferFunction2D, pointer: Pos2| {
        let point = plane.point(pointer);
        function.primitives.iter().rposition(|primitive| shapes::contains(&shapes::outline(&primitive.shape), point))
    };
    let pressed = ui.input(|input| input.pointer.press_origin());
    if (response.clicked() || response.drag_started())
        && let Some(pointer) = pressed.or(response.interact_pointer_pos())
    {
        state.selected = at(function, pointer);
        response.request_focus();
    }
    if response.dragged()
        && let Some(index) = state.selected
    {
        let delta = dragged_by(&response);
        let value = f64::from(delta.x / plane.plot.area.width()) * plane.plot.range.width();
        let gradient = f64::from(-delta.y / plane.plot.area.height()) * plane.gradient_max;
        let shape = &mut function.primitives[index].shape;
        *shape = shapes::moved(shape, [value, gradient]);
    }
    let delete = response.has_focus() && ui.input(|i| i.key_pressed(Key::Delete) || i.key_pressed(Key::Backspace));
    let removed = match response.interact_pointer_pos().filter(|_| response.secondary_clicked()) {
        Some(pointer) => at(function, pointer),
        None => state.selected.filter(|_| delete),
    };
    if let Some(index) = removed {
        function.primitives.remove(index);
        state.selected = None;
    }
    for (index, primitive) in function.primitives.iter().enumerate() {
        paint(ui, plane, primitive, state.selected == Some(index));
    }
    if let Some(pointer) = response.hover_pos() {
        let [value, gradient] = plane.point(pointer);
        let opacity = function.evaluate(value, gradient).opacity;
        let text = format!("{}   gradient {}   opacity {opacity:.3}", number::format(value), number::format(gradient));
        let at = plane.plot.area.left_top() + Vec2::new(6.0, 3.0);
        ui.painter().text(
            at,
            egui::Align2::LEFT_TOP,
            text,
            egui::FontId::proportional(10.5),
            ui.visuals().text_color(),
        );
    }
}

/// The sample that the ray probe points at: a ring at its value and gradient; a line at its value where no gradient is known.
fn marker(ui: &Ui, plane: &Plane, mark: Mark) {
    let Some(gradient) = mark.gradient else { return plot::marker(ui, &plane.plot, mark.value) };
    let painter = ui.painter().with_clip_rect(plane.plot.area);
    let at = plane.to_screen([mark.value, gradient]);
    for (color, width) in [(ui.visuals().extreme_bg_color, 4.0), (ui.visuals().strong_text_color(), 1.5)] {
        painter.circle_stroke(at, 5.0, Stroke::new(width, color));
    }
}

fn paint(ui: &Ui, plane: &Plane, primitive: &Primitive, selected: bool) {
    let points: Vec<Pos2> = shapes::outline(&primitive.shape).into_iter().map(|point| plane.to_screen(point)).collect();
    let color = screen_color(primitive.color);
    let fill = color.gamma_multiply(0.15 + 0.6 * primitive.opacity as f32);
    let stroke = Stroke::new(if selected { 2.0 } else { 1.0 }, color);
    ui.painter().with_clip_rect(plane.plot.area).add(egui::Shape::convex_polygon(points, fill, stroke));
}

/// The handles of the selected shape.
fn reshape(ui: &mut Ui, decl: &PropertyDecl, plane: &Plane, state: &State, function: &mut TransferFunction2D) {
    let Some(primitive) = state.selected.and_then(|index| function.primitives.get_mut(index)) else { return };
    for (handle, point) in shapes::handles(&primitive.shape).into_iter().enumerate() {
        let at = plane.to_screen(point);
        let area = Rect::from_center_size(at, Vec2::splat(12.0));
        let response = ui.interact(area, ui.id().with(("handle", handle)), Sense::click_and_drag());
        response.widget_info(|| {
            egui::WidgetInfo::labeled(egui::WidgetType::Other, true, format!("Handle {} of {}", handle + 1, decl.label))
        });
        if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.dragged()) {
            primitive.shape = shapes::reshaped(&primitive.shape, handle, plane.point(plane.plot.area.clamp(pointer)));
        }
        plot::handle(ui, at, screen_color(primitive.color), false, response.hovered());
    }
}

/// Colour, opacity and softness of the selected shape.
fn shape_row(
    ui: &mut Ui,
    decl: &PropertyDecl,
    state: &mut State,
    function: &mut TransferFunction2D,
    surroundings: &mut Surroundings<'_>,
) {
    ui.horizontal(|ui| {
        ui.set_min_height(HEIGHT);
        ui.spacing_mut().item_spacing.x = 4.0;
        let Some(primitive) = state.selected.and_then(|index| function.primitives.get_mut(index)) else {
            let hint =
                if function.primitives.is_empty() { "Add a shape below." } else { "Click a shape to change it." };
            ui.label(RichText::new(hint).weak().size(11.0));
            return;
        };
        if let Some(color) = rgb_button(ui, "Colour of the shape", primitive.color) {
            primitive.color = color;
        }
        let width = (ui.available_width() - 26.0) / 2.0;
        let range = [0.0, 1.0];
        let field = |label, unit| Number { label, range, slider: Some(range), unit, logarithmic: false, whole: false };
        let entered = field("Opacity of the shape", "opacity").show(ui, primitive.opacity, width);
        primitive.opacity = surroundings.number(decl, entered).unwrap_or(primitive.opacity);
        let entered = field("Softness of the shape", "softness").show(ui, primitive.softness, width);
        primitive.softness = surroundings.number(decl, entered).unwrap_or(primitive.softness);
        let remove = egui::Button::new(RichText::new("✖").size(10.5)).frame(false);
        if ui.add(remove).on_hover_text("Remove").clicked()
            && let Some(index) = state.selected.take()
        {
            function.primitives.remove(index);
        }
    });
}

/// New shapes.
fn add(ui: &mut Ui, plane: &Plane, state: &mut State, function: &mut TransferFunction2D) {
    ui.menu_button("Add a shape", |ui| {
        for (name, shape) in shapes::NEW {
            if ui.button(name).clicked() {
                let range = plane.plot.range;
                let shape = shapes::placed(&shape, range.min, [range.width(), plane.gradient_max]);
                let color = COLORS[function.primitives.len() % COLORS.len()];
                function.primitives.push(Primitive { shape, color, opacity: 0.4, softness: 0.5 });
                state.selected = Some(function.primitives.len() - 1);
                ui.close();
            }
        }
    });
}

/// Functions from and to files.
fn files(
    ui: &mut Ui,
    decl: &PropertyDecl,
    state: &mut State,
    function: &mut TransferFunction2D,
    surroundings: &mut Surroundings<'_>,
) {
    let current = Value::TransferFunction2D(function.clone());
    if let Some(Value::TransferFunction2D(read)) = exchange::menu(ui, decl, &current, surroundings) {
        *function = read;
        state.selected = None;
    }
}
