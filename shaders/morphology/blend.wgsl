// Pixels blended with their neighbours, by the weights of the edges around them.

// true: the sum of what each neighbour covers (MLAA). false: the two neighbours across the stronger axis (SMAA).
override BLEND_ALL_SIDES: bool = false;

@group(0) @binding(2) var<storage, read> tally: array<u32>;
@group(0) @binding(3) var<storage, read> pixels: array<u32>;
@group(0) @binding(4) var masks: texture_2d<u32>;
@group(0) @binding(5) var row_weights: texture_2d<u32>;
@group(0) @binding(6) var column_weights: texture_2d<u32>;

// What a pixel takes from above, below, left and right. Weights exist where there is an edge; elsewhere stands what an earlier
// picture left.
fn taken_at(size: vec2<i32>, pixel: vec2<i32>) -> vec4<f32> {
    let below = min(pixel + vec2<i32>(0, 1), size - 1);
    let right = min(pixel + vec2<i32>(1, 0), size - 1);
    let found = vec4<f32>(
        unpack2x16unorm(textureLoad(row_weights, pixel, 0).x).x,
        unpack2x16unorm(textureLoad(row_weights, below, 0).x).y,
        unpack2x16unorm(textureLoad(column_weights, pixel, 0).x).x,
        unpack2x16unorm(textureLoad(column_weights, right, 0).x).y,
    );
    return select(vec4<f32>(0.0), found, sides_at(size, pixel) != vec4<u32>(0u));
}

fn blended(pixel: vec2<i32>) -> vec4<f32> {
    let size = picture_size();
    let loaded = textureLoad(picture, pixel, 0);
    let taken = taken_at(size, pixel);
    if all(taken == vec4<f32>(0.0)) {
        return passed_on(loaded);
    }
    let here = blendable(loaded);
    if BLEND_ALL_SIDES {
        // Areas of different edges may overlap: never more than the whole pixel.
        let w = taken / max(dot(taken, vec4<f32>(1.0)), 1.0);
        let above = neighbor(pixel - vec2<i32>(0, 1), here) - here;
        let below = neighbor(pixel + vec2<i32>(0, 1), here) - here;
        let left = neighbor(pixel - vec2<i32>(1, 0), here) - here;
        let right = neighbor(pixel + vec2<i32>(1, 0), here) - here;
        return storable(here + w.x * above + w.y * below + w.z * left + w.w * right);
    }
    let across_rows = max(taken.x, taken.y) >= max(taken.z, taken.w);
    let pair = select(taken.zw, taken.xy, across_rows);
    let step = select(vec2<i32>(1, 0), vec2<i32>(0, 1), across_rows);
    // Each side's blend, weighted once more by its own weight.
    let w = pair * pair / (pair.x + pair.y);
    return storable(here + w.x * (neighbor(pixel - step, here) - here) + w.y * (neighbor(pixel + step, here) - here));
}

@compute @workgroup_size(64)
fn cs_blend(@builtin(global_invocation_id) thread: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    for (var i = thread.x; i < tally[TOUCHED + 3u]; i += 64u * groups.x) {
        let pixel = listed(pixels[i]);
        textureStore(patches, pixel, blended(pixel));
    }
}
