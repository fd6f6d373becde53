//! What the user does on the canvas, and doing it to the document.

use std::collections::BTreeSet;

use egui::Pos2;
use rayloom_network::{Address, Connection, EditError, Network, Refusal, Value};
use rayloom_processors::types::VOLUME_SOURCE;

use super::NetworkPanel;
use super::drag::Drag;
use super::frames::{self, FrameEdit};
use super::menus::LooseLink;
use super::socket::Socket;
use crate::pane::Pane;
use crate::session::{Session, Severity};
use crate::wiring::{self, End};

/// What the user does on the canvas.
#[derive(Clone, Debug)]
pub enum Action {
    /// Selects processors, and nothing else.
    Select(BTreeSet<String>),
    /// Adds a wire to the selection, or takes it out.
    SelectWire(Connection, bool),
    /// Takes hold of a socket.
    Hold(Socket),
    /// Connects; the wire held before, if any, goes away.
    Connect(Connection, Option<Connection>),
    /// Removes one wire.
    Cut(Connection),
    /// Keeps what is on an outport in sight.
    Pin(Address),
    /// Does something to a frame.
    Frame(FrameEdit),
    /// Adds a frame around the selection, or at a point, or in the middle of what is visible.
    AddFrame(Option<Pos2>),
    /// Shows or hides the map.
    Map,
    /// Lets a property (the second) follow another.
    Link(Address, Address),
    /// Offers the properties of a processor that may follow a property.
    OfferLinks(LooseLink),
    /// Adds a processor of a type, its middle at a point.
    Add(String, Pos2),
    /// Adds a processor for the loose end of a wire: type, port, loose end.
    AddConnected(String, String, End, Pos2),
    /// Adds a processor within a wire.
    Insert(String, Connection, Pos2),
    /// Adds a source for a volume file.
    AddFile(String, Pos2),
    /// Puts a processor of another type in a processor's place.
    Replace(String, String),
    /// Removes what is selected; and lets what fed it feed what it fed.
    Delete {
        /// Whether to reconnect.
        reconnect: bool,
    },
    /// Adds copies of what is selected.
    Duplicate,
    /// Copies what is selected into the clipboard.
    Copy,
    /// Adds the processors of a text.
    Paste(String, Pos2),
    /// Selects everything.
    SelectAll,
    /// Shows everything.
    Fit,
    /// Lays the network out anew.
    Arrange,
    /// Opens the palette.
    Palette,
    /// Tells the user why something is refused.
    Refuse(String),
}

/// From the middle of a typical node to its corner.
const CORNER: [f64; 2] = [-75.0, -30.0];

/// How far apart two nodes at the same place are moved.
const APART: f64 = 30.0;

impl NetworkPanel {
    /// Does what the user did.
    pub fn apply(&mut self, action: Action, context: &egui::Context, session: &mut Session) {
        match action {
            Action::Select(ids) => {
                session.selection = ids;
                self.wires.clear();
            }
            Action::SelectWire(wire, true) => drop(self.wires.insert(wire)),
            Action::SelectWire(wire, false) => drop(self.wires.remove(&wire)),
            Action::SelectAll => {
                session.selection = session.network().processors().map(|p| p.id().to_owned()).collect()
            }
            Action::Hold(socket) => self.drag = Some(Drag::start(session.network(), socket)),
            Action::Connect(wire, held) => connect(session, &wire, held.as_ref()),
            Action::Cut(wire) => cut(session, &wire),
            Action::Pin(outport) => session.to_open.push(Pane::Inspector(outport)),
            Action::Frame(edit) => frames::apply(edit, &mut self.frame, &self.geometry, session),
            Action::AddFrame(at) => {
                let at = at.unwrap_or_else(|| self.geometry.center());
                let area = frames::around(session, &self.geometry, at);
                frames::apply(FrameEdit::Add(area), &mut self.frame, &self.geometry, session);
            }
            Action::Map => self.shows_map = !self.shows_map,
            Action::Link(leader, follower) => {
                session.edit(&format!("link {follower} and {leader}"), |network| network.link(&leader, &follower));
            }
            Action::OfferLinks(menu) => self.loose_link = Some(menu),
            Action::Delete { reconnect } => self.delete(session, reconnect),
            Action::Copy => copy(context, session),
            Action::Fit => self.fit = true,
            Action::Arrange => self.arrange(context, session),
            Action::Palette => session.wants_palette = true,
            Action::Refuse(reason) => session.tell(Severity::Error, reason),
            adding => add(session, adding),
        }
    }

