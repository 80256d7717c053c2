//! The published tables, computed: the grid that ours replaces with exact areas, to compare with.
//!
//! Facts: Jimenez et al. 2012 and its reference implementation (slots, offsets, 8-bit truncation, a 30 x 30 grid of points).

use super::super::areas::{AreaTable, diagonal_lines};

/// Where samples may lie, across a line; the first is the pixel's centre.
const LINE_OFFSETS: [f64; 7] = [0.0, -0.25, 0.25, -0.125, 0.125, -0.375, 0.375];
const DIAGONAL_OFFSETS: [[f64; 2]; 5] = [[0.0, 0.0], [0.25, -0.25], [-0.25, 0.25], [0.125, -0.125], [-0.125, 0.125]];
const WIDTH: usize = 160;
const BLOCK: usize = 80;

/// 160 x 560 texels of two bytes: lines on the left, diagonals on the right, a block for each offset.
pub(super) fn area_texture() -> Vec<[u8; 2]> {
    let mut texels = vec![[0; 2]; WIDTH * BLOCK * LINE_OFFSETS.len()];
    let byte = |a: f64| (255.0 * a) as u8;
    for (block, offset) in LINE_OFFSETS.iter().enumerate() {
        for (slot1, slot2) in slots(&[0, 1, 3, 4]) {
            for (i, j) in square(16) {
                let area = line_area([slot1, slot2], [i * i, j * j], *offset);
                texels[(BLOCK * block + 16 * slot2 + j) * WIDTH + 16 * slot1 + i] = area.map(byte);
            }
        }
    }
    for (block, offset) in DIAGONAL_OFFSETS.iter().enumerate() {
        for (end1, end2) in slots(&[0, 1, 2, 3]) {
            for (left, right) in square(20) {
                let area = diagonal_area([end1, end2], [left, right], *offset);
                texels[(BLOCK * block + 20 * end2 + right) * WIDTH + BLOCK + 20 * end1 + left] = area.map(byte);
            }
        }
    }
    texels
}

fn slots(of: &[usize]) -> impl Iterator<Item = (usize, usize)> {
    of.iter().flat_map(move |a| of.iter().map(move |b| (*a, *b)))
}

fn square(side: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..side * side).map(move |i| (i % side, i / side))
}

/// Between the line from `p` to `q`, taken as endless to the right of `p`, and the axis.
fn between([x1, y1]: [f64; 2], [x2, y2]: [f64; 2], left: f64) -> [f64; 2] {
    let (dx, dy) = (x2 - x1, y2 - y1);
    let (from, to) = (left, left + 1.0);
    let height = |x: f64| y1 + dy * (x - x1) / dx;
    let (a, b) = (height(from), height(to));
    if !((from >= x1 && from < x2) || (to > x1 && to <= x2)) {
        return [0.0; 2];
    }
    let one_sided = a.is_sign_negative() == b.is_sign_negative() || a.abs() < 1e-4 || b.abs() < 1e-4;
    if one_sided {
        let area = (a + b) / 2.0;
        return if area < 0.0 { [area.abs(), 0.0] } else { [0.0, area.abs()] };
    }
    let crossing = -y1 * dx / dy + x1;
    let first = if crossing > x1 { a * crossing.fract() / 2.0 } else { 0.0 };
    let second = if crossing < x2 { b * (1.0 - crossing.fract()) / 2.0 } else { 0.0 };
    let larger = if first.abs() > second.abs() { first } else { -second };
    if larger < 0.0 { [first.abs(), second.abs()] } else { [second.abs(), first.abs()] }
}

