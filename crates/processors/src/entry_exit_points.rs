//! Entry and exit points: where the ray of every pixel enters and leaves a proxy geometry.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable, cast_slice};
use glam::{DVec3, Vec3};
use rayloom_gpu::wgpu::{self, TextureFormat};
use rayloom_gpu::{Gpu, GpuError, RenderState, Texture, VertexLayout};
use rayloom_network::{
    Camera, Choice, Declaration, ImageKind, InportDecl, Job, OutportDecl, Outputs, PortType, ProcessError, PropertyDecl,
};

use crate::{Context, Data, Image, JobData, Mesh, View, plain_shader};

const SHADER: &str = "entry_exit/points.wgsl";

/// Ports, properties and help.
pub fn declaration() -> Declaration {
    let entry = PortType::Image(ImageKind::EntryPoints);
    let exit = PortType::Image(ImageKind::ExitPoints);
    let formats = vec![
        Choice::new("32-bit", "32-bit float", "Exact to a hundred-thousandth of a voxel of 512."),
        Choice::new("16-bit", "16-bit integer", "Off by up to 0.004 voxels of 512."),
        Choice::new("half", "16-bit float", "Off by up to 0.13 voxels of 512: visible."),
        Choice::new(
            "8-bit",
            "8-bit integer",
            "Off by up to a voxel of 512: plainly visible. For comparison with early GPU raycasters.",
        ),
    ];
    Declaration::new(crate::types::ENTRY_EXIT_POINTS, "Entry/exit points", "Geometry")
        .help(
            "For every pixel, the volume coordinates at which its ray enters and leaves the proxy geometry. The camera may \
             be inside the geometry: such rays start at the camera.",
        )
        .input(InportDecl::new("geometry", "Proxy geometry", &[PortType::Geometry]).help("A closed mesh."))
        .output(OutportDecl::new("entry", "Entry points", entry).help("Volume coordinates in xyz, 1 in w where a ray hits."))
        .output(OutportDecl::new("exit", "Exit points", exit).help("Volume coordinates in xyz, 1 in w where a ray hits."))
        .property(PropertyDecl::camera("camera", "Camera", Camera::default()).help("Where the eye is and where it looks."))
        .property(
            PropertyDecl::choice("format", "Format", "32-bit", formats)
                .help("How precisely the points are stored. The price of each is stated."),
        )
        .uses_render_size()
}

/// Draws the mesh twice: its nearest faces give the entry points, its farthest back faces the exit points.
pub fn process(context: &mut Context, job: &Job<'_, Data>) -> Result<Outputs<Data>, ProcessError> {
    let mesh = job.geometry("geometry")?;
    let view = View::new(&job.properties.camera("camera")?, job.size, mesh.volume.volume.texture_to_world())?;
    let format = format(job.properties.text("format")?, &context.gpu)?;
    let rays = context.gpu.uniform("ray planes", &Rays::of(&view))?;
    let corners = Corners::of(mesh, &context.gpu)?;
    let mut outputs = Outputs::new();
    for pass in [Pass::ENTRY, Pass::EXIT] {
        if job.wants(pass.outport) {
            let points = pass.draw(context, &rays, &corners, job.size, format)?;
            let image = Image { color: points, depth: None, kind: pass.kind, view: Some(view.clone()) };
            outputs = outputs.with(pass.outport, image.into());
        }
    }
    Ok(outputs)
}

fn format(id: &str, gpu: &Gpu) -> Result<TextureFormat, ProcessError> {
    match id {
        "16-bit" if !draws_unorm16(gpu) => Err(ProcessError::new(
            "this graphics device cannot draw into 16-bit integer textures; choose the format 32-bit or half",
        )),
        "16-bit" => Ok(TextureFormat::Rgba16Unorm),
        "half" => Ok(TextureFormat::Rgba16Float),
        "8-bit" => Ok(TextureFormat::Rgba8Unorm),
        _ => Ok(TextureFormat::Rgba32Float),
    }
}

/// Some devices that have 16-bit integer textures cannot draw into them, and only an attempt tells.
fn draws_unorm16(gpu: &Gpu) -> bool {
    let attempt =
        || gpu.texture_2d("attempt", [1, 1], TextureFormat::Rgba16Unorm, wgpu::TextureUsages::RENDER_ATTACHMENT);
    gpu.features.norm16 && attempt().is_ok()
}

