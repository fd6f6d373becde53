//! A network on a device, set and looked at as a measurement needs it.

use std::time::Duration;

use rayloom_gpu::Gpu;
use rayloom_network::{Address, Camera, Evaluator, Level, Network, Report, Request, Sinks, Value};
use rayloom_processors::{Data, Picture, Runner};
use serde_json::json;

use crate::errors::surface::{Layers, NORMAL, Surface, surface};
use crate::run::figures::Shot;
use crate::subject::chain::Chain;
use crate::subject::compositing_of;
use crate::{Counts, MeasureError, Setting, Subject};

/// Pixels in a row, premultiplied.
pub(crate) type Pixels = Vec<[f32; 4]>;

/// A network with a runner and what has been computed.
pub(crate) struct Bench {
    saved: Network,
    network: Network,
    runner: Runner,
    evaluator: Evaluator<Runner>,
    pub chain: Chain,
    pub size: [u32; 2],
}

impl Bench {
    pub fn new(network: &Network, chain: Chain, gpu: Gpu, size: [u32; 2]) -> Result<Self, MeasureError> {
        let runner = Runner::new(gpu)?;
        Ok(Self { saved: network.clone(), network: network.clone(), runner, evaluator: Evaluator::new(), chain, size })
    }

    /// The camera of the saved network.
    pub fn camera(&self) -> Result<Camera, MeasureError> {
        match self.saved.value(&self.chain.view, "camera") {
            Some(Value::Camera(camera)) => Ok(camera),
            _ => Err(MeasureError::Subject(format!("`{}` has no camera.", self.chain.view))),
        }
    }

    /// From here on the network has this setting and camera. Nothing is computed yet.
    pub fn set(&mut self, setting: &Setting, camera: &Camera) -> Result<(), MeasureError> {
        let mut network = setting.applied(&self.saved)?;
        network.set_property(&self.chain.view, "camera", Value::Camera(*camera))?;
        self.network = network;
        Ok(())
    }

    /// The picture as it is shown.
    pub fn picture(&mut self) -> Result<Pixels, MeasureError> {
        self.evaluate()?;
        Ok(self.read(&self.chain.image)?.pixels)
    }

    /// The picture with its surface, and what was counted and noted on the way.
    pub fn shot(&mut self) -> Result<(Shot, Vec<String>), MeasureError> {
        let report = self.counted()?;
        let count = |key| self.count(&report, key);
        let counts = Counts { rays: count("rays"), samples: count("samples"), contributing: count("contributing") };
        let notes = report.runs.iter().flat_map(|run| run.notes.clone()).collect();
        let picture = self.read(&self.chain.image)?;
        let surface = self.surface(&picture)?;
        Ok((Shot { pixels: picture.pixels, surface, counts }, notes))
    }

    /// How many samples one ray may take, by the network and by the device: longer ones take longer steps.
    pub fn most_samples(&mut self) -> Result<u64, MeasureError> {
        let report = self.counted()?;
        Ok(self.count(&report, "most_samples"))
    }

    fn counted(&mut self) -> Result<Report, MeasureError> {
        self.runner.count_samples(true);
        self.again(Level::Shader);
        let report = self.evaluate();
        self.runner.count_samples(false);
        self.again(Level::Shader);
        report
    }

    fn count(&self, report: &Report, key: &str) -> u64 {
        let run = report.runs.iter().find(|run| run.processor == self.chain.traversal());
        run.and_then(|run| run.statistics.get(key)?.as_u64()).unwrap_or_default()
    }

    /// The picture with its surface.
    pub fn seen(&mut self) -> Result<(Pixels, Option<Surface>), MeasureError> {
        self.evaluate()?;
        let picture = self.read(&self.chain.image)?;
        let surface = self.surface(&picture)?;
        Ok((picture.pixels, surface))
    }

    /// The mean voxel spacing in world units.
    pub fn voxel(&mut self) -> Result<f64, MeasureError> {
        let port = self.chain.volume.clone();
        self.bring(vec![port.clone()])?;
        match self.evaluator.output(&port.processor, &port.item) {
            Some(Data::Volume(data)) => Ok(data.volume.index_to_world.matrix3.determinant().abs().cbrt()),
            _ => Err(MeasureError::Evaluation(format!("{port} holds no volume."))),
        }
    }

    /// The surface in a picture of the network as it is set.
    fn surface(&mut self, picture: &Picture) -> Result<Option<Surface>, MeasureError> {
        Ok(match Layers::of(&self.network, &self.chain) {
            None => None,
            Some(Layers::Depth) => surface(picture, None),
            Some(Layers::Normals) => surface(picture, Some(&picture.pixels)),
            Some(Layers::ProbedNormals) => surface(picture, Some(&self.normals()?)),
        })
    }

