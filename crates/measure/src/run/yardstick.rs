//! What pictures are compared with.

use std::ops::ControlFlow;

use rayloom_network::{Address, Camera, Network, Value};
use rayloom_reference::{Cache, FirstHit, Method, Reference, surface_points};
use serde_json::{Value as Json, json};

use crate::errors::surface::Surface;
use crate::run::bench::Bench;
use crate::run::figures::Expected;
use crate::run::setting::Assignment;
use crate::subject::chain::Chain;
use crate::{Listener, MeasureError, Refusal, Setting};

/// The choice of a reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standard {
    /// What the saved network stands for, in float64 and without samples: the whole error.
    Exact,
    /// The samples of each setting in float64: the arithmetic of the device alone.
    SameSamples,
    /// The device's own picture with every knob at its finest: for networks that the float64 reference cannot draw.
    Finest,
}

impl Standard {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Exact, Self::SameSamples, Self::Finest];

    /// The name of this choice in commands and files.
    pub fn id(self) -> &'static str {
        match self {
            Self::Exact => Reference::Exact.id(),
            Self::SameSamples => Reference::SameSamples.id(),
            Self::Finest => "finest",
        }
    }

    /// What it stands for.
    pub(crate) fn meaning(self) -> &'static str {
        match self {
            Self::Exact => {
                "Compared with the exact picture of the network as saved: float64, without samples. Settings that mean \
                 something else, such as another interpolation or another gradient, are measured as departures from it."
            }
            Self::SameSamples => {
                "Compared with the same samples taken in float64, for each setting its own: what remains is the arithmetic \
                 and storage of the device, not the error of the sampling."
            }
            Self::Finest => {
                "Compared with the device's own picture at its finest setting, which is not free of error itself. Settings \
                 that mean something else, such as another gradient, are measured as departures from it."
            }
        }
    }
}

/// Draws references.
pub(crate) struct Yardstick<'a> {
    pub standard: Standard,
    pub cache: &'a Cache,
    pub listener: Listener<'a>,
    /// Everything at its finest.
    pub finest: Setting,
}

impl Yardstick<'_> {
    /// The references of all views for one setting.
    pub fn draw(&self, bench: &mut Bench, setting: &Setting, views: &[Camera]) -> Result<Vec<Expected>, MeasureError> {
        let view = |(index, view): (usize, &Camera)| {
            let what = format!("reference of view {} of {}", index + 1, views.len());
            match self.standard {
                Standard::Exact => self.reference(bench, Reference::Exact, setting, view, &what),
                Standard::SameSamples => self.reference(bench, Reference::SameSamples, setting, view, &what),
                Standard::Finest => {
                    (self.listener)(&what, 0.0);
                    bench.set(&self.finest, view)?;
                    let (pixels, surface) = bench.seen()?;
                    Ok(Expected { pixels: pixels.into_iter().map(|pixel| pixel.map(f64::from)).collect(), surface })
                }
            }
        };
        views.iter().enumerate().map(view).collect()
    }

    fn reference(
        &self,
        bench: &mut Bench,
        reference: Reference,
        setting: &Setting,
        view: &Camera,
        what: &str,
    ) -> Result<Expected, MeasureError> {
        bench.set(setting, view)?;
        let subject = bench.subject()?;
        subject.check(reference)?;
        let progress = |share| {
            (self.listener)(what, share);
            ControlFlow::Continue(())
        };
        let scene = subject.scene();
        let image = self.cache.render(reference, &scene, None, &progress)?.image;
        let normals = match scene.method {
            Method::Isosurface { .. } => Some(scene.shading.is_some()),
            Method::FirstHit(told) => Some(told == FirstHit::Normal),
            _ => None,
        };
        let surface = |normals| Ok::<_, MeasureError>(Surface { points: surface_points(&scene, &image)?, normals });
        let surface = normals.map(surface).transpose()?;
        Ok(Expected { pixels: image.color, surface })
    }
}

/// The standard to use: the one that was asked for, else exact where that can be drawn, with the reason where it cannot.
pub(crate) fn choose(asked: Option<Standard>, bench: &mut Bench) -> Result<(Standard, Option<Refusal>), MeasureError> {
    if let Some(asked) = asked {
        return Ok((asked, None));
    }
    let camera = bench.camera()?;
    bench.set(&Setting::saved(), &camera)?;
    match bench.subject() {
        Ok(_) => Ok((Standard::Exact, None)),
        Err(MeasureError::Refusal(refusal)) => Ok((Standard::Finest, Some(refusal))),
        Err(other) => Err(other),
    }
}

/// Every knob of storage and termination at its finest, and `rate` samples per voxel, classified one by one: tables of
/// pre-integration are too coarse for steep transfer functions, however many samples there are.
pub(crate) fn finest(network: &Network, chain: &Chain, rate: f64) -> Setting {
    let mut setting = storage(network, chain);
    setting.name = "finest".into();
    setting.assignments.push(assignment(chain.traversal(), "sampling_rate", json!(rate)));
    setting.assignments.push(assignment(chain.traversal(), "termination_error", json!(0.0)));
    if let Some(Value::Text(id)) = network.value(chain.traversal(), "classification")
        && id.starts_with("preintegrated")
    {
        setting.assignments.push(assignment(chain.traversal(), "classification", json!("transfer_function")));
    }
    setting
}

/// All storage in 32 bits, and weights of interpolation in floats.
pub(crate) fn storage(network: &Network, chain: &Chain) -> Setting {
    let traversal = chain.traversal();
    let mut assignments =
        vec![assignment(traversal, "target", json!("32-bit")), assignment(&chain.view, "format", json!("32-bit"))];
    assignments.extend(chain.source.iter().map(|source| assignment(source, "precision", json!("32-bit"))));
    assignments.extend(chain.gradients(network).map(|gradients| assignment(gradients, "storage", json!("32-bit"))));
    if network.value(traversal, "sampling") == Some(Value::Text("filtered".into())) {
        assignments.push(assignment(traversal, "sampling", json!("trilinear")));
    }
    Setting { name: "32-bit storage".into(), assignments }
}

pub(crate) fn assignment(processor: &str, property: &str, value: Json) -> Assignment {
    Assignment { property: Address::new(processor, property), value }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;

    #[test]
    fn the_finest_picture_does_without_tables_of_pre_integration() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../networks/brain.json");
        let types = Arc::new(rayloom_processors::registry());
        let mut network = Network::load(path.as_ref(), &types).expect("the flagship").network;
        let chain = Chain::find(&network, None).expect("a ray traversal");
        for (saved, used) in [("preintegrated_full", true), ("preintegrated_fast", true), ("transfer_function", false)]
        {
            network.set_from_json(chain.traversal(), "classification", &json!(saved)).expect("a snippet");
            let finest = finest(&network, &chain, 64.0);
            let one = assignment(chain.traversal(), "classification", json!("transfer_function"));
            assert_eq!(finest.assignments.contains(&one), used, "{saved}");
        }
    }
}
