//! The measures against closed forms, brute force and each other.

use super::*;
use crate::sampling::{PatternSpec, hash, larcher_pillichshammer, radical_inverse};

/// So many trials are enough for tests to tell patterns apart.
const TRIALS: u32 = 60;

const COUNTS: [u32; 6] = [4, 16, 64, 256, 1024, 4096];

fn set(spec: &str, n: u32, seed: u32) -> Vec<[f64; 2]> {
    PatternSpec::parse(spec).and_then(|spec| spec.points(n, seed)).expect("a set")
}

/// (i / n, radical inverse), from the origin on.
fn hammersley(n: u32) -> Vec<[f64; 2]> {
    (0..n).map(|i| [f64::from(i) / f64::from(n), radical_inverse(2, i)]).collect()
}

fn larcher(n: u32) -> Vec<[f64; 2]> {
    (0..n).map(|i| [f64::from(i) / f64::from(n), f64::from(larcher_pillichshammer(i)) / 2f64.powi(32)]).collect()
}

fn uniform(index: u64) -> f64 {
    (hash(index) >> 11) as f64 / (1u64 << 53) as f64
}

/// Relative difference.
fn off(found: f64, expected: f64) -> f64 {
    (found / expected - 1.0).abs()
}

#[test]
fn star_discrepancies_of_nets_and_grids_are_the_known_ones() {
    let grid = set("regular", 1024, 0);
    let corners: Vec<[f64; 2]> = grid.iter().map(|p| p.map(|x| x - 1.0 / 64.0)).collect();
    let exact = 1.0 - (63.0f64 / 64.0).powi(2);
    assert!(off(star(&grid), exact) < 1e-12, "{}", star(&grid));
    for (points, largest, l2) in
        [(&grid, 31.006, 7.367), (&corners, 61.52, 18.62), (&hammersley(1024), 4.665, 1.813), (&larcher(1024), 3.338, 0.834)]
    {
        assert!(off(1e3 * star(points), largest) < 2e-4, "{} for {largest}", star(points));
        assert!(off(1e3 * star_l2(points), l2) < 6e-4, "{} for {l2}", star_l2(points));
    }
    // What is not the set is not taken for it: a point a cell further, and the set moved by half a step.
    let mut moved = hammersley(1024);
    moved[512][1] += 1.0 / 32.0;
    assert!(off(1e3 * star_l2(&moved), 1.813) > 6e-4);
    assert!(off(1e3 * star(&set("hammersley", 1024, 0)), 4.665) > 1e-2);
}

#[test]
fn star_discrepancy_is_the_supremum_over_boxes() {
    // Coordinates in eighths give many ties, whatever the order of the points.
    for seed in 0..40u64 {
        let points: Vec<[f64; 2]> =
            (0..9).map(|i| [0, 1].map(|k| (8.0 * uniform(100 * seed + 2 * i + k)).floor() / 8.0)).collect();
        let mut largest = 0.0f64;
        for corner in (0..=8).flat_map(|k| (0..=8).map(move |l| [f64::from(k) / 8.0, f64::from(l) / 8.0])) {
            let area = corner[0] * corner[1];
            let open = points.iter().filter(|p| p[0] < corner[0] && p[1] < corner[1]).count() as f64 / 9.0;
            let closed = points.iter().filter(|p| p[0] <= corner[0] && p[1] <= corner[1]).count() as f64 / 9.0;
            largest = largest.max(area - open).max(closed - area);
        }
        assert!((star(&points) - largest).abs() < 1e-14, "{} for {largest}", star(&points));
    }
}

#[test]
fn the_map_of_deviations_approaches_the_star_discrepancy_from_below() {
    let points = set("jittered", 64, 5);
    let largest = |side: usize| deviations(&points, side).iter().fold(0.0f64, |most, d| most.max(d.abs()));
    assert!(largest(1000) <= star(&points) && off(largest(1000), star(&points)) < 0.05, "{}", largest(1000));
    assert!(largest(8) < 0.9 * star(&points), "a coarse map misses the peaks");
    assert_eq!(*deviations(&points, 16).last().expect("a corner"), 0.0, "the whole square has all points");
}

