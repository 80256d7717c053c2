//! A border is the end of the picture: what lies at the other one, or beyond a filter's reach, does not matter.

use super::picture::{Picture, grey, long_lines};
use super::{Filter, eight_bit, specs};
use crate::common;

const LONG: u32 = 256;
const SHORT: u32 = 24;

/// Pixels that a pixel can be away from one that it depends on: how far searches go, and a little more.
fn reach_px(spec: &str) -> u32 {
    match spec {
        // Steps of a search come to 26.5 at most.
        "fxaa" | "fxaa:preset=ultra" => 30,
        "mlaa" | "smaa:preset=ultra" => 64 + 4,
        "smaa" => 2 * 16 + 4,
        // A Z's one half is 109 px long at most, and blends half of itself; the other is followed for 86.
        "cmaa2" | "cmaa2:preset=ultra" => 55 + 86 + 4,
        other => panic!("say how far {other} reaches"),
    }
}

/// The picture with its last column black: all edges end there.
fn last_column_black(picture: &Picture) -> Picture {
    let last = picture.size[0] - 1;
    Picture::from_fn(picture.size, |x, y| if x == last { grey(0.0) } else { picture.at(x, y) })
}

/// How many columns left of the last one a change of that one is felt.
fn felt_px(mut filter: impl FnMut(&Picture) -> Picture, picture: &Picture) -> u32 {
    let (before, after) = (filter(picture), filter(&last_column_black(picture)));
    let last = picture.size[0] - 1;
    before.differing(&after).iter().map(|[x, _]| last - x).max().unwrap_or(0)
}

/// A filter that is given the picture turned and its result turned back.
fn felt_at_each_border(rows: &mut Filter<'_>, columns: &mut Filter<'_>) -> [u32; 4] {
    let picture = long_lines([LONG, SHORT]);
    [
        felt_px(|p| rows.apply(p), &picture),
        felt_px(|p| rows.apply(&p.mirrored()).mirrored(), &picture),
        felt_px(|p| columns.apply(&p.transposed()).transposed(), &picture),
        felt_px(|p| columns.apply(&p.mirrored().transposed()).transposed().mirrored(), &picture),
    ]
}

#[test]
fn a_border_is_felt_no_farther_than_searches_reach() {
    let gpu = common::gpu();
    for spec in specs() {
        let mut rows = Filter::new(&gpu, &spec, [LONG, SHORT], eight_bit());
        let mut columns = Filter::new(&gpu, &spec, [SHORT, LONG], eight_bit());
        let felt = felt_at_each_border(&mut rows, &mut columns);
        println!("{spec}: the right, left, lower and upper border are felt {felt:?} px away, {} at most", reach_px(&spec));
        // Farther than a neighbour, or nothing was searched.
        assert!(felt.iter().all(|px| (2..=reach_px(&spec)).contains(px)), "{spec}: {felt:?}");
    }
}

#[test]
fn a_filter_that_reads_around_the_border_is_noticed() {
    let around = |picture: &Picture| {
        let width = picture.size[0];
        Picture::from_fn(picture.size, |x, y| {
            let (here, left) = (picture.at(x, y), picture.at((x + width - 1) % width, y));
            [0, 1, 2, 3].map(|c| 0.5 * (here[c] + left[c]))
        })
    };
    assert_eq!(felt_px(around, &long_lines([LONG, SHORT])), LONG - 1);
}
