//! The processors behind the picture of a ray traversal.

use rayloom_network::{Address, Network, Processor};
use rayloom_processors::types::{ENTRY_EXIT_POINTS, RAY_TRAVERSAL};

use crate::MeasureError;

/// A ray traversal with what feeds it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chain {
    /// The image that is measured: an outport of the ray traversal.
    pub image: Address,
    /// The outport that gives the volume.
    pub volume: Address,
    /// The outport that gives the labels: that of the volume where no other is connected.
    pub labels: Address,
    /// The outport that gives the entry points.
    pub entry: Address,
    /// The processor that holds the camera.
    pub view: String,
    /// The outport that gives the proxy geometry.
    pub geometry: Address,
    /// The processor on which the precision of the volume is chosen, if there is one.
    pub source: Option<String>,
}

impl Chain {
    /// The chain behind `port`, an outport of a ray traversal or an inport that one feeds; without one behind the network's
    /// only ray traversal.
    ///
    /// # Errors
    /// There is no ray traversal there, none or several in the network, or one that lacks inputs or takes its points from
    /// elsewhere than an entry/exit points processor.
    pub fn find(network: &Network, port: Option<&Address>) -> Result<Self, MeasureError> {
        let image = match port {
            Some(port) => image_at(network, port)?,
            None => only_image(network)?,
        };
        let traversal = &image.processor;
        let source = |processor: &str, inport: &str| feeding(network, processor, inport);
        let (volume, entry) = (source(traversal, "volume")?, source(traversal, "entry")?);
        let labels = source(traversal, "labels").unwrap_or_else(|_| volume.clone());
        let view = entry.processor.clone();
        if network.processor(&view).is_none_or(|processor| processor.type_id() != ENTRY_EXIT_POINTS) {
            return Err(MeasureError::Subject(format!(
                "The entry points of `{traversal}` come from {entry}, which is not of an entry/exit points processor, so there \
                 is no camera to move: feed it from one."
            )));
        }
        let geometry = source(&view, "geometry")?;
        let precise = precise_source(network, &volume.processor);
        Ok(Self { geometry, source: precise, image, volume, labels, entry, view })
    }

    /// The processor on which the storage of precomputed gradients is chosen, if the volume has any.
    pub fn gradients(&self, network: &Network) -> Option<&str> {
        network.value(&self.volume.processor, "storage").map(|_| self.volume.processor.as_str())
    }

    /// Id of the ray traversal.
    pub fn traversal(&self) -> &str {
        &self.image.processor
    }
}

fn image_at(network: &Network, port: &Address) -> Result<Address, MeasureError> {
    let processor = network.processor(&port.processor).ok_or_else(|| {
        MeasureError::Subject(format!("There is no processor `{}`: {}", port.processor, offer(network)))
    })?;
    let declaration = processor.declaration();
    let is_outport = declaration.is_some_and(|declaration| declaration.outport(&port.item).is_some());
    match is_outport {
        true if processor.type_id() == RAY_TRAVERSAL => Ok(port.clone()),
        true => Err(MeasureError::Subject(format!(
            "{port} is not an image of a ray traversal but of a {}: {}",
            processor.type_id(),
            offer(network)
        ))),
        false => image_at(network, &feeding(network, &port.processor, &port.item)?),
    }
}

fn only_image(network: &Network) -> Result<Address, MeasureError> {
    match traversals(network)[..] {
        [one] => Ok(Address::new(one, "image")),
        [] => Err(MeasureError::Subject("The network has no ray traversal, so it has no rays to measure.".into())),
        _ => Err(MeasureError::Subject(format!("The network has several ray traversals: {}", offer(network)))),
    }
}

fn traversals(network: &Network) -> Vec<&str> {
    network.processors().filter(|processor| processor.type_id() == RAY_TRAVERSAL).map(Processor::id).collect()
}

fn offer(network: &Network) -> String {
    let ports: Vec<String> = traversals(network).iter().map(|id| format!("{id}.image")).collect();
    match ports.is_empty() {
        true => "the network has no ray traversal.".into(),
        false => format!("choose one with --port {}.", ports.join(" or --port ")),
    }
}

fn feeding(network: &Network, processor: &str, inport: &str) -> Result<Address, MeasureError> {
    let connection = network.inputs(processor).find(|connection| connection.to.item == inport);
    connection.map(|connection| connection.from.clone()).ok_or_else(|| {
        MeasureError::Subject(format!("Nothing is connected to {processor}.{inport}: connect it, then measure."))
    })
}

/// The processor at or before `id` that has a `precision`.
fn precise_source(network: &Network, id: &str) -> Option<String> {
    let mut id = id.to_owned();
    loop {
        if network.value(&id, "precision").is_some() {
            return Some(id);
        }
        let before = network.inputs(&id).find(|connection| connection.to.item == "volume")?.from.processor.clone();
        id = before;
    }
}
