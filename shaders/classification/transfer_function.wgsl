//! slot: classification
//! label: Transfer function
//! help: Colour and opacity of the value at the sample (post-classification).
//! reads: transfer_function
//! visible: transfer_function

#include "classification/transfer_table.wgsl"

fn classify(s: Sample) -> vec4f {
    return transfer_lookup(s.value);
}
