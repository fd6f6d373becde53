//! Where everything on the canvas was drawn in the last frame, in the canvas's own coordinates.

use std::collections::BTreeMap;

use egui::emath::TSTransform;
use egui::{Pos2, Rect, Vec2};
use egui_graph::bezier::Path;
use egui_graph::edge::EdgeShape;
use rayloom_network::{Connection, Network};

use super::route;
use super::socket::Socket;
use crate::wiring::End;

/// How wires run.
pub const WIRE: EdgeShape = EdgeShape::Flow { curvature: 0.5, min_span: 36.0 };

/// Distance from a socket within which a wire snaps to it, points of the canvas.
const SNAP: f32 = 22.0;

/// Radius of a socket for the pointer, points of the canvas.
pub const RADIUS: f32 = 8.0;

/// Spacing of the points that a wire is measured by.
const STEP: f32 = 5.0;

/// Where nodes and sockets are.
pub struct Geometry {
    /// The frames of the nodes, by processor.
    pub nodes: BTreeMap<String, Rect>,
    /// The sockets of the nodes in view.
    pub sockets: BTreeMap<Socket, Pos2>,
    /// From the canvas to the window.
    pub to_window: TSTransform,
    /// The panel, in the window.
    pub area: Rect,
}

impl Default for Geometry {
    fn default() -> Self {
        Self {
            nodes: BTreeMap::new(),
            sockets: BTreeMap::new(),
            to_window: TSTransform::IDENTITY,
            area: Rect::from_min_size(Pos2::ZERO, Vec2::ZERO),
        }
    }
}

impl Geometry {
    /// A point of the window on the canvas, if it is within the panel.
    pub fn on_canvas(&self, window: Pos2) -> Option<Pos2> {
        self.area.contains(window).then(|| self.to_window.inverse() * window)
    }

    /// The middle of what is visible.
    pub fn center(&self) -> Pos2 {
        self.to_window.inverse() * self.area.center()
    }

    /// The processor whose node covers a point; the one drawn last where several do.
    pub fn node_at(&self, at: Pos2) -> Option<&str> {
        self.nodes.iter().rev().find(|(_, rect)| rect.contains(at)).map(|(id, _)| id.as_str())
    }

    /// The nearest socket that a wire at a point snaps to, among those that `wanted` lets through.
    pub fn socket_near(&self, at: Pos2, wanted: impl Fn(&End) -> bool) -> Option<&Socket> {
        let near = self.sockets.iter().filter(|(socket, place)| place.distance(at) < SNAP && wanted(&socket.end));
        near.min_by(|a, b| a.1.distance_sq(at).total_cmp(&b.1.distance_sq(at))).map(|(socket, _)| socket)
    }

    /// Where the socket of a port is.
    pub fn place(&self, end: &End) -> Option<Pos2> {
        self.sockets.get(&Socket::of(end.clone())).copied()
    }

    /// The socket of a processor that covers a point.
    pub fn socket_at(&self, at: Pos2, processor: &str) -> Option<&Socket> {
        self.socket_near(at, |end| end.address().processor == processor)
            .filter(|socket| self.sockets.get(socket).is_some_and(|place| place.distance(at) <= RADIUS))
    }

    /// The way of a wire between two points, the first where data comes out, by others.
    pub fn path(from: Pos2, way: &[Pos2], to: Pos2) -> Path {
        WIRE.path((from, Vec2::RIGHT), way, (to, Vec2::LEFT))
    }

    /// The points by which a connection's wire goes around the nodes in its way.
    pub fn way(&self, wire: &Connection) -> Vec<Pos2> {
        let Some((from, to)) = self.ends(wire) else { return Vec::new() };
        route::around(from, to, self.nodes.values().copied())
    }

    /// Where a connection's wire begins and ends, if that is in view.
    fn ends(&self, wire: &Connection) -> Option<(Pos2, Pos2)> {
        let own = self.sockets.get(&Socket::of_wire(wire)).copied();
        let to = own.or_else(|| self.place(&End::Inport(wire.to.clone())))?;
        Some((self.place(&End::Outport(wire.from.clone()))?, to))
    }

    /// The points of a connection's wire, if both its ends are in view.
    pub fn points(&self, wire: &Connection) -> Option<Vec<Pos2>> {
        let (from, to) = self.ends(wire)?;
        Some(Self::path(from, &self.way(wire), to).flatten(STEP).collect())
    }

    /// The connection whose wire passes a point; the nearest where several do.
    pub fn wire_at<'a>(&self, network: &'a Network, at: Pos2) -> Option<&'a Connection> {
        let distance = |wire: &Connection| {
            let points = self.points(wire)?;
            points.windows(2).map(|ends| distance_to_segment(at, ends[0], ends[1])).min_by(f32::total_cmp)
        };
        let near = network.connections().iter().filter_map(|wire| Some((distance(wire)?, wire)));
        near.filter(|(distance, _)| *distance < SNAP).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, wire)| wire)
    }
}

fn distance_to_segment(at: Pos2, from: Pos2, to: Pos2) -> f32 {
    let along = to - from;
    let share = (at - from).dot(along) / along.length_sq().max(f32::MIN_POSITIVE);
    at.distance(from + along * share.clamp(0.0, 1.0))
}
