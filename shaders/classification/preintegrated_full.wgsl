//! slot: classification
//! label: Pre-integrated, full
//! help: The transfer function integrated between two samples with self-attenuation, tabulated for the step in use: catches spikes narrower than a step.
//! reads: preintegration_full, previous
//! visible: transfer_function

#include "classification/table.wgsl"
#include "classification/preintegrated.wgsl"

fn classify(s: Sample) -> vec4f {
    return preintegrated(s.previous, s.value);
}
