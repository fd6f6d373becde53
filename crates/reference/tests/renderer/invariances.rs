//! Pictures that must be equal (I3, I5-I8, I11, I12).

use crate::scenes::*;
use glam::{DAffine3, DMat3, DVec3};
use rayloom_reference::field::Sampling;
use rayloom_reference::ray::AxisBox;
use rayloom_reference::same_samples::{Renderer, render};
use rayloom_reference::shading::Shading;
use rayloom_reference::{Camera, Comparison, Image, MISS, Rectangle, Scene, unattended};
use rayloom_volume::Volume;

const DIMS: [u32; 3] = [8, 6, 5];

/// Noise in a box from the origin to (1, 0.75, 0.625): equal spacings.
fn noisy() -> Volume {
    volume(DIMS, filling(DIMS, DVec3::ZERO, DVec3::new(1.0, 0.75, 0.625)), noise)
}

fn camera() -> Camera {
    Camera::perspective(DVec3::new(2.0, 1.4, -1.8), DVec3::new(0.5, 0.35, 0.3), 32.0)
}

fn shaded<'a>(volume: &'a Volume, camera: Camera) -> Scene<'a> {
    let mut scene = Scene::new(volume, colorful(), camera, [24, 20]);
    scene.shading = Some(Shading { gradient_fade: 0.05, ..Shading::default() });
    (scene.reference_length, scene.step) = (0.2, scene.step / 1.3);
    scene
}

fn image(scene: &Scene<'_>) -> Image {
    let image = render(scene).expect("the scene makes sense");
    assert!(image.color.iter().any(|pixel| pixel[3] > 0.3), "the picture shows something");
    image
}

fn assert_equal(a: &Image, b: &Image, tolerance: f64) {
    let comparison = Comparison::new(&a.color, &b.color).expect("pictures of one size");
    assert!(comparison.pixels.max <= tolerance, "{:?}", comparison.pixels);
}

#[test]
fn data_and_camera_turned_together() {
    let expected = image(&shaded(&noisy(), camera()));
    let turns = [DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X), DMat3::from_cols(DVec3::Y, -DVec3::X, DVec3::Z)];
    for turn in turns {
        let original = noisy();
        let turned_camera =
            Camera { eye: turn * camera().eye, focus: turn * camera().focus, up: turn * camera().up, ..camera() };
        // Turned by the transformation only.
        let mut turned = original.clone();
        turned.index_to_world = DAffine3::from_mat3(turn) * original.index_to_world;
        assert_equal(&image(&shaded(&turned, turned_camera)), &expected, 1e-12);
        // Turned by permuting the voxels: the same field on a grid along the new axes.
        let size = (turn * original.dims_f64()).abs();
        let dims = size.as_uvec3().to_array();
        let corner = (turn * DVec3::new(1.0, 0.75, 0.625)).min(DVec3::ZERO);
        let permuted = volume(dims, filling(dims, corner, corner + size / 8.0), |p| noise(turn.transpose() * p));
        assert_equal(&image(&shaded(&permuted, turned_camera)), &expected, 1e-12);
    }
}

#[test]
fn mirrored_storage_of_the_same_field() {
    let original = noisy();
    let expected = image(&shaded(&original, camera()));
    for axis in 0..3 {
        let mut flip = DVec3::ONE;
        flip[axis] = -1.0;
        let last = (original.dims_f64() - 1.0) * (DVec3::ONE - flip) / 2.0;
        let reversed = original.index_to_world * DAffine3::from_mat3_translation(DMat3::from_diagonal(flip), last);
        assert_equal(&image(&shaded(&volume(DIMS, reversed, noise), camera())), &expected, 1e-12);
    }
}

#[test]
fn moved_and_scaled_worlds() {
    let expected = image(&shaded(&noisy(), camera()));
    for (scale, shift, tolerance) in [(1e-9, 0.0, 1e-10), (1e9, 0.0, 1e-10), (1.0, 1e6, 1e-7)] {
        let place = |p: DVec3| p * scale + shift;
        let mut moved = noisy();
        moved.index_to_world =
            DAffine3::from_mat3_translation(DMat3::IDENTITY * scale, DVec3::splat(shift)) * moved.index_to_world;
        let moved_camera = Camera { eye: place(camera().eye), focus: place(camera().focus), ..camera() };
        let mut scene = shaded(&moved, moved_camera);
        scene.reference_length *= scale;
        assert_equal(&image(&scene), &expected, tolerance);
    }
}

/// Composites `front` over `back`.
fn over(front: &Image, back: &Image) -> Image {
    let mix = |(f, b): (&[f64; 4], &[f64; 4])| [0, 1, 2, 3].map(|i| f[i] + (1.0 - f[3]) * b[i]);
    Image { color: front.color.iter().zip(&back.color).map(mix).collect(), ..front.clone() }
}

#[test]
fn front_half_over_back_half_is_the_whole() {
    let cut = |scene: &Scene<'_>, from: f64, to: f64| {
        let mut part = scene.clone();
        part.clip = AxisBox { min: DVec3::new(from, 0.0, 0.0), max: DVec3::new(to, 1.0, 1.0) };
        render(&part).expect("the scene makes sense")
    };
    // Along x the cut falls between two steps, so that no step is shared.
    let volume_of_noise = noisy();
    let mut scene = shaded(&volume_of_noise, Camera { eye: DVec3::new(-3.0, 0.3, 0.3), ..along_x(0.3, 0.3) });
    scene.step = volume_of_noise.mean_spacing() / 3.0;
    assert_equal(&over(&cut(&scene, 0.0, 0.375), &cut(&scene, 0.375, 1.0)), &image(&scene), 1e-12);
    // In a homogeneous volume the lattice does not matter: any cut, any view.
    let homogeneous = volume(DIMS, volume_of_noise.index_to_world, |_| 0.6);
    let scene = Scene { volume: &homogeneous, ..shaded(&volume_of_noise, camera()) };
    assert_equal(&over(&cut(&scene, 0.377, 1.0), &cut(&scene, 0.0, 0.377)), &image(&scene), 1e-12);
}

