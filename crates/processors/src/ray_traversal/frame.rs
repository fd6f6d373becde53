//! The uniform that is the same for every ray. Mirrors `Frame` in `shaders/traversal/types.wgsl`.

use bytemuck::{Pod, Zeroable};
use glam::{DMat3, DVec3};
use rayloom_network::{LightSpace, ProcessError, Properties};
use rayloom_volume::{ValueRange, Volume};

use super::tables::gradient_maximum;
use crate::View;

#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Frame {
    volume_to_world: [[f32; 4]; 3],
    gradient_to_world: [[f32; 4]; 3],
    depth_plane: [f32; 4],
    pub texel_scale: [f32; 4],
    pub texel_offset: [f32; 4],
    dims: [f32; 3],
    samples_per_voxel: f32,
    light_direction: [f32; 3],
    gradient_fade: f32,
    light_color: [f32; 3],
    termination_opacity: f32,
    pub brick_scale: [f32; 3],
    two_sided: f32,
    image_size: [u32; 2],
    pub max_samples: u32,
    gradient_scale: f32,
    pub label_minimum: f32,
    pub label_span: f32,
    jitter_seed: u32,
    /// Row of the picture at which the dispatch begins.
    pub first_row: u32,
}

/// Above every opacity: no ray stops early.
const NEVER: f64 = 2.0;

impl Frame {
    /// The frame of a view of a volume; texel mapping, bricks and labels are left to whoever binds the textures.
    pub fn new(view: &View, volume: &Volume, range: ValueRange, properties: &Properties) -> Result<Self, ProcessError> {
        let to_world = volume.texture_to_world().matrix3;
        let index_to_world = volume.index_to_world.matrix3;
        let spacing = mean_spacing(volume);
        let light = properties.light("light")?;
        let direction = match light.space {
            LightSpace::Camera => view.camera_to_world(light.direction.into()),
            LightSpace::World => light.direction.into(),
        };
        let function = properties.transfer_function_2d("transfer_function_2d")?;
        let error = properties.f64("termination_error")?;
        Ok(Self {
            volume_to_world: columns(to_world * (1.0 / reference_length(volume, properties)?)),
            gradient_to_world: columns(index_to_world.inverse().transpose() * spacing),
            depth_plane: view.depth_plane().as_vec4().to_array(),
            texel_scale: [1.0; 4],
            texel_offset: [0.0; 4],
            dims: volume.dims_f64().as_vec3().to_array(),
            samples_per_voxel: properties.f64("sampling_rate")? as f32,
            light_direction: direction.normalize_or_zero().as_vec3().to_array(),
            gradient_fade: properties.f64("gradient_fade")? as f32,
            light_color: DVec3::from(light.color).as_vec3().to_array(),
            termination_opacity: if error > 0.0 { 1.0 - error } else { NEVER } as f32,
            brick_scale: [1.0; 3],
            two_sided: f32::from(u8::from(properties.bool("two_sided")?)),
            image_size: view.size,
            max_samples: properties.int("max_samples")?.clamp(1, super::declare::MOST_SAMPLES) as u32,
            gradient_scale: (range.width() / spacing / gradient_maximum(function)) as f32,
            label_minimum: 0.0,
            label_span: 1.0,
            jitter_seed: properties.int("jitter_seed")? as u32,
            first_row: 0,
        })
    }
}

fn columns(matrix: DMat3) -> [[f32; 4]; 3] {
    let column = |axis: DVec3| axis.extend(0.0).as_vec4().to_array();
    [column(matrix.x_axis), column(matrix.y_axis), column(matrix.z_axis)]
}

/// The edge of a cube as large as a voxel, world units.
pub(super) fn mean_spacing(volume: &Volume) -> f64 {
    // Factor by factor, since the determinant of tiny and huge voxels leaves f64's range long before their edges do.
    let spacing = volume.spacing();
    let axes = volume.index_to_world.matrix3;
    let unit = DMat3::from_cols(axes.x_axis / spacing.x, axes.y_axis / spacing.y, axes.z_axis / spacing.z);
    spacing.x.cbrt() * spacing.y.cbrt() * spacing.z.cbrt() * unit.determinant().abs().cbrt()
}

/// The length to which opacities refer, world units.
pub(super) fn reference_length(volume: &Volume, properties: &Properties) -> Result<f64, ProcessError> {
    let chosen = properties.f64("reference_length")?;
    Ok(if chosen > 0.0 { chosen } else { mean_spacing(volume) })
}
