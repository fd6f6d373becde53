//! What is measured: the picture of a ray traversal in an evaluated network, as a scene of the float64 reference.

pub(crate) mod chain;
pub(crate) mod lighting;

use std::sync::Arc;

use glam::DVec3;
use rayloom_network::{self as network, Network, Properties};
use rayloom_processors::{Data, Mesh, View, same_box, step_length};
use rayloom_reference::field::Sampling;
use rayloom_reference::gradient::GradientOperator;
use rayloom_reference::ray::AxisBox;
use rayloom_reference::shading::Shading;
use rayloom_reference::{
    Camera, Classification, FirstHit, Labels, Layer, Method, Projection, Reference, Refinement, Scene,
};
use rayloom_volume::{Knot, TransferFunction, Volume, VolumeRole};

use crate::subject::chain::Chain;
use crate::subject::lighting::{gradient, shading};
use crate::{MeasureError, Refusal};

/// What a ray traversal shows, in the words of the reference; it keeps the volume.
#[derive(Debug, Clone)]
pub struct Subject {
    volume: Arc<Volume>,
    channel: u32,
    sampling: Sampling,
    clip: AxisBox,
    camera: Camera,
    size: [u32; 2],
    step: f64,
    pixel_rate: f64,
    jitter: Option<u32>,
    reference_length: f64,
    method: Method,
    classification: Classification,
    shading: Option<Shading>,
    gradient: GradientOperator,
    early_termination: Option<f64>,
    /// Why the samples of the device cannot be retraced, if they cannot.
    own_samples: Option<Refusal>,
}

pub(crate) type Refusable<T> = Result<T, MeasureError>;

pub(crate) fn refuse<T>(why: impl Into<String>) -> Refusable<T> {
    Err(Refusal(why.into()).into())
}

impl Subject {
    /// What the ray traversal of `chain` shows. `outputs` gives what is on the outports `volume`, `labels`, `entry` and
    /// `geometry` of the chain.
    ///
    /// # Errors
    /// A [`Refusal`] where the traversal shows something that the reference does not know: another compositing, shading,
    /// classification or gradient, edited shader text, proxy geometry that is not a box along the voxel axes.
    pub fn of<'d>(
        network: &Network,
        outputs: impl Fn(&network::Address) -> Option<&'d Data>,
        chain: &Chain,
    ) -> Refusable<Self> {
        let missing = |what| MeasureError::Evaluation(format!("{what} has not been computed, so there is no scene."));
        let properties =
            network.processor(chain.traversal()).ok_or_else(|| missing(chain.image.to_string()))?.properties();
        let output = |port: &network::Address| outputs(port).ok_or_else(|| missing(port.to_string()));
        let volume_at = |port| match output(port)? {
            Data::Volume(data) => Ok(data.volume.clone()),
            _ => Err(missing(port.to_string())),
        };
        let Data::Geometry(mesh) = output(&chain.geometry)? else { return Err(missing(chain.geometry.to_string())) };
        let view = match output(&chain.entry)? {
            Data::Image(image) => image.view.clone().ok_or_else(|| missing(chain.entry.to_string()))?,
            _ => return Err(missing(chain.entry.to_string())),
        };
        check_texts(&properties, &chain.image.item)?;
        let volume = volume_at(&chain.volume)?;
        let method = method(&properties, &chain.image.item)?;
        let classification = classification(&properties, &chain.image.item, method, || volume_at(&chain.labels))?;
        check_box(&volume, &classification)?;
        let shading = shading(&properties, method)?;
        let gradient = match shading.is_some() || method == Method::FirstHit(FirstHit::Normal) {
            true => gradient(&properties, network, chain)?,
            false => GradientOperator::default(),
        };
        let error = properties.f64("termination_error")?;
        let step = step_length(&view, &volume, properties.f64("sampling_rate")?);
        Ok(Self {
            channel: channel(&properties, &volume)?,
            sampling: sampling(&properties)?,
            clip: clip(mesh)?,
            camera: camera(&view),
            size: view.size,
            step,
            pixel_rate: properties.f64("pixel_rate")?,
            jitter: jitter(&properties)?,
            reference_length: reference_length(&properties, &chain.image.item, &volume, method)?,
            method,
            classification,
            shading,
            gradient,
            early_termination: (error > 0.0).then_some(1.0 - error),
            own_samples: own_samples(&properties, &volume, method, step)?,
            volume,
        })
    }

    /// The scene.
    pub fn scene(&self) -> Scene<'_> {
        Scene {
            channel: self.channel,
            sampling: self.sampling,
            clip: self.clip,
            step: self.step,
            jitter: self.jitter,
            reference_length: self.reference_length,
            method: self.method,
            shading: self.shading,
            gradient: self.gradient,
            early_termination: self.early_termination,
            ..Scene::new(&self.volume, self.classification.clone(), self.camera, self.size)
        }
    }

    /// Whether the exact pictures of both are the same.
    pub(crate) fn stands_for(&self, other: &Self) -> bool {
        let surface = |method| match method {
            Method::Isosurface { value, .. } => Method::Isosurface { value, refinement: Refinement::None },
            Method::Isosurfaces { layers, .. } => Method::Isosurfaces { layers, refinement: Refinement::None },
            other => other,
        };
        surface(self.method) == surface(other.method)
            && same_values(&self.volume, &other.volume)
            // Fewer rays than pixels are a price; the mean of several rays is another picture than that of one.
            && self.pixel_rate.max(1.0) == other.pixel_rate.max(1.0)
            && (self.channel, self.sampling, self.gradient, self.size)
                == (other.channel, other.sampling, other.gradient, other.size)
            && (self.clip, self.camera, self.shading) == (other.clip, other.camera, other.shading)
            && self.reference_length == other.reference_length
            && same_classification(&self.classification, &other.classification)
    }

    /// Whether a reference can draw it.
    ///
    /// # Errors
    /// The same samples cannot be retraced where they do not stand for points of the field.
    pub fn check(&self, reference: Reference) -> Result<(), Refusal> {
        match (&self.own_samples, reference) {
            (Some(refusal), Reference::SameSamples) => Err(refusal.clone()),
            _ => Ok(()),
        }
    }
}

