//! The distance between samples, one for all rays of a picture.

use glam::{DMat3, DVec3};
use rayloom_volume::Volume;

use crate::View;

/// Rays that are looked at along each axis of the picture, from edge to edge.
const RAYS: u32 = 9;

/// By how much the edges of voxels may differ, and the sines of their angles from 1, in shares, and still make a cube.
const CUBE: f64 = 1e-6;

/// The step in world units that takes `rate` samples per voxel along the ray that crosses most voxels a length, and no fewer
/// along any other. Cubes are crossed alike by all rays: the step is their edge over `rate` whatever the view.
pub fn step_length(view: &View, volume: &Volume, rate: f64) -> f64 {
    let spacing = volume.spacing();
    let axes = volume.index_to_world.matrix3;
    let unit = DMat3::from_cols(axes.x_axis / spacing.x, axes.y_axis / spacing.y, axes.z_axis / spacing.z);
    if is_cube(spacing, &unit) {
        return volume.mean_spacing() / rate;
    }
    // Direction by direction, since products of tiny and huge edges leave f64's range long before the edges do.
    let to_axes = unit.inverse();
    let crossed = |direction: DVec3| ((to_axes * direction) / spacing).length();
    1.0 / (rate * directions(view).map(crossed).fold(0.0, f64::max))
}

fn is_cube(spacing: DVec3, unit: &DMat3) -> bool {
    let cosines = [unit.x_axis.dot(unit.y_axis), unit.y_axis.dot(unit.z_axis), unit.z_axis.dot(unit.x_axis)];
    spacing.max_element() - spacing.min_element() <= CUBE * spacing.max_element()
        && cosines.into_iter().all(|cosine| cosine.abs() <= CUBE)
}

/// Unit vectors in the world along rays all over the picture.
fn directions(view: &View) -> impl Iterator<Item = DVec3> {
    let planes = view.ray_planes();
    let to_world = view.texture_to_world.matrix3;
    let place = |i: u32| 2.0 * f64::from(i) / f64::from(RAYS - 1) - 1.0;
    (0..RAYS * RAYS).map(move |n| {
        let (x, y) = (place(n % RAYS), place(n / RAYS));
        let at = |plane: [DVec3; 3]| plane[0] + plane[1] * x + plane[2] * y;
        (to_world * (at(planes.far) - at(planes.near))).normalize_or_zero()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DAffine3, DQuat};
    use rayloom_network::{Camera, Projection};
    use rayloom_volume::Voxels;

    fn volume(axes: DMat3) -> Volume {
        let place = DAffine3::from_mat3_translation(axes, DVec3::new(1.0, -2.0, 0.5));
        Volume::new("test", [3, 4, 5], 1, Voxels::U8(vec![0; 60]), place).expect("a volume")
    }

    fn view(volume: &Volume, towards: DVec3, projection: Projection) -> View {
        let to_world = volume.texture_to_world();
        let center = to_world.transform_point3(DVec3::splat(0.5));
        let reach = to_world.matrix3.to_cols_array().into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let eye = center - 3.0 * reach * towards;
        let camera = Camera { position: eye.into(), focus: center.into(), projection, ..Camera::default() };
        View::new(&camera, [40, 30], to_world).expect("valid")
    }

    /// Voxels crossed by a ray of that direction, a world length.
    fn crossed(volume: &Volume, direction: DVec3) -> f64 {
        (volume.index_to_world.matrix3.inverse() * direction).length() / direction.length()
    }

    const PERSPECTIVE: Projection = Projection::Perspective { fov_degrees: 60.0 };
    const PARALLEL: Projection = Projection::Orthographic { height: 9.0 };

    #[test]
    fn cubes_have_one_step_for_all_views() {
        let turn = DMat3::from_quat(DQuat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.4));
        for edge in [1e-9, 0.7, 1e9] {
            let cubes = volume(turn * DMat3::from_diagonal(DVec3::new(edge, -edge, edge * (1.0 + 5e-7))));
            for projection in [PERSPECTIVE, PARALLEL] {
                for towards in [DVec3::new(1.0, 0.3, 0.2), DVec3::new(-0.1, 0.9, 0.4)] {
                    let found = step_length(&view(&cubes, towards, projection), &cubes, 2.0);
                    assert_eq!(found, cubes.mean_spacing() / 2.0);
                    assert!((found / edge - 0.5).abs() < 1e-6, "{found}");
                }
            }
        }
    }

    #[test]
    fn parallel_rays_keep_their_samples_per_voxel() {
        let shear = DMat3::from_cols(DVec3::new(0.5, 0.1, 0.0), DVec3::new(0.0, 1.0, 0.3), DVec3::new(0.0, 0.0, 5.0));
        for axes in [shear, DMat3::from_diagonal(DVec3::new(1.0, 1.0, -1000.0))] {
            let volume = volume(axes);
            for towards in [DVec3::X, DVec3::new(0.2, 0.4, -0.6)] {
                let projection = Projection::Orthographic { height: 0.1 * volume.spacing().x };
                let found = step_length(&view(&volume, towards, projection), &volume, 3.0);
                let expected = 1.0 / (3.0 * crossed(&volume, towards));
                // The direction is the difference of far points.
                assert!((found / expected - 1.0).abs() < 1e-9, "{axes} {towards}: {found} {expected}");
            }
        }
    }

    #[test]
    fn no_ray_is_sampled_more_coarsely_than_asked() {
        let flat = volume(DMat3::from_diagonal(DVec3::new(1.0, 1.0, 5.0)));
        let view = view(&flat, DVec3::new(0.2, 0.1, 1.0).normalize(), PERSPECTIVE);
        let step = step_length(&view, &flat, 1.5);
        let planes = view.ray_planes();
        let mut most: f64 = 0.0;
        for (x, y) in
            (0..=200).flat_map(|x| (0..=200).map(move |y| (f64::from(x) / 100.0 - 1.0, f64::from(y) / 100.0 - 1.0)))
        {
            let at = |plane: [DVec3; 3]| plane[0] + plane[1] * x + plane[2] * y;
            most = most.max(crossed(&flat, view.texture_to_world.transform_vector3(at(planes.far) - at(planes.near))));
        }
        // A ray between those that are looked at may ask for a little more.
        assert!((most * step * 1.5 - 1.0).abs() < 1e-3 && step < 5.0 / 1.5, "{}", most * step);
    }
}
