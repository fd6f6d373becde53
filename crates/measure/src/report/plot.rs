//! Error against cost, both logarithmic, as SVG.

use std::fmt::Write;

use super::axis::Axis;
use crate::Measurements;
use crate::run::pareto::Point;
use crate::text::{escaped, number};

const WIDTH: f64 = 560.0;
const HEIGHT: f64 = 400.0;
/// Room for the axes: left, top, right, bottom.
const MARGIN: [f64; 4] = [64.0, 18.0, 22.0, 50.0];
/// Estimated size of a letter of a label, pixels.
const LETTER: [f64; 2] = [6.8, 13.0];

/// What a plot shows.
pub(super) struct Plot<'a> {
    pub measurements: &'a Measurements,
    pub points: Vec<Point>,
    pub front: &'a [usize],
    /// Label of the horizontal axis.
    pub cost: &'static str,
    /// Whether to draw the spread of times.
    pub spread: bool,
}

/// A rectangle that is taken: left, top, right, bottom.
type Taken = [f64; 4];

impl Plot<'_> {
    /// The picture. Empty if nothing has a cost.
    pub fn svg(&self) -> String {
        let shown: Vec<usize> = (0..self.points.len()).filter(|&i| self.points[i].cost.is_finite()).collect();
        if shown.is_empty() {
            return String::new();
        }
        let [left, top, right, bottom] = MARGIN;
        let x = Axis::over(shown.iter().map(|&i| self.points[i].cost), 0.7, left, WIDTH - right);
        let y = Axis::over(shown.iter().map(|&i| self.points[i].error), 1.0, HEIGHT - bottom, top);
        let mut svg =
            format!("<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"Error against {}\">", self.cost);
        self.axes(&mut svg, x, y);
        self.front_line(&mut svg, x, y);
        let mut taken = self.marks(&mut svg, x, y, &shown);
        self.labels(&mut svg, x, y, &mut taken);
        svg + "</svg>"
    }

    fn axes(&self, svg: &mut String, x: Axis, y: Axis) {
        for tick in x.ticks() {
            let at = x.at(tick);
            let _ = write!(
                svg,
                "<path class=\"grid\" d=\"M{at:.1} {:.1}V{:.1}\"/><text x=\"{at:.1}\" y=\"{:.1}\" class=\"tick\" text-anchor=\"middle\">{}</text>",
                y.from,
                y.to,
                y.from + 17.0,
                number(tick)
            );
        }
        for tick in y.ticks() {
            let at = y.at(tick);
            let _ = write!(
                svg,
                "<path class=\"grid\" d=\"M{:.1} {at:.1}H{:.1}\"/><text x=\"{:.1}\" y=\"{:.1}\" class=\"tick\" text-anchor=\"end\">{}</text>",
                x.from,
                x.to,
                x.from - 7.0,
                at + 4.0,
                number(tick)
            );
        }
        let _ = write!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" class=\"axis\" text-anchor=\"middle\">{}</text><text transform=\"translate(15 {:.1}) rotate(-90)\" class=\"axis\" text-anchor=\"middle\">error (RMS)</text>",
            0.5 * (x.from + x.to),
            HEIGHT - 10.0,
            self.cost,
            0.5 * (y.from + y.to)
        );
    }

    /// The front as the stairs that it is: between two settings nothing better is on offer.
    fn front_line(&self, svg: &mut String, x: Axis, y: Axis) {
        let mut path = String::new();
        for (n, &i) in self.front.iter().enumerate() {
            let (px, py) = (x.at(self.points[i].cost), y.at(self.points[i].error));
            let _ = match n {
                0 => write!(path, "M{px:.1} {:.1}V{py:.1}", y.to),
                _ => write!(path, "H{px:.1}V{py:.1}"),
            };
        }
        let _ = write!(svg, "<path class=\"front\" d=\"{path}H{:.1}\"/>", x.to);
    }

    /// The points, those of the front last, and the room they take.
    fn marks(&self, svg: &mut String, x: Axis, y: Axis, shown: &[usize]) -> Vec<Taken> {
        let mut order = shown.to_vec();
        order.sort_by_key(|i| self.front.contains(i));
        let mut taken = Vec::new();
        for i in order {
            let measured = &self.measurements.settings[i];
            let (px, py) = (x.at(self.points[i].cost), y.at(self.points[i].error));
            let on_front = self.front.contains(&i);
            if let (true, Some(time)) = (self.spread, measured.all.time_ms) {
                let _ = write!(
                    svg,
                    "<path class=\"spread{}\" d=\"M{:.1} {py:.1}H{:.1}\"/>",
                    if on_front { " best" } else { "" },
                    x.at(time.low),
                    x.at(time.high)
                );
            }
            if self.measurements.chosen == Some(i) {
                let _ = write!(svg, "<circle class=\"chosen\" cx=\"{px:.1}\" cy=\"{py:.1}\" r=\"12\"/>");
            }
            if measured.setting.assignments.is_empty() {
                let _ = write!(svg, "<circle class=\"saved\" cx=\"{px:.1}\" cy=\"{py:.1}\" r=\"9\"/>");
            }
            let (class, radius) = match (on_front, measured.departs) {
                (true, _) => ("best", 4.5),
                (false, true) => ("departing", 3.0),
                (false, false) => ("other", 3.5),
            };
            let _ = write!(
                svg,
                "<circle class=\"{class}\" cx=\"{px:.1}\" cy=\"{py:.1}\" r=\"{radius}\"><title>{}: {} {}, error {}</title></circle>",
                escaped(&measured.setting.name),
                number(self.points[i].cost),
                self.cost,
                number(self.points[i].error)
            );
            taken.push([px - 4.0, py - 4.0, px + 4.0, py + 4.0]);
        }
        taken
    }

    /// Names of what to choose and of the front, each where it covers nothing else; of the others only the network as saved.
    fn labels(&self, svg: &mut String, x: Axis, y: Axis, taken: &mut Vec<Taken>) {
        let saved = self.measurements.saved().filter(|i| !self.front.contains(i) && self.points[*i].cost.is_finite());
        let chosen = self.measurements.chosen;
        let others = self.front.iter().chain(saved.iter()).filter(|i| Some(**i) != chosen);
        for &i in chosen.iter().filter(|i| self.points[**i].cost.is_finite()).chain(others) {
            let name = &self.measurements.settings[i].setting.name;
            let (px, py) = (x.at(self.points[i].cost), y.at(self.points[i].error));
            let Some((at, anchor)) = place(px, py, name.chars().count() as f64 * LETTER[0], taken) else { continue };
            let class = if self.front.contains(&i) { "name" } else { "name other-name" };
            let _ = write!(
                svg,
                "<text class=\"{class}\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\">{}</text>",
                at[0],
                at[1],
                escaped(name)
            );
        }
    }
}

