// Whose surface a probe hit.

@group(0) @binding(0) var depth: texture_depth_2d;
@group(0) @binding(1) var ids: texture_2d<u32>;

// Bits of reversed depth; object id, or signature.
@fragment
fn fs_keep(@builtin(position) position: vec4<f32>) -> @location(0) vec2<u32> {
    let pixel = vec2<i32>(position.xy);
    return vec2<u32>(bitcast<u32>(textureLoad(depth, pixel, 0)), textureLoad(ids, pixel, 0).x);
}
