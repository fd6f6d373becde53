//! Slice view: a plane through a volume.

use bytemuck::{Pod, Zeroable};
use glam::{DAffine3, DVec3, Vec3};
use rayloom_gpu::Texture;
use rayloom_gpu::wgpu::{TextureFormat, TextureUsages};
use rayloom_network::{
    Choice, Declaration, ImageKind, InportDecl, Job, OutportDecl, Outputs, PortType, ProcessError, Properties,
    PropertyDecl,
};
use rayloom_volume::{MAX_EXTINCTION, TransferFunction, ValueRange, Volume, fraction};

use crate::{Bind, Context, Data, GpuVolume, Image, ImagePass, JobData};

const SHADER: &str = "image/slice_view.wgsl";

/// Entries of the table that a transfer function is read from.
const TABLE: usize = 4096;

/// As in the shader.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Parameters {
    origin: [f32; 4],
    per_x: [f32; 4],
    per_y: [f32; 4],
    scale: [f32; 4],
    offset: [f32; 4],
    channel: u32,
    interpolation: u32,
    is_opaque: u32,
}

/// Ports, properties and help.
pub fn declaration() -> Declaration {
    let volume = InportDecl::new("volume", "Volume", &[PortType::Volume]).help("The volume to cut.");
    let image = OutportDecl::new("image", "Image", PortType::Image(ImageKind::Color))
        .help("The plane in true proportions, as large as fits; transparent outside of the volume. Without depth.");
    let declaration = Declaration::new(crate::types::SLICE_VIEW, "Slice view", "Rendering")
        .help(
            "Shows a plane through a volume: a slice across one of its axes, or any plane in the world. Values between voxels \
             are interpolated in full precision.",
        )
        .input(volume)
        .output(image)
        .uses_render_size();
    color_properties(plane_properties(declaration))
}

fn plane_properties(declaration: Declaration) -> Declaration {
    let planes = vec![
        Choice::new("x", "Across x", "y to the right, z up (voxel axes)."),
        Choice::new("y", "Across y", "x to the right, z up (voxel axes)."),
        Choice::new("z", "Across z", "x to the right, y up (voxel axes)."),
        Choice::new("oblique", "Oblique", "Any plane, seen from where its normal points to."),
    ];
    declaration
        .property(PropertyDecl::choice("plane", "Plane", "z", planes).help("Which way the plane lies."))
        .property(
            PropertyDecl::float("position", "Position", 0.5)
                .range(0.0, 1.0)
                .help("Where a slice lies along its axis: 0 and 1 are the sides of the volume, half a voxel beyond the outermost voxel centres."),
        )
        .property(
            PropertyDecl::vector("normal", "Normal", &[0.0, -1.0, 1.0])
                .help("The direction, in the world, from which an oblique plane is seen."),
        )
        .property(
            PropertyDecl::float("offset", "Offset", 0.0)
                .unit("world units")
                .help("How far an oblique plane lies from the centre of the volume, along the normal."),
        )
        .property(
            PropertyDecl::float("zoom", "Zoom", 1.0)
                .range(0.01, 1000.0)
                .logarithmic()
                .help("Magnification; 1 shows the whole volume."),
        )
        .property(
            PropertyDecl::vector("pan", "Pan", &[0.0, 0.0])
                .unit("world units")
                .help("What lies in the middle of the image, right of and above the middle of the plane."),
        )
}

fn color_properties(declaration: Declaration) -> Declaration {
    let interpolations = vec![
        Choice::new("linear", "Linear", "Values are interpolated between voxel centres."),
        Choice::new("nearest", "Nearest", "Every voxel is a block: what is stored, and right for labels."),
    ];
    let colors = vec![
        Choice::new("window", "Window", "Grays over a window of values, opaque."),
        Choice::new(
            "transfer_function",
            "Transfer function",
            "Colour and opacity of one reference length of the medium.",
        ),
        Choice::new(
            "opaque",
            "Transfer function, opaque",
            "The transfer function's colours wherever its opacity is not zero.",
        ),
    ];
    declaration
        .property(
            PropertyDecl::int("channel", "Channel", 0)
                .int_range(0, 3)
                .help("The channel to show, counted from 0. Gradients are shown per voxel step."),
        )
        .property(
            PropertyDecl::choice("interpolation", "Interpolation", "linear", interpolations)
                .help("What is shown between voxel centres."),
        )
        .property(PropertyDecl::choice("colors", "Colours", "window", colors).help("How values become colours."))
        .property(
            PropertyDecl::bool("automatic", "Automatic window", true)
                .help("On: the window is the value range of the volume."),
        )
        .property(
            PropertyDecl::vector("window", "Window", &[0.0, 1.0])
                .unit("data units")
                .help("Without automatic window: the values shown black and white; the first may be the larger one."),
        )
        .property(
            PropertyDecl::transfer_function(
                "transfer_function",
                "Transfer function",
                TransferFunction::ramp(ValueRange::new(0.0, 1.0), 1.0),
            )
            .help("Colour and opacity over data values."),
        )
}

