//! The volume itself: checks, ranges, values that are not finite.

use glam::{DAffine3, DVec3};
use rayloom_volume::{
    ElementType, Gaps, Operator, ValueRange, Volume, VolumeError, VolumeRole, Voxels, fraction, gradient_volume,
};

use crate::files::{DIMS, voxels};

fn line(values: Vec<f64>) -> Volume {
    Volume::new("line", [values.len() as u32, 1, 1], 1, Voxels::F64(values), DAffine3::IDENTITY).unwrap()
}

#[test]
fn what_cannot_be_a_volume_is_refused() {
    let build = |dims, channels, length, transform| {
        Volume::new("", dims, channels, Voxels::U8(vec![0; length]), transform).map(drop)
    };
    let identity = DAffine3::IDENTITY;
    assert_eq!(build([1, 0, 1], 1, 0, identity), Err(VolumeError::NoVoxels([1, 0, 1])));
    assert_eq!(build([1; 3], 5, 5, identity), Err(VolumeError::Channels(5)));
    assert_eq!(build([2; 3], 1, 7, identity), Err(VolumeError::Length { expected: 8, found: 7 }));
    assert!(matches!(build([u32::MAX; 3], 4, 0, identity), Err(VolumeError::TooLarge { .. })));
    for scale in [DVec3::new(1.0, 0.0, 1.0), DVec3::new(1.0, f64::NAN, 1.0), DVec3::splat(f64::INFINITY)] {
        assert!(matches!(build([1; 3], 1, 1, DAffine3::from_scale(scale)), Err(VolumeError::Transform { .. })));
    }
    for scale in [1e-9, 1e9, -1.0] {
        assert_eq!(build([1; 3], 1, 1, DAffine3::from_scale(DVec3::new(scale, 1.0, 10.0))), Ok(()));
    }
    assert!(line(vec![1.0]).with_rescale(0.0, 1.0).is_err() && line(vec![1.0]).with_rescale(1.0, f64::NAN).is_err());
    assert!(line(vec![1.0]).with_role(VolumeRole::GradientAndValue).is_err());
}

#[test]
fn ranges_of_every_type_and_channel() {
    for element in ElementType::ALL {
        for channels in 1..=4 {
            let volume = Volume::new("", DIMS, channels, voxels(element, channels), DAffine3::IDENTITY).unwrap();
            for channel in 0..channels {
                let stored = (0..24).map(|voxel| volume.voxels.stored(voxel * channels as usize + channel as usize));
                let expected = stored
                    .fold(ValueRange::new(f64::MAX, f64::MIN), |r, v| ValueRange::new(r.min.min(v), r.max.max(v)));
                assert_eq!(volume.ranges()[channel as usize], expected, "{element} x {channels}");
            }
        }
    }
}

#[test]
fn values_that_are_not_finite_stay_out_of_range_and_sight() {
    let volume = line(vec![f64::NAN, 3.0, f64::INFINITY, -5.0, f64::NEG_INFINITY]);
    assert_eq!((volume.ranges(), volume.non_finite()), (&[ValueRange::new(-5.0, 3.0)][..], 3));
    let shown: Vec<_> = (0..5).map(|i| volume.finite_value([i, 0, 0], 0)).collect();
    assert_eq!(shown, [-5.0, 3.0, 3.0, -5.0, -5.0]);
    assert_eq!(volume.normalised(0), [0.0, 1.0, 1.0, 0.0, 0.0]);

    let turned = volume.with_rescale(-2.0, 1.0).unwrap();
    assert_eq!(turned.ranges(), [ValueRange::new(-5.0, 11.0)]);
    assert_eq!(turned.normalised(0), [0.0, 0.0, 0.0, 1.0, 1.0]);

    let nothing = line(vec![f64::NAN; 3]);
    assert_eq!((nothing.ranges(), nothing.non_finite()), (&[ValueRange::new(0.0, 0.0)][..], 3));
    assert_eq!(nothing.normalised(0), [0.0; 3]);
}

#[test]
fn gaps_are_the_cells_at_voxels_without_value() {
    let mut values = vec![1.0; 60];
    values[(2 * 4 + 1) * 5 + 3] = f64::NAN;
    let volume = Volume::new("gap", [5, 4, 3], 1, Voxels::F64(values), DAffine3::IDENTITY).unwrap();
    let gaps = Gaps::of(&volume, 0).unwrap();
    let touched = |index: [f64; 3]| gaps.contains(index);
    assert_eq!(gaps.cells.iter().filter(|&&cell| cell == 1).count(), 8);
    assert!(touched([2.0, 0.0, 1.0]) && touched([3.99, 1.99, 2.4]) && touched([2.5, -0.4, 1.5]));
    assert!(
        !touched([1.99, 0.5, 1.5])
            && !touched([4.0, 0.5, 1.5])
            && !touched([2.5, 2.0, 1.5])
            && !touched([2.5, 0.5, 0.99])
    );
    assert_eq!(Gaps::of(&line(vec![1.0, f64::INFINITY]), 0), None);
    // A gradient volume keeps what has no value.
    let gradients = gradient_volume(&volume, 0, Operator::CentralDifferences).unwrap();
    assert_eq!(Gaps::of(&gradients, 3), Some(gaps));
    assert!(Gaps::of(&gradients, 0).is_none());
}

#[test]
fn normalising_survives_extreme_ranges() {
    assert_eq!(line(vec![4.0; 5]).normalised(0), [0.0; 5]);
    assert_eq!(line(vec![1e-310, 2e-310, 3e-310]).normalised(0), [0.0, 0.5, 1.0]);
    assert_eq!(line(vec![f64::MIN, 0.0, f64::MAX]).normalised(0), [0.0, 0.5, 1.0]);
    let beyond_f32 = line(vec![16_777_216.0, 16_777_217.0, 16_777_218.0]);
    assert_eq!(beyond_f32.normalised(0), [0.0, 0.5, 1.0]);
    assert_eq!(fraction(1.0, 2.0, 2.0), 0.0);
}

/// E21: positions beyond 2^31. Zeros are not touched by anything but the search for the range, so they take no memory.
#[test]
fn voxels_beyond_the_31st_bit_are_found() {
    let dims = [2048, 2048, 513];
    let mut voxels = vec![0_u8; 2048 * 2048 * 513];
    if let Some(last) = voxels.last_mut() {
        *last = 200;
    }
    let volume = Volume::new("large", dims, 1, Voxels::U8(voxels), DAffine3::IDENTITY).unwrap();
    let corner = [2047, 2047, 512];
    assert!(volume.position(corner, 0) > 1 << 31);
    assert_eq!((volume.value(corner, 0), volume.value([2046, 2047, 512], 0)), (200.0, 0.0));
    assert_eq!(volume.ranges(), [ValueRange::new(0.0, 200.0)]);
}

#[test]
fn the_box_lies_half_a_voxel_around_the_centres() {
    let transform =
        DAffine3::from_translation(DVec3::new(10.0, 20.0, 30.0)) * DAffine3::from_scale(DVec3::new(2.0, -3.0, 4.0));
    let volume = Volume::new("", DIMS, 1, voxels(ElementType::U8, 1), transform).unwrap();
    let corner = |u: f64| volume.texture_to_world().transform_point3(DVec3::splat(u));
    assert_eq!(corner(0.0), DVec3::new(9.0, 21.5, 28.0));
    assert_eq!(corner(1.0), DVec3::new(15.0, 15.5, 44.0));
    assert_eq!(volume.spacing(), DVec3::new(2.0, 3.0, 4.0));
}
