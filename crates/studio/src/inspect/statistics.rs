//! Numbers about an image, computed where it is; some kilobytes are read back.

use std::sync::{Mutex, PoisonError};

use bytemuck::{Pod, Zeroable};
use rayloom_gpu::{Gpu, GpuError, PipelineCache, wgpu};
use rayloom_network::ImageKind;
use rayloom_processors::{Image, plain_shader};

const SHADER: &str = "image/statistics.wgsl";

/// Workgroups; as in the shader.
const GROUPS: usize = 64;

/// As in the shader.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Parameters {
    depth: u32,
    bounded: u32,
    hits_only: u32,
}

/// As in the shader.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Summary {
    smallest: [f32; 5],
    largest: [f32; 5],
    sum: [f32; 5],
    count: [u32; 5],
    not_finite: u32,
    out_of_range: u32,
}

/// The values of one channel that are finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChannelStatistics {
    /// Smallest value.
    pub min: f32,
    /// Largest value.
    pub max: f32,
    /// Mean value.
    pub mean: f64,
    /// How many pixels count.
    pub count: u64,
}

/// Numbers about an image.
#[derive(Clone, Debug, PartialEq)]
pub struct Statistics {
    /// The four channels; `None` where no pixel counts. Coordinates count where something was hit.
    pub channels: [Option<ChannelStatistics>; 4],
    /// Depth where something was hit, world units.
    pub depth: Option<ChannelStatistics>,
    /// Pixels with a NaN or an infinity.
    pub not_finite: u64,
    /// Pixels of a colour or coordinate image with a value outside of 0 to 1.
    pub out_of_range: u64,
}

/// Computes the numbers. Waits for the device: not for the window's thread.
///
/// # Errors
/// The device refuses or is lost.
pub fn statistics(gpu: &Gpu, pipelines: &Mutex<PipelineCache>, image: &Image) -> Result<Statistics, GpuError> {
    let label = "image statistics";
    let pipeline = pipelines.lock().unwrap_or_else(PoisonError::into_inner).compute(
        gpu,
        label,
        &plain_shader(SHADER, &[]),
        "main",
    )?;
    let hits_only = matches!(image.kind, ImageKind::EntryPoints | ImageKind::ExitPoints);
    let bounded = hits_only || image.kind == ImageKind::Color;
    let parameters =
        Parameters { depth: image.depth.is_some().into(), bounded: bounded.into(), hits_only: hits_only.into() };
    let uniform = gpu.uniform(label, &parameters)?;
    let result = gpu.storage(label, &[Summary::zeroed(); GROUPS])?;
    let depth = image.depth.as_ref().unwrap_or(&image.color);
    gpu.guarded(label, || {
        let resources = [
            uniform.as_entire_binding(),
            wgpu::BindingResource::TextureView(&image.color.view),
            wgpu::BindingResource::TextureView(&depth.view),
            result.as_entire_binding(),
        ];
        let entries: Vec<_> =
            (0..).zip(resources).map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
        let layout = &pipeline.get_bind_group_layout(0);
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries });
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(GROUPS as u32, 1, 1);
        drop(pass);
        gpu.queue.submit([encoder.finish()]);
    })?;
    let bytes = gpu.read_buffer(&result)?;
    let size = size_of::<Summary>();
    let summaries: Vec<Summary> = bytes.chunks_exact(size).take(GROUPS).map(bytemuck::pod_read_unaligned).collect();
    Ok(merge(&summaries))
}

fn merge(summaries: &[Summary]) -> Statistics {
    let channel = |channel: usize| {
        let count = summaries.iter().map(|summary| u64::from(summary.count[channel])).sum::<u64>();
        let sum = summaries.iter().map(|summary| f64::from(summary.sum[channel])).sum::<f64>();
        (count > 0).then(|| ChannelStatistics {
            min: summaries.iter().map(|summary| summary.smallest[channel]).fold(f32::INFINITY, f32::min),
            max: summaries.iter().map(|summary| summary.largest[channel]).fold(f32::NEG_INFINITY, f32::max),
            mean: sum / count as f64,
            count,
        })
    };
    Statistics {
        channels: std::array::from_fn(channel),
        depth: channel(4),
        not_finite: summaries.iter().map(|summary| u64::from(summary.not_finite)).sum(),
        out_of_range: summaries.iter().map(|summary| u64::from(summary.out_of_range)).sum(),
    }
}
