//! Copying processors, by the text of a network file: it can be pasted into another window, or into an editor.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use rayloom_network::{Address, Connection, EditError, LoadError, Network};
use thiserror::Error;

use super::add::take_over;

/// Why a text cannot be pasted.
#[derive(Debug, Error)]
pub enum PasteError {
    /// It is not a network.
    #[error("the clipboard holds no processors: {0}")]
    Load(#[from] LoadError),
    /// It is a network without processors.
    #[error("the clipboard holds a network without processors.")]
    Empty,
    /// A processor cannot be added.
    #[error(transparent)]
    Edit(#[from] EditError),
}

/// Some processors with the connections and links among them, as the text of a network file.
pub fn copy(network: &Network, ids: &BTreeSet<String>) -> String {
    part(network, ids).to_text(None)
}

/// Adds the processors of a network file's text under free ids, the first of them at a place, and the others around it as
/// they were. Returns their ids.
///
/// # Errors
/// The text is no network, holds no processors, or holds processors of unknown types.
pub fn paste(network: &mut Network, text: &str, at: [f64; 2]) -> Result<BTreeSet<String>, PasteError> {
    let pasted = Network::from_text(text, Path::new("clipboard"), network.registry())?.network;
    let corner = |axis: usize| pasted.processors().map(|p| p.position()[axis]).reduce(f64::min).unwrap_or_default();
    let shift = [at[0] - corner(0), at[1] - corner(1)];
    let ids = merge(network, &pasted, shift)?;
    if ids.is_empty() { Err(PasteError::Empty) } else { Ok(ids.into_values().collect()) }
}

/// Adds copies of some processors beside them, fed by what feeds the originals. Returns their ids.
///
/// # Errors
/// One of them is of an unknown type.
pub fn duplicate(network: &mut Network, ids: &BTreeSet<String>) -> Result<BTreeSet<String>, EditError> {
    let from_outside: Vec<Connection> = ids
        .iter()
        .flat_map(|id| network.inputs(id))
        .filter(|wire| !ids.contains(&wire.from.processor))
        .cloned()
        .collect();
    let new = merge(network, &part(network, ids), [40.0, 40.0])?;
    for wire in from_outside {
        if let Some(to) = renamed(&wire.to, &new) {
            // The original is connected in the same way, so this fits.
            let _ = network.connect(&wire.from, &to);
        }
    }
    Ok(new.into_values().collect())
}

fn part(network: &Network, ids: &BTreeSet<String>) -> Network {
    let mut part = network.clone();
    part.name.clear();
    part.description.clear();
    part.visualization = serde_json::Value::Null;
    // Frames belong to the place, not to the processors; an empty list has nothing to refuse.
    let _ = part.set_frames(Vec::new());
    let others: Vec<String> = network.processors().map(|p| p.id().to_owned()).filter(|id| !ids.contains(id)).collect();
    for id in others {
        // It was just listed, so it is there.
        let _ = part.remove(&id);
    }
    part
}

/// Adds the processors of one network to another. Returns the new id of each.
fn merge(network: &mut Network, part: &Network, shift: [f64; 2]) -> Result<BTreeMap<String, String>, EditError> {
    let mut new = BTreeMap::new();
    for processor in part.processors() {
        let id = network.free_id(stem(processor.id()));
        network.add(processor.type_id(), &id)?;
        let [x, y] = processor.position();
        network.set_position(&id, [x + shift[0], y + shift[1]])?;
        network.set_label(&id, processor.label().map(str::to_owned))?;
        let order: Vec<String> = processor.property_decls().into_iter().map(|property| property.id).collect();
        take_over(network, &id, &order, &processor.properties());
        new.insert(processor.id().to_owned(), id);
    }
    for wire in part.connections() {
        if let (Some(from), Some(to)) = (renamed(&wire.from, &new), renamed(&wire.to, &new)) {
            network.connect(from, to)?;
        }
    }
    for link in part.links() {
        if let (Some(a), Some(b)) = (renamed(&link.a, &new), renamed(&link.b, &new)) {
            network.link(a, b)?;
        }
    }
    Ok(new)
}

fn renamed(address: &Address, new: &BTreeMap<String, String>) -> Option<Address> {
    Some(Address::new(new.get(&address.processor)?.as_str(), address.item.as_str()))
}

/// An id without the number that [`Network::free_id`] added to it.
fn stem(id: &str) -> &str {
    match id.rsplit_once('_') {
        Some((stem, number)) if !stem.is_empty() && number.parse::<u64>().is_ok() => stem,
        _ => id,
    }
}
