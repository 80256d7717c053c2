// Sixteen pixels in a row to a list of the second buffer.

@group(0) @binding(4) var<storage, read_write> second_pixels: array<u32>;

fn enlist_second(which: u32, first: vec2<u32>, list: u32) {
    let count = countOneBits(which);
    if count == 0u {
        return;
    }
    let at = reserve(count, list);
    var left = which;
    for (var i = 0u; i < count; i++) {
        second_pixels[at + i] = (first.x + countTrailingZeros(left)) | (first.y << 16u);
        left &= left - 1u;
    }
}
