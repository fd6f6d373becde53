//! Local illumination from the gradient of the field.

use crate::camera::View;
use glam::DVec3;
use std::f64::consts::PI;

/// The space in which the direction of a light is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LightSpace {
    /// Fixed to the camera: x right, y up, z towards the viewer.
    Camera,
    /// Fixed to the world.
    World,
}

/// What light a surface throws back in all directions, in its own colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Diffuse {
    /// The cosine between normal and light (Lambert 1760).
    Lambert,
    /// Flatter, as from clay (Oren and Nayar 1994, their qualitative model).
    OrenNayar {
        /// Standard deviation of the slope angle of the facets, radians.
        roughness: f64,
    },
    /// The cosine rounded up to one of a few steps.
    Toon {
        /// Number of steps, at least 1.
        steps: u32,
    },
}

/// What light a surface mirrors, in the colour of the light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Highlight {
    /// A power of the cosine between normal and half-way vector (Blinn 1977).
    BlinnPhong {
        /// The exponent.
        shininess: f64,
    },
    /// A power of the cosine between mirrored light and viewer (Phong 1975).
    Phong {
        /// The exponent.
        shininess: f64,
    },
    /// Microfacets with Beckmann's distribution and V-grooves (Cook and Torrance 1982) and Schlick's Fresnel term (1994), divided
    /// by `4 n·v`.
    CookTorrance {
        /// Root mean square slope of the facets.
        roughness: f64,
        /// Fresnel reflectance at normal incidence.
        reflectance: f64,
    },
    /// An anisotropic Gaussian (Ward 1992), times the cosine between normal and light. Its first tangent lies across the z axis
    /// of the world or, where the normal is all but along it, across the x axis.
    Ward {
        /// Slope along the first tangent.
        along: f64,
        /// Slope along the second.
        across: f64,
    },
}

/// Lighting by one distant light.
///
/// A straight colour `c` becomes `c (ambient + diffuse D L) + specular H L` with the light's colour `L`, a [`Diffuse`] term `D`
/// and a [`Highlight`] `H`. A side that the light does not reach has neither.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shading {
    /// Share of the colour that needs no light.
    pub ambient: f64,
    /// Strength of the diffuse term.
    pub diffuse: f64,
    /// The diffuse term.
    pub diffuse_term: Diffuse,
    /// Strength of the highlight.
    pub specular: f64,
    /// The highlight.
    pub highlight: Highlight,
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

impl Default for Shading {
    /// Blinn-Phong under a white light from the upper right behind the viewer, two-sided, without fading.
    fn default() -> Self {
        Self {
            ambient: 0.2,
            diffuse: 0.8,
            diffuse_term: Diffuse::Lambert,
            specular: 0.3,
            highlight: Highlight::BlinnPhong { shininess: 32.0 },
            light_direction: DVec3::new(0.3, 0.4, 1.0),
            light_space: LightSpace::Camera,
            light_color: [1.0; 3],
            two_sided: true,
            gradient_fade: 0.0,
        }
    }
}

impl Shading {
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
        let angles = Angles::new(if flip { -normal } else { normal }, towards_light, towards_viewer);
        let diffuse = self.diffuse * self.diffuse_term.strength(&angles);
        let specular = if angles.nl > SLACK { self.specular * self.highlight.strength(&angles) } else { 0.0 };
        [0, 1, 2].map(|i| color[i] * (self.ambient + diffuse * self.light_color[i]) + specular * self.light_color[i])
    }

    /// How much of the lit colour shows, 0 to 1, for a gradient of `magnitude` in shares of the range per mean voxel spacing.
    pub fn weight(&self, magnitude: f64) -> f64 {
        if magnitude > 0.0 { magnitude / (magnitude + self.gradient_fade) } else { 0.0 }
    }
}

/// The directions at a surface, unit vectors in world space, and their cosines.
struct Angles {
    normal: DVec3,
    light: DVec3,
    viewer: DVec3,
    halfway: DVec3,
    /// Normal and light, not negative.
    nl: f64,
    /// Normal and half-way vector.
    nh: f64,
}

impl Angles {
    fn new(normal: DVec3, light: DVec3, viewer: DVec3) -> Self {
        let halfway = (light + viewer).normalize_or_zero();
        Self { normal, light, viewer, halfway, nl: normal.dot(light).clamp(0.0, 1.0), nh: normal.dot(halfway) }
    }

    /// Normal and viewer. Normals of media turn to the light: either side is seen.
    fn nv(&self) -> f64 {
        self.normal.dot(self.viewer).abs().min(1.0)
    }
}

/// Cosines that are divided by are no smaller.
const GRAZING: f64 = 1e-3;

/// By how much a cosine may exceed the end of light, or light a step of [`Diffuse::Toon`], and still not be beyond it: rounding
/// would decide it on flat walls, otherwise at every place.
const SLACK: f64 = 1e-9;

impl Diffuse {
    fn strength(self, angles: &Angles) -> f64 {
        let nl = angles.nl;
        match self {
            Self::Lambert => nl,
            Self::Toon { steps } => (nl * f64::from(steps) - SLACK).ceil().max(0.0) / f64::from(steps),
            Self::OrenNayar { roughness } => {
                let (nv, square) = (angles.nv(), roughness * roughness);
                // Without the normal's share of them, the angle between light and viewer is that around the normal.
                let around = |v: DVec3| (v - angles.normal.dot(v) * angles.normal).normalize_or_zero();
                let azimuth = around(angles.light).dot(around(angles.viewer)).max(0.0);
                let sines = ((1.0 - nl * nl) * (1.0 - nv * nv)).max(0.0).sqrt();
                let even = 1.0 - 0.5 * square / (square + 0.33);
                let rough = 0.45 * square / (square + 0.09) * azimuth * sines / nl.max(nv).max(GRAZING);
                nl * (even + rough)
            }
        }
    }
}

impl Highlight {
    /// On the side that the light reaches.
    fn strength(self, angles: &Angles) -> f64 {
        let Angles { normal, light, viewer, halfway, nl, nh } = *angles;
        match self {
            Self::BlinnPhong { shininess } => nh.max(0.0).powf(shininess),
            Self::Phong { shininess } => (2.0 * nl * normal - light).dot(viewer).max(0.0).powf(shininess),
            Self::CookTorrance { roughness, reflectance } => {
                let (nv, nh) = (angles.nv().max(GRAZING), nh.max(GRAZING));
                let vh = viewer.dot(halfway).max(GRAZING);
                let (slope, nh2) = (roughness * roughness, nh * nh);
                let facets = ((nh2 - 1.0) / (slope * nh2)).exp() / (PI * slope * nh2 * nh2);
                let shadowing = (2.0 * nh * nv.min(nl) / vh).min(1.0);
                let fresnel = reflectance + (1.0 - reflectance) * (1.0 - vh).powi(5);
                facets * shadowing * fresnel / (4.0 * nv)
            }
            Self::Ward { along, across } => {
                let axis = if normal.z.abs() > 0.9 { DVec3::X } else { DVec3::Z };
                let tangent = axis.cross(normal).normalize_or_zero();
                let [x, y] = [halfway.dot(tangent) / along, halfway.dot(normal.cross(tangent)) / across];
                let nh = nh.max(GRAZING);
                let gauss = (-(x * x + y * y) / (nh * nh)).exp() / (4.0 * PI * along * across);
                gauss * (nl / angles.nv().max(GRAZING)).sqrt()
            }
        }
    }
}
