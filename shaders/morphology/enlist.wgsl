// Room for so many more on a list. Its order depends on the hardware; nothing that is computed from it does.
fn reserve(count: u32, list: u32) -> u32 {
    let at = atomicAdd(&tally[list + 3u], count);
    // No more groups than a dispatch may have: each goes on through the list in steps of all groups.
    atomicMax(&tally[list], min((at + count + 63u) / 64u, 65535u));
    return at;
}

// Sixteen pixels in a row to a list of the first buffer.
fn enlist(which: u32, first: vec2<u32>, list: u32) {
    let count = countOneBits(which);
    if count == 0u {
        return;
    }
    let at = reserve(count, list);
    var left = which;
    for (var i = 0u; i < count; i++) {
        pixels[at + i] = (first.x + countTrailingZeros(left)) | (first.y << 16u);
        left &= left - 1u;
    }
}
