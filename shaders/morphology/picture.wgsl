// The picture that comes in: in display values to find edges in, in light to blend in.

// What a load gives and a store takes: linear light, or display values.
override INPUT_IS_LINEAR: bool = false;
override OUTPUT_IS_LINEAR: bool = false;
// Whether the format can hold what is no number, or lies outside [0, 1].
override INPUT_IS_FLOAT: bool = false;
// Whether colours are mixed in linear light, or as display values.
override BLEND_IN_LINEAR: bool = true;

@group(0) @binding(0) var picture: texture_2d<f32>;

fn picture_size() -> vec2<i32> {
    return vec2<i32>(textureDimensions(picture));
}

// The nearest pixel of the picture: nothing is read from the other side.
fn inside(pixel: vec2<i32>) -> vec2<i32> {
    return clamp(pixel, vec2<i32>(0), picture_size() - 1);
}

// In [0, 1] whatever the picture holds; what is no number is black.
fn display_at(pixel: vec2<i32>) -> vec3<f32> {
    var rgb = textureLoad(picture, inside(pixel), 0).rgb;
    if INPUT_IS_FLOAT {
        rgb = select(vec3<f32>(0.0), clamp(rgb, vec3<f32>(0.0), vec3<f32>(1.0)), is_finite(rgb));
    }
    if INPUT_IS_LINEAR {
        rgb = srgb_coded(rgb);
    }
    return rgb;
}

// A loaded pixel in the space that colours are mixed in, and back to what a store takes. Alpha is never coded.
fn blendable(input: vec4<f32>) -> vec4<f32> {
    var loaded = input;
    if INPUT_IS_FLOAT {
        // Whose power and differences are still numbers.
        loaded = clamp(input, vec4<f32>(-1e15), vec4<f32>(1e15));
    }
    if INPUT_IS_LINEAR && !BLEND_IN_LINEAR {
        return vec4<f32>(srgb_coded(loaded.rgb), loaded.a);
    }
    if !INPUT_IS_LINEAR && BLEND_IN_LINEAR {
        return vec4<f32>(srgb_decoded(loaded.rgb), loaded.a);
    }
    return loaded;
}

fn storable(blended: vec4<f32>) -> vec4<f32> {
    if OUTPUT_IS_LINEAR && !BLEND_IN_LINEAR {
        return vec4<f32>(srgb_decoded(blended.rgb), blended.a);
    }
    if !OUTPUT_IS_LINEAR && BLEND_IN_LINEAR {
        return vec4<f32>(srgb_coded(blended.rgb), blended.a);
    }
    return blended;
}

// A pixel that is passed on: through no arithmetic where none is needed.
fn passed_on(loaded: vec4<f32>) -> vec4<f32> {
    if INPUT_IS_LINEAR == OUTPUT_IS_LINEAR {
        return loaded;
    }
    return storable(blendable(loaded));
}
