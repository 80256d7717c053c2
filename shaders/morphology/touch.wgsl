// Which pixels change: those with an edge on any of their four sides, one word of sixteen a thread.

@group(0) @binding(0) var masks: texture_2d<u32>;
@group(0) @binding(1) var touched: texture_storage_2d<r32uint, write>;
@group(0) @binding(2) var<storage, read_write> tally: array<atomic<u32>>;
@group(0) @binding(3) var<storage, read_write> pixels: array<u32>;

// Rows, as wide as their words.
fn rows_of_words() -> Axis {
    return along_rows(vec2<i32>(textureDimensions(touched)) * vec2<i32>(16, 1));
}

fn touch(at: vec2<i32>) {
    let rows = rows_of_words();
    let own = word_at(rows, at.x, at.y);
    let left = (own >> 16u) | ((word_at(rows, at.x + 1, at.y) >> 16u) << 16u);
    let which = (own | left | word_at(rows, at.x, at.y + 1) | (left >> 1u)) & 0xffffu;
    textureStore(touched, at, vec4<u32>(which));
    enlist(which, vec2<u32>(16u * u32(at.x), u32(at.y)), TOUCHED);
}

@compute @workgroup_size(64)
fn cs_touch(@builtin(global_invocation_id) thread: vec3<u32>) {
    if thread.x < textureDimensions(touched).x {
        touch(vec2<i32>(thread.xy));
    }
}
