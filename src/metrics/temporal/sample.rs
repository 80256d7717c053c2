//! Made-up motion for the tests.

use super::Flow;

/// The whole picture was so many pixels further right and down in the frame before.
pub(super) fn pan(size: [u32; 2], back: [f32; 2]) -> Flow {
    let pixels = size[0] as usize * size[1] as usize;
    Flow::new(size, vec![back; pixels], vec![back.map(|x| -x); pixels]).expect("a vector a pixel")
}

/// A box over the full height, from column `left` on `width` pixels wide, that moved right by `step` pixels before a wall at rest.
pub(super) fn box_over_wall(size: [u32; 2], left: i32, width: i32, step: i32) -> Flow {
    let vectors = |left: i32, motion: i32| {
        let column = |i: u32| (i % size[0]) as i32;
        let moves = |i: u32| (left..left + width).contains(&column(i));
        (0..size[0] * size[1]).map(|i| if moves(i) { [motion as f32, 0.0] } else { [0.0; 2] }).collect()
    };
    Flow::new(size, vectors(left, -step), vectors(left - step, step)).expect("a vector a pixel")
}
