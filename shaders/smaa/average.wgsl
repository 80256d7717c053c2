// Two pictures of as many samples, averaged.

@group(0) @binding(1) var other: texture_2d<f32>;

@fragment
fn fs_average(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(position.xy);
    let a = textureLoad(picture, pixel, 0);
    let b = textureLoad(other, pixel, 0);
    // What is no number has no share; what is the same goes through no arithmetic.
    if !is_number(b) || all(a == b) {
        return passed_on(a);
    }
    if !is_number(a) {
        return passed_on(b);
    }
    return storable(0.5 * (blendable(a) + blendable(b)));
}
