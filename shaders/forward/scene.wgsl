// What every draw of a scene reads: the frame, the objects, the jitters, one material.

struct FrameUniforms {
    // Unit vector to the light in world space.
    to_light: vec4<f32>,
    light_color: vec4<f32>,
    ambient: vec4<f32>,
    background: vec4<f32>,
    // World-space direction from the scene to the camera if w is 1 (parallel rays); else it follows from the position.
    to_camera: vec4<f32>,
    // From clip space of this frame to that of the frame before, for points that stand still; without jitter.
    previous_clip_from_clip: mat4x4<f32>,
    size_px: vec2<f32>,
    // Of all jitters of this draw.
    sum_of_weights: f32,
    // Of the mask, where this draw has one.
    mask_bits: u32,
}

// "Camera-relative" is world space moved so that the camera is the origin: small numbers near the camera, wherever that is.
struct Object {
    clip_from_object: mat4x4<f32>,
    previous_clip_from_object: mat4x4<f32>,
    camera_relative_from_object: mat4x4<f32>,
    // Inverse transpose of the above's linear part.
    normal_from_object: mat4x4<f32>,
    id: u32,
    // -1 where the transform mirrors.
    handedness: f32,
    padding: vec2<u32>,
}

struct Jitter {
    // Added to clip x and y after multiplication with w.
    offset_ndc: vec2<f32>,
}

struct MaterialUniforms {
    base_color: vec4<f32>,
    // Linear light; w is the material's number in the scene.
    emissive: vec4<f32>,
    // The pattern's second colour; w unused.
    other: vec4<f32>,
    // The pattern's numbers, see pattern.wgsl.
    pattern: vec4<f32>,
    metallic: f32,
    roughness: f32,
    normal_scale: f32,
    alpha_cutoff: f32,
}

// One pipeline a kind of surface: what it does not have is compiled out.
override PATTERN: u32 = 0u;
override UNLIT: bool = false;
override TEXTURED: bool = false;
override NORMAL_MAPPED: bool = false;
override MASKED: bool = false;
override ALPHA_TO_COVERAGE: bool = false;

@group(0) @binding(0) var<uniform> frame: FrameUniforms;
@group(0) @binding(1) var<storage, read> objects: array<Object>;
@group(0) @binding(2) var<storage, read> jitters: array<Jitter>;

@group(1) @binding(0) var<uniform> material: MaterialUniforms;
@group(1) @binding(1) var base_color_texture: texture_2d<f32>;
@group(1) @binding(2) var base_color_sampler: sampler;
@group(1) @binding(3) var metallic_roughness_texture: texture_2d<f32>;
@group(1) @binding(4) var metallic_roughness_sampler: sampler;
@group(1) @binding(5) var normal_texture: texture_2d<f32>;
@group(1) @binding(6) var normal_sampler: sampler;
@group(1) @binding(7) var emissive_texture: texture_2d<f32>;
@group(1) @binding(8) var emissive_sampler: sampler;

// The instance number carries both: which jitter in the upper half, which object in the lower.
fn object_of(instance: u32) -> u32 {
    return instance & 0xffffu;
}

fn jitter_of(instance: u32) -> u32 {
    return instance >> 16u;
}
