//! Draws the network with the library's widgets and collects what the user did. Nothing else knows the library's nodes.

use std::collections::{BTreeMap, BTreeSet};

use egui::{Color32, Pos2, Rect, Response, Sense, Shape, Stroke, Ui, UiBuilder, Vec2, WidgetInfo, WidgetType};
use egui_graph::edge::Edge;
use egui_graph::node::{EdgeEvent, Node, NodeId};
use egui_graph::{EdgesCtx, NodesCtx, SocketKind};
use rayloom_network::{Address, Connection, PortType, Processor};

use super::action::Action;
use super::drag::{Drag, Target};
use super::frames;
use super::geometry::{Geometry, RADIUS, WIRE};
use super::menus;
use super::node::{self, Card, Light, Port, ROW, Role};
use super::socket::{Socket, Sockets};
use super::state::{State, cost, short};
use super::waiting::waiting;
use crate::session::Session;
use crate::theme;
use crate::wiring::End;

/// Radius of a socket for the pointer, points of the window, where the canvas leaves room for it.
const GRIP: f32 = 7.0;

/// The accent of ports of processors whose type is not known.
const UNKNOWN: Color32 = Color32::from_gray(0x80);

/// What the pointer may rest on.
pub enum Resting {
    /// A node.
    Node(String),
    /// A socket.
    Socket(Socket),
    /// A wire, by the outport whose data flows there.
    Wire(Connection),
}

/// One frame of the canvas.
pub struct Scene<'a> {
    session: &'a Session,
    sockets: BTreeMap<&'a str, Sockets>,
    fed: BTreeMap<&'a Address, Vec<&'a Connection>>,
    feeding: BTreeSet<&'a Address>,
    waiting: BTreeSet<&'a str>,
    /// A wire in the user's hand.
    pub drag: Option<&'a Drag>,
    /// What that wire would do.
    pub target: Option<&'a Target>,
    /// Selected wires.
    pub selected: &'a BTreeSet<Connection>,
    /// A wire that something dragged would be put into.
    pub under_load: Option<Connection>,
    /// Where things are.
    pub geometry: Geometry,
    /// What the user did.
    pub actions: Vec<Action>,
    /// What the pointer may rest on, for tooltips.
    pub resting: Vec<(Response, Resting)>,
}

/// Smallest distance of the dots of the grid in the window, and their distance at zoom 1, both in points.
const GRID: (f32, f32) = (16.0, 24.0);

/// The library's id of a processor's node.
pub fn node_id(processor: &str) -> NodeId {
    NodeId::new(processor)
}

impl<'a> Scene<'a> {
    /// A frame of a session's network.
    pub fn new(session: &'a Session, selected: &'a BTreeSet<Connection>) -> Self {
        let network = session.network();
        let fed = fed(network.connections());
        Self {
            session,
            sockets: network.processors().map(|p| (p.id(), Sockets::of(network, p, &fed))).collect(),
            fed,
            feeding: network.connections().iter().map(|wire| &wire.from).collect(),
            waiting: waiting(network),
            drag: None,
            target: None,
            selected,
            under_load: None,
            geometry: Geometry::default(),
            actions: Vec::new(),
            resting: Vec::new(),
        }
    }

    /// To be called first: learns how the canvas lies in the window, and tells assistive technology, which the scene of egui
    /// leaves out.
    pub fn begin(&mut self, ui: &Ui) {
        let Some(transform) = ui.ctx().layer_transform_to_global(ui.layer_id()) else { return };
        self.geometry.to_window = transform;
        let scale = f64::from(transform.scaling);
        let [x, y] = [transform.translation.x.into(), transform.translation.y.into()];
        ui.ctx().accesskit_node_builder(ui.unique_id(), |node| {
            node.set_transform(egui::accesskit::Affine::new([scale, 0.0, 0.0, scale, x, y]));
        });
    }

