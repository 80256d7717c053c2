// Reading the masks that `detect.wgsl` writes: searches along lines of edges, sixteen pixels at a time.
//
// Along a row, "above" and "left" are what they say; along a column they change places.

// Rows or columns: where their words begin, and how long and how many the lines are.
struct Axis {
    words: i32,
    length: i32,
    lines: i32,
}

fn along_rows(size: vec2<i32>) -> Axis {
    return Axis(0, size.x, size.y);
}

fn along_columns(size: vec2<i32>) -> Axis {
    return Axis(i32(words_of(u32(size.x))), size.y, size.x);
}

// The word of sixteen pixels of a line; beyond the picture there are no edges.
fn word_at(axis: Axis, word: i32, line: i32) -> u32 {
    let at = vec2<i32>(axis.words + max(word, 0), clamp(line, 0, axis.lines - 1));
    let beyond = line < 0 || line >= axis.lines || word < 0 || 16 * word >= axis.length;
    return select(textureLoad(masks, at, 0).x, 0u, beyond);
}

// Whether an edge crosses the line just before this pixel of it.
fn crossing(axis: Axis, at: i32, line: i32) -> u32 {
    return (word_at(axis, at >> 4u, line) >> (16u + u32(at & 15))) & 1u;
}

// Edges of a pixel: x to its left, y above it.
fn edges_at(size: vec2<i32>, pixel: vec2<i32>) -> vec2<u32> {
    let word = word_at(along_rows(size), pixel.x >> 4u, pixel.y) >> u32(pixel.x & 15);
    return vec2<u32>((word >> 16u) & 1u, word & 1u);
}

// Edges on a pixel's four sides: above, below, left, right.
fn sides_at(size: vec2<i32>, pixel: vec2<i32>) -> vec4<u32> {
    let own = edges_at(size, pixel);
    let below = edges_at(size, pixel + vec2<i32>(0, 1)).y;
    let right = edges_at(size, pixel + vec2<i32>(1, 0)).x;
    return vec4<u32>(own.y, below, own.x, right);
}

// The first pixel of the line of edges above `at`: it goes on until an edge is missing or another one crosses, on either side.
fn line_start(axis: Axis, at: i32, line: i32, reach: i32) -> i32 {
    let nearest = at - reach;
    var word = at >> 4u;
    // Of this word only what lies at `at` or before it counts.
    var until = (2u << u32(at & 15)) - 1u;
    var before = until >> 1u;
    while 16 * word + 15 >= nearest && word >= 0 {
        let edges = word_at(axis, word, line);
        let crossed = ((edges | word_at(axis, word, line - 1)) >> 16u) & until;
        let missing = ~edges & before;
        if (crossed | missing) != 0u {
            // Both are -1 where there is no bit.
            let found = max(i32(firstLeadingBit(crossed)), select(-1, i32(firstLeadingBit(missing)) + 1, missing != 0u));
            return max(16 * word + found, nearest);
        }
        until = 0xffffu;
        before = 0xffffu;
        word--;
    }
    return max(nearest, 0);
}

// The last pixel of the line of edges above `at`.
fn line_end(axis: Axis, at: i32, line: i32, reach: i32) -> i32 {
    let farthest = min(at + reach, axis.length - 1);
    var word = at >> 4u;
    var after = 0xffffu & ~((2u << u32(at & 15)) - 1u);
    while 16 * word <= farthest {
        let edges = word_at(axis, word, line);
        let stops = (~edges | ((edges | word_at(axis, word, line - 1)) >> 16u)) & after;
        if stops != 0u {
            return min(16 * word + i32(countTrailingZeros(stops)) - 1, farthest);
        }
        after = 0xffffu;
        word++;
    }
    return farthest;
}
