//! Pixels: pictures of a homogeneous box between and at their pixels, against its formula at many points.

use rayloom_gpu::Gpu;
use rayloom_network::{Camera, Projection};
use rayloom_reference::closed_forms::homogeneous_opacity;
use serde_json::{Value as Json, json};

use super::lab::{Lab, rms};
use super::{Axis, Case, Expectation, Extent};
use crate::MeasureError;
use crate::verify::rays::Chord;

/// Pixels along an edge.
const PIXELS: [u32; 5] = [16, 32, 64, 128, 256];
/// Points along an edge at which pictures are looked at; odd, so that they fall anywhere within pixels.
const POINTS: u32 = 397;
const TAU: f64 = 1.0;

/// A box of this size, seen from close by with this field of view.
fn lab(gpu: &Gpu, side: u32, fov_degrees: f64) -> Result<Lab, MeasureError> {
    let knot = json!({"knots": [{"at": 0, "color": [1, 1, 1], "opacity": 1.0 - f64::exp(-TAU)}]});
    let settings: [(&str, Json); 4] = [
        ("source.field", json!("constant")),
        ("source.dims", json!([4, 4, 4])),
        ("source.extent", json!([1, 3, 3])),
        ("traversal.transfer_function", knot),
    ];
    let projection = Projection::Perspective { fov_degrees };
    let camera = Camera { position: [-4.0, 0.7, 0.4], focus: [0.0; 3], projection, ..Camera::default() };
    Lab::new(gpu, [side; 2], camera, &settings)
}

pub(super) fn cases(gpu: &Gpu, extent: Extent) -> Result<Vec<Case>, MeasureError> {
    let sizes = extent.of(&PIXELS, 4);
    let inside = errors(gpu, &sizes, 28.0, smooth)?;
    let around = errors(gpu, &sizes, 75.0, outline)?;
    Ok(vec![
        Case::new(
            Axis::Pixels,
            "between pixels, smooth part",
            Expectation { order: 2.0, within: 0.1, floor: 2e-6 },
            inside,
        ),
        Case::new(
            Axis::Pixels,
            "share on the wrong side of an outline",
            Expectation { order: 1.0, within: 0.2, floor: 1e-4 },
            around,
        ),
    ])
}

/// The error of a picture of a size, by the chords of the points.
type Judge = fn(&[Option<Chord>], &[[f32; 4]], u32) -> f64;

/// Errors of pictures of all sizes.
fn errors(gpu: &Gpu, sizes: &[u32], fov_degrees: f64, error: Judge) -> Result<Vec<(f64, f64)>, MeasureError> {
    let (_, points) = lab(gpu, POINTS, fov_degrees)?.rays()?;
    let of_size = |&side: &u32| {
        let picture = lab(gpu, side, fov_degrees)?.picture(&[])?;
        Ok((f64::from(side), error(&points, &picture, side)))
    };
    sizes.iter().map(of_size).collect()
}

/// Where point `i` of [`POINTS`] lies in a picture, in pixels from the first centre.
fn place(i: u32, side: u32) -> f64 {
    (f64::from(i) + 0.5) / f64::from(POINTS) * f64::from(side) - 0.5
}

/// Error of opacities interpolated linearly between pixels, away from the border of the picture.
fn smooth(points: &[Option<Chord>], picture: &[[f32; 4]], side: u32) -> f64 {
    let opacity = |x: u32, y: u32| f64::from(picture[(y * side + x) as usize][3]);
    let margin = POINTS / 8;
    let inner = (margin..POINTS - margin).flat_map(|y| (margin..POINTS - margin).map(move |x| (x, y)));
    rms(inner.map(|(i, j)| {
        let (x, y) = (place(i, side), place(j, side));
        let (column, row) = (x.floor() as u32, y.floor() as u32);
        let (u, v) = (x.fract(), y.fract());
        let line = |row| opacity(column, row) * (1.0 - u) + opacity(column + 1, row) * u;
        let found = line(row) * (1.0 - v) + line(row + 1) * v;
        let length = points[(j * POINTS + i) as usize].map_or(0.0, |chord| chord.length);
        found - homogeneous_opacity(TAU, length)
    }))
}

/// Share of the points that the nearest pixel takes for inside or outside of the box by mistake.
fn outline(points: &[Option<Chord>], picture: &[[f32; 4]], side: u32) -> f64 {
    let nearest = |i: u32| (place(i, side).round().max(0.0) as u32).min(side - 1);
    let all = (0..POINTS).flat_map(|y| (0..POINTS).map(move |x| (x, y)));
    let wrong = all.filter(|&(i, j)| {
        let covered = picture[(nearest(j) * side + nearest(i)) as usize][3] > 0.0;
        covered != points[(j * POINTS + i) as usize].is_some()
    });
    wrong.count() as f64 / f64::from(POINTS * POINTS)
}
