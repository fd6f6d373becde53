//! Transfer functions as textures of media: (extinction x colour, extinction) a reference length, rgba32float.

use std::sync::Arc;

use bytemuck::cast_slice;
use rayloom_gpu::wgpu::{TextureFormat, TextureUsages};
use rayloom_gpu::{Gpu, GpuError, Texture};
use rayloom_volume::{LabelTable, SplitTable, TransferFunction, TransferFunction2D, ValueRange};

/// Entries of most 1-D tables: 16 KiB, which a first-level cache holds.
pub(super) const ENTRIES: usize = 1024;
/// How many times as many cells a 1-D table may have whose ramps are steep: no more than the 8192 texels that every device allows.
const FINEST: usize = 8;
/// Entries along each axis of a 2-D table.
pub(super) const ENTRIES_2D: usize = 256;

fn upload(gpu: &Gpu, label: &str, size: [usize; 2], entries: &[[f32; 4]]) -> Result<Arc<Texture>, GpuError> {
    let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
    let size = size.map(|side| side as u32);
    let texture = gpu.texture_2d(label, size, TextureFormat::Rgba32Float, usage)?;
    gpu.upload(&texture, cast_slice(entries))?;
    Ok(Arc::new(texture))
}

/// One row over the value range; the rows of a split table where the function has steps.
pub(super) fn table(gpu: &Gpu, function: &TransferFunction, range: ValueRange) -> Result<Arc<Texture>, GpuError> {
    let entries = function.table_entries(range, ENTRIES, FINEST);
    if !has_steps(function, range) {
        return upload(gpu, "transfer function", [entries, 1], &function.table(range, entries));
    }
    let table = function.split_table(range, entries);
    upload(gpu, "transfer function", [table.width, SplitTable::ROWS], &table.entries)
}

/// Whether the table is cut at steps.
pub(super) fn has_steps(function: &TransferFunction, range: ValueRange) -> bool {
    function.has_steps(range, ENTRIES, FINEST)
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
