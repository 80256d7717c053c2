// Blending weights: how far the picture behind each edge reaches into the pixels beside it.

// Pixels that a search along a line, or along a diagonal, may go.
override LINE_REACH: i32 = 32;
override DIAGONAL_REACH: i32 = 8;
// 0 keeps corners sharp, 1 rounds them as if they were none.
override CORNER_ROUNDING: f32 = 0.25;

@group(0) @binding(0) var masks: texture_2d<u32>;
// Areas beside lines by their ends: 4 x 4 patterns of what crosses at each end, in each a square of distances to the ends.
@group(0) @binding(1) var line_areas: texture_2d<u32>;
@group(0) @binding(2) var diagonal_areas: texture_2d<u32>;
@group(0) @binding(3) var<storage, read> tally: array<u32>;
@group(0) @binding(4) var<storage, read> pixels: array<u32>;
@group(0) @binding(5) var weights: texture_storage_2d<rgba16float, write>;

fn area(areas: texture_2d<u32>, ends: vec2<i32>, distances: vec2<i32>) -> vec2<f32> {
    let side = i32(textureDimensions(areas).x) / 4;
    return unpack2x16unorm(textureLoad(areas, ends * side + distances, 0).x);
}

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
    return area(line_areas, ends, distances) * sharpened(axis, line, start, end, distances);
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

// A step of a staircase at a pixel: x the edge to its left (or, where the stairs fall to the right, to its right), y the one above.
fn step_at(size: vec2<i32>, pixel: vec2<i32>, falls_right: bool) -> vec2<u32> {
    return vec2<u32>(edges_at(size, pixel + vec2<i32>(i32(falls_right), 0)).x, edges_at(size, pixel).y);
}

// How far a staircase goes on in a direction.
struct Stairs {
    length: i32,
    // Whether an end was found: without one, nothing crosses it.
    ended: bool,
}

// `whole` counts the half step that a staircase may end with: an edge above without one beside.
fn climb(size: vec2<i32>, origin: vec2<i32>, direction: vec2<i32>, falls_right: bool, whole: bool) -> Stairs {
    var at = origin;
    for (var i = 0; i < DIAGONAL_REACH; i++) {
        at += direction;
        let step = step_at(size, at, falls_right);
        if (step.x & step.y) == 0u {
            return Stairs(i + i32(whole && step.y == 1u), true);
        }
    }
    return Stairs(DIAGONAL_REACH - 1 + i32(whole), false);
}

fn stairs_area(down: Stairs, up: Stairs, crossing_down: vec2<u32>, crossing_up: vec2<u32>) -> vec2<f32> {
    let ends = vec2<u32>(dot(crossing_down, vec2<u32>(2u, 1u)), dot(crossing_up, vec2<u32>(2u, 1u)));
    return area(diagonal_areas, select(vec2<i32>(0), vec2<i32>(ends), vec2<bool>(down.ended, up.ended)), vec2<i32>(down.length, up.length));
}

// Weights of the staircases through a pixel with an edge above; a staircase is at least three steps long.
fn diagonal_weights(size: vec2<i32>, pixel: vec2<i32>) -> vec2<f32> {
    var sum = vec2<f32>(0.0);

    // From below left to above right.
    var left = Stairs(0, true);
    if edges_at(size, pixel).x == 1u {
        left = climb(size, pixel, vec2<i32>(-1, 1), false, true);
    }
    var right = climb(size, pixel, vec2<i32>(1, -1), false, false);
    if left.length + right.length > 2 {
        let start = pixel + vec2<i32>(-left.length, left.length);
        let end = pixel + vec2<i32>(right.length, -right.length) + vec2<i32>(1, 0);
        let crossing_start = vec2<u32>(edges_at(size, start - vec2<i32>(1, 0)).y, edges_at(size, start).x);
        let crossing_end = vec2<u32>(edges_at(size, end).y, edges_at(size, end - vec2<i32>(0, 1)).x);
        sum += stairs_area(left, right, crossing_start, crossing_end);
    }

    // From above left to below right.
    left = climb(size, pixel, vec2<i32>(-1, -1), true, false);
    right = Stairs(0, true);
    if edges_at(size, pixel + vec2<i32>(1, 0)).x == 1u {
        right = climb(size, pixel, vec2<i32>(1, 1), true, true);
    }
    if left.length + right.length > 2 {
        let start = pixel - left.length;
        let end = pixel + right.length + vec2<i32>(1, 0);
        let crossing_start = vec2<u32>(edges_at(size, start - vec2<i32>(1, 0)).y, edges_at(size, start - vec2<i32>(0, 1)).x);
        let crossing_end = vec2<u32>(edges_at(size, end).y, edges_at(size, end).x);
        sum += stairs_area(left, right, crossing_start, crossing_end).yx;
    }
    return sum;
}

fn weights_at(size: vec2<i32>, pixel: vec2<i32>) -> vec4<f32> {
    let edges = edges_at(size, pixel);
    var lines = edges.y | (edges.x << 1u);
    var found = vec4<f32>(0.0);
    if DIAGONAL_REACH > 0 && edges.y == 1u {
        found = vec4<f32>(diagonal_weights(size, pixel), 0.0, 0.0);
        // Where a staircase was found, the lines that it is made of are not looked at.
        if any(found != vec4<f32>(0.0)) {
            lines = 0u;
        }
    }
    // One call serves both: pixels that a processor takes together need not have edges of the same kind.
    while lines != 0u {
        let by_row = (lines & 1u) == 1u;
        var axis = along_columns(size);
        var place = pixel.yx;
        if by_row {
            axis = along_rows(size);
            place = pixel;
        }
        let weights_of_line = line_weights(axis, place.x, place.y);
        found = select(vec4<f32>(found.xy, weights_of_line), vec4<f32>(weights_of_line, found.zw), by_row);
        lines &= lines - 1u;
    }
    return found;
}

@compute @workgroup_size(64)
fn cs_weights(@builtin(global_invocation_id) thread: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let size = vec2<i32>(textureDimensions(weights));
    for (var i = thread.x; i < tally[CANDIDATES + 3u]; i += 64u * groups.x) {
        let pixel = vec2<i32>(i32(pixels[i] & 0xffffu), i32(pixels[i] >> 16u));
        textureStore(weights, pixel, weights_at(size, pixel));
    }
}
