//! From rays to pixels, where a pixel is not one ray.

use rayloom_gpu::wgpu::TextureFormat;
use rayloom_network::{Job, ProcessError};

use super::dispatch::Target;
use crate::image_pass::{Bind, ImagePass};
use crate::{Context, Data, View};

const SHADER: &str = "image/resample.wgsl";

/// The picture of one ray a texel, made one of the size that was asked for, with the view of that. At a pixel rate of 1 it is
/// handed on as it is.
pub(super) fn resample(
    context: &mut Context,
    job: &Job<'_, Data>,
    rays: Target,
    view: &View,
) -> Result<(Target, View), ProcessError> {
    if job.properties.f64("pixel_rate")? == 1.0 {
        return Ok((rays, view.clone()));
    }
    let format = rays.color.texture.format();
    let pixels = Target {
        color: context.target("resampled image", job.size, format)?,
        depth: context.depth_target("resampled depth", job.size)?,
    };
    context.run_image_pass(&ImagePass {
        label: "pixels from rays",
        shader: SHADER,
        flags: if format == TextureFormat::Rgba16Float { &["half_targets"] } else { &[] },
        entry_point: "main",
        bindings: &[&rays.color, &rays.depth, &pixels.color, &pixels.depth].map(|texture| Bind::Texture(texture)),
        size: job.size,
    })?;
    let mut view = view.clone();
    view.size = job.size;
    Ok((pixels, view))
}
