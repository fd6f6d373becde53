//! Sources, precision, gradients and proxy geometry.

use std::sync::{Arc, Mutex};

use glam::{DAffine3, DVec3};
use rayloom_gpu::wgpu::TextureFormat;
use rayloom_gpu::{Features, Gpu, GpuOptions, Hidden};
use rayloom_network::{Outputs, Value};
use rayloom_processors::{Data, GpuVolume, Precision, VolumeData};
use rayloom_volume::{Element, Volume};

use crate::common::{GPU, failure, run, run_with, runner, text, volume};

fn volume_of<E: Element>(voxels: Vec<E>, dims: [u32; 3], channels: u32) -> Volume {
    Volume::new("test", dims, channels, E::wrap(voxels), DAffine3::IDENTITY).expect("valid")
}

/// Uploads a volume, reads it back as a shader would see it, and returns the largest error of a normalised value.
fn upload_error(gpu: &Gpu, volume: &Volume, precision: Precision) -> (TextureFormat, f64) {
    let uploaded = GpuVolume::upload(gpu, volume, precision).expect("fits");
    let texels = gpu.read_rgba_f32(&uploaded.texture).expect("read-back");
    let mut worst = 0.0_f64;
    for channel in 0..volume.channels {
        let (c, expected) = (channel as usize, volume.normalised(channel));
        for (texel, expected) in texels.iter().zip(expected) {
            let value = texel[c] * uploaded.scale[c] + uploaded.offset[c];
            worst = worst.max(f64::from((value - expected).abs()));
        }
    }
    (uploaded.texture.format, worst)
}

#[test]
fn precision_chooses_the_format_and_loses_only_what_it_says() {
    use TextureFormat as F;
    let bytes = volume_of((0..105).map(|i| i * 2 + 3).collect::<Vec<u8>>(), [5, 7, 3], 1);
    // 12-bit data as scanners give it, negative, with a negative slope.
    let scan = (0..105).map(|i| i * 19 - 1000).collect::<Vec<i16>>();
    let scan = volume_of(scan, [5, 7, 3], 1).with_rescale(-0.5, 10.0).expect("valid");
    let wide = volume_of((0..105).map(|i| i * 620).collect::<Vec<u16>>(), [5, 7, 3], 1);
    let floats = volume_of((0..105).map(|i| (f64::from(i) * 0.1).sin()).collect::<Vec<f64>>(), [5, 7, 3], 1);
    let colors = volume_of((0..315).map(|i| (i % 256) as u8).collect::<Vec<u8>>(), [5, 7, 3], 3);
    let norm16 = GPU.features.norm16;
    let exact = 2e-7;
    for (volume, precision, format, bound) in [
        (&bytes, Precision::Auto, F::R16Float, exact),
        (&bytes, Precision::Bits8, F::R8Unorm, exact),
        (&bytes, Precision::Bits32, F::R32Float, exact),
        (&colors, Precision::Auto, F::Rgba16Float, exact),
        (&scan, Precision::Auto, F::R16Float, exact),
        (&scan, Precision::Bits8, F::R8Unorm, 0.5 / 255.0 + exact),
        (&wide, Precision::Auto, if norm16 { F::R16Unorm } else { F::R32Float }, exact),
        (&floats, Precision::Auto, F::R32Float, exact),
        (&floats, Precision::Bits16, if norm16 { F::R16Unorm } else { F::R16Float }, 2.5e-4),
    ] {
        let (found, error) = upload_error(&GPU, volume, precision);
        assert_eq!(found, format, "{:?} {precision:?}", volume.voxels);
        assert!(error <= bound, "{:?} {precision:?}: {error}", volume.voxels);
    }
    let hidden = Hidden { norm16: true, ..Hidden::default() };
    let poor = Gpu::new(&GpuOptions { hidden, adapter: None }).expect("an adapter");
    assert_eq!(upload_error(&poor, &wide, Precision::Auto).0, F::R32Float);
    let (format, error) = upload_error(&poor, &wide, Precision::Bits16);
    assert!(format == F::R16Float && error <= 2.5e-4);
}

