//! Adding processors where they belong.

use rayloom_network::{Address, Connection, Declaration, EditError, Network, PortType, Properties, Refusal};
use thiserror::Error;

use super::connect::{End, connect};
use super::link::link_cameras;
use super::rename::rename;

/// How far apart processors lie that follow one another, points of the canvas.
const COLUMN: f64 = 220.0;

/// Why processors cannot be wired this way.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum WiringError {
    /// An edit is refused.
    #[error(transparent)]
    Edit(#[from] EditError),
    /// A connection is refused.
    #[error(transparent)]
    Connection(#[from] Refusal),
    /// A processor has no ports for a place within a wire.
    #[error("a {label} does not fit into {wire}: it would have to take {found} and give what {} takes.", wire.to)]
    DoesNotFit {
        /// The type.
        label: String,
        /// The wire.
        wire: Box<Connection>,
        /// What flows through the wire.
        found: PortType,
    },
    /// The wire is gone.
    #[error("there is no connection {0} any more.")]
    NoWire(Box<Connection>),
}

/// Adds a processor of a type at a place. Returns its id, which is that of its type while it is free. Its camera follows the
/// others where these are one.
///
/// # Errors
/// An unknown type, or a place that is not finite.
pub fn add(network: &mut Network, type_id: &str, at: [f64; 2]) -> Result<String, EditError> {
    let id = network.free_id(type_id);
    network.add(type_id, &id)?;
    network.set_position(&id, at)?;
    link_cameras(network, &id);
    Ok(id)
}

/// Adds a processor and connects one of its ports with the loose end of a wire. Returns its id.
///
/// # Errors
/// As [`add`] and [`connect`].
pub fn add_connected(
    network: &mut Network,
    type_id: &str,
    at: [f64; 2],
    port: &str,
    end: &End,
) -> Result<String, WiringError> {
    let id = add(network, type_id, at)?;
    let address = Address::new(id.as_str(), port);
    let other = if matches!(end, End::Outport(_)) { End::Inport(address) } else { End::Outport(address) };
    if let Some(wire) = end.wire(&other) {
        connect(network, &wire)?;
    }
    Ok(id)
}

/// The ports by which a processor of a type can be put into a wire: its inport and its outport.
pub fn fits_into<'a>(network: &Network, declaration: &'a Declaration, wire: &Connection) -> Option<(&'a str, &'a str)> {
    let [flowing] = End::Outport(wire.from.clone()).types(network)[..] else { return None };
    let accepted = End::Inport(wire.to.clone()).types(network);
    let inport = declaration.inports.iter().find(|port| port.accepts.contains(&flowing))?;
    let outport = declaration.outports.iter().find(|port| accepted.contains(&port.port_type))?;
    Some((&inport.id, &outport.id))
}

/// Adds a processor within a wire. Returns its id.
///
/// # Errors
/// The processor does not fit there; and as [`add`].
pub fn insert(network: &mut Network, type_id: &str, at: [f64; 2], wire: &Connection) -> Result<String, WiringError> {
    let id = add(network, type_id, at)?;
    let declaration = network.processor(&id).and_then(|p| p.declaration()).cloned();
    let declaration =
        declaration.ok_or_else(|| EditError::UnknownType { id: type_id.to_owned(), hint: String::new() })?;
    let Some((inport, outport)) = fits_into(network, &declaration, wire) else {
        let flowing = End::Outport(wire.from.clone()).types(network).first().copied();
        let found = flowing.ok_or_else(|| WiringError::NoWire(Box::new(wire.clone())))?;
        return Err(WiringError::DoesNotFit { label: declaration.label, wire: Box::new(wire.clone()), found });
    };
    if !network.disconnect(&wire.from, &wire.to) {
        return Err(WiringError::NoWire(Box::new(wire.clone())));
    }
    network.connect(&wire.from, (id.as_str(), inport))?;
    network.connect((id.as_str(), outport), &wire.to)?;
    make_room(network, &id, wire)?;
    Ok(id)
}

