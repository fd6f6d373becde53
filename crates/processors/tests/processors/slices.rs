//! The slice view against the field that it cuts.

use glam::DVec3;
use rayloom_network::{Outputs, Value};
use rayloom_processors::Data;
use rayloom_volume::{Knot, TransferFunction};

use crate::common::{assert_close, failure, picture, run, text, volume};

const SPACING: DVec3 = DVec3::new(1.0, 2.0, 4.0);

/// 8 x 8 x 8 voxels of 1 x 2 x 4 world units, whose value is i + 10 j + 100 k: 0 to 777.
fn digits() -> Data {
    volume([8; 3], SPACING, |i, j, k| i + 10.0 * j + 100.0 * k)
}

fn slice(changed: &[(&str, Value)], size: [u32; 2]) -> Outputs<Data> {
    run("slice_view", changed, &[("volume", digits())], size).expect("runs")
}

#[test]
fn slices_show_the_field_in_true_proportions() {
    // Across z the volume is 8 x 16 units: half the width of a square image. The middle lies between k = 3 and 4.
    let result = picture(&slice(&[], [64, 64]));
    for y in 0..64 {
        for x in 0..64 {
            let (right, up) = ((f64::from(x) + 0.5 - 32.0) / 4.0, (32.0 - f64::from(y) - 0.5) / 4.0);
            let (i, j) = ((right + 3.5).clamp(0.0, 7.0), (up / 2.0 + 3.5).clamp(0.0, 7.0));
            let gray = ((i + 10.0 * j + 350.0) / 777.0) as f32;
            let inside = right.abs() <= 4.0 && up.abs() <= 8.0;
            let expected = if inside { [gray, gray, gray, 1.0] } else { [0.0; 4] };
            assert_close(result.pixels[(y * 64 + x) as usize], expected, 2e-6);
        }
    }
}

#[test]
fn every_axis_has_its_slice_and_the_ends_belong_to_the_volume() {
    // Nearest voxels, window over one digit: the slice at the end is the outermost voxel.
    let at_window = |plane: &str, position: f64, window: [f64; 2]| {
        let properties = [
            ("plane", text(plane)),
            ("position", Value::Float(position)),
            ("interpolation", text("nearest")),
            ("automatic", Value::Bool(false)),
            ("window", Value::Vector(window.to_vec())),
        ];
        let result = picture(&slice(&properties, [64, 64]));
        let middle = result.pixels[32 * 64 + 32];
        (middle[0] * 1000.0).round()
    };
    let at = |plane: &str, position: f64| at_window(plane, position, [0.0, 1000.0]);
    // Just right of and below the middle: the upper of the two middle voxels to the right, the lower one upwards.
    assert_eq!([at("x", 0.0), at("x", 1.0)], [340.0, 347.0]);
    assert_eq!([at("y", 0.0), at("y", 1.0)], [304.0, 374.0]);
    assert_eq!([at("z", 0.0), at("z", 1.0)], [34.0, 734.0]);
    // A window whose first end is the larger one shows the negative.
    assert_eq!(at_window("z", 1.0, [1000.0, 0.0]), 1000.0 - 734.0);
}

#[test]
fn an_oblique_plane_shows_the_world() {
    // A field that is linear in the world and a plane across the diagonal, seen along it.
    let normal = DVec3::new(1.0, -1.0, 0.5).normalize();
    let properties = [
        ("plane", text("oblique")),
        ("normal", Value::Vector(normal.to_array().to_vec())),
        ("offset", Value::Float(1.5)),
        ("zoom", Value::Float(4.0)),
    ];
    let linear = |i: f64, j: f64, k: f64| DVec3::new(i, j, k) * SPACING;
    let weights = DVec3::new(0.3, 0.2, 0.1);
    let field = volume([8; 3], SPACING, |i, j, k| linear(i, j, k).dot(weights));
    let result = picture(&run("slice_view", &properties, &[("volume", field)], [32, 32]).expect("runs"));

    let center = linear(3.5, 3.5, 3.5) + normal * 1.5;
    let right = DVec3::Z.cross(normal).normalize();
    let up = normal.cross(right);
    let box_edges = SPACING * 8.0;
    let reach = |direction: DVec3| (direction.abs() * box_edges).element_sum();
    let pixel = reach(right).max(reach(up)) / 32.0 / 4.0;
    for (x, y) in [(0, 0), (16, 16), (31, 5), (9, 30)] {
        let p = center + right * (f64::from(x) + 0.5 - 16.0) * pixel + up * (16.0 - f64::from(y) - 0.5) * pixel;
        let gray = (p.dot(weights) / linear(7.0, 7.0, 7.0).dot(weights)) as f32;
        assert_close(result.pixels[(y * 32 + x) as usize], [gray, gray, gray, 1.0], 2e-5);
    }
}

#[test]
fn transfer_functions_color_the_slice() {
    let function = TransferFunction::new(vec![
        Knot::split(300.0, ([0.0; 3], 0.0), ([1.0, 0.5, 0.25], 0.5)),
        Knot::new(1000.0, [1.0, 0.5, 0.25], 0.5),
    ])
    .expect("valid");
    let colored = |colors: &str, position: f64| {
        let properties = [
            ("colors", text(colors)),
            ("transfer_function", Value::TransferFunction(function.clone())),
            ("position", Value::Float(position)),
        ];
        picture(&slice(&properties, [8, 8])).pixels[4 * 8 + 4]
    };
    // Half opaque for one reference length, premultiplied.
    assert_close(colored("transfer_function", 0.9), [0.5, 0.25, 0.125, 0.5], 1e-6);
    assert_close(colored("opaque", 0.9), [1.0, 0.5, 0.25, 1.0], 1e-6);
    assert_close(colored("opaque", 0.1), [0.0; 4], 0.0);
}

#[test]
fn an_empty_window_is_refused() {
    let properties = [("automatic", Value::Bool(false)), ("window", Value::Vector(vec![3.0, 3.0]))];
    let result = run("slice_view", &properties, &[("volume", digits())], [8, 8]);
    assert!(failure(result).contains("[3, 3] is empty"));
}
