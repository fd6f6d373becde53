//! Generated volumes against their closed forms.

use glam::{DVec3, dvec3};
use rayloom_volume::{Field, generate};

#[test]
fn voxels_hold_the_closed_form_at_their_centres() {
    let extent = dvec3(2.0, 4.0, 6.0);
    for field in Field::EXAMPLES {
        let volume = generate(&field, [16, 8, 48], extent).unwrap();
        assert_eq!(volume.texture_to_world().transform_point3(DVec3::ZERO), -0.5 * extent);
        for index in [[0, 0, 0], [7, 3, 25], [15, 7, 47], [1, 5, 30]] {
            let world = volume.index_to_world.transform_point3(DVec3::from_array(index.map(f64::from)));
            let expected = field.value(world / (0.5 * extent)) as f32;
            let found = volume.value(index, 0) as f32;
            assert!(
                (found - expected).abs() <= 1e-5 * expected.abs().max(1e-3),
                "{}: {found} instead of {expected}",
                field.id()
            );
        }
    }
}

#[test]
fn gradients_are_the_derivatives_of_the_values() {
    let points = [dvec3(0.3, -0.21, 0.17), dvec3(-0.55, 0.4, 0.62), dvec3(0.05, 0.9, -0.33)];
    for field in Field::EXAMPLES {
        for p in points {
            let Some(gradient) = field.gradient(p) else { continue };
            let h = 1e-5;
            let numeric = DVec3::AXES.map(|axis| (field.value(p + h * axis) - field.value(p - h * axis)) / (2.0 * h));
            let error = (gradient - DVec3::from_array(numeric)).length();
            assert!(error < 1e-5 * (1.0 + gradient.length()), "{}: {gradient} instead of {numeric:?}", field.id());
        }
    }
}

#[test]
fn known_values_of_the_test_signals() {
    let signal = Field::MarschnerLobb { frequency: 6.0, alpha: 0.25 };
    for (p, expected) in
        [(DVec3::ZERO, 0.6), (DVec3::Z, 0.2), (-DVec3::Z, 1.0), (dvec3(0.5, 0.25, 0.1), 0.486_522_727_9)]
    {
        assert!((signal.value(p) - expected).abs() < 1e-10);
    }
    // Probabilities sum to one.
    for field in [Field::Hydrogen1s { bohr: 0.1 }, Field::Hydrogen2p { bohr: 0.06 }, Field::Hydrogen3d { bohr: 0.035 }]
    {
        let n = 100;
        let at = |i: usize| (2 * i + 1) as f64 / n as f64 - 1.0;
        let sum: f64 = (0..n * n * n).map(|i| field.value(dvec3(at(i % n), at(i / n % n), at(i / n / n)))).sum();
        let total = sum * 8.0 / (n as f64).powi(3);
        assert!((total - 1.0).abs() < 0.01, "{}: {total}", field.id());
    }
}

#[test]
fn the_bucky_ball_has_sixty_atoms_with_three_neighbours() {
    // Atoms far smaller than their distance: the value at an atom is its own.
    let ball = Field::BuckyBall { radius: 1.0, sigma: 0.01 };
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let corner = dvec3(0.0, 1.0, 3.0 * golden);
    assert!((ball.value(corner.normalize()) - 1.0).abs() < 1e-12);
    let total: f64 = {
        // The integral of sixty Gaussians, sampled finely enough.
        let soft = Field::BuckyBall { radius: 0.5, sigma: 0.1 };
        let n = 40;
        let at = |i: usize| (2 * i + 1) as f64 / n as f64 * 1.2 - 1.2;
        let sum: f64 = (0..n * n * n).map(|i| soft.value(dvec3(at(i % n), at(i / n % n), at(i / n / n)))).sum();
        sum * (2.4 / n as f64).powi(3) / ((2.0 * std::f64::consts::PI).powf(1.5) * 0.001)
    };
    assert!((total - 60.0).abs() < 0.01, "{total}");
}

#[test]
fn grids_that_cannot_be_are_refused() {
    let field = Field::Ramp { axis: 0 };
    assert!(generate(&field, [0, 1, 1], DVec3::ONE).is_err());
    assert!(generate(&field, [u32::MAX; 3], DVec3::ONE).is_err());
    assert!(generate(&field, [2; 3], dvec3(1.0, 0.0, 1.0)).is_err());
    assert!(generate(&field, [2; 3], dvec3(1.0, f64::NAN, 1.0)).is_err());
}