/// Moves a processor that was put into a wire clear of the one before it, and all that lies behind out of its way.
fn make_room(network: &mut Network, id: &str, wire: &Connection) -> Result<(), EditError> {
    let place = |id: &str| network.processor(id).map(|processor| processor.position());
    let (Some([before, _]), Some([behind, _]), Some([x, y])) =
        (place(&wire.from.processor), place(&wire.to.processor), place(id))
    else {
        return Ok(());
    };
    // Wires that run backwards are the user's own order.
    if behind <= before {
        return Ok(());
    }
    let x = x.max(before + COLUMN);
    let missing = (x + COLUMN - behind).max(0.0);
    let later = network.processors().filter(|processor| processor.id() != id && processor.position()[0] >= behind);
    let moved: Vec<_> = later.map(|processor| (processor.id().to_owned(), processor.position())).collect();
    network.set_position(id, [x, y])?;
    moved.into_iter().try_for_each(|(id, [x, y])| network.set_position(&id, [x + missing, y]))
}

/// Puts a processor of another type in a processor's place, under a name that the user gave it; values of properties,
/// connections and links stay where they fit. An id that tells of the old type becomes one of the new type. Returns the id.
///
/// # Errors
/// An unknown processor or type.
pub fn replace(network: &mut Network, id: &str, type_id: &str) -> Result<String, EditError> {
    let unknown = || EditError::UnknownProcessor { id: id.to_owned(), hint: String::new() };
    let old = network.processor(id).ok_or_else(unknown)?.clone();
    let inputs: Vec<Connection> = network.inputs(id).cloned().collect();
    let outputs: Vec<Connection> = network.outputs(id).cloned().collect();
    let links: Vec<_> =
        network.links().iter().filter(|l| l.a.processor == id || l.b.processor == id).cloned().collect();
    network.remove(id)?;
    network.add(type_id, id)?;
    network.set_position(id, old.position())?;
    network.set_label(id, old.label().map(str::to_owned))?;
    take_over(network, id, &old.property_decls().iter().map(|p| p.id.clone()).collect::<Vec<_>>(), &old.properties());
    for wire in inputs {
        let end = End::Outport(wire.from);
        plug(network, id, &end, &wire.to.item);
    }
    for wire in outputs {
        let end = End::Inport(wire.to);
        plug(network, id, &end, &wire.from.item);
    }
    for link in links {
        // A property that the new type lacks cannot stay linked.
        let _ = network.link(link.a, link.b);
    }
    if !is_named_after(id, old.type_id()) {
        return Ok(id.to_owned());
    }
    let new = network.free_id(type_id);
    rename(network, id, &new)?;
    Ok(new)
}

/// Whether an id is what a processor of a type gets by itself: the type's own, with a number where that was taken.
fn is_named_after(id: &str, type_id: &str) -> bool {
    let rest = id.strip_prefix(type_id);
    rest.is_some_and(|rest| rest.chars().all(|c| c.is_ascii_digit() || c == '_'))
}

/// Sets the properties that the processor has too and that take the value, those that bring others with them first.
pub(super) fn take_over(network: &mut Network, id: &str, order: &[String], values: &Properties) {
    for property in order {
        if let Some(value) = values.get(property) {
            // What the processor does not have or take keeps its default.
            let _ = network.set_property(id, property, value.clone());
        }
    }
}

/// Connects a loose end with the port of this name, or else with the first one that takes it. Whether there was one.
pub(super) fn plug(network: &mut Network, id: &str, end: &End, preferred: &str) -> bool {
    let Some(declaration) = network.processor(id).and_then(|p| p.declaration()) else { return false };
    let ports: Vec<&str> = match end {
        End::Outport(_) => declaration.inports.iter().map(|port| port.id.as_str()).collect(),
        End::Inport(_) => declaration.outports.iter().map(|port| port.id.as_str()).collect(),
    };
    let mut candidates: Vec<String> = ports.into_iter().map(str::to_owned).collect();
    candidates.sort_by_key(|port| port != preferred);
    candidates.iter().any(|port| match end {
        End::Outport(from) => network.connect(from, (id, port.as_str())).is_ok(),
        End::Inport(to) => network.connect((id, port.as_str()), to).is_ok(),
    })
}
