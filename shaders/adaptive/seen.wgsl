// What a difference of light is to the eye.

struct AdaptiveFrame {
    // Factor on linear colour before the tone map.
    exposure: f32,
}

@group(0) @binding(0) var<uniform> frame: AdaptiveFrame;

// Nearly display values, by a root, which costs a tenth of the sRGB curve; what is brighter than white is white.
fn seen(linear: vec3<f32>) -> vec3<f32> {
    return sqrt(clamp(frame.exposure * linear, vec3<f32>(0.0), vec3<f32>(1.0)));
}
