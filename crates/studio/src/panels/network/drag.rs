//! A wire in the user's hand.

use std::collections::BTreeMap;

use egui::Pos2;
use rayloom_network::{Connection, Network};

use super::geometry::Geometry;
use super::socket::Socket;
use crate::wiring::{End, verdict};

/// A wire being drawn, or taken off and held.
pub struct Drag {
    /// The end that stays.
    pub anchor: End,
    /// The connection that it was; a wire drawn anew was none.
    pub held: Option<Connection>,
    /// For every port of the network, whether the wire may end there, or why not.
    verdicts: BTreeMap<End, Result<(), String>>,
}

/// What a wire would do if it were let go.
#[derive(Debug, PartialEq)]
pub enum Target {
    /// Be connected.
    Connect(End),
    /// Nothing, for this reason.
    Refuse(End, String),
    /// Go back to where it was.
    Back,
    /// Lie on empty canvas.
    Nowhere,
}

impl Drag {
    /// Takes hold of a socket: of its wire if there is one that can be moved, else of a new one.
    pub fn start(network: &Network, at: Socket) -> Self {
        let held = at.wire.or_else(|| only_wire(network, &at.end));
        let anchor = held.as_ref().map_or(at.end, |wire| End::Outport(wire.from.clone()));
        let mut without = network.clone();
        if let Some(wire) = &held {
            without.disconnect(&wire.from, &wire.to);
        }
        let verdicts = ends(&without).map(|end| (end.clone(), verdict(&without, &anchor, &end))).collect();
        Self { anchor, held, verdicts }
    }

    /// Whether the wire may end at a port.
    pub fn fits(&self, end: &End) -> bool {
        self.verdicts.get(end).is_some_and(Result::is_ok)
    }

    /// Whether a port is one of the kind that the wire looks for, an inport or an outport.
    fn opposite(&self, end: &End) -> bool {
        self.anchor.wire(end).is_some()
    }

    /// What happens if the wire is let go at a point of the canvas.
    pub fn target(&self, geometry: &Geometry, at: Pos2) -> Target {
        let near = geometry.socket_near(at, |end| self.opposite(end));
        if let Some(end) = near.map(|socket| &socket.end).or_else(|| self.best_of(geometry.node_at(at)?)) {
            let was = self.held.as_ref().is_some_and(|wire| wire.to == *end.address());
            return if was { Target::Back } else { self.judge(end) };
        }
        match geometry.socket_near(at, |end| *end == self.anchor).is_some()
            || geometry.node_at(at).is_some_and(|id| id == self.anchor.address().processor)
        {
            true => Target::Back,
            false => Target::Nowhere,
        }
    }

    fn judge(&self, end: &End) -> Target {
        match self.verdicts.get(end) {
            Some(Err(reason)) => Target::Refuse(end.clone(), reason.clone()),
            _ => Target::Connect(end.clone()),
        }
    }

    /// The port of a processor that a wire let go on its node means: the first that fits, else the first.
    fn best_of(&self, processor: &str) -> Option<&End> {
        let own = processor == self.anchor.address().processor;
        let mut ports =
            self.verdicts.keys().filter(|end| !own && end.address().processor == processor && self.opposite(end));
        let first = ports.clone().next();
        ports.find(|end| self.fits(end)).or(first)
    }
}

/// The wire into an inport for one.
fn only_wire(network: &Network, end: &End) -> Option<Connection> {
    let End::Inport(to) = end else { return None };
    let inport = network.processor(&to.processor)?.declaration()?.inport(&to.item)?;
    network.inputs(&to.processor).find(|wire| !inport.several && wire.to == *to).cloned()
}

/// All ports of a network.
fn ends(network: &Network) -> impl Iterator<Item = End> {
    let of = |processor: &rayloom_network::Processor| -> Vec<End> {
        let Some(declaration) = processor.declaration() else { return Vec::new() };
        let id = processor.id();
        let inports = declaration.inports.iter().map(|port| End::Inport((id, port.id.as_str()).into()));
        let outports = declaration.outports.iter().map(|port| End::Outport((id, port.id.as_str()).into()));
        inports.chain(outports).collect()
    };
    network.processors().flat_map(of)
}