/// A free place for a label of a width beside a point: where its text starts or ends, and which of the two.
fn place(px: f64, py: f64, width: f64, taken: &mut Vec<Taken>) -> Option<([f64; 2], &'static str)> {
    let candidates = [
        (9.0, -6.0, "start"),
        (9.0, 14.0, "start"),
        (-9.0, 14.0, "end"),
        (-9.0, -6.0, "end"),
        (12.0, 4.0, "start"),
        (-12.0, 4.0, "end"),
        (9.0, -20.0, "start"),
        (-9.0, 28.0, "end"),
        (9.0, 28.0, "start"),
        (-9.0, -20.0, "end"),
    ];
    for (dx, dy, anchor) in candidates {
        let (tx, ty) = (px + dx, py + dy);
        let (from, to) = if anchor == "start" { (tx, tx + width) } else { (tx - width, tx) };
        let room = [from, ty - LETTER[1] + 3.0, to, ty + 3.0];
        let inside = from >= MARGIN[0] && to <= WIDTH - 2.0 && room[1] >= 2.0 && room[3] <= HEIGHT - MARGIN[3];
        if inside && taken.iter().all(|other| !overlap(&room, other)) {
            taken.push(room);
            return Some(([tx, ty], anchor));
        }
    }
    None
}

fn overlap(a: &Taken, b: &Taken) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_do_not_cover_each_other() {
        let mut taken = Vec::new();
        let places: Vec<_> = (0..4).filter_map(|_| place(300.0, 200.0, 60.0, &mut taken)).collect();
        assert_eq!((places.len(), taken.len()), (4, 4));
        assert!((0..4).all(|i| (0..i).all(|j| !overlap(&taken[i], &taken[j]))));
    }
}
