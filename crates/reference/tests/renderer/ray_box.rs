//! Rays through the box: every direction, every place to start from, extreme shapes and sizes.

use crate::scenes::*;
use glam::{DAffine3, DMat3, DVec3};
use rayloom_reference::closed_forms::homogeneous_opacity;
use rayloom_reference::ray::{AxisBox, Ray};
use rayloom_reference::same_samples::{Renderer, render};
use rayloom_reference::{Camera, Scene};

/// The directions to the faces, edges and corners of a cube.
fn directions() -> impl Iterator<Item = DVec3> {
    let component = |n: i32, place: i32| f64::from(n / place % 3 - 1);
    (0..27).map(move |n| DVec3::new(component(n, 1), component(n, 3), component(n, 9))).filter(|d| *d != DVec3::ZERO)
}

#[test]
fn clipping_agrees_with_trying_every_point() {
    // Origins and directions are multiples of one half and one, so a ray enters and leaves at multiples of one half: trying
    // quarter steps finds the ends without any formula.
    let places = [-1.0, 0.0, 0.5, 1.0, 2.0];
    let inside = |p: DVec3| p.cmpge(DVec3::ZERO).all() && p.cmple(DVec3::ONE).all();
    for n in 0..125 {
        let origin = DVec3::new(places[n % 5], places[n / 5 % 5], places[n / 25]);
        for direction in directions() {
            for start in [0.0, -4.0] {
                let ray = Ray { origin, direction, start };
                let tried: Vec<f64> =
                    (0..=32).map(|i| f64::from(i) * 0.25 - 4.0).filter(|&t| t >= start && inside(ray.at(t))).collect();
                let found = AxisBox::UNIT.clip(&ray).map(|segment| (segment.from, segment.to));
                let expected = (tried.len() > 1).then(|| (tried[0], tried[tried.len() - 1]));
                assert_eq!(found, expected, "{ray:?}");
            }
        }
    }
}

#[test]
fn ends_lie_in_the_box_whatever_the_rounding() {
    for direction in directions() {
        for distance in [1.0, 1e4, 1e9] {
            let toward = direction + DVec3::new(1e-3, -2e-3, 3e-3);
            let ray = Ray { origin: DVec3::splat(0.5) - distance * toward, direction: toward, start: 0.0 };
            let segment = AxisBox::UNIT.clip(&ray).expect("the ray aims at the centre");
            for end in [segment.entry, segment.exit] {
                assert!(end.cmpge(DVec3::ZERO).all() && end.cmple(DVec3::ONE).all());
                // On a face, to rounding.
                let from_face = end.min(DVec3::ONE - end).min_element();
                assert!(from_face <= 1e-15 * distance, "{from_face}");
            }
        }
    }
    let tiny = Ray { origin: DVec3::new(0.0, 0.5, -1.0), direction: DVec3::new(5e-324, -5e-324, 1.0), start: 0.0 };
    assert_eq!(AxisBox::UNIT.clip(&tiny).map(|s| (s.from, s.to)), Some((1.0, 2.0)));
    let nothing = AxisBox { min: DVec3::splat(0.6), max: DVec3::splat(0.4) };
    let ray = Ray { origin: DVec3::splat(0.5), direction: DVec3::X, start: f64::NEG_INFINITY };
    assert_eq!(nothing.clip(&ray), None);
}

/// Length of the line through the centre of a box, with unit `direction`, from a box of these half `extents`.
fn half_chord(extents: DVec3, direction: DVec3) -> f64 {
    let reach = [0, 1, 2].map(|i| if direction[i] == 0.0 { f64::INFINITY } else { extents[i] / direction[i].abs() });
    reach.into_iter().fold(f64::INFINITY, f64::min)
}

#[test]
fn homogeneous_boxes_from_everywhere() {
    let shapes = [
        ([1, 1, 1], DVec3::ONE),
        ([256, 256, 1], DVec3::ONE),
        ([4, 5, 6], DVec3::new(1.0, 1.0, 1000.0)),
        ([4, 5, 6], DVec3::new(-1.0, 1.0, 0.5)),
    ];
    for (dims, spacing) in shapes {
        for size in [1e-9, 1.0, 1e9] {
            let to_world = DAffine3::from_mat3(DMat3::from_diagonal(spacing * size));
            let volume = volume(dims, to_world, |_| 1.0);
            let extents = 0.5 * (spacing.abs() * size * volume.dims_f64());
            let center = volume.texture_to_world().transform_point3(DVec3::splat(0.5));
            for toward in directions() {
                // From the outside through a corner, edge or face; from that very point; from the centre.
                let outward = extents * toward;
                let reach = half_chord(extents, outward.normalize());
                for (start, chord) in [(1e4, 2.0), (2.0, 2.0), (1.0, 2.0), (0.0, 1.0)] {
                    let eye = center + start * outward;
                    let up = if toward.x == 0.0 { DVec3::X } else { outward.any_orthogonal_vector() };
                    let mut camera = Camera { up, ..Camera::perspective(eye, center - outward, 40.0) };
                    let check = |camera: Camera, chord: f64| {
                        let mut scene = Scene::new(&volume, uniform([1.0; 3], 1.0), camera, [1, 1]);
                        scene.reference_length = reach;
                        scene.step /= 0.7;
                        let pixel = Renderer::new(&scene).expect("the scene makes sense").pixel(0, 0);
                        let expected = homogeneous_opacity(1.0, chord);
                        let found = pixel.color[3];
                        assert!(
                            (found - expected).abs() < 1e-9,
                            "{dims:?} {size} {toward} {start}: {found} {expected}"
                        );
                    };
                    check(camera, chord);
                    // A near plane through the centre leaves the far half.
                    camera.near = Some(start * outward.length());
                    check(camera, 1.0);
                    // An orthographic camera sees all of it from anywhere.
                    let height = outward.length();
                    check(
                        Camera {
                            projection: rayloom_reference::Projection::Orthographic { height },
                            near: None,
                            ..camera
                        },
                        2.0,
                    );
                }
            }
        }
    }
}

#[test]
fn whole_pictures_are_finite() {
    let dims = [256, 256, 1];
    let volume = volume(dims, filling(dims, DVec3::NEG_ONE, DVec3::new(1.0, 1.0, -0.99)), noise);
    // Within a face, along an edge, at a corner, inside, and far away.
    let eyes = [
        DVec3::new(0.0, 0.0, -1.0),
        DVec3::new(-1.0, -1.0, -0.995),
        DVec3::new(-1.0, -1.0, -1.0),
        DVec3::new(0.1, 0.2, -0.995),
        DVec3::new(2e4, 0.0, -0.99),
    ];
    for eye in eyes {
        let camera = Camera { up: DVec3::Z, ..Camera::perspective(eye, DVec3::new(0.3, 0.4, -0.993), 120.0) };
        let mut scene = Scene::new(&volume, colorful(), camera, [33, 32]);
        scene.shading = Some(rayloom_reference::shading::Shading::default());
        let image = render(&scene).expect("the scene makes sense");
        assert!(image.color.iter().flatten().all(|c| c.is_finite()));
        assert!(image.color.iter().all(|c| (0.0..=1.0).contains(&c[3])));
        assert!(image.depth.iter().all(|&d| d >= 0.0));
    }
}
