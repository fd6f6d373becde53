//! Helpers shared by the whole-program tests and benches.

pub mod timing;

pub mod chain;
pub mod grid;
pub mod rays;
pub mod tolerances;

pub use grid::{Grid, VolumeFile};

use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use rayloom_gpu::{Gpu, GpuOptions};
use rayloom_network::{Evaluator, Network, Registry, Report, Request};
use rayloom_processors::{Data, Image, Runner, registry};

/// Root folder of the project.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().map(Path::to_owned).unwrap_or_default()
}

/// The device, shared by the tests of one program: drivers take their time to start.
pub fn gpu() -> Gpu {
    static DEVICE: OnceLock<Gpu> = OnceLock::new();
    DEVICE.get_or_init(|| Gpu::new(&GpuOptions::default()).unwrap_or_else(|error| panic!("{error}"))).clone()
}

/// The processor types, shared.
pub fn types() -> Arc<Registry> {
    static TYPES: OnceLock<Arc<Registry>> = OnceLock::new();
    TYPES.get_or_init(|| Arc::new(registry())).clone()
}

/// A picture read back from the device: premultiplied colour and view depth, row 0 at the top.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Premultiplied red, green, blue and opacity.
    pub color: Vec<[f32; 4]>,
    /// View depth in world units; empty when there is none.
    pub depth: Vec<f32>,
}

impl Picture {
    /// Reads an image back.
    pub fn of(image: &Image, gpu: &Gpu) -> Self {
        let read = |texture| gpu.read_rgba_f32(texture).unwrap_or_else(|error| panic!("{error}"));
        let depth = image.depth.as_ref().map(|depth| read(depth).iter().map(|texel| texel[0]).collect());
        Self { size: image.size(), color: read(&image.color), depth: depth.unwrap_or_default() }
    }

    /// The pixel in column `x` and row `y`.
    pub fn at(&self, x: u32, y: u32) -> [f32; 4] {
        self.color[(y * self.size[0] + x) as usize]
    }
}

/// A network with a runner and what has been computed.
pub struct Workbench {
    /// The network; edit it between evaluations.
    pub network: Network,
    /// The backend.
    pub runner: Runner,
    /// Results.
    pub evaluator: Evaluator<Runner>,
}

impl Workbench {
    /// A workbench for a network.
    pub fn new(network: Network) -> Self {
        Self::on(network, gpu())
    }

    /// A workbench for a network on a certain device.
    pub fn on(network: Network, gpu: Gpu) -> Self {
        let runner = Runner::new(gpu).unwrap_or_else(|error| panic!("{error}"));
        Self { network, runner, evaluator: Evaluator::new() }
    }

    /// A workbench for a saved network, by path from the project's root.
    pub fn load(path: &str) -> Self {
        let loaded = Network::load(&root().join(path), &types()).unwrap_or_else(|error| panic!("{error}"));
        assert!(loaded.warnings.is_empty(), "{path}: {:?}", loaded.warnings);
        Self::new(loaded.network)
    }

    /// Sets a property from JSON text.
    pub fn set(&mut self, property: &str, json: &str) -> &mut Self {
        self.put(property, serde_json::from_str(json).unwrap_or_else(|error| panic!("{json}: {error}")))
    }

    /// Sets a property from JSON.
    pub fn put(&mut self, property: &str, json: serde_json::Value) -> &mut Self {
        let (processor, id) = property.split_once('.').expect("PROCESSOR.PROPERTY");
        self.network.set_from_json(processor, id, &json).unwrap_or_else(|error| panic!("{error}"));
        self
    }

    /// Evaluates what the request asks for.
    pub fn evaluate(&mut self, request: &Request) -> Report {
        let report = self.runner.evaluate(&mut self.evaluator, &self.network, request);
        report.unwrap_or_else(|error| panic!("{error}"))
    }

    /// Evaluates and reads one image back.
    ///
    /// # Panics
    /// When a processor fails or is not ready: a test must never compare what was not computed.
    pub fn picture(&mut self, processor: &str, outport: &str, size: [u32; 2]) -> Picture {
        let address = format!("{processor}.{outport}").parse().unwrap_or_else(|error| panic!("{error}"));
        let request = Request { watch: vec![address], size: Some(size), ..Request::default() };
        let report = self.evaluate(&request);
        assert!(report.is_complete(), "{report:?}");
        match self.evaluator.output(processor, outport) {
            Some(Data::Image(image)) => Picture::of(image, &self.runner.context.gpu),
            other => panic!("{processor}.{outport} holds no image but {other:?}"),
        }
    }
}