    /// Draws dots behind everything else, so that it is seen how the canvas moves. The library's own fade unevenly when small.
    pub fn grid(&self, ui: &Ui) {
        let transform = self.geometry.to_window;
        let doublings = (GRID.0 / (GRID.1 * transform.scaling)).log2().ceil();
        let step = GRID.1 * doublings.exp2();
        let seen = transform.inverse() * self.geometry.area;
        let color = ui.visuals().weak_text_color().gamma_multiply(0.35);
        let pixel = 1.0 / ui.ctx().pixels_per_point();
        let numbers = |range: egui::Rangef| (range.min / step).ceil() as i32..=(range.max / step).floor() as i32;
        for row in numbers(seen.y_range()) {
            for column in numbers(seen.x_range()) {
                // On whole pixels of the window, or every dot would be blurred in its own way.
                let at = transform * (step * Pos2::new(column as f32, row as f32));
                let at = ((at / pixel).floor() + Vec2::splat(0.5)) * pixel;
                ui.painter().circle_filled(transform.inverse() * at, 0.8 / transform.scaling, color);
            }
        }
    }

    /// Draws the frames, behind everything else.
    pub fn frames(&mut self, ui: &mut Ui) {
        frames::show(ui, self.session, self.geometry.to_window.scaling, &mut self.actions);
    }

    /// Draws the nodes.
    pub fn nodes(&mut self, context: &mut NodesCtx<'_>, ui: &mut Ui) {
        for processor in self.session.network().processors() {
            self.node(processor, context, ui);
        }
    }

    fn node(&mut self, processor: &'a Processor, context: &mut NodesCtx<'_>, ui: &mut Ui) {
        let id = processor.id();
        let card = self.card(processor);
        let node = Node::from_id(node_id(id))
            .inputs(card.inports.len())
            .outputs(card.outports.len())
            .socket_color(Color32::TRANSPARENT)
            .max_width(600.0);
        let response = node.show_or_cull(context, ui, |node| {
            let frame = node::frame(node.style(), &card.state, node.interaction());
            node.framed_with(frame, |ui, sockets| card.show(ui, sockets))
        });
        let label = format!("processor {id} ({}): {}", card.kind, card.state.word());
        response.widget_info(|| WidgetInfo::labeled(WidgetType::Button, true, &label));
        self.geometry.nodes.insert(id.to_owned(), response.rect);
        for (index, socket) in response.sockets().inputs() {
            self.socket(ui, &response, (id, index, SocketKind::Input), socket, &card.inports[index]);
        }
        for (index, socket) in response.sockets().outputs() {
            self.socket(ui, &response, (id, index, SocketKind::Output), socket, &card.outports[index]);
        }
        if let Some(EdgeEvent::Started { kind, index }) = response.edge_event() {
            self.actions.extend(self.numbered(id, kind, index).cloned().map(Action::Hold));
        }
        // The library sees no click that begins and ends within one frame.
        let clicked = response.clicked() && !ui.input(|input| input.modifiers.any());
        let at_once = ui.input(|input| input.pointer.primary_pressed() && input.pointer.primary_released());
        if response.clicked() && at_once && ui.input(|input| input.modifiers.command || input.modifiers.shift) {
            let mut selection = self.session.selection.clone();
            if !selection.remove(id) {
                selection.insert(id.to_owned());
            }
            self.actions.push(Action::Select(selection));
        }
        if (clicked || response.secondary_clicked()) && !self.session.selection.contains(id) {
            self.actions.push(Action::Select([id.to_owned()].into()));
        }
        response.context_menu(|ui| menus::node(ui, self.session, id, &mut self.actions));
        self.resting.push(((*response).clone(), Resting::Node(id.to_owned())));
    }

    fn socket(
        &mut self,
        ui: &mut Ui,
        node: &Response,
        (id, index, kind): (&str, usize, SocketKind),
        response: &Response,
        port: &Port,
    ) {
        let Some(socket) = self.numbered(id, kind, index).cloned() else { return };
        let grip = self.grip(ui, node, (index, kind), response.rect.center());
        if grip.is_pointer_button_down_on() && ui.input(|input| input.pointer.primary_pressed()) {
            self.actions.push(Action::Hold(socket.clone()));
        }
        node::socket(ui, node, &grip, port, if kind == SocketKind::Input { -1.0 } else { 1.0 });
        grip.widget_info(|| WidgetInfo::labeled(WidgetType::Button, true, socket.to_string()));
        self.geometry.sockets.insert(socket.clone(), response.rect.center());
        self.resting.push((grip, Resting::Socket(socket)));
    }

