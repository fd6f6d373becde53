//! What an evaluation needs: which processors, which of their outports, at which render size, in which order.

use std::collections::{BTreeMap, BTreeSet};

use crate::names::Address;
use crate::network::{Network, Processor};
use crate::report::{Request, Sinks};

/// Render size where neither a sink nor the request gives one.
const FALLBACK_SIZE: [u32; 2] = [512, 512];

/// The processors that are needed, each with what is needed of it.
pub(crate) struct Plan {
    /// Ids, each after those that feed it.
    pub order: Vec<String>,
    /// Outports that a needed processor or a watcher consumes.
    pub wanted: BTreeMap<String, BTreeSet<String>>,
    /// Render size: the largest width and the largest height that any consumer needs.
    pub size: BTreeMap<String, [u32; 2]>,
}

impl Plan {
    pub fn new(network: &Network, request: &Request) -> Self {
        let sinks: Vec<&Processor> = network.processors().filter(|p| is_selected(p, &request.sinks)).collect();
        let watch: Vec<&Address> = request.watch.iter().filter(|address| is_outport(network, address)).collect();
        let mut plan = Self { order: Vec::new(), wanted: BTreeMap::new(), size: BTreeMap::new() };
        plan.collect(network, &sinks, &watch);
        plan.order =
            network.order().into_iter().filter(|id| plan.wanted.contains_key(*id)).map(str::to_owned).collect();
        plan.spread_sizes(network, &sinks, &watch, request.size);
        plan
    }

    /// Walks upstream from the sinks and the watched outports.
    fn collect(&mut self, network: &Network, sinks: &[&Processor], watch: &[&Address]) {
        for address in watch {
            self.wanted.entry(address.processor.clone()).or_default().insert(address.item.clone());
        }
        let ends = sinks.iter().map(|sink| sink.id()).chain(watch.iter().map(|address| address.processor.as_str()));
        let mut stack: Vec<&str> = ends.collect();
        let mut seen: BTreeSet<&str> = BTreeSet::new();
        while let Some(id) = stack.pop() {
            if !seen.insert(id) {
                continue;
            }
            self.wanted.entry(id.to_owned()).or_default();
            for connection in network.inputs(id) {
                let from = &connection.from;
                self.wanted.entry(from.processor.clone()).or_default().insert(from.item.clone());
                stack.push(&from.processor);
            }
        }
    }

    /// Sizes start at the sinks and travel upstream, against the order.
    fn spread_sizes(&mut self, network: &Network, sinks: &[&Processor], watch: &[&Address], fixed: Option<[u32; 2]>) {
        for sink in sinks {
            if let Some(size) = fixed.or_else(|| own_size(sink)) {
                self.enlarge(sink.id(), size);
            }
        }
        let largest = self.size.values().copied().reduce(max);
        let default = fixed.or(largest).unwrap_or(FALLBACK_SIZE);
        for id in self.order.iter().rev() {
            let consumers = network.outputs(id).filter_map(|connection| self.size.get(&connection.to.processor));
            let watched = watch.iter().any(|address| address.processor == *id).then_some(&default);
            let asked = consumers.chain(watched).chain(self.size.get(id)).copied().reduce(max);
            self.size.insert(id.clone(), asked.unwrap_or(default));
        }
    }

    fn enlarge(&mut self, id: &str, size: [u32; 2]) {
        let at = self.size.entry(id.to_owned()).or_insert(size);
        *at = max(*at, size);
    }
}

fn max(a: [u32; 2], b: [u32; 2]) -> [u32; 2] {
    [a[0].max(b[0]), a[1].max(b[1])]
}

fn is_selected(processor: &Processor, sinks: &Sinks) -> bool {
    processor.declaration().is_some_and(|declaration| declaration.sink)
        && match sinks {
            Sinks::All => true,
            Sinks::Only(ids) => ids.iter().any(|id| id == processor.id()),
        }
}

fn is_outport(network: &Network, address: &Address) -> bool {
    let declaration = network.processor(&address.processor).and_then(Processor::declaration);
    declaration.is_some_and(|declaration| declaration.outport(&address.item).is_some())
}

/// The property `size` of a sink. Float-to-int casts saturate, and the property's range keeps it sensible.
fn own_size(sink: &Processor) -> Option<[u32; 2]> {
    let [width, height] = sink.properties().array::<2>("size").ok()?;
    Some([(width as u32).max(1), (height as u32).max(1)])
}
