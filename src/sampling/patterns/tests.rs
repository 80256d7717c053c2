use super::*;

/// Root mean square over all axis-parallel rectangles of volume minus share of points, times 2 (Morokoff and Caflisch 1994).
fn discrepancy(points: &[[f64; 2]]) -> f64 {
    let n = points.len() as f64;
    let pairs: f64 = points
        .iter()
        .flat_map(|a| points.iter().map(move |b| (0..2).map(|k| a[k].min(b[k]) * (1.0 - a[k].max(b[k]))).product::<f64>()))
        .sum();
    let singles: f64 = points.iter().map(|p| p.iter().map(|x| x * (1.0 - x)).product::<f64>()).sum();
    (4.0 / (n * n) * pairs - 2.0 / n * singles + 4.0 / 144.0).sqrt()
}

fn discrepancy_of(name: &str, n: u32) -> f64 {
    discrepancy(&pattern(name).expect("exists").points(n, 1))
}

#[test]
fn every_pattern_fills_the_square_for_every_count() {
    for p in PATTERNS {
        for n in (1..40).chain([63, 64, 100, 1000, 2500, MAX_POINTS]) {
            let points = p.points(n, 3);
            assert_eq!(points.len(), n as usize, "{} {n}", p.name);
            assert!(points.iter().flatten().all(|x| (0.0..1.0).contains(x)), "{} {n}", p.name);
            if p.seeded {
                assert_ne!(points, p.points(n, 4), "{} {n}", p.name);
            } else {
                assert_eq!(points, p.points(n, 4), "{} {n}", p.name);
            }
        }
    }
}

#[test]
fn discrepancies_are_the_published_ones() {
    // Closed form, N = 1024, from the lecture's table of discrepancies, recomputed.
    for (name, expected, tolerance) in [
        ("regular", 7.37199e-3, 1e-7),
        ("hammersley", 0.805_623e-3, 2e-6),
        ("larcher", 0.805_623e-3, 2e-6),
        ("halton", 1.412e-3, 1e-6),
        ("r2", 1.535e-3, 1e-6),
        ("jittered", 2.562e-3, 0.3e-3),
        ("random", 8.87e-3, 4e-3),
    ] {
        let found = discrepancy_of(name, 1024);
        assert!((found - expected).abs() < tolerance, "{name}: {found}");
    }
}

#[test]
fn four_rotated_samples_are_the_standard_positions_of_hardware() {
    assert_eq!(
        pattern("rotated").expect("exists").points(4, 0),
        [[0.375, 0.125], [0.875, 0.375], [0.125, 0.625], [0.625, 0.875]]
    );
}

#[test]
fn no_two_rotated_samples_share_a_row_or_column() {
    for n in [4, 9, 16, 25, 64] {
        for axis in 0..2 {
            let mut values: Vec<f64> = pattern("rotated").expect("exists").points(n, 0).iter().map(|p| p[axis]).collect();
            values.sort_by(f64::total_cmp);
            assert!(values.windows(2).all(|w| w[1] - w[0] > 0.5 / f64::from(n)), "{n}");
        }
    }
}

#[test]
fn square_counts_make_square_grids() {
    assert_eq!(pattern("regular").expect("exists").points(4, 0), [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]]);
}

#[test]
fn an_unknown_pattern_is_named() {
    assert!(pattern("haltom").expect_err("no such pattern").to_string().contains("'halton'"));
}
