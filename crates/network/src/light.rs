//! A directional light.

use serde_json::{Value as Json, json};
use thiserror::Error;

use crate::json::{Node, ValueError};

/// A directional light.
///
/// JSON: `{"space":"camera","direction":[x,y,z],"color":[r,g,b]}`, space `camera` or `world`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// The coordinates `direction` is given in.
    pub space: LightSpace,
    /// Points towards the light; any length but zero.
    pub direction: [f64; 3],
    /// Linear red, green and blue, 0 or more.
    pub color: [f64; 3],
}

/// The coordinates of a light's direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightSpace {
    /// Moves with the camera: x right, y up, z towards the viewer.
    Camera,
    /// Stays in the scene: world coordinates.
    World,
}

/// Why a light is refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum LightError {
    /// The direction is zero or not finite.
    #[error("the light's direction is zero or not finite; give three finite numbers, not all zero")]
    Direction,
    /// A colour component is negative or not finite.
    #[error("the light's colour has a component that is negative or not finite; give three numbers from 0 up")]
    Color,
}

impl Default for Light {
    /// A white headlight a little to the right of and above the eye.
    fn default() -> Self {
        Self { space: LightSpace::Camera, direction: [0.3, 0.4, 1.0], color: [1.0; 3] }
    }
}

impl Light {
    /// Checks that the light has a direction and a colour.
    ///
    /// # Errors
    /// A direction that is zero or not finite, a colour component that is negative or not finite.
    pub fn validate(&self) -> Result<(), LightError> {
        if !self.direction.iter().all(|x| x.is_finite()) || self.direction == [0.0; 3] {
            return Err(LightError::Direction);
        }
        if !self.color.iter().all(|c| c.is_finite() && *c >= 0.0) {
            return Err(LightError::Color);
        }
        Ok(())
    }

    /// The JSON form (see the type).
    pub fn to_json(&self) -> Json {
        let space = match self.space {
            LightSpace::Camera => "camera",
            LightSpace::World => "world",
        };
        json!({"space": space, "direction": self.direction, "color": self.color})
    }

    /// Reads the JSON form; the light is valid.
    pub(crate) fn from_node(node: &Node<'_>) -> Result<Self, ValueError> {
        node.only(&["space", "direction", "color"])?;
        let space = node.required("space", "`camera` or `world`")?;
        let light = Self {
            space: match space.string()? {
                "camera" => LightSpace::Camera,
                "world" => LightSpace::World,
                other => return Err(space.error(format!("`{other}`"), "`camera` or `world`")),
            },
            direction: node.required("direction", "an array of 3 numbers")?.triple()?,
            color: node.required("color", "an array of 3 numbers")?.triple()?,
        };
        light.check().map_err(|error| error.within(&node.path))?;
        Ok(light)
    }

    /// [`Light::validate`] with the JSON field named.
    pub(crate) fn check(&self) -> Result<(), ValueError> {
        self.validate().map_err(|e| {
            let field = if e == LightError::Direction { "direction" } else { "color" };
            ValueError::new(format!("an impossible light ({e})"), "a valid light").within(field)
        })
    }
}
