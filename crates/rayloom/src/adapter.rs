//! `rayloom adapter`: the graphics adapter that pictures are rendered on.

use rayloom_gpu::{Gpu, GpuOptions};

use crate::failure::Failure;

/// Describes the adapter, what it can do and the largest sizes it allows.
///
/// # Errors
/// There is none; the message says how to install one.
pub fn run() -> Result<String, Failure> {
    let gpu = Gpu::new(&GpuOptions::default())?;
    let offered = |offered| if offered { "yes" } else { "no" };
    let lines = [
        ("timestamp queries", offered(gpu.features.timestamps).to_owned()),
        ("filtered 32-bit floats", offered(gpu.features.float32_filterable).to_owned()),
        ("16-bit normalised textures", offered(gpu.features.norm16).to_owned()),
        ("largest volume", format!("{} voxels a side", gpu.limits.max_texture_dimension_3d)),
        ("largest picture", format!("{} pixels a side", gpu.limits.max_texture_dimension_2d)),
    ];
    let lines: String = lines.iter().map(|(name, value)| format!("  {name:<28}{value}\n")).collect();
    Ok(format!("{}\n{lines}", gpu.describe()))
}
