//! Whether a processor can run, and if not, why: a chain down to the cause.

use std::collections::{BTreeMap, HashSet, VecDeque};
use std::rc::Rc;

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
    match not_ready(network, &[processor]).remove(processor) {
        Some(reasons) => Readiness::NotReady(reasons),
        None => Readiness::Ready,
    }
}

/// Those of `processors`, and of what feeds them, that are not ready, with the reasons as in [`Readiness::NotReady`].
pub fn not_ready<'a>(network: &'a Network, processors: &[&'a str]) -> BTreeMap<&'a str, Vec<String>> {
    let mut needed: HashSet<&str> = HashSet::new();
    let mut stack = processors.to_vec();
    while let Some(id) = stack.pop() {
        if needed.insert(id) {
            stack.extend(network.inputs(id).map(|connection| connection.from.processor.as_str()));
        }
    }
    let order = network.order().into_iter().filter(|id| needed.contains(id));
    chains(network, order, &|id| network.processor(id).map(|p| causes(network, p)).unwrap_or_default())
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

/// How many causes are listed for one processor; the others are listed for those that feed it.
const MOST_CAUSES: usize = 20;
/// How many steps of a long way to a cause are written out at either end of it.
const STEPS: usize = 3;

/// A cause, and the way to it from a processor that waits.
#[derive(Clone)]
struct Chain {
    cause: Rc<str>,
    /// The first steps, the nearest last, and then the steps at the cause, the nearest to it first.
    begin: VecDeque<String>,
    end: Vec<String>,
    /// Steps between the two.
    between: usize,
}

impl Chain {
    fn after(&self, step: &str) -> Self {
        let mut chain = self.clone();
        if chain.begin.len() + chain.between == 0 && chain.end.len() < STEPS {
            chain.end.push(step.to_owned());
            return chain;
        }
        chain.begin.push_back(step.to_owned());
        if chain.begin.len() > STEPS {
            chain.begin.pop_front();
            chain.between += 1;
        }
        chain
    }

    fn text(&self) -> String {
        let mut parts: Vec<String> = self.begin.iter().rev().cloned().collect();
        if self.between > 0 {
            parts.push(format!("... ({} further processors wait)", self.between));
        }
        parts.extend(self.end.iter().rev().cloned());
        parts.push(self.cause.to_string());
        parts.join("; ")
    }
}

/// For every processor of `order`, in which each comes after those that feed it: the causes at it and at everything that feeds
/// it, each once and with the way to it. Processors without any are left out.
pub(crate) fn chains<'a>(
    network: &'a Network,
    order: impl IntoIterator<Item = &'a str>,
    causes: &dyn Fn(&str) -> Vec<String>,
) -> BTreeMap<&'a str, Vec<String>> {
    let mut found: BTreeMap<&str, Vec<Chain>> = BTreeMap::new();
    for id in order {
        let own = causes(id).into_iter().map(|cause| Chain {
            cause: cause.into(),
            begin: VecDeque::new(),
            end: Vec::new(),
            between: 0,
        });
        let mut chains: Vec<Chain> = own.collect();
        for connection in network.inputs(id) {
            let step = format!("{id} waits for {}", connection.from);
            for chain in found.get(connection.from.processor.as_str()).into_iter().flatten() {
                let known = chains.iter().any(|other| Rc::ptr_eq(&other.cause, &chain.cause));
                if !known && chains.len() < MOST_CAUSES {
                    chains.push(chain.after(&step));
                }
            }
        }
        if !chains.is_empty() {
            found.insert(id, chains);
        }
    }
    found.into_iter().map(|(id, chains)| (id, chains.iter().map(Chain::text).collect())).collect()
}
