//! The device, textures, caches and measurements on whatever adapter this machine has; software Vulkan will do.

use std::sync::LazyLock;

use half::f16;
use rayloom_gpu::wgpu::{self, TextureFormat, TextureUsages};
use rayloom_gpu::{Gpu, GpuError, GpuOptions, Hidden, PipelineCache, TexturePool, Timer};

static GPU: LazyLock<Gpu> = LazyLock::new(|| Gpu::new(&GpuOptions::default()).expect("an adapter"));

const COPY: TextureUsages = TextureUsages::COPY_SRC.union(TextureUsages::COPY_DST);

/// Uploads texels of `format` and expects them back as `expected`; 5 x 3 texels, so rows need padding.
fn round_trip(format: TextureFormat, bytes: &[u8], expected: &[[f32; 4]]) {
    let texture = GPU.texture_2d("round trip", [5, 3], format, COPY).expect("texture");
    GPU.upload(&texture, bytes).expect("upload");
    assert_eq!(GPU.read_rgba_f32(&texture).expect("read-back"), expected, "{format:?}");
}

#[test]
fn every_format_comes_back_as_numbers() {
    let codes: Vec<u16> = (0..60).map(|i| i * 1092).collect();
    let bytes_of = |codes: &[u16]| codes.iter().flat_map(|c| c.to_le_bytes()).collect::<Vec<u8>>();

    let expected: Vec<[f32; 4]> = texels(&codes, |c| f32::from(c) / 65535.0);
    if GPU.features.norm16 {
        round_trip(TextureFormat::Rgba16Unorm, &bytes_of(&codes), &expected);
    }
    let floats: Vec<f32> = codes.iter().map(|&c| f32::from(c) * 1e-3 - 7.0).collect();
    round_trip(TextureFormat::Rgba32Float, bytemuck::cast_slice(&floats), &texels(&floats, |v| v));

    let halves: Vec<u16> = floats.iter().map(|&v| f16::from_f32(v).to_bits()).collect();
    let expected = texels(&halves, |bits| f16::from_bits(bits).to_f32());
    round_trip(TextureFormat::Rgba16Float, &bytes_of(&halves), &expected);

    let small: Vec<u8> = (0..60).map(|i| i * 4).collect();
    round_trip(TextureFormat::Rgba8Unorm, &small, &texels(&small, |c| f32::from(c) / 255.0));

    let single: Vec<[f32; 4]> = floats[..15].iter().map(|&v| [v, 0.0, 0.0, 1.0]).collect();
    round_trip(TextureFormat::R32Float, bytemuck::cast_slice(&floats[..15]), &single);
}

fn texels<T: Copy>(values: &[T], decode: impl Fn(T) -> f32) -> Vec<[f32; 4]> {
    values.chunks_exact(4).map(|t| [decode(t[0]), decode(t[1]), decode(t[2]), decode(t[3])]).collect()
}

#[test]
fn a_part_of_a_3d_texture_is_read_in_order() {
    let size = [3, 4, 5];
    let texture = GPU.texture_3d("bricks", size, TextureFormat::R32Float, COPY).expect("texture");
    let values: Vec<f32> = (0..60).map(|i| i as f32).collect();
    GPU.upload(&texture, bytemuck::cast_slice(&values)).expect("upload");
    let part = GPU.read_region(&texture, [1, 2, 3], [2, 1, 2]).expect("part");
    let expected = [43.0, 44.0, 55.0, 56.0].map(|v| [v, 0.0, 0.0, 1.0]);
    assert_eq!(part, expected);
    let error = GPU.read_region(&texture, [1, 2, 3], [3, 1, 1]).expect_err("outside");
    assert!(error.to_string().contains("within [3, 4, 5]"), "{error}");
}

#[test]
fn sizes_over_a_limit_name_the_limit() {
    let over = GPU.limits.max_texture_dimension_3d + 1;
    let error = GPU.texture_3d("head.nii", [over, 8, 8], TextureFormat::R8Unorm, COPY).expect_err("too large");
    let text = error.to_string();
    assert!(matches!(error, GpuError::OverLimit { limit: "maxTextureDimension3D", .. }), "{text}");
    assert!(text.contains("head.nii") && text.contains(&over.to_string()), "{text}");

    let error = GPU.texture_2d("canvas", [0, 8], TextureFormat::R8Unorm, COPY).expect_err("empty");
    assert!(error.to_string().contains("0 x 8"), "{error}");

    let texture = GPU.texture_2d("small", [2, 2], TextureFormat::R8Unorm, COPY).expect("texture");
    let error = GPU.upload(&texture, &[0; 5]).expect_err("too many bytes");
    assert!(error.to_string().contains("expected 4 bytes"), "{error}");
}

