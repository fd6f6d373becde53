//! Volumes of many kinds: generated ones, shipped ones, and ones made here and written to a folder.

use std::error::Error;
use std::path::Path;

use glam::{DVec3, IVec3};
use serde_json::{Value as Json, json};

use crate::random::Random;

/// What a volume holds, and so how it can be looked at.
#[derive(Clone, Copy, PartialEq)]
pub enum Kind {
    Values,
    Labels,
    Colors,
}

/// A source processor of a random volume, with its name.
pub fn source(random: &mut Random, folder: &Path) -> Result<(String, Kind, Json), Box<dyn Error>> {
    match random.number(0.0, 10.0) as usize {
        0..=1 => Ok(generated(random)),
        2 => Ok(shipped(random)),
        _ => made(random, folder),
    }
}

fn file(file: &Path) -> Json {
    json!({"id": "source", "type": "volume_source", "properties": {"file": file}})
}

fn generated(random: &mut Random) -> (String, Kind, Json) {
    const FIELDS: [&str; 7] =
        ["bucky_ball", "hydrogen_2p", "hydrogen_3d", "marschner_lobb", "gaussian_blob", "sphere_distance", "shells"];
    let field = *random.of(&FIELDS);
    let dims = [0; 3].map(|_| random.number(24.0, 80.0).round());
    let extent = dims.map(|side| side * random.number(0.7, 1.4));
    let properties = json!({"field": field, "dims": dims, "extent": extent});
    let name = format!("{field} {}x{}x{}", dims[0], dims[1], dims[2]);
    (name, Kind::Values, json!({"id": "source", "type": "volume_generator", "properties": properties}))
}

