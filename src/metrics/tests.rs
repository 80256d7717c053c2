//! Each metric against its definition, and against a defect that it must notice.

use super::formula::{HEIGHT, PAIRS, WIDTH};
use super::*;
use crate::Error;
use crate::picture::{DisplayPicture, LinearPicture, NonFinite, Pixel};

fn figure(name: &str, pair: &Pair<'_>) -> Figure {
    find(name).expect("known").evaluate(pair)
}

fn number(name: &str, pair: &Pair<'_>) -> f64 {
    figure(name, pair).number().unwrap_or(f64::NAN)
}

fn grey(value: f32) -> DisplayPicture {
    DisplayPicture::from_fn(20, 16, |_, _| [value, value, value, 1.0]).expect("a size")
}

/// The grey picture with one pixel replaced.
fn with_pixel(value: f32, pixel: Pixel) -> DisplayPicture {
    DisplayPicture::from_fn(20, 16, |x, y| if (x, y) == (7, 9) { pixel } else { [value, value, value, 1.0] }).expect("a size")
}

fn linear(values: &[f32]) -> LinearPicture {
    LinearPicture::new(values.len() as u32, 1, values.iter().map(|&v| [v, v, v, 1.0]).collect()).expect("a row")
}

/// The figure of a linear metric for two rows of grey pixels.
fn linear_figure(name: &str, candidate: &[f32], reference: &[f32]) -> Figure {
    let (candidate, reference) = (linear(candidate), linear(reference));
    let (shown_candidate, shown_reference) = (candidate.to_display(), reference.to_display());
    let pair = Pair::new(&shown_candidate, &shown_reference).and_then(|pair| pair.with_linear(&candidate, &reference));
    figure(name, &pair.expect("one size"))
}

#[test]
fn equal_pictures_are_perfect() {
    let picture = PAIRS[0].reference();
    let linear = picture.to_linear();
    let pair = Pair::new(&picture, &picture).and_then(|pair| pair.with_linear(&linear, &linear)).expect("one size");
    for metric in METRICS {
        let perfect = match (metric.better, metric.name) {
            (_, "psnr" | "psnr-linear") => Figure::Infinite,
            (Better::Lower | Better::NearZero, _) => Figure::Number(0.0),
            (Better::Higher | Better::NearOne, _) => Figure::Number(1.0),
        };
        assert_eq!(metric.evaluate(&pair), perfect, "{}", metric.name);
    }
}

#[test]
fn one_level_in_one_channel_of_one_pixel_is_noticed() {
    let (candidate, reference) = (with_pixel(0.5, [0.5, 0.5 + 1.0 / 255.0, 0.5, 1.0]), grey(0.5));
    let (linear_candidate, linear_reference) = (candidate.to_linear(), reference.to_linear());
    let pair = Pair::new(&candidate, &reference)
        .and_then(|pair| pair.with_linear(&linear_candidate, &linear_reference))
        .expect("one size");
    assert!((number("psnr", &pair) - 10.0 * (255.0_f64.powi(2) * 960.0).log10()).abs() < 1e-3);
    assert!((number("max-error", &pair) - 1.0).abs() < 1e-4);
    assert!(number("ssim", &pair) < 1.0);
    assert!(number("flip", &pair) > 0.0);
    assert!(number("flip-p99", &pair) > 0.0);
    assert!(number("psnr-linear", &pair) < 100.0);
    assert!(number("rel-rmse", &pair) > 0.0);
    assert!(number("energy", &pair) > 1.0);
}

#[test]
fn a_pixel_that_is_not_finite_is_said_not_averaged() {
    for bad in [f32::NAN, f32::INFINITY] {
        let (candidate, reference) = (with_pixel(0.5, [0.5, bad, 0.5, 1.0]), grey(0.5));
        for (candidate, reference) in [(&candidate, &reference), (&reference, &candidate)] {
            let pair = Pair::new(candidate, reference).expect("one size");
            assert!(METRICS.iter().all(|metric| metric.evaluate(&pair) == Figure::NonFinite), "{bad}");
        }
    }
}

#[test]
fn a_tone_map_hides_no_infinity() {
    let (candidate, reference) = (linear(&[0.5, f32::INFINITY]), linear(&[0.5, 1.0]));
    let (shown_candidate, shown_reference) = (candidate.to_display(), reference.to_display());
    let pair = Pair::new(&shown_candidate, &shown_reference).and_then(|pair| pair.with_linear(&candidate, &reference));
    let pair = pair.expect("one size");
    assert_eq!(pair.candidate_non_finite(), Some(NonFinite { pixels: 1, first: [1, 0] }));
    assert_eq!(pair.reference_non_finite(), None);
    assert_eq!(figure("psnr", &pair), Figure::NonFinite);
}

#[test]
fn sizes_must_be_equal() {
    let (small, large) = (grey(0.5), PAIRS[0].reference());
    assert!(matches!(Pair::new(&small, &large), Err(Error::SizeMismatch([64, 48], [20, 16]))));
    let (small_linear, large_linear) = (small.to_linear(), large.to_linear());
    let mixed = Pair::new(&small, &small).and_then(|pair| pair.with_linear(&small_linear, &large_linear));
    assert!(matches!(mixed, Err(Error::SizeMismatch(..))));
}

