// The two halves of the weighted sum, put together and divided by the sum of weights (in alpha).

@group(0) @binding(0) var half_a: texture_2d<f32>;
@group(0) @binding(1) var half_b: texture_2d<f32>;

@fragment
fn fs_normalize(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(position.xy);
    let sum = textureLoad(half_a, pixel, 0) + textureLoad(half_b, pixel, 0);
    return vec4<f32>(sum.rgb / sum.a, 1.0);
}
