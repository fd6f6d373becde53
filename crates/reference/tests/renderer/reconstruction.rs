//! Orders of the reconstruction filters and gradient operators (T14, T15).

use crate::scenes::*;
use glam::{DAffine3, DMat3, DVec3};
use rayloom_reference::field::{Field, Sampling};
use rayloom_reference::gradient::GradientOperator;
use rayloom_volume::{Volume, Voxels};
use std::f64::consts::PI;

/// Field with zero slope at the outermost voxel centres, so that mirroring keeps it smooth.
fn waves(n: u32) -> Volume {
    let to_unit = DAffine3::from_mat3(DMat3::from_diagonal(DVec3::splat(1.0 / f64::from(n - 1))));
    volume([n; 3], to_unit, wave)
}

fn wave(p: DVec3) -> f64 {
    (PI * p.x).cos() * (2.0 * PI * p.y).cos() + (PI * p.z).cos()
}

/// Positions in 0..1 without structure.
fn positions(low: f64, high: f64) -> impl Iterator<Item = DVec3> {
    let golden = DVec3::new(0.819_172_513_396_164_4, 0.671_043_606_703_789_3, 0.549_700_477_901_970_3);
    (1..400).map(move |i| low + (high - low) * (golden * f64::from(i)).fract())
}

fn rms(errors: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = errors.fold((0.0, 0.0), |(sum, count), e| (sum + e * e, count + 1.0));
    f64::sqrt(sum / count)
}

#[test]
fn filters_have_their_orders() {
    for (sampling, order) in [
        (Sampling::Nearest, 1.0),
        (Sampling::Trilinear, 2.0),
        (Sampling::CatmullRom, 3.0),
        (Sampling::BSplinePrefiltered, 4.0),
    ] {
        let errors = [17, 33, 65].map(|n| {
            let field = Field::new(&waves(n), 0, sampling);
            // Only the B-spline keeps its order at the edge.
            let margin = if sampling == Sampling::BSplinePrefiltered { 0.0 } else { 0.1 };
            rms(positions(margin, 1.0 - margin).map(|p| field.at_index(p * field.last_center()) - wave(p)))
        });
        assert_order(&errors, order, 0.3);
    }
}

#[test]
fn interpolating_filters_pass_through_the_voxels() {
    let volume = volume([5, 1, 4], DAffine3::IDENTITY, noise);
    for sampling in [Sampling::Nearest, Sampling::Trilinear, Sampling::CatmullRom, Sampling::BSplinePrefiltered] {
        let field = Field::new(&volume, 0, sampling);
        for (i, k) in [(0, 0), (4, 3), (2, 1), (1, 3)] {
            let expected = volume.value([i, 0, k], 0);
            let center = DVec3::new(f64::from(i), 0.0, f64::from(k));
            assert!((field.at_index(center) - expected).abs() < 1e-14, "{sampling:?}");
            // Constant over the thin axis and beyond the outermost centres.
            assert!((field.at_index(center + DVec3::new(0.0, 0.4, 0.0)) - expected).abs() < 1e-14, "{sampling:?}");
        }
        assert_eq!(field.at_index(DVec3::new(-0.5, 0.0, 0.0)), field.at_index(DVec3::ZERO));
    }
}

#[test]
fn gradients_of_polynomials() {
    let index = DAffine3::IDENTITY;
    let linear = Field::new(&volume([6, 5, 1], index, |p| 2.0 * p.x - 3.0 * p.y), 0, Sampling::Trilinear);
    let quadratic = volume([9; 3], index, |p| p.x * p.x + 2.0 * p.y * p.y + 3.0 * p.z * p.z + p.x * p.y);
    let quadratic = Field::new(&quadratic, 0, Sampling::Trilinear);
    let cubic = Field::new(&volume([9; 3], index, |p| p.x.powi(3)), 0, Sampling::Trilinear);
    use GradientOperator::*;
    for operator in [Central, Forward, Backward, CentralFourth] {
        for p in [DVec3::ZERO, DVec3::new(5.4, -0.5, 0.3), DVec3::new(2.2, 3.9, -0.2), DVec3::new(4.7, 0.2, 0.0)] {
            let found = operator.gradient(&linear, p);
            assert!(found.abs_diff_eq(DVec3::new(2.0, -3.0, 0.0), 1e-12), "{operator:?} at {p}: {found}");
        }
    }
    let p = DVec3::new(3.0, 4.0, 5.0);
    let exact = DVec3::new(2.0 * 3.0 + 4.0, 4.0 * 4.0 + 3.0, 6.0 * 5.0);
    assert_eq!(Central.gradient(&quadratic, p), exact);
    assert_eq!(Forward.gradient(&quadratic, p), exact + DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(Backward.gradient(&quadratic, p), exact - DVec3::new(1.0, 2.0, 3.0));
    // Central differences of x³ are off by exactly h².
    assert_eq!(Central.gradient(&cubic, p).x, 27.0 + 1.0);
    assert!((CentralFourth.gradient(&cubic, p).x - 27.0).abs() < 1e-12);
}

#[test]
fn central_differences_commute_with_trilinear_interpolation() {
    let volume_of_noise = volume([8; 3], DAffine3::IDENTITY, noise);
    let field = Field::new(&volume_of_noise, 0, Sampling::Trilinear);
    let component = |axis: usize| {
        let gradient = |p: DVec3| GradientOperator::Central.gradient(&field, p)[axis];
        Field::new(&volume([8; 3], DAffine3::IDENTITY, gradient), 0, Sampling::Trilinear)
    };
    let components = [0, 1, 2].map(component);
    for p in positions(1.0, 6.0) {
        let stored = DVec3::from_array([0, 1, 2].map(|axis| components[axis].at_index(p)));
        assert!(stored.abs_diff_eq(GradientOperator::Central.gradient(&field, p), 1e-14));
    }
}

#[test]
fn broken_voxels_are_replaced() {
    let values = vec![1.0, f64::NAN, f64::INFINITY, 3.0, f64::NEG_INFINITY];
    let volume = Volume::new("broken", [5, 1, 1], 1, Voxels::F64(values), DAffine3::IDENTITY).expect("a volume");
    for sampling in [Sampling::Trilinear, Sampling::BSplinePrefiltered] {
        let field = Field::new(&volume, 0, sampling);
        let found = [0, 1, 2, 3, 4].map(|i| field.at_index(DVec3::new(f64::from(i), 0.0, 0.0)));
        assert!(found.iter().zip([1.0, 1.0, 3.0, 3.0, 1.0]).all(|(a, b)| (a - b).abs() < 1e-14), "{found:?}");
    }
}
