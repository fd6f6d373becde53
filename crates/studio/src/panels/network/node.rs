//! The look of a node: a card with its name, its state, and a row for each port.

use std::sync::Arc;

use egui::{Color32, CornerRadius, FontId, Galley, Pos2, Rect, Response, Sense, Stroke, Ui, Vec2};
use egui_graph::SocketLayout;
use egui_graph::node::NodeInteraction;

use super::state::State;

/// Height of the part with the name, points.
const HEAD: f32 = 40.0;
/// Height of a row of ports.
const ROW: f32 = 20.0;
/// Space below the last row.
const FOOT: f32 = 6.0;
/// Least width of a node.
const WIDTH: f32 = 150.0;
/// Space between the border and the texts.
const MARGIN: f32 = 14.0;
/// Zoom below which a node shows its name only, large.
const FAR: f32 = 0.7;
/// Radius of a socket.
const SOCKET: f32 = 5.0;

/// How a socket shows while a wire is in the user's hand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Light {
    /// There is no such wire.
    #[default]
    Normal,
    /// The wire fits.
    Fits,
    /// The wire snaps to it now.
    Chosen,
    /// The wire does not fit.
    Dim,
}

/// A port as it is drawn.
pub struct Port {
    /// Its name.
    pub label: String,
    /// Its accent.
    pub color: Color32,
    /// Whether a wire ends or begins here.
    pub connected: bool,
    /// Whether it may be left open.
    pub optional: bool,
    /// How it shows.
    pub light: Light,
}

/// A node as it is drawn.
pub struct Card {
    /// What the user calls it.
    pub title: String,
    /// Its type.
    pub kind: String,
    /// How it is doing.
    pub state: State,
    /// What its last run took.
    pub time: String,
    /// Its inports, from the top.
    pub inports: Vec<Port>,
    /// Its outports, from the top.
    pub outports: Vec<Port>,
    /// Pixels of the window for a point of the canvas.
    pub zoom: f32,
}

/// The border and filling of a node.
pub fn frame(ui: &egui::Style, state: &State, interaction: NodeInteraction) -> egui::Frame {
    let visuals = &ui.visuals;
    let border = match state {
        _ if interaction.selected || interaction.in_selection_rect => Stroke::new(2.0, visuals.selection.stroke.color),
        State::Failed(_) => Stroke::new(1.5, state.color()),
        _ if interaction.hovered => Stroke::new(1.0, visuals.widgets.hovered.bg_stroke.color),
        _ => Stroke::new(1.0, visuals.widgets.noninteractive.bg_stroke.color),
    };
    egui::Frame::new()
        .fill(visuals.window_fill)
        .stroke(border)
        .corner_radius(CornerRadius::same(8))
        .shadow(egui::Shadow { offset: [0, 3], blur: 10, spread: 0, color: Color32::from_black_alpha(60) })
}

impl Card {
    /// Draws the contents and says where the sockets are.
    pub fn show(&self, ui: &mut Ui, sockets: &mut SocketLayout) {
        let texts = Texts::lay_out(self, ui);
        let rows = self.inports.len().max(self.outports.len());
        let foot = if rows > 0 { FOOT } else { 0.0 };
        let (rect, _) =
            ui.allocate_exact_size(Vec2::new(texts.width(), HEAD + rows as f32 * ROW + foot), Sense::hover());
        self.head(ui, rect, &texts);
        let row = |index: usize| rect.top() + HEAD + (index as f32 + 0.5) * ROW;
        for (index, galley) in texts.inports.into_iter().enumerate() {
            sockets.input_at(index, row(index));
            let at = Pos2::new(rect.left() + MARGIN, row(index) - 0.5 * galley.size().y);
            ui.painter().galley(at, galley, Color32::PLACEHOLDER);
        }
        for (index, galley) in texts.outports.into_iter().enumerate() {
            sockets.output_at(index, row(index));
            let at = Pos2::new(rect.right() - MARGIN - galley.size().x, row(index) - 0.5 * galley.size().y);
            ui.painter().galley(at, galley, Color32::PLACEHOLDER);
        }
    }

