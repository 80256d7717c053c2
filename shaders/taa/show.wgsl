// The mean as the picture, sharpened if asked for, and what can be looked at.

// 0 leaves it as it is, 1 undoes about the softness of one bilinear fetch.
override SHARPEN: f32 = 0.0;
// 0 how many frames each pixel stands for, 1 where history was refused, 2 where it was clipped.
override VIEW: u32 = 0u;
override MOST_STILL: f32 = 64.0;

@group(0) @binding(1) var history: texture_2d<f32>;
@group(0) @binding(2) var memory: texture_2d<u32>;

fn near(pixel: vec2<i32>) -> vec3<f32> {
    return to_working(textureLoad(history, clamp(pixel, vec2<i32>(0), vec2<i32>(textureDimensions(history)) - 1), 0).rgb);
}

@fragment
fn fs_show(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(position.xy);
    let mean = textureLoad(history, pixel, 0).rgb;
    if SHARPEN == 0.0 {
        return vec4<f32>(mean, 1.0);
    }
    let middle = to_working(mean);
    let around = array<vec3<f32>, 4>(
        near(pixel + vec2<i32>(0, -1)),
        near(pixel + vec2<i32>(-1, 0)),
        near(pixel + vec2<i32>(1, 0)),
        near(pixel + vec2<i32>(0, 1)),
    );
    let low = min(min(min(around[0], around[1]), min(around[2], around[3])), middle);
    let high = max(max(max(around[0], around[1]), max(around[2], around[3])), middle);
    let sharper = middle + SHARPEN * (middle - 0.25 * (around[0] + around[1] + around[2] + around[3]));
    // Nothing becomes brighter or darker than what lies around: no halo, and black stays black.
    return vec4<f32>(from_working(clamp(sharper, low, high)), 1.0);
}

@fragment
fn fs_view(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(position.xy);
    let kept = textureLoad(memory, pixel, 0);
    if VIEW == 0u {
        return vec4<f32>(vec3<f32>(textureLoad(history, pixel, 0).a / MOST_STILL), 1.0);
    }
    if VIEW == 1u {
        // Off screen blue, hidden red, forgotten grey.
        let refused = kept.x >> 30u;
        let shown = array<vec3<f32>, 4>(vec3<f32>(0.0), vec3<f32>(0.1, 0.3, 1.0), vec3<f32>(1.0, 0.15, 0.1), vec3<f32>(0.5));
        return vec4<f32>(shown[refused], 1.0);
    }
    return vec4<f32>(vec3<f32>(f32(kept.y >> 30u) / 3.0), 1.0);
}
