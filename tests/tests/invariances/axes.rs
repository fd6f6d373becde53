//! I5, I6: the directions in which voxels are stored, and those of the world, do not matter.

use glam::{DAffine3, DMat3, DVec3};
use rayloom_reference::Camera;
use rayloom_tests::{Grid, Picture, Workbench, tolerances::*};
use serde_json::json;

use crate::{SIZE, assert_shows, difference, function};

/// A lopsided thing in a box around the origin.
pub fn thing(dims: [u32; 3]) -> Grid {
    Grid::of_world(dims, Grid::centered(dims, DVec3::from_array(dims.map(f64::from))), |p| {
        let blob = |center: DVec3, sigma: f64| (-(p - center).length_squared() / (2.0 * sigma * sigma)).exp();
        blob(DVec3::new(-3.0, 2.0, 1.0), 4.0)
            + 0.7 * blob(DVec3::new(4.0, -5.0, -3.0), 3.0)
            + 0.2 * (0.7 * p.x + 0.3 * p.y * p.z).sin()
    })
}

fn picture(grid: &Grid, camera: &Camera, settings: &[(&str, &str)]) -> Picture {
    let file = grid.save();
    let mut bench = Workbench::of_file(file.path());
    bench.look(camera).classify(&function(&[
        (0.1, [0.1, 0.3, 0.9], 0.0),
        (0.5, [0.9, 0.8, 0.2], 0.2),
        (1.0, [1.0, 0.2, 0.1], 0.6),
    ]));
    for (property, value) in settings {
        bench.put(&format!("traversal.{property}"), json!(value));
    }
    bench.render(SIZE)
}

fn cameras() -> [Camera; 3] {
    let up = |camera: Camera| Camera { up: DVec3::new(0.1, 0.2, 1.0), ..camera };
    [
        up(Camera::perspective(DVec3::new(30.0, -17.0, 22.0), DVec3::new(1.0, 0.0, -1.0), 45.0)),
        up(Camera::perspective(DVec3::new(4.0, 3.0, -2.0), DVec3::new(-3.0, 1.0, 1.0), 70.0)),
        up(Camera::orthographic(DVec3::new(-13.0, -27.0, 9.0), DVec3::ZERO, 26.0)),
    ]
}

const LOOKS: [&[(&str, &str)]; 3] = [
    &[],
    &[("shading", "blinn_phong")],
    &[("compositing", "isosurface"), ("shading", "diffuse"), ("refinement", "secant")],
];

/// The volume whose index axis `a` runs along the old axis `order[a]`, backwards where `flipped[a]`, and the same world.
fn stored(grid: &Grid, order: [usize; 3], flipped: [bool; 3]) -> Grid {
    let dims = order.map(|axis| grid.dims[axis]);
    let old = |index: [u32; 3]| {
        let mut old = [0; 3];
        for a in 0..3 {
            old[order[a]] = if flipped[a] { dims[a] - 1 - index[a] } else { index[a] };
        }
        old
    };
    let corner = DVec3::from_array(old([0; 3]).map(f64::from));
    let column = |a: usize| DVec3::AXES[order[a]] * if flipped[a] { -1.0 } else { 1.0 };
    let to_old = DAffine3 { matrix3: DMat3::from_cols(column(0), column(1), column(2)), translation: corner };
    Grid::of_index(dims, grid.index_to_world * to_old, |index| f64::from(grid.at(old(index))))
}

/// The same world in another order of storage gives the same picture.
fn assert_same(name: &str, order: [usize; 3], flipped: [bool; 3]) {
    let grid = thing([24, 20, 28]);
    let turned = stored(&grid, order, flipped);
    for (view, camera) in cameras().iter().enumerate() {
        for look in LOOKS {
            let (a, b) = (picture(&grid, camera, look), picture(&turned, camera, look));
            assert_shows(&a, name);
            let errors: Vec<f64> = a
                .color
                .iter()
                .zip(&b.color)
                .map(|(a, b)| (0..4).map(|i| f64::from((a[i] - b[i]).abs())).fold(0.0, f64::max))
                .collect();
            let mean = errors.iter().sum::<f64>() / errors.len() as f64;
            println!("{name}, view {view}, {look:?}: mean difference {mean:.2e}, largest {:.2e}", difference(&a, &b));
            assert!(mean <= AXES_MEAN, "{name}, view {view}, {look:?}: {mean}");
            let allowed = match look {
                [] => AXES_UNSHADED,
                [("shading", _)] => AXES_SHADED,
                _ => AXES_SURFACE,
            };
            assert!(difference(&a, &b) <= allowed, "{name}, view {view}, {look:?}: {}", difference(&a, &b));
        }
    }
}

#[test]
fn i5_rotated_storage() {
    assert_same("a quarter turn about x", [0, 2, 1], [false, true, false]);
    assert_same("a quarter turn about y", [2, 1, 0], [true, false, false]);
    assert_same("a quarter turn about z", [1, 0, 2], [false, true, false]);
    assert_same("a third of a turn about the diagonal", [1, 2, 0], [false; 3]);
}

#[test]
fn i6_mirrored_storage() {
    assert_same("mirrored along x", [0, 1, 2], [true, false, false]);
    assert_same("mirrored along y", [0, 1, 2], [false, true, false]);
    assert_same("mirrored along all axes", [0, 1, 2], [true; 3]);
    assert_same("two axes exchanged", [1, 0, 2], [false; 3]);
}

/// A rotated world seen by a rotated camera, and a mirrored world seen in a mirror.
#[test]
fn i5_i6_turned_worlds() {
    let grid = thing([24, 20, 28]);
    let quarter = DMat3::from_cols(DVec3::Y, -DVec3::X, DVec3::Z);
    let mirror = DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0));
    for (name, turn, is_mirror) in [("quarter", quarter, false), ("mirror", mirror, true)] {
        let turned = Grid { index_to_world: DAffine3::from_mat3(turn) * grid.index_to_world, ..grid.clone() };
        for camera in cameras() {
            let other = Camera { eye: turn * camera.eye, focus: turn * camera.focus, up: turn * camera.up, ..camera };
            let (a, mut b) = (picture(&grid, &camera, LOOKS[0]), picture(&turned, &other, LOOKS[0]));
            if is_mirror {
                b.color.chunks_mut(SIZE[0] as usize).for_each(<[_]>::reverse);
            }
            assert_shows(&a, name);
            println!("turned world, {name}: largest difference {:.2e}", difference(&a, &b));
            assert!(difference(&a, &b) <= AXES_UNSHADED, "{name}: {}", difference(&a, &b));
        }
    }
}
