// One threshold for the whole picture.

struct Thresholds {
    above: vec4<f32>,
    left: vec4<f32>,
}

fn thresholds_of_four(first: vec2<i32>) -> Thresholds {
    return Thresholds(vec4<f32>(THRESHOLD), vec4<f32>(THRESHOLD));
}
