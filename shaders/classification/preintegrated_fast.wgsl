//! slot: classification
//! label: Pre-integrated, fast
//! help: Mean of the transfer function between two samples, from integral functions: opacity exact for values that run linearly, colour without self-attenuation.
//! reads: preintegration_fast, previous
//! visible: transfer_function

#include "classification/table.wgsl"
#include "classification/preintegrated.wgsl"

fn classify(s: Sample) -> vec4f {
    return preintegrated(s.previous, s.value);
}
