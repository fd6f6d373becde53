//! What an evaluation needs: which processors, which of their outports, at which render size, in which order.

use std::collections::{BTreeMap, BTreeSet};

use crate::names::Address;
use crate::network::{Network, Processor};
use crate::port::PortType;
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
        plan.spread_sizes(network, &sinks, request);
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

    /// Sizes start at the sinks and travel upstream, against the order. Images that meet in a processor must be of one size,
    /// so what makes one of them larger makes all of them larger. What is only watched is as large as the largest sink.
    fn spread_sizes(&mut self, network: &Network, sinks: &[&Processor], request: &Request) {
        for sink in sinks {
            if let Some(size) = request.sizes.get(sink.id()).copied().or(request.size).or_else(|| own_size(sink)) {
                self.enlarge(sink.id(), size);
            }
        }
        let largest = self.size.values().copied().reduce(max);
        let default = request.size.or(largest).unwrap_or(FALLBACK_SIZE);
        loop {
            for id in self.order.iter().rev() {
                let consumers = network.outputs(id).filter_map(|connection| {
                    let consumer = &connection.to.processor;
                    Some(scaled(*self.size.get(consumer)?, upstream_scale(network, consumer)))
                });
                let asked = consumers.chain(self.size.get(id).copied()).reduce(max);
                self.size.insert(id.clone(), asked.unwrap_or(default));
            }
            let meeting: Vec<_> =
                self.order.iter().filter_map(|id| Some((id.clone(), self.meeting(network, id)?))).collect();
            if meeting.is_empty() {
                return;
            }
            for (id, size) in meeting {
                self.enlarge(&id, size);
            }
        }
    }

    /// The size of the largest image that meets others in a processor, if it is larger than the processor's own.
    fn meeting(&self, network: &Network, id: &str) -> Option<[u32; 2]> {
        let images: BTreeSet<&str> = network
            .inputs(id)
            .filter(|connection| matches!(port_type(network, &connection.from), Some(PortType::Image(_))))
            .map(|connection| connection.from.processor.as_str())
            .collect();
        let largest = images.iter().filter_map(|source| self.size.get(*source)).copied().reduce(max)?;
        let scale = upstream_scale(network, id);
        let asked = scaled(*self.size.get(id)?, scale);
        let own = largest.map(|side| (f64::from(side) / scale).ceil() as u32);
        (images.len() > 1 && max(asked, largest) != asked).then_some(own)
    }

    fn enlarge(&mut self, id: &str, size: [u32; 2]) {
        let at = self.size.entry(id.to_owned()).or_insert(size);
        *at = max(*at, size);
    }
}

fn max(a: [u32; 2], b: [u32; 2]) -> [u32; 2] {
    [a[0].max(b[0]), a[1].max(b[1])]
}

/// By how much a processor multiplies its render size for what feeds it.
fn upstream_scale(network: &Network, id: &str) -> f64 {
    let scale = |processor: &Processor| {
        let property = processor.declaration()?.scales_render_size.as_deref()?;
        processor.properties().f64(property).ok()
    };
    network.processor(id).and_then(scale).unwrap_or(1.0)
}

fn scaled(size: [u32; 2], scale: f64) -> [u32; 2] {
    size.map(|side| ((f64::from(side) * scale).round() as u32).max(1))
}

fn is_selected(processor: &Processor, sinks: &Sinks) -> bool {
    processor.declaration().is_some_and(|declaration| declaration.sink)
        && match sinks {
            Sinks::All => true,
            Sinks::Only(ids) => ids.iter().any(|id| id == processor.id()),
        }
}

fn is_outport(network: &Network, address: &Address) -> bool {
    port_type(network, address).is_some()
}

/// The type of an outport; `None` if there is no such.
fn port_type(network: &Network, address: &Address) -> Option<PortType> {
    let declaration = network.processor(&address.processor).and_then(Processor::declaration)?;
    declaration.outport(&address.item).map(|outport| outport.port_type)
}

/// The property `size` of a sink. Float-to-int casts saturate, and the property's range keeps it sensible.
fn own_size(sink: &Processor) -> Option<[u32; 2]> {
    let [width, height] = sink.properties().array::<2>("size").ok()?;
    Some([(width as u32).max(1), (height as u32).max(1)])
}