fn same_classification(a: &Classification, b: &Classification) -> bool {
    match (a, b) {
        (Classification::Function(a), Classification::Function(b)) => a == b,
        (Classification::Labels(a), Classification::Labels(b)) => {
            a.table == b.table && same_values(&a.volume, &b.volume)
        }
        _ => false,
    }
}

fn same_values(a: &Arc<Volume>, b: &Arc<Volume>) -> bool {
    let place = |volume: &Volume| (volume.dims, volume.channels, volume.index_to_world, volume.role);
    let scale = |volume: &Volume| (volume.slope, volume.intercept);
    Arc::ptr_eq(a, b) || (place(a) == place(b) && scale(a) == scale(b) && a.voxels == b.voxels)
}

/// The property that chooses the compositing of an outport.
pub(crate) fn compositing_of(outport: &str) -> String {
    format!("compositing{}", outport.trim_start_matches("image"))
}

fn check_texts(properties: &Properties, outport: &str) -> Refusable<()> {
    let compositing = compositing_of(outport);
    for slot in ["sampling", "classification", "gradient", "shading", "refinement", "skipping", &compositing] {
        if !properties.text(&format!("{slot}.text"))?.trim().is_empty() {
            return refuse(format!("the slot `{slot}` holds a text of your own, which it cannot read"));
        }
    }
    Ok(())
}

