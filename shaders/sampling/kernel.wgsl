/// Sum over the 4x4x4 texels around `p` with separable weights: column k of `weights` holds the weights of offset k - 1.
fn weigh_64_texels(p: vec3f, weights: array<vec3f, 4>) -> vec4f {
    var w = weights;
    let base = vec3i(floor(p * frame.dims - 0.5));
    let last = vec3i(textureDimensions(volume)) - 1;
    var sum = vec4f(0.0);
    for (var z = 0; z < 4; z++) {
        for (var y = 0; y < 4; y++) {
            for (var x = 0; x < 4; x++) {
                let texel = clamp(base + vec3i(x, y, z) - 1, vec3i(0), last);
                sum += textureLoad(volume, texel, 0) * (w[x].x * w[y].y * w[z].z);
            }
        }
    }
    return sum;
}
