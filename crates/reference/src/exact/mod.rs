//! The picture that a scene stands for, without samples, in float64.
//!
//! Between the cuts of the grid the field along a ray is a polynomial: a cubic for [`Sampling::Trilinear`], of up to ninth
//! degree for the splines. It is taken in Bernstein form from the voxels, not fitted to samples, and its roots and turning
//! points are isolated, so that no crossing is missed:
//!
//! - [`Method::Dvr`] is cut where labels change and where the field passes a knot of the transfer function. A piece of constant
//!   material has a closed form; on the others the extinction is the logarithm of a polynomial, and optical depth and colour
//!   are integrated by collocation of order 16, halved until both are right to [`TOLERANCE`] ([`LIT_TOLERANCE`] under lighting).
//! - [`Method::Mip`] and [`Method::MinIp`] look at turning points and ends of cells, [`Method::Mean`] and [`Method::Sum`] at
//!   the mean of coefficients.
//! - [`Method::Isosurface`] takes the first root, [`Method::Isosurfaces`] all; a ray that touches a surface from outside meets it.
//! - [`Method::FirstHit`] is where the first piece begins that is not transparent.
//!
//! There is nothing to choose: [`Scene::step`], [`Scene::early_termination`] and the refinement of isosurfaces do not apply.
//! Opacity 1 that the transfer function reaches at a single value is a pole of the extinction with a finite integral; only
//! where it is 1 over an interval of values, or a cell is constant, [`rayloom_volume::MAX_EXTINCTION`] applies.
//!
//! [`Sampling::Trilinear`]: crate::field::Sampling::Trilinear

mod bernstein;
mod cells;
mod emission;
mod isosurface;
mod lobatto;
mod medium;
mod project;
mod quadrature;

pub use quadrature::{LIT_TOLERANCE, TOLERANCE};

use crate::image::{Image, PixelResult, Rectangle};
use crate::prepared::{Prepared, SurfaceHit};
use crate::progress::{Progress, RenderError, picture, unattended};
use crate::scene::{Method, Scene, SceneError};

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
        let Some(passage) = self.prepared.passage(x, y) else { return PixelResult::NOTHING };
        match self.prepared.scene.method {
            Method::Dvr => self.emission(&passage),
            Method::Mip | Method::MinIp | Method::Mean | Method::Sum => self.project(&passage),
            Method::Isosurface { value, .. } => self.isosurface(&passage, value),
            Method::Isosurfaces { layers, .. } => self.isosurfaces(&passage, layers),
            Method::FirstHit(told) => self.first_hit(&passage, told),
        }
    }

    /// The isosurface that the ray of a pixel meets; `None` if it meets none or the method is another.
    pub fn surface(&self, x: u32, y: u32) -> Option<SurfaceHit> {
        let Method::Isosurface { value, .. } = self.prepared.scene.method else { return None };
        self.surface_hit(&self.prepared.passage(x, y)?, value)
    }
}