#[test]
fn lost_precision_and_odd_voxels_are_reported() {
    let odd = volume_of(vec![1.0_f32, f32::NAN, 3.0, f32::INFINITY, f32::NEG_INFINITY, 2.0], [3, 2, 1], 1);
    let (_, error) = upload_error(&GPU, &odd, Precision::Bits32);
    assert!(error == 0.0, "NaN and infinities are drawn as the ends of the range");
    let all_features = Features { timestamps: true, float32_filterable: true, norm16: true };
    let loss = |precision| rayloom_processors::Storage::choose(&odd, precision, all_features).loss;
    assert!(loss(Precision::Auto).is_none() && loss(Precision::Bits32).is_none());
    assert!(loss(Precision::Bits8).expect("lossy").contains("256"));
}

#[test]
fn a_volume_over_the_device_limit_names_it() {
    let over = GPU.limits.max_texture_dimension_3d + 1;
    let long = volume_of(vec![0_u8; over as usize], [1, 1, over], 1);
    let error = VolumeData::new(Arc::new(long), Precision::Auto).on_gpu(&GPU).expect_err("too long").to_string();
    assert!(error.contains("maxTextureDimension3D") && error.contains(&over.to_string()), "{error}");
}

fn volume_at<'a>(outputs: &'a Outputs<Data>, outport: &str) -> &'a Arc<VolumeData> {
    match &outputs.data[outport] {
        Data::Volume(volume) => volume,
        other => panic!("no volume but {other:?}"),
    }
}

