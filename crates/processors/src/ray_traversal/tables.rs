//! Transfer functions as textures of media: (extinction x colour, extinction) a reference length, rgba32float.

use std::sync::Arc;

use bytemuck::cast_slice;
use rayloom_gpu::wgpu::{TextureFormat, TextureUsages};
use rayloom_gpu::{Gpu, GpuError, Texture};
use rayloom_volume::{Knot, LabelTable, TransferFunction, TransferFunction2D, ValueRange};

/// Entries of a 1-D table: 16 KiB, which a first-level cache holds.
pub(super) const ENTRIES: usize = 1024;
/// Entries of a 1-D table with steps, each of which is as wide as a cell: 128 KiB, eight cells for one of the others, and no more
/// than the 8192 texels that every device allows.
const ENTRIES_OF_STEPS: usize = 8 * (ENTRIES - 1) + 1;
/// Entries along each axis of a 2-D table.
pub(super) const ENTRIES_2D: usize = 256;

fn upload(gpu: &Gpu, label: &str, size: [usize; 2], entries: &[[f32; 4]]) -> Result<Arc<Texture>, GpuError> {
    let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
    let size = size.map(|side| side as u32);
    let texture = gpu.texture_2d(label, size, TextureFormat::Rgba32Float, usage)?;
    gpu.upload(&texture, cast_slice(entries))?;
    Ok(Arc::new(texture))
}

/// One row over the value range.
pub(super) fn table(gpu: &Gpu, function: &TransferFunction, range: ValueRange) -> Result<Arc<Texture>, GpuError> {
    let entries = if has_steps(function, range) { ENTRIES_OF_STEPS } else { ENTRIES };
    upload(gpu, "transfer function", [entries, 1], &function.table(range, entries))
}

/// Whether a function jumps, or rises or falls within less than a cell of the smaller table.
fn has_steps(function: &TransferFunction, range: ValueRange) -> bool {
    // A hundredth of a cell less, because knots on the entries themselves are no steps, whichever way they were rounded.
    let cell = 0.99 * range.width() / (ENTRIES - 1) as f64;
    let narrow = |pair: &[Knot]| pair[1].at - pair[0].at < cell && pair[0].right_side() != pair[1].left_side();
    function.knots.iter().any(|knot| knot.right.is_some()) || function.knots.windows(2).any(narrow)
}

/// Rows of rising gradient magnitude, 0 to `gradient_maximum`.
pub(super) fn table_2d(gpu: &Gpu, function: &TransferFunction2D, range: ValueRange) -> Result<Arc<Texture>, GpuError> {
    let entries = function.table(range, gradient_maximum(function), ENTRIES_2D, ENTRIES_2D);
    upload(gpu, "2-D transfer function", [ENTRIES_2D, ENTRIES_2D], &entries)
}

/// The gradient magnitude of a 2-D table's last row: just above all shapes, so that it is clear and what lies beyond, too.
pub(super) fn gradient_maximum(function: &TransferFunction2D) -> f64 {
    let top = function.gradient_maximum();
    if top > 0.0 { top * (1.0 + 2.0 / ENTRIES_2D as f64) } else { 1.0 }
}

/// Columns: value at the front, rows: value at the back of a segment; with self-attenuation for a segment of
/// `length` reference lengths, or without.
pub(super) fn preintegrated(
    gpu: &Gpu,
    function: &TransferFunction,
    range: ValueRange,
    length: Option<f64>,
) -> Result<Arc<Texture>, GpuError> {
    let entries = match length {
        Some(length) => function.preintegration_full(range, ENTRIES_2D, length),
        None => function.preintegration_fast(range, ENTRIES_2D),
    };
    upload(gpu, "pre-integrated transfer function", [ENTRIES_2D, ENTRIES_2D], &entries)
}

/// One row a label, from label 0; labels without an entry are transparent, as is the row behind the last.
pub(super) fn labels(gpu: &Gpu, table: &LabelTable, range: ValueRange) -> Result<Arc<Texture>, GpuError> {
    let rows = table.labels.last_key_value().map_or(0, |(label, _)| *label as usize + 1) + 1;
    // A table too tall for the device is refused before it is filled.
    gpu.texture_2d(
        "label table",
        [ENTRIES_2D as u32, rows.min(u32::MAX as usize) as u32],
        TextureFormat::Rgba32Float,
        TextureUsages::TEXTURE_BINDING,
    )?;
    let mut entries = vec![[0.0; 4]; rows * ENTRIES_2D];
    for (label, meaning) in &table.labels {
        let row = meaning.transfer_function.table(range, ENTRIES_2D);
        entries[*label as usize * ENTRIES_2D..][..ENTRIES_2D].copy_from_slice(&row);
    }
    upload(gpu, "label table", [ENTRIES_2D, rows], &entries)
}