#[test]
fn what_does_not_apply_is_said() {
    let pair_of = |picture: &DisplayPicture| Pair::new(picture, picture).map(|pair| figure("ssim", &pair)).expect("one size");
    assert_eq!(pair_of(&grey(0.5).crop(0, 0, 10, 16).expect("inside")), Figure::NotApplicable);
    assert_eq!(pair_of(&grey(0.5).crop(0, 0, 11, 11).expect("inside")), Figure::Number(1.0));
    let (a, b) = (grey(0.5), grey(0.6));
    let pair = Pair::new(&a, &b).expect("one size");
    for metric in METRICS.iter().filter(|metric| metric.reads == Reads::Linear) {
        assert_eq!(metric.evaluate(&pair), Figure::NotApplicable, "{}", metric.name);
    }
}

#[test]
fn every_metric_but_ssim_works_on_one_pixel() {
    let (candidate, reference) = (linear(&[0.25]), linear(&[0.5]));
    let (shown_candidate, shown_reference) = (candidate.to_display(), reference.to_display());
    let pair = Pair::new(&shown_candidate, &shown_reference).and_then(|pair| pair.with_linear(&candidate, &reference));
    let pair = pair.expect("one size");
    for metric in METRICS.iter().filter(|metric| metric.name != "ssim") {
        assert!(matches!(metric.evaluate(&pair), Figure::Number(_)), "{}", metric.name);
    }
}

#[test]
fn linear_metrics_follow_their_formulas() {
    let close = |name: &str, candidate: &[f32], reference: &[f32], expected: f64| {
        let got = linear_figure(name, candidate, reference).number().unwrap_or(f64::NAN);
        assert!((got - expected).abs() < 1e-6, "{name}: {got}, expected {expected}");
    };
    // Above white and below black are clamped for the PSNR, and count for the others.
    close("psnr-linear", &[5.0, 0.5], &[3.0, 0.25], -10.0 * (0.0625_f64 / 2.0).log10());
    close("rel-rmse", &[5.0, 0.5], &[3.0, 0.25], ((4.0_f64 / 9.01 + 0.0625 / 0.0725) / 2.0).sqrt());
    close("energy", &[5.0, 0.5], &[3.0, 0.25], 5.5 / 3.25);
    assert_eq!(linear_figure("psnr-linear", &[9.0, -1.0], &[1.0, 0.0]), Figure::Infinite);
}

#[test]
fn energy_of_a_black_reference_is_defined() {
    assert_eq!(linear_figure("energy", &[0.0, 0.0], &[0.0, 0.0]), Figure::Number(1.0));
    assert_eq!(linear_figure("energy", &[0.0, 0.1], &[0.0, 0.0]), Figure::Infinite);
    assert_eq!(linear_figure("energy", &[0.0, -0.1], &[0.0, 0.0]), Figure::NotApplicable);
}

#[test]
fn alpha_is_ignored() {
    let (opaque, clear) = (with_pixel(0.5, [0.5; 4]), grey(0.5));
    let pair = Pair::new(&opaque, &clear).expect("one size");
    assert_eq!(figure("psnr", &pair), Figure::Infinite);
    assert_eq!(figure("flip", &pair), Figure::Number(0.0));
}

#[test]
fn the_percentile_is_unweighted_and_interpolated() {
    let (test, reference) = (PAIRS[5].test(), PAIRS[5].reference());
    let pair = Pair::new(&test, &reference).expect("one size");
    let mut sorted = pair.flip_map().expect("a map").to_vec();
    sorted.sort_by(f32::total_cmp);
    let rank = 0.99 * f64::from(WIDTH * HEIGHT - 1);
    let (below, above) = (f64::from(sorted[rank as usize]), f64::from(sorted[rank as usize + 1]));
    let got = number("flip-p99", &pair);
    assert!((got - (below + rank.fract() * (above - below))).abs() < 1e-12, "{got} between {below} and {above}");
    assert!(got > number("flip", &pair));
}

#[test]
fn the_error_map_shows_errors_and_broken_pixels() {
    let (candidate, reference) = (with_pixel(0.5, [1.0, 0.0, 0.5, 1.0]), grey(0.5));
    let map = error_map(&Pair::new(&candidate, &reference).expect("one size")).expect("small enough");
    let brightness = |x: u32, y: u32| map.pixel(x, y)[..3].iter().sum::<f32>();
    assert!(brightness(7, 9) > brightness(0, 0));

    let broken = with_pixel(0.5, [f32::NAN, 0.0, 0.5, 1.0]);
    let map = error_map(&Pair::new(&broken, &reference).expect("one size")).expect("small enough");
    assert_eq!(map.pixel(7, 9), NON_FINITE_COLOUR);
    assert_ne!(map.pixel(6, 9), NON_FINITE_COLOUR);
}

#[test]
fn threads_do_not_change_a_bit() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let (test, reference) = (PAIRS[0].test(), PAIRS[0].reference());
        let (linear_test, linear_reference) = (test.to_linear(), reference.to_linear());
        let pair = Pair::new(&test, &reference).and_then(|pair| pair.with_linear(&linear_test, &linear_reference));
        let pair = pair.expect("one size");
        pool.install(|| METRICS.iter().map(|metric| metric.evaluate(&pair)).collect::<Vec<_>>())
    };
    assert_eq!(run(1), run(4));
}

#[test]
fn names_and_ids_are_unique_and_unknown_ones_are_refused() {
    for (i, metric) in METRICS.iter().enumerate() {
        assert!(METRICS[..i].iter().all(|other| other.name != metric.name && other.id != metric.id), "{}", metric.name);
        assert!(metric.id.contains('/'), "{} carries a version", metric.id);
    }
    assert!(find("pnsr").expect_err("unknown").to_string().contains("did you mean 'psnr'"));
}
