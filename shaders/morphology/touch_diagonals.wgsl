// As `touch.wgsl`, and which pixels a staircase may go through: on to a list of their own, for it is long work for few.

// Whole steps of a row of sixteen pixels and one more on either side: bit 1 is the first. x: falling left, y: falling right.
fn steps_of(rows: Axis, at: vec2<i32>) -> vec2<u32> {
    let before = word_at(rows, at.x - 1, at.y);
    let own = word_at(rows, at.x, at.y);
    let after = word_at(rows, at.x + 1, at.y);
    let above = ((before >> 15u) & 1u) | ((own & 0xffffu) << 1u) | ((after & 1u) << 17u);
    // One bit more: the edge to the right of the last is the one to the left of its neighbour.
    let left = (before >> 31u) | ((own >> 16u) << 1u) | ((after >> 16u) << 17u);
    return vec2<u32>(above & left, above & (left >> 1u));
}

@compute @workgroup_size(64)
fn cs_touch_diagonals(@builtin(global_invocation_id) thread: vec3<u32>) {
    if thread.x >= textureDimensions(touched).x {
        return;
    }
    let at = vec2<i32>(thread.xy);
    touch(at);
    // A staircase is three steps at least, so a pixel's next step is whole on one side or the other.
    let rows = rows_of_words();
    let above = steps_of(rows, at - vec2<i32>(0, 1));
    let below = steps_of(rows, at + vec2<i32>(0, 1));
    let may = (above.x >> 2u) | below.x | above.y | (below.y >> 2u);
    enlist_second(word_at(rows, at.x, at.y) & may & 0xffffu, vec2<u32>(16u * thread.x, thread.y), DIAGONALS);
}
