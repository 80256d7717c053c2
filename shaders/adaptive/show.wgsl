// The mean of a pixel's samples, and how many they are.

// Samples a pixel at most.
override MOST: f32 = 64.0;

@group(0) @binding(0) var total: texture_2d<f32>;

@fragment
fn fs_show(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let sum = textureLoad(total, vec2<i32>(position.xy), 0);
    return vec4<f32>(sum.rgb / sum.a, 1.0);
}

// Black one sample, white the most, a step each time they double.
@fragment
fn fs_refine(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let count = textureLoad(total, vec2<i32>(position.xy), 0).a;
    return vec4<f32>(vec3<f32>(log2(count) / max(log2(MOST), 1.0)), 1.0);
}
