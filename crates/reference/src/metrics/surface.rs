//! Errors of surfaces where rays meet them.

use super::linear::{CompareError, ErrorStatistics};
use glam::DVec3;

/// Where a ray meets a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Distance along the ray, or view depth; world units.
    pub distance: f64,
    /// Normal in world space, of any length; zero where there is none.
    pub normal: DVec3,
}

/// How far the surface in a picture lies from that of a reference. Pixels count that meet both; the others are the silhouette.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceComparison {
    /// Absolute errors of the distance, in the unit of length that was given.
    pub distance: ErrorStatistics,
    /// Angles between the normals in degrees, 0 to 180; pixels where either surface has none are left out.
    pub normal: ErrorStatistics,
    /// Pixels that meet both surfaces.
    pub common: usize,
    /// Pixels that meet the reference only: eroded silhouettes, missed folds.
    pub missing: usize,
    /// Pixels that meet the picture's surface only.
    pub extra: usize,
}

impl SurfaceComparison {
    /// Compares the surface of every pixel with the reference; distances are given in units of `unit` world units, the voxel
    /// spacing for errors in voxels.
    ///
    /// A distance that is not a number counts as infinitely wrong.
    ///
    /// # Errors
    /// There are no pixels, or not equally many.
    pub fn new(
        picture: &[Option<SurfacePoint>],
        reference: &[Option<SurfacePoint>],
        unit: f64,
    ) -> Result<Self, CompareError> {
        if picture.len() != reference.len() {
            return Err(CompareError::DifferentSizes { found: picture.len(), expected: reference.len() });
        }
        if picture.is_empty() {
            return Err(CompareError::Empty);
        }
        let (mut distances, mut angles) = (vec![], vec![]);
        let (mut missing, mut extra) = (0, 0);
        for pair in picture.iter().zip(reference) {
            match pair {
                (Some(found), Some(expected)) => {
                    let error = ((found.distance - expected.distance) / unit).abs();
                    distances.push(if error.is_nan() { f64::INFINITY } else { error });
                    angles.extend(angle_degrees(found.normal, expected.normal));
                }
                (None, Some(_)) => missing += 1,
                (Some(_), None) => extra += 1,
                (None, None) => {}
            }
        }
        let common = distances.len();
        let (distance, normal) = (ErrorStatistics::of(distances), ErrorStatistics::of(angles));
        Ok(Self { distance, normal, common, missing, extra })
    }

    /// Pixels in which only one of the surfaces is met.
    pub fn silhouette(&self) -> usize {
        self.missing + self.extra
    }
}

/// The angle between two directions; `None` if either is none. Precise for small angles, unlike the arc cosine.
fn angle_degrees(a: DVec3, b: DVec3) -> Option<f64> {
    let (a, b) = (a.try_normalize()?, b.try_normalize()?);
    Some(a.cross(b).length().atan2(a.dot(b)).to_degrees())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_computed_surfaces() -> Result<(), CompareError> {
        let point = |distance, normal| Some(SurfacePoint { distance, normal });
        let reference =
            [point(10.0, DVec3::X), point(10.0, DVec3::X), point(7.0, DVec3::ZERO), None, point(1.0, DVec3::Y), None];
        let tilted = DVec3::new(1e-9_f64.cos(), 1e-9_f64.sin(), 0.0);
        let picture = [
            point(10.5, 3.0 * DVec3::X),
            point(10.0, -DVec3::Y),
            point(f64::NAN, DVec3::X),
            point(3.0, DVec3::X),
            None,
            None,
        ];
        let found = SurfaceComparison::new(&picture, &reference, 0.5)?;
        assert_eq!((found.common, found.missing, found.extra, found.silhouette()), (3, 1, 1, 2));
        assert_eq!((found.distance.max, found.normal.max, found.normal.mean), (f64::INFINITY, 90.0, 45.0));
        let close = SurfaceComparison::new(&[point(10.5, tilted)], &reference[..1], 0.5)?;
        assert_eq!(close.distance.max, 1.0);
        assert!((close.normal.max.to_radians() - 1e-9).abs() < 1e-15);
        assert!(SurfaceComparison::new(&picture[..2], &reference, 1.0).is_err());
        assert_eq!(SurfaceComparison::new(&[], &[], 1.0), Err(CompareError::Empty));
        Ok(())
    }
}
