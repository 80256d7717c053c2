// What a pixel keeps from frame to frame beside its colour: the box it was in, how it moved, whose surface it showed, and where.
//
// x, y: the corners of the box, ten bits a channel, rounded outwards; the two bits above tell views why history was refused and how
// much it was clipped. z: motion in pixels, two halves. w: the object's id, or the bits of its depth.

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
