//! Plots along a ray, one above the other, and strips of its colours.

use egui::{Align2, Color32, FontId, Mesh, Pos2, Rect, Sense, Stroke, Ui, Vec2, Vec2b};
use egui_plot::{AxisHints, Line, Plot, PlotPoint, PlotPoints, PlotTransform, Points, Span, VLine};
use rayloom_processors::{Trace, TraceSample};

use super::reading::{opacity, screen, straight};
use super::{Along, nearest};
use crate::inspect::text::number;
use crate::theme;

/// Points of a line; longer rays show the extremes of stretches.
const POINTS: usize = 2048;
/// Samples are shown as dots when there are at most this many.
const DOTS: usize = 160;
/// Width left of the plots, for numbers.
const NUMBERS: f32 = 46.0;
/// Height of a strip of colours.
const STRIP: f32 = 11.0;

/// A quantity over the samples.
struct Curve {
    name: &'static str,
    color: Color32,
    of: fn(&TraceSample) -> Option<f64>,
    /// Whether it is known between samples, too.
    goes_on: bool,
}

/// Curves in one frame.
struct Graph {
    title: &'static str,
    curves: Vec<Curve>,
    /// Values that are always in sight.
    range: Option<[f64; 2]>,
    share: f32,
}

const RED: Color32 = Color32::from_rgb(0xd0, 0x5c, 0x5c);
const GREEN: Color32 = Color32::from_rgb(0x62, 0xa8, 0x62);
const BLUE: Color32 = Color32::from_rgb(0x5c, 0x86, 0xd0);

fn graphs(ui: &Ui, trace: &Trace) -> Vec<Graph> {
    let has = |of: fn(&TraceSample) -> Option<f64>| trace.samples.first().is_some_and(|sample| of(sample).is_some());
    let value = Curve { name: "value", color: theme::WARNING, of: |s| Some(s.value), goes_on: false };
    let gradient = Curve { name: "gradient magnitude", color: theme::READY, of: |s| s.gradient, goes_on: false };
    let strong = ui.visuals().strong_text_color();
    let sample = Curve {
        name: "opacity of the sample",
        color: ui.visuals().weak_text_color(),
        of: |s| s.classified.map(|medium| f64::from(opacity(medium))),
        goes_on: false,
    };
    let channel = |name, color, of| Curve { name, color, of, goes_on: true };
    let mut colors = vec![
        channel("red so far", RED, |s| s.accumulated.first().map(|c| f64::from(c[0]))),
        channel("green so far", GREEN, |s| s.accumulated.first().map(|c| f64::from(c[1]))),
        channel("blue so far", BLUE, |s| s.accumulated.first().map(|c| f64::from(c[2]))),
        channel("opacity so far", strong, |s| s.accumulated.first().map(|c| f64::from(c[3]))),
    ];
    if has(sample.of) {
        colors.insert(0, sample);
    }
    let mut graphs = vec![Graph { title: "value", curves: vec![value], range: None, share: 0.36 }];
    if has(gradient.of) {
        graphs.push(Graph {
            title: "gradient magnitude",
            curves: vec![gradient],
            range: Some([0.0, 0.0]),
            share: 0.24,
        });
    }
    graphs.push(Graph { title: "opacity and colour", curves: colors, range: Some([0.0, 1.0]), share: 0.4 });
    graphs
}

/// Shows the plots in a height; the sample (by place in the list) under the pointer.
pub(super) fn show(ui: &mut Ui, trace: &Trace, along: Along, chosen: Option<usize>, height: f32) -> Option<usize> {
    let graphs = graphs(ui, trace);
    let strips = strips(trace);
    let room = height - (STRIP + 3.0) * strips.len() as f32 - 24.0;
    let shares: f32 = graphs.iter().map(|graph| graph.share).sum();
    let mut hovered = None;
    let mut transform = None;
    ui.spacing_mut().item_spacing.y = 3.0;
    for (index, graph) in graphs.iter().enumerate() {
        let last = index + 1 == graphs.len();
        let height = room * graph.share / shares + if last { 20.0 } else { 0.0 };
        let (pointed, shown) = plot(ui, trace, along, chosen, graph, height.max(30.0), last);
        hovered = hovered.or(pointed);
        transform = Some(shown);
    }
    if let Some(transform) = transform {
        for (name, of) in strips {
            strip(ui, trace, along, &transform, name, of);
        }
    }
    hovered
}

/// Where a sample is on the horizontal axis.
fn place(sample: &TraceSample, along: Along) -> f64 {
    match along {
        Along::Distance => sample.distance,
        Along::Number => f64::from(sample.index),
    }
}

