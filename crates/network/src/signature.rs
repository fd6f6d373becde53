//! What goes into a run, and how two such sets differ.

use std::collections::{BTreeMap, BTreeSet};

use crate::names::Address;
use crate::properties::Properties;
use crate::property::{Level, PropertyDecl};
use crate::report::Reason;

/// Everything that a processor's result depends on.
pub(crate) struct Signature {
    pub properties: Properties,
    /// By inport: where the data comes from and its revision.
    pub inputs: BTreeMap<String, Vec<(Address, u64)>>,
    pub wanted: BTreeSet<String>,
    /// Render size, if it matters.
    pub size: Option<[u32; 2]>,
}

/// Why a processor must run again although it has a result, and what each reason makes stale.
pub(crate) fn diff(id: &str, old: &Signature, new: &Signature, decls: &[PropertyDecl]) -> Vec<(Level, Reason)> {
    let mut reasons = changed_properties(id, old, new, decls);
    let inports: BTreeSet<&String> = old.inputs.keys().chain(new.inputs.keys()).collect();
    reasons.extend(inports.into_iter().filter_map(|inport| changed_input(inport, old, new)));
    // An output that nothing consumes any more does no harm; one that is new must be computed.
    let outputs = new.wanted.difference(&old.wanted);
    reasons.extend(outputs.map(|outport| (Level::Ports, Reason::Output(outport.clone()))));
    if let Some(size) = new.size.filter(|size| old.size != Some(*size)) {
        reasons.push((Level::Result, Reason::Size(size)));
    }
    reasons
}

fn changed_properties(id: &str, old: &Signature, new: &Signature, decls: &[PropertyDecl]) -> Vec<(Level, Reason)> {
    let changed = decls.iter().filter(|decl| {
        let before = old.properties.get(&decl.id);
        before.is_some() && before != new.properties.get(&decl.id)
    });
    let mut reasons: Vec<_> =
        changed.map(|decl| (decl.level, Reason::Property(Address::new(id, decl.id.clone())))).collect();
    let ids = |signature: &Signature| signature.properties.iter().map(|(id, _)| id.to_owned()).collect::<Vec<_>>();
    if ids(old) != ids(new) {
        reasons.push((Level::Shader, Reason::Parameters(id.to_owned())));
    }
    reasons
}

fn changed_input(inport: &str, old: &Signature, new: &Signature) -> Option<(Level, Reason)> {
    let at = |signature: &Signature| signature.inputs.get(inport).cloned().unwrap_or_default();
    let (before, now) = (at(old), at(new));
    // Revisions never repeat, so they tell data apart whatever the processors are called by now.
    let revisions = |sources: &[(Address, u64)]| sources.iter().map(|(_, revision)| *revision).collect::<Vec<_>>();
    if revisions(&before) == revisions(&now) {
        return None;
    }
    let addresses = |sources: &[(Address, u64)]| sources.iter().map(|(address, _)| address.clone()).collect::<Vec<_>>();
    if addresses(&before) != addresses(&now) {
        return Some((Level::Ports, Reason::Connection { inport: inport.to_owned(), sources: addresses(&now) }));
    }
    let newer = now.iter().zip(&before).find(|(now, before)| now.1 != before.1);
    let source = newer.map(|((address, _), _)| address.processor.clone()).unwrap_or_default();
    Some((Level::Result, Reason::Input { inport: inport.to_owned(), source }))
}