#[test]
fn the_source_reads_reports_and_does_not_read_twice() {
    let folder = tempfile::tempdir().expect("folder");
    std::fs::write(folder.path().join("a.raw"), [7, 8, 9, 250]).expect("written");
    let header = folder.path().join("a.volume.json");
    std::fs::write(&header, r#"{"raw": "a.raw", "dims": [2, 2, 1], "type": "u8", "spacing": [1, 2, 3]}"#)
        .expect("written");
    let file = ("file", text(&header.to_string_lossy()));

    let mut runner = runner();
    let heard = Arc::new(Mutex::new(Vec::new()));
    let listener = heard.clone();
    runner.context.progress = Some(Box::new(move |id, progress| {
        listener.lock().expect("not poisoned").push((id.to_owned(), progress.done, progress.total));
    }));
    let first = run_with(&mut runner, "volume_source", std::slice::from_ref(&file), &[], [1, 1]).expect("reads");
    assert_eq!(volume_at(&first, "volume").volume.spacing(), DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(heard.lock().expect("not poisoned").last(), Some(&("volume_source".to_owned(), 4, 4)));
    assert!(!volume_at(&first, "volume").is_on_gpu(), "nothing has consumed it");

    let coarse = [file, ("precision", text("8-bit"))];
    let second = run_with(&mut runner, "volume_source", &coarse, &[], [1, 1]).expect("keeps");
    assert!(Arc::ptr_eq(&volume_at(&first, "volume").volume, &volume_at(&second, "volume").volume));
    let missing = run("volume_source", &[("file", text("/nowhere/b.nrrd"))], &[], [1, 1]);
    assert!(failure(missing).contains("/nowhere/b.nrrd"));
}

#[test]
fn generators_follow_their_formula_and_parameters() {
    let properties = [
        ("field", text("sphere_distance")),
        ("radius", Value::Float(0.5)),
        ("dims", Value::Vector(vec![4.0, 2.0, 1.0])),
        ("extent", Value::Vector(vec![8.0, 2.0, 1.0])),
    ];
    let outputs = run("volume_generator", &properties, &[], [1, 1]).expect("runs");
    let volume = &volume_at(&outputs, "volume").volume;
    assert_eq!((volume.dims, volume.spacing()), ([4, 2, 1], DVec3::new(2.0, 1.0, 1.0)));
    // The centre of the first voxel lies at (-3/4, -1/2, 0) of the domain.
    assert!((volume.value([0, 0, 0], 0) - (0.8125_f64.sqrt() - 0.5)).abs() < 1e-6);
}

#[test]
fn gradients_of_a_linear_field_are_constant_and_zero_stays_zero_in_8_bits() {
    let input = [("volume", volume([6, 5, 4], DVec3::ONE, |i, j, _| 3.0 * i - 2.0 * j))];
    for (storage, format, tolerance) in
        [("32-bit", TextureFormat::Rgba32Float, 1e-6), ("8-bit", TextureFormat::Rgba8Unorm, 1.0 / 254.0 * 3.0 / 23.0)]
    {
        let outputs = run("gradient_volume", &[("storage", text(storage))], &input, [1, 1]).expect("runs");
        let uploaded = volume_at(&outputs, "gradients").on_gpu(&GPU).expect("fits");
        assert_eq!(uploaded.texture.format, format);
        // Values run from -8 to 15.
        for texel in GPU.read_rgba_f32(&uploaded.texture).expect("read-back") {
            let [x, y, z, _] = std::array::from_fn(|c| texel[c] * uploaded.scale[c] + uploaded.offset[c]);
            assert!((x - 3.0 / 23.0).abs() <= tolerance && (y + 2.0 / 23.0).abs() <= tolerance, "{storage}: {x} {y}");
            assert!(z.abs() < 1e-6, "{storage}: {z}");
        }
    }
    let wrong = run("gradient_volume", &[("channel", Value::Int(2))], &input, [1, 1]);
    assert!(failure(wrong).contains("channel 2"));
}

fn bounds(outputs: &Outputs<Data>) -> ([f32; 3], [f32; 3], usize) {
    let Some(Data::Geometry(mesh)) = outputs.data.values().next() else { panic!("no mesh came out") };
    let fold = |start: f32, pick: fn(f32, f32) -> f32| {
        std::array::from_fn(|axis| mesh.positions.iter().map(|p| p[axis]).fold(start, pick))
    };
    (fold(f32::INFINITY, f32::min), fold(f32::NEG_INFINITY, f32::max), mesh.indices.len())
}

#[test]
fn the_cube_is_clipped_at_voxel_edges() {
    let input = [("volume", volume([8, 4, 10], DVec3::new(1.0, 2.0, 0.5), |_, _, _| 0.0))];
    let whole = run("cube_proxy", &[], &input, [1, 1]).expect("runs");
    assert_eq!(bounds(&whole), ([0.0; 3], [1.0; 3], 12));
    let clip = [("clip_x", Value::Vector(vec![2.0, 6.0])), ("clip_z", Value::Vector(vec![5.0, 99.0]))];
    let part = run("cube_proxy", &clip, &input, [1, 1]).expect("runs");
    assert_eq!(bounds(&part), ([0.25, 0.0, 0.5], [0.75, 1.0, 1.0], 12));
    let empty = run("cube_proxy", &[("clip_y", Value::Vector(vec![4.0, 9.0]))], &input, [1, 1]);
    assert!(failure(empty).contains("along y"));
}

#[test]
fn planes_cut_in_world_coordinates() {
    // The box is 4 x 8 x 5 world units; its lower corner lies half a voxel below the origin.
    let input = [("volume", volume([4, 4, 10], DVec3::new(1.0, 2.0, 0.5), |_, _, _| 0.0))];
    let cube = run("cube_proxy", &[], &input, [1, 1]).expect("runs").data["geometry"].clone();
    let normal = |n: [f64; 3]| ("normal", Value::Vector(n.to_vec()));
    let cut = |properties: &[(&str, Value)]| {
        run("clipped_proxy", properties, &[("geometry", cube.clone())], [1, 1]).expect("runs")
    };
    // y = 1 lies at (1 + 1) / 8 of the box, whatever the length of the normal... the distance is along its unit vector.
    let below = cut(&[normal([0.0, 10.0, 0.0]), ("distance", Value::Float(1.0))]);
    assert_eq!(bounds(&below).1, [1.0, 0.25, 1.0]);
    let above = cut(&[normal([0.0, 10.0, 0.0]), ("distance", Value::Float(1.0)), ("invert", Value::Bool(true))]);
    assert_eq!(bounds(&above).0, [0.0, 0.25, 0.0]);
    let nothing = cut(&[normal([1.0, 1.0, 1.0]), ("distance", Value::Float(-100.0))]);
    assert_eq!(nothing.data["clipped"].facts(), rayloom_network::Facts::Geometry { triangles: 0 });
    let zero = run("clipped_proxy", &[normal([0.0; 3])], &[("geometry", cube.clone())], [1, 1]);
    assert!(failure(zero).contains("no direction"));
}