/// Where the segment of a sample begins and ends.
fn segment(sample: &TraceSample, along: Along) -> [f64; 2] {
    match along {
        Along::Distance => [sample.start, sample.start + sample.length],
        Along::Number => [f64::from(sample.index) - 0.5, f64::from(sample.index) + 0.5],
    }
}

/// What is in sight at first: the samples taken, and a little around them.
fn extent(trace: &Trace, along: Along) -> [f64; 2] {
    let [first, last] =
        [trace.samples.first(), trace.samples.last()].map(|s| s.map_or([0.0; 2], |s| segment(s, along)));
    let air = 0.08 * (last[1] - first[0]);
    [(first[0] - air).max(0.0), (last[1] + air).min(end(trace, along))]
}

/// The end of the axis.
fn end(trace: &Trace, along: Along) -> f64 {
    match along {
        Along::Distance => trace.length,
        Along::Number => f64::from(trace.count),
    }
}

/// One frame with its curves; the sample under the pointer, and where things are on the screen.
fn plot(
    ui: &mut Ui,
    trace: &Trace,
    along: Along,
    chosen: Option<usize>,
    graph: &Graph,
    height: f32,
    numbered: bool,
) -> (Option<usize>, PlotTransform) {
    let id = ui.id().with((graph.title, along == Along::Number));
    let y_axis = AxisHints::new_y().min_thickness(NUMBERS).formatter(|mark, _| number(mark.value));
    let mut plot = Plot::new(id)
        .height(height)
        .custom_y_axes(vec![y_axis])
        .show_axes(Vec2b::new(numbered, true))
        .show_grid(Vec2b::new(true, true))
        .link_axis(ui.id().with(("along", along == Along::Number)), Vec2b::new(true, false))
        .allow_zoom(Vec2b::new(true, false))
        .allow_drag(Vec2b::new(true, false))
        .allow_scroll(false)
        .allow_axis_zoom_drag(false)
        .allow_boxed_zoom(false)
        .show_crosshair(false)
        .set_margin_fraction(Vec2::new(0.0, 0.08))
        .include_x(extent(trace, along)[0])
        .include_x(extent(trace, along)[1])
        .grid_color(ui.visuals().weak_text_color().gamma_multiply(0.35))
        .label_formatter(|_| None);
    for value in graph.range.into_iter().flatten() {
        plot = plot.include_y(value);
    }
    let gap = ui.visuals().weak_text_color().gamma_multiply(0.22);
    let cursor = ui.visuals().strong_text_color().gamma_multiply(0.6);
    let response = plot.show(ui, |plot| {
        for gap_range in gaps(trace, along) {
            plot.span(Span::new("", gap_range[0]..=gap_range[1]).fill(gap));
        }
        for curve in &graph.curves {
            for run in runs(trace, along, curve) {
                if trace.samples.len() <= DOTS && !curve.goes_on || run.len() == 1 {
                    let dots = PlotPoints::from(run.clone());
                    plot.points(Points::new(curve.name, dots).color(curve.color).radius(1.6).allow_hover(false));
                }
                plot.line(Line::new(curve.name, thinned(run)).color(curve.color).width(1.3).allow_hover(false));
            }
        }
        for output in trace.outputs.iter().filter(|_| along == Along::Distance) {
            if let Some(place) = output.place {
                plot.vline(VLine::new("depth", place).color(theme::READY).width(1.0).allow_hover(false));
            }
        }
        if let Some(sample) = chosen {
            let at = place(&trace.samples[sample], along);
            plot.vline(VLine::new("cursor", at).stroke(Stroke::new(1.0, cursor)).allow_hover(false));
        }
    });
    let frame = *response.transform.frame();
    let font = FontId::proportional(10.5);
    let color = ui.visuals().weak_text_color();
    ui.painter().text(frame.left_top() + Vec2::new(5.0, 2.0), Align2::LEFT_TOP, graph.title, font, color);
    response
        .response
        .widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Other, true, format!("Plot of {}", graph.title)));
    let pointer = response.response.hover_pos().filter(|pointer| frame.contains(*pointer));
    let wanted = pointer.map(|pointer| response.transform.value_from_position(pointer).x);
    (wanted.and_then(|wanted| nearest(trace, |sample| place(sample, along), wanted)), response.transform)
}

/// Stretches that were skipped.
fn gaps(trace: &Trace, along: Along) -> Vec<[f64; 2]> {
    let mut found = Vec::new();
    let mut open = 0.0_f64.min(trace.samples.first().map_or(0.0, |first| segment(first, along)[0]));
    let mut next = 0;
    for sample in &trace.samples {
        let [start, stop] = segment(sample, along);
        if sample.index > next {
            found.push([open, start]);
        }
        (open, next) = (stop, sample.index + 1);
    }
    if next < trace.count && trace.truncated() == 0 {
        found.push([open, end(trace, along)]);
    }
    found
}

