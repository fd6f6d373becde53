//! Drawing of a transfer function: histogram, axis, curve, colours.

use egui::{Align2, Color32, FontId, Mesh, Pos2, Rect, Shape, Stroke, Ui};
use rayloom_volume::{Histogram, TransferFunction, ValueRange};

use super::super::editor::screen_color;
use super::super::number;

/// Columns that the curve's colours are sampled in.
const COLUMNS: usize = 160;

/// Where values and opacities lie on the screen.
#[derive(Clone, Copy)]
pub(in super::super) struct Plot {
    /// The area of the plot.
    pub area: Rect,
    /// The values from its left to its right side, data units.
    pub range: ValueRange,
}

impl Plot {
    /// Where a value lies.
    pub fn x(&self, value: f64) -> f32 {
        self.area.left() + self.range.normalise(value).clamp(-10.0, 11.0) as f32 * self.area.width()
    }

    /// The value at a place.
    pub fn value(&self, x: f32) -> f64 {
        self.range.denormalise(f64::from((x - self.area.left()) / self.area.width().max(1.0)))
    }

    /// Where an opacity (or any share of the height) lies.
    pub fn y(&self, opacity: f64) -> f32 {
        self.area.bottom() - opacity as f32 * self.area.height()
    }

    /// The opacity at a place, 0 to 1.
    pub fn opacity(&self, y: f32) -> f64 {
        f64::from((self.area.bottom() - y) / self.area.height().max(1.0)).clamp(0.0, 1.0)
    }

    /// A value rounded to what a pixel can tell apart.
    pub fn tidy(&self, value: f64) -> f64 {
        let pixel = self.range.width() / f64::from(self.area.width().max(1.0));
        if !(pixel > 0.0 && pixel.is_finite()) {
            return value;
        }
        let step = 10_f64.powf(pixel.log10().floor());
        let rounded = if step < 1.0 {
            (value * (1.0 / step).round()).round() / (1.0 / step).round()
        } else {
            (value / step).round() * step
        };
        if rounded.is_finite() { rounded } else { value }
    }
}

/// The histogram as a grey silhouette; logarithmic or linear in the counts.
pub(super) fn histogram(ui: &Ui, plot: &Plot, histogram: &Histogram, linear: bool) {
    let mut sorted: Vec<u64> = histogram.counts.clone();
    sorted.sort_unstable();
    // The background of a scan fills one bin and would flatten all others.
    let most = sorted.iter().rev().nth(if linear { 2 } else { 0 }).copied().unwrap_or(1).max(1) as f64;
    let height = |count: u64| match linear {
        true => (count as f64 / most).min(1.0),
        false => (count as f64).ln_1p() / most.ln_1p(),
    };
    let color = ui.visuals().weak_text_color().gamma_multiply(0.55);
    let bins = histogram.counts.len() as f64;
    let mut mesh = Mesh::default();
    for (bin, count) in histogram.counts.iter().enumerate().filter(|(_, count)| **count > 0) {
        let left = plot.x(histogram.range.denormalise(bin as f64 / bins));
        let right = plot.x(histogram.range.denormalise((bin + 1) as f64 / bins)).max(left + 0.5);
        let corners = [Pos2::new(left, plot.y(0.94 * height(*count))), Pos2::new(right, plot.area.bottom())];
        mesh.add_colored_rect(Rect::from_min_max(corners[0], corners[1]), color);
    }
    ui.painter().with_clip_rect(plot.area).add(mesh);
}

/// The value that the ray probe points at, above the curve.
pub(in super::super) fn marker(ui: &Ui, plot: &Plot, value: f64) {
    let color = ui.visuals().strong_text_color();
    let painter = ui.painter().with_clip_rect(plot.area.expand(4.0));
    let x = plot.x(value);
    painter.extend(Shape::dashed_line(
        &[Pos2::new(x, plot.area.top()), Pos2::new(x, plot.area.bottom())],
        Stroke::new(1.0, color),
        3.0,
        2.0,
    ));
    let tip = Pos2::new(x, plot.area.top() + 5.0);
    let corners = vec![Pos2::new(x - 4.0, plot.area.top()), Pos2::new(x + 4.0, plot.area.top()), tip];
    painter.add(Shape::convex_polygon(corners, color, Stroke::NONE));
}

/// The curve of the opacity over its colours.
pub(super) fn curve(ui: &Ui, plot: &Plot, function: &TransferFunction) {
    let painter = ui.painter().with_clip_rect(plot.area.expand(1.0));
    painter.add(fill(plot, function));
    let mut points = Vec::new();
    if let (Some(first), Some(last)) = (function.knots.first(), function.knots.last()) {
        points.push(Pos2::new(plot.area.left(), plot.y(first.opacity)));
        for knot in &function.knots {
            points.push(Pos2::new(plot.x(knot.at), plot.y(knot.opacity)));
            points.push(Pos2::new(plot.x(knot.at), plot.y(knot.right_side().opacity)));
        }
        points.push(Pos2::new(plot.area.right(), plot.y(last.right_side().opacity)));
    }
    painter.add(Shape::line(points, Stroke::new(1.5, ui.visuals().strong_text_color())));
}

