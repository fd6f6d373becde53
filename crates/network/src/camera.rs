//! The camera: where the eye is, where it looks and how it projects. All lengths are in world units.

use glam::{DMat4, DVec3};
use serde_json::{Value as Json, json};
use thiserror::Error;

use crate::json::{Node, ValueError};

/// How far from parallel `up` must be: the smallest sine of its angle to the viewing direction.
const MIN_UP_SINE: f64 = 1e-6;

/// A camera in world coordinates. It may hold anything; [`Camera::validate`] says whether it can form an image.
///
/// JSON: `{"position":[x,y,z],"focus":[x,y,z],"up":[x,y,z],"fov_degrees":30}` or `"orthographic_height":200` in place of
/// `fov_degrees`, and optionally `"near"`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The eye, world units.
    pub position: [f64; 3],
    /// The point looked at, world units; the centre of the picture and of orbiting.
    pub focus: [f64; 3],
    /// A direction that points up in the picture; need be neither normalised nor perpendicular to the view.
    pub up: [f64; 3],
    /// Perspective or orthographic.
    pub projection: Projection,
    /// Distance along the viewing direction before which nothing is drawn, world units; `None` leaves it to the renderer.
    pub near: Option<f64>,
}

/// How a camera projects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Rays meet at the eye.
    Perspective {
        /// Full vertical field of view, degrees, above 0 and below 180.
        fov_degrees: f64,
    },
    /// Rays are parallel.
    Orthographic {
        /// Height of the picture, world units, above 0.
        height: f64,
    },
}

/// Why a camera cannot form an image.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CameraError {
    /// A coordinate is NaN or infinite.
    #[error("the camera's {0} has a coordinate that is not a finite number; give three finite numbers")]
    NotFinite(&'static str),
    /// Eye and focus are the same point.
    #[error("the camera's position and focus are the same point, so it looks nowhere; move one of them")]
    ZeroDistance,
    /// `up` is zero or parallel to the viewing direction.
    #[error("the camera's up direction is zero or parallel to the viewing direction; turn it aside")]
    UpParallel,
    /// The field of view is not between 0 and 180 degrees.
    #[error("the camera's field of view is {0} degrees; it must be above 0 and below 180")]
    Fov(f64),
    /// The orthographic height is not positive and finite.
    #[error("the camera's orthographic height is {0}; it must be a positive number of world units")]
    Height(f64),
    /// The near distance is negative or not finite.
    #[error("the camera's near distance is {0}; it must be 0 or a positive number of world units")]
    Near(f64),
}

impl CameraError {
    /// The JSON field that is to blame.
    fn field(&self) -> &'static str {
        match self {
            Self::NotFinite(field) => field,
            Self::ZeroDistance => "position",
            Self::UpParallel => "up",
            Self::Fov(_) => "fov_degrees",
            Self::Height(_) => "orthographic_height",
            Self::Near(_) => "near",
        }
    }
}

impl Default for Camera {
    /// Looks at the origin along +y from 400 world units away, x to the right and z up, 30 degrees.
    fn default() -> Self {
        Self {
            position: [0.0, -400.0, 0.0],
            focus: [0.0; 3],
            up: [0.0, 0.0, 1.0],
            projection: Projection::Perspective { fov_degrees: 30.0 },
            near: None,
        }
    }
}

impl Camera {
    /// Checks that the camera can form an image.
    ///
    /// # Errors
    /// Names the first thing that is wrong: a coordinate that is not finite, no viewing direction, `up` along it, a field of
    /// view outside (0, 180), a height that is not positive, a negative near distance.
    pub fn validate(&self) -> Result<(), CameraError> {
        for (name, v) in [("position", self.position), ("focus", self.focus), ("up", self.up)] {
            if !v.iter().all(|x| x.is_finite()) {
                return Err(CameraError::NotFinite(name));
            }
        }
        let forward =
            direction(DVec3::from(self.focus) - DVec3::from(self.position)).ok_or(CameraError::ZeroDistance)?;
        let up = direction(self.up.into()).ok_or(CameraError::UpParallel)?;
        if forward.cross(up).length() < MIN_UP_SINE {
            return Err(CameraError::UpParallel);
        }
        match self.projection {
            Projection::Perspective { fov_degrees: fov } if !(fov > 0.0 && fov < 180.0) => Err(CameraError::Fov(fov)),
            Projection::Orthographic { height } if !(height > 0.0 && height.is_finite()) => {
                Err(CameraError::Height(height))
            }
            _ => match self.near {
                Some(near) if !(near >= 0.0 && near.is_finite()) => Err(CameraError::Near(near)),
                _ => Ok(()),
            },
        }
    }

