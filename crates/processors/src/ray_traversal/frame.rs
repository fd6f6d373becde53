//! The uniforms of the ray loop: what all rays share, and what belongs to a volume. They mirror `Frame` and `Source` in
//! `shaders/traversal/types.wgsl`.

use bytemuck::{Pod, Zeroable};
use glam::{DMat3, DVec3};
use rayloom_network::{LightSpace, ProcessError, Properties};
use rayloom_volume::{ValueRange, Volume};

use super::tables::gradient_maximum;
use crate::{View, step_length};

/// What is the same for every ray of a picture.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Frame {
    chord: [[f32; 4]; 3],
    pixel_to_device: [f32; 4],
    light_direction: [f32; 3],
    gradient_fade: f32,
    light_color: [f32; 3],
    termination_opacity: f32,
    image_size: [u32; 2],
    /// Distance from one sample to the next, reference lengths.
    pub step: f32,
    two_sided: f32,
    depths: [f32; 2],
    jitter_seed: u32,
    /// Row of the picture at which the dispatch begins.
    pub first_row: u32,
}

/// Above every opacity: no ray stops early.
const NEVER: f64 = 2.0;

impl Frame {
    /// The frame of a view of a volume. Its rays take at most `most_samples`.
    pub fn new(view: &View, volume: &Volume, properties: &Properties, most_samples: u32) -> Result<Self, ProcessError> {
        let reference_length = reference_length(volume, properties)?;
        let planes = view.ray_planes();
        let to_world = view.texture_to_world.matrix3 * (1.0 / reference_length);
        let chord = |i: usize| (to_world * (planes.far[i] - planes.near[i])).extend(0.0).as_vec4().to_array();
        let [width, height] = view.size.map(|pixels| pixels as f32);
        let light = properties.light("light")?;
        let direction = match light.space {
            LightSpace::Camera => view.camera_to_world(light.direction.into()),
            LightSpace::World => light.direction.into(),
        };
        let error = properties.f64("termination_error")?;
        let step =
            step_length(view, volume, properties.f64("sampling_rate")?).max(diagonal(volume) / f64::from(most_samples));
        Ok(Self {
            chord: [chord(0), chord(1), chord(2)],
            pixel_to_device: [2.0 / width, -2.0 / height, -1.0, 1.0],
            light_direction: direction.normalize_or_zero().as_vec3().to_array(),
            gradient_fade: properties.f64("gradient_fade")? as f32,
            light_color: DVec3::from(light.color).as_vec3().to_array(),
            termination_opacity: if error > 0.0 { 1.0 - error } else { NEVER } as f32,
            image_size: view.size,
            step: (step / reference_length) as f32,
            two_sided: f32::from(u8::from(properties.bool("two_sided")?)),
            depths: view.depths().map(|depth| depth as f32),
            jitter_seed: properties.int("jitter_seed")? as u32,
            first_row: 0,
        })
    }
}

/// What belongs to one volume.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Source {
    near: [[f32; 4]; 3],
    far: [[f32; 4]; 3],
    gradient_to_world: [[f32; 4]; 3],
    pub texel_scale: [f32; 4],
    pub texel_offset: [f32; 4],
    dims: [f32; 3],
    gradient_scale: f32,
    pub brick_scale: [f32; 3],
    pub label_minimum: f32,
    pub label_span: f32,
    padding: [f32; 3],
}

impl Source {
    /// A volume as a view sees it; texel mapping, bricks and labels are left to whoever binds the textures.
    pub fn new(view: &View, volume: &Volume, range: ValueRange, properties: &Properties) -> Result<Self, ProcessError> {
        let planes = view.ray_planes();
        let padded = |plane: [DVec3; 3]| plane.map(|v| v.extend(0.0).as_vec4().to_array());
        let index_to_world = volume.index_to_world.matrix3;
        let spacing = volume.mean_spacing();
        let function = properties.transfer_function_2d("transfer_function_2d")?;
        Ok(Self {
            near: padded(planes.near),
            far: padded(planes.far),
            gradient_to_world: columns(index_to_world.inverse().transpose() * spacing),
            texel_scale: [1.0; 4],
            texel_offset: [0.0; 4],
            dims: volume.dims_f64().as_vec3().to_array(),
            gradient_scale: (range.width() / spacing / gradient_maximum(function)) as f32,
            brick_scale: [1.0; 3],
            label_minimum: 0.0,
            label_span: 1.0,
            padding: [0.0; 3],
        })
    }
}

/// The longest way through a volume, world units.
pub(super) fn diagonal(volume: &Volume) -> f64 {
    let axes = volume.texture_to_world().matrix3;
    let diagonals = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    diagonals.into_iter().map(|(y, z)| (axes * DVec3::new(1.0, y, z)).length()).fold(0.0, f64::max)
}

fn columns(matrix: DMat3) -> [[f32; 4]; 3] {
    let column = |axis: DVec3| axis.extend(0.0).as_vec4().to_array();
    [column(matrix.x_axis), column(matrix.y_axis), column(matrix.z_axis)]
}

/// The length to which opacities refer, world units.
pub(super) fn reference_length(volume: &Volume, properties: &Properties) -> Result<f64, ProcessError> {
    let chosen = properties.f64("reference_length")?;
    Ok(if chosen > 0.0 { chosen } else { volume.mean_spacing() })
}