#[test]
fn rectangle_discrepancies_of_nets_and_grids_are_the_closed_forms() {
    let regular = [141.2985, 62.0645, 29.8629, 14.7817, 7.3720, 3.6836];
    let net = [105.717_620, 34.542_040, 10.252_534, 2.911_546, 0.805_623, 0.219_123];
    for (i, n) in COUNTS.into_iter().enumerate() {
        for (points, expected) in [(set("regular", n, 0), regular[i]), (hammersley(n), net[i]), (larcher(n), net[i])] {
            let found = 1e3 * stroud(&points);
            // To the last digit given.
            let digits = if expected == net[i] { 0.6e-6 } else { 0.6e-4 };
            assert!((found - expected).abs() < digits, "{found} for {expected} at {n}");
        }
        let mut wrong = larcher(n);
        wrong[1][0] += 0.1;
        assert!((1e3 * stroud(&wrong) - net[i]).abs() > 1e-3);
    }
}

#[test]
fn a_shift_on_the_torus_changes_a_net_only_in_the_star() {
    let net = hammersley(256);
    let shifted: Vec<[f64; 2]> = net.iter().map(|p| [(p[0] + 0.3125).fract(), (p[1] + 0.71875).fract()]).collect();
    assert!(off(stroud(&shifted), stroud(&net)) < 1e-9);
    assert!(off(stroud_torus(&shifted), stroud_torus(&net)) < 1e-9);
    assert!(off(star_l2(&shifted), star_l2(&net)) > 1e-2);
    let random = set("random", 256, 1);
    let shifted: Vec<[f64; 2]> = random.iter().map(|p| [(p[0] + 0.3125).fract(), (p[1] + 0.71875).fract()]).collect();
    assert!(off(stroud_torus(&shifted), stroud_torus(&random)) < 1e-9);
    assert!(off(stroud(&shifted), stroud(&random)) > 1e-3, "not so where rectangles end at the sides");
}

/// Roots of the expectations of T^2, times 1000, for [`COUNTS`] points.
const EXPECTED: [(&str, [f64; 6]); 4] = [
    ("random", [144.3376, 72.1688, 36.0844, 18.0422, 9.02110, 4.5105]),
    ("jittered", [130.1041, 52.0182, 19.5719, 7.1391, 2.56379, 0.9135]),
    ("semi-jittered", [129.1625, 50.1640, 20.6637, 8.9939, 4.11363, 1.9526]),
    ("n-rooks", [117.2743, 47.3918, 21.6197, 10.5175, 5.22102, 2.6058]),
];

#[test]
fn rectangle_discrepancies_of_random_sets_have_their_expectations() {
    for (i, n) in COUNTS.into_iter().enumerate() {
        for (pattern, expected) in EXPECTED {
            // The largest sets take long.
            let trials = if n > 1024 { TRIALS / 3 } else { TRIALS };
            let squares: Vec<f64> = (0..trials).map(|seed| stroud(&set(pattern, n, seed)).powi(2)).collect();
            let spread = Spread::of(&squares).expect("trials");
            let meets = |rms: f64| (spread.mean - (1e-3 * rms).powi(2)).abs() < 3.0 * spread.standard_error();
            assert!(meets(expected[i]), "{pattern}, {n}: {}", spread.mean.sqrt());
            let others = EXPECTED.iter().filter(|(other, _)| *other != pattern && n >= 256);
            for (other, rms) in others {
                assert!(!meets(rms[i]), "{pattern} is taken for {other} at {n}");
            }
        }
    }
}

