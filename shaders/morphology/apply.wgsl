// The picture with the changed pixels put in.

@group(0) @binding(1) var touched: texture_2d<u32>;
@group(0) @binding(2) var patches: texture_2d<f32>;

@fragment
fn fs_apply(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(position.xy);
    let word = textureLoad(touched, vec2<i32>(pixel.x >> 4u, pixel.y), 0).x;
    if ((word >> u32(pixel.x & 15)) & 1u) == 1u {
        return textureLoad(patches, pixel, 0);
    }
    return passed_on(textureLoad(picture, pixel, 0));
}
