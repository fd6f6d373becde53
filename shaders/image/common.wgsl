// Shared by the image processors.

// The depth of a pixel in which nothing was hit.
const MISS: f32 = 3.0e38;

// The texel at a pixel. A texture of one texel stands for an input that is not connected, and serves every pixel.
fn texel_at(image: texture_2d<f32>, pixel: vec2u) -> vec4f {
    return textureLoad(image, min(pixel, textureDimensions(image) - vec2u(1u)), 0);
}

// `front` over `back`, both premultiplied.
fn over(front: vec4f, back: vec4f) -> vec4f {
    return front + (1.0 - front.a) * back;
}
