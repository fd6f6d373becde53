//! The exact renderer against a march in tiny steps, written without any of its ideas.

use crate::scenes::*;
use glam::{DAffine3, DMat3, DVec3};
use rayloom_reference::field::{Field, Sampling};
use rayloom_reference::ray::AxisBox;
use rayloom_reference::{Camera, Classification, Labels, Scene, exact};
use rayloom_volume::{Knot, Label, LabelTable, TransferFunction, Volume};
use std::sync::Arc;

/// Small reproducible random numbers in 0..1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mixed = (self.0 ^ (self.0 >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        (mixed >> 11) as f64 / (1u64 << 53) as f64
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn direction(&mut self) -> DVec3 {
        let v = DVec3::new(self.within(-1.0, 1.0), self.within(-1.0, 1.0), self.within(-1.0, 1.0));
        v.normalize_or(DVec3::X)
    }
}

/// A few waves in random directions: smooth over a voxel or two, values in 0..1.
fn waves(random: &mut Random) -> impl Fn(DVec3) -> f64 + use<> {
    let terms: Vec<_> =
        (0..4).map(|_| (random.direction() * random.within(3.0, 14.0), random.within(0.0, 6.0))).collect();
    move |p| 0.5 + terms.iter().map(|(k, phase)| (k.dot(p) + phase).sin()).sum::<f64>() / 8.0
}

/// Straight lines between random knots, with jumps, and a spike about a thousandth wide.
fn transfer_function(random: &mut Random) -> TransferFunction {
    let mut at: Vec<f64> = (0..6).map(|_| random.within(0.05, 0.95)).collect();
    at.sort_by(f64::total_cmp);
    let mut side = |opaque: f64| ([random.next(), random.next(), random.next()], opaque * random.next());
    let mut knots = vec![];
    for (i, &at) in at.iter().enumerate() {
        knots.push(match i {
            0 => Knot::split(at, side(0.0), side(0.4)),
            2 => Knot::split(at, side(0.9), side(0.2)),
            _ => Knot::split(at, side(0.5), side(0.5)),
        });
        if i == 3 {
            let (color, opacity) = side(0.9);
            knots.push(Knot::split(at + 1e-3, (color, opacity), side(0.3)));
        }
    }
    knots.sort_by(|a, b| a.at.total_cmp(&b.at));
    TransferFunction { knots }
}

/// A label for each voxel of a grid of its own, and transfer functions for some of them.
fn labels(random: &mut Random) -> Labels {
    let dims = [4, 9, 6];
    let to_world = filling(dims, DVec3::ZERO, DVec3::ONE);
    let volume = Arc::new(volume(dims, to_world, |p| (5.0 * noise(p)).floor()));
    let label = |random: &mut Random| Label { name: String::new(), transfer_function: transfer_function(random) };
    let labels = [0, 1, 3, 4, 9].map(|number| (number, label(random))).into();
    Labels { volume, table: LabelTable { labels } }
}

/// Colour and optical depth of one ray, marched by midpoints.
struct March<'a> {
    scene: &'a Scene<'a>,
    field: Field,
    entry: DVec3,
    span: DVec3,
    /// Length of the way in reference lengths.
    length: f64,
    depth: f64,
    color: [f64; 3],
    /// Steps to a cell, and to a piece of the transfer function, at least.
    rate: f64,
}

impl March<'_> {
    fn value(&self, fraction: f64) -> f64 {
        self.field.at_texture(self.entry + self.span * fraction)
    }

    /// The transfer function at a place; `None` for a label without one.
    fn function(&self, fraction: f64) -> Option<&TransferFunction> {
        match &self.scene.classification {
            Classification::Function(function) => Some(function),
            Classification::Labels(Labels { volume, table }) => {
                let place = (self.entry + self.span * fraction) * volume.dims_f64();
                let label = volume.value(place.floor().as_uvec3().to_array(), 0);
                table.labels.get(&(label as u32)).map(|label| &label.transfer_function)
            }
        }
    }

    /// Whether the transfer function is all but straight between two values: one piece, and little of it. A march without
    /// this much sense would need steps far below d/256 to see a jump or a spike in place.
    fn is_straight(&self, function: &TransferFunction, a: f64, b: f64) -> bool {
        let knots = &function.knots;
        let piece = |value: f64| knots.partition_point(|knot| knot.at <= value);
        let next = piece(a);
        let bounded = next > 0 && next < knots.len();
        next == piece(b) && (!bounded || (a - b).abs() < (knots[next].at - knots[next - 1].at) / self.rate)
    }

    /// One midpoint step; halved while the transfer function is not straight along it.
    fn step(&mut self, from: f64, to: f64, halvings: u32) {
        let middle = 0.5 * (from + to);
        let Some(function) = self.function(middle) else { return };
        if halvings > 0 && !self.is_straight(function, self.value(from), self.value(to)) {
            self.step(from, middle, halvings - 1);
            self.step(middle, to, halvings - 1);
            return;
        }
        let material = function.evaluate(self.value(middle));
        let depth = -(-material.opacity).ln_1p() * (to - from) * self.length;
        let weight = (-self.depth).exp() * -(-depth).exp_m1();
        for (sum, c) in self.color.iter_mut().zip(material.color) {
            *sum += weight * c;
        }
        self.depth += depth;
    }
}

