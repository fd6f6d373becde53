//! The node canvas: shows the network, and edits it.

mod action;
mod arrange;
mod drag;
mod frames;
mod geometry;
mod menus;
mod minimap;
mod node;
mod route;
mod scene;
mod socket;
pub(super) mod state;
mod svg;
mod text;
mod waiting;
mod zoom;

use std::collections::{BTreeSet, HashSet};

use egui::{DragAndDrop, Event, Key, Pos2, Rect, Response, Ui};
use egui_graph::{Graph, View};
use rayloom_network::{Address, Connection, EditError};

use crate::catalog::NewProcessor;
use crate::inspect;
use crate::pane::Pane;
use crate::session::Session;
use crate::theme;
use crate::wiring::End;
pub use action::Action;
use drag::{Drag, Target};
use geometry::Geometry;
use menus::{LooseEnd, LooseLink};
use scene::{Resting, Scene, node_id};
use socket::Socket;

/// Distance from a wire at which the pointer touches it, points of the window.
const TOUCH: f32 = 6.0;

/// What the pointer does, for the list of keys.
pub const GESTURES: &[(&str, &str)] = &[
    ("Drag a socket", "connect; on empty canvas: add what fits"),
    ("Drag a wire's end", "plug it elsewhere, or cut it"),
    ("Drop on a doubled socket", "add to the wires there"),
    ("Alt and click", "cut a wire"),
    ("Rest on a wire", "see what flows there"),
    ("Drag", "select; with a node: move it"),
    ("Ctrl or Shift and click", "add to the selection"),
    ("Middle drag", "move"),
    ("Wheel, pinch", "zoom to the pointer"),
    ("Right click", "menu"),
];

/// What the canvas remembers from frame to frame.
pub struct NetworkPanel {
    view: View,
    /// Revision of the document whose positions `view` holds.
    synced: u64,
    /// Whether to bring everything into view.
    fit: bool,
    geometry: Geometry,
    /// Selected wires.
    wires: BTreeSet<Connection>,
    drag: Option<Drag>,
    loose_end: Option<LooseEnd>,
    loose_link: Option<LooseLink>,
    /// A frame that is being dragged.
    frame: frames::Dragged,
    shows_map: bool,
    /// Where the menu of the empty canvas was opened.
    menu_at: Pos2,
    /// Whether the last click was here, so that keys are meant for the canvas.
    attentive: bool,
    /// Where the pointer was in the last frame.
    pointer: Option<Pos2>,
    drawing: svg::Drawing,
}

impl Default for NetworkPanel {
    fn default() -> Self {
        Self {
            view: View::default(),
            synced: 0,
            fit: true,
            geometry: Geometry::default(),
            wires: BTreeSet::new(),
            drag: None,
            loose_end: None,
            loose_link: None,
            frame: frames::Dragged::default(),
            shows_map: false,
            menu_at: Pos2::ZERO,
            attentive: true,
            pointer: None,
            drawing: svg::Drawing::default(),
        }
    }
}

impl NetworkPanel {
    /// Shows the network and lets the user edit it.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) {
        let area = ui.available_rect_before_wrap();
        let mut actions = Vec::new();
        self.notice(ui, area);
        self.clipboard(ui.ctx(), &mut actions);
        self.sync(session);
        self.fit_view(ui.ctx(), session, area);
        self.zoom(ui, area);
        let pointer = ui.input(|input| input.pointer.latest_pos());
        let on_canvas = pointer.and_then(|at| self.geometry.on_canvas(at));
        let target = self.drag.as_ref().zip(on_canvas).map(|(drag, at)| drag.target(&self.geometry, at));
        let deleting = ui.input(|input| input.key_pressed(Key::Delete) || input.key_pressed(Key::Backspace));

        let mut scene = Scene::new(session, &self.wires);
        scene.drag = self.drag.as_ref();
        scene.target = target.as_ref();
        let loaded = DragAndDrop::has_payload_of_type::<NewProcessor>(ui.ctx());
        scene.under_load =
            on_canvas.filter(|_| loaded).and_then(|at| self.geometry.wire_at(session.network(), at).cloned());
        scene.geometry.area = area;
        let selected: HashSet<_> = session.selection.iter().map(|id| node_id(id)).collect();
        // The library fills the background with this.
        ui.visuals_mut().widgets.noninteractive.bg_fill = ui.visuals().extreme_bg_color;
        // The distance at which wires are touched, which the library takes on the canvas, is one in the window.
        ui.style_mut().interaction.interact_radius = (TOUCH / self.geometry.to_window.scaling).clamp(3.0, 30.0);
        let graph = Graph::new("network").zoom_range(zoom::RANGE).dot_grid(false).selected_nodes(selected);
        let shown = graph.show(&mut self.view, ui, |ui, show| {
            scene.begin(ui);
            scene.grid(ui);
            scene.welcome(ui);
            scene.frames(ui);
            show.nodes(ui, |context, ui| scene.nodes(context, ui)).edges(ui, |context, ui| scene.wires(context, ui));
        });
        let Scene { geometry, actions: done, resting, .. } = scene;
        actions.extend(done);
        self.geometry = geometry;
        self.drawing.show(ui.ctx(), session, &self.geometry);

