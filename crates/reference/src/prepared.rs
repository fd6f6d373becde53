//! What every renderer of a scene needs before its first ray.

use crate::camera::View;
use crate::classification::Functions;
use crate::field::Field;
use crate::image::PixelResult;
use crate::ray::{AxisBox, Ray, Segment};
use crate::scene::{FirstHit, Method, Scene, SceneError};
use glam::{DAffine3, DMat3, DVec3};

/// A point of an isosurface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceHit {
    /// Where, in texture coordinates.
    pub texture: DVec3,
    /// Where, in world space.
    pub world: DVec3,
    /// Unit normal in world space, towards smaller values; zero where the field is flat.
    pub normal: DVec3,
    /// View depth in world units.
    pub depth: f64,
}

/// A scene made ready: checked, with its field, transfer functions and transformations computed.
#[derive(Debug)]
pub(crate) struct Prepared<'a> {
    pub(crate) scene: &'a Scene<'a>,
    pub(crate) field: Field,
    pub(crate) functions: Functions,
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

/// The way of a pixel's ray through the volume.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Passage {
    pub(crate) ray: Ray,
    /// In texture coordinates.
    pub(crate) segment: Segment,
    /// Length in reference lengths.
    pub(crate) length: f64,
}

impl<'a> Prepared<'a> {
    pub(crate) fn new(scene: &'a Scene<'a>) -> Result<Self, SceneError> {
        scene.check()?;
        let view = scene.camera.view(scene.size)?;
        let texture_to_world = scene.volume.texture_to_world();
        Ok(Self {
            field: Field::new(scene.volume, scene.channel, scene.sampling),
            functions: Functions::new(&scene.classification),
            bounds: AxisBox::UNIT.intersection(&scene.clip),
            texture_to_world,
            world_to_texture: texture_to_world.inverse(),
            gradient_to_world: scene.volume.index_to_world.matrix3.inverse().transpose(),
            mean_spacing: scene.volume.mean_spacing(),
            towards_light: scene.shading.map_or(DVec3::ZERO, |shading| shading.towards_light(&view)),
            view,
            scene,
        })
    }

    /// The way of the ray of the pixel in column `x` and row `y`; `None` if it passes the volume by.
    pub(crate) fn passage(&self, x: u32, y: u32) -> Option<Passage> {
        let ray = self.view.ray(x, y);
        let segment = self.bounds.clip(&ray.transformed(&self.world_to_texture))?;
        Some(Passage { ray, segment, length: self.length(&segment) })
    }

    /// The line of a ray, extended beyond its start, within the box of the whole volume.
    pub(crate) fn line(&self, ray: &Ray) -> Option<Segment> {
        let line = Ray { start: f64::NEG_INFINITY, ..*ray };
        AxisBox::UNIT.clip(&line.transformed(&self.world_to_texture))
    }

    /// Length of a segment in reference lengths.
    pub(crate) fn length(&self, segment: &Segment) -> f64 {
        let world = self.texture_to_world.transform_vector3(segment.exit - segment.entry);
        world.length() / self.scene.reference_length
    }

    /// The surface at texture coordinates on a ray.
    pub(crate) fn surface_at(&self, texture: DVec3, depth: f64) -> SurfaceHit {
        let world = self.texture_to_world.transform_point3(texture);
        SurfaceHit { texture, world, normal: self.normal(self.gradient(texture)), depth }
    }

    /// The surface that the ray of a pixel meets at a view depth.
    pub(crate) fn surface_seen(&self, x: u32, y: u32, depth: f64) -> SurfaceHit {
        let world = self.view.ray(x, y).at(depth);
        self.surface_at(self.world_to_texture.transform_point3(world), depth)
    }

    /// What is told of a hit at texture coordinates on a ray.
    pub(crate) fn told(&self, told: FirstHit, texture: DVec3, depth: f64) -> PixelResult {
        let [r, g, b] = match told {
            FirstHit::Depth => [depth; 3],
            FirstHit::Point => texture.to_array(),
            FirstHit::Normal => (0.5 + 0.5 * self.normal(self.gradient(texture))).to_array(),
        };
        PixelResult { color: [r, g, b, 1.0], depth }
    }

    /// Straight `color` at texture coordinates, lit as the scene asks for.
    pub(crate) fn lit(&self, color: [f64; 3], texture: DVec3, ray: &Ray) -> [f64; 3] {
        let Some(shading) = &self.scene.shading else { return color };
        let gradient = self.gradient(texture);
        let steepness = (self.gradient_to_world * gradient).length() * self.mean_spacing;
        // A range of no width has no gradient either.
        let width = self.field.range().width();
        let weight = if width > 0.0 { shading.weight(steepness / width) } else { 0.0 };
        if weight == 0.0 {
            return color;
        }
        let viewer = -ray.direction.normalize();
        let surface = matches!(self.scene.method, Method::Isosurface { .. } | Method::Isosurfaces { .. });
        let facing = if surface { viewer } else { self.towards_light };
        let lit = shading.light(color, self.normal(gradient), facing, self.towards_light, viewer);
        [0, 1, 2].map(|i| color[i] + weight * (lit[i] - color[i]))
    }

    /// Gradient in data units per voxel along each voxel axis.
    fn gradient(&self, texture: DVec3) -> DVec3 {
        self.scene.gradient.gradient(&self.field, self.field.texture_to_index(texture))
    }

    /// Unit world normal of a gradient per voxel, towards smaller values; zero if there is none.
    fn normal(&self, gradient: DVec3) -> DVec3 {
        -(self.gradient_to_world * gradient).normalize_or_zero()
    }
}
