//! Giving a processor another id.

use rayloom_network::{EditError, Network};

use crate::visualization::follow_rename;

/// Gives a processor another id; connections, links and what visualization mode shows follow.
///
/// # Errors
/// There is no such processor, or the new id is malformed or taken.
pub fn rename(network: &mut Network, id: &str, new: &str) -> Result<(), EditError> {
    network.rename(id, new)?;
    follow_rename(network, id, new);
    Ok(())
}
