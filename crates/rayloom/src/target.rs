//! Which image a picture is made of, and what has to be evaluated for it.

use rayloom_network::{Address, Network, PortType, Processor, Readiness, Request, Sinks, closest, readiness};
use rayloom_processors::types::CANVAS;

use crate::failure::Failure;

/// What is to be written.
pub struct Target {
    /// The outport whose image is written.
    pub outport: Address,
    /// What to evaluate for it.
    pub request: Request,
}

impl Target {
    /// The image at `port`, or the one that the only canvas shows. `size` replaces the size of the canvas.
    ///
    /// # Errors
    /// There is no such port, it holds no image, the network has not exactly one canvas, or what feeds the image is not
    /// ready to run.
    pub fn find(network: &Network, port: Option<&Address>, size: Option<[u32; 2]>) -> Result<Self, Failure> {
        let target = match port {
            Some(port) => Self::at_port(network, port, size)?,
            None => Self::at_canvas(network, size)?,
        };
        match readiness(network, &target.outport.processor) {
            Readiness::Ready => Ok(target),
            Readiness::NotReady(reasons) => Err(Failure::new(reasons.join("\n"))),
        }
    }

    fn at_canvas(network: &Network, size: Option<[u32; 2]>) -> Result<Self, Failure> {
        let canvases: Vec<&str> = canvases(network).map(Processor::id).collect();
        let [canvas] = canvases[..] else {
            return Err(match canvases.is_empty() {
                true => Failure::new("the network has no canvas; name the image to write with --port PROCESSOR.PORT"),
                false => {
                    let ports: Vec<String> = canvases.iter().map(|id| format!("--port {id}.image")).collect();
                    Failure::new(format!("the network has several canvases; choose one with {}", ports.join(" or ")))
                }
            });
        };
        if let Readiness::NotReady(reasons) = readiness(network, canvas) {
            return Err(Failure::new(reasons.join("\n")));
        }
        Self::at_port(network, &Address::new(canvas, "image"), size)
    }

    fn at_port(network: &Network, port: &Address, size: Option<[u32; 2]>) -> Result<Self, Failure> {
        let outport = outport(network, port)?;
        let sinks = Sinks::Only(vec![port.processor.clone()]);
        let size = size.or_else(|| largest_canvas(network, &port.processor));
        Ok(Self { request: Request { sinks, watch: vec![outport.clone()], size, ..Request::default() }, outport })
    }
}

/// The outport that a user means by a port: the outport itself, or what feeds the inport.
fn outport(network: &Network, port: &Address) -> Result<Address, Failure> {
    let Some(processor) = network.processor(&port.processor) else {
        let hint = names(&port.processor, network.processors().map(Processor::id).collect());
        return Err(Failure::new(format!("--port {port}: there is no processor `{}`; {hint}", port.processor)));
    };
    let Some(declaration) = processor.declaration() else {
        let type_id = processor.type_id();
        return Err(Failure::new(format!("--port {port}: `{}` is of the unknown type `{type_id}`", processor.id())));
    };
    if let Some(found) = declaration.outport(&port.item) {
        return match found.port_type {
            PortType::Image(_) => Ok(port.clone()),
            other => Err(no_image(network, port, other)),
        };
    }
    if declaration.inport(&port.item).is_none() {
        let ports = declaration.outports.iter().map(|port| port.id.as_str());
        let ports = ports.chain(declaration.inports.iter().map(|port| port.id.as_str())).collect();
        let (id, type_id) = (processor.id(), processor.type_id());
        let hint = names(&port.item, ports);
        return Err(Failure::new(format!("--port {port}: `{id}` (a {type_id}) has no port `{}`; {hint}", port.item)));
    }
    let source = network.inputs(processor.id()).find(|connection| connection.to.item == port.item);
    match source {
        Some(connection) => outport(network, &connection.from),
        None => Err(Failure::new(format!("--port {port}: nothing is connected to this inport, so it has no image"))),
    }
}

/// The failure that a port holds something that is not an image, with ports that do.
fn no_image(network: &Network, port: &Address, found: PortType) -> Failure {
    let images: Vec<String> = network
        .processors()
        .flat_map(|processor| {
            let outports = processor.declaration().map_or(&[][..], |declaration| &declaration.outports);
            let images = outports.iter().filter(|outport| matches!(outport.port_type, PortType::Image(_)));
            images.map(|outport| format!("{}.{}", processor.id(), outport.id))
        })
        .collect();
    let hint = match images.is_empty() {
        true => "the network has no images".to_owned(),
        false => format!("images are at {}", images.join(", ")),
    };
    Failure::new(format!("--port {port}: {found} is there, and only images can be written; {hint}"))
}

fn names(wanted: &str, known: Vec<&str>) -> String {
    let near = closest(wanted, known.iter().copied());
    match (near.is_empty(), known.is_empty()) {
        (false, _) => format!("did you mean `{}`?", near.join("` or `")),
        (true, false) => format!("there are: `{}`", known.join("`, `")),
        (true, true) => "there are none".to_owned(),
    }
}

/// The size at which the network shows its pictures, unless the processor is a canvas with its own.
fn largest_canvas(network: &Network, processor: &str) -> Option<[u32; 2]> {
    let size = |canvas: &Processor| canvas.properties().array::<2>("size").ok().map(|size| size.map(|n| n as u32));
    let own = canvases(network).find(|canvas| canvas.id() == processor).and_then(size);
    own.or_else(|| canvases(network).filter_map(size).reduce(|a, b| [a[0].max(b[0]), a[1].max(b[1])]))
}

fn canvases(network: &Network) -> impl Iterator<Item = &Processor> {
    network.processors().filter(|processor| processor.type_id() == CANVAS)
}
