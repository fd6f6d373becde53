//! slot: classification
//! label: Transfer function
//! help: Colour and opacity of the value at the sample (post-classification).
//! reads: transfer_function
//! visible: transfer_function

#include "classification/table.wgsl"

fn classify(s: Sample) -> vec4f {
    return table_lookup(transfer_table, 0, s.value);
}
