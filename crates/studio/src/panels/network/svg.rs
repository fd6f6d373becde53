//! The network as a drawing: an SVG file with all nodes and wires, independent of the window.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use egui::{Color32, Context, Id, Pos2, Rect};

use super::geometry::Geometry;
use super::socket::Socket;
use crate::dialogs::{Dialogs, Question};
use crate::session::{Session, Severity};
use crate::theme;
use crate::wiring::End;

/// Space around everything, points of the canvas.
const BORDER: f32 = 24.0;
/// Size of titles and of the names of ports, points.
const TITLE: f32 = 13.0;
const PORT: f32 = 9.5;

/// The drawing on its way into a file.
#[derive(Default)]
pub struct Drawing {
    /// Whether it is to be made once everything is in sight.
    wanted: bool,
    dialogs: Dialogs<Result<PathBuf, String>>,
}

impl Drawing {
    /// Asks for a drawing.
    pub fn begin(&mut self) {
        self.wanted = true;
    }

    /// Draws and asks for a file, once everything is in sight; tells what became of it.
    pub fn show(&mut self, context: &Context, session: &mut Session, geometry: &Geometry) {
        let who = Id::new("drawing of the network");
        match self.dialogs.answer(who) {
            None => {}
            Some(Ok(path)) => session.tell(Severity::Note, format!("saved {}", path.display())),
            Some(Err(error)) => session.tell(Severity::Error, error),
        }
        if !self.wanted || !session.network().connections().iter().all(|wire| geometry.points(wire).is_some()) {
            return;
        }
        self.wanted = false;
        let drawing = draw(session, geometry);
        let question = Question {
            name: "Drawing",
            extensions: &["svg".to_owned()],
            folder: session.document.path().and_then(Path::parent),
            save_as: Some("network.svg"),
        };
        self.dialogs.ask(who, context, &session.chooser, &question, move |path| {
            rayloom_files::write(&path, drawing.as_bytes()).map_err(|error| format!("{}: {error}", path.display()))?;
            Ok(path)
        });
    }
}

/// Draws the nodes and wires that the geometry knows, in the colours of the dark theme.
pub fn draw(session: &Session, geometry: &Geometry) -> String {
    let bounds = geometry.nodes.values().copied().reduce(Rect::union).unwrap_or(Rect::ZERO).expand(BORDER);
    let (at, size) = (bounds.min, bounds.size());
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{} {} {} {}\" width=\"{}\" height=\"{}\" \
         font-family=\"Ubuntu, sans-serif\">\n<rect x=\"{}\" y=\"{}\" width=\"100%\" height=\"100%\" fill=\"#15171b\"/>\n",
        at.x, at.y, size.x, size.y, size.x, size.y, at.x, at.y
    );
    for wire in session.network().connections() {
        let color = port_color(session, &End::Outport(wire.from.clone()));
        let points = geometry.points(wire).unwrap_or_default();
        let path: Vec<String> = points.iter().map(|point| format!("{:.1},{:.1}", point.x, point.y)).collect();
        line(
            &mut svg,
            &format!("<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2.5\"/>", path.join(" ")),
        );
    }
    nodes(&mut svg, session, geometry);
    sockets(&mut svg, session, geometry);
    svg.push_str("</svg>\n");
    svg
}

fn nodes(svg: &mut String, session: &Session, geometry: &Geometry) {
    for processor in session.network().processors() {
        let Some(rect) = geometry.nodes.get(processor.id()) else { continue };
        let (x, y, w, h) = (rect.left(), rect.top(), rect.width(), rect.height());
        line(
            svg,
            &format!("<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" rx=\"4\" fill=\"#24282e\"/>"),
        );
        let title = processor.label().unwrap_or(processor.id());
        text(svg, Pos2::new(x + 9.0, y + 17.0), "start", TITLE, "#ffffff", title);
    }
}

fn sockets(svg: &mut String, session: &Session, geometry: &Geometry) {
    for (Socket { end, wire }, place) in &geometry.sockets {
        let address = end.address();
        let declaration = session.network().processor(&address.processor).and_then(|processor| processor.declaration());
        let (anchor, shift, label) = match end {
            End::Inport(_) => {
                ("start", 10.0, declaration.and_then(|d| d.inport(&address.item)).map(|port| &port.label))
            }
            End::Outport(_) => {
                ("end", -10.0, declaration.and_then(|d| d.outport(&address.item)).map(|port| &port.label))
            }
        };
        let (x, y, color) = (place.x, place.y, port_color(session, end));
        line(svg, &format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"{color}\"/>"));
        let label = match wire {
            Some(wire) => {
                let source = session.network().processor(&wire.from.processor);
                source.and_then(|source| source.label()).unwrap_or(&wire.from.processor)
            }
            None => label.map_or(address.item.as_str(), String::as_str),
        };
        text(svg, Pos2::new(x + shift, y + 3.5), anchor, PORT, "#a8adb4", label);
    }
}

fn line(svg: &mut String, element: &str) {
    svg.push_str(element);
    svg.push('\n');
}

fn text(svg: &mut String, at: Pos2, anchor: &str, size: f32, color: &str, text: &str) {
    // Writing to a text cannot fail.
    let _ = writeln!(
        svg,
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\" font-size=\"{size}\" fill=\"{color}\">{}</text>",
        at.x,
        at.y,
        escaped(text)
    );
}

/// A text as XML wants it.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

fn port_color(session: &Session, end: &End) -> String {
    let port_type = end.types(session.network()).first().copied();
    let [r, g, b, _] = port_type.map_or(Color32::from_gray(0x80), theme::port_color).to_array();
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_cannot_break_the_file() {
        assert_eq!(escaped("a < b & c > d"), "a &lt; b &amp; c &gt; d");
    }
}
