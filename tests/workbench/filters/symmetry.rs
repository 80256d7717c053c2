//! A picture mirrored, turned upside down or transposed is filtered to the result mirrored, turned or transposed.

use dejag::gpu::Gpu;

use super::picture::{PICTURES, Picture, confetti, hard};
use super::{Filter, eight_bit, filters, half_float};
use crate::common;

/// Wide enough for lines that end beyond a word of sixteen pixels or two.
const SIZE: [u32; 2] = [131, 131];

type Turn = (&'static str, fn(&Picture) -> Picture);

/// Each is its own inverse.
const TURNS: [Turn; 3] =
    [("mirrored", Picture::mirrored), ("upside down", Picture::upside_down), ("transposed", Picture::transposed)];

/// How far a filter is from treating a picture and its turned copy alike.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
struct Asymmetry {
    /// Of pixels that differ by more than rounding: sums may come in another order.
    share: f64,
    largest: f32,
}

/// `rounding` is what the sum of a few numbers may be off by, near a value.
fn asymmetry(expected: &Picture, turned: &Picture, rounding: impl Fn(f32) -> f32) -> Asymmetry {
    let mut found = Asymmetry::default();
    let mut differing = 0_u32;
    for (a, b) in expected.pixels.iter().zip(&turned.pixels) {
        let excess = |c: usize| (a[c] - b[c]).abs() - rounding(a[c].abs().max(b[c].abs()));
        let worst = (0..4).map(|c| (a[c] - b[c]).abs()).fold(0.0, f32::max);
        differing += u32::from((0..4).any(|c| excess(c) > 0.0));
        found.largest = found.largest.max(worst);
    }
    found.share = f64::from(differing) / expected.pixels.len() as f64;
    found
}

/// Largest asymmetry on each of the hard pictures, in 8 bits and in half floats.
fn measured(gpu: &Gpu, spec: &str, turns: &[Turn]) -> [Asymmetry; PICTURES] {
    let mut found = [Asymmetry::default(); PICTURES];
    for surface in [eight_bit(), half_float()] {
        let mut filter = Filter::new(gpu, spec, SIZE, surface);
        for (i, (pattern, picture)) in hard(SIZE).iter().enumerate() {
            let expected = filter.apply(picture);
            for (name, turn) in turns {
                let turned = turn(&filter.apply(&turn(picture)));
                let of = asymmetry(&expected, &turned, |value| 1.01 * filter.step(value) + NEAR_BLACK);
                if of.share > 0.0 {
                    println!("{}, {pattern} {name}: {:.2}% differ, the most by {:.3}", filter.name, 100.0 * of.share, of.largest);
                }
                found[i] = Asymmetry { share: found[i].share.max(of.share), largest: found[i].largest.max(of.largest) };
            }
        }
    }
    found
}

/// Light near black is what is left of numbers near 1, and coding makes it 13 times larger.
const NEAR_BLACK: f32 = 4e-6;

fn assert_exact(gpu: &Gpu, spec: &str, turns: &[Turn]) {
    let found = measured(gpu, spec, turns);
    assert!(found.iter().all(|of| of.share == 0.0), "{spec}: {found:?}");
}

/// `shares` in the order of the hard pictures.
fn assert_bounded(gpu: &Gpu, spec: &str, turns: &[Turn], shares: [f64; PICTURES], largest: f32) {
    let found = measured(gpu, spec, turns);
    let bounded = found.iter().zip(shares).all(|(of, share)| of.share <= share && of.largest <= largest);
    assert!(bounded, "{spec}: {found:?}");
}

#[test]
fn cmaa2_and_mlaa_are_symmetric() {
    let gpu = common::gpu();
    for spec in ["mlaa", "cmaa2", "cmaa2:preset=ultra"] {
        assert_exact(&gpu, spec, &TURNS);
    }
}

#[test]
fn smaa_is_symmetric_where_it_is_not_published_otherwise() {
    let gpu = common::gpu();
    assert_exact(&gpu, "smaa:contrast=0,diag=0", &TURNS[..2]);
    // Of equal weights along both axes, those of rows are taken: noise is full of lines of one pixel.
    assert_bounded(&gpu, "smaa:contrast=0,diag=0", &TURNS[2..], [0.0, 0.001, 0.18, 0.0, 0.0], 0.6);
}

#[test]
fn smaa_is_as_asymmetric_as_measured() {
    let gpu = common::gpu();
    // Contrast is looked for on one side of an edge, staircases from edges above alone.
    for spec in ["smaa", "smaa:preset=ultra"] {
        assert_bounded(&gpu, spec, &TURNS, [0.015, 0.03, 0.45, 0.001, 0.0], 0.68);
    }
}

#[test]
fn fxaa_is_asymmetric_in_ties_alone() {
    let gpu = common::gpu();
    // Between two directions, two sides or two ends that are equally good, one is taken. A pixel that stands out from all of its
    // neighbours has equal second differences both ways, so noise is full of ties, and rounding decides them.
    for spec in ["fxaa", "fxaa:preset=ultra"] {
        assert_bounded(&gpu, spec, &TURNS, [0.001, 0.004, 0.055, 0.0, 0.0], 0.68);
    }
}

#[test]
fn every_filter_has_a_symmetry() {
    let tested = ["fxaa", "mlaa", "smaa", "cmaa2"];
    assert!(filters().iter().all(|method| tested.contains(&method.name)), "a filter without a test of its symmetry");
}

#[test]
fn a_filter_that_leans_is_noticed() {
    // Each pixel mixed with the one to its left.
    let leaning = |picture: &Picture| {
        Picture::from_fn(picture.size, |x, y| {
            let (here, left) = (picture.at(x, y), picture.at(x.saturating_sub(1), y));
            [0, 1, 2, 3].map(|c| 0.9 * here[c] + 0.1 * left[c])
        })
    };
    let picture = confetti(SIZE, 1);
    let found = TURNS.map(|(_, turn)| asymmetry(&leaning(&picture), &turn(&leaning(&turn(&picture))), |_| 1.0 / 255.0));
    assert!(found[0].share > 0.05 && found[1].share == 0.0 && found[2].share > 0.05, "{found:?}");
    for (name, turn) in TURNS {
        assert!(turn(&turn(&picture)).same_bits(&picture) && !turn(&picture).same_bits(&picture), "{name}");
    }
}
