// Steps in reversed depth.
//
// Reversed depth is affine in screen space on a plane, so what a step adds to the slope on its smoother side is a silhouette,
// however steep the plane. Taken relative to the nearer of the two, it means the same at every distance.

// Of the nearer pixel's depth.
override DEPTH_STEP: f32 = 0.01;

@group(0) @binding(6) var depth: texture_depth_2d;

fn depth_at(pixel: vec2<i32>) -> f32 {
    return textureLoad(depth, inside(pixel), 0);
}

fn depths_at(first: vec2<i32>) -> vec4<f32> {
    let one = vec2<i32>(1, 0);
    return vec4<f32>(depth_at(first), depth_at(first + one), depth_at(first + 2 * one), depth_at(first + 3 * one));
}

// In order across the step: two before it, two after it.
fn is_step(a: vec4<f32>, b: vec4<f32>, c: vec4<f32>, d: vec4<f32>) -> vec4<bool> {
    let excess = min(abs((c - b) - (b - a)), abs((c - b) - (d - c)));
    return (excess >= DEPTH_STEP * max(b, c)) & (excess > vec4<f32>(0.0));
}

fn geometry_steps(first: vec2<i32>) -> Edges {
    let here = depths_at(first);
    let left = vec4<f32>(depth_at(first - vec2<i32>(1, 0)), here.xyz);
    let left_of_left = vec4<f32>(depth_at(first - vec2<i32>(2, 0)), left.xyz);
    let right = vec4<f32>(here.yzw, depth_at(first + vec2<i32>(4, 0)));
    let rows = vec2<i32>(0, 1);
    let above = is_step(depths_at(first - 2 * rows), depths_at(first - rows), here, depths_at(first + rows));
    return Edges(above, is_step(left_of_left, left, here, right));
}
