//! slot: classification
//! label: Labels
//! help: A transfer function for each label; the label is that of the nearest voxel, the value is interpolated.
//! reads: labels

#include "classification/table.wgsl"

fn classify(s: Sample) -> vec4f {
    let size = vec3i(textureDimensions(label_volume));
    let voxel = clamp(vec3i(floor(s.position * vec3f(size))), vec3i(0), size - 1);
    let label = i32(round(source.label_minimum + source.label_span * textureLoad(label_volume, voxel, 0).x));
    let rows = i32(textureDimensions(label_table).y);
    // The last row, behind those of all labels, is transparent.
    let row = select(rows - 1, min(label, rows - 1), label >= 0);
    return table_lookup(label_table, row, s.value);
}
