//! The look of a node: a card with its name, its state, and a row for each port.

use egui::{Color32, CornerRadius, Painter, Pos2, Rect, Response, Sense, Stroke, Ui, Vec2};
use egui_graph::SocketLayout;
use egui_graph::node::NodeInteraction;

use super::state::State;
use super::text::Text;

/// Height of the part with the name, points.
const HEAD: f32 = 40.0;
/// Height of a row of ports.
pub const ROW: f32 = 20.0;
/// Space below the last row.
const FOOT: f32 = 6.0;
/// Least width of a node.
const WIDTH: f32 = 150.0;
/// Space between the border and the texts.
const MARGIN: f32 = 14.0;
/// Zoom below which a node shows its name only, large.
const FAR: f32 = 0.7;
/// Zoom below which the names of ports cannot be read anyway.
const BLIND: f32 = 0.5;
/// Heights of the fonts of the name, of the type and of ports.
const TITLE: f32 = 13.5;
const KIND: f32 = 11.0;
const PORT: f32 = 12.0;
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

/// What a socket stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A port.
    One,
    /// An inport that takes several wires: here they are added.
    Several,
    /// One of several wires of the port above.
    Wire,
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
    /// What it stands for.
    pub role: Role,
}

/// A node as it is drawn.
pub struct Card {
    /// What the user calls it.
    pub title: String,
    /// Its type.
    pub kind: String,
    /// How it is doing.
    pub state: State,
    /// What its last run took, or that this is of yesterday.
    pub time: String,
    /// Its inports, from the top.
    pub inports: Vec<Port>,
    /// Its outports, from the top.
    pub outports: Vec<Port>,
    /// Pixels of the window for a point of the canvas.
    pub zoom: f32,
}

/// The border of a node at rest, to be seen on the canvas and on the frames there.
fn border(visuals: &egui::Visuals) -> Color32 {
    if visuals.dark_mode { Color32::from_gray(0x70) } else { Color32::from_gray(0x84) }
}

/// The border and filling of a node.
pub fn frame(ui: &egui::Style, state: &State, interaction: NodeInteraction) -> egui::Frame {
    let visuals = &ui.visuals;
    let border = match state {
        _ if interaction.selected || interaction.in_selection_rect => Stroke::new(2.0, visuals.selection.stroke.color),
        State::Failed(_) => Stroke::new(2.0, state.color()),
        _ if interaction.hovered => Stroke::new(1.0, visuals.widgets.hovered.bg_stroke.color),
        _ => Stroke::new(1.0, border(visuals)),
    };
    egui::Frame::new()
        .fill(visuals.window_fill)
        .stroke(border)
        // A thicker border must not make the node larger.
        .inner_margin(2.0 - border.width)
        .corner_radius(CornerRadius::same(8))
        .shadow(egui::Shadow { offset: [0, 3], blur: 10, spread: 0, color: Color32::from_black_alpha(60) })
}

impl Port {
    /// Space between the border and its name: wires are listed under the name of their port.
    fn inset(&self) -> f32 {
        if self.role == Role::Wire { 1.7 * MARGIN } else { MARGIN }
    }
}

impl Card {
    /// Draws the contents and says where the sockets are.
    pub fn show(&self, ui: &mut Ui, sockets: &mut SocketLayout) {
        let rows = self.inports.len().max(self.outports.len());
        let foot = if rows > 0 { FOOT } else { 0.0 };
        let size = Vec2::new(self.width(ui.painter()), HEAD + rows as f32 * ROW + foot);
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        self.mark(ui.painter(), rect);
        self.head(ui, rect);
        for (index, port) in self.inports.iter().enumerate() {
            sockets.input_at(index, row(rect, index));
            self.port(ui, rect, index, port, 0.0);
        }
        for (index, port) in self.outports.iter().enumerate() {
            sockets.output_at(index, row(rect, index));
            self.port(ui, rect, index, port, 1.0);
        }
    }

    fn port(&self, ui: &Ui, rect: Rect, index: usize, port: &Port, side: f32) {
        if self.zoom < BLIND {
            return;
        }
        let color = match port.light {
            Light::Dim => ui.visuals().weak_text_color().gamma_multiply(0.6),
            _ if port.role == Role::Wire => ui.visuals().weak_text_color(),
            _ => ui.visuals().text_color(),
        };
        let text = Text::new(ui.painter(), &port.label, PORT, color, self.zoom);
        let left = rect.left() + port.inset() + side * (rect.width() - MARGIN - port.inset() - text.size().x);
        let top = row(rect, index) - 0.5 * text.size().y;
        text.paint(ui.painter(), Pos2::new(left, top));
    }

