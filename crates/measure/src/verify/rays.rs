//! The rays of a picture in float64, and transfer functions whose extinction is a formula: what closed forms are held against.

use glam::DVec3;
use rayloom_reference::ray::{AxisBox, Ray, Segment};
use rayloom_reference::{Camera, SceneError};
use rayloom_volume::{Knot, TransferFunction, TransferFunctionError, ValueRange, Volume};

/// Entries of the table in which the ray loop keeps a transfer function.
pub const TABLE: usize = 1024;

/// A ray of a picture and the part of it inside the box.
#[derive(Clone, Copy, Debug)]
pub struct Chord {
    /// The ray in world space; a unit of its parameter is a unit of view depth.
    pub ray: Ray,
    /// The part inside the box, texture coordinates.
    pub segment: Segment,
    /// Its length in world units.
    pub length: f64,
}

impl Chord {
    /// The world position after a share of the way through the box, 0 to 1.
    pub fn at(&self, share: f64) -> DVec3 {
        self.ray.at(self.segment.from + share * (self.segment.to - self.segment.from))
    }

    /// The world position half way through the box.
    pub fn middle(&self) -> DVec3 {
        self.at(0.5)
    }
}

/// The chord of every pixel in the part `clip` (texture coordinates) of a volume, row by row; `None` for rays that pass by.
///
/// # Errors
/// The camera makes no sense.
pub fn chords(
    camera: &Camera,
    size: [u32; 2],
    volume: &Volume,
    clip: &AxisBox,
) -> Result<Vec<Option<Chord>>, SceneError> {
    let view = camera.view(size)?;
    let to_texture = volume.texture_to_world().inverse();
    let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
    let chord = |(x, y)| {
        let ray = view.ray(x, y);
        let segment = clip.clip(&ray.transformed(&to_texture))?;
        let length = (segment.to - segment.from) * ray.direction.length();
        Some(Chord { ray, segment, length })
    };
    Ok(pixels.map(chord).collect())
}

/// The transfer function with this extinction per reference length and this straight colour at every entry of the ray
/// loop's table over `range`: extinction and emission then run linearly from entry to entry, both there and in float64.
///
/// # Errors
/// A colour or an extinction that is none.
pub fn tabulated(
    range: ValueRange,
    extinction: impl Fn(f64) -> f64,
    color: impl Fn(f64) -> [f64; 3],
) -> Result<TransferFunction, TransferFunctionError> {
    let knot = |i: usize| {
        let value = if i + 1 == TABLE { range.max } else { range.denormalise(i as f64 / (TABLE - 1) as f64) };
        Knot::new(value, color(value), -(-extinction(value)).exp_m1())
    };
    TransferFunction::new((0..TABLE).map(knot).collect())
}
