// A linear picture to display values.

struct PresentUniforms {
    exposure: f32,
    tone_map: u32,
}

@group(0) @binding(0) var picture: texture_2d<f32>;
@group(0) @binding(1) var<uniform> uniforms: PresentUniforms;

@fragment
fn fs_present(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let color = textureLoad(picture, vec2<i32>(position.xy), 0).rgb;
    // What is no number should be seen, not guessed.
    if !is_finite(color) {
        return vec4<f32>(1.0, 0.0, 1.0, 1.0);
    }
    return vec4<f32>(srgb_coded(tone_mapped(uniforms.exposure * color, uniforms.tone_map)), 1.0);
}
