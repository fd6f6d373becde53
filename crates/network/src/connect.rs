//! Whether a connection fits, and connecting.

use std::collections::{BTreeMap, VecDeque};

use thiserror::Error;

use crate::names::{Address, hint};
use crate::network::{Connection, Network, Processor};
use crate::port::{InportDecl, OutportDecl, PortType};

/// Why a connection is refused.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum Refusal {
    /// An end is at no processor.
    #[error("there is no processor `{id}`.{hint}")]
    UnknownProcessor {
        /// The id.
        id: String,
        /// The closest names, a sentence.
        hint: String,
    },
    /// An end is at a placeholder, whose ports are not known.
    #[error(
        "`{id}` is of the unknown type `{type_id}`, so its ports are not known; only connections from the file are kept."
    )]
    Placeholder {
        /// The processor.
        id: String,
        /// Its type.
        type_id: String,
    },
    /// There is no such outport.
    #[error("`{}` (a {type_id}) has no outport `{}`.{hint}", address.processor, address.item)]
    NoOutport {
        /// What was asked for.
        address: Address,
        /// Type of the processor.
        type_id: String,
        /// The closest names, a sentence.
        hint: String,
    },
    /// There is no such inport.
    #[error("`{}` (a {type_id}) has no inport `{}`.{hint}", address.processor, address.item)]
    NoInport {
        /// What was asked for.
        address: Address,
        /// Type of the processor.
        type_id: String,
        /// The closest names, a sentence.
        hint: String,
    },
    /// Both ends are at the same processor.
    #[error("`{0}` cannot feed itself; connect two different processors.")]
    Itself(String),
    /// The inport does not accept what comes out.
    #[error("{} gives {found}, but {} takes {expected}.", connection.from, connection.to)]
    Type {
        /// The connection.
        connection: Box<Connection>,
        /// What comes out.
        found: PortType,
        /// What is accepted.
        expected: String,
    },
    /// The connection exists.
    #[error("{0} and {1} are already connected.")]
    Already(Address, Address),
    /// The inport takes one connection and has one.
    #[error("{to} is already fed by {by} and takes one connection; disconnect that first.")]
    Occupied {
        /// The inport.
        to: Address,
        /// What feeds it.
        by: Address,
    },
    /// The connection would close a cycle.
    #[error("the connection would close a cycle: {}.", path.join(" -> "))]
    Cycle {
        /// The processors along the cycle, the first repeated at the end.
        path: Vec<String>,
    },
}

/// Whether an outport may be connected to an inport. Conditions on the data itself do not matter here: they make a processor
/// not ready.
///
/// # Errors
/// The reason, as a sentence.
pub fn can_connect(network: &Network, from: &Address, to: &Address) -> Result<(), Refusal> {
    check_ends(network, from, to)?;
    check_cycle(network, from, to)
}

/// Everything but cycles, which take a look at the whole network.
fn check_ends(network: &Network, from: &Address, to: &Address) -> Result<(), Refusal> {
    let source = find(network, &from.processor)?;
    let target = find(network, &to.processor)?;
    let outport = outport(source, from)?;
    let inport = inport(target, to)?;
    if from.processor == to.processor {
        return Err(Refusal::Itself(from.processor.clone()));
    }
    if !inport.accepts.contains(&outport.port_type) {
        let expected = inport.accepts.iter().map(PortType::to_string).collect::<Vec<_>>().join(" or ");
        let connection = Box::new(Connection { from: from.clone(), to: to.clone() });
        return Err(Refusal::Type { connection, found: outport.port_type, expected });
    }
    check_place(network, from, to, inport.several)
}

/// As [`can_connect`], but for a connection from a file, which may end at placeholders. Cycles are looked for once all
/// connections are there, with [`first_in_cycle`].
pub(crate) fn can_keep(network: &Network, from: &Address, to: &Address) -> Result<(), Refusal> {
    let (source, target) = (find(network, &from.processor)?, find(network, &to.processor)?);
    if !source.is_placeholder() && !target.is_placeholder() {
        return check_ends(network, from, to);
    }
    if !source.is_placeholder() {
        outport(source, from)?;
    }
    let several = target.is_placeholder() || inport(target, to)?.several;
    if from.processor == to.processor {
        return Err(Refusal::Itself(from.processor.clone()));
    }
    check_place(network, from, to, several)
}