/// The single pixel of a scene, marched in steps of a voxel over `rate` or less, which end where cells of the grid and labels do.
fn marched(scene: &Scene<'_>, rate: f64) -> [f64; 4] {
    let view = scene.camera.view(scene.size).expect("the camera makes sense");
    let to_world = scene.volume.texture_to_world();
    let segment = AxisBox::UNIT.clip(&view.ray(0, 0).transformed(&to_world.inverse())).expect("the ray hits");
    let span = segment.exit - segment.entry;
    let dims = scene.volume.dims_f64();
    let mut cuts = vec![0.0, 1.0];
    for axis in 0..3 {
        for voxel in 0..scene.volume.dims[axis] {
            cuts.push(((f64::from(voxel) + 0.5) / dims[axis] - segment.entry[axis]) / span[axis]);
        }
        if let Classification::Labels(Labels { volume, .. }) = &scene.classification {
            for face in 1..volume.dims[axis] {
                cuts.push((f64::from(face) / volume.dims_f64()[axis] - segment.entry[axis]) / span[axis]);
            }
        }
    }
    cuts.retain(|cut| (0.0..=1.0).contains(cut));
    cuts.sort_by(f64::total_cmp);
    let mut march = March {
        scene,
        field: Field::new(scene.volume, 0, scene.sampling),
        entry: segment.entry,
        span,
        length: to_world.transform_vector3(span).length() / scene.reference_length,
        depth: 0.0,
        color: [0.0; 3],
        rate,
    };
    for pair in cuts.windows(2) {
        // Every step is halved at twice the rate, as extrapolation asks for.
        let length = pair[1] - pair[0];
        for i in 0..rate as u32 {
            let at = |i: u32| pair[0] + length * f64::from(i) / rate;
            march.step(at(i), at(i + 1), 36);
        }
    }
    let [r, g, b] = march.color;
    [r, g, b, -(-march.depth).exp_m1()]
}

/// `(4 I(d/512) - I(d/256)) / 3`.
fn extrapolated(scene: &Scene<'_>) -> [f64; 4] {
    let (coarse, fine) = (marched(scene, 256.0), marched(scene, 512.0));
    std::array::from_fn(|i| (4.0 * fine[i] - coarse[i]) / 3.0)
}

/// The largest difference over a few rays through random data.
fn worst_of<C>(scene_number: u64, sampling: Sampling, classification: impl Fn(&mut Random) -> C) -> f64
where
    C: Into<Classification>,
{
    let mut random = Random(scene_number);
    let dims = [9, 7, 8];
    let mut to_world = filling(dims, DVec3::NEG_ONE, DVec3::new(1.0, 0.8, 0.9));
    to_world.matrix3 *= DMat3::from_cols(DVec3::X, DVec3::new(random.within(-0.3, 0.3), 1.0, 0.1), DVec3::Z);
    let volume: Volume =
        volume(dims, DAffine3::from_mat3_translation(to_world.matrix3, to_world.translation), waves(&mut random));
    let classification = classification(&mut random).into();
    let center = volume.texture_to_world().transform_point3(DVec3::splat(0.5));
    (0..4)
        .map(|_| {
            let aside = 0.3 * random.direction();
            let camera = Camera::perspective(center + aside + 4.0 * random.direction(), center + aside, 1.0);
            let mut scene = Scene::new(&volume, classification.clone(), camera, [1, 1]);
            (scene.sampling, scene.reference_length) = (sampling, 0.3);
            let found = exact::render(&scene).expect("the scene makes sense").pixel(0, 0);
            let expected = extrapolated(&scene);
            assert!(expected[3] > 0.01, "the ray meets something");
            (0..4).map(|i| (found[i] - expected[i]).abs()).fold(0.0, f64::max)
        })
        .fold(0.0, f64::max)
}

#[test]
fn twenty_random_scenes() {
    let worst = (1..=20).map(|n| worst_of(n, Sampling::Trilinear, transfer_function)).fold(0.0, f64::max);
    println!("worst difference {worst:e}");
    assert!(worst < 1e-8, "{worst:e}");
}

#[test]
fn random_labels() {
    let of = |n| worst_of(n, Sampling::Trilinear, |random| Classification::Labels(labels(random)));
    let worst = (31..=38).map(of).fold(0.0, f64::max);
    println!("worst difference {worst:e}");
    assert!(worst < 1e-8, "{worst:e}");
}

#[test]
fn smooth_transfer_functions() {
    let smooth = |random: &mut Random| {
        let mut knot = |at| Knot::new(at, [random.next(), random.next(), random.next()], 0.6 * random.next());
        TransferFunction { knots: vec![knot(-0.5), knot(1.5)] }
    };
    for sampling in [Sampling::Trilinear, Sampling::CatmullRom, Sampling::BSplinePrefiltered] {
        let worst = (21..=26).map(|n| worst_of(n, sampling, smooth)).fold(0.0, f64::max);
        println!("{sampling:?}: worst difference {worst:e}");
        assert!(worst < 1e-10, "{sampling:?}: {worst:e}");
    }
}
