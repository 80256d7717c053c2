//! Exact means against many samples, and errors against those known.

use super::fresnel::fresnel;
use super::*;
use crate::sampling::PatternSpec;

fn test(name: &str) -> PixelTest {
    PixelTest::new(name, 0.0).expect("a known test")
}

/// Errors of one set in every pixel.
fn fixed(test: &PixelTest, points: &[[f64; 2]]) -> Vec<f64> {
    (0..test.pixels()).map(|pixel| test.error(pixel, points.iter().copied())).collect()
}

fn set(spec: &str, n: u32, seed: u32) -> Vec<[f64; 2]> {
    PatternSpec::parse(spec).and_then(|spec| spec.points(n, seed)).expect("a set")
}

#[test]
fn fresnel_integrals() {
    // Simpson's rule over so many intervals that it is exact to f64.
    let simpson = |t: f64| {
        let intervals = 40_000;
        let at = |i: u32| {
            let s = t * f64::from(i) / f64::from(intervals);
            (std::f64::consts::FRAC_PI_2 * s * s).sin_cos()
        };
        let weight = |i: u32| if i == 0 || i == intervals { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
        let (sin, cos) = (0..=intervals).fold((0.0, 0.0), |(sin, cos), i| {
            let (s, c) = at(i);
            (sin + weight(i) * s, cos + weight(i) * c)
        });
        [cos, sin].map(|sum| sum * t / f64::from(3 * intervals))
    };
    for t in [0.0, 0.3, 1.0, 1.599, 1.6, 2.0, 5.0, 9.5] {
        let (found, expected) = (fresnel(t), simpson(t));
        assert!((0..2).all(|k| (found[k] - expected[k]).abs() < 1e-11), "{t}: {found:?} for {expected:?}");
    }
    assert!(fresnel(1e6).iter().all(|part| (part - 0.5).abs() < 1e-6));
}

#[test]
fn exact_means_are_what_many_samples_come_to() {
    let turned = PixelTest::new("checker", 30.0).expect("a floor");
    let grid = set("larcher", 4096, 0);
    for (name, test) in [
        ("halfplane", test("halfplane")),
        ("halfplane-axis", test("halfplane-axis")),
        ("checker", test("checker")),
        ("checker, turned", turned),
        ("zone", test("zone")),
    ] {
        // A prime step meets all rows and columns. Right below the horizon even so many samples are too few.
        let pixels = (40 * SIDE..test.pixels()).step_by(1009);
        let errors: Vec<f64> = pixels.map(|pixel| test.error(pixel, grid.iter().copied()).abs()).collect();
        let worst = errors.iter().fold(0.0, |worst: f64, e| worst.max(*e));
        assert!(worst < 0.012, "{name}: {worst}");
    }
    // A floor turned by one degree is another floor.
    let (floor, other) = (test("checker"), PixelTest::new("checker", 31.0).expect("a floor"));
    let differ = (40 * SIDE..SIDE * SIDE).step_by(1009).filter(|&p| (floor.exact(p) - other.exact(p)).abs() > 0.012);
    assert!(differ.count() > 20);
}

#[test]
fn edges_cut_off_what_they_should() {
    for (name, expected) in [("halfplane", 0.13177), ("halfplane-axis", 0.15742)] {
        let test = test(name);
        let variance = |pixel: usize| test.exact(pixel) * (1.0 - test.exact(pixel));
        let mean = (0..test.pixels()).map(variance).sum::<f64>() / test.pixels() as f64;
        assert!((mean / expected - 1.0).abs() < 5e-3, "{name}: {mean}");
    }
}

#[test]
fn errors_of_a_grid_are_the_known_ones() {
    // Test; its parts with their errors at 16 and 64 samples a pixel.
    type Known = (&'static str, &'static [(&'static str, [f64; 2])]);
    let expectations: [Known; 4] = [
        ("halfplane", &[("all", [31.5, 11.1])]),
        ("halfplane-axis", &[("all", [55.0, 21.0])]),
        ("checker", &[("all", [57.4, 30.6]), ("far", [145.0, 78.9]), ("near", [10.1, 7.1])]),
        ("zone", &[("all", [71.6, 2.9]), ("lowpass", [7.0, 0.22])]),
    ];
    for (name, parts) in expectations {
        let test = test(name);
        for (i, n) in [16, 64].into_iter().enumerate() {
            let points = set("regular", n, 0);
            let found = test.rms(&fixed(&test, &points));
            assert_eq!(found.len(), parts.len());
            for ((part, rms), (expected_part, expected)) in found.iter().zip(parts) {
                assert_eq!(part, expected_part);
                assert!((1e3 * rms / expected[i] - 1.0).abs() < 0.03, "{name}, {part}, {n}: {rms} for {}", expected[i]);
            }
            // A grid that is off centre by half a cell is seen at once.
            let half = 0.5 / f64::from(n).sqrt();
            let corners: Vec<[f64; 2]> = points.iter().map(|p| p.map(|x| x - half)).collect();
            let wrong = test.rms(&fixed(&test, &corners))[0].1;
            assert!(1e3 * wrong > 1.15 * parts[0].1[i], "{name}, {n}: {wrong}");
        }
    }
}

#[test]
fn random_sets_err_as_chance_says() {
    let test = test("halfplane");
    let pool: Vec<Vec<[f64; 2]>> = (0..4096).map(|seed| set("random", 16, seed)).collect();
    let errors: Vec<f64> = (0..test.pixels()).map(|p| test.error(p, pool[p % pool.len()].iter().copied())).collect();
    let rms = test.rms(&errors)[0].1;
    assert!((1e3 * rms / 90.75 - 1.0).abs() < 0.02, "{rms}");
    assert!((1e3 * test.rms(&fixed(&test, &pool[0]))[0].1 / 90.75 - 1.0).abs() > 0.02, "one set is not all of them");
}

#[test]
fn unknown_tests_and_angles_are_refused() {
    let words = |name: &str, yaw: f64| PixelTest::new(name, yaw).expect_err("no such test").to_string();
    assert!(words("checkers", 0.0).contains("did you mean 'checker'?"));
    assert!(words("checker", f64::NAN).contains("-180 to 180"));
    assert!(words("checker", 181.0).contains("-180 to 180"));
    assert_eq!(pixel_tests().count(), 4);
    let known = test("zone");
    assert_eq!(known.error(7, [].into_iter()), -known.exact(7));
}