    /// Where a socket is taken hold of, over the node: the library lets go of wires only beside nodes, and there the pointer is
    /// still near enough to them to take hold of the node.
    fn grip(&self, ui: &mut Ui, node: &Response, (index, kind): (usize, SocketKind), center: Pos2) -> Response {
        let radius = (GRIP / self.geometry.to_window.scaling).clamp(RADIUS, 0.5 * ROW);
        let id = node.id.with(("grip", index, kind == SocketKind::Input));
        let area = Rect::from_center_size(center, Vec2::splat(2.0 * radius));
        let builder = UiBuilder::new().layer_id(node.layer_id).max_rect(area);
        ui.scope_builder(builder, |ui| ui.interact(area, id, Sense::click_and_drag())).inner
    }

    fn numbered(&self, id: &str, kind: SocketKind, index: usize) -> Option<&Socket> {
        let sockets = self.sockets.get(id)?;
        match kind {
            SocketKind::Input => sockets.inputs.get(index),
            SocketKind::Output => sockets.outputs.get(index),
        }
    }

    fn card(&self, processor: &'a Processor) -> Card {
        let id = processor.id();
        let sockets = &self.sockets[id];
        let declaration = processor.declaration();
        let run = self.session.engine.results.runs.get(id);
        let state = State::of(self.session, id, self.waiting.contains(id));
        Card {
            title: processor.label().unwrap_or(id).to_owned(),
            kind: declaration.map_or(processor.type_id(), |d| d.label.as_str()).to_owned(),
            time: match state {
                State::Stale => "stale".to_owned(),
                _ => run.map(|run| short(cost(run))).unwrap_or_default(),
            },
            state,
            inports: sockets.inputs.iter().map(|socket| self.inport(processor, socket)).collect(),
            outports: sockets.outputs.iter().map(|socket| self.outport(processor, &socket.end)).collect(),
            zoom: self.geometry.to_window.scaling,
        }
    }

    fn inport(&self, processor: &Processor, socket: &Socket) -> Port {
        let Socket { end, wire } = socket;
        let inport = processor.declaration().and_then(|d| d.inport(&end.address().item));
        let port = Port {
            label: inport.map_or(end.address().item.clone(), |port| port.label.clone()),
            color: color(inport.and_then(|port| port.accepts.first().copied())),
            connected: self.fed.contains_key(end.address()),
            optional: inport.is_none_or(|port| port.optional),
            light: self.light(end),
            role: if inport.is_some_and(|port| port.several) { Role::Several } else { Role::One },
        };
        let Some(wire) = wire else { return port };
        let source = self.session.network().processor(&wire.from.processor);
        let name = source.and_then(Processor::label).unwrap_or(&wire.from.processor).to_owned();
        // Wires are added at the socket of the port, not here.
        let light = if port.light == Light::Dim { Light::Dim } else { Light::Normal };
        Port { label: name, light, role: Role::Wire, ..port }
    }

    fn outport(&self, processor: &Processor, end: &End) -> Port {
        let outport = processor.declaration().and_then(|d| d.outport(&end.address().item));
        Port {
            label: outport.map_or(end.address().item.clone(), |port| port.label.clone()),
            color: color(outport.map(|port| port.port_type)),
            connected: self.feeding.contains(end.address()),
            optional: false,
            light: self.light(end),
            role: Role::One,
        }
    }

    fn light(&self, end: &End) -> Light {
        let Some(drag) = self.drag else { return Light::Normal };
        match self.target {
            Some(Target::Connect(chosen)) if chosen == end => Light::Chosen,
            _ if drag.anchor == *end => Light::Chosen,
            _ if drag.fits(end) => Light::Fits,
            _ => Light::Dim,
        }
    }

    /// Draws the wires, and the one in the user's hand.
    pub fn wires(&mut self, context: &mut EdgesCtx, ui: &mut Ui) {
        for wire in self.session.network().connections() {
            self.wire(wire, context, ui);
        }
        self.loose_wire(ui);
    }

