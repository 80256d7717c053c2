// This frame's sample and earlier frames' mean into a new mean.

// What becomes of history outside the box: 0 stays, 1 each channel to its limit, 2 towards the box's middle until it is inside.
override RECTIFY: u32 = 2u;
// Share by which a remembered box gives way to this frame's; 1 remembers none.
override FORGETTING: f32 = 0.16666667;
// The same where this frame shows most of what was remembered: nothing thin is missing, so the light has changed.
override FORGETTING_SEEN: f32 = 0.5;
// Most frames that a mean stands for at rest.
override MOST_STILL: f32 = 64.0;
// Share of its frames that a mean loses each time it is clipped by as much as the box is wide, and how many it keeps. All at once would
// let a pixel that is hit once a cycle swing from one cycle to the next.
override CLIPPED_LOSES: f32 = 0.25;
override LEAST_CLIPPED: f32 = 4.0;
// Whether history is kept in halves.
override IN_HALVES: bool = true;
// Whether a pixel without history is filled by a filter.
override FALLBACK: bool = false;

// This frame as a filter smoothed it.
@group(0) @binding(7) var filtered: texture_2d<f32>;

struct Resolved {
    @location(0) history: vec4<f32>,
    @location(1) memory: vec4<u32>,
}

// The same 32 bits for the same three (Jarzynski and Olano 2020, pcg3d, its first word).
fn noise(x: u32, y: u32, z: u32) -> u32 {
    var v = vec3<u32>(x, y, z) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3<u32>(16u);
    v.x += v.y * v.z;
    return v.x;
}

// Rounded to what a half can hold, up as often as the rest is large: in the mean nothing is lost, and a mean of many frames does not
// stall where a frame's share is below half a step.
fn to_half(x: f32, random: u32) -> f32 {
    let smallest_normal = 6.103515625e-5;
    let steps_below = 16777216.0;
    let fine = floor(x * steps_below + f32(random & 0x1fffu) / 8192.0) / steps_below;
    let coarse = bitcast<f32>((bitcast<u32>(x) + (random & 0x1fffu)) & 0xffffe000u);
    return min(select(coarse, fine, x < smallest_normal), LARGEST_HALF);
}

fn stored(color: vec3<f32>, pixel: vec2<i32>) -> vec3<f32> {
    if !IN_HALVES {
        return color;
    }
    let random = noise(u32(pixel.x), u32(pixel.y), frame.seed);
    return vec3<f32>(to_half(color.r, random), to_half(color.g, random >> 9u), to_half(color.b, random >> 18u));
}

// A history and how far out of its box it was, in half widths of it.
struct Rectified {
    color: vec3<f32>,
    excess: f32,
}

fn rectified(color: vec3<f32>, box: Box) -> Rectified {
    let middle = 0.5 * (box.low + box.high);
    // No thinner than what a display or a half tells apart: where a channel is flat, its rounding must not pull the others along.
    let thinnest = (0.1 + max3(abs(middle))) / 512.0;
    let half_width = max(0.5 * (box.high - box.low), vec3<f32>(thinnest));
    let away = (color - middle) / half_width;
    let farthest = max(abs(away.x), max(abs(away.y), abs(away.z)));
    if RECTIFY == 0u || farthest <= 1.0 {
        return Rectified(color, 0.0);
    }
    if RECTIFY == 1u {
        return Rectified(middle + clamp(away, vec3<f32>(-1.0), vec3<f32>(1.0)) * half_width, farthest - 1.0);
    }
    return Rectified(middle + away / farthest * half_width, farthest - 1.0);
}

// This frame's box with what is remembered of earlier ones. One that has nothing in common with this frame's is of another light.
struct Remembered {
    low: vec3<f32>,
    high: vec3<f32>,
}

fn remembered(box: Box, kept: vec4<u32>) -> Remembered {
    let low = low_code(box.low);
    let high = high_code(box.high);
    let kept_low = corner_code(kept.x);
    let kept_high = corner_code(kept.y);
    if FORGETTING >= 1.0 || any(kept_low > high) || any(kept_high < low) {
        return Remembered(low, high);
    }
    let share_seen = max3((high - low) / max(kept_high - kept_low, vec3<f32>(1.0)));
    let forgetting = mix(FORGETTING, max(FORGETTING, FORGETTING_SEEN), smoothstep(0.5, 0.8, share_seen));
    // At least a step each frame, or rounding would keep it from ever closing in.
    let fading_low = max(floor(mix(kept_low, low, forgetting)), min(kept_low + 1.0, low));
    let fading_high = min(ceil(mix(kept_high, high, forgetting)), max(kept_high - 1.0, high));
    return Remembered(min(low, fading_low), max(high, fading_high));
}

@fragment
fn fs_resolve(@builtin(position) position: vec4<f32>) -> Resolved {
    let pixel = vec2<i32>(position.xy);
    let seen = seen_at(pixel, followed_from(pixel));
    let speed_px = length(seen.motion_px);
    let past = history_at(position.xy + seen.motion_px, seen);
    let now = neighborhood_at(pixel, speed_px);

    var codes = Remembered(low_code(now.box.low), high_code(now.box.high));
    var box = now.box;
    if past.frames > 0.0 && FORGETTING < 1.0 {
        codes = remembered(now.box, past.kept);
        box = Box(min(box.low, expanded(codes.low / 511.0)), max(box.high, expanded(codes.high / 511.0)));
    }
    let rectified = rectified(to_working(past.color), box);
    var frames = past.frames * (1.0 - CLIPPED_LOSES * min(rectified.excess, 1.0));
    frames = max(frames, min(past.frames, LEAST_CLIPPED));
    frames = min(frames + now.weight, select(MOST_STILL, MOST_MOTION, speed_px >= WHOLE_PX));

    var sample = now.sample;
    if FALLBACK && past.frames == 0.0 {
        let smooth_color = textureLoad(filtered, pixel, 0).rgb;
        if is_finite(smooth_color) {
            sample = to_working(clamp(smooth_color, vec3<f32>(0.0), vec3<f32>(LARGEST_HALF)));
        }
    }
    var mean = from_working(rectified.color + (sample - rectified.color) * (now.weight / max(frames, 1e-3)));
    if past.frames == 0.0 {
        mean = from_working(sample);
        frames = 1.0;
    }
    // A second wall: what is kept stays forever.
    mean = select(vec3<f32>(0.0), mean, is_finite(mean));
    let clipped = u32(ceil(3.0 * clamp(rectified.excess, 0.0, 1.0)));
    let kept = vec4<u32>(
        packed_corner(codes.low, past.refused),
        packed_corner(codes.high, clipped),
        packed_motion(seen.motion_px),
        seen.key,
    );
    return Resolved(vec4<f32>(stored(mean, pixel), frames), kept);
}
