//! The assembled ray loop against one written by hand, with the same maths on the same textures: A B A B in one run,
//! by GPU time. Prints the ratio; asserts only that both draw the same picture.

use std::sync::Arc;
use std::time::Duration;

use bytemuck::{Pod, Zeroable};
use rayloom_gpu::wgpu::{self, TextureFormat};
use rayloom_gpu::{Gpu, PipelineCache, Texture, TexturePool, Timer};
use rayloom_processors::{Data, Image, VolumeData};
use rayloom_tests::timing::{Summary, time_again};
use rayloom_tests::{Picture, Workbench};

const SIZE: u32 = 512;
const ROUNDS: usize = 15;

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Scene {
    volume_to_world: [[f32; 4]; 3],
    depth_plane: [f32; 4],
    dims: [f32; 3],
    rate: f32,
    image_size: [u32; 2],
    texel_scale: f32,
    texel_offset: f32,
}

fn main() {
    let mut bench = Workbench::load("networks/brain.json");
    bench
        .set("source.file", &format!("{:?}", rayloom_tests::root().join("data/ch2.nii.gz")))
        .set("traversal.shading", r#""none""#)
        .set("traversal.skipping", r#""none""#)
        .set("traversal.termination_error", "0");
    bench.runner.measure(true);
    let assembled = bench.picture("traversal", "image", [SIZE, SIZE]);
    let hand_written = HandWritten::new(&bench);
    let by_hand = hand_written.picture();
    let difference = difference(&assembled, &by_hand);
    assert!(difference < 1e-5, "the two loops draw different pictures, by up to {difference}");

    let mut times = [Vec::new(), Vec::new()];
    for _ in 0..ROUNDS {
        times[0].push(time_again(&mut bench, "traversal", "image", [SIZE; 2]));
        times[1].push(hand_written.run());
    }
    println!(
        "unshaded DVR of 181 x 217 x 181 voxels at {SIZE} x {SIZE}, one sample a voxel, on {}",
        hand_written.gpu.describe()
    );
    println!("largest difference of the pictures {difference:.1e}");
    println!("assembled    {} ms", Summary::of(&times[0]));
    println!("hand-written {} ms", Summary::of(&times[1]));
    println!("ratio        {}, {ROUNDS} pairs", Summary::of_ratios(&times[0], &times[1]));
}

fn difference(a: &Picture, b: &Picture) -> f32 {
    let pairs = a.color.iter().flatten().zip(b.color.iter().flatten());
    let colors = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    let depths = a.depth.iter().zip(&b.depth).map(|(a, b)| (a - b).abs() / a.abs().max(1.0));
    depths.fold(colors, f32::max)
}

fn milliseconds(time: Option<Duration>) -> f64 {
    time.expect("the device has timestamp queries").as_secs_f64() * 1e3
}

struct HandWritten {
    gpu: Gpu,
    timer: Timer,
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    targets: [Arc<Texture>; 2],
}

impl HandWritten {
    fn new(bench: &Workbench) -> Self {
        let gpu = bench.runner.context.gpu.clone();
        let (volume, entry, exit) = (volume(bench), image(bench, "entry"), image(bench, "exit"));
        let (stored, data) = (volume.on_gpu(&gpu).expect("uploaded"), &volume.volume);
        let view = entry.view.as_ref().expect("entry points have a view");
        let to_world = data.texture_to_world().matrix3;
        let column = |axis: glam::DVec3| axis.extend(0.0).as_vec4().to_array();
        let scene = Scene {
            volume_to_world: [column(to_world.x_axis), column(to_world.y_axis), column(to_world.z_axis)],
            depth_plane: view.depth_plane().as_vec4().to_array(),
            dims: data.dims_f64().as_vec3().to_array(),
            rate: 1.0,
            image_size: [SIZE; 2],
            texel_scale: stored.scale[0],
            texel_offset: stored.offset[0],
        };
        let uniform = gpu.uniform("scene", &scene).expect("uniform");
        let function = match bench.network.value("traversal", "transfer_function") {
            Some(rayloom_network::Value::TransferFunction(function)) => function.clone(),
            other => panic!("no transfer function but {other:?}"),
        };
        let entries = function.table(data.ranges()[0], 1024);
        let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
        let table = gpu.texture_2d("table", [1024, 1], TextureFormat::Rgba32Float, usage).expect("table");
        gpu.upload(&table, bytemuck::cast_slice(&entries)).expect("table");
        let mut pool = TexturePool::new();
        let mut target = |format| pool.get(&gpu, "target", [SIZE; 2], format).expect("target");
        let targets = [target(TextureFormat::Rgba32Float), target(TextureFormat::R32Float)];
        let linear = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        let text = include_str!("hand_written.wgsl");
        let pipeline = PipelineCache::new().compute(&gpu, "hand-written loop", text, "dvr").expect("shader");
        let views = [
            &stored.texture.view,
            &entry.color.view,
            &exit.color.view,
            &table.view,
            &targets[0].view,
            &targets[1].view,
        ];
        let mut resources = vec![uniform.as_entire_binding()];
        resources.extend(views.map(wgpu::BindingResource::TextureView));
        resources.insert(2, wgpu::BindingResource::Sampler(&linear));
        let entries: Vec<_> =
            (0..).zip(resources).map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
        let layout = &pipeline.get_bind_group_layout(0);
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries });
        let timer = Timer::new(&gpu).expect("timer");
        Self { gpu, timer, pipeline, group, targets }
    }

    /// GPU time in milliseconds.
    fn run(&self) -> f64 {
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("hand-written loop"),
            timestamp_writes: self.timer.compute_pass(),
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.dispatch_workgroups(SIZE / 8, SIZE / 8, 1);
        drop(pass);
        self.gpu.queue.submit([encoder.finish()]);
        milliseconds(self.timer.finish(&self.gpu).expect("timestamps"))
    }

    fn picture(&self) -> Picture {
        self.run();
        let read = |texture| self.gpu.read_rgba_f32(texture).expect("read back");
        Picture {
            size: [SIZE; 2],
            color: read(&self.targets[0]),
            depth: read(&self.targets[1]).iter().map(|texel| texel[0]).collect(),
        }
    }
}

fn volume(bench: &Workbench) -> Arc<VolumeData> {
    match bench.evaluator.output("source", "volume") {
        Some(Data::Volume(volume)) => volume.clone(),
        other => panic!("no volume but {other:?}"),
    }
}

fn image(bench: &Workbench, outport: &str) -> Arc<Image> {
    match bench.evaluator.output("view", outport) {
        Some(Data::Image(image)) => image.clone(),
        other => panic!("no image but {other:?}"),
    }
}