    fn wire(&mut self, wire: &'a Connection, context: &mut EdgesCtx, ui: &mut Ui) {
        let Some(places) = self.places(wire) else { return };
        let color = self.wire_color(wire);
        let held = self.drag.is_some_and(|drag| drag.held.as_ref() == Some(wire));
        let loaded = self.under_load.as_ref() == Some(wire);
        let mut selected = self.selected.contains(wire);
        let halo = ui.visuals().selection.stroke.color.gamma_multiply(0.55);
        let way = self.geometry.way(wire);
        let edge = Edge::new(places.0, places.1, &mut selected).shape(WIRE).waypoints(&way).show_with(
            context,
            ui,
            |ui, paint| {
                if held {
                    return;
                }
                if paint.selected || loaded {
                    ui.painter().add(Shape::line(paint.points.to_vec(), Stroke::new(7.0, halo)));
                }
                let width = if paint.hovered || loaded { 4.0 } else { 2.5 };
                ui.painter().add(Shape::line(paint.points.to_vec(), Stroke::new(width, color)));
            },
        );
        edge.widget_info(|| WidgetInfo::labeled(WidgetType::Button, true, format!("wire {wire}")));
        let changed = edge.changed();
        let response: Response = edge.into();
        if response.middle_clicked() {
            self.actions.push(Action::Pin(wire.from.clone()));
        }
        if response.clicked() && ui.input(|input| input.modifiers.alt) {
            self.actions.push(Action::Cut(wire.clone()));
        } else if changed {
            self.actions.push(Action::SelectWire(wire.clone(), selected));
        }
        response.context_menu(|ui| menus::wire(ui, self.session, wire, &self.geometry, &mut self.actions));
        self.resting.push((response, Resting::Wire(wire.clone())));
    }

    fn places(&self, wire: &Connection) -> Option<((NodeId, usize), (NodeId, usize))> {
        let output = self.sockets.get(wire.from.processor.as_str())?.output(wire)?;
        let input = self.sockets.get(wire.to.processor.as_str())?.input(wire)?;
        Some(((node_id(&wire.from.processor), output), (node_id(&wire.to.processor), input)))
    }

    fn wire_color(&self, wire: &Connection) -> Color32 {
        let full = color(End::Outport(wire.from.clone()).types(self.session.network()).first().copied());
        if self.drag.is_some() { full.gamma_multiply(0.35) } else { full.gamma_multiply(0.85) }
    }

    fn loose_wire(&self, ui: &Ui) {
        let (Some(drag), Some(pointer)) = (self.drag, ui.input(|input| input.pointer.latest_pos())) else { return };
        let Some(start) = self.geometry.place(&drag.anchor) else { return };
        let loose = self.geometry.to_window.inverse() * pointer;
        let (end, color) = match self.target {
            Some(Target::Connect(end)) => (self.geometry.place(end).unwrap_or(loose), theme::READY),
            Some(Target::Refuse(..)) => (loose, theme::ERROR),
            _ => (loose, color(drag.anchor.types(self.session.network()).first().copied())),
        };
        let path = match drag.anchor {
            End::Outport(_) => Geometry::path(start, &[], end),
            End::Inport(_) => Geometry::path(end, &[], start),
        };
        let points: Vec<Pos2> = path.flatten(5.0).collect();
        ui.painter().add(Shape::line(points, Stroke::new(3.0, color)));
        ui.painter().circle_filled(end, 4.0, color);
    }

    /// Says how to begin where there is nothing.
    pub fn welcome(&self, ui: &Ui) {
        if self.session.network().processors().next().is_some() {
            return;
        }
        let lines = "Press Space to add a processor,\nor drag one here from the list.";
        let (font, color) = (egui::FontId::proportional(15.0), ui.visuals().weak_text_color());
        let galley = ui.painter().layout_job(egui::text::LayoutJob {
            halign: egui::Align::Center,
            ..egui::text::LayoutJob::simple(lines.to_owned(), font, color, f32::INFINITY)
        });
        let at = ui.clip_rect().center() - Vec2::new(0.0, 0.5 * galley.size().y);
        ui.painter().galley(at, galley, color);
    }
}

/// The accent of a port type.
fn color(port_type: Option<PortType>) -> Color32 {
    port_type.map_or(UNKNOWN, theme::port_color)
}

/// The connections by the inport where they end, in the order in which the processor sees them.
fn fed(connections: &[Connection]) -> BTreeMap<&Address, Vec<&Connection>> {
    let mut fed: BTreeMap<&Address, Vec<&Connection>> = BTreeMap::new();
    for wire in connections {
        fed.entry(&wire.to).or_default().push(wire);
    }
    fed.values_mut().for_each(|wires| wires.sort());
    fed
}
