// Entry points of the scene's draws.

// Largest value of a half float: what a target of halves would turn into infinity, every target gets as this.
const LARGEST_HALF: f32 = 65504.0;

// The one place where a vertex gets its position: the depth of a prepass and of its colour draw must be equal to the bit.
fn clip_position(instance: u32, position: vec3<f32>) -> vec4<f32> {
    let clip = objects[object_of(instance)].clip_from_object * vec4<f32>(position, 1.0);
    return vec4<f32>(clip.xy + jitters[jitter_of(instance)].offset_ndc * clip.w, clip.zw);
}

@vertex
fn vs_depth(@builtin(instance_index) instance: u32, @location(0) position: vec3<f32>) -> @builtin(position) @invariant vec4<f32> {
    return clip_position(instance, position);
}

struct MaskVertex {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) uv: vec2<f32>,
    @location(1) opacity: f32,
}

@vertex
fn vs_mask(
    @builtin(instance_index) instance: u32,
    @location(0) position: vec3<f32>,
    @location(3) uv: vec2<f32>,
    @location(4) color: vec4<f32>,
) -> MaskVertex {
    return MaskVertex(clip_position(instance, position), uv, color.a);
}

fn base_color(vertex_color: vec4<f32>, uv: vec2<f32>) -> vec4<f32> {
    var color = material.base_color * vertex_color;
    if TEXTURED {
        color *= textureSample(base_color_texture, base_color_sampler, uv);
    }
    return patterned(color, uv);
}

@fragment
fn fs_mask(in: MaskVertex) {
    if base_color(vec4<f32>(1.0, 1.0, 1.0, in.opacity), in.uv).a < material.alpha_cutoff {
        discard;
    }
}

struct SurfaceVertex {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) uv: vec2<f32>,
    @location(1) color: vec4<f32>,
    @location(2) camera_relative: vec3<f32>,
    @location(3) normal: vec3<f32>,
    @location(4) tangent: vec4<f32>,
}

@vertex
fn vs_surface(
    @builtin(instance_index) instance: u32,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) tangent: vec4<f32>,
    @location(3) uv: vec2<f32>,
    @location(4) color: vec4<f32>,
) -> SurfaceVertex {
    let object = object_of(instance);
    let to_space = objects[object].camera_relative_from_object;
    return SurfaceVertex(
        clip_position(instance, position),
        uv,
        color,
        (to_space * vec4<f32>(position, 1.0)).xyz,
        (objects[object].normal_from_object * vec4<f32>(normal, 0.0)).xyz,
        vec4<f32>((to_space * vec4<f32>(tangent.xyz, 0.0)).xyz, tangent.w * objects[object].handedness),
    );
}

// The geometric normal, bent by a map or pattern where there is one; it faces the side that is seen.
fn shading_normal(in: SurfaceVertex, front: bool) -> vec3<f32> {
    let normal = normalize(in.normal) * select(-1.0, 1.0, front);
    if !NORMAL_MAPPED {
        return normal;
    }
    let across = in.tangent.xyz - normal * dot(normal, in.tangent.xyz);
    let length_2 = dot(across, across);
    let bent = tangent_space_normal(in.uv);
    // Without a usable tangent the map has no direction to bend in.
    if length_2 < 1e-12 {
        return normal;
    }
    let tangent = across * inverseSqrt(length_2);
    let bitangent = cross(normal, tangent) * in.tangent.w;
    return normalize(bent.x * tangent + bent.y * bitangent + bent.z * normal);
}

fn shaded(in: SurfaceVertex, base: vec4<f32>, front: bool) -> vec3<f32> {
    var emissive = material.emissive.rgb;
    var metallic = material.metallic;
    var roughness = material.roughness;
    if TEXTURED {
        emissive *= textureSample(emissive_texture, emissive_sampler, in.uv).rgb;
        let texel = textureSample(metallic_roughness_texture, metallic_roughness_sampler, in.uv);
        metallic *= texel.b;
        roughness *= texel.g;
    }
    if UNLIT {
        return base.rgb + emissive;
    }
    let to_camera = select(normalize(-in.camera_relative), frame.to_camera.xyz, frame.to_camera.w == 1.0);
    return lit(Surface(base.rgb, metallic, roughness, shading_normal(in, front), to_camera)) + emissive;
}

