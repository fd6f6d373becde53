//! The samples of the GPU ray loop, in float64.
//!
//! Every pixel is independent of the others: any [`Rectangle`] of a picture equals the same part of the whole, bit by bit.

mod composite;
mod isosurface;
mod lattice;
mod project;

pub use crate::prepared::SurfaceHit;
pub use lattice::{Lattice, LatticeSample, jitter};

use crate::image::{Image, PixelResult, Rectangle};
use crate::prepared::Prepared;
use crate::progress::{Progress, RenderError, picture, unattended};
use crate::ray::{Ray, Segment};
use crate::scene::{Method, Scene, SceneError};
use glam::DVec3;

/// Renders the whole picture of a scene.
///
/// # Errors
/// The camera, the size or a number of the scene makes no sense.
pub fn render(scene: &Scene<'_>) -> Result<Image, RenderError> {
    Renderer::new(scene)?.render(None, &unattended)
}

/// A scene made ready to be rendered: checked, with its field and transformations computed.
#[derive(Debug)]
pub struct Renderer<'a> {
    prepared: Prepared<'a>,
}

impl<'a> Renderer<'a> {
    /// Makes `scene` ready.
    ///
    /// # Errors
    /// The camera, the size or a number of the scene makes no sense.
    pub fn new(scene: &'a Scene<'a>) -> Result<Self, SceneError> {
        Ok(Self { prepared: Prepared::new(scene)? })
    }

    /// The picture, or `part` of it.
    ///
    /// # Errors
    /// The part is empty or does not lie within the picture, or `progress` cancelled it.
    pub fn render(&self, part: Option<Rectangle>, progress: Progress<'_>) -> Result<Image, RenderError> {
        picture(self.prepared.scene.size, part, progress, |x, y| self.pixel(x, y))
    }

    /// The pixel in column `x` and row `y`, counted from the top left.
    pub fn pixel(&self, x: u32, y: u32) -> PixelResult {
        let Some(path) = self.path(x, y) else { return PixelResult::NOTHING };
        match self.prepared.scene.method {
            Method::Dvr => self.composite(&path),
            Method::Mip | Method::MinIp | Method::Mean | Method::Sum => self.project(&path),
            Method::Isosurface { value, refinement } => self.isosurface(&path, value, refinement),
            Method::Isosurfaces { layers, refinement } => self.isosurfaces(&path, layers, refinement),
            Method::FirstHit(told) => self.first_hit(&path, told),
        }
    }

    /// The isosurface that the ray of a pixel meets; `None` if it meets none or the method is another.
    pub fn surface(&self, x: u32, y: u32) -> Option<SurfaceHit> {
        let Method::Isosurface { value, refinement } = self.prepared.scene.method else { return None };
        self.surface_hit(&self.path(x, y)?, value, refinement)
    }

    /// The way of a pixel's ray through the volume.
    fn path(&self, x: u32, y: u32) -> Option<Path> {
        let passage = self.prepared.passage(x, y)?;
        let line = self.prepared.line(&passage.ray)?;
        let Scene { step, reference_length, jitter: seed, .. } = self.prepared.scene;
        let length = self.prepared.length(&line);
        let distance = |parameter: f64| (parameter - line.from) / (line.to - line.from) * length;
        let lattice = Lattice {
            step: step / reference_length,
            shift: seed.map_or(0.0, |seed| jitter(x, y, seed)),
            from: distance(passage.segment.from),
            to: distance(passage.segment.to),
        };
        // None: a corner grazed so closely that the length underflows.
        (lattice.from < lattice.to).then_some(Path { ray: passage.ray, line, length, lattice })
    }

    /// The samples of a ray at which the field has a value.
    fn samples<'p>(&'p self, path: &'p Path) -> impl Iterator<Item = LatticeSample> + 'p {
        path.lattice.samples().filter(|sample| !self.in_gap(path, sample.position))
    }

    /// Whether the field has no value at a `position` on a ray.
    fn in_gap(&self, path: &Path, position: f64) -> bool {
        self.prepared.field.in_gap(path.texture(position))
    }

    /// The field at a `position` on a ray, in data units.
    fn value(&self, path: &Path, position: f64) -> f64 {
        self.prepared.field.at_texture(path.texture(position))
    }
}

/// The way of a ray through the volume and the samples on it. Positions are distances in reference lengths from where the line
/// of the ray enters the box of the whole volume, whatever part of it is shown.
struct Path {
    ray: Ray,
    /// The line of the ray through the whole volume, before the eye, too; texture coordinates.
    line: Segment,
    /// Length of the line in reference lengths.
    length: f64,
    lattice: Lattice,
}

impl Path {
    /// Texture coordinates at a position.
    fn texture(&self, position: f64) -> DVec3 {
        self.line.at(position / self.length)
    }

    /// View depth in world units at a position.
    fn depth(&self, position: f64) -> f64 {
        self.line.parameter_at(position / self.length)
    }
}
