// Which pixels of a multisampled picture hold several colours: the resolve has smoothed them already. Sixteen a thread.

override SAMPLES: i32 = 4;

@group(0) @binding(0) var samples: texture_multisampled_2d<f32>;
@group(0) @binding(1) var resolved: texture_storage_2d<r32uint, write>;

@compute @workgroup_size(64)
fn cs_resolved(@builtin(global_invocation_id) thread: vec3<u32>) {
    let size = textureDimensions(samples);
    var word = 0u;
    for (var i = 0u; i < 16u; i++) {
        let pixel = vec2<u32>(16u * thread.x + i, thread.y);
        if pixel.x >= size.x {
            break;
        }
        let first = textureLoad(samples, pixel, 0);
        var differs = false;
        for (var k = 1; k < SAMPLES; k++) {
            differs |= any(textureLoad(samples, pixel, k) != first);
        }
        word |= u32(differs) << i;
    }
    if 16u * thread.x < size.x {
        textureStore(resolved, thread.xy, vec4<u32>(word));
    }
}
