//! Local illumination from the gradient of the field.

use crate::camera::View;
use glam::DVec3;

/// The space in which the direction of a light is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LightSpace {
    /// Fixed to the camera: x right, y up, z towards the viewer.
    Camera,
    /// Fixed to the world.
    World,
}

/// Blinn-Phong lighting by one distant light.
///
/// With the unit normal `n`, the unit vector `l` towards the light and `h` halfway between it and the viewer, a straight
/// colour `c` becomes `c (ambient + diffuse max(n·l, 0)) + specular max(n·h, 0)^shininess`. A side that the light does not reach
/// (`n·l <= 0`) has no highlight either, wherever the half-way vector points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlinnPhong {
    /// Share of the colour that needs no light.
    pub ambient: f64,
    /// Share of the colour under perpendicular light.
    pub diffuse: f64,
    /// Strength of the highlight.
    pub specular: f64,
    /// Exponent of the highlight.
    pub shininess: f64,
    /// Direction towards the light, of any length.
    pub light_direction: DVec3,
    /// The space of `light_direction`.
    pub light_space: LightSpace,
    /// Colour of the light; multiplies the diffuse and the specular term.
    pub light_color: [f64; 3],
    /// Whether normals are turned around that point away: those of surfaces from the viewer, who sees the front; those of media,
    /// which have none, from the light. Turned to the viewer they would jump, inside of what a ray integrates, where they are
    /// seen edge-on.
    pub two_sided: bool,
    /// Gradient magnitude in world space, in shares of the value range per mean voxel spacing (the edge of a cube as large as
    /// a voxel), at which the colour is half lit; weaker gradients, whose direction is mostly noise, fade to the unlit colour.
    /// Zero lights every gradient but none.
    pub gradient_fade: f64,
}

impl Default for BlinnPhong {
    /// A white light from the upper right behind the viewer, two-sided, without fading.
    fn default() -> Self {
        Self {
            ambient: 0.2,
            diffuse: 0.8,
            specular: 0.3,
            shininess: 32.0,
            light_direction: DVec3::new(0.3, 0.4, 1.0),
            light_space: LightSpace::Camera,
            light_color: [1.0; 3],
            two_sided: true,
            gradient_fade: 0.0,
        }
    }
}

impl BlinnPhong {
    /// Unit vector towards the light in world space.
    pub fn towards_light(&self, view: &View) -> DVec3 {
        let direction = match self.light_space {
            LightSpace::Camera => view.camera_to_world(self.light_direction),
            LightSpace::World => self.light_direction,
        };
        direction.normalize_or_zero()
    }

    /// The lit straight colour of material of colour `color` with unit `normal`, which two-sided lighting turns to the side of
    /// `facing`; all vectors unit and in world space.
    pub fn light(
        &self,
        color: [f64; 3],
        normal: DVec3,
        facing: DVec3,
        towards_light: DVec3,
        towards_viewer: DVec3,
    ) -> [f64; 3] {
        let flip = self.two_sided && normal.dot(facing) < 0.0;
        let normal = if flip { -normal } else { normal };
        let halfway = (towards_light + towards_viewer).normalize_or_zero();
        let cosine = normal.dot(towards_light).max(0.0);
        let diffuse = self.diffuse * cosine;
        let lobe = normal.dot(halfway).max(0.0).powf(self.shininess);
        let specular = if cosine > 0.0 { self.specular * lobe } else { 0.0 };
        [0, 1, 2].map(|i| color[i] * (self.ambient + diffuse * self.light_color[i]) + specular * self.light_color[i])
    }

    /// How much of the lit colour shows, 0 to 1, for a gradient of `magnitude` in shares of the range per mean voxel spacing.
    pub fn weight(&self, magnitude: f64) -> f64 {
        if magnitude > 0.0 { magnitude / (magnitude + self.gradient_fade) } else { 0.0 }
    }
}