    /// Orthonormal right, up and forward directions in world coordinates, each of length 1 for a valid camera.
    pub fn basis(&self) -> [DVec3; 3] {
        let forward = direction(DVec3::from(self.focus) - DVec3::from(self.position)).unwrap_or(DVec3::NEG_Z);
        let up = direction(self.up.into()).unwrap_or(DVec3::Y);
        let right = direction(forward.cross(up)).unwrap_or_else(|| forward.any_orthonormal_vector());
        [right, right.cross(forward), forward]
    }

    /// World to camera coordinates: x right, y up, the camera looks along -z.
    pub fn view_matrix(&self) -> DMat4 {
        let [right, up, forward] = self.basis();
        let axes = DMat4::from_cols(right.extend(0.0), up.extend(0.0), (-forward).extend(0.0), glam::DVec4::W);
        axes.transpose() * DMat4::from_translation(-DVec3::from(self.position))
    }

    /// Distance from eye to focus, world units.
    pub fn distance(&self) -> f64 {
        DVec3::from(self.focus).distance(self.position.into())
    }

    /// Turns the eye around the focus: `yaw` to the right and `pitch` upwards, radians. `up` turns along, so nothing flips.
    pub fn orbit(&mut self, yaw: f64, pitch: f64) {
        let [right, up, _] = self.basis();
        let turn = glam::DQuat::from_axis_angle(up, yaw) * glam::DQuat::from_axis_angle(right, -pitch);
        let focus = DVec3::from(self.focus);
        self.position = (focus + turn * (DVec3::from(self.position) - focus)).into();
        self.up = (turn * up).into();
    }

    /// Scales the distance to the focus (perspective) or the height (orthographic) by `factor`, which should be positive.
    pub fn zoom(&mut self, factor: f64) {
        self.zoom_about(self.focus, factor);
    }

    /// Like [`Camera::zoom`], but around a world point, which stays where it is seen: focus and eye move to it or away from it.
    pub fn zoom_about(&mut self, point: [f64; 3], factor: f64) {
        if let Projection::Orthographic { height } = &mut self.projection {
            *height *= factor;
        }
        let point = DVec3::from(point);
        let scaled = |at: [f64; 3]| (point + (DVec3::from(at) - point) * factor).into();
        (self.position, self.focus) = (scaled(self.position), scaled(self.focus));
    }

    /// Moves eye and focus by `right` and `up`, world units, parallel to the picture.
    pub fn pan(&mut self, right: f64, up: f64) {
        let [r, u, _] = self.basis();
        let shift = r * right + u * up;
        self.position = (DVec3::from(self.position) + shift).into();
        self.focus = (DVec3::from(self.focus) + shift).into();
    }

    /// The same view direction, focused on `center` and backed off so that a sphere of `radius` world units fits the height.
    #[must_use]
    pub fn framing(&self, center: [f64; 3], radius: f64) -> Self {
        let [_, _, forward] = self.basis();
        let radius = radius.max(f64::MIN_POSITIVE);
        let (distance, projection) = match self.projection {
            Projection::Perspective { fov_degrees } => {
                (radius / (fov_degrees.to_radians() / 2.0).sin(), self.projection)
            }
            Projection::Orthographic { .. } => (2.0 * radius, Projection::Orthographic { height: 2.0 * radius }),
        };
        Self { position: (DVec3::from(center) - forward * distance).into(), focus: center, projection, ..*self }
    }

    /// The JSON form (see the type).
    pub fn to_json(&self) -> Json {
        let mut json = json!({"position": self.position, "focus": self.focus, "up": self.up});
        match self.projection {
            Projection::Perspective { fov_degrees } => json["fov_degrees"] = fov_degrees.into(),
            Projection::Orthographic { height } => json["orthographic_height"] = height.into(),
        }
        if let Some(near) = self.near {
            json["near"] = near.into();
        }
        json
    }