        if shown.nodes_moved {
            self.keep_positions(session);
        }
        // The library forgets selected nodes on Delete; here that key may be meant for another panel.
        if let Some(nodes) = shown.selection_changed.filter(|_| !deleting) {
            let ids = session.network().processors().map(|p| p.id().to_owned());
            session.selection = ids.filter(|id| nodes.contains(&node_id(id))).collect();
        }
        if shown.response.clicked() && !ui.input(|input| input.modifiers.any()) && self.drag.is_none() {
            session.selection.clear();
        }
        self.canvas_menu(&shown.response, session, &mut actions);
        self.let_go(ui, target, &mut actions);
        self.drops(ui, session, &mut actions);
        self.choose(ui, session, &mut actions);
        self.tooltips(ui, session, resting);
        self.buttons(ui, area, &mut actions);
        if self.shows_map
            && let Some(middle) = minimap::show(ui, session, &self.geometry)
        {
            self.view.scene_rect = Rect::from_center_size(middle, self.view.scene_rect.size());
        }
        if !ui.input(|input| input.pointer.any_down()) {
            self.frame = frames::Dragged::default();
        }
        for action in actions {
            self.apply(action, ui.ctx(), session);
        }
    }

    /// Draws the whole network into a file.
    pub fn draw(&mut self, session: &mut Session) {
        // What is out of sight has no place to be drawn at.
        self.fit = true;
        self.drawing.begin();
        session.to_open.push(Pane::Network);
    }

    /// Adds a processor where the pointer is, or in the middle of what is visible.
    pub fn add_at_pointer(&mut self, type_id: String, context: &egui::Context, session: &mut Session) {
        self.apply(Action::Add(type_id, self.place(context)), context, session);
    }

    /// Adds a processor in the middle of what is visible.
    pub fn add_in_the_middle(&mut self, type_id: &str, context: &egui::Context, session: &mut Session) {
        self.apply(Action::Add(type_id.to_owned(), self.geometry.center()), context, session);
    }

    /// Notices whether keys are meant for the canvas: they are once the pointer moved over it, until a click elsewhere.
    fn notice(&mut self, ui: &Ui, area: Rect) {
        let (pressed, pointer) = ui.input(|input| {
            let pressed = input.pointer.any_pressed().then(|| input.pointer.interact_pos()).flatten();
            (pressed, input.pointer.latest_pos())
        });
        // Not by how far it moved: a pointer that comes back into the window moved from nowhere.
        let moved = pointer.filter(|_| pointer != self.pointer);
        self.pointer = pointer;
        if let Some(at) = pressed {
            self.attentive = area.contains(at);
        } else if moved.is_some_and(|at| area.contains(at)) {
            self.attentive = true;
        }
    }

    /// Whether keys are meant for the canvas.
    pub fn is_attentive(&self) -> bool {
        self.attentive
    }

    /// Keys are meant for the canvas from now on.
    pub fn attend(&mut self) {
        self.attentive = true;
    }

    /// Whether any wires are selected.
    pub fn has_selected_wires(&self) -> bool {
        !self.wires.is_empty()
    }

    /// Takes the clipboard's events; all other keys are those of commands.
    fn clipboard(&mut self, context: &egui::Context, actions: &mut Vec<Action>) {
        if !self.attentive || context.egui_wants_keyboard_input() {
            return;
        }
        let at = self.place(context);
        context.input(|input| {
            for event in &input.events {
                match event {
                    Event::Copy => actions.push(Action::Copy),
                    Event::Cut => actions.extend([Action::Copy, Action::Delete { reconnect: false }]),
                    Event::Paste(text) => actions.push(Action::Paste(text.clone(), at)),
                    _ => {}
                }
            }
        });
    }

    /// Where something new goes: where the pointer is, or in the middle of what is visible.
    fn place(&self, context: &egui::Context) -> Pos2 {
        let pointer = context.input(|input| input.pointer.latest_pos());
        pointer.and_then(|at| self.geometry.on_canvas(at)).unwrap_or_else(|| self.geometry.center())
    }

    /// Takes over what changed in the document: positions, and what is gone from it.
    fn sync(&mut self, session: &mut Session) {
        let revision = session.document.revision();
        if self.synced == revision {
            return;
        }
        self.synced = revision;
        let network = session.document.network();
        self.view.layout =
            network.processors().map(|p| (node_id(p.id()), Pos2::from(p.position().map(|x| x as f32)))).collect();
        session.selection.retain(|id| network.processor(id).is_some());
        self.wires.retain(|wire| network.connections().contains(wire));
    }

    /// Stores where nodes were dragged to; one step of the history.
    fn keep_positions(&mut self, session: &mut Session) {
        let layout = &self.view.layout;
        let moved: Vec<(String, [f64; 2])> = session
            .network()
            .processors()
            .filter_map(|processor| {
                let at = layout.get(&node_id(processor.id()))?;
                let at = [f64::from(at.x.round()), f64::from(at.y.round())];
                (at != processor.position().map(f64::round)).then(|| (processor.id().to_owned(), at))
            })
            .collect();
        session.edit("move", |network| -> Result<(), EditError> {
            moved.iter().try_for_each(|(id, at)| network.set_position(id, *at))
        });
    }

    fn canvas_menu(&mut self, response: &Response, session: &Session, actions: &mut Vec<Action>) {
        if response.secondary_clicked()
            && let Some(at) = response.interact_pointer_pos()
        {
            self.menu_at = at;
        }
        response.context_menu(|ui| menus::canvas(ui, session, self.menu_at, actions));
    }

    /// Lets go of the wire in the user's hand; before, says why it would be refused.
    fn let_go(&mut self, ui: &Ui, target: Option<Target>, actions: &mut Vec<Action>) {
        if ui.input(|input| input.key_pressed(Key::Escape)) {
            self.drag = None;
        }
        let Some(drag) = &self.drag else { return };
        if let Some(Target::Refuse(_, reason)) = &target {
            egui::Tooltip::always_open(
                ui.ctx().clone(),
                ui.layer_id(),
                ui.id().with("refusal"),
                egui::PopupAnchor::Pointer,
            )
            .gap(14.0)
            .show(|ui| theme::colored(ui, theme::ERROR, reason));
        }
        if !ui.input(|input| input.pointer.primary_released()) {
            return;
        }
        let window = ui.input(|input| input.pointer.latest_pos()).unwrap_or_default();
        match (target, &drag.held) {
            (Some(Target::Connect(end)), held) => {
                actions.extend(drag.anchor.wire(&end).map(|wire| Action::Connect(wire, held.clone())));
            }
            (Some(Target::Refuse(_, reason)), _) => actions.push(Action::Refuse(reason)),
            (Some(Target::Nowhere), Some(wire)) => actions.push(Action::Cut(wire.clone())),
            (Some(Target::Nowhere), None) => {
                let at = self.geometry.to_window.inverse() * window;
                self.loose_end = Some(LooseEnd { end: drag.anchor.clone(), at, window });
            }
            (Some(Target::Back) | None, _) => {}
        }
        self.drag = None;
    }

    /// What was dragged here from the list of processors or from the desktop.
    fn drops(&self, ui: &Ui, session: &Session, actions: &mut Vec<Action>) {
        let at = ui.input(|input| input.pointer.latest_pos()).and_then(|at| self.geometry.on_canvas(at));
        if let Some(at) = at
            && ui.input(|input| input.pointer.primary_released())
            // Taking something of another type would lose it.
            && DragAndDrop::has_payload_of_type::<NewProcessor>(ui.ctx())
            && let Some(new) = DragAndDrop::take_payload::<NewProcessor>(ui.ctx())
        {
            let type_id = new.0.clone();
            actions.push(match self.geometry.wire_at(session.network(), at) {
                Some(wire) => Action::Insert(type_id, wire.clone(), at),
                None => Action::Add(type_id, at),
            });
        }
        if let Some(at) = at
            && ui.input(|input| input.pointer.primary_released())
            && let Some(processor) = self.geometry.node_at(at)
            && DragAndDrop::has_payload_of_type::<Address>(ui.ctx())
            && let Some(leader) = DragAndDrop::take_payload::<Address>(ui.ctx())
        {
            let (window, processor) = (self.geometry.to_window * at, processor.to_owned());
            actions.push(Action::OfferLinks(LooseLink { leader: (*leader).clone(), processor, window }));
        }
        let files = ui.input(|input| input.raw.dropped_files.clone());
        for file in files {
            let at = at.unwrap_or_else(|| self.geometry.center());
            actions.push(Action::AddFile(file.path().to_string_lossy().into_owned(), at));
        }
    }

    /// The menu at a loose wire.
    fn choose(&mut self, ui: &mut Ui, session: &Session, actions: &mut Vec<Action>) {
        if let Some(menu) = self.loose_end.take() {
            self.loose_end = menus::loose_end(ui, session, menu, actions);
        }
        if let Some(menu) = self.loose_link.take() {
            self.loose_link = menus::loose_link(ui, session, menu, actions);
        }
    }

    /// What resting on a node, a socket or a wire shows.
    fn tooltips(&self, ui: &Ui, session: &mut Session, resting: Vec<(Response, Resting)>) {
        let asks = self.loose_end.is_some() || self.loose_link.is_some() || egui::Popup::is_any_open(ui.ctx());
        if asks || self.drag.is_some() || ui.input(|input| input.pointer.any_down()) {
            return;
        }
        let pointer = ui.input(|input| input.pointer.latest_pos());
        let on_canvas = pointer.and_then(|at| self.geometry.on_canvas(at));
        for (response, what) in resting {
            match what {
                // The inner half of a socket lies on its node.
                Resting::Node(id) => drop(match on_canvas.and_then(|at| self.geometry.socket_at(at, &id)) {
                    Some(socket) => response.on_hover_ui_at_pointer(|ui| socket_tooltip(ui, session, socket)),
                    None => response.on_hover_ui(|ui| state::tooltip(ui, session, &id)),
                }),
                Resting::Socket(socket) => {
                    response.on_hover_ui_at_pointer(|ui| socket_tooltip(ui, session, &socket));
                }
                // Where wires lie side by side, the library knows the last one that is near, not the nearest.
                Resting::Wire(wire) => {
                    let nearest = on_canvas.filter(|_| response.hovered());
                    let nearest = nearest.and_then(|at| self.geometry.wire_at(session.network(), at)).cloned();
                    let outport = nearest.unwrap_or(wire).from;
                    response.on_hover_ui_at_pointer(|ui| inspect::hover(ui, session, &outport));
                }
            }
        }
    }

    fn buttons(&self, ui: &Ui, area: Rect, actions: &mut Vec<Action>) {
        let id = ui.id().with("buttons");
        let place = area.right_bottom() - egui::vec2(10.0, 10.0);
        egui::Area::new(id).order(egui::Order::Middle).pivot(egui::Align2::RIGHT_BOTTOM).fixed_pos(place).show(
            ui.ctx(),
            |ui| {
                ui.horizontal(|ui| {
                    let mut button = |text: &str, help: &str, action: Action| {
                        if ui.small_button(text).on_hover_text(help).clicked() {
                            actions.push(action);
                        }
                    };
                    button("Map", "Show where this is in the whole network (M)", Action::Map);
                    button("Add", "Search a processor to add (Space, Ctrl+P)", Action::Palette);
                    button("Arrange", "Lay all processors out along the wires (L)", Action::Arrange);
                    button("Show all", "Bring the whole network into view (F)", Action::Fit);
                });
            },
        );
    }
}

/// What resting on a socket shows: what it is for, and what is there.
fn socket_tooltip(ui: &mut Ui, session: &mut Session, socket: &Socket) {
    ui.set_max_width(360.0);
    let end = &socket.end;
    let address = end.address();
    let declaration = session.network().processor(&address.processor).and_then(|p| p.declaration());
    let (label, help) = match end {
        End::Inport(_) => declaration.and_then(|d| d.inport(&address.item)).map(|port| (&port.label, &port.help)),
        End::Outport(_) => declaration.and_then(|d| d.outport(&address.item)).map(|port| (&port.label, &port.help)),
    }
    .map(|(label, help)| (label.clone(), help.clone()))
    .unwrap_or_default();
    let mut types = end.types(session.network()).iter().map(ToString::to_string).collect::<Vec<_>>().join(" or ");
    if matches!(end, End::Inport(_)) && declaration.and_then(|d| d.inport(&address.item)).is_some_and(|p| p.several) {
        types += ", takes several";
    }
    ui.horizontal(|ui| {
        ui.strong(label);
        ui.weak(format!("{address}, {types}"));
    });
    ui.label(help);
    if let Some(shown) = action::shown_at(session.network(), socket) {
        ui.separator();
        inspect::hover(ui, session, &shown);
    }
}