fn add(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

/// Slots: 1 an edge crosses on the upper side, 3 on the lower, 4 on both.
fn line_area([slot1, slot2]: [usize; 2], [left, right]: [usize; 2], offset: f64) -> [f64; 2] {
    let upper = |slot| usize::from(slot == 1 || slot == 4);
    let lower = |slot| usize::from(slot >= 3);
    let pattern = lower(slot1) | lower(slot2) << 1 | upper(slot1) << 2 | upper(slot2) << 3;
    let d = (left + right + 1) as f64;
    let at = left as f64;
    let (o1, o2) = (0.5 + offset, -0.5 + offset);
    let start = |y: f64| between([0.0, y], [d / 2.0, 0.0], at);
    let end = |y: f64| between([d / 2.0, 0.0], [d, y], at);
    let whole = |a: f64, b: f64| between([0.0, a], [d, b], at);
    let smooth = |area: [f64; 2]| {
        area.map(|a| {
            let wide = (a * 2.0).sqrt() * 0.5;
            let p = (d / 32.0).clamp(0.0, 1.0);
            wide + p * (a - wide)
        })
    };
    let z = |a: f64, b: f64| {
        if offset == 0.0 { whole(a, b) } else { add(whole(a, b), add(start(a), end(b))).map(|x| x / 2.0) }
    };
    match pattern {
        1 if left <= right => start(o2),
        4 if left <= right => start(o1),
        2 if left >= right => end(o2),
        8 if left >= right => end(o1),
        3 => add(smooth(start(o2)), smooth(end(o2))),
        12 => add(smooth(start(o1)), smooth(end(o1))),
        6 => z(o1, o2),
        9 => z(o2, o1),
        7 | 14 => whole(o1, o2),
        11 | 13 => whole(o2, o1),
        _ => [0.0; 2],
    }
}

fn diagonal_area(ends: [usize; 2], [left, right]: [usize; 2], offset: [f64; 2]) -> [f64; 2] {
    const POINTS: usize = 30;
    let d = (left + right + 1) as f64;
    let moved = |p: [f64; 2], end: usize, by: f64| {
        let offset = if end > 0 { offset } else { [0.0; 2] };
        [p[0] + by + offset[0], p[1] + by + offset[1]]
    };
    let share = |p: [f64; 2], q: [f64; 2], corner: [f64; 2]| {
        if p == q {
            return 1.0;
        }
        let middle = [(p[0] + q[0]) / 2.0, (p[1] + q[1]) / 2.0];
        let (a, b) = (q[1] - p[1], p[0] - q[0]);
        let behind = square(POINTS).filter(|(i, j)| {
            let x = corner[0] + *i as f64 / (POINTS - 1) as f64;
            let y = corner[1] + *j as f64 / (POINTS - 1) as f64;
            a * (x - middle[0]) + b * (y - middle[1]) > 0.0
        });
        behind.count() as f64 / (POINTS * POINTS) as f64
    };
    let lines = diagonal_lines(ends);
    let left = left as f64;
    let areas = lines.iter().map(|[p, q]| {
        let (p, q) = (moved(*p, ends[0], 0.0), moved(*q, ends[1], d));
        [1.0 - share(p, q, [1.0 + left, left]), share(p, q, [1.0 + left, 1.0 + left])]
    });
    areas.fold([0.0; 2], add).map(|a| a / lines.len() as f64)
}

/// 64 x 16 bytes: how far the last step of a search goes, by the code of four edges that one bilinear fetch returns.
fn search_texture() -> Vec<u8> {
    // Edges: left above, above, left, own.
    let code = |edges: usize| {
        let weights = [1, 3, 7, 21];
        (0..4).map(|i| weights[i] * (edges >> i & 1)).sum::<usize>()
    };
    let edges_of = |wanted: usize| (0..16).find(|edges| code(*edges) == wanted);
    let has = |edges: usize, i: usize| edges >> i & 1 == 1;
    let to_left = |left: usize, top: usize| match () {
        () if has(top, 3) && has(top, 2) && !has(left, 1) && !has(left, 3) => 2,
        () => u8::from(has(top, 3)),
    };
    let to_right = |left: usize, top: usize| match () {
        () if has(top, 3) && !has(left, 1) && !has(left, 3) => 1 + u8::from(has(top, 2) && !has(left, 0) && !has(left, 2)),
        () => 0,
    };
    let mut whole = vec![0_u8; 66 * 33];
    for (x, y) in (0..33 * 33).map(|i| (i % 33, i / 33)) {
        if let (Some(left), Some(top)) = (edges_of(x), edges_of(y)) {
            whole[y * 66 + x] = 127 * to_left(left, top);
            whole[y * 66 + 33 + x] = 127 * to_right(left, top);
        }
    }
    (17..33).rev().flat_map(|y| whole[y * 66..y * 66 + 64].to_vec()).collect()
}

fn sha256(bytes: &[u8]) -> String {
    use sha2::Digest as _;
    sha2::Sha256::digest(bytes).iter().map(|b| format!("{b:02x}")).collect()
}

#[test]
fn the_published_areas_are_met_byte_for_byte() {
    let bytes: Vec<u8> = area_texture().into_iter().flatten().collect();
    assert_eq!(bytes.iter().max(), Some(&222));
    assert_eq!(sha256(&bytes), "35065cef2a02cabcad711d6bf430239ae64e27d71c4e4fa06f29cce2c992f0d2");
}

#[test]
fn the_published_search_lengths_are_met_byte_for_byte() {
    assert_eq!(sha256(&search_texture()), "3694eae5e9d44b8ebb4415a13f8c7b94dc08a2fc86658434d771c4610fe5744d");
}

/// What the published shader would read for a line: the table at the square roots of the distances, linearly interpolated.
pub(crate) fn line_table(reach: u32) -> AreaTable {
    let texels = area_texture();
    AreaTable::from_fn(reach as usize + 1, |ends, distances| {
        let slot = ends.map(|end| [0, 1, 3, 4][end]);
        let at = distances.map(|d| (d as f64).sqrt());
        let [x0, y0] = at.map(|a| a.floor() as usize);
        let [fx, fy] = [at[0].fract(), at[1].fract()];
        let read = |i: usize, j: usize, channel: usize| {
            f64::from(texels[(16 * slot[1] + y0 + j) * WIDTH + 16 * slot[0] + x0 + i][channel]) / 255.0
        };
        [0, 1].map(|c| {
            let row = |j: usize| if fx == 0.0 { read(0, j, c) } else { (1.0 - fx) * read(0, j, c) + fx * read(1, j, c) };
            if fy == 0.0 { row(0) } else { (1.0 - fy) * row(0) + fy * row(1) }
        })
    })
}

/// And for a diagonal: whole distances, read as they are.
pub(crate) fn diagonal_table(reach: u32) -> AreaTable {
    diagonal_table_at(reach, 0)
}

fn diagonal_table_at(reach: u32, block: usize) -> AreaTable {
    let texels = area_texture();
    AreaTable::from_fn(reach as usize + 1, |ends, distances| {
        let [left, right] = distances.map(|d| d.min(19));
        texels[(BLOCK * block + 20 * ends[1] + right) * WIDTH + BLOCK + 20 * ends[0] + left].map(|b| f64::from(b) / 255.0)
    })
}

/// The largest difference of two tables.
fn farthest(exact: &AreaTable, published: &AreaTable) -> f64 {
    let unpack = |texel: u32| [texel & 0xffff, texel >> 16].map(|v| f64::from(v) / 65535.0);
    let pairs = exact.texels.iter().zip(&published.texels).flat_map(|(a, b)| unpack(*a).into_iter().zip(unpack(*b)));
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn exact_areas_stay_near_the_published_ones() {
    for (block, offset_px) in DIAGONAL_OFFSETS.into_iter().enumerate() {
        let largest = farthest(&AreaTable::diagonals(19, offset_px), &diagonal_table_at(19, block));
        println!("diagonals, samples off by {offset_px:?}: {:.1}/255", 255.0 * largest);
        assert!(largest <= 8.5 / 255.0 && largest > 1e-3, "{offset_px:?}: {largest}");
    }
    // Off the centre, lines are not what is published: see `area_set`. Between the published distances, linear interpolation is off.
    let largest = farthest(&AreaTable::lines(9, [0.0; 2], true), &line_table(9));
    assert!(largest <= 24.0 / 255.0 && largest > 1e-3, "{largest}");
}
