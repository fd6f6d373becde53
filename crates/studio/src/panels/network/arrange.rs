//! Laying the network out, and bringing all of it into view.

use egui::{Context, Direction, Rect};
use egui_graph::{LayoutNode, LayoutParams, layout};
use rayloom_network::EditError;

use super::NetworkPanel;
use super::frames;
use super::scene::node_id;
use crate::session::Session;
use crate::wiring::End;

/// Space around everything when all of it is shown, points of the window.
const BORDER: f32 = 36.0;

impl NetworkPanel {
    /// Lays all processors out from left to right along the wires; one step of the history.
    pub(super) fn arrange(&mut self, context: &Context, session: &mut Session) {
        let network = session.network();
        let processors = network.processors().filter_map(|processor| {
            let id = processor.id();
            let rect = *self.geometry.nodes.get(id)?;
            let declaration = processor.declaration();
            let offset = |end: &End| self.geometry.place(end).map_or(f32::NAN, |at| at.y - rect.top());
            let inputs =
                declaration.map(|d| d.inports.iter().map(|p| offset(&End::Inport((id, p.id.as_str()).into()))));
            let outputs =
                declaration.map(|d| d.outports.iter().map(|p| offset(&End::Outport((id, p.id.as_str()).into()))));
            let node = LayoutNode::new(rect.size())
                .input_offsets(inputs.map(Iterator::collect).unwrap_or_default())
                .output_offsets(outputs.map(Iterator::collect).unwrap_or_default());
            Some((node_id(id), node))
        });
        let port = |id: &str, item: &str, input: bool| {
            let declaration = network.processor(id).and_then(|p| p.declaration());
            let index = declaration.and_then(|d| match input {
                true => d.inports.iter().position(|port| port.id == item),
                false => d.outports.iter().position(|port| port.id == item),
            });
            (node_id(id), index.unwrap_or_default())
        };
        let wires = network.connections().iter().map(|wire| {
            (port(&wire.from.processor, &wire.from.item, false), port(&wire.to.processor, &wire.to.item, true))
        });
        let params = LayoutParams::new(Direction::LeftToRight).layer_gap(70.0).node_gap(36.0);
        let places = layout(processors, wires, params);
        let ids: Vec<String> = network.processors().map(|p| p.id().to_owned()).collect();
        session.edit("arrange", |network| -> Result<(), EditError> {
            for id in &ids {
                if let Some(at) = places.get(&node_id(id)) {
                    network.set_position(id, [at.x.round().into(), at.y.round().into()])?;
                }
            }
            Ok(())
        });
        self.synced = 0;
        self.fit = true;
        context.request_repaint();
    }

    /// Brings all nodes into view once their sizes are known, no larger than life.
    pub(super) fn fit_view(&mut self, context: &Context, session: &Session, area: Rect) {
        if !self.fit {
            return;
        }
        let known = |id: &str| self.geometry.nodes.contains_key(id);
        if !session.network().processors().all(|processor| known(processor.id())) {
            // Sizes are known after the first pass; nothing is shown before.
            context.request_discard("sizes of new nodes");
            return;
        }
        let mut bounds = session.network().frames().iter().map(frames::rect).reduce(|all, frame| all.union(frame));
        for processor in session.network().processors() {
            let (Some(at), Some(rect)) =
                (self.view.layout.get(&node_id(processor.id())), self.geometry.nodes.get(processor.id()))
            else {
                continue;
            };
            let rect = Rect::from_min_size(*at, rect.size());
            bounds = Some(bounds.map_or(rect, |all| all.union(rect)));
        }
        self.fit = false;
        let shown = bounds.map_or(Rect::from_min_size(egui::Pos2::ZERO, area.size()), |all| {
            let room = (area.size() - egui::Vec2::splat(2.0 * BORDER)).max(egui::Vec2::splat(1.0));
            all.expand(BORDER * (all.size() / room).max_elem().max(1.0))
        });
        self.view.scene_rect = match shown.width() < area.width() && shown.height() < area.height() {
            true => Rect::from_center_size(shown.center(), area.size()),
            false => shown,
        };
        context.request_repaint();
    }
}
