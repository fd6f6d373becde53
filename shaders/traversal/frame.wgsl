@group(0) @binding(auto) var<uniform> frame: Frame;
@group(0) @binding(auto) var linear_sampler: sampler;