#[test]
fn hidden_abilities_are_missing() {
    let hidden = Hidden { timestamps: true, float32_filterable: true, norm16: true };
    let gpu = Gpu::new(&GpuOptions { hidden, adapter: None }).expect("an adapter");
    assert!(!gpu.features.timestamps && !gpu.features.float32_filterable && !gpu.features.norm16);
    assert!(!gpu.filterable(TextureFormat::R32Float) && gpu.filterable(TextureFormat::R16Float));
    let error = gpu.texture_2d("ramp", [2, 2], TextureFormat::R16Unorm, COPY).expect_err("no such format");
    assert!(matches!(error, GpuError::Unsupported { .. }), "{error}");
    let timer = Timer::new(&gpu).expect("timer");
    assert!(timer.compute_pass().is_none() && timer.finish(&gpu).expect("time").is_none());
}

#[test]
fn an_unknown_adapter_is_named() {
    let options = GpuOptions { adapter: Some("no such card".into()), ..Default::default() };
    let text = Gpu::new(&options).expect_err("no such adapter").to_string();
    assert!(text.contains("no such card") && text.contains("mesa-vulkan-drivers"), "{text}");
}

#[test]
fn dropped_targets_are_reused() {
    let mut pool = TexturePool::new();
    let format = TextureFormat::Rgba32Float;
    let first = pool.get(&GPU, "a", [16, 8], format).expect("target");
    let second = pool.get(&GPU, "b", [16, 8], format).expect("target");
    assert_ne!(first.texture, second.texture);
    let texture = first.texture.clone();
    drop(first);
    assert_eq!(pool.get(&GPU, "c", [16, 8], format).expect("target").texture, texture);
    assert_eq!((pool.counts().created, pool.counts().reused), (2, 1));
    assert_eq!(pool.trim(16 * 8 * 16), 0, "that much may stay");
    assert_eq!(pool.trim(0), 16 * 8 * 16);
    assert_eq!(pool.bytes(), 16 * 8 * 16, "the second is still held");
}

const SQUARES: &str = "
@group(0) @binding(0) var<storage, read_write> values: array<f32>;
@compute @workgroup_size(64)
fn square(@builtin(global_invocation_id) id: vec3u) {
    values[id.x] = values[id.x] * values[id.x];
}";

#[test]
fn a_pipeline_is_compiled_once_runs_and_is_timed() {
    let mut pipelines = PipelineCache::new();
    let pipeline = pipelines.compute(&GPU, "squares", SQUARES, "square").expect("pipeline");
    assert_eq!(pipelines.compute(&GPU, "other label", SQUARES, "square").expect("pipeline"), pipeline);
    assert_eq!((pipelines.counts().misses, pipelines.counts().hits), (1, 1));

    let values: Vec<f32> = (0..64).map(|i| i as f32).collect();
    let buffer = GPU.storage("values", &values).expect("buffer");
    let timer = Timer::new(&GPU).expect("timer");
    GPU.guarded("squaring", || {
        let group = GPU.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() }],
        });
        let mut encoder = GPU.device.create_command_encoder(&Default::default());
        let mut pass = encoder
            .begin_compute_pass(&wgpu::ComputePassDescriptor { label: None, timestamp_writes: timer.compute_pass() });
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(1, 1, 1);
        drop(pass);
        GPU.queue.submit([encoder.finish()]);
    })
    .expect("no error");
    let bytes = GPU.read_buffer(&buffer).expect("read-back");
    let squares: Vec<f32> = bytemuck::pod_collect_to_vec(&bytes);
    assert!(squares.iter().zip(&values).all(|(s, v)| *s == v * v));
    assert_eq!(timer.finish(&GPU).expect("time").is_some(), GPU.features.timestamps);
    assert!(timer.finish(&GPU).expect("time").is_none(), "nothing was measured since");
}

#[test]
fn a_broken_shader_is_an_error_with_a_line() {
    let mut pipelines = PipelineCache::new();
    let broken = SQUARES.replace("id.x;", "id.x * 2.0;").replace("values[id.x] *", "valeus[id.x] *");
    let error = pipelines.compute(&GPU, "squares", &broken, "square").expect_err("does not compile");
    let text = error.to_string();
    assert!(text.contains("squares") && text.contains("valeus") && text.contains("5:"), "{text}");
    let missing = pipelines.compute(&GPU, "squares", SQUARES, "cube").expect_err("no such entry point");
    assert!(missing.to_string().contains("cube"), "{missing}");
}
