//! The samples of the GPU ray loop, in float64.
//!
//! Every pixel is independent of the others: any [`Rectangle`] of a picture equals the same part of the whole, bit by bit.

mod composite;
mod isosurface;
mod lattice;
mod project;

pub use isosurface::SurfaceHit;
pub use lattice::{Lattice, LatticeSample};

use crate::camera::View;
use crate::field::Field;
use crate::image::{Image, PixelResult, Rectangle};
use crate::ray::{AxisBox, Ray, Segment};
use crate::scene::{Method, Scene, SceneError};
use glam::{DAffine3, DMat3, DVec3};
use rayon::prelude::*;

/// Renders the whole picture of a scene.
///
/// # Errors
/// The camera, the size or a number of the scene makes no sense.
pub fn render(scene: &Scene<'_>) -> Result<Image, SceneError> {
    Ok(Renderer::new(scene)?.render())
}

/// A scene made ready to be rendered: checked, with its field and transformations computed.
#[derive(Debug)]
pub struct Renderer<'a> {
    scene: &'a Scene<'a>,
    field: Field,
    view: View,
    bounds: AxisBox,
    texture_to_world: DAffine3,
    world_to_texture: DAffine3,
    /// Takes gradients per voxel to gradients per world unit.
    gradient_to_world: DMat3,
    /// Edge of a cube as large as a voxel, world units.
    mean_spacing: f64,
    towards_light: DVec3,
}

impl<'a> Renderer<'a> {
    /// Makes `scene` ready.
    ///
    /// # Errors
    /// The camera, the size or a number of the scene makes no sense.
    pub fn new(scene: &'a Scene<'a>) -> Result<Self, SceneError> {
        scene.check()?;
        let view = scene.camera.view(scene.size)?;
        let texture_to_world = scene.volume.texture_to_world();
        Ok(Self {
            field: Field::new(scene.volume, scene.channel, scene.sampling),
            bounds: AxisBox::UNIT.intersection(&scene.clip),
            texture_to_world,
            world_to_texture: texture_to_world.inverse(),
            gradient_to_world: scene.volume.index_to_world.matrix3.inverse().transpose(),
            mean_spacing: scene.volume.index_to_world.matrix3.determinant().abs().cbrt(),
            towards_light: scene.shading.map_or(DVec3::ZERO, |shading| shading.towards_light(&view)),
            view,
            scene,
        })
    }

    /// The whole picture.
    pub fn render(&self) -> Image {
        let [width, height] = self.scene.size;
        self.pixels(Rectangle { x: 0, y: 0, width, height })
    }

    /// Part of the picture.
    ///
    /// # Errors
    /// The rectangle is empty or does not lie within the picture.
    pub fn render_rectangle(&self, rectangle: Rectangle) -> Result<Image, SceneError> {
        let size = self.scene.size;
        let fits = |start: u32, count: u32, limit: u32| count > 0 && start < limit && count <= limit - start;
        if fits(rectangle.x, rectangle.width, size[0]) && fits(rectangle.y, rectangle.height, size[1]) {
            Ok(self.pixels(rectangle))
        } else {
            Err(SceneError::Rectangle { found: rectangle, size })
        }
    }

    fn pixels(&self, Rectangle { x, y, width, height }: Rectangle) -> Image {
        let (color, depth) = (0..height)
            .into_par_iter()
            .flat_map(|row| (0..width).into_par_iter().map(move |column| (x + column, y + row)))
            .map(|(column, row)| self.pixel(column, row))
            .map(|result| (result.color, result.depth))
            .unzip();
        Image { size: [width, height], color, depth }
    }

    /// The pixel in column `x` and row `y`, counted from the top left.
    pub fn pixel(&self, x: u32, y: u32) -> PixelResult {
        let Some(path) = self.path(x, y) else { return PixelResult::NOTHING };
        match self.scene.method {
            Method::Dvr => self.composite(&path),
            Method::Mip | Method::MinIp | Method::Mean | Method::Sum => self.project(&path),
            Method::Isosurface { value, refinement } => self.isosurface(&path, value, refinement),
        }
    }

    /// The isosurface that the ray of a pixel meets; `None` if it meets none or the method is another.
    pub fn surface(&self, x: u32, y: u32) -> Option<SurfaceHit> {
        let Method::Isosurface { value, refinement } = self.scene.method else { return None };
        self.surface_hit(&self.path(x, y)?, value, refinement)
    }

    /// The way of a pixel's ray through the volume.
    fn path(&self, x: u32, y: u32) -> Option<Path> {
        let ray = self.view.ray(x, y);
        let segment = self.bounds.clip(&ray.transformed(&self.world_to_texture))?;
        let span = segment.exit - segment.entry;
        let lattice = Lattice::new((span * self.field.dims().as_dvec3()).length(), self.scene.rate);
        if lattice.length == 0.0 {
            // A corner grazed so closely that the length underflows.
            return None;
        }
        let world_length = self.texture_to_world.transform_vector3(span).length();
        let step = world_length / lattice.length / self.scene.reference_length;
        Some(Path { ray, segment, lattice, step })
    }

    /// The field at `position` steps from the entry, in data units.
    fn value(&self, path: &Path, position: f64) -> f64 {
        self.field.at_texture(path.texture(position))
    }

    /// Straight `color` at texture coordinates, lit as the scene asks for.
    fn lit(&self, color: [f64; 3], texture: DVec3, ray: &Ray) -> [f64; 3] {
        let Some(shading) = &self.scene.shading else { return color };
        let gradient = self.scene.gradient.gradient(&self.field, self.field.texture_to_index(texture));
        let steepness = (self.gradient_to_world * gradient).length() * self.mean_spacing;
        // A range of no width has no gradient either.
        let width = self.field.range().width();
        let weight = if width > 0.0 { shading.weight(steepness / width) } else { 0.0 };
        if weight == 0.0 {
            return color;
        }
        let lit = shading.light(color, self.normal(gradient), self.towards_light, -ray.direction.normalize());
        [0, 1, 2].map(|i| color[i] + weight * (lit[i] - color[i]))
    }

    /// Unit world normal of a gradient per voxel, towards smaller values; zero if there is none.
    fn normal(&self, gradient: DVec3) -> DVec3 {
        -(self.gradient_to_world * gradient).normalize_or_zero()
    }
}

/// The way of a ray through the volume and the samples on it.
struct Path {
    ray: Ray,
    segment: Segment,
    lattice: Lattice,
    /// One step in reference lengths.
    step: f64,
}

impl Path {
    /// Texture coordinates at `position` steps from the entry.
    fn texture(&self, position: f64) -> DVec3 {
        self.segment.at(position / self.lattice.length)
    }

    /// View depth in world units at `position` steps from the entry.
    fn depth(&self, position: f64) -> f64 {
        self.segment.parameter_at(position / self.lattice.length)
    }
}
