//! Transfer functions of value and gradient magnitude: a sum of simple shapes.

use serde::{Deserialize, Serialize};

use super::one_dimensional::table_value;
use super::{MAX_EXTINCTION, Medium, Rgba, TransferFunctionError, check_extent, check_finite, check_unit, extinction};
use crate::ValueRange;

/// Standard deviations beyond which a Gaussian primitive is exactly zero.
const GAUSSIAN_REACH: f64 = 3.0;

/// Where a primitive covers the plane of value (data units) and gradient magnitude (data units per world unit).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Shape {
    /// An axis-aligned rectangle.
    Rectangle {
        /// From and to, data units.
        value: [f64; 2],
        /// From and to, data units per world unit.
        gradient: [f64; 2],
    },
    /// A triangle with a horizontal base.
    Triangle {
        /// Value and gradient magnitude of the tip.
        apex: [f64; 2],
        /// The values at the two ends of the base.
        base: [f64; 2],
        /// The gradient magnitude of the base; not that of the tip.
        base_gradient: f64,
    },
    /// A Gaussian bell, lowered so that it is exactly zero from three standard deviations on.
    Gaussian {
        /// Value and gradient magnitude of the centre.
        center: [f64; 2],
        /// Standard deviations along value and gradient magnitude; positive.
        sigma: [f64; 2],
    },
}

impl Shape {
    /// How deep a point lies inside: 1 in the middle, falling linearly to 0 at the border, negative outside.
    fn depth(&self, value: f64, magnitude: f64) -> f64 {
        match *self {
            Self::Rectangle { value: v, gradient: g } => depth_between(v, value).min(depth_between(g, magnitude)),
            Self::Triangle { apex, base, base_gradient } => {
                let tip = (magnitude - base_gradient) / (apex[1] - base_gradient);
                // Barycentric: what remains is shared between the ends of the base.
                let along = (value - tip * apex[0] - (1.0 - tip) * base[0]) / (base[1] - base[0]);
                3.0 * tip.min(along).min(1.0 - tip - along)
            }
            Self::Gaussian { center, sigma } => {
                let (v, g) = ((value - center[0]) / sigma[0], (magnitude - center[1]) / sigma[1]);
                let edge = (-0.5 * GAUSSIAN_REACH * GAUSSIAN_REACH).exp();
                ((-0.5 * (v * v + g * g)).exp() - edge) / (1.0 - edge)
            }
        }
    }

    /// The values, data units, outside of which the shape covers nothing.
    fn values(&self) -> [f64; 2] {
        match *self {
            Self::Rectangle { value, .. } => value,
            Self::Triangle { apex, base, .. } => [base[0].min(apex[0]), base[1].max(apex[0])],
            Self::Gaussian { center, sigma } => [-1.0, 1.0].map(|side| center[0] + side * GAUSSIAN_REACH * sigma[0]),
        }
    }

    fn check(&self, index: usize) -> Result<(), TransferFunctionError> {
        match *self {
            Self::Rectangle { value, gradient } => {
                check_extent(|| format!("`value` of primitive {index}"), value)?;
                check_extent(|| format!("`gradient` of primitive {index}"), gradient)
            }
            Self::Triangle { apex, base, base_gradient } => {
                check_finite(|| format!("the value of `apex` of primitive {index}"), apex[0])?;
                check_extent(|| format!("`base` of primitive {index}"), base)?;
                let heights = [base_gradient.min(apex[1]), base_gradient.max(apex[1])];
                check_extent(|| format!("the height (`base_gradient` and `apex`) of primitive {index}"), heights)
            }
            Self::Gaussian { center, sigma } => {
                center.iter().try_for_each(|&c| check_finite(|| format!("`center` of primitive {index}"), c))?;
                sigma.iter().try_for_each(|&s| check_extent(|| format!("`sigma` of primitive {index}"), [0.0, s]))
            }
        }
    }
}

fn depth_between([low, high]: [f64; 2], x: f64) -> f64 {
    1.0 - (2.0 * x - low - high).abs() / (high - low)
}

/// A coloured shape.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Primitive {
    /// Where.
    pub shape: Shape,
    /// Straight red, green, blue; 0 to 1.
    pub color: [f64; 3],
    /// Opacity per reference length where the shape covers fully; 0 to 1.
    pub opacity: f64,
    /// How much of the way from border to middle the opacity takes to rise: 0 is a hard edge, 1 a tent. Gaussians are soft
    /// by themselves and ignore it.
    #[serde(default)]
    pub softness: f64,
}

impl Primitive {
    fn medium(&self, value: f64, magnitude: f64) -> Medium {
        let depth = self.shape.depth(value, magnitude);
        let coverage = match self.shape {
            _ if depth < 0.0 => 0.0,
            Shape::Gaussian { .. } => depth,
            _ if self.softness > 0.0 => (depth / self.softness).min(1.0),
            _ => 1.0,
        };
        Rgba { color: self.color, opacity: self.opacity * coverage }.medium()
    }

