//! Whether a processor can run, and if not, why: a chain down to the cause.

use std::collections::BTreeSet;

use crate::network::{Network, Processor};
use crate::property::{PropertyDecl, PropertyKind};

/// Whether a processor can run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Readiness {
    /// As far as can be told without running what feeds it.
    Ready,
    /// One text for each cause: "canvas waits for view.image; view waits for source.volume; source: no file chosen".
    NotReady(Vec<String>),
}

impl Readiness {
    /// Whether it is ready.
    pub fn is_ready(&self) -> bool {
        *self == Self::Ready
    }
}

/// Whether a processor could run: its required inports are connected, its files chosen, its type known, and the same holds for
/// everything that feeds it. What depends on data (conditions, failures) is in the report of an evaluation. An unknown
/// processor is not ready.
pub fn readiness(network: &Network, processor: &str) -> Readiness {
    if network.processor(processor).is_none() {
        return Readiness::NotReady(vec![format!("there is no processor `{processor}`")]);
    }
    let reasons =
        chain(network, processor, &|id| network.processor(id).map(|p| causes(network, p)).unwrap_or_default());
    if reasons.is_empty() { Readiness::Ready } else { Readiness::NotReady(reasons) }
}

/// Why a processor itself cannot run, whatever feeds it.
pub(crate) fn causes(network: &Network, processor: &Processor) -> Vec<String> {
    let id = processor.id();
    let Some(declaration) = processor.declaration() else {
        return vec![format!("{id}: its type `{}` is not known here", processor.type_id())];
    };
    let connected = |inport: &str| network.inputs(id).any(|connection| connection.to.item == inport);
    let open = declaration.inports.iter().filter(|port| !port.optional && !connected(&port.id));
    let mut causes: Vec<String> = open.map(|port| format!("{id}: input `{}` is not connected", port.id)).collect();
    let (decls, properties) = processor.resolve();
    let unchosen = |decl: &&PropertyDecl| {
        matches!(decl.kind, PropertyKind::File { required: true, .. }) && properties.text(&decl.id) == Ok("")
    };
    let files: Vec<&PropertyDecl> = decls.iter().filter(unchosen).collect();
    causes.extend(files.iter().map(|decl| match files.len() {
        1 => format!("{id}: no file chosen"),
        _ => format!("{id}: no file chosen for `{}`", decl.id),
    }));
    causes
}

/// The causes at a processor and at everything that feeds it, each with the way to it. A processor that feeds another in
/// several ways is followed once.
pub(crate) fn chain(network: &Network, processor: &str, causes: &dyn Fn(&str) -> Vec<String>) -> Vec<String> {
    let mut reasons = Vec::new();
    let mut seen = BTreeSet::from([processor]);
    let mut stack = vec![(processor, String::new())];
    while let Some((id, way)) = stack.pop() {
        reasons.extend(causes(id).into_iter().map(|cause| format!("{way}{cause}")));
        // The first connection is followed first, so it is pushed last.
        let inputs: Vec<_> = network.inputs(id).filter(|c| seen.insert(c.from.processor.as_str())).collect();
        stack.extend(
            inputs.into_iter().rev().map(|c| (c.from.processor.as_str(), format!("{way}{id} waits for {}; ", c.from))),
        );
    }
    reasons
}
