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
        // Sets that are made by trying and moving cost too much for many points.
        let large = if p.density == DensityControl::Warping { &[2500, MAX_POINTS][..] } else { &[] };
        for n in (1..40).chain([63, 64, 100, 1000]).chain(large.iter().copied()) {
            let points = p.points(n, 3);
            assert_eq!(points.len(), n as usize, "{} {n}", p.name);
            assert!(points.iter().flatten().all(|x| (0.0..1.0).contains(x)), "{} {n}", p.name);
            if p.seeded && (p.name, n) != ("lloyd", 1) {
                assert_ne!(points, p.points(n, 4), "{} {n}", p.name);
            } else {
                // Also a single cell of Lloyd's, whose centre is the square's wherever it started.
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

#[test]
fn names_and_aliases_are_unique_and_parameters_take_their_defaults() {
    let names = pattern_names();
    for (i, name) in names.iter().enumerate() {
        assert!(!names[..i].contains(name), "{name} twice");
    }
    assert_eq!(pattern("larcher").expect("an alias").name, "larcher-pillichshammer");
    for p in PATTERNS {
        for parameter in p.parameters {
            parameter.check(p.name, parameter.default, "its default").expect(parameter.name);
        }
    }
}

#[test]
fn one_point_is_where_it_has_to_be() {
    for name in ["regular", "rotated", "standard-msaa", "lloyd", "hammersley", "fibonacci:centred=0"] {
        let points = PatternSpec::parse(name).expect(name).points(1, 0).expect(name);
        let expected = if name.starts_with("fib") { 0.0 } else { 0.5 };
        assert!((points[0][0] - expected).abs() < 1e-12, "{name}: {points:?}");
    }
    for p in PATTERNS {
        assert!(p.points(0, 0).is_empty(), "{}", p.name);
    }
}

#[test]
fn a_prefix_of_a_progressive_set_is_a_shorter_set() {
    for p in PATTERNS.iter().filter(|p| p.progressive) {
        assert_eq!(p.points(200, 5)[..77], p.points(77, 5), "{}", p.name);
    }
}

#[test]
fn nets_have_a_point_in_every_elementary_interval() {
    let nets = ["hammersley", "hammersley:xor=1", "larcher", "larcher:xor=1", "hammersley-owen", "sobol", "sobol-owen"];
    for name in nets {
        let points = PatternSpec::parse(name).expect(name).points(64, 9).expect(name);
        for log in 0..=6 {
            let (columns, rows) = (f64::from(1 << log), f64::from(64 >> log));
            let mut cells: Vec<_> = points.iter().map(|p| ((p[0] * columns) as u32, (p[1] * rows) as u32)).collect();
            cells.sort_unstable();
            cells.dedup();
            assert_eq!(cells.len(), 64, "{name}: {columns}x{rows}");
        }
    }
}

#[test]
fn rooks_do_not_see_each_other() {
    for name in ["n-rooks", "n-rooks:centred=1", "multi-jittered", "correlated-multi-jittered"] {
        // 64 is a square; other counts keep their rows.
        for (n, axes) in [(64, 0..2), (50, 1..2)] {
            let points = PatternSpec::parse(name).expect(name).points(n, 2).expect(name);
            for axis in axes {
                let mut fields: Vec<u32> = points.iter().map(|p| (p[axis] * f64::from(n)) as u32).collect();
                fields.sort_unstable();
                assert_eq!(fields, (0..n).collect::<Vec<_>>(), "{name} {n}");
            }
        }
    }
}

/// Distance of each point to its nearest neighbour on the torus: the least and the mean.
fn nearest_distances(points: &[[f64; 2]]) -> [f64; 2] {
    let along = |a: f64, b: f64| (a - b).abs().min(1.0 - (a - b).abs());
    let nearest = points.iter().enumerate().map(|(i, p)| {
        let others = points.iter().enumerate().filter(|(k, _)| *k != i);
        others.map(|(_, q)| along(p[0], q[0]).hypot(along(p[1], q[1]))).fold(f64::INFINITY, f64::min)
    });
    let nearest: Vec<f64> = nearest.collect();
    [nearest.iter().copied().fold(f64::INFINITY, f64::min), nearest.iter().sum::<f64>() / points.len() as f64]
}

#[test]
fn neighbours_are_as_far_apart_as_in_the_literature() {
    // N = 1024: least and mean nearest distance, and the standard deviations of a set's.
    for (spec, expected, deviation) in [
        ("hammersley", [0.00138, 0.02282], [1e-5, 1e-5]),
        ("larcher", [0.02210, 0.02450], [1e-5, 1e-5]),
        ("fibonacci", [0.01304, 0.02939], [1e-5, 1e-5]),
        ("r2", [0.02211, 0.02377], [1e-5, 1e-5]),
        ("semi-jittered", [0.01641, 0.02485], [3e-4, 1e-4]),
        ("correlated-multi-jittered", [0.00734, 0.02796], [2.4e-3, 7e-4]),
        ("sobol-owen", [0.00377, 0.02034], [1.3e-3, 5e-4]),
        ("poisson-disk:radius=0.68", [0.02284, 0.02562], [2e-5, 1e-4]),
        ("poisson-disk:radius=0.75", [0.02519, 0.02702], [2e-5, 1e-4]),
        ("mitchell", [0.02448, 0.02798], [2e-4, 1e-4]),
        ("lloyd", [0.02412, 0.03029], [9e-4, 1e-4]),
        ("lloyd:raster=512", [0.02353, 0.03020], [1.2e-3, 1e-4]),
        ("lloyd:torus=1", [0.02529, 0.03050], [8e-4, 1e-4]),
        ("ccpd", [0.01850, 0.02648], [1e-3, 1e-4]),
        ("ccpd:torus=1", [0.01878, 0.02651], [1e-3, 1e-4]),
    ] {
        let points = PatternSpec::parse(spec).expect(spec).points(1024, 1).expect(spec);
        let found = nearest_distances(&points);
        for k in 0..2 {
            assert!((found[k] - expected[k]).abs() < 3.5 * deviation[k], "{spec}: {found:?}, not {expected:?}");
        }
    }
}

#[test]
fn random_sets_have_the_discrepancies_that_are_expected() {
    // N = 1024: mean over sets and standard deviation of a set, x 1000, from 12 to 100 independent sets.
    for (spec, sets, mean, deviation, known_from) in [
        ("random", 8, 8.87, 1.60, 100),
        ("jittered", 8, 2.562, 0.090, 1000),
        ("semi-jittered", 8, 4.1134, 0.042, 1000),
        ("n-rooks", 8, 5.17, 0.70, 1000),
        ("multi-jittered", 8, 1.856, 0.038, 100),
        ("correlated-multi-jittered", 8, 1.353, 0.109, 100),
        ("sobol-owen", 8, 1.151, 0.028, 100),
        ("poisson-disk", 8, 3.210, 0.44, 1200),
        ("mitchell", 3, 3.145, 0.457, 100),
        ("lloyd", 8, 5.549, 1.117, 12),
        ("lloyd:raster=512", 8, 6.154, 1.400, 100),
        ("lloyd:torus=1", 8, 4.991, 1.024, 12),
        ("ccpd", 4, 2.226, 0.104, 60),
        ("ccpd:torus=1", 4, 2.082, 0.104, 60),
    ] {
        let spec = PatternSpec::parse(spec).expect(spec);
        let sum: f64 = (0..sets).map(|seed| discrepancy(&spec.points(1024, seed).expect("in range"))).sum();
        let found = 1000.0 * sum / f64::from(sets);
        let error = deviation * (1.0 / f64::from(sets) + 1.0 / f64::from(known_from)).sqrt();
        assert!((found - mean).abs() < 3.0 * error, "{spec}: {found}, not {mean} +- {error}");
    }
}

#[test]
fn disks_hold_all_points_evenly() {
    for p in PATTERNS {
        let request = Request { domain: Domain::Disk, ..Request::new(500, 1) };
        let points = PatternSpec::from(p).generate(&request).expect("in range");
        let within = |radius: f64| points.iter().filter(|q| (q[0] - 0.5).hypot(q[1] - 0.5) <= radius).count();
        assert_eq!(within(0.5), 500, "{}", p.name);
        // Half the area; independent points have a standard deviation of 11.
        assert!(within(0.5f64.sqrt() / 2.0).abs_diff(250) < 40, "{}: {}", p.name, within(0.5f64.sqrt() / 2.0));
    }
}

#[test]
fn bright_places_have_their_share_of_the_points() {
    let halves = Density::new(2, 1, vec![1.0, 3.0]).expect("fine");
    let ring = Density::from_fn(64, 64, |p| if (p[0] - 0.5).hypot(p[1] - 0.5) < 0.25 { 4.0 } else { 1.0 }).expect("fine");
    for p in PATTERNS {
        for domain in [Domain::Square, Domain::Disk] {
            let share = |density: &Density, bright: &dyn Fn(&[f64; 2]) -> bool| {
                let request = Request { domain, density: Some(density), ..Request::new(600, 1) };
                let points = PatternSpec::from(p).generate(&request).expect("in range");
                points.iter().filter(|q| bright(q)).count() as f64 / 600.0
            };
            // Standard deviation of independent points: 0.018 and 0.02.
            let found = share(&halves, &|q| q[0] >= 0.5);
            assert!((found - 0.75).abs() < 0.06, "{} {domain:?}: {found}", p.name);
            let bright = std::f64::consts::PI * 0.25 * 0.25;
            let area = if domain == Domain::Square { 1.0 } else { 4.0 * bright };
            let found = share(&ring, &|q| (q[0] - 0.5).hypot(q[1] - 0.5) < 0.25);
            let expected = 4.0 * bright / (area + 3.0 * bright);
            assert!((found - expected).abs() < 0.07, "{} {domain:?}: {found}, not {expected}", p.name);
        }
    }
}

#[test]
fn what_takes_long_tells_how_far_it_is() {
    let heard = std::sync::Mutex::new(Vec::new());
    let listen = |share: f64| heard.lock().expect("no panic").push(share);
    for name in ["poisson-disk", "mitchell", "lloyd", "ccpd"] {
        let request = Request { progress: Progress::new(&listen), ..Request::new(100, 0) };
        let points = PatternSpec::parse(name).expect(name).generate(&request).expect(name);
        assert_eq!(points, pattern(name).expect(name).points(100, 0), "{name}: not the same when watched");
        let shares = std::mem::take(&mut *heard.lock().expect("no panic"));
        assert!(shares.len() > 5 && shares.iter().all(|s| (0.0..=1.0).contains(s)), "{name}: {shares:?}");
        assert!(shares.last() > shares.first(), "{name}");
    }
}