/// The uniform of the shader.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Rays {
    volume_to_clip: [[f32; 4]; 4],
    near: [[f32; 4]; 3],
    far: [[f32; 4]; 3],
    pixel_to_device: [f32; 4],
}

impl Rays {
    fn of(view: &View) -> Self {
        let planes = view.ray_planes();
        let [width, height] = view.size.map(|pixels| pixels as f32);
        let padded = |plane: [DVec3; 3]| plane.map(|v| v.extend(0.0).as_vec4().to_array());
        Self {
            volume_to_clip: view.clip_matrix().as_mat4().to_cols_array_2d(),
            near: padded(planes.near),
            far: padded(planes.far),
            pixel_to_device: [2.0 / width, -2.0 / height, -1.0, 1.0],
        }
    }
}

/// The corners of all triangles on the device: position, first corner of the triangle, outward normal.
struct Corners {
    buffer: wgpu::Buffer,
    count: u32,
}

impl Corners {
    fn of(mesh: &Mesh, gpu: &Gpu) -> Result<Self, GpuError> {
        let mut corners: Vec<[[f32; 3]; 3]> = Vec::with_capacity(3 * mesh.indices.len());
        for triangle in &mesh.indices {
            let [a, b, c] = triangle.map(|corner| Vec3::from(mesh.positions[corner as usize]));
            let normal = (b - a).cross(c - a).to_array();
            corners.extend([a, b, c].map(|corner| [corner.to_array(), a.to_array(), normal]));
        }
        let buffer = gpu.buffer("proxy geometry", cast_slice(&corners), wgpu::BufferUsages::VERTEX)?;
        Ok(Self { buffer, count: corners.len() as u32 })
    }

    fn layout() -> VertexLayout {
        let attributes = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3].to_vec();
        VertexLayout { stride: 36, attributes }
    }
}

/// One of the two drawings. Depth runs from 1 on the near to 0 on the far plane.
struct Pass {
    outport: &'static str,
    kind: ImageKind,
    keep: wgpu::CompareFunction,
    clear_depth: f32,
}

impl Pass {
    const ENTRY: Pass =
        Pass { outport: "entry", kind: ImageKind::EntryPoints, keep: wgpu::CompareFunction::Greater, clear_depth: 0.0 };
    const EXIT: Pass =
        Pass { outport: "exit", kind: ImageKind::ExitPoints, keep: wgpu::CompareFunction::Less, clear_depth: 1.0 };

    fn state(&self, format: TextureFormat) -> RenderState {
        RenderState {
            vertex: "project".into(),
            fragment: self.outport.into(),
            buffers: vec![Corners::layout()],
            primitive: wgpu::PrimitiveState::default(),
            targets: vec![format.into()],
            depth: Some(wgpu::DepthStencilState {
                format: TextureFormat::Depth32Float,
                depth_write_enabled: Some(true),
                depth_compare: Some(self.keep),
                stencil: Default::default(),
                bias: Default::default(),
            }),
        }
    }

    fn draw(
        &self,
        context: &mut Context,
        rays: &wgpu::Buffer,
        corners: &Corners,
        size: [u32; 2],
        format: TextureFormat,
    ) -> Result<Arc<Texture>, GpuError> {
        let target = context.target(self.outport, size, format)?;
        let depth = context.target("depth test", size, TextureFormat::Depth32Float)?;
        let pipeline = context.pipelines.render(
            &context.gpu,
            "entry/exit points",
            &plain_shader(SHADER, &[]),
            &self.state(format),
        )?;
        let gpu = &context.gpu;
        gpu.guarded("entry/exit points", || {
            let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(self.outport),
                layout: &pipeline.get_bind_group_layout(0),
                entries: &[wgpu::BindGroupEntry { binding: 0, resource: rays.as_entire_binding() }],
            });
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some(self.outport),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &target.view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: &depth.view,
                    depth_ops: Some(wgpu::Operations {
                        load: wgpu::LoadOp::Clear(self.clear_depth),
                        store: wgpu::StoreOp::Discard,
                    }),
                    stencil_ops: None,
                }),
                timestamp_writes: context.timer.render_pass(),
                ..Default::default()
            });
            if corners.count > 0 {
                pass.set_pipeline(&pipeline);
                pass.set_bind_group(0, &group, &[]);
                pass.set_vertex_buffer(0, corners.buffer.slice(..));
                pass.draw(0..corners.count, 0..1);
            }
            drop(pass);
            gpu.queue.submit([encoder.finish()]);
        })?;
        Ok(target)
    }
}
