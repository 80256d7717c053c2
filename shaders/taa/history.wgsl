// What earlier frames make of the place that a pixel's surface was at.

// How it is interpolated: 0 linearly, 1 by the cubic of Catmull and Rom, 2 by a sinc windowed to three lobes.
override HISTORY_FILTER: u32 = 1u;
// Most frames that a mean stands for in motion, or once it was interpolated.
override MOST_MOTION: f32 = 16.0;

// Linear colour, and how many frames it stands for.
@group(0) @binding(5) var history: texture_2d<f32>;
@group(0) @binding(6) var memory: texture_2d<u32>;

struct History {
    // Linear.
    color: vec3<f32>,
    // 0 where there is none.
    frames: f32,
    kept: vec4<u32>,
    // Why there is none: 1 off screen, 2 hidden, 3 forgotten.
    refused: u32,
}

// An offset this close to whole pixels reads that pixel as it is.
const WHOLE_PX: f32 = 1.0 / 1024.0;

fn no_history(refused: u32) -> History {
    return History(vec3<f32>(0.0), 0.0, vec4<u32>(0u), refused);
}

fn history_at(from_px: vec2<f32>, seen: Seen) -> History {
    let outside = any(from_px < vec2<f32>(0.0)) || any(from_px > vec2<f32>(picture_size()));
    // Not a branch that a uniform alone decides: Mesa 22.3 would compile the pass anew for it, frame by frame.
    if (frame.reset | u32(outside)) != 0u {
        return no_history(select(1u, 3u, frame.reset != 0u));
    }
    var corner = floor(from_px - 0.5);
    var share = from_px - 0.5 - corner;
    let whole = abs(share - round(share)) < vec2<f32>(WHOLE_PX);
    corner += select(vec2<f32>(0.0), round(share), whole);
    share = select(share, vec2<f32>(0.0), whole);
    let first = vec2<i32>(corner);

    // The four around, without those that show what is hidden now.
    var sum = vec4<f32>(0.0);
    var weights = 0.0;
    var low = vec3<f32>(LARGEST_HALF);
    var high = vec3<f32>(0.0);
    var complete = true;
    for (var i = 0; i < 4; i++) {
        let step = vec2<i32>(i & 1, i >> 1u);
        let weight = mix(1.0 - share.x, share.x, f32(step.x)) * mix(1.0 - share.y, share.y, f32(step.y));
        let at = inside(first + step);
        let tap = textureLoad(history, at, 0);
        if weight > 0.0 {
            if is_stale(textureLoad(memory, at, 0), seen) {
                complete = false;
            } else {
                sum += weight * tap;
                weights += weight;
                low = min(low, tap.rgb);
                high = max(high, tap.rgb);
            }
        }
    }
    let nearest = inside(first + vec2<i32>(round(share)));
    let kept = textureLoad(memory, nearest, 0);
    if weights < 0.01 {
        return no_history(2u);
    }
    let mean = sum / weights;
    var found = mean.rgb;
    if HISTORY_FILTER > 0u && complete && any(share != vec2<f32>(0.0)) {
        // Its lobes ring beside what is bright: kept between the four around.
        found = clamp(interpolated_at(first, share), low, high);
    }
    // What is interpolated is softer than its count says.
    let most = select(1e9, MOST_MOTION, any(share != vec2<f32>(0.0)));
    return History(found, min(mean.a, most), kept, 0u);
}
