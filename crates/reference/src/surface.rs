//! The surface in a picture that has been rendered.

use crate::image::{Image, MISS};
use crate::metrics::SurfacePoint;
use crate::prepared::Prepared;
use crate::scene::{Scene, SceneError};

/// Where the rays of `image`, a picture of an isosurface by either renderer, meet the surface: view depth and unit normal in
/// world space, towards smaller values; row by row.
///
/// # Errors
/// A number of the scene makes no sense.
pub fn surface_points(scene: &Scene<'_>, image: &Image) -> Result<Vec<Option<SurfacePoint>>, SceneError> {
    let prepared = Prepared::new(scene)?;
    let pixels = (0..image.size[1]).flat_map(|y| (0..image.size[0]).map(move |x| (x, y)));
    let point = |((x, y), &depth): ((u32, u32), &f64)| {
        let hit = || prepared.surface_seen(x, y, depth);
        (depth < MISS).then(hit).map(|hit| SurfacePoint { distance: hit.depth, normal: hit.normal })
    };
    Ok(pixels.zip(&image.depth).map(point).collect())
}
