// What bevy_anti_alias 0.20.1's TAA does, written anew from a description of its behaviour, its defects with it.

struct Frame {
    // Factor on linear colour: the engine's own TAA sees exposed colours.
    exposure: f32,
    // Whether what came before must be forgotten.
    reset: u32,
}

// Of this frame in a mean: at least and at most.
const LEAST_SHARE: f32 = 0.015;
const MOST_SHARE: f32 = 0.1;

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var color: texture_2d<f32>;
@group(0) @binding(2) var depth: texture_depth_2d;
@group(0) @binding(3) var motion: texture_2d<f32>;
// Tone-mapped colour; in alpha, how much it is trusted.
@group(0) @binding(4) var history: texture_2d<f32>;
@group(0) @binding(5) var bilinear: sampler;

struct Shown {
    @location(0) output: vec4<f32>,
    @location(1) history: vec4<f32>,
}

@vertex
fn vs(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4<f32>(4.0 * f32(index & 1u) - 1.0, 4.0 * f32(index >> 1u) - 1.0, 0.0, 1.0);
}

fn inside(pixel: vec2<i32>) -> vec2<i32> {
    return clamp(pixel, vec2<i32>(0), vec2<i32>(textureDimensions(color)) - 1);
}

fn max3(c: vec3<f32>) -> f32 {
    return max(c.r, max(c.g, c.b));
}

fn tone_mapped(linear: vec3<f32>) -> vec3<f32> {
    let exposed = frame.exposure * linear;
    return exposed / (1.0 + max3(exposed));
}

fn linear_of(mapped: vec3<f32>) -> vec3<f32> {
    return mapped / (1.0 - max3(mapped)) / frame.exposure;
}

fn to_ycocg(c: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(0.25 * c.r + 0.5 * c.g + 0.25 * c.b, 0.5 * (c.r - c.b), 0.5 * c.g - 0.25 * (c.r + c.b));
}

fn from_ycocg(c: vec3<f32>) -> vec3<f32> {
    return saturate(vec3<f32>(c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z));
}

// Of the nearest surface of five: the pixel and four corners two pixels away. Depth is reversed.
fn motion_at(pixel: vec2<i32>) -> vec2<f32> {
    var nearest = pixel;
    for (var i = 0; i < 4; i++) {
        let corner = inside(pixel + vec2<i32>(4 * (i & 1) - 2, 4 * (i >> 1u) - 2));
        if textureLoad(depth, corner, 0) > textureLoad(depth, nearest, 0) {
            nearest = corner;
        }
    }
    return textureLoad(motion, nearest, 0).xy;
}

// Catmull and Rom's cubic by five bilinear fetches of the nine that it takes; what the corners weigh is lost.
fn cubic_history(place_px: vec2<f32>) -> vec3<f32> {
    let texel = 1.0 / vec2<f32>(textureDimensions(history));
    let middle = floor(place_px - 0.5) + 0.5;
    let t = place_px - middle;
    let before = t * (t * (1.0 - 0.5 * t) - 0.5);
    let after = t * t * (0.5 * t - 0.5);
    let second = t * (t * (2.0 - 1.5 * t) + 0.5);
    let inner = 1.0 - before - after;
    let at = array<vec2<f32>, 3>((middle - 1.0) * texel, (middle + second / inner) * texel, (middle + 2.0) * texel);
    let fetched = inner.x * inner.y * textureSampleLevel(history, bilinear, at[1], 0.0).rgb
        + before.x * inner.y * textureSampleLevel(history, bilinear, vec2<f32>(at[0].x, at[1].y), 0.0).rgb
        + after.x * inner.y * textureSampleLevel(history, bilinear, vec2<f32>(at[2].x, at[1].y), 0.0).rgb
        + inner.x * before.y * textureSampleLevel(history, bilinear, vec2<f32>(at[1].x, at[0].y), 0.0).rgb
        + inner.x * after.y * textureSampleLevel(history, bilinear, vec2<f32>(at[1].x, at[2].y), 0.0).rgb;
    return fetched;
}

// Pulled towards the mean of the 3 x 3 until it lies within one deviation of it.
fn clipped(past: vec3<f32>, pixel: vec2<i32>) -> vec3<f32> {
    var sum = vec3<f32>(0.0);
    var squares = vec3<f32>(0.0);
    for (var i = 0; i < 9; i++) {
        let near = to_ycocg(tone_mapped(textureLoad(color, inside(pixel + vec2<i32>(i % 3, i / 3) - 1), 0).rgb));
        sum += near;
        squares += near * near;
    }
    let mean = sum / 9.0;
    let deviation = sqrt(max(squares / 9.0 - mean * mean, vec3<f32>(0.0)));
    let away = to_ycocg(past) - mean;
    let farthest = max3(abs(away) / max(deviation, vec3<f32>(1e-8)));
    return from_ycocg(mean + select(away, away / farthest, farthest > 1.0));
}

@fragment
fn fs(@builtin(position) position: vec4<f32>) -> Shown {
    let pixel = vec2<i32>(position.xy);
    let loaded = textureLoad(color, pixel, 0);
    let now = tone_mapped(loaded.rgb);
    if frame.reset != 0u {
        // Trusted as if many frames had gone into it.
        return Shown(vec4<f32>(linear_of(now), loaded.a), vec4<f32>(now, 1.0 / LEAST_SHARE));
    }
    let motion_px = motion_at(pixel);
    let place_px = position.xy + motion_px;
    // Where the pixel is now, not where its surface was.
    var trust = textureLoad(history, pixel, 0).a;
    trust = select(1.0, trust + 10.0, all(abs(motion_px) < vec2<f32>(0.01)));
    var share = clamp(1.0 / trust, LEAST_SHARE, MOST_SHARE);
    if any(place_px < vec2<f32>(0.0)) || any(place_px > vec2<f32>(textureDimensions(color))) {
        share = 1.0;
        trust = 1.0;
    }
    let mean = mix(clipped(cubic_history(place_px), pixel), now, share);
    return Shown(vec4<f32>(linear_of(mean), loaded.a), vec4<f32>(mean, trust));
}
