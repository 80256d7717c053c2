// Weights of staircases. Where one is found, its weights take the place of those of the lines that it is made of.

// Pixels that a search along a diagonal may go, each way.
override DIAGONAL_REACH: i32 = 8;

@group(0) @binding(0) var masks: texture_2d<u32>;
// 4 x 4 patterns of what goes on at each end, in each a square of distances to the ends: for staircases that rise to the right.
@group(0) @binding(1) var rising_areas: texture_2d<u32>;
@group(0) @binding(2) var<storage, read> tally: array<u32>;
@group(0) @binding(3) var<storage, read> pixels: array<u32>;
@group(0) @binding(4) var row_weights: texture_storage_2d<r32uint, write>;
@group(0) @binding(5) var column_weights: texture_storage_2d<r32uint, write>;
// And for those that fall.
@group(0) @binding(6) var falling_areas: texture_2d<u32>;

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

// What goes on at the end of a staircase; nothing where no end was found.
fn stairs_end(stairs: Stairs, crossing: vec2<u32>) -> i32 {
    return select(0, i32(dot(crossing, vec2<u32>(2u, 1u))), stairs.ended);
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
        let ends = vec2<i32>(stairs_end(left, crossing_start), stairs_end(right, crossing_end));
        sum += area(rising_areas, ends, vec2<i32>(left.length, right.length));
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
        let ends = vec2<i32>(stairs_end(left, crossing_start), stairs_end(right, crossing_end));
        sum += area(falling_areas, ends, vec2<i32>(left.length, right.length)).yx;
    }
    return sum;
}

@compute @workgroup_size(64)
fn cs_diagonals(@builtin(global_invocation_id) thread: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let size = vec2<i32>(textureDimensions(row_weights));
    for (var i = thread.x; i < tally[DIAGONALS + 3u]; i += 64u * groups.x) {
        let pixel = listed(pixels[i]);
        let found = diagonal_weights(size, pixel);
        if any(found != vec2<f32>(0.0)) {
            textureStore(row_weights, pixel, vec4<u32>(pack2x16unorm(found)));
            textureStore(column_weights, pixel, vec4<u32>(0u));
        }
    }
}