    fn head(&self, ui: &Ui, rect: Rect, texts: &Texts) {
        let painter = ui.painter();
        let (left, right) = (rect.left() + MARGIN, rect.right() - MARGIN);
        if self.zoom < FAR {
            // From afar only the name can be read, if it is large.
            let size = (11.0 / self.zoom).min(28.0);
            let title = |size| {
                let color = ui.visuals().strong_text_color();
                painter.layout_no_wrap(self.title.clone(), FontId::proportional(size), color)
            };
            let large = title(size);
            let room = right - left - 16.0;
            let galley = if large.size().x > room { title(size * room / large.size().x) } else { large };
            let top = rect.top() + 0.5 * (HEAD - galley.size().y);
            painter.galley(Pos2::new(left, top), galley, Color32::PLACEHOLDER);
        } else {
            painter.galley(Pos2::new(left, rect.top() + 6.0), texts.title.clone(), Color32::PLACEHOLDER);
            painter.galley(Pos2::new(left, rect.top() + 22.0), texts.kind.clone(), Color32::PLACEHOLDER);
            let time = Pos2::new(right - texts.time.size().x, rect.top() + 22.0);
            painter.galley(time, texts.time.clone(), Color32::PLACEHOLDER);
        }
        let mark = Pos2::new(right - 4.0, rect.top() + 14.0);
        match &self.state {
            State::Running(part) => {
                painter.circle_stroke(mark, 4.0, Stroke::new(1.5, self.state.color()));
                let bar = Rect::from_min_size(
                    Pos2::new(rect.left(), rect.top() + HEAD - 3.0),
                    Vec2::new(rect.width() * part.clamp(0.02, 1.0), 2.0),
                );
                painter.rect_filled(bar, 1.0, self.state.color());
            }
            State::Idle => drop(painter.circle_stroke(mark, 3.5, Stroke::new(1.5, self.state.color()))),
            _ => drop(painter.circle_filled(mark, 4.0, self.state.color())),
        }
    }
}

/// The texts of a node, laid out.
struct Texts {
    title: Arc<Galley>,
    kind: Arc<Galley>,
    time: Arc<Galley>,
    inports: Vec<Arc<Galley>>,
    outports: Vec<Arc<Galley>>,
}

impl Texts {
    fn lay_out(card: &Card, ui: &Ui) -> Self {
        let (strong, text, weak) =
            (ui.visuals().strong_text_color(), ui.visuals().text_color(), ui.visuals().weak_text_color());
        let line = |text: &str, size: f32, color: Color32| {
            ui.painter().layout_no_wrap(text.to_owned(), FontId::proportional(size), color)
        };
        let port = |port: &Port| {
            let color = if port.light == Light::Dim { weak.gamma_multiply(0.6) } else { text };
            line(&port.label, 12.0, color)
        };
        Self {
            title: line(&card.title, 13.5, strong),
            kind: line(&card.kind, 11.0, weak),
            time: line(&card.time, 11.0, weak),
            inports: card.inports.iter().map(port).collect(),
            outports: card.outports.iter().map(port).collect(),
        }
    }

    fn width(&self) -> f32 {
        let column = |texts: &[Arc<Galley>]| texts.iter().map(|text| text.size().x).fold(0.0, f32::max);
        let title = self.title.size().x + 20.0;
        let kind = self.kind.size().x + 12.0 + self.time.size().x;
        let ports = column(&self.inports) + 16.0 + column(&self.outports);
        // Whole pairs of points, so that a time that grows by a digit rarely moves anything.
        (0.5 * (2.0 * MARGIN + title.max(kind).max(ports)).max(WIDTH)).ceil() * 2.0
    }
}

/// Draws a socket over the one of the library, which knows one colour per node only.
pub fn socket(ui: &Ui, node: &Response, socket: &Response, port: &Port, outwards: f32) {
    let painter = ui.painter().clone().with_layer_id(node.layer_id);
    let center = socket.rect.center() + Vec2::new(2.0 * outwards, 0.0);
    let ring = if port.connected || !port.optional { SOCKET } else { SOCKET - 1.0 };
    let (radius, color) = match port.light {
        Light::Dim => (ring, port.color.gamma_multiply(0.25)),
        Light::Chosen => (ring + 2.0, port.color),
        _ if socket.hovered() => (ring + 1.5, port.color),
        _ => (ring, port.color),
    };
    if matches!(port.light, Light::Fits | Light::Chosen) {
        painter.circle_filled(center, radius + 5.0, port.color.gamma_multiply(0.28));
    }
    let inside = if port.connected { color } else { ui.visuals().window_fill };
    painter.circle(center, radius, inside, Stroke::new(2.0, color));
}
