//! Bricks, distances, histograms, splines and gradients against brute force.

use glam::{DAffine3, DVec3};
use proptest::prelude::*;
use rayloom_volume::{
    MinMaxBricks, Operator, TransferFunction, ValueRange, Volume, VolumeRole, Voxels, bspline_coefficients,
    distance_map, gradient_volume, histogram, histogram_2d,
};

/// Numbers without pattern in 0 .. 1, the same for the same seed.
fn noise(count: usize, seed: u64) -> Vec<f32> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 40) as f32 / (1 << 24) as f32
    };
    (0..count).map(|_| next()).collect()
}

fn volume(dims: [u32; 3], channels: u32, voxels: Voxels) -> Volume {
    Volume::new("", dims, channels, voxels, DAffine3::from_scale(DVec3::new(1.0, 2.0, 0.5))).unwrap()
}

fn noise_volume(dims: [u32; 3], channels: u32, seed: u64) -> Volume {
    volume(dims, channels, Voxels::F32(noise((dims.iter().product::<u32>() * channels) as usize, seed)))
}

/// Trilinear interpolation at a position in voxels from the corner of the volume, clamped to the outermost centres.
fn trilinear(volume: &Volume, channel: u32, position: [f64; 3]) -> f64 {
    let centre = |axis: usize| (position[axis] - 0.5).clamp(0.0, f64::from(volume.dims[axis] - 1));
    let mut sum = 0.0;
    for corner in 0..8_u32 {
        let (mut index, mut weight) = ([0; 3], 1.0);
        for (axis, i) in index.iter_mut().enumerate() {
            let (c, up) = (centre(axis), corner >> axis & 1);
            let fraction = c - c.floor();
            *i = (c.floor() as u32 + up).min(volume.dims[axis] - 1);
            weight *= if up == 1 { fraction } else { 1.0 - fraction };
        }
        if weight > 0.0 {
            sum += weight * volume.finite_value(index, channel);
        }
    }
    sum
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn bricks_hold_every_interpolated_value(
        dims in [1..14_u32, 1..14_u32, 1..14_u32], channels in 1..=2_u32, size in 1..6_u32, apron in 0..3_u32, seed: u64, slope in prop_oneof![Just(-2.0), Just(3.0)],
    ) {
        let mut values = noise((dims.iter().product::<u32>() * channels) as usize, seed);
        for (i, special) in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY].into_iter().enumerate() {
            let at = (seed as usize).wrapping_mul(i + 1) % values.len();
            values[at] = special;
        }
        let volume = volume(dims, channels, Voxels::F32(values)).with_rescale(slope, 1.0).unwrap();
        let channel = channels - 1;
        let bricks = MinMaxBricks::build(&volume, channel, size, apron);
        prop_assert_eq!(bricks.grid, dims.map(|n| n.div_ceil(size)));
        let points = noise(64 * 3, seed ^ 1);
        for z in 0..bricks.grid[2] { for y in 0..bricks.grid[1] { for x in 0..bricks.grid[0] {
            let range = bricks.range([x, y, z]);
            for point in points.chunks(3) {
                let corner = [x, y, z].map(|b| f64::from(b * size));
                let reach = f64::from(size + 2 * apron);
                let position = std::array::from_fn(|axis| corner[axis] - f64::from(apron) + reach * f64::from(point[axis]));
                let value = trilinear(&volume, channel, position);
                prop_assert!(range.min - 1e-9 <= value && value <= range.max + 1e-9, "{value} outside of {range:?}");
            }
        }}}
    }

    #[test]
    fn distances_are_those_of_brute_force(grid in [1..12_u32, 1..9_u32, 1..10_u32], density in 0.0..0.2_f32, seed: u64) {
        let occupied: Vec<u8> = noise(grid.iter().product::<u32>() as usize, seed).iter().map(|&v| u8::from(v < density)).collect();
        let at = |i: usize| [i as u32 % grid[0], i as u32 / grid[0] % grid[1], i as u32 / grid[0] / grid[1]];
        let found = distance_map(&occupied, grid);
        for (i, &distance) in found.iter().enumerate() {
            let others = (0..occupied.len()).filter(|&j| occupied[j] != 0);
            let nearest = others.map(|j| (0..3).map(|a| at(i)[a].abs_diff(at(j)[a])).max().unwrap_or(0)).min();
            prop_assert_eq!(u32::from(distance), nearest.unwrap_or(255).min(255));
        }
    }

    #[test]
    fn splines_pass_through_the_voxels(dims in [1..40_u32, 1..12_u32, 1..36_u32], seed: u64) {
        let volume = noise_volume(dims, 1, seed);
        let coefficients = bspline_coefficients(&volume, 0);
        let [nx, ny, nz] = dims.map(|n| n as i64);
        let mirrored = |i: i64, n: i64| if n == 1 { 0 } else { (n - 1) - ((n - 1) - i.abs()).abs() };
        let weights = [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0];
        let expected = volume.normalised(0);
        for (at, &value) in expected.iter().enumerate().step_by(7) {
            let (i, j, k) = (at as i64 % nx, at as i64 / nx % ny, at as i64 / nx / ny);
            let mut sum = 0.0;
            for c in 0..3 { for b in 0..3 { for a in 0..3 {
                let index = (mirrored(k + c - 1, nz) * ny + mirrored(j + b - 1, ny)) * nx + mirrored(i + a - 1, nx);
                sum += weights[a as usize] * weights[b as usize] * weights[c as usize] * f64::from(coefficients[index as usize]);
            }}}
            prop_assert!((sum - f64::from(value)).abs() < 3e-6, "{sum} instead of {value} at {i} {j} {k} of {dims:?}");
        }
    }
}

