// Where a pixel's surface was in the frame before, and whether it was seen there.

// Whose motion a pixel follows: 0 its own, 1 that of the nearest surface of five, 2 of the 3 x 3.
override DILATION: u32 = 2u;
// Whether the background moves as the camera does, whatever the motion vectors there say.
override CAMERA_MOVES_BACKGROUND: bool = false;
// Whether motion vectors are taken as if they had come in halves.
override MOTION_IN_HALVES: bool = false;
override REFUSE_BY_DEPTH: bool = false;
override REFUSE_BY_IDS: bool = true;
// Of reversed depth, relative to the nearer.
override DEPTH_STEP: f32 = 0.02;
// Surfaces that move together hide nothing from each other: below this difference of their motions nothing is refused.
override SLIDE_PX: f32 = 0.5;

@group(0) @binding(2) var depth: texture_depth_2d;
@group(0) @binding(3) var motion: texture_2d<f32>;
@group(0) @binding(4) var ids: texture_2d<u32>;

fn depth_at(pixel: vec2<i32>) -> f32 {
    return textureLoad(depth, inside(pixel), 0);
}

// Clip space to pixels, y down.
fn pixel_of(ndc: vec2<f32>) -> vec2<f32> {
    return (0.5 + vec2<f32>(0.5, -0.5) * ndc) * vec2<f32>(picture_size());
}

// Where a still point was, in clip space divided by w.
fn still_before(pixel: vec2<i32>, reversed_depth: f32) -> vec3<f32> {
    let uv = (vec2<f32>(pixel) + 0.5) / vec2<f32>(picture_size());
    let ndc = vec2<f32>(2.0, -2.0) * uv - vec2<f32>(1.0, -1.0);
    let before = frame.previous_clip_from_clip * vec4<f32>(ndc, reversed_depth, 1.0);
    return before.xyz / select(before.w, 1e-9, abs(before.w) < 1e-9);
}

// In pixels from this frame to the one before; zero where a vector is no number.
fn motion_at(at: vec2<i32>) -> vec2<f32> {
    let pixel = inside(at);
    var found = textureLoad(motion, pixel, 0).xy;
    if MOTION_IN_HALVES {
        // To ten bits of fraction, as a half has.
        found = bitcast<vec2<f32>>((bitcast<vec2<u32>>(found) + 0x1000u) & vec2<u32>(0xffffe000u));
    }
    if CAMERA_MOVES_BACKGROUND && depth_at(pixel) == 0.0 {
        found = pixel_of(still_before(pixel, 0.0).xy) - vec2<f32>(pixel) - 0.5;
    }
    return select(vec2<f32>(0.0), found, is_finite(vec3<f32>(found, 0.0)));
}

// The pixel whose surface a pixel's colour follows. An edge moves with the surface in front, so the nearest around decides; but only if it
// is in front of this one's plane (on which reversed depth is affine), or a slope would follow its nearer end and drift.
fn followed_from(pixel: vec2<i32>) -> vec2<i32> {
    var step = vec2<i32>(0);
    if DILATION > 0u {
        let own = depth_at(pixel);
        var nearest = own;
        for (var i = 0; i < 9; i++) {
            let found = depth_at(pixel + offset_of(i));
            if found > nearest && (DILATION == 2u || i % 2 == 1) {
                nearest = found;
                step = offset_of(i);
            }
        }
        let slope = max(own - depth_at(pixel - step), 0.0);
        step *= i32(nearest - own > slope + DEPTH_STEP * nearest);
    }
    return inside(pixel + step);
}

// What a pixel shows now.
struct Seen {
    // Of the surface that it follows.
    key: u32,
    // Of its own.
    own_key: u32,
    // Depths that still surfaces around it had in the frame before.
    farthest: f32,
    nearest: f32,
    motion_px: vec2<f32>,
}

fn seen_at(pixel: vec2<i32>, followed: vec2<i32>) -> Seen {
    var seen = Seen(0u, 0u, 1.0, 0.0, motion_at(followed));
    if REFUSE_BY_IDS {
        seen.key = textureLoad(ids, followed, 0).x;
        seen.own_key = textureLoad(ids, pixel, 0).x;
    } else if REFUSE_BY_DEPTH {
        seen.key = bitcast<u32>(depth_at(followed));
    }
    for (var i = 0; i < 9; i++) {
        let at = inside(pixel + offset_of(i));
        if REFUSE_BY_DEPTH {
            let before = still_before(at, depth_at(at)).z;
            seen.farthest = min(seen.farthest, before);
            seen.nearest = max(seen.nearest, before);
        }
    }
    return seen;
}

// Whether what a remembered pixel showed is no longer here: it moved away, and what we see now lay hidden behind it.
fn is_stale(kept: vec4<u32>, seen: Seen) -> bool {
    if distance(motion_px_of(kept.z), shortened(seen.motion_px)) <= SLIDE_PX {
        return false;
    }
    var stale = false;
    if REFUSE_BY_IDS {
        // Of the followed surface, or of the pixel's own where that is another.
        stale = kept.w != seen.key && kept.w != seen.own_key;
    }
    if REFUSE_BY_DEPTH {
        let was = bitcast<f32>(kept.w);
        let beyond = max(was - seen.nearest, seen.farthest - was);
        stale = beyond > DEPTH_STEP * max(was, seen.farthest);
    }
    return stale;
}
