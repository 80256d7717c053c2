// Where the probes disagree.

// In values of `seen`, 0 to 1.
override THRESHOLD: f32 = 0.02;
override BY_COLOR: bool = true;
override BY_GRADIENT: bool = false;
override BY_VARIANCE: bool = false;
override BY_DEPTH: bool = false;
override BY_IDS: bool = false;
// Of reversed depth, relative to the nearest.
override DEPTH_STEP: f32 = 0.02;

@group(0) @binding(1) var probes: texture_2d_array<f32>;
@group(0) @binding(2) var surfaces: texture_2d_array<u32>;
@group(0) @binding(3) var outline: texture_2d<u32>;

struct Detected {
    // Sum of the probes, and how many they are.
    @location(0) total: vec4<f32>,
    @location(1) doubt: u32,
}

fn probe_count() -> i32 {
    return i32(textureNumLayers(probes));
}

fn inside(pixel: vec2<i32>) -> vec2<i32> {
    return clamp(pixel, vec2<i32>(0), vec2<i32>(textureDimensions(probes)) - 1);
}

fn mean_at(pixel: vec2<i32>) -> vec3<f32> {
    var sum = vec3<f32>(0.0);
    for (var i = 0; i < probe_count(); i++) {
        sum += textureLoad(probes, inside(pixel), i, 0).rgb;
    }
    return seen(sum / f32(probe_count()));
}

// Steepest change to a neighbour of the pixel's mean.
fn gradient_at(pixel: vec2<i32>) -> f32 {
    let across = mean_at(pixel + vec2<i32>(1, 0)) - mean_at(pixel - vec2<i32>(1, 0));
    let down = mean_at(pixel + vec2<i32>(0, 1)) - mean_at(pixel - vec2<i32>(0, 1));
    return 0.5 * max(max3(abs(across)), max3(abs(down)));
}

fn surfaces_differ(pixel: vec2<i32>) -> bool {
    let first = textureLoad(surfaces, pixel, 0, 0).xy;
    var nearest = bitcast<f32>(first.x);
    var farthest = nearest;
    var same_id = true;
    for (var i = 1; i < probe_count(); i++) {
        let surface = textureLoad(surfaces, pixel, i, 0).xy;
        nearest = max(nearest, bitcast<f32>(surface.x));
        farthest = min(farthest, bitcast<f32>(surface.x));
        same_id &= surface.y == first.y;
    }
    return (BY_IDS && !same_id) || (BY_DEPTH && nearest - farthest > DEPTH_STEP * nearest);
}

@fragment
fn fs_detect(@builtin(position) position: vec4<f32>) -> Detected {
    let pixel = vec2<i32>(position.xy);
    let count = f32(probe_count());
    var sum = vec3<f32>(0.0);
    var low = vec3<f32>(1.0);
    var high = vec3<f32>(0.0);
    var shown = vec3<f32>(0.0);
    var squares = vec3<f32>(0.0);
    for (var i = 0; i < probe_count(); i++) {
        let linear = textureLoad(probes, pixel, i, 0).rgb;
        let value = seen(linear);
        sum += linear;
        low = min(low, value);
        high = max(high, value);
        shown += value;
        squares += value * value;
    }
    var doubt = BY_COLOR && max3(high - low) > THRESHOLD;
    if BY_VARIANCE {
        // The standard error of the mean; one probe knows of none.
        let spread = max(squares - shown * shown / count, vec3<f32>(0.0)) / max(count - 1.0, 1.0);
        doubt = doubt || sqrt(max3(spread) / count) > THRESHOLD;
    }
    if BY_GRADIENT {
        doubt = doubt || gradient_at(pixel) > THRESHOLD;
    }
    if BY_DEPTH || BY_IDS {
        doubt = doubt || surfaces_differ(pixel);
    }
    let edge = select(0u, OUTLINE, textureLoad(outline, pixel, 0).x != 0u);
    return Detected(vec4<f32>(sum, count), select(0u, PROBES, doubt) | edge);
}