    fn head(&self, ui: &Ui, rect: Rect) {
        let (painter, visuals) = (ui.painter(), ui.visuals());
        let (left, right) = (rect.left() + MARGIN, rect.right() - MARGIN);
        let title = |size| Text::new(painter, &self.title, size, visuals.strong_text_color(), self.zoom);
        if self.zoom < FAR {
            // From afar only the name can be read, if it is large.
            let size = (11.0 / self.zoom).min(28.0);
            let room = right - left - 16.0;
            let text = title(size * (room / title(size).size().x).min(1.0));
            let top = rect.top() + 0.5 * (HEAD - text.size().y);
            return text.paint(painter, Pos2::new(left, top));
        }
        title(TITLE).paint(painter, Pos2::new(left, rect.top() + 6.0));
        let small = |text: &str| Text::new(painter, text, KIND, visuals.weak_text_color(), self.zoom);
        small(&self.kind).paint(painter, Pos2::new(left, rect.top() + 22.0));
        let time = small(&self.time);
        let start = right - time.size().x;
        time.paint(painter, Pos2::new(start, rect.top() + 22.0));
    }

    /// The state, as a mark in the corner and a bar for progress.
    fn mark(&self, painter: &Painter, rect: Rect) {
        let at = Pos2::new(rect.right() - MARGIN - 4.0, rect.top() + 14.0);
        match &self.state {
            State::Running(part) => {
                painter.circle_stroke(at, 4.0, Stroke::new(1.5, self.state.color()));
                if let Some(part) = part {
                    let start = Pos2::new(rect.left(), rect.top() + HEAD - 3.0);
                    let bar = Rect::from_min_size(start, Vec2::new(rect.width() * part.clamp(0.02, 1.0), 2.0));
                    painter.rect_filled(bar, 1.0, self.state.color());
                }
            }
            State::Stale => {
                painter.circle_stroke(at, 4.0, Stroke::new(1.5, self.state.color()));
                let half = Rect::from_min_max(at - Vec2::new(4.0, 0.0), at + Vec2::new(4.0, 4.0));
                painter.with_clip_rect(half.intersect(painter.clip_rect())).circle_filled(at, 4.0, self.state.color());
            }
            State::Idle => drop(painter.circle_stroke(at, 3.5, Stroke::new(1.5, self.state.color()))),
            _ => drop(painter.circle_filled(at, 4.0, self.state.color())),
        }
    }

    /// The width that all texts fit in, the same at every zoom.
    fn width(&self, painter: &Painter) -> f32 {
        let width = |text: &str, size| Text::new(painter, text, size, Color32::PLACEHOLDER, 1.0).size().x;
        let column = |ports: &[Port]| {
            ports.iter().map(|port| width(&port.label, PORT) + port.inset() - MARGIN).fold(0.0, f32::max)
        };
        let title = width(&self.title, TITLE) + 20.0;
        // Room for any time, so that nothing moves when one gets longer.
        let kind = width(&self.kind, KIND) + 60.0;
        let ports = column(&self.inports) + 16.0 + column(&self.outports);
        (2.0 * MARGIN + title.max(kind).max(ports)).max(WIDTH).ceil()
    }
}

/// The height at which a row of ports lies.
fn row(rect: Rect, index: usize) -> f32 {
    rect.top() + HEAD + (index as f32 + 0.5) * ROW
}

/// Draws a socket over the one of the library, which knows one colour per node only.
pub fn socket(ui: &Ui, node: &Response, socket: &Response, port: &Port, outwards: f32) {
    let painter = ui.painter().clone().with_layer_id(node.layer_id);
    let center = socket.rect.center() + Vec2::new(2.0 * outwards, 0.0);
    let small = port.role == Role::Wire || (port.optional && !port.connected);
    let ring = if small { SOCKET - 1.0 } else { SOCKET };
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
    if port.role == Role::Several {
        // Doubled: there is room for more.
        painter.circle_stroke(center, radius + 3.5, Stroke::new(1.5, color));
    }
}
