//! What the user did in the panel, carried out after everything has been shown.

use rayloom_network::{Address, EditError, Network, Value};

use crate::pane::Pane;
use crate::session::{Session, Severity};
use crate::visualization::Change;
use crate::wiring;

/// Something the user did.
pub(super) enum Action {
    /// Gave a property a value.
    Set(Address, Value),
    /// Put a property back to its default.
    Reset(Address),
    /// Linked two properties; the first takes the value of the second.
    Link(Address, Address),
    /// Cut a link.
    Unlink(Address, Address),
    /// Named a processor; an empty name takes it away.
    Name(String, String),
    /// Gave a processor another id.
    Rename(String, String),
    /// Selected a processor.
    Select(String),
    /// Changed what visualization mode shows.
    Author(Change),
    /// Asked for a pane.
    Open(Pane),
    /// Something to tell.
    Tell(Severity, String),
}

/// Carries out what was done in this frame.
pub(super) fn apply(ui: &egui::Ui, session: &mut Session, actions: Vec<Action>) {
    if actions.is_empty() {
        return;
    }
    for action in actions {
        carry_out(session, action);
    }
    // What is typed is a step of its own; what is dragged becomes one when the pointer is released.
    if !ui.input(|input| input.pointer.any_down()) {
        session.document.settle();
    }
    ui.ctx().request_repaint();
}

fn carry_out(session: &mut Session, action: Action) {
    match action {
        Action::Set(address, value) => session.set(&address.processor, &address.item, value),
        Action::Reset(address) => {
            session.edit(&format!("reset {address}"), |network: &mut Network| {
                network.reset_property(&address.processor, &address.item).map(|_| ())
            });
        }
        Action::Link(follower, leader) => {
            session.edit(&format!("link {follower} and {leader}"), |network: &mut Network| {
                network.link(&leader, &follower)
            });
        }
        Action::Unlink(a, b) => {
            session.edit(&format!("cut the link of {a} and {b}"), |network: &mut Network| {
                network.unlink(&a, &b);
                Ok::<(), EditError>(())
            });
        }
        Action::Name(id, name) => {
            let label = Some(name.trim().to_owned()).filter(|name| !name.is_empty() && *name != id);
            session.edit(&format!("name {id}"), |network: &mut Network| network.set_label(&id, label));
        }
        Action::Rename(id, new) => {
            let renamed = session.edit(&format!("rename {id}"), |network| wiring::rename(network, &id, &new));
            if renamed && session.selection.remove(&id) {
                session.selection.insert(new);
            }
        }
        Action::Select(id) => session.selection = [id].into(),
        Action::Author(change) => session.author(change),
        Action::Open(pane) => session.to_open.push(pane),
        Action::Tell(severity, text) => session.tell(severity, text),
    }
}