/// The points of a curve, cut where samples were skipped unless it goes on there.
fn runs(trace: &Trace, along: Along, curve: &Curve) -> Vec<Vec<[f64; 2]>> {
    let mut runs: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut last = None;
    for sample in &trace.samples {
        let Some(y) = (curve.of)(sample).filter(|y| y.is_finite()) else { continue };
        let point = [place(sample, along), y];
        let continues = last.is_some_and(|last| curve.goes_on || last + 1 == sample.index);
        match runs.last_mut().filter(|_| continues) {
            Some(run) => run.push(point),
            None => runs.push(vec![point]),
        }
        last = Some(sample.index);
    }
    runs
}

/// Points for the screen: of long lines the least and the greatest of every stretch.
fn thinned(points: Vec<[f64; 2]>) -> PlotPoints<'static> {
    if points.len() <= 2 * POINTS {
        return PlotPoints::from(points);
    }
    let stretch = points.len().div_ceil(POINTS);
    let extremes = points.chunks(stretch).flat_map(|stretch| {
        let low = stretch.iter().min_by(|a, b| a[1].total_cmp(&b[1]));
        let high = stretch.iter().max_by(|a, b| a[1].total_cmp(&b[1]));
        let mut both: Vec<[f64; 2]> = low.into_iter().chain(high).copied().collect();
        both.sort_by(|a, b| a[0].total_cmp(&b[0]));
        both
    });
    PlotPoints::from(extremes.collect::<Vec<_>>())
}

/// How a sample looks in a strip.
type Shade = fn(&TraceSample) -> Option<Color32>;

/// The strips that this ray has.
fn strips(trace: &Trace) -> Vec<(&'static str, Shade)> {
    let all: [(&'static str, Shade); 3] = [
        ("classified", |sample| sample.classified.map(dimmed)),
        ("shaded", |sample| sample.shaded.map(dimmed)),
        ("so far", |sample| sample.accumulated.first().map(|c| screen([c[0], c[1], c[2]], 1.0))),
    ];
    let first = trace.samples.first();
    all.into_iter().filter(|(_, shade)| first.and_then(shade).is_some()).collect()
}

/// A medium over black. Opacities of a single sample are small, so the root of them is shown.
fn dimmed(medium: [f32; 4]) -> Color32 {
    screen(straight(medium), opacity(medium).max(0.0).sqrt())
}

/// A strip of colours under the plots, aligned with them.
fn strip(ui: &mut Ui, trace: &Trace, along: Along, transform: &PlotTransform, name: &str, shade: Shade) {
    let (row, _) = ui.allocate_exact_size(Vec2::new(ui.available_width(), STRIP), Sense::hover());
    let frame = transform.frame();
    let area = Rect::from_x_y_ranges(frame.x_range(), row.y_range());
    let font = FontId::proportional(9.5);
    let color = ui.visuals().weak_text_color();
    ui.painter().text(Pos2::new(area.left() - 5.0, area.center().y), Align2::RIGHT_CENTER, name, font, color);
    let painter = ui.painter().with_clip_rect(area);
    painter.rect_filled(area, 0.0, Color32::BLACK);
    let x = |along: f64| transform.position_from_point(&PlotPoint::new(along, 0.0)).x;
    let mut mesh = Mesh::default();
    let mut held: Option<(f32, Color32)> = None;
    let goes_on = name == "so far";
    for sample in &trace.samples {
        let Some(color) = shade(sample) else { continue };
        let [start, stop] = segment(sample, along).map(x);
        // What has been accumulated stays as it is while samples are skipped.
        if let Some((from, color)) = held.filter(|_| goes_on) {
            mesh.add_colored_rect(Rect::from_x_y_ranges(from..=start, area.y_range()), color);
        }
        mesh.add_colored_rect(Rect::from_x_y_ranges(start..=stop.max(start + 0.5), area.y_range()), color);
        held = Some((stop, color));
    }
    if let Some((from, color)) = held.filter(|_| goes_on) {
        mesh.add_colored_rect(Rect::from_x_y_ranges(from..=x(end(trace, along)).max(from), area.y_range()), color);
    }
    painter.add(mesh);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lines_keep_their_extremes() {
        let mut points: Vec<[f64; 2]> = (0..50_000).map(|i| [f64::from(i), (f64::from(i) * 0.01).sin()]).collect();
        points[31_234][1] = 7.0;
        let thin = thinned(points.clone());
        let shown = thin.points();
        assert!(shown.len() <= 2 * POINTS && shown.windows(2).all(|pair| pair[0].x <= pair[1].x));
        assert!(shown.iter().any(|point| point.x == 31_234.0 && point.y == 7.0));
    }
}
