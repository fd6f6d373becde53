//! The editor of a transfer function: knots over the histogram of the volume that flows in.

mod knots;
pub(super) mod plot;

use egui::{CornerRadius, Key, PointerButton, Pos2, Rect, RichText, Sense, Ui, Vec2};
use rayloom_network::PropertyDecl;
use rayloom_volume::{Histogram, TransferFunction, ValueRange};

use super::editor::{Surroundings, rgb_button, screen_color};
use super::exchange;
use super::number::{self, Number};
use super::row::HEIGHT;
use super::transfer_function::knots::Side;
use crate::pointer::dragged_by;
use crate::upstream;
use plot::Plot;

/// Height of the plot, points.
const PLOT: f32 = 132.0;
/// Height of the values below it.
const AXIS: f32 = 15.0;
/// Height of the strip of colours.
const STRIP: f32 = 12.0;

/// What the editor remembers.
#[derive(Default)]
pub(super) struct State {
    selected: Option<(usize, Side)>,
    linear: bool,
    /// The values shown; they stay while something is dragged.
    shown: Option<ValueRange>,
    /// The function when a drag of the strip began, and how far the pointer is from there.
    window: Option<(TransferFunction, Vec2)>,
}

/// Shows a transfer function; the new one if the user changed it.
pub(super) fn show(
    ui: &mut Ui,
    decl: &PropertyDecl,
    function: &TransferFunction,
    surroundings: &mut Surroundings<'_>,
) -> Option<TransferFunction> {
    let address = surroundings.address(decl);
    let mut state = surroundings.tools.curves.remove(&address).unwrap_or_default();
    if state.selected.is_some_and(|(index, _)| index >= function.knots.len()) {
        state.selected = None;
    }
    let mut after = function.clone();
    let data = data(surroundings);
    let counted = data.as_ref().and_then(|(volume, channel, _)| surroundings.tools.histograms.values(volume, *channel));
    let range = data.map(|(_, _, range)| range);
    state.look_at(ui, function, range);
    let width = ui.available_width();
    let (area, background) = ui.allocate_exact_size(Vec2::new(width, PLOT + AXIS + STRIP), Sense::hover());
    let plot_area = Rect::from_min_size(area.min, Vec2::new(width, PLOT)).shrink2(Vec2::new(6.0, 0.0));
    let plot = Plot { area: plot_area, range: state.shown.unwrap_or(ValueRange::new(0.0, 1.0)) };
    let rounded = Rect::from_min_size(area.min, Vec2::new(width, PLOT));
    ui.painter().rect_filled(rounded, CornerRadius::same(3), ui.visuals().extreme_bg_color);
    if let Some(counted) = &counted {
        plot::histogram(ui, &plot, counted, state.linear);
    } else if range.is_some() {
        let font = egui::FontId::proportional(11.0);
        let color = ui.visuals().weak_text_color();
        ui.painter().text(plot.area.center(), egui::Align2::CENTER_CENTER, "counting voxels...", font, color);
    }
    plot::curve(ui, &plot, &after);
    plot::axis(ui, &plot, 60.0);
    if let Some(mark) = surroundings.marker {
        plot::marker(ui, &plot, mark.value);
    }
    empty_space(ui, decl, &plot, &mut state, &mut after, counted.as_deref());
    handles(ui, decl, &plot, &mut state, &mut after);
    let strip = Rect::from_min_max(
        Pos2::new(plot.area.left(), area.bottom() - STRIP),
        Pos2::new(plot.area.right(), area.bottom()),
    );
    window(ui, &plot, strip, &mut state, &mut after, background.id);
    knot_row(ui, decl, &mut state, &mut after, surroundings);
    tools(ui, decl, &mut state, &mut after, range, surroundings);
    surroundings.tools.curves.insert(address, state);
    (after != *function).then_some(after)
}

/// The volume that flows in, the channel that is classified, and its range.
fn data(surroundings: &Surroundings<'_>) -> Option<(std::sync::Arc<rayloom_volume::Volume>, u32, ValueRange)> {
    let volume = surroundings.volume.clone()?;
    let channel = upstream::channel(&volume, surroundings.properties.int("channel").ok());
    let range = *volume.ranges().get(channel as usize)?;
    Some((volume, channel, range))
}

impl State {
    /// Chooses the values to show: those of the data and all knots.
    fn look_at(&mut self, ui: &Ui, function: &TransferFunction, data: Option<ValueRange>) {
        if self.shown.is_some() && ui.input(|input| input.pointer.any_down()) {
            return;
        }
        let both = match (data, knots::extent(function)) {
            (Some(data), Some(knots)) => ValueRange::new(data.min.min(knots.min), data.max.max(knots.max)),
            (data, knots) => data.or(knots).unwrap_or(ValueRange::new(0.0, 1.0)),
        };
        let both = if both.max > both.min { both } else { ValueRange::new(both.min - 0.5, both.max + 0.5) };
        self.shown = Some(both);
    }
}

