// What this frame shows in and around a pixel.

// A brightest sample is limited to this many times the next in its 3 x 3; 0 limits none.
override LIMIT: f32 = 4.0;
// 0 least and greatest, 1 those of the 3 x 3 and of the cross in the mean, 2 mean and deviation, 3 what lies in 0 and in 2.
override BOX: u32 = 3u;
// Deviations from the mean, at rest and in motion.
override GAMMA_STILL: f32 = 1.5;
override GAMMA_MOTION: f32 = 1.0;

@group(0) @binding(1) var color: texture_2d<f32>;

// Times the limit: a sample beyond counts less, the brighter it is.
const BELIEVED: f32 = 64.0;

struct Box {
    low: vec3<f32>,
    high: vec3<f32>,
}

struct Neighborhood {
    // This frame's word on the pixel, in the working space.
    sample: vec3<f32>,
    // What it counts; 0 where the pixel's own sample is no number.
    weight: f32,
    box: Box,
}

fn picture_size() -> vec2<i32> {
    return vec2<i32>(textureDimensions(color));
}

fn inside(pixel: vec2<i32>) -> vec2<i32> {
    return clamp(pixel, vec2<i32>(0), picture_size() - 1);
}

// Of the 3 x 3 around a pixel, from above left.
fn offset_of(i: i32) -> vec2<i32> {
    return vec2<i32>(i % 3, i / 3) - 1;
}

// The brightness beyond which a colour is a firefly: some times the second brightest. What is no brighter than white is none.
fn brightness_limit(colors: array<vec3<f32>, 9>) -> f32 {
    var neighbors = colors;
    var brightest = 0.0;
    var next = 0.0;
    for (var i = 0; i < 9; i++) {
        let value = max3(neighbors[i]);
        next = max(next, min(value, brightest));
        brightest = max(brightest, value);
    }
    return max(LIMIT * next, 1.0 / frame.exposure);
}

fn neighborhood_at(pixel: vec2<i32>, speed_px: f32) -> Neighborhood {
    var colors: array<vec3<f32>, 9>;
    var counts: array<f32, 9>;
    for (var i = 0; i < 9; i++) {
        let loaded = textureLoad(color, inside(pixel + offset_of(i)), 0).rgb;
        let sound = is_finite(loaded);
        counts[i] = f32(sound);
        colors[i] = select(vec3<f32>(0.0), clamp(loaded, vec3<f32>(0.0), vec3<f32>(LARGEST_HALF)), sound);
    }
    var weight = frame.frame_weight * counts[4];
    if LIMIT > 0.0 {
        let limit = brightness_limit(colors);
        // What lies far beyond is no light of the scene: at an edge, where the box is wide, even its limit would stay for long.
        weight *= min(BELIEVED * limit / max(max3(colors[4]), 1e-9), 1.0);
        for (var i = 0; i < 9; i++) {
            colors[i] *= min(limit / max(max3(colors[i]), 1e-9), 1.0);
        }
    }
    for (var i = 0; i < 9; i++) {
        colors[i] = to_working(colors[i]);
    }
    return Neighborhood(sample_of(colors, counts), weight, box_of(colors, counts, speed_px));
}

// By the input filter; where the pixel's own sample is no number, the mean of those around it that are.
fn sample_of(colors_in: array<vec3<f32>, 9>, counts_in: array<f32, 9>) -> vec3<f32> {
    var colors = colors_in;
    var counts = counts_in;
    var sum = vec3<f32>(0.0);
    var weights = 0.0;
    for (var i = 0; i < 9; i++) {
        let weight = counts[i] * select(1.0, frame.input_weights[i / 3][i % 3], counts[4] > 0.0);
        sum += weight * colors[i];
        weights += weight;
    }
    // Lobes below zero may cancel the rest where a neighbour is missing.
    return select(colors[4], sum / weights, weights > 0.1);
}

fn box_of(colors_in: array<vec3<f32>, 9>, counts_in: array<f32, 9>, speed_px: f32) -> Box {
    var colors = colors_in;
    var counts = counts_in;
    var whole = Box(vec3<f32>(1e9), vec3<f32>(-1e9));
    var cross = whole;
    var sum = vec3<f32>(0.0);
    var squares = vec3<f32>(0.0);
    var count = 0.0;
    for (var i = 0; i < 9; i++) {
        if counts[i] > 0.0 {
            whole = Box(min(whole.low, colors[i]), max(whole.high, colors[i]));
            if i % 2 == 1 || i == 4 {
                cross = Box(min(cross.low, colors[i]), max(cross.high, colors[i]));
            }
            sum += colors[i];
            squares += colors[i] * colors[i];
            count += 1.0;
        }
    }
    if BOX == 0u {
        return whole;
    }
    if BOX == 1u {
        return Box(0.5 * (whole.low + cross.low), 0.5 * (whole.high + cross.high));
    }
    let mean = sum / max(count, 1.0);
    let deviation = sqrt(max(squares / max(count, 1.0) - mean * mean, vec3<f32>(0.0)));
    let reach = mix(GAMMA_STILL, GAMMA_MOTION, clamp(speed_px, 0.0, 1.0)) * deviation;
    if BOX == 2u {
        return Box(mean - reach, mean + reach);
    }
    return Box(max(mean - reach, whole.low), min(mean + reach, whole.high));
}
