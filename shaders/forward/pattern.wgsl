// Procedural patterns over uv. Numbers as in `MaterialUniforms::of` on the Rust side.

const PATTERN_CHECKER: u32 = 1u;
const PATTERN_STRIPES: u32 = 2u;
const PATTERN_ZONE_PLATE: u32 = 3u;
const PATTERN_BUMPS: u32 = 4u;
const PATTERN_LEAF: u32 = 5u;
const PATTERN_GRADIENT: u32 = 6u;

const TAU: f32 = 6.283185307;

// Half the width of a leaf at v, as a part of its greatest: rounded at the stalk, a third of the way up widest, drawn out to a tip.
fn leaf_half_width(v: f32) -> f32 {
    let along = clamp(v, 0.0, 1.0);
    return 6.75 * along * (1.0 - along) * (1.0 - along);
}

// Colour and opacity of the surface before light.
fn patterned(color: vec4<f32>, uv: vec2<f32>) -> vec4<f32> {
    switch PATTERN {
        case PATTERN_CHECKER: {
            let cell = vec2<i32>(floor(uv * material.pattern.x));
            return vec4<f32>(select(color.rgb, material.other.rgb, ((cell.x + cell.y) & 1) == 1), color.a);
        }
        case PATTERN_STRIPES: {
            return vec4<f32>(select(material.other.rgb, color.rgb, fract(uv.x * material.pattern.x) < material.pattern.y), color.a);
        }
        case PATTERN_ZONE_PLATE: {
            return vec4<f32>(color.rgb * (0.5 + 0.5 * cos(material.pattern.x * dot(uv, uv))), color.a);
        }
        case PATTERN_LEAF: {
            let across = abs(2.0 * uv.x - 1.0);
            let vein = 1.0 + 0.5 * f32(across < 0.06);
            return vec4<f32>(color.rgb * vein, color.a * clamp(0.5 + 2.0 * (leaf_half_width(uv.y) - across), 0.0, 1.0));
        }
        case PATTERN_GRADIENT: {
            return vec4<f32>(mix(color.rgb, material.other.rgb, clamp(uv.y, 0.0, 1.0)), color.a);
        }
        default: {
            return color;
        }
    }
}

// The normal in tangent space.
fn tangent_space_normal(uv: vec2<f32>) -> vec3<f32> {
    if PATTERN == PATTERN_BUMPS {
        return normalize(vec3<f32>(material.pattern.y * cos(TAU * material.pattern.x * uv), 1.0));
    }
    let texel = textureSample(normal_texture, normal_sampler, uv).xyz * 2.0 - 1.0;
    return normalize(vec3<f32>(texel.xy * material.normal_scale, max(texel.z, 1e-3)));
}