/// Colours below the curve, the stronger the more opaque.
fn fill(plot: &Plot, function: &TransferFunction) -> Mesh {
    let mut mesh = Mesh::default();
    for x in columns(plot, function) {
        for x in [x - 0.01, x + 0.01] {
            let here = function.evaluate(plot.value(x));
            let color = screen_color(here.color).gamma_multiply(0.65);
            mesh.colored_vertex(Pos2::new(x, plot.y(here.opacity)), color);
            mesh.colored_vertex(Pos2::new(x, plot.area.bottom()), color.gamma_multiply(0.5));
        }
    }
    quads(&mut mesh);
    mesh
}

/// Joins pairs of vertices to a band.
fn quads(mesh: &mut Mesh) {
    for corner in (0..(mesh.vertices.len() as u32).saturating_sub(2)).step_by(2) {
        mesh.add_triangle(corner, corner + 1, corner + 2);
        mesh.add_triangle(corner + 1, corner + 2, corner + 3);
    }
}

/// Places to sample at: evenly, and at every knot, in order.
fn columns(plot: &Plot, function: &TransferFunction) -> Vec<f32> {
    let even = (0..=COLUMNS).map(|column| plot.area.left() + plot.area.width() * column as f32 / COLUMNS as f32);
    let knots = function.knots.iter().map(|knot| plot.x(knot.at)).filter(|x| plot.area.x_range().contains(*x));
    let mut columns: Vec<f32> = even.chain(knots).collect();
    columns.sort_by(f32::total_cmp);
    columns
}

/// The colours alone, as a strip.
pub(super) fn strip(ui: &Ui, plot: &Plot, area: Rect, function: &TransferFunction) {
    let mut mesh = Mesh::default();
    for x in columns(plot, function) {
        for x in [x - 0.01, x + 0.01] {
            let color = screen_color(function.evaluate(plot.value(x)).color);
            mesh.colored_vertex(Pos2::new(x, area.top()), color);
            mesh.colored_vertex(Pos2::new(x, area.bottom()), color);
        }
    }
    quads(&mut mesh);
    ui.painter().with_clip_rect(area).add(mesh);
}

/// Values below the plot, about every `gap` points.
pub(in super::super) fn axis(ui: &Ui, plot: &Plot, gap: f32) {
    let color = ui.visuals().weak_text_color();
    for value in ticks(plot.range, f64::from(plot.area.width() / gap)) {
        let x = plot.x(value);
        let align = match (x - plot.area.left(), plot.area.right() - x) {
            (left, _) if left < 8.0 => Align2::LEFT_TOP,
            (_, right) if right < 8.0 => Align2::RIGHT_TOP,
            _ => Align2::CENTER_TOP,
        };
        ui.painter().vline(x, plot.area.bottom()..=plot.area.bottom() + 3.0, Stroke::new(1.0, color));
        let at = Pos2::new(x, plot.area.bottom() + 3.0);
        ui.painter().text(at, align, number::format(value), FontId::proportional(10.0), color);
    }
}

/// Round values within a range, about as many as asked for.
fn ticks(range: ValueRange, about: f64) -> Vec<f64> {
    let rough = range.width() / about.max(1.0);
    if !(rough > 0.0 && rough.is_finite()) {
        return vec![range.min];
    }
    let ten = 10_f64.powf(rough.log10().floor());
    let step =
        [1.0, 2.0, 5.0, 10.0].map(|factor| factor * ten).into_iter().find(|step| *step >= rough).unwrap_or(rough);
    let first = (range.min / step).ceil();
    let count = ((range.max / step).floor() - first).clamp(0.0, 100.0) as usize;
    (0..=count).map(|index| (first + index as f64) * step).collect()
}

/// A handle of a knot or shape.
pub(in super::super) fn handle(ui: &Ui, at: Pos2, color: Color32, selected: bool, hovered: bool) {
    let radius = if hovered || selected { 5.5 } else { 4.5 };
    let rim = if selected { ui.visuals().strong_text_color() } else { ui.visuals().text_color() };
    ui.painter().circle(at, radius, color, Stroke::new(if selected { 2.0 } else { 1.2 }, rim));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(ticks(ValueRange::new(0.0, 255.0), 4.0), [0.0, 100.0, 200.0]);
        assert_eq!(ticks(ValueRange::new(-1.0, 1.0), 4.0), [-1.0, -0.5, 0.0, 0.5, 1.0]);
        assert_eq!(ticks(ValueRange::new(3.0, 3.0), 4.0), [3.0]);
    }

    #[test]
    fn places_and_values_are_inverse() {
        let area = Rect::from_min_size(Pos2::new(10.0, 20.0), egui::vec2(300.0, 100.0));
        let plot = Plot { area, range: ValueRange::new(-50.0, 250.0) };
        assert!((plot.value(plot.x(30.0)) - 30.0).abs() < 1e-3);
        assert!((plot.opacity(plot.y(0.25)) - 0.25).abs() < 1e-6);
        assert_eq!(plot.tidy(30.4), 30.0);
    }
}
