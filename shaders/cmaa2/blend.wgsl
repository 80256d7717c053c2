// Pixels blended by CMAA2's two kinds of shapes: simple ones, from the edges around a pixel alone, and long Z shapes.

override SIMPLE_BLUR: f32 = 0.1;
// Simple shapes are blurred less among many edges: from so much, less by a share of their number.
override CROWDED_FROM: f32 = 1.3;
override CROWDED_SHARE: f32 = 0.1;
// In the mean of all shapes through a pixel.
const SIMPLE_WEIGHT: f32 = 0.8;
const Z_WEIGHT: f32 = 1.8;
// An L is blurred less than other simple shapes, but more where it continues as a staircase.
const L_FACTOR: f32 = 0.75;
const STAIR_FACTOR: f32 = 0.9;

@group(0) @binding(2) var<storage, read> tally: array<u32>;
@group(0) @binding(3) var<storage, read> pixels: array<u32>;
@group(0) @binding(4) var masks: texture_2d<u32>;
@group(0) @binding(5) var row_weights: texture_2d<u32>;
@group(0) @binding(6) var column_weights: texture_2d<u32>;

// How much of each neighbour a simple shape takes: above, below, left, right.
fn simple_shape(size: vec2<i32>, pixel: vec2<i32>, own: vec4<f32>) -> vec4<f32> {
    let count = dot(own, vec4<f32>(1.0));
    if count < 2.0 {
        return vec4<f32>(0.0);
    }
    let above = vec4<f32>(sides_at(size, pixel - vec2<i32>(0, 1)));
    let below = vec4<f32>(sides_at(size, pixel + vec2<i32>(0, 1)));
    let left = vec4<f32>(sides_at(size, pixel - vec2<i32>(1, 0)));
    let right = vec4<f32>(sides_at(size, pixel + vec2<i32>(1, 0)));
    var taken = own;
    var blur = SIMPLE_BLUR;
    if count == 2.0 {
        // Two edges side by side are no shape.
        if own.x * own.y + own.z * own.w > 0.0 {
            return vec4<f32>(0.0);
        }
        blur *= L_FACTOR;
        // An edge that turns away from the pixel at one end, and does not go on at the other, is a stair's tread.
        taken += STAIR_FACTOR * vec4<f32>(
            own.w * right.x * (1.0 - below.w) + own.z * left.x * (1.0 - below.z),
            own.w * right.y * (1.0 - above.w) + own.z * left.y * (1.0 - above.z),
            own.x * above.z * (1.0 - right.x) + own.y * below.z * (1.0 - right.y),
            own.x * above.w * (1.0 - left.x) + own.y * below.w * (1.0 - left.y),
        );
    }
    let around = dot(above, vec4<f32>(1.0, 0.0, 1.0, 1.0)) + dot(below, vec4<f32>(0.0, 1.0, 1.0, 1.0))
        + dot(left, vec4<f32>(1.0, 1.0, 1.0, 0.0)) + dot(right, vec4<f32>(1.0, 1.0, 0.0, 1.0));
    return blur * clamp(CROWDED_FROM - CROWDED_SHARE * around, 0.0, 1.0) * taken;
}

// What the Z shapes through a pixel give it, from above, below, left and right: weight and count in sixteen bits each. They exist
// where there is an edge; elsewhere stands what an earlier picture left.
fn z_shapes(size: vec2<i32>, pixel: vec2<i32>, sides: vec4<u32>) -> vec4<u32> {
    let below = min(pixel + vec2<i32>(0, 1), size - 1);
    let right = min(pixel + vec2<i32>(1, 0), size - 1);
    let found = vec4<u32>(
        textureLoad(row_weights, pixel, 0).x & 0xffffu,
        textureLoad(row_weights, below, 0).x >> 16u,
        textureLoad(column_weights, pixel, 0).x & 0xffffu,
        textureLoad(column_weights, right, 0).x >> 16u,
    );
    return found * sides;
}

fn blended(pixel: vec2<i32>) -> vec4<f32> {
    let size = picture_size();
    let loaded = textureLoad(picture, pixel, 0);
    let sides = sides_at(size, pixel);
    let simple = simple_shape(size, pixel, vec4<f32>(sides));
    let simple_weight = select(0.0, SIMPLE_WEIGHT, any(simple > vec4<f32>(0.0)));
    let z = z_shapes(size, pixel, sides);
    let z_count = dot(z >> vec4<u32>(14u), vec4<u32>(1u));
    let total = simple_weight + Z_WEIGHT * f32(z_count);
    if total == 0.0 {
        return passed_on(loaded);
    }
    let w = (simple_weight * simple + Z_WEIGHT * vec4<f32>(z & vec4<u32>(0x3fffu)) / 16383.0) / total;
    let here = blendable(loaded);
    let above = neighbor(pixel - vec2<i32>(0, 1), here) - here;
    let below = neighbor(pixel + vec2<i32>(0, 1), here) - here;
    let left = neighbor(pixel - vec2<i32>(1, 0), here) - here;
    let right = neighbor(pixel + vec2<i32>(1, 0), here) - here;
    return storable(here + w.x * above + w.y * below + w.z * left + w.w * right);
}

@compute @workgroup_size(64)
fn cs_blend(@builtin(global_invocation_id) thread: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    for (var i = thread.x; i < tally[TOUCHED + 3u]; i += 64u * groups.x) {
        let pixel = listed(pixels[i]);
        textureStore(patches, pixel, blended(pixel));
    }
}