fn method(properties: &Properties, outport: &str) -> Refusable<Method> {
    let slot = compositing_of(outport);
    Ok(match properties.text(&slot)? {
        "dvr" => Method::Dvr,
        "mip" => Method::Mip,
        "minip" => Method::MinIp,
        "mean" => Method::Mean,
        "sum" if properties.f64(&format!("{slot}.gain"))? > 0.0 => Method::Sum,
        "sum" => return refuse("a sum with the gain 0 shows one value everywhere"),
        "first_hit_depth" => Method::FirstHit(FirstHit::Depth),
        "first_hit_point" => Method::FirstHit(FirstHit::Point),
        "first_hit_normal" => Method::FirstHit(FirstHit::Normal),
        "isosurface" => {
            let value = properties.f64(&format!("{slot}.isovalue"))?;
            Method::Isosurface { value, refinement: refinement(properties)? }
        }
        "isosurfaces" => {
            Method::Isosurfaces { layers: layers(properties, &slot)?, refinement: refinement(properties)? }
        }
        other => {
            return refuse(format!(
                "the compositing `{other}` has no counterpart there; it knows dvr, mip, minip, mean, sum, isosurface, \
                 isosurfaces and the first hits"
            ));
        }
    })
}

fn layers(properties: &Properties, slot: &str) -> Refusable<[Layer; 3]> {
    let layer = |name: &str| {
        let [r, g, b, _] = properties.color(&format!("{slot}.color_{name}"))?;
        let number = |what: &str| properties.f64(&format!("{slot}.{what}_{name}"));
        Ok::<_, MeasureError>(Layer { value: number("isovalue")?, color: [r, g, b], opacity: number("opacity")? })
    };
    Ok([layer("a")?, layer("b")?, layer("c")?])
}

fn refinement(properties: &Properties) -> Refusable<Refinement> {
    let steps = |id| Ok::<_, MeasureError>(properties.int(id)?.clamp(0, 64) as u32);
    Ok(match properties.text("refinement")? {
        "none" => Refinement::None,
        "linear" => Refinement::Linear,
        "bisection" => Refinement::Bisection(steps("refinement.halvings")?),
        // The shader takes a last straight line behind its samples, which the reference counts as a step.
        "secant" => Refinement::Secant(steps("refinement.steps")? + 1),
        other => return refuse(format!("the refinement `{other}` has no counterpart there")),
    })
}

/// `labels` gives the label volume.
fn classification(
    properties: &Properties,
    outport: &str,
    method: Method,
    labels: impl Fn() -> Refusable<Arc<Volume>>,
) -> Refusable<Classification> {
    if let Method::Isosurfaces { .. } = method {
        return Ok(TransferFunction::default().into());
    }
    if let Method::Isosurface { .. } = method {
        let [r, g, b, _] = properties.color(&format!("{}.color", compositing_of(outport)))?;
        let surface = TransferFunction::new(vec![Knot::new(0.0, [r, g, b], 1.0)]);
        return match surface {
            Ok(surface) => Ok(surface.into()),
            Err(error) => refuse(format!("the colour of the surface is none ({error})")),
        };
    }
    match properties.text("classification")? {
        "transfer_function" | "preintegrated_fast" | "preintegrated_full" => {
            Ok(properties.transfer_function("transfer_function")?.clone().into())
        }
        "transfer_function_2d" => refuse("it knows no transfer functions over value and gradient"),
        "labels" if matches!(method, Method::Dvr | Method::FirstHit(_)) => {
            Ok(Classification::Labels(Labels { volume: labels()?, table: properties.labels("label_table")?.clone() }))
        }
        "labels" => {
            refuse("it classifies by labels in direct volume rendering and first hits only; choose the compositing dvr")
        }
        other => refuse(format!(
            "the classification `{other}` has no counterpart there; it knows transfer functions of the value, and labels"
        )),
    }
}

fn check_box(volume: &Volume, classification: &Classification) -> Refusable<()> {
    match classification {
        Classification::Labels(labels) if !same_box(&volume.texture_to_world(), &labels.volume.texture_to_world()) => {
            refuse("the labels and the volume fill different boxes in the world; use labels of the same scan")
        }
        _ => Ok(()),
    }
}

fn sampling(properties: &Properties) -> Refusable<Sampling> {
    Ok(match properties.text("sampling")? {
        "nearest" => Sampling::Nearest,
        "filtered" | "trilinear" => Sampling::Trilinear,
        "catmull_rom" => Sampling::CatmullRom,
        "bspline" => Sampling::BSplinePrefiltered,
        other => return refuse(format!("the sampling `{other}` has no counterpart there")),
    })
}

