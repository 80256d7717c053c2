// Lists of pixels: column in the low half of an entry, row in the high.
//
// `tally` holds four words a list: workgroups of 64 that go through it (an indirect dispatch), and its length. Two buffers hold the
// lists: one the pixels with an edge above, and when these are done with, all that may change; the other those with an edge to
// their left, and after them those that a staircase may go through.

const ROWS: u32 = 0u;
const COLUMNS: u32 = 4u;
const TOUCHED: u32 = 8u;
const DIAGONALS: u32 = 12u;

fn words_of(pixels: u32) -> u32 {
    return (pixels + 15u) / 16u;
}

fn listed(entry: u32) -> vec2<i32> {
    return vec2<i32>(i32(entry & 0xffffu), i32(entry >> 16u));
}
