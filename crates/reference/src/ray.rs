//! Rays and the part of them that lies inside the volume.

use glam::{DAffine3, DVec3};

/// A half line (or a whole one, when `start` is minus infinity) in any space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// The point of parameter zero.
    pub origin: DVec3,
    /// Advance per unit of the parameter; of any length but zero.
    pub direction: DVec3,
    /// Parameter at which the ray begins.
    pub start: f64,
}

impl Ray {
    /// The point of parameter `t`.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.direction
    }

    /// The same ray in another space, with the same parameters.
    pub fn transformed(&self, map: &DAffine3) -> Self {
        Self {
            origin: map.transform_point3(self.origin),
            direction: map.transform_vector3(self.direction),
            start: self.start,
        }
    }
}

/// An axis-aligned closed box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisBox {
    /// Smallest coordinates.
    pub min: DVec3,
    /// Largest coordinates.
    pub max: DVec3,
}

impl AxisBox {
    /// The box `0..1` on each axis: the whole volume in texture coordinates.
    pub const UNIT: Self = Self { min: DVec3::ZERO, max: DVec3::ONE };

    /// What both boxes share; its `min` exceeds its `max` on some axis if that is nothing.
    pub fn intersection(&self, other: &Self) -> Self {
        Self { min: self.min.max(other.min), max: self.max.min(other.max) }
    }

    /// The part of `ray` inside this box, or `None` if that is empty or a single point.
    ///
    /// A ray that runs within a face, along an edge or starts on one is inside as far as it goes. The end points lie in the
    /// box exactly, whatever the rounding.
    pub fn clip(&self, ray: &Ray) -> Option<Segment> {
        let (mut from, mut to) = (ray.start, f64::INFINITY);
        for axis in 0..3 {
            let (origin, direction) = (ray.origin[axis], ray.direction[axis]);
            let (low, high) = (self.min[axis] - origin, self.max[axis] - origin);
            if direction == 0.0 {
                // Parallel to this pair of faces: dividing would give 0/0 on a face.
                if low > 0.0 || high < 0.0 {
                    return None;
                }
            } else {
                let (near, far) = if direction > 0.0 { (low, high) } else { (high, low) };
                from = from.max(near / direction);
                to = to.min(far / direction);
            }
        }
        if !(from < to && from.is_finite() && to.is_finite()) {
            return None;
        }
        let end = |t: f64| ray.at(t).clamp(self.min, self.max);
        let segment = Segment { entry: end(from), exit: end(to), from, to };
        (segment.entry != segment.exit).then_some(segment)
    }
}

/// A piece of a ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Where it begins.
    pub entry: DVec3,
    /// Where it ends.
    pub exit: DVec3,
    /// Ray parameter at the entry.
    pub from: f64,
    /// Ray parameter at the exit.
    pub to: f64,
}

impl Segment {
    /// The point at `fraction` of the way, 0 at the entry and 1 at the exit.
    pub fn at(&self, fraction: f64) -> DVec3 {
        self.entry + (self.exit - self.entry) * fraction
    }

    /// The ray parameter at `fraction` of the way.
    pub fn parameter_at(&self, fraction: f64) -> f64 {
        self.from + (self.to - self.from) * fraction
    }
}
