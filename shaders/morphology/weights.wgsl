// Blending weights: how far the picture behind each edge reaches into the pixels beside it. Two unorm16: what this pixel takes from
// the one across the edge, and what that one takes from this.

// Pixels that a search along a line may go, each way.
override LINE_REACH: i32 = 32;
// 0 keeps corners sharp, 1 rounds them as if they were none.
override CORNER_ROUNDING: f32 = 0.25;

@group(0) @binding(0) var masks: texture_2d<u32>;
// Areas beside lines by their ends: 4 x 4 patterns of what crosses at each end, in each a square of distances to the ends.
@group(0) @binding(1) var areas: texture_2d<u32>;
@group(0) @binding(2) var<storage, read> tally: array<u32>;
@group(0) @binding(3) var<storage, read> pixels: array<u32>;
@group(0) @binding(4) var weights: texture_storage_2d<r32uint, write>;

// What crosses at an end of a line: 1 above it, 2 below it, 3 both.
fn end_pattern(axis: Axis, at: i32, line: i32) -> i32 {
    return i32(crossing(axis, at, line - 1) | (crossing(axis, at, line) << 1u));
}

// How much of this pixel is taken by what lies above its edge, and how much the pixel above takes of this one.
fn line_weights(axis: Axis, at: i32, line: i32) -> vec2<f32> {
    let start = line_start(axis, at, line, LINE_REACH);
    let end = line_end(axis, at, line, LINE_REACH);
    let distances = vec2<i32>(at - start, end - at);
    let ends = vec2<i32>(end_pattern(axis, start, line), end_pattern(axis, end + 1, line));
    return area(areas, ends, distances) * sharpened(axis, line, start, end, distances);
}

// Where a line turns a right angle, its nearer half is blended less: it is a corner, not a slope.
fn sharpened(axis: Axis, line: i32, start: i32, end: i32, distances: vec2<i32>) -> vec2<f32> {
    if CORNER_ROUNDING >= 1.0 {
        return vec2<f32>(1.0);
    }
    let nearer = vec2<f32>(distances.xy <= distances.yx);
    let less = (1.0 - CORNER_ROUNDING) * nearer / (nearer.x + nearer.y);
    let below = vec2<f32>(f32(crossing(axis, start, line + 1)), f32(crossing(axis, end + 1, line + 1)));
    let above = vec2<f32>(f32(crossing(axis, start, line - 2)), f32(crossing(axis, end + 1, line - 2)));
    return max(1.0 - vec2<f32>(dot(less, below), dot(less, above)), vec2<f32>(0.0));
}

fn packed(weights: vec2<f32>) -> u32 {
    return pack2x16unorm(weights);
}
