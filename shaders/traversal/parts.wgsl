#include "traversal/types.wgsl"
#include "traversal/frame.wgsl"
#parameters
#constants
#include "traversal/ray.wgsl"
#snippet lattice
#include "traversal/medium.wgsl"
#each source
#include "traversal/source.wgsl"
#snippet sampling
#snippet gaps
#snippet gradient
#snippet slope
#snippet classification
#snippet lighting
#snippet skipping
#end
#snippet shading
#snippet refinement
#include "traversal/walk.wgsl"
#snippet stepping
#snippet endings
