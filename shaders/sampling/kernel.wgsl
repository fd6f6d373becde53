/// Sum over the 4x4x4 texels around `x` (voxel centres at whole numbers) with separable weights: element k of `weights` holds the weights of offset k - 1.
/// Beyond the border the voxels are mirrored at the outermost ones (`mirror`) or the outermost ones go on.
fn weigh_64_texels(x: vec3f, weights: array<vec3f, 4>, mirror: bool) -> vec4f {
    var w = weights;
    let base = vec3i(floor(x));
    let last = vec3i(textureDimensions(volume)) - 1;
    var sum = vec4f(0.0);
    for (var k = 0; k < 4; k++) {
        for (var j = 0; j < 4; j++) {
            for (var i = 0; i < 4; i++) {
                let there = base + vec3i(i, j, k) - 1;
                let mirrored = last - abs(last - abs(there));
                let texel = clamp(select(there, mirrored, mirror), vec3i(0), last);
                sum += textureLoad(volume, texel, 0) * (w[i].x * w[j].y * w[k].z);
            }
        }
    }
    return sum;
}