/// Draws the plane.
pub fn process(context: &mut Context, job: &Job<'_, Data>) -> Result<Outputs<Data>, ProcessError> {
    let (data, properties) = (job.volume("volume")?, job.properties);
    let volume = &*data.volume;
    let channel = properties.int("channel")?;
    let channel = usize::try_from(channel).ok().filter(|&c| c < volume.channels as usize).ok_or_else(|| {
        ProcessError::new(format!(
            "channel {channel} was chosen, but the volume `{}` has {}; choose a smaller one",
            volume.name, volume.channels
        ))
    })?;
    let plane = Plane::choose(properties, volume)?;
    let colors = Colors::choose(properties, volume, channel)?;
    let uploaded = data.on_gpu(&context.gpu)?;
    let parameters = parameters(properties, &plane, &colors, uploaded, channel, job.size)?;
    let table = upload_table(context, &colors.table)?;
    let color = context.color_target("a slice", job.size)?;
    context.run_image_pass(&ImagePass {
        label: "slice view",
        shader: SHADER,
        flags: &[],
        entry_point: "main",
        bindings: &[
            Bind::Uniform(bytemuck::bytes_of(&parameters)),
            Bind::Texture(&uploaded.texture),
            Bind::Texture(&table),
            Bind::Texture(&color),
        ],
        size: job.size,
    })?;
    let image = Image { color, depth: None, kind: ImageKind::Color, view: None };
    Ok(Outputs::new().with("image", image.into()))
}

/// A rectangle in the world that shows a plane through a volume.
struct Plane {
    /// Middle of the plane, world.
    center: DVec3,
    /// Unit vectors to the right and up, world.
    right: DVec3,
    up: DVec3,
    /// How far the volume reaches to the right and up from the middle, world units.
    reach: [f64; 2],
    /// World to volume coordinates.
    to_texture: DAffine3,
    /// For a slice: the axis that it crosses and its coordinate there, which holds exactly.
    fixed: Option<(usize, f64)>,
}

impl Plane {
    fn choose(properties: &Properties, volume: &Volume) -> Result<Self, ProcessError> {
        let to_world = volume.texture_to_world();
        let columns = [to_world.matrix3.x_axis, to_world.matrix3.y_axis, to_world.matrix3.z_axis];
        let position = properties.f64("position")?;
        let slice = |axis: usize, right: usize, up: usize| {
            let mut center = DVec3::splat(0.5);
            center[axis] = position;
            let right = columns[right].normalize();
            let up = columns[up].reject_from_normalized(right).normalize();
            Self::spanned(&to_world, to_world.transform_point3(center), right, up, Some((axis, position)))
        };
        Ok(match properties.text("plane")? {
            "x" => slice(0, 1, 2),
            "y" => slice(1, 0, 2),
            "oblique" => {
                let normal = DVec3::from_array(properties.array("normal")?);
                let normal = normal.try_normalize().ok_or_else(|| {
                    ProcessError::new(format!(
                        "the normal of the plane is {normal}, which has no direction; give it a length"
                    ))
                })?;
                let upright = if normal.z.abs() < 0.999 { DVec3::Z } else { DVec3::Y };
                let right = upright.cross(normal).normalize();
                let center = to_world.transform_point3(DVec3::splat(0.5)) + normal * properties.f64("offset")?;
                Self::spanned(&to_world, center, right, normal.cross(right), None)
            }
            _ => slice(2, 0, 1),
        })
    }