fn shipped(random: &mut Random) -> (String, Kind, Json) {
    let name = *random.of(&["ch2.nii.gz", "ch2better.nii.gz", "brainsmall.volume.json"]);
    (name.into(), Kind::Values, file(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data").join(name)))
}

/// The value of a made volume at a point, voxels and 0 to 1; about 0 to 1.
type Field = Box<dyn Fn(IVec3, DVec3) -> f64>;

fn made(random: &mut Random, folder: &Path) -> Result<(String, Kind, Json), Box<dyn Error>> {
    const FIELDS: [&str; 9] =
        ["noise", "rough noise", "white noise", "sheets", "blocks", "tubes", "nested", "labels", "colours"];
    let what = *random.of(&FIELDS);
    let side = *random.of(&[8.0, 20.0, 33.0, 48.0, 64.0, 100.0]);
    // White noise at full size is a fog of which no two readers would want the same.
    let side = if what == "white noise" { f64::min(side, 20.0) } else { side };
    let dims = [0; 3].map(|_| (side * random.number(0.75, 1.0)).round().max(4.0) as i32);
    let spacing = match *random.of(&[0, 0, 1]) {
        0 => [1.0; 3],
        _ => [random.number(0.3, 1.0), random.number(0.5, 1.5), random.number(1.0, 3.0)],
    };
    let element = *random.of(&["u8", "u16", "f32"]);
    let (kind, channels) = match what {
        "labels" => (Kind::Labels, 1),
        "colours" => (Kind::Colors, *random.of(&[3, 4])),
        _ => (Kind::Values, 1),
    };
    let element = if kind == Kind::Values { element } else { "u8" };
    let fields: Vec<Field> = (0..channels).map(|_| field(random, what)).collect();
    let mut bytes = Vec::new();
    for z in 0..dims[2] {
        for y in 0..dims[1] {
            for x in 0..dims[0] {
                let voxel = IVec3::new(x, y, z);
                let point = (voxel.as_dvec3() + 0.5) / IVec3::from(dims).as_dvec3();
                for field in &fields {
                    let value = field(voxel, point).clamp(0.0, 1.0);
                    match element {
                        "u8" if kind == Kind::Labels => bytes.push((value * 5.0).round() as u8),
                        "u8" => bytes.push((value * 255.0).round() as u8),
                        "u16" => bytes.extend(((value * 4000.0).round() as u16).to_le_bytes()),
                        _ => bytes.extend((value as f32 * 3.0 - 1.0).to_le_bytes()),
                    }
                }
            }
        }
    }
    let text = json!({"raw": "made.raw", "dims": dims, "type": element, "channels": channels, "spacing": spacing});
    std::fs::write(folder.join("made.raw"), bytes)?;
    let described = folder.join("made.volume.json");
    std::fs::write(&described, text.to_string())?;
    let apart = if spacing == [1.0; 3] { "" } else { ", anisotropic" };
    Ok((format!("{what} {}x{}x{}, {element}{apart}", dims[0], dims[1], dims[2]), kind, file(&described)))
}

fn field(random: &mut Random, what: &str) -> Field {
    let seed = random.number(0.0, 1e6) as u32;
    let mut points = |count: usize| -> Vec<DVec3> {
        (0..count).map(|_| DVec3::from([0; 3].map(|_| random.number(0.15, 0.85)))).collect()
    };
    match what {
        "noise" => {
            let scale = random.number(3.0, 7.0);
            Box::new(move |_, p| smooth_noise(p * scale, seed))
        }
        "rough noise" => Box::new(move |_, p| {
            (0..4)
                .map(|octave| smooth_noise(p * 4.0 * f64::from(1 << octave), seed + octave) / f64::from(2 << octave))
                .sum()
        }),
        "white noise" => Box::new(move |voxel, _| hash(voxel, seed)),
        "sheets" => {
            let (centers, radius) = (points(2), random.number(0.2, 0.35));
            Box::new(move |_, p| {
                let sheet = |c: &DVec3| (-((p.distance(*c) - radius) * 60.0).powi(2)).exp();
                centers.iter().map(sheet).fold(0.0, f64::max)
            })
        }
        "blocks" | "labels" => {
            let (low, high) = (points(5), points(5));
            Box::new(move |_, p| {
                let inside = |i: &usize| p.cmpge(low[*i].min(high[*i])).all() && p.cmple(low[*i].max(high[*i])).all();
                (0..5).rev().find(inside).map_or(0.0, |i| (i + 1) as f64 / 5.0)
            })
        }
        "tubes" => {
            let (from, to) = (points(6), points(6));
            Box::new(move |_, p| {
                let tube = |(a, b): (&DVec3, &DVec3)| {
                    let along = ((p - *a).dot(*b - *a) / (*b - *a).length_squared()).clamp(0.0, 1.0);
                    (-(p.distance(*a + (*b - *a) * along) * 25.0).powi(2)).exp()
                };
                from.iter().zip(&to).map(tube).fold(0.0, f64::max)
            })
        }
        // Head-like: skin, bone, something softer and noise in it; or a colour of such.
        _ => {
            let center = points(1)[0].lerp(DVec3::splat(0.5), 0.7);
            let (size, middle) = (random.number(0.3, 0.45), random.number(0.3, 1.0));
            Box::new(move |_, p| match p.distance(center) / size {
                r if r > 1.0 => 0.0,
                r if r > 0.9 => 0.3,
                r if r > 0.8 => 1.0,
                _ => 0.5 * middle + 0.15 * smooth_noise(p * 9.0, seed),
            })
        }
    }
}

/// A value of 0 to 1 for every lattice point.
fn hash(at: IVec3, seed: u32) -> f64 {
    let mut x = seed.wrapping_mul(0x9E37_79B1);
    for part in at.to_array() {
        x = (x ^ part as u32).wrapping_mul(0x85EB_CA6B);
        x ^= x >> 13;
        x = x.wrapping_mul(0xC2B2_AE35);
        x ^= x >> 16;
    }
    f64::from(x) / f64::from(u32::MAX)
}

/// Noise of one wave length, 0 to 1: lattice values, smoothly interpolated.
fn smooth_noise(p: DVec3, seed: u32) -> f64 {
    let cell = p.floor();
    let t = p - cell;
    let t = t * t * (DVec3::splat(3.0) - 2.0 * t);
    let corner = |i: i32| {
        let bits = IVec3::new(i & 1, i >> 1 & 1, i >> 2);
        let weight = |axis: usize| if bits[axis] == 1 { t[axis] } else { 1.0 - t[axis] };
        weight(0) * weight(1) * weight(2) * hash(cell.as_ivec3() + bits, seed)
    };
    (0..8).map(corner).sum()
}
