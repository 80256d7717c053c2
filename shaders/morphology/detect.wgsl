// Edges to bits, and the pixels that have any to lists.
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
@group(0) @binding(5) var resolved: texture_2d<u32>;

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

// Blocks of 4 x 4 pixels, one a thread: edges above in the low half, row by row, edges to the left in the high half.
var<workgroup> blocks: array<u32, 64>;

fn bits(edges: vec4<bool>) -> u32 {
    return dot(select(vec4<u32>(0u), vec4<u32>(1u, 2u, 4u, 8u), edges), vec4<u32>(1u));
}

// A row of a block: its nibble in both halves.
fn row_of_block(first: vec2<u32>) -> u32 {
    let size = vec2<u32>(picture_size());
    var edges = edges_of_four(vec2<i32>(first));
    if SPARE_RESOLVED {
        edges = without_resolved(edges, vec2<i32>(first));
    }
    // Beyond the right and lower border there are no pixels.
    let exists = (first.xxxx + vec4<u32>(0u, 1u, 2u, 3u) < size.xxxx) & (first.yyyy < size.yyyy);
    return bits(edges.above & exists) | (bits(edges.left & exists) << 16u);
}

// Nibbles of four blocks beside each other, as sixteen bits of a row in both halves.
fn joined(nibbles: vec4<u32>) -> u32 {
    let low = dot((nibbles & vec4<u32>(15u)) << vec4<u32>(0u, 4u, 8u, 12u), vec4<u32>(1u));
    let high = dot(((nibbles >> vec4<u32>(16u)) & vec4<u32>(15u)) << vec4<u32>(16u, 20u, 24u, 28u), vec4<u32>(1u));
    return low | high;
}

// A column of a block, as a nibble in both halves.
fn column_of_block(block: vec4<u32>, column: u32) -> vec4<u32> {
    let spread = (block >> vec4<u32>(column)) & vec4<u32>(0x11111111u);
    let halves = spread | (spread >> vec4<u32>(3u)) | (spread >> vec4<u32>(6u)) | (spread >> vec4<u32>(9u));
    return halves & vec4<u32>(0x000f000fu);
}

@compute @workgroup_size(64)
fn cs_detect(@builtin(workgroup_id) tile: vec3<u32>, @builtin(local_invocation_index) thread: u32) {
    let corner = 32u * tile.xy;
    let size = vec2<u32>(picture_size());
    let first = corner + 4u * vec2<u32>(thread % 8u, thread / 8u);
    blocks[thread] = row_of_block(first)
        | (row_of_block(first + vec2<u32>(0u, 1u)) << 4u)
        | (row_of_block(first + vec2<u32>(0u, 2u)) << 8u)
        | (row_of_block(first + vec2<u32>(0u, 3u)) << 12u);
    workgroupBarrier();

    // A word of a row: 32 rows of two.
    let row = thread / 2u;
    let row_block = 8u * (row / 4u) + 4u * (thread % 2u);
    let beside = vec4<u32>(blocks[row_block], blocks[row_block + 1u], blocks[row_block + 2u], blocks[row_block + 3u]);
    let row_word = joined(beside >> vec4<u32>(4u * (row % 4u)));
    let row_at = vec2<u32>(2u * tile.x + thread % 2u, corner.y + row);
    if 16u * row_at.x < size.x && row_at.y < size.y {
        textureStore(masks, row_at, vec4<u32>(row_word));
        let first_of_word = vec2<u32>(16u * row_at.x, row_at.y);
        enlist(row_word & 0xffffu, first_of_word, ROWS);
        enlist_second(row_word >> 16u, first_of_word, COLUMNS);
    }

    // A word of a column: 32 columns of two, lines and crossings exchanged.
    let column = thread / 2u;
    let column_block = 32u * (thread % 2u) + column / 4u;
    let below = vec4<u32>(blocks[column_block], blocks[column_block + 8u], blocks[column_block + 16u], blocks[column_block + 24u]);
    let column_word = joined(column_of_block(below, column % 4u));
    let column_at = vec2<u32>(2u * tile.y + thread % 2u, corner.x + column);
    if 16u * column_at.x < size.y && column_at.y < size.x {
        let at = vec2<u32>(words_of(size.x) + column_at.x, column_at.y);
        textureStore(masks, at, vec4<u32>((column_word >> 16u) | (column_word << 16u)));
    }
}
