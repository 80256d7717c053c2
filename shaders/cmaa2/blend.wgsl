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
@group(0) @binding(5) var weights: texture_2d<f32>;
@group(0) @binding(6) var counts: texture_2d<f32>;

// Edges on a pixel's four sides: above, below, left, right.
fn sides_at(size: vec2<i32>, pixel: vec2<i32>) -> vec4<f32> {
    let own = edges_at(size, pixel);
    let below = edges_at(size, pixel + vec2<i32>(0, 1)).y;
    let right = edges_at(size, pixel + vec2<i32>(1, 0)).x;
    return vec4<f32>(f32(own.y), f32(below), f32(own.x), f32(right));
}

// How much of each neighbour a simple shape takes: above, below, left, right.
fn simple_shape(size: vec2<i32>, pixel: vec2<i32>, own: vec4<f32>) -> vec4<f32> {
    let count = dot(own, vec4<f32>(1.0));
    if count < 2.0 {
        return vec4<f32>(0.0);
    }
    let above = sides_at(size, pixel - vec2<i32>(0, 1));
    let below = sides_at(size, pixel + vec2<i32>(0, 1));
    let left = sides_at(size, pixel - vec2<i32>(1, 0));
    let right = sides_at(size, pixel + vec2<i32>(1, 0));
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

// Weights exist where there is an edge; elsewhere stands what an earlier picture left.
fn stored_at(stored: texture_2d<f32>, size: vec2<i32>, pixel: vec2<i32>) -> vec4<f32> {
    let edges = edges_at(size, pixel);
    let found = textureLoad(stored, min(pixel, size - 1), 0);
    return select(vec4<f32>(0.0), found, vec4<bool>(vec2<bool>(edges.yy), vec2<bool>(edges.xx)));
}

// What the Z shapes through a pixel give it, from all four sides.
fn from_sides(stored: texture_2d<f32>, size: vec2<i32>, pixel: vec2<i32>) -> vec4<f32> {
    let own = stored_at(stored, size, pixel);
    let below = stored_at(stored, size, pixel + vec2<i32>(0, 1)).y;
    let right = stored_at(stored, size, pixel + vec2<i32>(1, 0)).w;
    return vec4<f32>(own.x, below, own.z, right);
}

fn neighbor(pixel: vec2<i32>, otherwise: vec4<f32>) -> vec4<f32> {
    let loaded = textureLoad(picture, inside(pixel), 0);
    // A pixel that is no number is no neighbour.
    if INPUT_IS_FLOAT && !(is_finite(loaded.rgb) && is_finite(loaded.aaa)) {
        return otherwise;
    }
    return blendable(loaded);
}

fn blended(pixel: vec2<i32>) -> vec4<f32> {
    let size = picture_size();
    let loaded = textureLoad(picture, pixel, 0);
    let simple = simple_shape(size, pixel, sides_at(size, pixel));
    let simple_weight = select(0.0, SIMPLE_WEIGHT, any(simple > vec4<f32>(0.0)));
    let z_count = dot(from_sides(counts, size, pixel), vec4<f32>(1.0));
    let total = simple_weight + Z_WEIGHT * z_count;
    if total == 0.0 {
        return passed_on(loaded);
    }
    let w = (simple_weight * simple + Z_WEIGHT * from_sides(weights, size, pixel)) / total;
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
        let pixel = vec2<i32>(i32(pixels[i] & 0xffffu), i32(pixels[i] >> 16u));
        textureStore(patches, pixel, blended(pixel));
    }
}
