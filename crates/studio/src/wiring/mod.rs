//! Edits of a network that take several steps of the model: what the node canvas offers as one.

mod add;
mod connect;
mod copy;
mod link;
mod remove;
mod rename;

pub use add::{add, add_connected, fits_into, insert, replace};
pub use connect::{End, connect, feeds, fitting, re_plug, verdict};
pub use copy::{copy, duplicate, paste};
pub use link::followers;
pub use remove::{remove, remove_and_reconnect};
pub use rename::rename;

#[cfg(test)]
mod tests;
