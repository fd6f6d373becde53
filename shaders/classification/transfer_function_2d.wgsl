//! slot: classification
//! label: 2-D transfer function
//! help: Colour and opacity of value and gradient magnitude together: tells boundaries from the materials they part.
//! reads: transfer_function_2d, gradient
//! visible: transfer_function_2d

#include "classification/table.wgsl"

fn classify(s: Sample) -> vec4f {
    return table_lookup_2d(transfer_table_2d, vec2f(s.value, length(s.gradient) * source.gradient_scale));
}
