// Intermediates to look at.

override WIDTH: i32 = 1;
override HEIGHT: i32 = 1;

@group(0) @binding(0) var masks: texture_2d<u32>;
@group(0) @binding(1) var weights: texture_2d<f32>;

// Red: an edge to the left; green: one above.
@fragment
fn fs_edges(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let edges = edges_at(vec2<i32>(WIDTH, HEIGHT), vec2<i32>(position.xy));
    return vec4<f32>(f32(edges.x), f32(edges.y), 0.0, 1.0);
}

// Red: taken from above; green: given to what is above; blue: both, across the edge to the left.
@fragment
fn fs_weights(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(position.xy);
    let edges = edges_at(vec2<i32>(WIDTH, HEIGHT), pixel);
    // Weights exist where there is an edge; elsewhere stands what an earlier picture left.
    let found = select(vec4<f32>(0.0), textureLoad(weights, pixel, 0), vec4<bool>(vec2<bool>(edges.yy), vec2<bool>(edges.xx)));
    return vec4<f32>(found.xy, found.z + found.w, 1.0);
}
