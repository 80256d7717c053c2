// Where FXAA has work: pixels whose neighbourhood spans enough of luma. "Above" stands for "has work" here.

override THRESHOLD: f32 = 0.166;
override THRESHOLD_MIN: f32 = 0.0833;
override LUMA_IS_GREEN: bool = false;

// Luma of every pixel, to search in.
@group(0) @binding(6) var luma: texture_storage_2d<r32float, write>;

fn luma_at(pixel: vec2<i32>) -> f32 {
    let rgb = display_at(pixel);
    return select(dot(rgb, vec3<f32>(0.299, 0.587, 0.114)), rgb.g, LUMA_IS_GREEN);
}

fn lumas_at(first: vec2<i32>) -> vec4<f32> {
    let x = vec2<i32>(1, 0);
    return vec4<f32>(luma_at(first), luma_at(first + x), luma_at(first + 2 * x), luma_at(first + 3 * x));
}

fn edges_of_four(first: vec2<i32>) -> Edges {
    let here = lumas_at(first);
    let left = vec4<f32>(luma_at(first - vec2<i32>(1, 0)), here.xyz);
    let right = vec4<f32>(here.yzw, luma_at(first + vec2<i32>(4, 0)));
    let above = lumas_at(first - vec2<i32>(0, 1));
    let below = lumas_at(first + vec2<i32>(0, 1));
    for (var i = 0; i < 4; i++) {
        let pixel = first + vec2<i32>(i, 0);
        if all(pixel < picture_size()) {
            textureStore(luma, pixel, vec4<f32>(here[i], 0.0, 0.0, 0.0));
        }
    }
    let highest = max(max(here, max(left, right)), max(above, below));
    let lowest = min(min(here, min(left, right)), min(above, below));
    return Edges(highest - lowest >= max(vec4<f32>(THRESHOLD_MIN), highest * THRESHOLD), vec4<bool>(false));
}