#[test]
fn the_lattice_sum_is_that_over_its_rectangles() {
    let points = set("random", 37, 2);
    let mut sum = 0.0;
    let (mut rectangles, lines) = (0.0, 6);
    let place = |k: i32| f64::from(k) / f64::from(lines);
    for (a, c) in (0..=lines).flat_map(|a| (a + 1..=lines).map(move |c| (a, c))) {
        for (b, d) in (0..=lines).flat_map(|b| (b + 1..=lines).map(move |d| (b, d))) {
            let within = |p: &&[f64; 2]| (place(a)..place(c)).contains(&p[0]) && (place(b)..place(d)).contains(&p[1]);
            let share = points.iter().filter(within).count() as f64 / 37.0;
            sum += (share - f64::from((c - a) * (d - b)) / f64::from(lines * lines)).powi(2);
            rectangles += 1.0;
        }
    }
    assert!(off(stroud_on_lattice(&points, 6), f64::sqrt(sum / rectangles)) < 1e-12);
    // Ever finer lattices have ever more of all rectangles.
    assert!(off(stroud_on_lattice(&points, 4000), stroud(&points)) < 1e-3);
    assert!(off(stroud_on_lattice(&points, 40), stroud(&points)) > 1e-2);
}

#[test]
fn a_lattice_of_100_gives_the_published_grid() {
    assert!(off(1e3 * stroud_on_lattice(&set("regular", 1024, 0), 100), 7.4684) < 1e-5);
    assert!(off(1e3 * stroud_on_lattice(&hammersley(1024), 100), 0.818) < 1e-3);
    assert!(off(1e3 * stroud_on_lattice(&larcher(1024), 100), 0.808) < 1e-3);
    assert!(off(1e3 * stroud(&set("regular", 1024, 0)), 7.4684) > 1e-2, "the closed form is another figure");
}

#[test]
fn rectangles_of_the_torus_have_their_expectation() {
    // Of n random points: (1/4 - 1/9) / n.
    let squares: Vec<f64> = (0..TRIALS).map(|seed| stroud_torus(&set("random", 256, seed)).powi(2)).collect();
    let spread = Spread::of(&squares).expect("trials");
    assert!((spread.mean - 5.0 / 36.0 / 256.0).abs() < 3.0 * spread.standard_error());
    assert!(off(1e3 * stroud_torus(&set("regular", 1024, 0)), 10.42) < 1e-3);
    assert!(off(1e3 * stroud(&set("regular", 1024, 0)), 10.42) > 0.1);
}

#[test]
fn neighbours_are_as_far_as_in_the_reference() {
    let torus = |points: &[[f64; 2]]| nearest(points, Surroundings::Torus).expect("neighbours");
    for (points, smallest, mean) in
        [(set("regular", 1024, 0), 0.03125, 0.03125), (hammersley(1024), 0.00138, 0.02282), (larcher(1024), 0.02210, 0.02450)]
    {
        let found = torus(&points);
        assert!(
            (found.smallest - smallest).abs() < 0.6e-5 && (found.mean - mean).abs() < 0.6e-5,
            "{found:?} for {smallest}, {mean}"
        );
    }
    let pair = [[0.05, 0.5], [0.95, 0.5]];
    assert!((torus(&pair).smallest - 0.1).abs() < 1e-15);
    assert!((nearest(&pair, Surroundings::Open).expect("a pair").mean - 0.9).abs() < 1e-15);
}

#[test]
fn a_grid_has_power_where_it_repeats_and_nowhere_else() {
    let spectrum = Periodogram::of(&set("regular", 1024, 0), 64);
    assert!((spectrum.power(32, 0) - 1024.0).abs() < 1e-6 && (spectrum.power(-32, -64) - 1024.0).abs() < 1e-6);
    assert!(spectrum.power(31, 0) < 1e-20 && (spectrum.power(0, 0) - 1024.0).abs() < 1e-9);
    let figures = spectrum.figures(1024);
    assert!((figures.peak - 21.79).abs() < 5e-3 && figures.peak_frequency == 1.0, "{figures:?}");
    assert!((figures.axis - 16.254).abs() < 5e-4 && (figures.anisotropy_db - 18.8).abs() < 0.06, "{figures:?}");
}

