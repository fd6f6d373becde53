//! The picture of a ray traversal with finer sampling, from inputs that have been computed already.

use std::collections::BTreeSet;

use rayloom_gpu::{Gpu, GpuError};
use rayloom_network::{Address, Backend, Input, Inputs, Job, Level, Network, Outputs, Value};
use rayloom_processors::{Data, Runner};

use crate::run::bench::Pixels;
use crate::{Counts, MeasureError};

/// Runs ray traversals anew beside an evaluation, which it leaves alone.
pub struct Refiner {
    runner: Runner,
}

impl Refiner {
    /// A refiner on a device.
    ///
    /// # Errors
    /// The device cannot be used.
    pub fn new(gpu: Gpu) -> Result<Self, GpuError> {
        Ok(Self { runner: Runner::new(gpu)? })
    }

    /// The premultiplied pixels on `image`, an outport of a ray traversal, with `factor` times the sampling rate of the
    /// network, and what was sampled for them. `outputs` gives what is on the outports that feed the traversal.
    ///
    /// # Errors
    /// There is no such traversal, it is not fed, the rate is beyond its range, or it fails.
    pub fn picture<'d>(
        &mut self,
        network: &Network,
        outputs: impl Fn(&Address) -> Option<&'d Data>,
        image: &Address,
        factor: f64,
    ) -> Result<(Pixels, Counts), MeasureError> {
        let mut network = network.clone();
        let id = image.processor.as_str();
        if let Some(Value::Float(rate)) = network.value(id, "sampling_rate") {
            network.set_property(id, "sampling_rate", Value::Float(rate * factor))?;
        }
        let mut inputs = Inputs::new();
        for connection in network.inputs(id) {
            let from = connection.from.clone();
            let data =
                outputs(&from).ok_or_else(|| MeasureError::Evaluation(format!("{from} has not been computed.")))?;
            let input = Input { data: data.clone(), from, revision: 0 };
            inputs.entry(connection.to.item.clone()).or_default().push(input);
        }
        self.runner.count_samples(true);
        let outputs = self.run(&network, image, &inputs)?;
        self.runner.tidy(|other| other == id);
        let count = |key| outputs.statistics.get(key).and_then(|value| value.as_u64()).unwrap_or_default();
        let counts = Counts { rays: count("rays"), samples: count("samples"), contributing: count("contributing") };
        match outputs.data.get(&image.item) {
            Some(Data::Image(picture)) => Ok((picture.read_back(&self.runner.context)?.pixels, counts)),
            _ => Err(MeasureError::Evaluation(format!("{image} holds no image."))),
        }
    }

    fn run(
        &mut self,
        network: &Network,
        image: &Address,
        inputs: &Inputs<Data>,
    ) -> Result<Outputs<Data>, MeasureError> {
        let absent = || MeasureError::Subject(format!("There is no processor `{}`.", image.processor));
        let processor = network.processor(&image.processor).ok_or_else(absent)?;
        let size = inputs.values().flatten().find_map(|input| match &input.data {
            Data::Image(points) => Some(points.size()),
            _ => None,
        });
        let job = Job {
            id: processor.id(),
            processor_type: processor.processor_type().ok_or_else(absent)?,
            properties: &processor.properties(),
            inputs,
            wanted: &BTreeSet::from([image.item.clone()]),
            size: size.unwrap_or([1, 1]),
            level: Level::Ports,
            reasons: &[],
        };
        let failed = |error| MeasureError::Evaluation(format!("{} failed: {error}", image.processor));
        self.runner.process(&job).map_err(failed)
    }
}
