// Edges to bits, and the pixels that have any to a list.
//
// An edge lies between a pixel and the one to its left, or the one above. Sixteen pixels in a row share a word of `masks`: its low
// half says which of them have an edge above (the line that is searched along), its high half which have an edge to their left
// (what crosses the line). Right of these words stand those of the columns, lines and crossings exchanged, so that a search along
// a column is a search along a row of the transposed picture.

@group(0) @binding(1) var masks: texture_storage_2d<r32uint, write>;
@group(0) @binding(2) var<storage, read_write> tally: array<atomic<u32>>;
@group(0) @binding(3) var<storage, read_write> pixels: array<u32>;

// After multisampling: bits of the pixels that the resolve has smoothed, sixteen a word. Their edges are left alone.
override SPARE_RESOLVED: bool = false;
@group(0) @binding(4) var resolved: texture_2d<u32>;

// Four pixels in a row, the first in column 4n.
fn resolved_four(first: vec2<i32>) -> vec4<bool> {
    let last = vec2<i32>(textureDimensions(resolved)) - 1;
    let word = textureLoad(resolved, clamp(vec2<i32>(first.x >> 4u, first.y), vec2<i32>(0), last), 0).x;
    return ((vec4<u32>(word >> u32(first.x & 15)) >> vec4<u32>(0u, 1u, 2u, 3u)) & vec4<u32>(1u)) == vec4<u32>(1u);
}

fn without_resolved(edges: Edges, first: vec2<i32>) -> Edges {
    let here = resolved_four(first);
    let left = vec4<bool>(resolved_four(first - vec2<i32>(4, 0)).w, here.xyz);
    return Edges(edges.above & !here & !resolved_four(first - vec2<i32>(0, 1)), edges.left & !here & !left);
}

// Four pixels in a row a thread: bits 0 to 3 edges above, 4 to 7 edges to the left.
var<workgroup> nibbles: array<u32, 64>;

fn bits(edges: vec4<bool>) -> u32 {
    return dot(select(vec4<u32>(0u), vec4<u32>(1u, 2u, 4u, 8u), edges), vec4<u32>(1u));
}

@compute @workgroup_size(64)
fn cs_detect(@builtin(workgroup_id) tile: vec3<u32>, @builtin(local_invocation_index) thread: u32) {
    let corner = 16u * tile.xy;
    let size = vec2<u32>(picture_size());
    let first = corner + vec2<u32>(4u * (thread % 4u), thread / 4u);
    var edges = edges_of_four(vec2<i32>(first));
    if SPARE_RESOLVED {
        edges = without_resolved(edges, vec2<i32>(first));
    }
    // Beyond the right and lower border there are no pixels.
    let exists = (first.xxxx + vec4<u32>(0u, 1u, 2u, 3u) < size.xxxx) & (first.yyyy < size.yyyy);
    nibbles[thread] = bits(edges.above & exists) | (bits(edges.left & exists) << 4u);
    workgroupBarrier();

    if thread < 16u && corner.y + thread < size.y {
        let n = vec4<u32>(nibbles[4u * thread], nibbles[4u * thread + 1u], nibbles[4u * thread + 2u], nibbles[4u * thread + 3u]);
        let shifts = vec4<u32>(0u, 4u, 8u, 12u);
        let above = dot((n & vec4<u32>(15u)) << shifts, vec4<u32>(1u));
        let left = dot((n >> vec4<u32>(4u)) << shifts, vec4<u32>(1u));
        textureStore(masks, vec2<u32>(tile.x, corner.y + thread), vec4<u32>(above | (left << 16u)));
        enlist(above | left, corner + vec2<u32>(0u, thread), CANDIDATES);
    }
    if thread >= 16u && thread < 32u && corner.x + thread - 16u < size.x {
        let column = thread - 16u;
        var word = 0u;
        for (var row = 0u; row < 16u; row++) {
            let nibble = nibbles[4u * row + column / 4u] >> (column % 4u);
            word |= (((nibble >> 4u) & 1u) | ((nibble & 1u) << 16u)) << row;
        }
        textureStore(masks, vec2<u32>(words_of(size.x) + tile.y, corner.x + column), vec4<u32>(word));
    }
}
