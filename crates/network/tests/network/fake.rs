//! Processor types without an implementation, and a backend that counts runs and passes on texts.

use std::collections::BTreeMap;
use std::sync::Arc;

use rayloom_network::*;
use rayloom_volume::VolumeRole;

struct Type(Declaration);

impl ProcessorType for Type {
    fn declaration(&self) -> &Declaration {
        &self.0
    }

    /// The snippet `phong` brings two parameters, `flat` none.
    fn snippet_properties(&self, current: &Properties) -> Vec<PropertyDecl> {
        match current.text("shading") {
            Ok("phong") => vec![
                PropertyDecl::float("shading.ambient", "Ambient", 0.2).range(0.0, 1.0),
                PropertyDecl::float("shading.shininess", "Shininess", 20.0).range(1.0, 200.0),
            ],
            _ => Vec::new(),
        }
    }
}

const COLOR: PortType = PortType::Image(ImageKind::Color);

fn one_channel(facts: &Facts) -> bool {
    matches!(facts, Facts::Volume { channels: 1, .. })
}

fn declarations() -> Vec<Declaration> {
    let precision = vec![Choice::new("auto", "Automatic", ""), Choice::new("8-bit", "8 bit", "")];
    let volume = || OutportDecl::new("volume", "Volume", PortType::Volume);
    let volume_in = || InportDecl::new("volume", "Volume", &[PortType::Volume]);
    vec![
        Declaration::new("source", "Volume source", "Data")
            .output(volume())
            .property(PropertyDecl::file("file", "File", &["nrrd"]))
            .property(PropertyDecl::choice("precision", "Precision", "auto", precision)),
        Declaration::new("generator", "Generator", "Data")
            .output(volume())
            .property(PropertyDecl::int("channels", "Channels", 1).int_range(1, 4))
            .property(PropertyDecl::vector("extent", "Extent", &[1.0; 3]).range(0.0, 1e6).unit("mm")),
        Declaration::new("proxy", "Proxy", "Geometry").input(volume_in()).output(OutportDecl::new(
            "geometry",
            "Geometry",
            PortType::Geometry,
        )),
        Declaration::new("traversal", "Ray traversal", "Rendering")
            .input(volume_in().condition("a volume with one channel", one_channel))
            .input(InportDecl::new("geometry", "Geometry", &[PortType::Geometry]).optional())
            .output(OutportDecl::new("image", "Image", COLOR))
            .output(OutportDecl::new("depth", "Depth", PortType::Image(ImageKind::Depth)))
            .property(PropertyDecl::camera("camera", "Camera", Camera::default()))
            .property(PropertyDecl::light("light", "Light", Light::default()))
            .property(PropertyDecl::float("rate", "Rate", 1.0).range(0.1, 16.0).unit("samples per voxel"))
            .property(
                PropertyDecl::transfer_function("transfer", "Transfer function", Default::default())
                    .level(Level::Parameters),
            )
            .property(PropertyDecl::color("tint", "Tint", [1.0; 4]))
            .property(PropertyDecl::bool("early", "Early termination", true).level(Level::Shader))
            .property(PropertyDecl::snippet("shading", "Shading", "shading", "flat"))
            .uses_render_size(),
        Declaration::new("preview", "Preview", "Rendering")
            .input(volume_in())
            .output(OutportDecl::new("image", "Image", COLOR))
            .property(PropertyDecl::camera("camera", "Camera", Camera::default()))
            .property(PropertyDecl::float("rate", "Rate", 1.0).range(0.1, 4.0).unit("samples per voxel"))
            .uses_render_size(),
        Declaration::new("filter", "Filter", "Image")
            .input(InportDecl::new("image", "Image", &[COLOR]))
            .output(OutportDecl::new("image_out", "Image", COLOR))
            .property(PropertyDecl::text("fail", "Fail with", "")),
        Declaration::new("compositor", "Compositor", "Image")
            .input(InportDecl::new("layers", "Layers", &[COLOR]).several())
            .output(OutportDecl::new("image", "Image", COLOR)),
        Declaration::new("mixture", "Mixture", "Rendering")
            .input(
                InportDecl::new("volumes", "Volumes", &[PortType::Volume])
                    .several()
                    .condition("a volume with one channel", one_channel),
            )
            .output(OutportDecl::new("image", "Image", COLOR))
            .uses_render_size(),
        Declaration::new("canvas", "Canvas", "Output")
            .input(InportDecl::new("image", "Image", &[COLOR, PortType::Image(ImageKind::Depth)]))
            .property(PropertyDecl::size("size", "Size", [640, 480]))
            .sink(),
    ]
}

/// All fake types.
pub fn registry() -> Arc<Registry> {
    registry_without("")
}

