// Four pixels in a row at a time: what steps at edges, and by how much.

// false: luma of the display values; true: the largest difference of the three channels.
override EDGES_BY_COLOR: bool = false;
// Luma's weights: of Rec. 601, or of Rec. 709.
override LUMA_IS_REC601: bool = false;

// Channel by channel; luma alone uses `x`.
struct Strip {
    x: vec4<f32>,
    y: vec4<f32>,
    z: vec4<f32>,
}

fn luma_of(rgb: vec3<f32>) -> f32 {
    return dot(rgb, select(vec3<f32>(0.2126, 0.7152, 0.0722), vec3<f32>(0.299, 0.587, 0.114), LUMA_IS_REC601));
}

fn feature_at(pixel: vec2<i32>) -> vec3<f32> {
    let rgb = display_at(pixel);
    return select(vec3<f32>(luma_of(rgb), 0.0, 0.0), rgb, EDGES_BY_COLOR);
}

fn strip_at(first: vec2<i32>) -> Strip {
    let a = feature_at(first);
    let b = feature_at(first + vec2<i32>(1, 0));
    let c = feature_at(first + vec2<i32>(2, 0));
    let d = feature_at(first + vec2<i32>(3, 0));
    return Strip(vec4<f32>(a.x, b.x, c.x, d.x), vec4<f32>(a.y, b.y, c.y, d.y), vec4<f32>(a.z, b.z, c.z, d.z));
}

// The four pixels to the left, or to the right, of a strip's.
fn moved_left(strip: Strip, entering: vec3<f32>) -> Strip {
    return Strip(vec4<f32>(entering.x, strip.x.xyz), vec4<f32>(entering.y, strip.y.xyz), vec4<f32>(entering.z, strip.z.xyz));
}

fn moved_right(strip: Strip, entering: vec3<f32>) -> Strip {
    return Strip(vec4<f32>(strip.x.yzw, entering.x), vec4<f32>(strip.y.yzw, entering.y), vec4<f32>(strip.z.yzw, entering.z));
}

fn step_between(a: Strip, b: Strip) -> vec4<f32> {
    let x = abs(a.x - b.x);
    return select(x, max(x, max(abs(a.y - b.y), abs(a.z - b.z))), EDGES_BY_COLOR);
}
