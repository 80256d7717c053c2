// The long Z shapes of CMAA2: for each pixel's edges, what the Z shapes along them blend on both sides.
//
// A Z is a step: an edge across, from which one line of edges leaves to one side along the row's upper border and another to the
// other side along its lower border. It stands for a line from the middle of one to the middle of the other, and blends the row's
// pixels on either side of the step with what lies beyond their line, less the farther from the step they are.

// A Z must be this long after its doubts are taken off, 5 as published.
override LEAST_LENGTH: i32 = 5;
// A side may be this much longer than the other, and less a constant.
override LONGER_FACTOR: f32 = 1.25;
override LONGER_OFFSET: f32 = 0.25;
// Blending grows by this with every pixel of length, up to whole.
override DAMPENING: f32 = 0.15;
override LINE_REACH: i32 = 86;
// Lines of odd length end within a pixel.
const ODD_LENGTH_PX: f32 = 0.22;

@group(0) @binding(0) var masks: texture_2d<u32>;
@group(0) @binding(1) var<storage, read> tally: array<u32>;
@group(0) @binding(2) var<storage, read> pixels: array<u32>;
@group(0) @binding(3) var weights: texture_storage_2d<r32uint, write>;

// Whether there is an edge above this pixel of a line.
fn edge_above(axis: Axis, at: i32, line: i32) -> i32 {
    return i32((word_at(axis, at >> 4u, line) >> u32(at & 15)) & 1u);
}

fn crossing_count(axis: Axis, at: i32, line: i32) -> i32 {
    return i32(crossing(axis, at, line));
}

// A row of pixels with a step, looked at so that the near line leaves to the right of the step and above the row.
struct Step {
    axis: Axis,
    // The first pixel of the near line.
    at: i32,
    // -1 where the picture is seen from behind: the near line leaves to the left.
    toward: i32,
    // The row, and the lines that border it on the near line's side and on the far line's.
    row: i32,
    near: i32,
    far: i32,
}

// What is odd about a Z, in pixels of its length: 0 to 3, 3 is none at all.
fn doubts(step: Step) -> i32 {
    let first = step.at;
    let before = step.at - step.toward;
    let near = step.toward;
    let exists = edge_above(step.axis, first, step.near) * edge_above(step.axis, before, step.far);
    let helpers = edge_above(step.axis, first + near, step.near) + edge_above(step.axis, before - near, step.far);
    let opposing = edge_above(step.axis, before, step.near) + edge_above(step.axis, first, step.far);
    // Edges across, one pixel from the step on either side.
    let across = step.at + i32(step.toward < 0);
    let others = crossing_count(step.axis, across - 1, step.row) + crossing_count(step.axis, across + 1, step.row);
    let score = f32(exists) * (2.0 + f32(helpers) - f32(opposing) - 0.7 * f32(others));
    return i32(floor(clamp(4.0 - score, 0.0, 3.0)));
}

// Weight of this pixel in the Z of a step, `distance` pixels into the near line, which is `near_length` long; 0 if it has none.
fn z_weight(step: Step, distance: i32, near_length: i32) -> f32 {
    let before = step.at - step.toward;
    let crossed = step.at + i32(step.toward < 0);
    if crossing_count(step.axis, crossed, step.row) == 0 || edge_above(step.axis, before, step.far) == 0 {
        return 0.0;
    }
    let doubt = doubts(step);
    if doubt >= 3 {
        return 0.0;
    }
    var far_length = 0;
    if step.toward > 0 {
        far_length = before - line_start(step.axis, before, step.far, LINE_REACH) + 1;
    } else {
        far_length = line_end(step.axis, before, step.far, LINE_REACH) - before + 1;
    }
    // The two sides may not differ by much.
    let longest = i32(ceil(LONGER_FACTOR * f32(min(near_length, far_length)) - LONGER_OFFSET));
    let near = min(near_length, longest) - doubt;
    let far = min(far_length, longest) - doubt;
    if near < 1 || far < 1 || near + far < LEAST_LENGTH {
        return 0.0;
    }
    // Each line gives its nearer half.
    let near_half = (near + 1) / 2;
    let far_half = (far + 1) / 2;
    if distance >= near_half {
        return 0.0;
    }
    let near_width = f32(near_half) - ODD_LENGTH_PX * f32(near % 2);
    let far_width = f32(far_half) - ODD_LENGTH_PX * f32(far % 2);
    let ramp = (near_width - f32(distance) - 0.5) / (near_width + far_width);
    return max(ramp, 0.0) * min(DAMPENING * f32(near + far - doubt), 1.0);
}

// Sums for this pixel and the one above it, and how many Z shapes went into each.
fn line_weights(axis: Axis, at: i32, line: i32) -> vec4<f32> {
    let start = line_start(axis, at, line, LINE_REACH);
    let end = line_end(axis, at, line, LINE_REACH);
    let length = end - start + 1;
    var sums = vec4<f32>(0.0);
    for (var i = 0; i < 4; i++) {
        let leaves_right = i < 2;
        // The row below the line, whose far border is the next line; then the row above.
        let below = (i & 1) == 0;
        let row = line - i32(!below);
        let far = line + select(-1, 1, below);
        let step = Step(axis, select(end, start, leaves_right), select(-1, 1, leaves_right), row, line, far);
        let weight = z_weight(step, select(end - at, at - start, leaves_right), length);
        let counted = vec2<f32>(weight, f32(weight > 0.0));
        sums += select(vec4<f32>(0.0, counted.x, 0.0, counted.y), vec4<f32>(counted.x, 0.0, counted.y, 0.0), below);
    }
    return sums;
}

// For this pixel in the low half, for the one above in the high: 14 bits of weight, 2 of count.
fn packed(sums: vec4<f32>) -> u32 {
    let weights = vec2<u32>(round(clamp(sums.xy, vec2<f32>(0.0), vec2<f32>(1.0)) * 16383.0));
    let halves = weights | (vec2<u32>(sums.zw) << vec2<u32>(14u));
    return halves.x | (halves.y << 16u);
}
