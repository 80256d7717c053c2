// Intermediates to look at.

override WIDTH: i32 = 1;
override HEIGHT: i32 = 1;

@group(0) @binding(0) var masks: texture_2d<u32>;
@group(0) @binding(1) var row_weights: texture_2d<u32>;
@group(0) @binding(2) var column_weights: texture_2d<u32>;

// Bits of a weight: 16, or 14 below a count.
override WEIGHT_BITS: u32 = 16u;

// Red: an edge to the left; green: one above.
@fragment
fn fs_edges(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let edges = edges_at(vec2<i32>(WIDTH, HEIGHT), vec2<i32>(position.xy));
    return vec4<f32>(f32(edges.x), f32(edges.y), 0.0, 1.0);
}

fn weights_in(packed: u32) -> vec2<f32> {
    let mask = (1u << WEIGHT_BITS) - 1u;
    return vec2<f32>(vec2<u32>(packed & mask, (packed >> 16u) & mask)) / f32(mask);
}

// Red: taken from above; green: given to what is above; blue: both, across the edge to the left.
@fragment
fn fs_weights(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(position.xy);
    // Weights exist where there is an edge; elsewhere stands what an earlier picture left.
    let edges = vec2<f32>(edges_at(vec2<i32>(WIDTH, HEIGHT), pixel));
    let across_rows = edges.y * weights_in(textureLoad(row_weights, pixel, 0).x);
    let across_columns = edges.x * weights_in(textureLoad(column_weights, pixel, 0).x);
    return vec4<f32>(across_rows, across_columns.x + across_columns.y, 1.0);
}