/// All fake types but one.
pub fn registry_without(id: &str) -> Arc<Registry> {
    let mut registry = Registry::new();
    for declaration in declarations().into_iter().filter(|declaration| declaration.id != id) {
        registry.add(Arc::new(Type(declaration))).expect("fake types are declared well");
    }
    Arc::new(registry)
}

/// generator -> proxy -> traversal -> filter -> canvas, the generator feeding the traversal too.
pub fn pipeline() -> Network {
    let mut network = Network::new(registry());
    for (type_id, id) in
        [("generator", "data"), ("proxy", "proxy"), ("traversal", "view"), ("filter", "filter"), ("canvas", "canvas")]
    {
        network.add(type_id, id).unwrap();
    }
    for (from, to) in [
        (("data", "volume"), ("proxy", "volume")),
        (("data", "volume"), ("view", "volume")),
        (("proxy", "geometry"), ("view", "geometry")),
        (("view", "image"), ("filter", "image")),
        (("filter", "image_out"), ("canvas", "image")),
    ] {
        network.connect(from, to).unwrap();
    }
    network
}

/// Fake data: facts, and how it came about.
#[derive(Clone, Debug, PartialEq)]
pub struct Made {
    pub facts: Facts,
    pub how: String,
}

/// Counts runs; fails where the property `fail` says so.
#[derive(Default)]
pub struct Counter {
    pub runs: BTreeMap<String, usize>,
    pub sizes: BTreeMap<String, [u32; 2]>,
    /// What fed each processor in its last run, as connections.
    pub fed: BTreeMap<String, Vec<String>>,
    pub silent: bool,
    /// Processors that come to their result in so many runs.
    pub steps: BTreeMap<String, usize>,
    done: BTreeMap<String, usize>,
    /// Whether those never get further than their first step.
    pub stuck: bool,
    /// The processor during whose run the evaluation is interrupted.
    pub interrupt: Option<String>,
    pub interrupted: bool,
}

impl Backend for Counter {
    type Data = Made;

    fn facts(&self, data: &Made) -> Facts {
        data.facts.clone()
    }

    fn interrupted(&self) -> bool {
        self.interrupted
    }

    fn process(&mut self, job: &Job<'_, Made>) -> Result<Outputs<Made>, ProcessError> {
        if self.interrupt.as_deref() == Some(job.id) {
            self.interrupted = true;
            return Err(ProcessError::new("interrupted"));
        }
        *self.runs.entry(job.id.to_owned()).or_default() += 1;
        self.sizes.insert(job.id.to_owned(), job.size);
        self.fed.insert(job.id.to_owned(), fed(job));
        if let Ok(message) = job.properties.text("fail")
            && !message.is_empty()
        {
            return Err(ProcessError::new(message));
        }
        let mut outputs = Outputs::new();
        outputs.unfinished = self.unfinished(job);
        for outport in job.wanted.iter().filter(|_| !self.silent) {
            let declaration = job.processor_type.declaration();
            let port_type = declaration.outport(outport).expect("only declared outports are wanted").port_type;
            let facts = facts(port_type, job);
            let fed = job.inputs.values().flatten().map(|input| input.data.how.as_str()).collect::<Vec<_>>();
            let how = format!("{}({})", job.id, fed.join(", "));
            outputs = outputs.with(outport, Made { facts, how });
        }
        Ok(outputs)
    }
}

impl Counter {
    /// How far a processor of several steps is after this run: the first unless it goes on.
    fn unfinished(&mut self, job: &Job<'_, Made>) -> Option<Unfinished> {
        let steps = *self.steps.get(job.id)?;
        let done = self.done.entry(job.id.to_owned()).or_default();
        *done = if job.refines() && !self.stuck { *done + 1 } else { 1 };
        let share = *done as f64 / steps as f64;
        (*done < steps).then(|| Unfinished { share, message: format!("step {done} of {steps}") })
    }
}

fn fed(job: &Job<'_, Made>) -> Vec<String> {
    let inports = job.processor_type.declaration().inports.iter();
    let into = inports.flat_map(|port| job.inputs(&port.id).iter().map(move |input| (&input.from, port)));
    into.map(|(from, port)| format!("{from} -> {}", port.id)).collect()
}

fn facts(port_type: PortType, job: &Job<'_, Made>) -> Facts {
    match port_type {
        PortType::Volume => {
            let channels = job.properties.int("channels").unwrap_or(1) as u32;
            Facts::Volume { dims: [2; 3], channels, role: VolumeRole::Values }
        }
        PortType::Image(kind) => Facts::Image { kind, size: job.size, has_depth: false },
        PortType::Geometry => Facts::Geometry { triangles: 12 },
    }
}
