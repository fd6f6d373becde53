//! Runs single processors on the real device.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, LazyLock};

use glam::{DAffine3, DVec3};
use rayloom_gpu::wgpu::{TextureFormat, TextureUsages};
use rayloom_gpu::{Gpu, GpuOptions};
use rayloom_network::{
    Address, Backend, ImageKind, Input, Job, Level, Outputs, ProcessError, ProcessorType, Properties, Value,
};
use rayloom_processors::{Data, Image, Picture, Precision, Runner, VolumeData, processors};
use rayloom_volume::{Volume, Voxels};

/// One device for all tests of a file.
pub static GPU: LazyLock<Gpu> = LazyLock::new(|| Gpu::new(&GpuOptions::default()).expect("an adapter"));

/// A runner of one's own on the common device.
pub fn runner() -> Runner {
    Runner::new(GPU.clone()).expect("a runner")
}

/// Runs a processor with these properties (defaults for the others) and inputs, all outputs wanted.
pub fn run_with(
    runner: &mut Runner,
    kind: &str,
    changed: &[(&str, Value)],
    inputs: &[(&str, Data)],
    size: [u32; 2],
) -> Result<Outputs<Data>, ProcessError> {
    let process = processors().into_iter().find(|p| p.declaration().id == kind).expect("a processor of this type");
    let mut properties = Properties::default();
    let set = |properties: &mut Properties, id: &str, default: &Value| {
        let value = changed.iter().find(|(name, _)| *name == id).map_or(default, |(_, value)| value);
        properties.insert(id, value.clone());
    };
    for property in &process.declaration().properties {
        set(&mut properties, &property.id, &property.default);
    }
    for property in process.snippet_properties(&properties.clone()) {
        set(&mut properties, &property.id, &property.default);
    }
    for (id, _) in changed {
        assert!(properties.contains(id), "{kind} has no property {id}");
    }
    let wanted: BTreeSet<String> = process.declaration().outports.iter().map(|port| port.id.clone()).collect();
    let inputs: BTreeMap<String, Vec<Input<Data>>> = inputs
        .iter()
        .map(|(port, data)| {
            let from = Address::new("test", *port);
            (port.to_string(), vec![Input { data: data.clone(), from, revision: 1 }])
        })
        .collect();
    let processor_type: Arc<dyn ProcessorType> = process;
    runner.process(&Job {
        id: kind,
        processor_type: &processor_type,
        properties: &properties,
        inputs: &inputs,
        wanted: &wanted,
        size,
        level: Level::Ports,
        reasons: &[],
    })
}

/// [`run_with`] a fresh runner.
pub fn run(
    kind: &str,
    changed: &[(&str, Value)],
    inputs: &[(&str, Data)],
    size: [u32; 2],
) -> Result<Outputs<Data>, ProcessError> {
    run_with(&mut runner(), kind, changed, inputs, size)
}

/// The message of a run that must fail.
pub fn failure(result: Result<Outputs<Data>, ProcessError>) -> String {
    result.expect_err("this must fail").to_string()
}

/// The image at the outport `image`, in memory.
pub fn picture(outputs: &Outputs<Data>) -> Picture {
    let Some(Data::Image(image)) = outputs.data.get("image") else { panic!("no image came out") };
    let pixels = GPU.read_rgba_f32(&image.color).expect("read-back");
    let depth = image.depth.as_ref().map(|d| GPU.read_rgba_f32(d).expect("read-back").iter().map(|t| t[0]).collect());
    Picture { size: image.size(), pixels, depth }
}

/// An image on the device.
pub fn image(kind: ImageKind, picture: &Picture) -> Data {
    let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST | TextureUsages::COPY_SRC;
    let color = GPU.texture_2d("test", picture.size, TextureFormat::Rgba32Float, usage).expect("texture");
    GPU.upload(&color, bytemuck::cast_slice(&picture.pixels)).expect("upload");
    let depth = picture.depth.as_ref().map(|depth| {
        let texture = GPU.texture_2d("test depth", picture.size, TextureFormat::R32Float, usage).expect("texture");
        GPU.upload(&texture, bytemuck::cast_slice(depth)).expect("upload");
        Arc::new(texture)
    });
    Image { color: Arc::new(color), depth, kind, view: None }.into()
}

/// A volume of one channel whose value is `value(i, j, k)`.
pub fn volume(dims: [u32; 3], spacing: DVec3, value: impl Fn(f64, f64, f64) -> f64) -> Data {
    let mut voxels = Vec::new();
    for k in 0..dims[2] {
        for j in 0..dims[1] {
            voxels.extend((0..dims[0]).map(|i| value(i.into(), j.into(), k.into()) as f32));
        }
    }
    let volume = Volume::new("test", dims, 1, Voxels::F32(voxels), DAffine3::from_scale(spacing)).expect("valid");
    VolumeData::new(Arc::new(volume), Precision::Auto).into()
}

/// A choice, file or other text.
pub fn text(value: &str) -> Value {
    Value::Text(value.to_owned())
}

/// Asserts that colours agree to `tolerance` in every channel.
#[track_caller]
pub fn assert_close(found: [f32; 4], expected: [f32; 4], tolerance: f32) {
    let close = found.iter().zip(expected).all(|(f, e)| (f - e).abs() <= tolerance);
    assert!(close, "found {found:?}, expected {expected:?}");
}
