// Resolves multisampled linear colour: every sample of a footprint, weighted by a filter at its true position and, if asked,
// by a tone-map weight, divided by the sum of weights. Samples beyond the picture's border do not count.

struct Tap {
    offset: vec2<i32>,
    index: u32,
    weight: f32,
}

struct ResolveUniforms {
    exposure: f32,
}

// 0: by the filter alone, 1: times 1/(1 + luminance), 2: times 1/(1 + largest channel).
override WEIGHTING: u32 = 0u;

@group(0) @binding(0) var samples: texture_multisampled_2d<f32>;
@group(0) @binding(1) var<storage, read> taps: array<Tap>;
@group(0) @binding(2) var<uniform> uniforms: ResolveUniforms;

fn tone_map_weight(color: vec3<f32>) -> f32 {
    let exposed = max(uniforms.exposure * color, vec3<f32>(0.0));
    switch WEIGHTING {
        case 1u: { return 1.0 / (1.0 + luminance(exposed)); }
        case 2u: { return 1.0 / (1.0 + max3(exposed)); }
        default: { return 1.0; }
    }
}

@fragment
fn fs_resolve(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(position.xy);
    let size = vec2<i32>(textureDimensions(samples));
    var sum = vec3<f32>(0.0);
    var sum_of_weights = 0.0;
    for (var i = 0u; i < arrayLength(&taps); i++) {
        let tap = taps[i];
        let at = pixel + tap.offset;
        if any(at < vec2<i32>(0)) || any(at >= size) {
            continue;
        }
        let color = textureLoad(samples, at, i32(tap.index)).rgb;
        let weight = tap.weight * tone_map_weight(color);
        sum += weight * color;
        sum_of_weights += weight;
    }
    // Negative lobes and tone-map weights together can cancel: then the pixel's first sample is the honest answer.
    if sum_of_weights < 1e-4 {
        return vec4<f32>(textureLoad(samples, pixel, 0).rgb, 1.0);
    }
    return vec4<f32>(sum / sum_of_weights, 1.0);
}