#[test]
fn transparent_padding_changes_nothing() {
    // The two outermost layers of voxels are transparent themselves: otherwise padding changes the field between them and
    // the padding, and the gradients next to them.
    let rim = |p: DVec3| {
        let index = p * 8.0 - 0.5;
        let rim = index.cmplt(DVec3::splat(1.5)).any() || index.cmpgt(DVec3::new(5.5, 3.5, 2.5)).any();
        if rim { 0.0 } else { noise(p) }
    };
    let original = volume(DIMS, noisy().index_to_world, rim);
    let padded_to_world = original.index_to_world * DAffine3::from_translation(DVec3::splat(-2.0));
    let padded = volume(DIMS.map(|n| n + 4), padded_to_world, rim);
    let along = Camera { eye: DVec3::new(-3.0, 0.3, 0.3), ..along_x(0.3, 0.3) };
    // The padding is whole steps deep.
    let step = 0.5 * original.mean_spacing();
    let whole = |volume| Scene { step, reference_length: 0.05, ..shaded(volume, along) };
    let expected = image(&whole(&original));
    assert_equal(&image(&whole(&padded)), &expected, 1e-12);
    // Seen through a window onto the original.
    let low = DVec3::splat(2.0) / padded.dims_f64();
    let clip = AxisBox { min: low, max: DVec3::ONE - low };
    assert_equal(&image(&Scene { clip, ..whole(&padded) }), &expected, 1e-12);
}

/// A clip and a near plane shorten the segments they cut and leave all others where they were, to the last bit.
#[test]
fn cuts_move_no_samples() {
    let dims = [32, 24, 20];
    let to_world = filling(dims, DVec3::ZERO, DVec3::new(1.0, 0.75, 0.625));
    let clip = AxisBox { min: DVec3::new(0.11, 0.07, 0.23), max: DVec3::new(0.83, 0.91, 0.77) };
    let forward = (camera().focus - camera().eye).normalize();
    let near = 0.95 * (camera().focus - camera().eye).length();
    // What is visible keeps away from the cuts, so that they cut transparent segments only.
    let margin = 0.06;
    let [low, high] = [clip.min, clip.max].map(|corner| corner * DVec3::new(1.0, 0.75, 0.625));
    let visible = |p: DVec3| {
        let within = p.cmpge(low + margin).all() && p.cmple(high - margin).all();
        within && (p - camera().eye).dot(forward) > near + margin
    };
    let volume = volume(dims, to_world, |p| if visible(p) { 0.2 + noise(p) } else { 0.0 });
    let mut scene = shaded(&volume, camera());
    (scene.shading, scene.jitter, scene.sampling) = (None, Some(7), Sampling::Nearest);
    let whole = image(&scene);
    let behind = Camera { near: Some(near), ..camera() };
    for (clip, camera) in [(clip, camera()), (AxisBox::UNIT, behind), (clip, behind)] {
        assert_eq!(image(&Scene { clip, camera, ..scene.clone() }).color, whole.color);
    }
}

#[test]
fn rectangles_are_parts_of_the_whole() {
    let volume = noisy();
    let scene = shaded(&volume, camera());
    let renderer = Renderer::new(&scene).expect("the scene makes sense");
    let render = |part| renderer.render(part, &unattended);
    let whole = render(None).expect("the scene makes sense");
    let part = render(Some(Rectangle { x: 5, y: 7, width: 9, height: 6 })).expect("a part");
    for (y, x) in (0..6).flat_map(|y| (0..9).map(move |x| (y, x))) {
        assert_eq!(part.pixel(x, y), whole.pixel(x + 5, y + 7));
    }
    assert!(render(Some(Rectangle { x: 20, y: 0, width: 5, height: 1 })).is_err());
    assert!(render(Some(Rectangle { x: 0, y: u32::MAX, width: 1, height: 2 })).is_err());
    assert!(whole.color.iter().zip(&whole.depth).all(|(c, &d)| (c[3] == 0.0) == (d == MISS)));
}

#[test]
fn opacity_grows_with_density() {
    let volume = noisy();
    let mut scene = shaded(&volume, camera());
    let mut previous = image(&scene);
    for reference_length in [0.1, 0.05, 0.01] {
        scene.reference_length = reference_length;
        let denser = image(&scene);
        assert!(denser.color.iter().zip(&previous.color).all(|(a, b)| a[3] >= b[3]));
        previous = denser;
    }
}

#[test]
fn senseless_scenes_are_refused() {
    let volume = noisy();
    let good = shaded(&volume, camera());
    let senseless = [
        Scene { channel: 1, ..good.clone() },
        Scene { size: [0, 4], ..good.clone() },
        Scene { step: 0.0, ..good.clone() },
        Scene { step: f64::INFINITY, ..good.clone() },
        Scene { reference_length: f64::NAN, ..good.clone() },
        Scene { early_termination: Some(-1.0), ..good.clone() },
    ];
    for scene in senseless {
        let error = render(&scene).expect_err("the scene makes no sense").to_string();
        assert!(error.ends_with('.') && error.contains(':'), "{error}");
    }
}