#[test]
fn spectra_of_nets_are_the_reference_s() {
    for (points, low_quarter, low_half, largest, peak, at, onset, anisotropy) in [
        (hammersley(1024), 0.0, 0.0037, 1.05, 7.49, 2.0, 0.56, 14.6),
        (larcher(1024), 0.0001, 0.0382, 3.51, 6.42, 1.12, 0.59, 12.4),
    ] {
        let f = Periodogram::of(&points, 64).figures(1024);
        let lows = (f.low_quarter - low_quarter).abs() < 0.6e-4 && (f.low_half - low_half).abs() < 0.6e-4;
        assert!(lows && (f.low_largest - largest).abs() < 6e-3 && f.axis < 1e-20, "{f:?}");
        assert!((f.peak - peak).abs() < 6e-3 && (f.peak_frequency - at).abs() < 6e-3, "{f:?}");
        assert!((f.onset_frequency.unwrap_or(0.0) - onset).abs() < 6e-3 && (f.anisotropy_db - anisotropy).abs() < 0.06, "{f:?}");
    }
}

#[test]
fn white_noise_is_flat_and_even() {
    let mut sum = Periodogram::of(&set("random", 256, 0), 32);
    (1..TRIALS).for_each(|seed| sum.add(&Periodogram::of(&set("random", 256, seed), 32)));
    let figures = sum.figures(256);
    assert_eq!(sum.sets(), TRIALS);
    let floor = -10.0 * f64::from(TRIALS).log10();
    assert!((figures.low_half - 1.0).abs() < 0.05 && (figures.axis - 1.0).abs() < 0.1, "{figures:?}");
    assert!((figures.anisotropy_db - floor).abs() < 1.0, "{figures:?}");
    let jittered = Periodogram::of(&set("jittered", 256, 0), 32).figures(256);
    assert!(jittered.low_half < 0.6 && jittered.anisotropy_db > floor + 10.0, "one set, and not white: {jittered:?}");
}

#[test]
fn spreads_are_those_of_a_sample() {
    let spread = Spread::of(&[1.0, 2.0, 3.0, 6.0]).expect("four values");
    assert_eq!((spread.trials, spread.mean, spread.rms), (4, 3.0, 12.5f64.sqrt()));
    assert!((spread.variance - 14.0 / 3.0).abs() < 1e-15);
    assert!((spread.standard_error() - spread.standard_deviation() / 2.0).abs() < 1e-15);
    assert_eq!(Spread::of(&[7.0]).map(|one| (one.mean, one.variance)), Some((7.0, 0.0)));
    assert_eq!(Spread::of(&[]), None);
}

#[test]
fn sets_of_no_or_one_point_have_figures() {
    let none: [[f64; 2]; 0] = [];
    assert_eq!(star(&none), 1.0);
    assert!(off(star_l2(&none), 1.0 / 3.0) < 1e-15 && off(stroud(&none), 1.0 / 6.0) < 1e-15);
    assert!(off(stroud_torus(&none), 1.0 / 3.0) < 1e-15 && stroud_on_lattice(&none, 1) == 1.0);
    assert_eq!((nearest(&none, Surroundings::Torus), nearest(&[[0.5, 0.5]], Surroundings::Open)), (None, None));
    assert_eq!(star(&[[0.5, 0.5]]), 0.75);
    // sqrt(4/16 - 2/16 + 4/144).
    assert!(off(stroud(&[[0.5, 0.5]]), (0.125f64 + 1.0 / 36.0).sqrt()) < 1e-15);
    assert_eq!(Periodogram::of(&[[0.5, 0.5]], 2).power(1, 1), 1.0);
    assert_eq!(Periodogram::of(&none, 2).figures(0).low_half, 0.0);
}
