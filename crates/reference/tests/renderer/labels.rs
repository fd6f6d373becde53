//! Classification by labels, against closed forms.

use crate::scenes::*;
use glam::DVec3;
use rayloom_reference::closed_forms::{homogeneous_opacity, linear_opacity_depth};
use rayloom_reference::ray::AxisBox;
use rayloom_reference::{Camera, Classification, Labels, Method, Scene, SceneError, exact, same_samples};
use rayloom_volume::{Knot, Label, LabelTable, TransferFunction, Volume};
use std::sync::Arc;

/// Five slabs of labels along x.
const SLABS: [f64; 5] = [0.0, 3.0, 8.0, -2.0, 1.0];

/// The values `x` over the unit box with the middles of the voxels on its sides.
fn ramp() -> Volume {
    let step = DVec3::new(1.0 / 16.0, 0.5, 0.5);
    volume([17, 3, 3], filling([17, 3, 3], -0.5 * step, DVec3::ONE + 0.5 * step), |p| p.x)
}

fn labels(functions: Vec<(u32, TransferFunction)>) -> Labels {
    let dims = [5, 2, 1];
    let volume = volume(dims, filling(dims, DVec3::ZERO, DVec3::ONE), |p| SLABS[(5.0 * p.x) as usize]);
    let label = |transfer_function| Label { name: String::new(), transfer_function };
    let labels = functions.into_iter().map(|(number, function)| (number, label(function))).collect();
    Labels { volume: Arc::new(volume), table: LabelTable { labels } }
}

/// The one pixel of a slanted ray through a box of labels, with the length of its way.
fn slanted(volume: &Volume, labels: Labels) -> (Scene<'_>, f64) {
    let direction = DVec3::new(1.0, 0.13, -0.21);
    let center = volume.texture_to_world().transform_point3(DVec3::splat(0.5));
    let camera = Camera::orthographic(center - 3.0 * direction, center, 1.0);
    let scene = Scene::new(volume, Classification::Labels(labels), camera, [1, 1]);
    let width = volume.texture_to_world().matrix3.x_axis.x;
    (scene, direction.length() * width / direction.x)
}

/// Colour and opacity of slabs one behind the other: optical depth and straight colour of each.
fn composited(slabs: &[(f64, [f64; 3])]) -> [f64; 4] {
    let mut sum = [0.0; 4];
    for (depth, [r, g, b]) in slabs {
        let weight = (1.0 - sum[3]) * homogeneous_opacity(*depth, 1.0);
        sum = std::array::from_fn(|i| sum[i] + weight * [*r, *g, *b, 1.0][i]);
    }
    sum
}

#[test]
fn boxes_of_constant_labels() {
    let volume = ramp();
    let (glass, red, blue) = ([0.2, 0.9, 0.4], [0.9, 0.1, 0.2], [0.1, 0.3, 1.0]);
    // Labels 8 and -2 mean nothing, 7 does not occur.
    let functions =
        |last| vec![(0, uniform(glass, 0.7)), (3, uniform(red, 1.9)), (1, last), (7, uniform([1.0; 3], 9.0))];
    let opaque = TransferFunction { knots: vec![Knot::new(0.0, blue, 1.0)] };
    for (last, tau) in [(uniform(blue, 0.4), 0.4), (opaque, 1e6)] {
        let (scene, length) = slanted(&volume, labels(functions(last)));
        let fifth = length / 5.0;
        let expected = composited(&[(0.7 * fifth, glass), (1.9 * fifth, red), (tau * fifth, blue)]);
        let found = exact::render(&scene).expect("the scene makes sense").pixel(0, 0);
        assert!((0..4).all(|i| (found[i] - expected[i]).abs() < 1e-12), "{found:?} {expected:?}");
        // What is in front of a box that means nothing does not matter.
        let front = Scene { clip: AxisBox { max: DVec3::new(0.4, 1.0, 1.0), ..AxisBox::UNIT }, ..scene.clone() };
        let back = Scene { clip: AxisBox { min: DVec3::new(0.4, 0.0, 0.0), ..AxisBox::UNIT }, ..scene };
        let [front, back] =
            [front, back].map(|scene| exact::render(&scene).expect("the scene makes sense").pixel(0, 0));
        let whole: [f64; 4] = std::array::from_fn(|i| front[i] + (1.0 - front[3]) * back[i]);
        assert!((0..4).all(|i| (whole[i] - expected[i]).abs() < 1e-12), "{whole:?} {expected:?}");
    }
}

#[test]
fn values_inside_of_a_label() {
    // Along x exactly, between the voxel centres at 0 and 1: opacity is drawn as the value, in the second and the last fifth.
    let volume = ramp();
    let line = TransferFunction { knots: vec![Knot::new(0.0, [1.0; 3], 0.0), Knot::new(1.0, [1.0; 3], 1.0)] };
    let (mut scene, _) = slanted(&volume, labels(vec![(3, line.clone()), (1, line)]));
    scene.camera = along_x(0.3, 0.4);
    let box_of = volume.texture_to_world().matrix3.x_axis.x;
    let place = |texture: f64| (texture - 0.5) * box_of + 0.5;
    scene.clip.max.x = 0.5 + 0.5 / box_of;
    let depth = |from: f64, to: f64| linear_opacity_depth(1.0, to) - linear_opacity_depth(1.0, from);
    let expected = homogeneous_opacity(depth(place(0.2), place(0.4)) + depth(place(0.8), 1.0), 1.0);
    let image = exact::render(&scene).expect("the scene makes sense");
    assert!((image.pixel(0, 0)[3] - expected).abs() < 1e-12, "{} {expected}", image.pixel(0, 0)[3]);
    assert!((image.depth[0] - (10.0 + place(0.2))).abs() < 1e-12);
    // Samples come to it by the first power of the step.
    let error = |rate: f64| {
        let scene = Scene { step: scene.step / rate, ..scene.clone() };
        (same_samples::render(&scene).expect("the scene makes sense").pixel(0, 0)[3] - expected).abs()
    };
    assert!(error(1000.0) < 1e-3 && error(100_000.0) < 1e-5, "{} {}", error(1000.0), error(100_000.0));
}

#[test]
fn one_value_of_a_ray_has_no_label() {
    let volume = ramp();
    let (mut scene, _) = slanted(&volume, labels(vec![]));
    assert!(exact::render(&scene).is_ok_and(|image| image.pixel(0, 0) == [0.0; 4]));
    scene.method = Method::Mean;
    assert!(matches!(exact::Renderer::new(&scene), Err(SceneError::Labels)));
}
