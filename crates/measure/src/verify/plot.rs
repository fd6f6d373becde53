//! Error against fineness, both logarithmic, one line a case, as an SVG file of its own.

use std::fmt::Write;

use super::{Axis, Case, Study};
use crate::report::axis::Axis as Scale;
use crate::text::{escaped, number};

const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 400.0;
/// Room around the plot: left, top, right (for the names), bottom.
const MARGIN: [f64; 4] = [80.0, 16.0, 262.0, 50.0];
/// Told apart without telling red from green.
const COLORS: [&str; 7] = ["#2563eb", "#d97706", "#0f766e", "#9333ea", "#be123c", "#0891b2", "#57534e"];

/// The plot of one axis.
pub(super) fn svg(study: &Study, axis: Axis) -> String {
    let cases: Vec<&Case> = study.cases.iter().filter(|case| case.axis == axis).collect();
    let points = || cases.iter().flat_map(|case| &case.errors);
    let [left, top, right, bottom] = MARGIN;
    let x = Scale::over(points().map(|(fineness, _)| *fineness), 0.7, left, WIDTH - right);
    let y = Scale::over(points().map(|(_, error)| *error), 1.0, HEIGHT - bottom, top);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"Error against {}\" \
         font-family=\"system-ui, sans-serif\" font-size=\"12\"><rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#fff\"/>",
        axis.unit()
    );
    grid(&mut svg, x, y, axis);
    for (case, color) in cases.iter().zip(COLORS.iter().cycle()) {
        line(&mut svg, case, color, x, y);
    }
    names(&mut svg, &cases, y);
    svg + "</svg>\n"
}

fn grid(svg: &mut String, x: Scale, y: Scale, axis: Axis) {
    let path = |svg: &mut String, d: String| {
        let _ = write!(svg, "<path d=\"{d}\" stroke=\"#e5e7eb\" fill=\"none\"/>");
    };
    for tick in x.ticks() {
        let at = x.at(tick);
        path(svg, format!("M{at:.1} {:.1}V{:.1}", y.from, y.to));
        let _ = write!(
            svg,
            "<text x=\"{at:.1}\" y=\"{:.1}\" fill=\"#6b7280\" text-anchor=\"middle\">{}</text>",
            y.from + 17.0,
            number(tick)
        );
    }
    for tick in y.ticks() {
        let at = y.at(tick);
        path(svg, format!("M{:.1} {at:.1}H{:.1}", x.from, x.to));
        let _ = write!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" fill=\"#6b7280\" text-anchor=\"end\">{}</text>",
            x.from - 7.0,
            at + 4.0,
            number(tick)
        );
    }
    let _ = write!(
        svg,
        "<text x=\"{:.1}\" y=\"{:.1}\" fill=\"#6b7280\" text-anchor=\"middle\">{}</text><text transform=\"translate(15 {:.1}) \
         rotate(-90)\" fill=\"#6b7280\" text-anchor=\"middle\">error (RMS)</text>",
        0.5 * (x.from + x.to),
        HEIGHT - 10.0,
        axis.unit(),
        0.5 * (y.from + y.to)
    );
}

/// The errors of a case; those that only arithmetic is left of are hollow.
fn line(svg: &mut String, case: &Case, color: &str, x: Scale, y: Scale) {
    let places: Vec<(f64, f64)> = case.errors.iter().map(|(n, error)| (x.at(*n), y.at(*error))).collect();
    let path: String = places.iter().map(|(px, py)| format!("L{px:.1} {py:.1}")).collect();
    let _ = write!(svg, "<path d=\"M{}\" stroke=\"{color}\" stroke-width=\"1.6\" fill=\"none\"/>", &path[1..]);
    for (i, (px, py)) in places.iter().enumerate() {
        let fill = if i < case.judged { color } else { "#fff" };
        let _ = write!(svg, "<circle cx=\"{px:.1}\" cy=\"{py:.1}\" r=\"3.2\" fill=\"{fill}\" stroke=\"{color}\"/>");
    }
}

/// Names with observed orders, beside the ends of their lines, moved apart.
fn names(svg: &mut String, cases: &[&Case], y: Scale) {
    const LINE: f64 = 30.0;
    let mut order: Vec<usize> = (0..cases.len()).collect();
    let end = |i: usize| cases[i].errors.last().map_or(y.from, |(_, error)| y.at(*error));
    order.sort_by(|&a, &b| end(a).total_cmp(&end(b)));
    // No lower than leaves room for those below, and below the one above.
    let mut above = MARGIN[1] - LINE + 14.0;
    for (rank, &i) in order.iter().enumerate() {
        let lowest = HEIGHT - 24.0 - LINE * (order.len() - 1 - rank) as f64;
        let at = end(i).max(above + LINE).min(lowest.max(above + LINE));
        above = at;
        let color = COLORS[i % COLORS.len()];
        let _ = write!(
            svg,
            "<text x=\"{:.1}\" y=\"{at:.1}\" fill=\"{color}\" font-weight=\"600\">{}</text><text x=\"{:.1}\" y=\"{:.1}\" \
             fill=\"#6b7280\">order {:.2}, expected {}</text>",
            WIDTH - MARGIN[2] + 12.0,
            escaped(&cases[i].name),
            WIDTH - MARGIN[2] + 12.0,
            at + 14.0,
            cases[i].order,
            number(cases[i].expected)
        );
    }
}
