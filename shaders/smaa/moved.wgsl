// The previous frame between its pixels.

fn row_between(pixel: vec2<i32>, t: f32, otherwise: vec4<f32>) -> vec4<f32> {
    return between(
        previous_at(pixel - vec2<i32>(1, 0), otherwise),
        previous_at(pixel, otherwise),
        previous_at(pixel + vec2<i32>(1, 0), otherwise),
        previous_at(pixel + vec2<i32>(2, 0), otherwise),
        t,
    );
}

// The picture at `pixel + t`, `t` in [0, 1).
fn moved(pixel: vec2<i32>, t: vec2<f32>, otherwise: vec4<f32>) -> vec4<f32> {
    if all(t == vec2<f32>(0.0)) {
        return previous_at(pixel, otherwise);
    }
    return between(
        row_between(pixel - vec2<i32>(0, 1), t.x, otherwise),
        row_between(pixel, t.x, otherwise),
        row_between(pixel + vec2<i32>(0, 1), t.x, otherwise),
        row_between(pixel + vec2<i32>(0, 2), t.x, otherwise),
        t.y,
    );
}
