//! Small pictures, each made to show what one option does.

use super::super::picture::{Picture, random};

/// An edge between black and white that rises one pixel in `run`, stepping in the middle.
pub(super) fn slope(run: f64) -> Picture {
    Picture::half_plane([256, 16], |x, y| y - 8.0 - (x - 128.0) / run)
}

/// Discs that are a little brighter than what is around them, and ever more.
pub(super) fn faint() -> Picture {
    const STEPS: [f32; 10] = [0.02, 0.04, 0.06, 0.08, 0.12, 0.16, 0.2, 0.26, 0.4, 0.6];
    Picture::grey([20 * STEPS.len() as u32, 20], |x, y| {
        let (dx, dy) = (x as f32 % 20.0 - 9.7, y as f32 - 9.6);
        0.3 + if dx.hypot(dy) < 7.3 { STEPS[(x / 20) as usize] } else { 0.0 }
    })
}

/// White pixels, each alone.
pub(super) fn dots() -> Picture {
    Picture::grey([36, 36], |x, y| f32::from(x % 6 == 3 && y % 6 == 3))
}

/// A slanting edge between two colours.
pub(super) fn two_colors(a: [f32; 3], b: [f32; 3]) -> Picture {
    Picture::half_plane([48, 48], |x, y| 3.0 * x - y - 40.0).map(|[white, ..]| {
        let [r, g, b] = if white > 0.5 { a } else { b };
        [r, g, b, 1.0]
    })
}

/// Of the same luma by Rec. 709, one more red and one more green.
pub(super) fn equal_luma() -> Picture {
    two_colors([0.6, 0.2, 0.2], [0.2, 0.2 + 0.4 * 0.2126 / 0.7152, 0.2])
}

/// Stairs of one pixel, and how much of each pixel lies behind the line that they stand for.
pub(super) fn staircase() -> (Picture, Vec<f64>) {
    const SIDE: u32 = 48;
    const GRID: u32 = 16;
    let distance = |x: f64, y: f64| 0.97 * x - y + 0.3;
    let covered = |i: u32| {
        let inside = |k: &u32| {
            let offset = |n: u32| (f64::from(n) + 0.5) / f64::from(GRID);
            distance(f64::from(i % SIDE) + offset(k % GRID), f64::from(i / SIDE) + offset(k / GRID)) > 0.0
        };
        (0..GRID * GRID).filter(inside).count() as f64 / f64::from(GRID * GRID)
    };
    (Picture::half_plane([SIDE; 2], distance), (0..SIDE * SIDE).map(covered).collect())
}

/// White on black, from (12, 12) to (31, 31).
pub(super) fn square() -> Picture {
    Picture::grey([44, 44], |x, y| f32::from((12..32).contains(&x) && (12..32).contains(&y)))
}

/// Blocks of all shades of dark grey along a slanting white edge.
pub(super) fn beside_a_strong_edge() -> Picture {
    Picture::grey([96, 48], |x, y| if 9 * y < x + 100 { 1.0 } else { 0.5 * random(3, x / 5 + 100 * (y / 5)) })
}
