//! Which ends fit together, and connecting them.

use rayloom_network::{Address, Connection, Declaration, Network, PortType, Refusal, Registry, can_connect};

/// One end of a wire.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum End {
    /// Where data comes out.
    Outport(Address),
    /// Where data goes in.
    Inport(Address),
}

impl End {
    /// The port.
    pub fn address(&self) -> &Address {
        match self {
            Self::Outport(address) | Self::Inport(address) => address,
        }
    }

    /// The connection between two ends; `None` when both are inports or both outports.
    pub fn wire(&self, other: &Self) -> Option<Connection> {
        let (from, to) = match (self, other) {
            (Self::Outport(from), Self::Inport(to)) | (Self::Inport(to), Self::Outport(from)) => (from, to),
            _ => return None,
        };
        Some(Connection { from: from.clone(), to: to.clone() })
    }

    /// The types that may flow here: one at an outport, those accepted at an inport. None when there is no such port.
    pub fn types(&self, network: &Network) -> Vec<PortType> {
        let address = self.address();
        let Some(declaration) = network.processor(&address.processor).and_then(|p| p.declaration()) else {
            return Vec::new();
        };
        match self {
            Self::Outport(_) => declaration.outport(&address.item).map(|port| vec![port.port_type]).unwrap_or_default(),
            Self::Inport(_) => declaration.inport(&address.item).map(|port| port.accepts.clone()).unwrap_or_default(),
        }
    }
}

/// Connects. An inport for one connection that is fed already is fed by the new wire instead.
///
/// # Errors
/// The connection is refused for another reason; the network may then lack the wire that was replaced, so edit a copy.
pub fn connect(network: &mut Network, wire: &Connection) -> Result<(), Refusal> {
    match network.connect(&wire.from, &wire.to) {
        Err(Refusal::Occupied { to, by }) => {
            network.disconnect(&by, &to);
            network.connect(&wire.from, &wire.to)
        }
        result => result,
    }
}

/// Takes a wire off and connects it elsewhere.
///
/// # Errors
/// As [`connect`].
pub fn re_plug(network: &mut Network, old: &Connection, new: &Connection) -> Result<(), Refusal> {
    network.disconnect(&old.from, &old.to);
    connect(network, new)
}

/// Whether a wire between two ends would be taken, replacing what [`connect`] replaces.
///
/// # Errors
/// The reason, a sentence.
pub fn verdict(network: &Network, one: &End, other: &End) -> Result<(), String> {
    let Some(wire) = one.wire(other) else {
        let kind = if matches!(one, End::Outport(_)) { "outputs" } else { "inputs" };
        return Err(format!(
            "{} and {} are both {kind}; connect an output to an input.",
            one.address(),
            other.address()
        ));
    };
    match can_connect(network, &wire.from, &wire.to) {
        // Only the wire that goes away was in the way, unless a cycle hides behind it.
        Err(Refusal::Occupied { .. }) if feeds(network, &wire.to.processor, &wire.from.processor) => {
            connect(&mut network.clone(), &wire).map_err(|refusal| refusal.to_string())
        }
        Err(Refusal::Occupied { .. }) => Ok(()),
        result => result.map_err(|refusal| refusal.to_string()),
    }
}

/// Whether data flows from one processor to another.
pub fn feeds(network: &Network, from: &str, to: &str) -> bool {
    let mut seen = std::collections::BTreeSet::from([from]);
    let mut stack = vec![from];
    while let Some(id) = stack.pop() {
        if id == to {
            return true;
        }
        stack.extend(network.outputs(id).map(|c| c.to.processor.as_str()).filter(|next| seen.insert(next)));
    }
    false
}

/// A processor type that a loose wire can end at.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit<'a> {
    /// The type.
    pub declaration: &'a str,
    /// What the user reads.
    pub label: &'a str,
    /// Its port.
    pub port: &'a str,
    /// What the user reads of the port.
    pub port_label: &'a str,
}

/// The processor types that have a port for the other end of a wire, with the first such port; by name.
pub fn fitting<'a>(registry: &'a Registry, network: &Network, end: &End) -> Vec<Fit<'a>> {
    let types = end.types(network);
    let fit = |declaration: &'a Declaration| {
        let (port, port_label) = port_for(declaration, end, &types)?;
        Some(Fit { declaration: &declaration.id, label: &declaration.label, port, port_label })
    };
    let mut fits: Vec<_> = registry.declarations().filter_map(fit).collect();
    fits.sort_by_key(|fit| fit.label);
    fits
}

/// Id and label of the first port of a type that takes the other end of a wire; a required inport goes before optional ones.
fn port_for<'a>(declaration: &'a Declaration, end: &End, types: &[PortType]) -> Option<(&'a str, &'a str)> {
    match end {
        End::Outport(_) => {
            let fits = declaration.inports.iter().filter(|port| types.iter().any(|t| port.accepts.contains(t)));
            fits.min_by_key(|port| port.optional).map(|port| (port.id.as_str(), port.label.as_str()))
        }
        End::Inport(_) => {
            let mut fits = declaration.outports.iter().filter(|port| types.contains(&port.port_type));
            fits.next().map(|port| (port.id.as_str(), port.label.as_str()))
        }
    }
}