/// The position of the first connection that closes a cycle with those before it, and the refusal.
pub(crate) fn first_in_cycle(network: &Network) -> Option<(usize, Refusal)> {
    let count = network.processors().count();
    if network.order().len() == count {
        return None;
    }
    let connections = network.connections();
    let with_first = |number: usize| {
        let connections = connections[..number].iter().cloned().collect();
        Network { connections, ..network.clone() }
    };
    // The more connections, the more cycles: the first number of them that is too many is found by halving.
    let (mut fine, mut too_many) = (0, connections.len());
    while too_many - fine > 1 {
        let number = fine.midpoint(too_many);
        let without_cycle = with_first(number).order().len() == count;
        *(if without_cycle { &mut fine } else { &mut too_many }) = number;
    }
    let Connection { from, to } = &connections[fine];
    check_cycle(&with_first(fine), from, to).err().map(|refusal| (fine, refusal))
}

fn find<'a>(network: &'a Network, id: &str) -> Result<&'a Processor, Refusal> {
    let unknown = || Refusal::UnknownProcessor { id: id.to_owned(), hint: hint(id, network.ids()) };
    network.processor(id).ok_or_else(unknown)
}

fn outport<'a>(processor: &'a Processor, address: &Address) -> Result<&'a OutportDecl, Refusal> {
    let declaration = processor.declaration().ok_or_else(|| placeholder(processor))?;
    declaration.outport(&address.item).ok_or_else(|| Refusal::NoOutport {
        address: address.clone(),
        type_id: processor.type_id.clone(),
        hint: hint(&address.item, declaration.outports.iter().map(|port| port.id.as_str())),
    })
}

fn inport<'a>(processor: &'a Processor, address: &Address) -> Result<&'a InportDecl, Refusal> {
    let declaration = processor.declaration().ok_or_else(|| placeholder(processor))?;
    declaration.inport(&address.item).ok_or_else(|| Refusal::NoInport {
        address: address.clone(),
        type_id: processor.type_id.clone(),
        hint: hint(&address.item, declaration.inports.iter().map(|port| port.id.as_str())),
    })
}

fn placeholder(processor: &Processor) -> Refusal {
    Refusal::Placeholder { id: processor.id.clone(), type_id: processor.type_id.clone() }
}

/// Refuses a second identical connection, and a second one into an inport for one.
fn check_place(network: &Network, from: &Address, to: &Address, several: bool) -> Result<(), Refusal> {
    let mut into = network.inputs(&to.processor).filter(|connection| connection.to == *to);
    if into.clone().any(|connection| connection.from == *from) {
        return Err(Refusal::Already(from.clone(), to.clone()));
    }
    match into.next() {
        Some(other) if !several => Err(Refusal::Occupied { to: to.clone(), by: other.from.clone() }),
        _ => Ok(()),
    }
}

/// Refuses a connection whose source is fed by its target; the message shows the shortest way.
fn check_cycle(network: &Network, from: &Address, to: &Address) -> Result<(), Refusal> {
    let (start, goal) = (to.processor.as_str(), from.processor.as_str());
    let mut reached_from: BTreeMap<&str, &str> = BTreeMap::new();
    let mut queue = VecDeque::from([start]);
    while let Some(processor) = queue.pop_front() {
        if processor == goal {
            return Err(Refusal::Cycle { path: cycle(&reached_from, start, goal) });
        }
        for connection in network.outputs(processor) {
            let next = connection.to.processor.as_str();
            if next != start && !reached_from.contains_key(next) {
                reached_from.insert(next, processor);
                queue.push_back(next);
            }
        }
    }
    Ok(())
}

/// The way from `start` to `goal` by the steps of a search, closed by the new connection back to `start`.
fn cycle(reached_from: &BTreeMap<&str, &str>, start: &str, goal: &str) -> Vec<String> {
    let mut path = vec![start.to_owned(), goal.to_owned()];
    let mut at = goal;
    while at != start {
        let Some(&previous) = reached_from.get(at) else {
            break;
        };
        path.push(previous.to_owned());
        at = previous;
    }
    path.reverse();
    path
}

impl Network {
    /// Connects an outport to an inport; an inport for several keeps those that it has.
    ///
    /// # Errors
    /// As [`can_connect`].
    pub fn connect(&mut self, from: impl Into<Address>, to: impl Into<Address>) -> Result<(), Refusal> {
        let (from, to) = (from.into(), to.into());
        can_connect(self, &from, &to)?;
        self.connections.push(Connection { from, to });
        Ok(())
    }

    /// Removes a connection; `false` if there was none.
    pub fn disconnect(&mut self, from: impl Into<Address>, to: impl Into<Address>) -> bool {
        let gone = Connection { from: from.into(), to: to.into() };
        self.connections.retain(|connection| *connection != gone)
    }
}
