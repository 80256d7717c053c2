// What a pixel keeps from frame to frame beside its colour: the box it was in, how it moved, whose surface it showed, and where.
//
// x, y: the corners of the box, ten bits a channel, rounded outwards; the two bits above tell views why history was refused and how
// much it was clipped. z: motion in 64ths of a pixel, two signed halves of the word. w: the object's id, or the bits of its depth.

// Anything between -inf and inf in [-1, 1], finest near zero, as the eye is.
fn companded(x: vec3<f32>) -> vec3<f32> {
    let y = frame.exposure * abs(x);
    return sign(x) * sqrt(y / (1.0 + y));
}

fn expanded(companded: vec3<f32>) -> vec3<f32> {
    let y = companded * companded;
    return sign(companded) * y / (max(1.0 - y, vec3<f32>(1e-6)) * frame.exposure);
}

fn packed_corner(code: vec3<f32>, note: u32) -> u32 {
    let bits = vec3<u32>(clamp(code, vec3<f32>(-511.0), vec3<f32>(511.0)) + 512.0);
    return bits.x | (bits.y << 10u) | (bits.z << 20u) | (note << 30u);
}

// In steps, from -511 to 511.
fn corner_code(packed: u32) -> vec3<f32> {
    return vec3<f32>(vec3<u32>(packed, packed >> 10u, packed >> 20u) & vec3<u32>(1023u)) - 512.0;
}

fn low_code(low: vec3<f32>) -> vec3<f32> {
    return floor(511.0 * companded(low));
}

fn high_code(high: vec3<f32>) -> vec3<f32> {
    return ceil(511.0 * companded(high));
}

// Motion as far as it is remembered: what is faster than this is told apart from what is slow, not from what is faster still.
fn shortened(motion_px: vec2<f32>) -> vec2<f32> {
    return clamp(motion_px, vec2<f32>(-500.0), vec2<f32>(500.0));
}

fn packed_motion(motion_px: vec2<f32>) -> u32 {
    let steps = vec2<i32>(round(64.0 * shortened(motion_px)));
    return (u32(steps.x) & 0xffffu) | (u32(steps.y) << 16u);
}

fn motion_px_of(packed: u32) -> vec2<f32> {
    let steps = vec2<i32>(i32(packed << 16u) >> 16u, i32(packed) >> 16u);
    return vec2<f32>(steps) / 64.0;
}
