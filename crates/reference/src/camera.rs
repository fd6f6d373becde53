//! Cameras and the rays through their pixels.

use crate::ray::Ray;
use crate::scene::SceneError;
use glam::{DMat3, DVec3};

/// How a camera maps the world to its picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Rays spread from the eye.
    Perspective {
        /// Vertical angle of the whole view in degrees, between 0 and 180 exclusive.
        fov_degrees: f64,
    },
    /// Rays run parallel to the viewing direction.
    Orthographic {
        /// Height of the view in world units, positive.
        height: f64,
    },
}

/// Where the picture is taken from. All lengths are world units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Position of the eye.
    pub eye: DVec3,
    /// Point at the centre of the picture.
    pub focus: DVec3,
    /// Direction that points up in the picture; any length, not parallel to the viewing direction.
    pub up: DVec3,
    /// Perspective or orthographic.
    pub projection: Projection,
    /// View depth at which rays begin. `None`: at the eye for a perspective view, without limit for an orthographic one, whose
    /// eye only says where the picture is centred.
    pub near: Option<f64>,
}

impl Camera {
    /// A perspective camera without near plane; up is +y.
    pub fn perspective(eye: DVec3, focus: DVec3, fov_degrees: f64) -> Self {
        let projection = Projection::Perspective { fov_degrees };
        Self { eye, focus, up: DVec3::Y, projection, near: None }
    }

    /// An orthographic camera without near plane; up is +y.
    pub fn orthographic(eye: DVec3, focus: DVec3, height: f64) -> Self {
        let projection = Projection::Orthographic { height };
        Self { eye, focus, up: DVec3::Y, projection, near: None }
    }

    /// The rays of this camera for a picture of `size` pixels, width and height.
    ///
    /// # Errors
    /// The camera has no viewing direction, no upright, or a view of no or infinite extent.
    pub fn view(&self, size: [u32; 2]) -> Result<View, SceneError> {
        let invalid = |problem: &'static str| Err(SceneError::Camera { problem });
        if ![self.eye, self.focus, self.up].iter().all(|v| v.is_finite()) {
            return invalid("eye, focus and up must be finite numbers");
        }
        let Some(forward) = (self.focus - self.eye).try_normalize() else {
            return invalid("the eye and the focus must be different points");
        };
        let Some(right) = self.up.try_normalize().and_then(|up| forward.cross(up).try_normalize()) else {
            return invalid("up must not be zero or parallel to the viewing direction");
        };
        let half_height = match self.projection {
            Projection::Perspective { fov_degrees } if fov_degrees > 0.0 && fov_degrees < 180.0 => {
                (0.5 * fov_degrees.to_radians()).tan()
            }
            Projection::Perspective { .. } => return invalid("the field of view must lie between 0 and 180 degrees"),
            Projection::Orthographic { height } if height > 0.0 && height.is_finite() => 0.5 * height,
            Projection::Orthographic { .. } => return invalid("the orthographic height must be positive and finite"),
        };
        let default_near = match self.projection {
            Projection::Perspective { .. } => 0.0,
            Projection::Orthographic { .. } => f64::NEG_INFINITY,
        };
        let near = self.near.unwrap_or(default_near);
        if near.is_nan() {
            return invalid("the near distance must be a number");
        }
        let axes = DMat3::from_cols(right, right.cross(forward), -forward);
        Ok(View { camera: *self, axes, half_height, near, size: size.map(f64::from) })
    }
}

/// A camera made ready for a picture of a certain size.
#[derive(Debug, Clone, Copy)]
pub struct View {
    camera: Camera,
    axes: DMat3,
    half_height: f64,
    near: f64,
    size: [f64; 2],
}

impl View {
    /// The ray through the centre of the pixel in column `x` from the left and row `y` from the top.
    ///
    /// Its direction advances by one unit of view depth per unit of the ray parameter.
    pub fn ray(&self, x: u32, y: u32) -> Ray {
        let [width, height] = self.size;
        // Offsets from the centre of the picture, in half heights.
        let right = (2.0 * (f64::from(x) + 0.5) - width) / height;
        let up = (height - 2.0 * (f64::from(y) + 0.5)) / height;
        let offset = self.half_height * (right * self.axes.x_axis + up * self.axes.y_axis);
        let forward = -self.axes.z_axis;
        let (origin, direction) = match self.camera.projection {
            Projection::Perspective { .. } => (self.camera.eye, forward + offset),
            Projection::Orthographic { .. } => (self.camera.eye + offset, forward),
        };
        Ray { origin, direction, start: self.near }
    }

    /// World vector of a vector in camera space (x right, y up, z towards the viewer).
    pub fn camera_to_world(&self, vector: DVec3) -> DVec3 {
        self.axes * vector
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_run_right_and_down() -> Result<(), SceneError> {
        let view = Camera::perspective(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO, 90.0).view([4, 2])?;
        assert!(view.ray(0, 0).direction.abs_diff_eq(DVec3::new(-1.5, 0.5, -1.0), 1e-15));
        assert!(view.ray(3, 1).direction.abs_diff_eq(DVec3::new(1.5, -0.5, -1.0), 1e-15));
        let view = Camera::orthographic(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO, 2.0).view([4, 2])?;
        assert!(view.ray(0, 0).origin.abs_diff_eq(DVec3::new(-1.5, 0.5, 5.0), 1e-15));
        assert_eq!(view.ray(0, 0).start, f64::NEG_INFINITY);
        assert!(view.camera_to_world(DVec3::Z).abs_diff_eq(DVec3::Z, 1e-15));
        Ok(())
    }

    #[test]
    fn senseless_cameras_are_refused() {
        let good = Camera::perspective(DVec3::Z, DVec3::ZERO, 30.0);
        for bad in [
            Camera { focus: DVec3::Z, ..good },
            Camera { up: DVec3::Z, ..good },
            Camera { up: DVec3::ZERO, ..good },
            Camera { eye: DVec3::NAN, ..good },
            Camera { near: Some(f64::NAN), ..good },
            Camera::perspective(DVec3::Z, DVec3::ZERO, 180.0),
            Camera::orthographic(DVec3::Z, DVec3::ZERO, 0.0),
        ] {
            assert!(matches!(bad.view([1, 1]), Err(SceneError::Camera { .. })), "{bad:?}");
        }
    }
}
