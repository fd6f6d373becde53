//! What is to be rendered.

use crate::camera::Camera;
use crate::classification::Classification;
use crate::field::Sampling;
use crate::gradient::GradientOperator;
use crate::ray::AxisBox;
use crate::shading::Shading;
use rayloom_volume::Volume;

/// How an isosurface is located between the two samples that enclose it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refinement {
    /// Not at all: the second of the two samples.
    None,
    /// Where the straight line between the two values crosses.
    Linear,
    /// That many halvings, then the middle of what is left.
    Bisection(u32),
    /// That many steps of false position, each keeping the crossing enclosed; one is [`Refinement::Linear`]. The weight of an
    /// end that two steps in a row have kept is halved, or the steps would creep (the Illinois method, Dowell and Jarratt 1971).
    Secant(u32),
}

/// One of several isosurfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    /// The value in data units.
    pub value: f64,
    /// Straight colour.
    pub color: [f64; 3],
    /// Opacity; a layer of none is not there.
    pub opacity: f64,
}

/// What is told of the place where a ray first meets something visible.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FirstHit {
    /// The view depth in world units, in all three colours.
    Depth,
    /// The texture coordinates.
    Point,
    /// The unit normal `n` in world space, towards smaller values, as `n / 2 + 1 / 2`; zero where the field is flat.
    Normal,
}

/// What becomes of the samples of a ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// Emission and absorption, front to back. Depth: the first sample that is not transparent.
    Dvr,
    /// The largest value, classified once over one reference length. Depth: where it first occurs.
    Mip,
    /// The smallest value, likewise.
    MinIp,
    /// The mean value weighted by length, likewise. Depth: the entry.
    Mean,
    /// The integral of the normalised value over reference lengths, taken as a normalised value itself and classified likewise:
    /// an X-ray exposed for one reference length of the largest value. Depth: the entry.
    Sum,
    /// The first crossing of a value, opaque, in the colour that the transfer function has there. Depth: the crossing.
    Isosurface {
        /// The value in data units.
        value: f64,
        /// How the crossing is located.
        refinement: Refinement,
    },
    /// All crossings of up to three values, composited front to back. Depth: the first. Where the field passes several values at
    /// one place, they are met in the order in which it would come by them.
    Isosurfaces {
        /// The surfaces in any order; classification does not apply to them.
        layers: [Layer; 3],
        /// How the crossings are located.
        refinement: Refinement,
    },
    /// The first place that is not transparent, opaque, with what is told of it as its colour. Depth: that place.
    FirstHit(FirstHit),
}

/// A picture to render.
#[derive(Debug, Clone)]
pub struct Scene<'a> {
    /// The data.
    pub volume: &'a Volume,
    /// The channel that is shown.
    pub channel: u32,
    /// How values between voxels come about.
    pub sampling: Sampling,
    /// The part of the volume that is shown, in texture coordinates; rays enter and leave here.
    pub clip: AxisBox,
    /// Where the picture is taken from.
    pub camera: Camera,
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
    /// Distance between samples in world units, the same for all rays.
    pub step: f64,
    /// The length in world units over which a material shows the opacity drawn in the transfer function.
    pub reference_length: f64,
    /// What becomes of the samples of a ray.
    pub method: Method,
    /// Colours and opacities; by labels for [`Method::Dvr`] and [`Method::FirstHit`] only.
    pub classification: Classification,
    /// Lighting of [`Method::Dvr`] and isosurfaces; the others are never lit.
    pub shading: Option<Shading>,
    /// How gradients for the lighting are taken.
    pub gradient: GradientOperator,
    /// Seed of the jitter of the sample lattice, see [`crate::same_samples::jitter`]; `None` for none.
    pub jitter: Option<u32>,
    /// Opacity at which [`Method::Dvr`] and [`Method::Isosurfaces`] stop following a ray; what is accumulated stays as it is.
    pub early_termination: Option<f64>,
}

impl<'a> Scene<'a> {
    /// The whole first channel of `volume`, rendered by [`Method::Dvr`] at one trilinear sample per mean voxel spacing, without
    /// lighting or early termination; opacities are per unit length.
    pub fn new(volume: &'a Volume, classification: impl Into<Classification>, camera: Camera, size: [u32; 2]) -> Self {
        Self {
            volume,
            channel: 0,
            sampling: Sampling::default(),
            clip: AxisBox::UNIT,
            camera,
            size,
            step: volume.mean_spacing(),
            reference_length: 1.0,
            method: Method::Dvr,
            classification: classification.into(),
            shading: None,
            gradient: GradientOperator::default(),
            jitter: None,
            early_termination: None,
        }
    }

    /// Checks everything but the camera, which [`Camera::view`] checks.
    pub(crate) fn check(&self) -> Result<(), SceneError> {
        let positive = |what: &'static str, found: f64| {
            if found > 0.0 && found.is_finite() { Ok(()) } else { Err(SceneError::NotPositive { what, found }) }
        };
        if self.channel >= self.volume.channels {
            return Err(SceneError::Channel { found: self.channel, count: self.volume.channels });
        }
        if self.size.contains(&0) {
            return Err(SceneError::Size { found: self.size });
        }
        positive("step", self.step)?;
        positive("reference length", self.reference_length)?;
        if let Some(threshold) = self.early_termination {
            positive("early termination threshold", threshold)?;
        }
        if !self.clip.min.is_finite() || !self.clip.max.is_finite() {
            return Err(SceneError::Clip);
        }
        let isovalues = match self.method {
            Method::Isosurface { value, .. } => vec![value],
            Method::Isosurfaces { layers, .. } => layers.map(|layer| layer.value).to_vec(),
            _ => vec![],
        };
        if let Some(found) = isovalues.into_iter().find(|value| !value.is_finite()) {
            return Err(SceneError::Isovalue { found });
        }
        if matches!(self.classification, Classification::Labels(_))
            && !matches!(self.method, Method::Dvr | Method::FirstHit(_))
        {
            return Err(SceneError::Labels);
        }
        Ok(())
    }
}

/// Why a scene cannot be rendered.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// The camera shows nothing.
    #[error("The camera cannot be used: {problem}.")]
    Camera {
        /// What must hold and does not.
        problem: &'static str,
    },
    /// The volume lacks the channel.
    #[error("The volume has no channel {found}: choose one below {count}.")]
    Channel {
        /// The channel asked for.
        found: u32,
        /// The number of channels.
        count: u32,
    },
    /// The picture is empty.
    #[error("A picture of {} x {} pixels is empty: give it at least one pixel each way.", found[0], found[1])]
    Size {
        /// The size asked for.
        found: [u32; 2],
    },
    /// Part of the rectangle lies outside the picture.
    #[error(
        "The rectangle {found:?} does not lie within the picture of {} x {} pixels: choose one that does.", size[0], size[1]
    )]
    Rectangle {
        /// The rectangle asked for.
        found: crate::image::Rectangle,
        /// The size of the picture.
        size: [u32; 2],
    },
    /// A number must be positive.
    #[error("The {what} is {found}: it must be positive and finite.")]
    NotPositive {
        /// Which number.
        what: &'static str,
        /// Its value.
        found: f64,
    },
    /// The clip box is not a box.
    #[error("The clip box has a coordinate that is not finite: give texture coordinates between 0 and 1.")]
    Clip,
    /// The isovalue is not a number.
    #[error("The isovalue is {found}: it must be finite, in data units.")]
    Isovalue {
        /// Its value.
        found: f64,
    },
    /// One value of a whole ray has no label.
    #[error(
        "Only direct volume rendering and first hits look at labels: choose one of them, or classify by a transfer function."
    )]
    Labels,
}