fn channel(properties: &Properties, volume: &Volume) -> Refusable<u32> {
    if volume.role == VolumeRole::GradientAndValue {
        return Ok(3);
    }
    // The reference itself refuses a channel that the volume lacks.
    Ok(u32::try_from(properties.int("channel")?).unwrap_or(0))
}

/// The length to which opacities refer, world units. A gain of a sum shortens it: twice the gain is the sum over twice as
/// many reference lengths.
fn reference_length(properties: &Properties, outport: &str, volume: &Volume, method: Method) -> Refusable<f64> {
    let chosen = properties.f64("reference_length")?;
    let length = if chosen > 0.0 { chosen } else { volume.mean_spacing() };
    Ok(match method {
        Method::Sum => length / properties.f64(&format!("{}.gain", compositing_of(outport)))?,
        _ => length,
    })
}

/// The box that a mesh bounds.
fn clip(mesh: &Mesh) -> Refusable<AxisBox> {
    const ROUNDING: f64 = 1e-6;
    let corner = |position: &[f32; 3]| DVec3::from(position.map(f64::from));
    let corners: Vec<DVec3> = mesh.positions.iter().map(corner).collect();
    let min = corners.iter().copied().reduce(DVec3::min).unwrap_or(DVec3::ZERO);
    let max = corners.iter().copied().reduce(DVec3::max).unwrap_or(DVec3::ZERO);
    let signed = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|i| corners.get(i as usize).copied().unwrap_or_default() - min);
        a.dot(b.cross(c)) / 6.0
    };
    // By the divergence theorem: only the whole box has its volume.
    let inside: f64 = mesh.indices.iter().map(signed).sum();
    match mesh.closed && (inside - (max - min).element_product()).abs() <= ROUNDING {
        true => Ok(AxisBox { min, max }),
        false => refuse(
            "the proxy geometry is not a box along the voxel axes; cut with the clip ranges of a cube proxy only",
        ),
    }
}

fn camera(view: &View) -> Camera {
    let network::Camera { position, focus, up, projection, near } = view.camera;
    let projection = match projection {
        network::Projection::Perspective { fov_degrees } => Projection::Perspective { fov_degrees },
        network::Projection::Orthographic { height } => Projection::Orthographic { height },
    };
    Camera { eye: position.into(), focus: focus.into(), up: up.into(), projection, near }
}

fn jitter(properties: &Properties) -> Refusable<Option<u32>> {
    let seed = properties.int("jitter_seed")? as u32;
    Ok(properties.bool("jitter")?.then_some(seed))
}

fn own_samples(properties: &Properties, volume: &Volume, method: Method, step: f64) -> Refusable<Option<Refusal>> {
    let classification = properties.text("classification")?;
    if method == Method::Dvr && classification.starts_with("preintegrated") {
        return Ok(Some(Refusal(
            "pre-integrated classification looks at segments, not samples; draw the exact reference or classify by \
             `transfer_function`"
                .into(),
        )));
    }
    if properties.f64("pixel_rate")? != 1.0 {
        return Ok(Some(Refusal(
            "a pixel is not one ray there; set pixel_rate to 1 or draw the exact reference".into(),
        )));
    }
    let most = properties.int("max_samples")? as f64;
    let longest = longest_diagonal(volume) / step;
    Ok((longest > most).then(|| {
        Refusal(format!(
            "rays of up to {longest:.0} samples are cut to {most}; raise max_samples or draw the exact reference"
        ))
    }))
}

/// Length of the longest line through the box of a volume, world units.
fn longest_diagonal(volume: &Volume) -> f64 {
    let box_axes = volume.texture_to_world().matrix3;
    let diagonals = [DVec3::ONE, DVec3::new(-1.0, 1.0, 1.0), DVec3::new(1.0, -1.0, 1.0), DVec3::new(1.0, 1.0, -1.0)];
    diagonals.map(|diagonal| (box_axes * diagonal).length()).into_iter().fold(0.0, f64::max)
}
