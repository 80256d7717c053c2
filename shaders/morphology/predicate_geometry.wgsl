// A higher threshold, lowered where the geometry steps: textures are spared, silhouettes are found.

override PREDICATION_SCALE: f32 = 2.0;
override PREDICATION_STRENGTH: f32 = 0.4;

struct Thresholds {
    above: vec4<f32>,
    left: vec4<f32>,
}

fn thresholds_of_four(first: vec2<i32>) -> Thresholds {
    let steps = geometry_steps(first);
    let high = vec4<f32>(PREDICATION_SCALE * THRESHOLD);
    let low = high * (1.0 - PREDICATION_STRENGTH);
    return Thresholds(select(high, low, steps.above), select(high, low, steps.left));
}
