//! A chain from a generated volume to the picture of a ray traversal.

use std::path::Path;
use std::sync::Arc;

use rayloom_gpu::Gpu;
use rayloom_network::{Address, Camera, Network};
use rayloom_processors::types;
use rayloom_reference::exact;
use rayloom_volume::Volume;
use serde_json::{Value as Json, json};

use crate::run::bench::{Bench, Pixels};
use crate::run::yardstick::assignment;
use crate::subject::chain::Chain;
use crate::verify::rays::{Chord, chords};
use crate::{MeasureError, Setting};

/// Properties and their values, `PROCESSOR.PROPERTY` each.
pub(super) type Settings<'a> = &'a [(&'a str, Json)];

/// The chain on a device.
pub(super) struct Lab {
    bench: Bench,
    base: Setting,
    camera: Camera,
    size: [u32; 2],
}

impl Lab {
    /// A chain with these settings, looked at through a camera: whole rays, float weights of interpolation, opacities a world
    /// unit.
    pub fn new(gpu: &Gpu, size: [u32; 2], camera: Camera, settings: Settings<'_>) -> Result<Self, MeasureError> {
        let text = json!({
            "rayloom": 1,
            "processors": [
                {"id": "source", "type": types::VOLUME_GENERATOR},
                {"id": "proxy", "type": types::CUBE_PROXY},
                {"id": "view", "type": types::ENTRY_EXIT_POINTS},
                {"id": "traversal", "type": types::RAY_TRAVERSAL, "properties": {
                    "termination_error": 0, "reference_length": 1, "sampling": "trilinear",
                }},
            ],
            "connections": ["source.volume -> proxy.volume", "proxy.geometry -> view.geometry",
                "source.volume -> traversal.volume", "view.entry -> traversal.entry", "view.exit -> traversal.exit"],
        });
        let registry = Arc::new(rayloom_processors::registry());
        let loaded = Network::from_text(&text.to_string(), Path::new(""), &registry);
        let network = loaded.map_err(|error| MeasureError::Subject(error.to_string()))?.network;
        let mut base = Setting::saved();
        add(&mut base, settings)?;
        let network = base.applied(&network)?;
        let chain = Chain::find(&network, None)?;
        let bench = Bench::new(&network, chain, gpu.clone(), size)?;
        Ok(Self { bench, base, camera, size })
    }

    /// Sets properties for good.
    pub fn keep(&mut self, settings: Settings<'_>) -> Result<(), MeasureError> {
        add(&mut self.base, settings)
    }

    /// The picture with some more settings.
    pub fn picture(&mut self, settings: Settings<'_>) -> Result<Pixels, MeasureError> {
        self.set(settings)?;
        self.bench.picture()
    }

    /// The same without samples, in float64.
    pub fn exact(&mut self, settings: Settings<'_>) -> Result<Vec<[f64; 4]>, MeasureError> {
        self.set(settings)?;
        Ok(exact::render(&self.bench.subject()?.scene())?.color)
    }

    /// The volume and the chord of every pixel.
    pub fn rays(&mut self) -> Result<(Volume, Vec<Option<Chord>>), MeasureError> {
        self.set(&[])?;
        let subject = self.bench.subject()?;
        let scene = subject.scene();
        Ok((scene.volume.clone(), chords(&scene.camera, self.size, scene.volume, &scene.clip)?))
    }

    fn set(&mut self, settings: Settings<'_>) -> Result<(), MeasureError> {
        let mut setting = self.base.clone();
        add(&mut setting, settings)?;
        self.bench.set(&setting, &self.camera)
    }
}

/// Adds assignments in their order.
fn add(setting: &mut Setting, settings: Settings<'_>) -> Result<(), MeasureError> {
    for (property, value) in settings {
        let address: Address =
            property.parse().map_err(|error: rayloom_network::AddressError| MeasureError::Plan(error.to_string()))?;
        setting.assignments.push(assignment(&address.processor, &address.item, value.clone()));
    }
    Ok(())
}

/// Root of the mean square; not a number for no values.
pub(super) fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| (sum + value * value, count + 1.0));
    f64::sqrt(sum / count)
}