    fn check(&self, index: usize) -> Result<(), TransferFunctionError> {
        self.shape.check(index)?;
        for (name, component) in ["red", "green", "blue"].into_iter().zip(self.color) {
            check_unit(|| format!("{name} of primitive {index}"), component)?;
        }
        check_unit(|| format!("the opacity of primitive {index}"), self.opacity)?;
        check_unit(|| format!("the softness of primitive {index}"), self.softness)
    }
}

/// A transfer function over value (data units) and gradient magnitude (data units per world unit).
///
/// Where primitives overlap their media mix: extinctions add up and the colour is the mean weighted by extinction.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Unchecked")]
pub struct TransferFunction2D {
    /// The shapes; their order does not matter. After changing them, [`TransferFunction2D::check`] tells whether they still
    /// make sense.
    pub primitives: Vec<Primitive>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    primitives: Vec<Primitive>,
}

impl TryFrom<Unchecked> for TransferFunction2D {
    type Error = TransferFunctionError;

    fn try_from(unchecked: Unchecked) -> Result<Self, Self::Error> {
        Self::new(unchecked.primitives)
    }
}

impl TransferFunction2D {
    /// A transfer function of these primitives.
    ///
    /// # Errors
    /// See [`TransferFunction2D::check`].
    pub fn new(primitives: Vec<Primitive>) -> Result<Self, TransferFunctionError> {
        let function = Self { primitives };
        function.check()?;
        Ok(function)
    }

    /// Checks that every number is finite, every shape has an area, and colours, opacities and softness lie between 0 and 1.
    ///
    /// # Errors
    /// The first thing that is wrong, with the number of its primitive.
    pub fn check(&self) -> Result<(), TransferFunctionError> {
        self.primitives.iter().enumerate().try_for_each(|(index, primitive)| primitive.check(index))
    }

    /// Emission and extinction per reference length at a value and a gradient magnitude.
    pub fn medium(&self, value: f64, magnitude: f64) -> Medium {
        let mut sum = Medium::default();
        for primitive in &self.primitives {
            let medium = primitive.medium(value, magnitude);
            sum.extinction += medium.extinction;
            (0..3).for_each(|c| sum.emission[c] += medium.emission[c]);
        }
        // Several opaque primitives are as opaque as one.
        let scale = (MAX_EXTINCTION / sum.extinction).min(1.0);
        if scale < 1.0 {
            sum = Medium { emission: sum.emission.map(|e| e * scale), extinction: MAX_EXTINCTION };
        }
        sum
    }

    /// Straight colour and opacity per reference length at a value and a gradient magnitude.
    pub fn evaluate(&self, value: f64, magnitude: f64) -> Rgba {
        let medium = self.medium(value, magnitude);
        if medium.extinction == 0.0 {
            return Rgba::default();
        }
        Rgba { color: medium.emission.map(|e| e / medium.extinction), opacity: -(-medium.extinction).exp_m1() }
    }

    /// A table of `nx` x `ny` entries (extinction times red, green and blue, extinction) per reference length. Along a row
    /// the value runs over `range` as in [`super::TransferFunction::table`]; row `j` has the gradient magnitude
    /// `j / (ny - 1) * gradient_max`.
    pub fn table(&self, range: ValueRange, gradient_max: f64, nx: usize, ny: usize) -> Vec<[f32; 4]> {
        let magnitudes = ValueRange::new(0.0, gradient_max);
        (0..nx * ny)
            .map(|at| self.medium(table_value(range, nx, at % nx), table_value(magnitudes, ny, at / nx)).to_entry())
            .collect()
    }

    /// The largest gradient magnitude that any shape covers, data units per world unit; 0 without shapes.
    pub fn gradient_maximum(&self) -> f64 {
        let tops = self.primitives.iter().map(|primitive| match primitive.shape {
            Shape::Rectangle { gradient, .. } => gradient[1],
            Shape::Triangle { apex, base_gradient, .. } => apex[1].max(base_gradient),
            Shape::Gaussian { center, sigma } => center[1] + GAUSSIAN_REACH * sigma[1],
        });
        tops.fold(0.0, f64::max)
    }

    /// Whether everything on the closed interval `min ..= max` of values is transparent, whatever the gradient. It may say
    /// no where a shape only touches the interval, or lies at gradients that do not occur.
    pub fn transparent_between(&self, min: f64, max: f64) -> bool {
        self.primitives.iter().all(|primitive| {
            let [low, high] = primitive.shape.values();
            extinction(primitive.opacity) == 0.0 || high < min || low > max
        })
    }
}