    /// Reads the JSON form; the camera is valid.
    pub(crate) fn from_node(node: &Node<'_>) -> Result<Self, ValueError> {
        node.only(&["position", "focus", "up", "fov_degrees", "orthographic_height", "near"])?;
        let triple = |name| node.required(name, "an array of 3 numbers")?.triple();
        let projection = match (node.field("fov_degrees")?, node.field("orthographic_height")?) {
            (Some(fov), None) => Projection::Perspective { fov_degrees: fov.f64()? },
            (None, Some(height)) => Projection::Orthographic { height: height.f64()? },
            (Some(_), Some(_)) => {
                return Err(node.error("both `fov_degrees` and `orthographic_height`", "one of them"));
            }
            (None, None) => {
                return Err(node.error("neither `fov_degrees` nor `orthographic_height`", "one of them"));
            }
        };
        let near = node.field("near")?.map(|near| near.f64()).transpose()?;
        let camera =
            Self { position: triple("position")?, focus: triple("focus")?, up: triple("up")?, projection, near };
        camera.check().map_err(|error| error.within(&node.path))?;
        Ok(camera)
    }

    /// [`Camera::validate`] with the JSON field named.
    pub(crate) fn check(&self) -> Result<(), ValueError> {
        self.validate().map_err(|e| {
            ValueError::new(format!("a camera that forms no image ({e})"), "a valid camera").within(e.field())
        })
    }
}

/// `v` with length 1; `None` for a zero vector and for one whose length overflows or underflows.
fn direction(v: DVec3) -> Option<DVec3> {
    // Scaling by the largest coordinate first keeps tiny and huge vectors apart from zero and infinity.
    let largest = v.abs().max_element();
    if largest > 0.0 && largest.is_finite() { (v / largest).try_normalize() } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(change: impl FnOnce(&mut Camera)) -> String {
        let mut camera = Camera::default();
        change(&mut camera);
        camera.validate().expect_err("must be refused").to_string()
    }

    #[test]
    fn cameras_that_form_no_image_are_refused() {
        assert_eq!(Camera::default().validate(), Ok(()));
        insta::assert_snapshot!(refusal(|c| c.position = c.focus), @"the camera's position and focus are the same point, so it looks nowhere; move one of them");
        insta::assert_snapshot!(refusal(|c| c.up = [0.0, 3.0, 0.0]), @"the camera's up direction is zero or parallel to the viewing direction; turn it aside");
        insta::assert_snapshot!(refusal(|c| c.up = [0.0; 3]), @"the camera's up direction is zero or parallel to the viewing direction; turn it aside");
        insta::assert_snapshot!(refusal(|c| c.focus[1] = f64::NAN), @"the camera's focus has a coordinate that is not a finite number; give three finite numbers");
        for fov in [0.0, 180.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(refusal(|c| c.projection = Projection::Perspective { fov_degrees: fov }).contains("field of view"));
        }
        for height in [0.0, f64::NAN, f64::INFINITY] {
            assert!(refusal(|c| c.projection = Projection::Orthographic { height }).contains("orthographic height"));
        }
        assert!(refusal(|c| c.near = Some(-1.0)).contains("near distance"));
    }

    #[test]
    fn tiny_and_huge_scenes_are_valid() {
        for scale in [1e-200, 1e-9, 1e9, 1e200] {
            let camera = Camera { position: [0.0, -scale, 0.0], ..Camera::default() };
            assert_eq!(camera.validate(), Ok(()), "{scale}");
        }
    }

    #[test]
    fn the_view_matrix_puts_the_focus_on_the_negative_z_axis() {
        let camera = Camera { position: [3.0, -2.0, 5.0], focus: [1.0, 1.0, 1.0], ..Camera::default() };
        let seen = camera.view_matrix().transform_point3(camera.focus.into());
        assert!(seen.distance(DVec3::new(0.0, 0.0, -camera.distance())) < 1e-12);
        let [right, up, forward] = camera.basis();
        assert!(right.cross(up).distance(-forward) < 1e-12);
    }

    #[test]
    fn orbiting_past_the_pole_keeps_distance_and_validity() {
        let mut camera = Camera::default();
        for _ in 0..100 {
            camera.orbit(0.3, 0.4);
            assert_eq!(camera.validate(), Ok(()));
        }
        assert!((camera.distance() - 400.0).abs() < 1e-9);
    }
}