/// What lies between the knots: a click adds one; the values under the pointer are told.
fn empty_space(
    ui: &mut Ui,
    decl: &PropertyDecl,
    plot: &Plot,
    state: &mut State,
    function: &mut TransferFunction,
    counted: Option<&Histogram>,
) {
    let response = ui.interact(plot.area, ui.id().with("plot"), Sense::click());
    response
        .widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Other, true, format!("Plot of {}", decl.label)));
    let Some(pointer) = response.hover_pos() else { return };
    let (value, opacity) = (plot.tidy(plot.value(pointer.x)), plot.opacity(pointer.y));
    let voxels = counted.map(|counted| {
        let bins = counted.counts.len();
        let bin = (counted.range.normalise(value) * bins as f64).max(0.0) as usize;
        let within = value >= counted.range.min && value <= counted.range.max;
        format!("   {} voxels", if within { counted.counts.get(bin.min(bins - 1)).copied().unwrap_or(0) } else { 0 })
    });
    let here = function.evaluate(value);
    let text = format!("{}   opacity {:.3}{}", number::format(value), here.opacity, voxels.unwrap_or_default());
    ui.painter().vline(pointer.x, plot.area.y_range(), ui.visuals().widgets.noninteractive.bg_stroke);
    let at = plot.area.left_top() + Vec2::new(0.0, 3.0);
    ui.painter().text(at, egui::Align2::LEFT_TOP, text, egui::FontId::proportional(10.5), ui.visuals().text_color());
    if response.clicked() {
        let index = knots::insert(function, value, (opacity * 1000.0).round() / 1000.0);
        state.selected = Some((index, Side::Left));
    }
}

/// The knots: drag to move, right button or Delete to remove, arrow keys to nudge.
fn handles(ui: &mut Ui, decl: &PropertyDecl, plot: &Plot, state: &mut State, function: &mut TransferFunction) {
    let mut removed = None;
    for index in 0..function.knots.len() {
        let knot = function.knots[index];
        let sides: &[Side] = if knot.right.is_some() { &[Side::Left, Side::Right] } else { &[Side::Left] };
        for &side in sides {
            let look = knots::side(&knot, side);
            let at = Pos2::new(plot.x(knot.at), plot.y(look.opacity));
            let area = Rect::from_center_size(at, Vec2::splat(13.0));
            let response = ui.interact(area, ui.id().with(("knot", index, side)), Sense::click_and_drag());
            response.widget_info(|| {
                let side = if side == Side::Right { " right" } else { "" };
                egui::WidgetInfo::labeled(
                    egui::WidgetType::Other,
                    true,
                    format!("Knot {}{side} of {}", index + 1, decl.label),
                )
            });
            if response.clicked() || response.drag_started() {
                state.selected = Some((index, side));
                response.request_focus();
            }
            if let Some(pointer) =
                response.interact_pointer_pos().filter(|_| response.dragged_by(PointerButton::Primary))
            {
                let value = plot.tidy(plot.value(pointer.x.clamp(plot.area.left(), plot.area.right())));
                knots::move_to(function, index, value);
                let opacity = (plot.opacity(pointer.y) * 1000.0).round() / 1000.0;
                knots::set_side(&mut function.knots[index], side, look.color, opacity);
            }
            if response.has_focus() {
                nudge(ui, plot, function, index, side);
            }
            let delete =
                response.has_focus() && ui.input(|i| i.key_pressed(Key::Delete) || i.key_pressed(Key::Backspace));
            if response.secondary_clicked() || delete {
                removed = Some(index);
            }
            let selected = state.selected == Some((index, side));
            plot::handle(ui, at, screen_color(look.color), selected, response.hovered());
        }
    }
    if let Some(index) = removed {
        function.knots.remove(index);
        state.selected = None;
    }
}

fn nudge(ui: &Ui, plot: &Plot, function: &mut TransferFunction, index: usize, side: Side) {
    let presses = |key| ui.input(|input| f64::from(input.num_presses(key) as u32));
    let right = presses(Key::ArrowRight) - presses(Key::ArrowLeft);
    let up = presses(Key::ArrowUp) - presses(Key::ArrowDown);
    if right != 0.0 {
        let at = function.knots[index].at + right * plot.range.width() / 255.0;
        knots::move_to(function, index, at);
    }
    if up != 0.0 {
        let look = knots::side(&function.knots[index], side);
        knots::set_side(&mut function.knots[index], side, look.color, look.opacity + 0.01 * up);
    }
}

