// FXAA 3.11, the quality path: which way the edge runs, where it ends, and how far along it this pixel lies, for pixels on a list.

override SUBPIX: f32 = 0.75;
// Steps of the search, in pixels: so many of 1, one of 1.5, so many of 2, and two more.
override UNIT_STEPS: u32 = 1u;
override DOUBLE_STEPS: u32 = 4u;
override NEXT_TO_LAST_STEP: f32 = 4.0;
override LAST_STEP: f32 = 8.0;

@group(0) @binding(2) var<storage, read> tally: array<u32>;
@group(0) @binding(3) var<storage, read> pixels: array<u32>;
@group(0) @binding(4) var lumas: texture_2d<f32>;

fn luma_at(pixel: vec2<i32>) -> f32 {
    return textureLoad(lumas, inside(pixel), 0).x;
}

fn step_px(i: u32) -> f32 {
    if i < UNIT_STEPS {
        return 1.0;
    }
    if i == UNIT_STEPS {
        return 1.5;
    }
    if i <= UNIT_STEPS + DOUBLE_STEPS {
        return 2.0;
    }
    return select(LAST_STEP, NEXT_TO_LAST_STEP, i == UNIT_STEPS + DOUBLE_STEPS + 1u);
}

// An edge: the pixel whose side it is on, the direction along it, and the one across.
struct Edge {
    pixel: vec2<i32>,
    along: vec2<i32>,
    across: vec2<i32>,
}

// Mean luma of both sides of the edge, so many pixels along it.
fn mean_luma(edge: Edge, distance_px: f32) -> f32 {
    let whole = floor(distance_px);
    let near = edge.pixel + i32(whole) * edge.along;
    let far = near + edge.along;
    let at_near = luma_at(near) + luma_at(near + edge.across);
    let at_far = luma_at(far) + luma_at(far + edge.across);
    return 0.5 * mix(at_near, at_far, distance_px - whole);
}

// Where a search ended, and by how much the mean luma there differs from the mean at this pixel.
struct End {
    distance_px: f32,
    difference: f32,
}

fn search(edge: Edge, sign: f32, mean_here: f32, enough: f32) -> End {
    let steps = UNIT_STEPS + DOUBLE_STEPS + 3u;
    var end = End(step_px(0u), 0.0);
    for (var i = 1u; i < steps; i++) {
        end.difference = mean_luma(edge, sign * end.distance_px) - mean_here;
        if abs(end.difference) >= enough {
            break;
        }
        end.distance_px += step_px(i);
    }
    return end;
}

// How far towards its neighbour across the edge a pixel is read, and that neighbour.
struct Shift {
    neighbor: vec2<i32>,
    amount: f32,
}

fn shift_of(pixel: vec2<i32>) -> Shift {
    let x = vec2<i32>(1, 0);
    let y = vec2<i32>(0, 1);
    let m = luma_at(pixel);
    let n = luma_at(pixel - y);
    let s = luma_at(pixel + y);
    let w = luma_at(pixel - x);
    let e = luma_at(pixel + x);
    let nw = luma_at(pixel - y - x);
    let ne = luma_at(pixel - y + x);
    let sw = luma_at(pixel + y - x);
    let se = luma_at(pixel + y + x);

    // Second differences down the columns and along the rows: the larger tells which way the edge runs.
    let down = abs(nw + sw - 2.0 * w) + 2.0 * abs(n + s - 2.0 * m) + abs(ne + se - 2.0 * e);
    let along_rows = abs(nw + ne - 2.0 * n) + 2.0 * abs(w + e - 2.0 * m) + abs(sw + se - 2.0 * s);
    let horizontal = down >= along_rows;
    let along = select(y, x, horizontal);
    let before = select(w, n, horizontal);
    let after = select(e, s, horizontal);
    let edge_is_before = abs(before - m) >= abs(after - m);
    let across = select(select(x, y, horizontal), -select(x, y, horizontal), edge_is_before);
    let edge = Edge(pixel, along, across);

    let mean_here = 0.5 * (select(after, before, edge_is_before) + m);
    // A quarter as published, and a little less: between two flat colours the mean half way differs by just that, and rounding
    // should not decide.
    let enough = 0.245 * max(abs(before - m), abs(after - m));
    let back = search(edge, -1.0, mean_here, enough);
    let forth = search(edge, 1.0, mean_here, enough);
    let nearer_is_back = back.distance_px < forth.distance_px;
    let nearest = min(back.distance_px, forth.distance_px);
    let end_difference = select(forth.difference, back.difference, nearer_is_back);
    // The edge bends away from this pixel's side only where the luma at its end lies on the other side of the mean.
    let bends = (end_difference < 0.0) != (m - mean_here < 0.0);
    let by_edge = select(0.0, 0.5 - nearest / (back.distance_px + forth.distance_px), bends);

    // Single pixels: how far this one stands out of the mean of its neighbours.
    let range = max(m, max(max(n, s), max(w, e))) - min(m, min(min(n, s), min(w, e)));
    let mean = (2.0 * (n + s + w + e) + nw + ne + sw + se) / 12.0;
    let out = clamp(abs(mean - m) / max(range, 1e-6), 0.0, 1.0);
    let smooth_out = (3.0 - 2.0 * out) * out * out;
    return Shift(pixel + across, max(by_edge, smooth_out * smooth_out * SUBPIX));
}

fn shifted(pixel: vec2<i32>) -> vec4<f32> {
    let loaded = textureLoad(picture, pixel, 0);
    let shift = shift_of(pixel);
    let other = textureLoad(picture, inside(shift.neighbor), 0);
    // A pixel that is no number is no neighbour.
    if shift.amount == 0.0 || (INPUT_IS_FLOAT && !(is_finite(other.rgb) && is_finite(other.aaa))) {
        return passed_on(loaded);
    }
    let here = blendable(loaded);
    return storable(here + shift.amount * (blendable(other) - here));
}

@compute @workgroup_size(64)
fn cs_search(@builtin(global_invocation_id) thread: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    for (var i = thread.x; i < tally[ROWS + 3u]; i += 64u * groups.x) {
        let pixel = listed(pixels[i]);
        textureStore(patches, pixel, shifted(pixel));
    }
}
