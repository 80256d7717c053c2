// Doubts of the probes, and their neighbours: what one pixel's probes hit may be missed by the next one's.

// In pixels to each side.
override REACH: i32 = 1;

@group(0) @binding(0) var doubts: texture_2d<u32>;

@fragment
fn fs_spread(@builtin(position) position: vec4<f32>) -> @location(0) u32 {
    let pixel = vec2<i32>(position.xy);
    let last = vec2<i32>(textureDimensions(doubts)) - 1;
    var near = 0u;
    for (var y = -REACH; y <= REACH; y++) {
        for (var x = -REACH; x <= REACH; x++) {
            near |= textureLoad(doubts, clamp(pixel + vec2<i32>(x, y), vec2<i32>(0), last), 0).x;
        }
    }
    return (near & PROBES) | (textureLoad(doubts, pixel, 0).x & OUTLINE);
}