    fn delete(&mut self, session: &mut Session, reconnect: bool) {
        let (ids, wires) = (std::mem::take(&mut session.selection), std::mem::take(&mut self.wires));
        if ids.is_empty() && wires.is_empty() {
            return;
        }
        session.edit("delete", |network| match reconnect {
            true => wiring::remove_and_reconnect(network, &ids),
            false => wiring::remove(network, &ids, &wires),
        });
    }
}

/// The actions that add processors; these are selected then.
fn add(session: &mut Session, action: Action) {
    let at = |point: Pos2| [f64::from(point.x) + CORNER[0], f64::from(point.y) + CORNER[1]];
    let one = |id: String| BTreeSet::from([id]);
    match action {
        Action::Add(type_id, point) => select_new(session, &format!("add {type_id}"), |network| {
            let place = free_place(network, at(point));
            wiring::add(network, &type_id, place).map(one)
        }),
        Action::AddConnected(type_id, port, end, point) => {
            select_new(session, &format!("add {type_id}"), |network| {
                // Beside the end of the wire, not over it.
                let [x, y] = at(point);
                let place = [if matches!(end, End::Outport(_)) { x - CORNER[0] } else { x + CORNER[0] }, y];
                wiring::add_connected(network, &type_id, place, &port, &end).map(one)
            });
        }
        Action::Insert(type_id, wire, point) => select_new(session, &format!("insert {type_id}"), |network| {
            wiring::insert(network, &type_id, at(point), &wire).map(one)
        }),
        Action::AddFile(file, point) => select_new(session, "add a volume", |network| -> Result<_, EditError> {
            let place = free_place(network, at(point));
            let id = wiring::add(network, VOLUME_SOURCE, place)?;
            network.set_property(&id, "file", Value::Text(file))?;
            Ok(one(id))
        }),
        Action::Replace(id, type_id) => {
            select_new(session, &format!("replace {id}"), |network| wiring::replace(network, &id, &type_id).map(one));
        }
        Action::Duplicate if !session.selection.is_empty() => {
            let ids = session.selection.clone();
            select_new(session, "duplicate", |network| wiring::duplicate(network, &ids));
        }
        Action::Paste(text, point) => {
            let place = [f64::from(point.x), f64::from(point.y)];
            select_new(session, "paste", |network| wiring::paste(network, &text, place));
        }
        _ => {}
    }
}

/// Edits, and selects what was added.
fn select_new<E: std::fmt::Display>(
    session: &mut Session,
    label: &str,
    change: impl FnOnce(&mut Network) -> Result<BTreeSet<String>, E>,
) {
    let mut new = BTreeSet::new();
    let links = session.network().links().len();
    if session.edit(label, |network| change(network).map(|ids| new = ids)) {
        session.first_look.wait_for(new.iter().cloned());
        session.selection = new;
        let linked = session.network().links().iter().skip(links);
        let notes: Vec<String> = linked
            .map(|link| format!("{} follows {}; links are cut in the menu of its name", link.b, link.a))
            .collect();
        notes.into_iter().for_each(|note| session.tell(Severity::Note, note));
    }
}

/// A place near the wanted one where no node begins.
fn free_place(network: &Network, mut at: [f64; 2]) -> [f64; 2] {
    let taken = |at: [f64; 2]| {
        network.processors().any(|p| p.position().iter().zip(at).all(|(x, y)| (x - y).abs() < 0.5 * APART))
    };
    while taken(at) {
        at = at.map(|x| x + APART);
    }
    at.map(f64::round)
}

fn connect(session: &mut Session, wire: &Connection, held: Option<&Connection>) {
    session.edit(&format!("connect {wire}"), |network| -> Result<(), Refusal> {
        match held {
            Some(old) => wiring::re_plug(network, old, wire),
            None => wiring::connect(network, wire),
        }
    });
}

fn cut(session: &mut Session, wire: &Connection) {
    session.edit(&format!("cut {wire}"), |network| -> Result<(), Refusal> {
        network.disconnect(&wire.from, &wire.to);
        Ok(())
    });
}

fn copy(context: &egui::Context, session: &mut Session) {
    if !session.selection.is_empty() {
        context.copy_text(wiring::copy(session.network(), &session.selection));
    }
}

/// The data that a socket shows: that of the outport behind it. Where several wires end, each has a socket that shows it.
pub fn shown_at(network: &Network, socket: &Socket) -> Option<Address> {
    match (&socket.wire, &socket.end) {
        (Some(wire), _) => Some(wire.from.clone()),
        (None, End::Outport(address)) => Some(address.clone()),
        (None, End::Inport(address)) => {
            let mut wires = network.inputs(&address.processor).filter(|wire| wire.to == *address);
            let first = wires.next()?;
            wires.next().is_none().then(|| first.from.clone())
        }
    }
}
