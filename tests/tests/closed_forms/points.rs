//! T14, T15 gradients of polynomials, T16 the signal of Marschner and Lobb, read point by point through the ray loop.

use glam::{DAffine3, DVec3};
use rayloom_measure::verify::probe;
use rayloom_reference::Camera;
use rayloom_reference::field::{self, Sampling};
use rayloom_reference::ray::AxisBox;
use rayloom_tests::rays::chords;
use rayloom_tests::{Grid, Workbench, tolerances::*};
use rayloom_volume::Field;
use serde_json::json;

use crate::{largest, rms};

const SIZE: [u32; 2] = [24, 24];

/// What a probe reads in the middle of every ray, with the world position there.
fn read(bench: &mut Workbench, probe: &str, camera: &Camera, clip: &AxisBox) -> Vec<(DVec3, DVec3)> {
    bench.put("traversal.compositing.text", json!(probe)).put("traversal.max_samples", json!(1));
    bench.put("traversal.skipping", json!("none"));
    let volume = bench.volume();
    let picture = bench.look(camera).render(SIZE);
    let chords = chords(camera, SIZE, &volume, clip);
    let met = chords.iter().zip(&picture.color).filter_map(|(chord, pixel)| Some((chord.as_ref()?, pixel)));
    met.map(|(chord, &[r, g, b, _])| (chord.middle(), DVec3::from([r, g, b].map(f64::from)))).collect()
}

/// Largest error of a gradient operator over points well inside, normalised values a voxel; a voxel is one unit.
fn gradient_error(grid: &Grid, operator: &str, camera: &Camera, clip: &AxisBox, exact: impl Fn(DVec3) -> DVec3) -> f64 {
    let file = grid.save();
    let mut bench = Workbench::of_file(file.path());
    let voxels = f64::from(grid.dims[0]);
    for (axis, (low, high)) in ["x", "y", "z"].iter().zip(clip.min.to_array().into_iter().zip(clip.max.to_array())) {
        bench.put(&format!("proxy.clip_{axis}"), json!([low * voxels, high * voxels]));
    }
    let width = bench.volume().ranges()[0].width();
    bench.put("traversal.gradient", json!(operator)).put("traversal.sampling", json!("trilinear"));
    let found = read(&mut bench, probe::GRADIENT, camera, clip);
    largest(&found.iter().map(|(place, gradient)| (*gradient - exact(*place) / width).length()).collect::<Vec<_>>())
}

#[test]
fn t14_differences_of_a_quadratic_field() {
    let dims = [17; 3];
    let value = |p: DVec3| p.x * p.x + 2.0 * p.y * p.y + 3.0 * p.z * p.z + p.x * p.y;
    let gradient = |p: DVec3| DVec3::new(2.0 * p.x + p.y, 4.0 * p.y + p.x, 6.0 * p.z);
    let grid = Grid::of_world(dims, Grid::centered(dims, DVec3::splat(17.0)), value);
    let camera = Camera::orthographic(DVec3::new(30.0, 17.0, 13.0), DVec3::ZERO, 7.0);
    // Half the second derivative along each axis is what one-sided differences are off by, at voxels and between.
    let curvature = DVec3::new(1.0, 2.0, 3.0);
    for (operator, offset) in [("central", 0.0), ("sobel", 0.0), ("forward", 1.0), ("backward", -1.0)] {
        let exact = |p| gradient(p) + offset * curvature;
        let worst = gradient_error(&grid, operator, &camera, &AxisBox::UNIT, exact);
        println!("T14, {operator}: largest error {worst:.2e}");
        assert!(worst <= DIFFERENCE, "{operator}: {worst}");
    }
}

#[test]
fn t15_central_differences_of_a_cubic_field_are_off_by_the_square_of_the_voxel() {
    let voxels = 16;
    let dims = [voxels; 3];
    let grid = Grid::of_world(dims, Grid::centered(dims, DVec3::splat(f64::from(voxels))), |p| p.x.powi(3));
    for slice in [3, 8, 12] {
        // One voxel thick, so that rays have their middles at voxel centres.
        let ends = [slice, slice + 1].map(|edge| f64::from(edge) / f64::from(voxels));
        let clip = AxisBox { min: DVec3::new(ends[0], 0.0, 0.0), max: DVec3::new(ends[1], 1.0, 1.0) };
        let camera = Camera::orthographic(DVec3::X * -30.0, DVec3::ZERO, 11.0);
        let exact = |p: DVec3| DVec3::X * (3.0 * p.x * p.x + 1.0);
        let worst = gradient_error(&grid, "central", &camera, &clip, exact);
        println!("T15, slice {slice}: departs from 3 x^2 + h^2 by {worst:.2e} at most");
        assert!(worst <= DIFFERENCE, "{slice}: {worst}");
    }
}

#[test]
fn t16_marschner_lobb_is_kept_by_cubic_sampling_and_lost_by_linear() {
    let field = Field::MarschnerLobb { frequency: 6.0, alpha: 0.25 };
    let values = [([0.0, 0.0, 0.0], 0.6), ([0.0, 0.0, 1.0], 0.2), ([0.0, 0.0, -1.0], 1.0)];
    for (place, value) in values.into_iter().chain([([0.5, 0.25, 0.1], 0.486_522_727_9)]) {
        assert!((field.value(DVec3::from(place)) - value).abs() < 1e-10, "{place:?}");
    }
    // Samples at -1, -0.95, ... 1.
    let to_world = DAffine3::from_translation(-DVec3::ONE) * DAffine3::from_scale(DVec3::splat(0.05));
    let file = Grid::of_world([41; 3], to_world, |p| field.value(p)).save();
    let mut bench = Workbench::of_file(file.path());
    let volume = bench.volume();
    let (range, to_texture) = (volume.ranges()[0], volume.texture_to_world().inverse());
    let camera = Camera::orthographic(DVec3::new(1.0, 1.7, 9.0), DVec3::ZERO, 1.4);
    let samplings = [
        ("trilinear", Sampling::Trilinear),
        ("catmull_rom", Sampling::CatmullRom),
        ("bspline", Sampling::BSplinePrefiltered),
    ];
    let errors = samplings.map(|(id, sampling)| {
        let exact = field::Field::new(&volume, 0, sampling);
        bench.put("traversal.sampling", json!(id));
        let found = read(&mut bench, probe::VALUE, &camera, &AxisBox::UNIT);
        let values = found.iter().map(|(place, value)| (*place, range.denormalise(value.x)));
        let (mut signal, mut interpolated) = (Vec::new(), Vec::new());
        for (place, value) in values {
            signal.push(value - field.value(place));
            interpolated.push(value - exact.at_texture(to_texture.transform_point3(place)));
        }
        let (signal, arithmetic) = (rms(&signal), largest(&interpolated));
        println!("T16, {id}: rms error {signal:.2e}, from the same interpolation in float64 {arithmetic:.2e}");
        assert!(arithmetic.abs() <= INTERPOLATED, "{id}: {arithmetic}");
        signal
    });
    // This close to the limit of the grid linear interpolation loses most of the waves, whose rms is 0.06.
    assert!(errors[0] > MARSCHNER_LOBB_LINEAR && errors[2] < 0.5 * errors[0], "{errors:?}");
    assert!(errors[2] < errors[1] && errors[1] < errors[0], "{errors:?}");
}
