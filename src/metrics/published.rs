//! The metrics against the figures that other implementations agree on.

use super::formula::{FormulaPair, HEIGHT, PAIRS, WIDTH};
use super::*;
#[cfg(feature = "flip-oracle")]
use crate::picture::DisplayPicture;
use crate::picture::srgb_decode;

fn number(name: &str, pair: &Pair<'_>) -> f64 {
    find(name).expect("known").evaluate(pair).number().unwrap_or(f64::NAN)
}

/// Asserts that a figure is the published one to within that much.
#[track_caller]
fn assert_meets(what: &str, pair: &FormulaPair, got: f64, published: f64, within: f64) {
    let name = pair.name;
    assert!((got - published).abs() <= within, "{what} of {name}: {got}, published {published}");
}

/// Half a step of the sixth, seventh and ninth decimal: what a figure printed to that many may be off.
const SIX: f64 = 0.500_1e-6;
const SEVEN: f64 = 0.500_1e-7;
const NINE: f64 = 0.500_1e-9;

fn maximum(map: &[f32]) -> f64 {
    map.iter().copied().fold(0.0, f32::max).into()
}

#[test]
fn differences_meet_the_published_figures() {
    for formula in PAIRS {
        let (test, reference) = (formula.test(), formula.reference());
        let pair = Pair::new(&test, &reference).expect("one size");
        let mse = pair.display().mean(|t, r| (t - r).powi(2)) * 255.0 * 255.0;
        // Pictures hold f32: eight digits, of which the published figure of box3 has ten.
        assert_meets("MSE", formula, mse, formula.mse, SIX.max(1e-7 * formula.mse));
        assert_meets("PSNR", formula, number("psnr", &pair), formula.psnr, SIX);
    }
}

#[test]
fn linear_psnr_meets_the_published_figures() {
    for formula in PAIRS {
        let (test, reference) = (formula.test(), formula.reference());
        let (linear_test, linear_reference) = (test.to_linear(), reference.to_linear());
        let pair = Pair::new(&test, &reference).and_then(|pair| pair.with_linear(&linear_test, &linear_reference));
        let got = number("psnr-linear", &pair.expect("one size"));
        assert_meets("linear PSNR of f32 pictures", formula, got, formula.psnr_linear, 5e-6);
        assert_meets("linear PSNR", formula, exact_linear_psnr(formula), formula.psnr_linear, SIX);
    }
}

/// The figure without the rounding of linear values to f32.
fn exact_linear_psnr(formula: &FormulaPair) -> f64 {
    let squared = |channel: usize| {
        let [test, reference] = formula.exact(channel);
        test.iter().zip(&reference).map(|(&t, &r)| (srgb_decode(t) - srgb_decode(r)).powi(2)).sum::<f64>()
    };
    -10.0 * ((0..3).map(squared).sum::<f64>() / f64::from(3 * WIDTH * HEIGHT)).log10()
}

#[test]
fn ssim_meets_the_published_figures() {
    for formula in PAIRS {
        let (test, reference) = (formula.test(), formula.reference());
        let pair = Pair::new(&test, &reference).expect("one size");
        assert_meets("SSIM of f32 pictures", formula, number("ssim", &pair), formula.ssim, 3e-9);
        let channel = |channel| {
            let [test, reference] = formula.exact(channel);
            ssim::plane_mean(WIDTH as usize, &test, &reference)
        };
        assert_meets("SSIM", formula, (0..3).map(channel).sum::<f64>() / 3.0, formula.ssim, NINE);
    }
}

/// The published means were summed in f32, which loses the seventh digit of 3072 errors: the map meets them when it is summed
/// like that, and our sums in f64 are as near as that loss allows.
#[test]
fn flip_meets_the_published_figures() {
    let summed_in_f32 = |map: &[f32]| f64::from(map.iter().sum::<f32>() / map.len() as f32);
    for formula in PAIRS {
        let (test, reference) = (formula.test(), formula.reference());
        let pair = Pair::new(&test, &reference).expect("one size");
        let map = pair.flip_map().expect("a map");
        let at_67 = flip::compute_map(&pair, 67.0).expect("a map");
        assert_meets("FLIP mean in f32", formula, summed_in_f32(map), formula.flip[0], SEVEN);
        assert_meets("FLIP mean", formula, number("flip", &pair), formula.flip[0], 2.5e-7);
        assert_meets("FLIP maximum", formula, maximum(map), formula.flip[1], SEVEN);
        assert_meets("FLIP mean at 67 in f32", formula, summed_in_f32(&at_67), formula.flip_67[0], SIX);
        assert_meets("FLIP mean at 67", formula, flip::mean_of(&at_67), formula.flip_67[0], 7e-7);
        assert_meets("FLIP maximum at 67", formula, maximum(&at_67), formula.flip_67[1], SIX);
    }
}

#[test]
fn the_ids_name_the_viewing_distance() {
    let suffix = format!("@{PIXELS_PER_DEGREE:.4}");
    for name in ["flip", "flip-p99"] {
        assert!(find(name).expect("known").id.ends_with(&suffix), "{name} is at {PIXELS_PER_DEGREE}");
    }
}

#[cfg(feature = "flip-oracle")]
#[test]
fn flip_agrees_with_nvidias_own_code() {
    for formula in PAIRS {
        let (test, reference) = (formula.test(), formula.reference());
        let pair = Pair::new(&test, &reference).expect("one size");
        let rgb = |picture: &DisplayPicture| {
            let bytes: Vec<u8> = picture.to_rgba8().chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
            nv_flip::FlipImageRgb8::with_data(picture.width(), picture.height(), &bytes)
        };
        let theirs = nv_flip::flip(rgb(&reference), rgb(&test), nv_flip::DEFAULT_PIXELS_PER_DEGREE).to_vec();
        let ours = flip::compute_map(&pair, nv_flip::DEFAULT_PIXELS_PER_DEGREE).expect("a map");
        let furthest = ours.iter().zip(&theirs).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(furthest <= 1e-6, "{}: pixels differ by up to {furthest}", formula.name);
    }
}