    fn spanned(to_world: &DAffine3, center: DVec3, right: DVec3, up: DVec3, fixed: Option<(usize, f64)>) -> Self {
        // A box reaches half the sum of its edges in any direction.
        let m = to_world.matrix3;
        let reach = |direction: DVec3| 0.5 * (m.transpose() * direction).abs().element_sum();
        Self { center, right, up, reach: [reach(right), reach(up)], to_texture: to_world.inverse(), fixed }
    }

    /// Volume coordinates of the image's corner, and how they grow per pixel to the right and down.
    fn pixels(&self, [width, height]: [u32; 2], zoom: f64, pan: [f64; 2]) -> [DVec3; 3] {
        let (width, height) = (f64::from(width), f64::from(height));
        let pixel = (2.0 * self.reach[0] / width).max(2.0 * self.reach[1] / height) / zoom;
        let middle = self.center + self.right * pan[0] + self.up * pan[1];
        let corner = middle - self.right * (0.5 * width * pixel) + self.up * (0.5 * height * pixel);
        let mut origin = self.to_texture.transform_point3(corner);
        let mut per_x = self.to_texture.transform_vector3(self.right * pixel);
        let mut per_y = self.to_texture.transform_vector3(self.up * -pixel);
        if let Some((axis, coordinate)) = self.fixed {
            (origin[axis], per_x[axis], per_y[axis]) = (coordinate, 0.0, 0.0);
        }
        [origin, per_x, per_y]
    }
}

/// How normalised values become colours.
struct Colors {
    /// The table of the shader.
    table: Vec<[f32; 4]>,
    /// Where in the table a normalised value is: value * gain + bias, from 0 to 1.
    gain: f64,
    bias: f64,
    is_opaque: bool,
}

impl Colors {
    fn choose(properties: &Properties, volume: &Volume, channel: usize) -> Result<Self, ProcessError> {
        let range = volume.ranges()[channel];
        let colors = properties.text("colors")?;
        if colors != "window" {
            let table = properties.transfer_function("transfer_function")?.table(range, TABLE);
            return Ok(Self { table, gain: 1.0, bias: 0.0, is_opaque: colors == "opaque" });
        }
        let opaque = MAX_EXTINCTION as f32;
        let table = vec![[0.0, 0.0, 0.0, opaque], [opaque; 4]];
        if properties.bool("automatic")? {
            return Ok(Self { table, gain: 1.0, bias: 0.0, is_opaque: true });
        }
        let [black, white] = properties.array("window")?;
        if black == white {
            return Err(ProcessError::new(format!(
                "the window [{black}, {white}] is empty; give it two different ends"
            )));
        }
        let share = |value: f64| fraction(value, black, white);
        Ok(Self { table, gain: share(range.max) - share(range.min), bias: share(range.min), is_opaque: true })
    }
}

fn parameters(
    properties: &Properties,
    plane: &Plane,
    colors: &Colors,
    volume: &GpuVolume,
    channel: usize,
    size: [u32; 2],
) -> Result<Parameters, ProcessError> {
    let [origin, per_x, per_y] = plane.pixels(size, properties.f64("zoom")?, properties.array("pan")?).map(extended);
    let (mut scale, mut offset) = (volume.scale, volume.offset);
    scale[channel] = (f64::from(scale[channel]) * colors.gain) as f32;
    offset[channel] = (f64::from(offset[channel]) * colors.gain + colors.bias) as f32;
    Ok(Parameters {
        origin,
        per_x,
        per_y,
        scale,
        offset,
        channel: channel as u32,
        interpolation: u32::from(properties.text("interpolation")? == "nearest"),
        is_opaque: u32::from(colors.is_opaque),
    })
}

fn extended(v: DVec3) -> [f32; 4] {
    let v: Vec3 = v.as_vec3();
    v.extend(0.0).to_array()
}

fn upload_table(context: &Context, table: &[[f32; 4]]) -> Result<Texture, ProcessError> {
    let size = [table.len() as u32, 1];
    let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
    let texture = context.gpu.texture_2d("a transfer function", size, TextureFormat::Rgba32Float, usage)?;
    context.gpu.upload(&texture, bytemuck::cast_slice(table))?;
    Ok(texture)
}