#[test]
fn distances_stop_at_255_and_cross_the_whole_grid() {
    assert_eq!(distance_map(&[0; 8], [2, 2, 2]), [255; 8]);
    let mut far = vec![0; 300];
    far[0] = 1;
    let distances = distance_map(&far, [300, 1, 1]);
    assert!((0..300).all(|i| usize::from(distances[i]) == i.min(255)));
    assert_eq!(distance_map(&far, [1, 300, 1]), distances);
    assert_eq!(distance_map(&far, [1, 1, 300]), distances);
}

#[test]
fn occupancy_asks_about_every_brick() {
    let ramp: Vec<u8> = (0..64).map(|i| i as u8).collect();
    let bricks = MinMaxBricks::build(&volume([64, 1, 1], 1, Voxels::U8(ramp)), 0, 8, 0);
    assert_eq!(bricks.range([1, 0, 0]), ValueRange::new(7.0, 16.0));
    assert_eq!(bricks.occupancy(|min, max| min <= 30.0 && 30.0 <= max), [0, 0, 0, 1, 0, 0, 0, 0]);
    let nothing = TransferFunction::default();
    assert_eq!(bricks.occupancy(|min, max| !nothing.transparent_between(min, max)), [0; 8]);
}

#[test]
fn linear_fields_have_one_gradient_borders_included() {
    let slope = [3.0, -2.0, 0.5];
    for dims in [[5, 4, 3], [2, 2, 2], [1, 6, 2]] {
        let [nx, ny, nz] = dims;
        let index = move |at: u32| [at % nx, at / nx % ny, at / nx / ny];
        let value = |at: u32| (0..3).map(|axis| slope[axis] * f64::from(index(at)[axis])).sum::<f64>();
        let linear =
            volume(dims, 1, Voxels::F64((0..nx * ny * nz).map(value).collect())).with_rescale(2.0, 1.0).unwrap();
        for operator in [Operator::CentralDifferences, Operator::Sobel] {
            let gradients = gradient_volume(&linear, 0, operator).unwrap();
            assert_eq!((gradients.role, gradients.channels), (VolumeRole::GradientAndValue, 4));
            for at in 0..nx * ny * nz {
                let found: Vec<f64> = (0..4).map(|channel| gradients.value(index(at), channel)).collect();
                let expected: Vec<f64> =
                    (0..3).map(|axis| if dims[axis] > 1 { 2.0 * slope[axis] } else { 0.0 }).collect();
                assert_eq!(found[..3], expected, "{operator:?} at {:?} of {dims:?}", index(at));
                assert_eq!(found[3], linear.value(index(at), 0));
            }
        }
    }
}

#[test]
fn central_differences_of_a_cube_err_by_one() {
    let cubes = volume([6, 1, 1], 1, Voxels::F64((0..6).map(|i| f64::from(i * i * i)).collect()));
    let gradients = gradient_volume(&cubes, 0, Operator::CentralDifferences).unwrap();
    for i in 1..5 {
        assert_eq!(gradients.value([i, 0, 0], 0), f64::from(3 * i * i) + 1.0);
    }
}

#[test]
fn histograms_count_every_finite_voxel() {
    let values = vec![0.0, 1.0, 1.5, 2.0, 4.0, f32::NAN, 3.999, f32::INFINITY];
    let counts = histogram(&volume([8, 1, 1], 1, Voxels::F32(values)), 0, 4);
    assert_eq!((counts.range, counts.counts), (ValueRange::new(0.0, 4.0), vec![1, 2, 1, 2]));
    assert_eq!(histogram(&volume([3, 1, 1], 1, Voxels::U8(vec![9; 3])), 0, 3).counts, [3, 0, 0]);

    let two_channels = volume([3, 1, 1], 2, Voxels::U8(vec![0, 10, 1, 20, 2, 30]));
    assert_eq!(histogram(&two_channels, 1, 2).counts, [1, 2]);

    // 2 data units a voxel along y, where a voxel is 2 world units long, and nothing elsewhere: magnitude 1 everywhere.
    let ramp = volume([2, 4, 2], 1, Voxels::U8((0..16).map(|at| 2 * (at / 2 % 4)).collect()));
    let plane = histogram_2d(&ramp, 0, [4, 3]);
    assert_eq!(plane.gradient_max, 1.0);
    assert_eq!(plane.counts, [0, 0, 0, 0, 0, 0, 0, 0, 4, 4, 4, 4]);
}
