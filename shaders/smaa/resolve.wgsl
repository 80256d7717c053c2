// A frame averaged with the one before it, which is found by motion vectors.

// How fast the frame before loses weight as its speed differs.
override VELOCITY_SCALE: f32 = 30.0;

// In pixels, from this frame to the one before.
@group(0) @binding(1) var motion: texture_2d<f32>;
// The frame before as it was filtered, not as it was resolved: nothing older is in it.
@group(0) @binding(2) var previous: texture_2d<f32>;
@group(0) @binding(3) var previous_speed: texture_2d<f32>;

struct Resolved {
    @location(0) color: vec4<f32>,
    @location(1) speed: f32,
}

// In picture sizes a frame; 0 for what is no number.
fn speed_of(motion_px: vec2<f32>) -> f32 {
    let speed = length(motion_px / vec2<f32>(picture_size()));
    return select(0.0, speed, is_finite(vec3<f32>(speed)));
}

// Without a frame before.
@fragment
fn fs_first(@builtin(position) position: vec4<f32>) -> Resolved {
    let pixel = vec2<i32>(position.xy);
    return Resolved(passed_on(textureLoad(picture, pixel, 0)), speed_of(textureLoad(motion, pixel, 0).xy));
}

// A pixel of the frame before, or what else there is where that is no number.
fn previous_at(pixel: vec2<i32>, otherwise: vec4<f32>) -> vec4<f32> {
    let loaded = textureLoad(previous, inside(pixel), 0);
    return select(otherwise, blendable(loaded), vec4<bool>(is_number(loaded)));
}

// Where a pixel was: the pixel up and to the left of it, and how far it lies from there.
struct Origin {
    pixel: vec2<i32>,
    t: vec2<f32>,
}

fn origin_of(pixel: vec2<i32>, motion_px: vec2<f32>) -> Origin {
    // Farther than the picture is wide is off screen from anywhere, and fits an integer; so is what is no number.
    let size = vec2<f32>(picture_size());
    let is_near = is_finite(vec3<f32>(motion_px, 0.0)) && all(abs(motion_px) <= size);
    let by = select(-2.0 * size, motion_px, is_near);
    // Within 2^-10 of a whole pixel it is that pixel.
    let snapped = select(by, round(by), abs(by - round(by)) < vec2<f32>(1.0 / 1024.0));
    return Origin(pixel + vec2<i32>(floor(snapped)), fract(snapped));
}

// Of the pixels that lie around an origin: half, less by how much the speed there differs, nothing off screen.
fn previous_weight(origin: Origin, speed: f32) -> f32 {
    // Motion vectors are exact to 1/256 pixel; the root would make much of less.
    let noise = 1.0 / (256.0 * f32(picture_size().x));
    let shares = vec4<f32>(1.0 - origin.t, origin.t);
    var weight = 0.0;
    for (var i = 0; i < 4; i++) {
        let step = vec2<i32>(i & 1, i >> 1u);
        let pixel = origin.pixel + step;
        let share = select(shares.x, shares.z, step.x == 1) * select(shares.y, shares.w, step.y == 1);
        let change = abs(speed - textureLoad(previous_speed, inside(pixel), 0).x);
        let trust = clamp(1.0 - VELOCITY_SCALE * sqrt(max(change - noise, 0.0)), 0.0, 1.0);
        weight += 0.5 * share * select(0.0, trust, all(pixel == inside(pixel)));
    }
    return weight;
}

@fragment
fn fs_resolve(@builtin(position) position: vec4<f32>) -> Resolved {
    let pixel = vec2<i32>(position.xy);
    let loaded = textureLoad(picture, pixel, 0);
    let motion_px = textureLoad(motion, pixel, 0).xy;
    let speed = speed_of(motion_px);
    let origin = origin_of(pixel, motion_px);
    let here = blendable(loaded);
    let before = moved(origin.pixel, origin.t, here);
    let weight = previous_weight(origin, speed);
    // What changes nothing goes through no arithmetic.
    if !is_number(loaded) || weight == 0.0 || all(before == here) {
        return Resolved(passed_on(loaded), speed);
    }
    return Resolved(storable(mix(here, before, weight)), speed);
}