// Linear colour, and the opacity as coverage (1 unless alpha to coverage is on).
fn surface_color(in: SurfaceVertex, front: bool) -> vec4<f32> {
    let base = base_color(in.color, in.uv);
    var coverage = 1.0;
    if MASKED && ALPHA_TO_COVERAGE {
        // Crosses one half where the opacity crosses the cut-off, over the width of a pixel (Golus 2017).
        coverage = clamp((base.a - material.alpha_cutoff) / max(fwidth(base.a), 1e-4) + 0.5, 0.0, 1.0);
    } else if MASKED && base.a < material.alpha_cutoff {
        discard;
    }
    let color = shaded(in, base, front);
    return vec4<f32>(select(edge_on_color(), min(color, vec3<f32>(LARGEST_HALF)), is_finite(color)), coverage);
}

// A triangle seen almost edge-on still covers a sample now and then, and what is interpolated over its vanishing area may be no
// number. Such a sample gets the material's colour in half the light: near what its neighbours have, and never a firefly.
fn edge_on_color() -> vec3<f32> {
    let light = select(frame.ambient.rgb + 0.5 * frame.light_color.rgb, vec3<f32>(1.0), UNLIT);
    return material.base_color.rgb * light + material.emissive.rgb;
}

@fragment
fn fs_color(in: SurfaceVertex, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return surface_color(in, front);
}

// A weighted sum over jitters: the background is added once for all of them (fs_background), so a surface adds its difference to it.
@fragment
fn fs_sum(in: SurfaceVertex, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    // The jitter's weight is the blend constant.
    return vec4<f32>(surface_color(in, front).rgb - frame.background.rgb, 0.0);
}

@fragment
fn fs_background() -> @location(0) vec4<f32> {
    return frame.sum_of_weights * vec4<f32>(frame.background.rgb, 1.0);
}

struct ExtrasVertex {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) uv: vec2<f32>,
    @location(1) opacity: f32,
    @location(2) clip: vec4<f32>,
    @location(3) previous_clip: vec4<f32>,
    @location(4) @interpolate(flat) id: u32,
    @location(5) normal: vec3<f32>,
}

@vertex
fn vs_extras(
    @builtin(instance_index) instance: u32,
    @location(0) position: vec3<f32>,
    @location(3) uv: vec2<f32>,
    @location(4) color: vec4<f32>,
    @location(1) normal: vec3<f32>,
) -> ExtrasVertex {
    let object = object_of(instance);
    return ExtrasVertex(
        clip_position(instance, position),
        uv,
        color.a,
        // Without the jitter: motion vectors are the scene's, not the sampling's.
        objects[object].clip_from_object * vec4<f32>(position, 1.0),
        objects[object].previous_clip_from_object * vec4<f32>(position, 1.0),
        objects[object].id,
        (objects[object].normal_from_object * vec4<f32>(normal, 0.0)).xyz,
    );
}

struct Extras {
    @location(0) motion_px: vec2<f32>,
    @location(1) id: u32,
    @location(2) signature: u32,
}

@fragment
fn fs_extras(in: ExtrasVertex, @builtin(front_facing) front: bool) -> Extras {
    if MASKED && base_color(vec4<f32>(1.0, 1.0, 1.0, in.opacity), in.uv).a < material.alpha_cutoff {
        discard;
    }
    let faces_light = (dot(in.normal, frame.to_light.xyz) > 0.0) == front;
    return Extras(motion_px(in.clip, in.previous_clip), in.id, 2u * (u32(material.emissive.w) + 1u) + u32(faces_light));
}

fn motion_px(clip: vec4<f32>, previous_clip: vec4<f32>) -> vec2<f32> {
    let ndc = previous_clip.xy / previous_clip.w - clip.xy / clip.w;
    return 0.5 * frame.size_px * vec2<f32>(ndc.x, -ndc.y);
}

// Where no surface is: what lies at infinity (or on the far plane) moves as the camera turns.
@fragment
fn fs_background_extras(@builtin(position) position: vec4<f32>) -> Extras {
    let ndc = 2.0 * position.xy / frame.size_px - 1.0;
    let clip = vec4<f32>(ndc.x, -ndc.y, 0.0, 1.0);
    return Extras(motion_px(clip, frame.previous_clip_from_clip * clip), 0u, 0u);
}

// Writes the stencil where the mask has none of the draw's bits.
@group(1) @binding(9) var mask: texture_2d<u32>;

@fragment
fn fs_stencil(@builtin(position) position: vec4<f32>) {
    if (textureLoad(mask, vec2<i32>(position.xy), 0).x & frame.mask_bits) != 0u {
        discard;
    }
}

// For draws that only touch depth and stencil inside a pass that has a colour target.
@fragment
fn fs_nothing() {}