    /// The normals of an isosurface, on an outport beside that of the picture.
    fn normals(&mut self) -> Result<Pixels, MeasureError> {
        let (id, own) = (self.chain.traversal().to_owned(), compositing_of(&self.chain.image.item));
        let number = if own == "compositing2" { 3 } else { 2 };
        let isovalue = self.network.value(&id, &format!("{own}.isovalue")).map(|value| value.to_json());
        let network = self.network.clone();
        let slot = format!("compositing{number}");
        self.network.set_from_json(&id, "target", &json!("32-bit"))?;
        self.network.set_from_json(&id, &format!("{slot}.text"), &json!(NORMAL))?;
        self.network.set_from_json(&id, &format!("{slot}.isovalue"), &isovalue.unwrap_or_default())?;
        let port = Address::new(&id, format!("image{number}"));
        let found = self.bring(vec![port.clone()]).and_then(|_| self.read(&port));
        self.network = network;
        Ok(found?.pixels)
    }

    /// Milliseconds on the device for entry points and rays; everything else is ready before. `None` where it cannot be told.
    pub fn time(&mut self) -> Result<Option<f64>, MeasureError> {
        self.evaluate()?;
        self.time_of_one()
    }

    /// The same, of the very next picture: for what has been rendered before in some size.
    pub fn time_of_one(&mut self) -> Result<Option<f64>, MeasureError> {
        self.runner.measure(true);
        self.again(Level::Result);
        self.evaluator.invalidate(&self.chain.view, Level::Result, "measured again");
        let report = self.evaluate();
        self.runner.measure(false);
        let measured = [self.chain.traversal(), &self.chain.view];
        let report = report?;
        let times = report.runs.iter().filter(|run| measured.contains(&run.processor.as_str())).map(|run| run.gpu);
        let total: Option<Duration> = times.sum();
        Ok(total.map(|time| time.as_secs_f64() * 1e3))
    }

    /// What the network shows, as a scene of the reference.
    pub fn subject(&mut self) -> Result<Subject, MeasureError> {
        let Chain { volume, labels, entry, geometry, .. } = self.chain.clone();
        self.bring(vec![volume, labels, entry, geometry])?;
        Subject::of(&self.network, |port| self.evaluator.output(&port.processor, &port.item), &self.chain)
    }

    /// Voxels along the longest ray that the volume can have.
    pub fn longest_ray(&mut self) -> Result<f64, MeasureError> {
        let port = self.chain.volume.clone();
        self.bring(vec![port.clone()])?;
        match self.evaluator.output(&port.processor, &port.item) {
            Some(Data::Volume(data)) => Ok(data.volume.dims_f64().length()),
            _ => Err(MeasureError::Evaluation(format!("{port} holds no volume."))),
        }
    }

    fn again(&mut self, level: Level) {
        self.evaluator.invalidate(self.chain.traversal(), level, "measured again");
    }

    fn evaluate(&mut self) -> Result<Report, MeasureError> {
        self.bring(vec![self.chain.image.clone()])
    }

    /// Brings these outports up to date.
    fn bring(&mut self, watch: Vec<Address>) -> Result<Report, MeasureError> {
        let request = Request { sinks: Sinks::Only(Vec::new()), watch, size: Some(self.size), ..Request::default() };
        let report = self.runner.evaluate(&mut self.evaluator, &self.network, &request)?;
        self.runner.tidy(|_| true);
        match report.is_complete() {
            true => Ok(report),
            false => Err(MeasureError::Evaluation(problems(&report))),
        }
    }

    fn read(&self, image: &Address) -> Result<Picture, MeasureError> {
        match self.evaluator.output(&image.processor, &image.item) {
            Some(Data::Image(picture)) => Ok(picture.read_back(&self.runner.context)?),
            _ => Err(MeasureError::Evaluation(format!("{image} holds no image."))),
        }
    }
}

impl Drop for Bench {
    /// A measurement that ends early may leave work behind, and drivers do not survive a program that ends under their work.
    fn drop(&mut self) {
        // Whatever is wrong with the device was told to whoever used it, and there is nobody left to tell.
        let _ = self.runner.context.gpu.wait("measuring");
    }
}

/// What failed; if nothing did, what is not ready.
fn problems(report: &Report) -> String {
    let mut lines: Vec<String> = report.failed.iter().map(|(id, error)| format!("{id} failed: {error}")).collect();
    if lines.is_empty() {
        lines = report.not_ready.values().flatten().cloned().collect();
        lines.dedup();
    }
    lines.join("\n")
}
