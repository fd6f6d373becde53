@group(0) @binding(0) var<uniform> frame: Frame;
// Binding 1 holds the snippets' parameters.
@group(0) @binding(2) var volume: texture_3d<f32>;
#if filtering
@group(0) @binding(3) var linear_sampler: sampler;
#endif
@group(0) @binding(4) var entry_points: texture_2d<f32>;
@group(0) @binding(5) var exit_points: texture_2d<f32>;
#if transfer_function
@group(0) @binding(6) var transfer_table: texture_2d<f32>;
#endif
#if transfer_function_2d
@group(0) @binding(7) var transfer_table_2d: texture_2d<f32>;
#endif
#if preintegration_fast
@group(0) @binding(8) var preintegrated_table: texture_2d<f32>;
#endif
#if preintegration_full
@group(0) @binding(8) var preintegrated_table: texture_2d<f32>;
#endif
#if labels
@group(0) @binding(9) var label_volume: texture_3d<f32>;
@group(0) @binding(10) var label_table: texture_2d<f32>;
#endif
#if skipping
@group(0) @binding(11) var skip_map: texture_3d<u32>;
#endif
#if gaps
/// 1 where interpolation touches a voxel that has no value.
@group(0) @binding(14) var gap_map: texture_3d<u32>;
#endif
#if statistics
/// rays, then samples taken and samples contributing, each as low and high word.
@group(0) @binding(12) var<storage, read_write> counters: array<atomic<u32>, 6>;
#endif
#if sample_map
/// Per ray: samples taken, samples contributing, 0, and 1 where the ray meets the volume.
@group(0) @binding(13) var sample_map: texture_storage_2d<rgba32float, write>;
#endif
#each output
#if half_targets
@group(0) @binding(OUT_COLOR_BINDING) var OUT_color: texture_storage_2d<rgba16float, write>;
#else
@group(0) @binding(OUT_COLOR_BINDING) var OUT_color: texture_storage_2d<rgba32float, write>;
#endif
@group(0) @binding(OUT_DEPTH_BINDING) var OUT_depth: texture_storage_2d<r32float, write>;
#end