/// The strip of colours; dragging it moves (level) and stretches (window) all knots.
fn window(ui: &mut Ui, plot: &Plot, area: Rect, state: &mut State, function: &mut TransferFunction, id: egui::Id) {
    plot::strip(ui, plot, area, function);
    let response = ui.interact(area, id.with("window"), Sense::drag());
    if response.drag_started() {
        state.window = Some((function.clone(), Vec2::ZERO));
    }
    if response.dragged()
        && let Some((original, moved)) = &mut state.window
    {
        *moved += dragged_by(&response);
        let shift = plot.range.width() * f64::from(moved.x / plot.area.width().max(1.0));
        let shifted = knots::window_level(original, plot.tidy(shift), f64::from(-0.01 * moved.y).exp());
        if shifted.check().is_ok() {
            *function = shifted;
        }
    }
    if response.drag_stopped() {
        state.window = None;
    }
    response.on_hover_text("Drag sideways to shift all knots (level), up and down to stretch them (window)");
}

/// Numbers of the selected knot.
fn knot_row(
    ui: &mut Ui,
    decl: &PropertyDecl,
    state: &mut State,
    function: &mut TransferFunction,
    surroundings: &mut Surroundings<'_>,
) {
    ui.horizontal(|ui| {
        ui.set_min_height(HEIGHT);
        ui.spacing_mut().item_spacing.x = 4.0;
        let Some((index, side)) = state.selected else {
            ui.label(
                RichText::new("Click to add a knot, drag to move it, right-click to remove it.").weak().size(11.0),
            );
            return;
        };
        let look = knots::side(&function.knots[index], side);
        if let Some(color) = rgb_button(ui, "Colour of the knot", look.color) {
            knots::set_side(&mut function.knots[index], side, color, look.opacity);
        }
        let unbounded = [f64::NEG_INFINITY, f64::INFINITY];
        let width = (ui.available_width() - 76.0) / 2.0;
        let field =
            |label, range, slider, unit| Number { label, range, slider, unit, logarithmic: false, whole: false };
        let entered = field("Value of the knot", unbounded, None, "value").show(ui, function.knots[index].at, width);
        if let Some(at) = surroundings.number(decl, entered) {
            knots::move_to(function, index, at);
        }
        let unit = [0.0, 1.0];
        let entered = field("Opacity of the knot", unit, Some(unit), "opacity").show(ui, look.opacity, width);
        if let Some(opacity) = surroundings.number(decl, entered) {
            let color = knots::side(&function.knots[index], side).color;
            knots::set_side(&mut function.knots[index], side, color, opacity);
        }
        let split = function.knots[index].right.is_some();
        let help = "A split knot has another colour and opacity on its right side";
        if ui.selectable_label(split, "Split").on_hover_text(help).clicked() {
            knots::toggle_split(&mut function.knots[index]);
            state.selected = Some((index, if split { Side::Left } else { Side::Right }));
        }
        if ui.add(egui::Button::new(RichText::new("✖").size(10.5)).frame(false)).on_hover_text("Remove").clicked() {
            function.knots.remove(index);
            state.selected = None;
        }
    });
}

/// Presets, fit, mirror, scale of the histogram, files.
fn tools(
    ui: &mut Ui,
    decl: &PropertyDecl,
    state: &mut State,
    function: &mut TransferFunction,
    data: Option<ValueRange>,
    surroundings: &mut Surroundings<'_>,
) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let range = data.or(knots::extent(function)).unwrap_or(ValueRange::new(0.0, 1.0));
        let mut replacement = None;
        ui.menu_button("Presets", |ui| {
            for (name, shape) in knots::PRESETS {
                if ui.button(name).clicked() {
                    replacement = Some(knots::preset(shape, range));
                    ui.close();
                }
            }
        });
        if ui.button("Fit").on_hover_text("Stretch the knots over the range of the data").clicked() {
            replacement = Some(knots::fit(function, range));
        }
        if ui.button("Invert").on_hover_text("Mirror the knots within the range of the data").clicked() {
            replacement = Some(knots::mirror(function, range));
        }
        let help = "Whether the heights of the histogram are logarithms of the counts";
        if ui.selectable_label(!state.linear, "Log").on_hover_text(help).clicked() {
            state.linear = !state.linear;
        }
        let current = rayloom_network::Value::TransferFunction(function.clone());
        if let Some(rayloom_network::Value::TransferFunction(read)) = exchange::menu(ui, decl, &current, surroundings) {
            replacement = Some(read);
        }
        if let Some(replacement) = replacement {
            *function = replacement;
            state.selected = None;
        }
    });
}
