// Lists of pixels: column in the low half of an entry, row in the high.
//
// `tally` holds four words a list: workgroups of 64 that go through it (an indirect dispatch), and its length.

const CANDIDATES: u32 = 0u;
const TOUCHED: u32 = 4u;
const DIAGONALS: u32 = 8u;

fn words_of(pixels: u32) -> u32 {
    return (pixels + 15u) / 16u;
}
