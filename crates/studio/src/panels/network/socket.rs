//! The sockets of a node: one for each port, and at an inport for several connections one more for each wire that ends there.

use std::collections::BTreeMap;
use std::fmt;

use rayloom_network::{Address, Connection, Network, Processor};

use crate::wiring::End;

/// Where a wire can be taken hold of or dropped.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Socket {
    /// The port.
    pub end: End,
    /// The one wire that ends here; `None` where wires are added, or where there can be one only.
    pub wire: Option<Connection>,
}

impl Socket {
    /// The socket of a port itself.
    pub fn of(end: End) -> Self {
        Self { end, wire: None }
    }

    /// The socket where a wire ends at an inport for several.
    pub fn of_wire(wire: &Connection) -> Self {
        Self { end: End::Inport(wire.to.clone()), wire: Some(wire.clone()) }
    }
}

impl fmt::Display for Socket {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let side = if matches!(self.end, End::Inport(_)) { "input" } else { "output" };
        write!(f, "{side} {}", self.end.address())?;
        self.wire.as_ref().map_or(Ok(()), |wire| write!(f, " from {}", wire.from))
    }
}

/// The sockets of a processor from the top, as the library numbers them.
#[derive(Default)]
pub struct Sockets {
    /// Those on the left.
    pub inputs: Vec<Socket>,
    /// Those on the right.
    pub outputs: Vec<Socket>,
}

impl Sockets {
    /// The sockets of a processor, with the connections of the network by their inport; those of a placeholder as its
    /// connections name them.
    pub fn of(network: &Network, processor: &Processor, fed: &BTreeMap<&Address, Vec<&Connection>>) -> Self {
        let id = processor.id();
        let Some(declaration) = processor.declaration() else {
            return Self::of_placeholder(network, id);
        };
        let mut sockets = Self::default();
        for port in &declaration.inports {
            let address = Address::new(id, port.id.as_str());
            let wires = fed.get(&address).filter(|_| port.several).into_iter().flatten();
            let of_wires = wires.map(|wire| Socket::of_wire(wire));
            let of_wires: Vec<Socket> = of_wires.collect();
            sockets.inputs.push(Socket::of(End::Inport(address)));
            sockets.inputs.extend(of_wires);
        }
        let outports = declaration.outports.iter().map(|port| End::Outport((id, port.id.as_str()).into()));
        sockets.outputs = outports.map(Socket::of).collect();
        sockets
    }

    fn of_placeholder(network: &Network, id: &str) -> Self {
        let mut inputs: Vec<Socket> = network.inputs(id).map(|wire| Socket::of(End::Inport(wire.to.clone()))).collect();
        let mut outputs: Vec<Socket> =
            network.outputs(id).map(|wire| Socket::of(End::Outport(wire.from.clone()))).collect();
        for sockets in [&mut inputs, &mut outputs] {
            sockets.sort();
            sockets.dedup();
        }
        Self { inputs, outputs }
    }

    /// The number of the socket where a wire ends.
    pub fn input(&self, wire: &Connection) -> Option<usize> {
        let own = self.inputs.iter().position(|socket| socket.wire.as_ref() == Some(wire));
        own.or_else(|| self.inputs.iter().position(|socket| *socket.end.address() == wire.to))
    }

    /// The number of the socket where a wire begins.
    pub fn output(&self, wire: &Connection) -> Option<usize> {
        self.outputs.iter().position(|socket| *socket.end.address() == wire.from)
    }
}
