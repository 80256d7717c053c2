//! Point sets in the unit square: `n` points in [0, 1)^2, any n from 1 to [`MAX_POINTS`].

use super::sequences::{fraction, larcher_pillichshammer, owen_scrambled, radical_inverse, uniform};
use crate::error::{Result, unknown};

/// The most points a pattern is asked for.
pub const MAX_POINTS: u32 = 4096;

/// A way to spread samples over a pixel.
#[derive(Debug)]
pub struct Pattern {
    /// As in `pattern=NAME`.
    pub name: &'static str,
    /// What it is, in a line.
    pub summary: &'static str,
    /// Whether the seed changes it.
    pub seeded: bool,
    /// Whether its first points are spread as well as all of them are.
    pub progressive: bool,
    /// Number of points, seed -> the points.
    pub points: fn(u32, u32) -> Vec<[f64; 2]>,
}

/// Every pattern there is.
pub const PATTERNS: &[Pattern] = &[
    Pattern {
        name: "regular",
        summary: "the centres of n equal cells in rows: exact on constant areas, worst on near-axis edges",
        seeded: false,
        progressive: false,
        points: regular,
    },
    Pattern {
        name: "rotated",
        summary: "the regular grid sheared both ways, so that no two samples share a row or column (4: RGSS)",
        seeded: false,
        progressive: false,
        points: rotated,
    },
    Pattern {
        name: "jittered",
        summary: "one random point in each of n equal cells (Cook 1986)",
        seeded: true,
        progressive: false,
        points: jittered,
    },
    Pattern {
        name: "random",
        summary: "independent random points: the worst case to compare with",
        seeded: true,
        progressive: true,
        points: random,
    },
    Pattern {
        name: "halton",
        summary: "radical inverses in bases 2 and 3, from index 1 (Halton 1960)",
        seeded: false,
        progressive: true,
        points: halton,
    },
    Pattern {
        name: "r2",
        summary: "multiples of the plastic number's powers, modulo 1 (Roberts 2018)",
        seeded: false,
        progressive: true,
        points: r2,
    },
    Pattern {
        name: "hammersley",
        summary: "i/n against the radical inverse in base 2 (Hammersley 1960)",
        seeded: false,
        progressive: false,
        points: hammersley,
    },
    Pattern {
        name: "hammersley-owen",
        summary: "Hammersley with an Owen-scrambled second coordinate (Owen 1995)",
        seeded: true,
        progressive: false,
        points: hammersley_owen,
    },
    Pattern {
        name: "larcher",
        summary: "the digital net of Larcher and Pillichshammer (2001): lowest discrepancy of all",
        seeded: false,
        progressive: false,
        points: larcher,
    },
];

/// The pattern of this name.
///
/// # Errors
/// [`crate::Error::Request`] that lists the names.
pub fn pattern(name: &str) -> Result<&'static Pattern> {
    PATTERNS.iter().find(|p| p.name == name).ok_or_else(|| {
        let names: Vec<_> = PATTERNS.iter().map(|p| p.name).collect();
        unknown("pattern", name, &names)
    })
}

/// `n` cells of equal area: rows of nearly equal counts, each as high as its count asks for. For square n, the square grid.
/// Calls `point` with (row, rows, column, columns) and maps the answer from the cell into the square.
fn in_cells(n: u32, mut point: impl FnMut([u32; 4]) -> [f64; 2]) -> Vec<[f64; 2]> {
    let rows = f64::from(n).sqrt().round() as u32;
    let mut points = Vec::with_capacity(n as usize);
    for row in 0..rows {
        // The first `done` points fill the rows above; the difference of two floors spreads the remainder.
        let done = row * n / rows;
        let columns = (row + 1) * n / rows - done;
        for column in 0..columns {
            let [u, v] = point([row, rows, column, columns]);
            let x = (f64::from(column) + u) / f64::from(columns);
            let y = (f64::from(done) + v * f64::from(columns)) / f64::from(n);
            points.push([x, y]);
        }
    }
    points
}

fn regular(n: u32, _seed: u32) -> Vec<[f64; 2]> {
    in_cells(n, |_| [0.5, 0.5])
}

fn rotated(n: u32, _seed: u32) -> Vec<[f64; 2]> {
    in_cells(n, |[row, rows, column, columns]| {
        [1.0 - (f64::from(row) + 0.5) / f64::from(rows), (f64::from(column) + 0.5) / f64::from(columns)]
    })
}

fn jittered(n: u32, seed: u32) -> Vec<[f64; 2]> {
    let mut next = 0;
    in_cells(n, |_| {
        next += 2;
        [uniform(seed, next - 2), uniform(seed, next - 1)]
    })
}

fn random(n: u32, seed: u32) -> Vec<[f64; 2]> {
    (0..u64::from(n)).map(|i| [uniform(seed, 2 * i), uniform(seed, 2 * i + 1)]).collect()
}

fn halton(n: u32, _seed: u32) -> Vec<[f64; 2]> {
    (1..=n).map(|i| [radical_inverse(2, i), radical_inverse(3, i)]).collect()
}

fn r2(n: u32, _seed: u32) -> Vec<[f64; 2]> {
    // The plastic number, the real root of x^3 = x + 1.
    const PLASTIC: f64 = 1.324_717_957_244_746;
    (0..n).map(|i| [1.0 / PLASTIC, 1.0 / (PLASTIC * PLASTIC)].map(|step| (0.5 + f64::from(i + 1) * step).fract())).collect()
}

/// A net in two dimensions: x the middles of n strata, y a binary fraction.
fn net(n: u32, second: impl Fn(u32) -> u32) -> Vec<[f64; 2]> {
    (0..n).map(|i| [(f64::from(i) + 0.5) / f64::from(n), fraction(second(i))]).collect()
}

/// A net whose y is a multiple of 1/n, moved to the middles of its strata: the mean of all points is the pixel's centre.
fn centred_net(n: u32, second: impl Fn(u32) -> u32) -> Vec<[f64; 2]> {
    net(n, second).into_iter().map(|[x, y]| [x, (y + 0.5 / f64::from(n)).fract()]).collect()
}

fn hammersley(n: u32, _seed: u32) -> Vec<[f64; 2]> {
    centred_net(n, u32::reverse_bits)
}

fn hammersley_owen(n: u32, seed: u32) -> Vec<[f64; 2]> {
    net(n, |i| owen_scrambled(i.reverse_bits(), seed))
}

fn larcher(n: u32, _seed: u32) -> Vec<[f64; 2]> {
    centred_net(n, larcher_pillichshammer)
}

#[cfg(test)]
mod tests {
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
        discrepancy(&(pattern(name).expect("exists").points)(n, 1))
    }

    #[test]
    fn every_pattern_fills_the_square_for_every_count() {
        for p in PATTERNS {
            for n in (1..40).chain([63, 64, 100, 1000, 2500, MAX_POINTS]) {
                let points = (p.points)(n, 3);
                assert_eq!(points.len(), n as usize, "{} {n}", p.name);
                assert!(points.iter().flatten().all(|x| (0.0..1.0).contains(x)), "{} {n}", p.name);
                if p.seeded {
                    assert_ne!(points, (p.points)(n, 4), "{} {n}", p.name);
                } else {
                    assert_eq!(points, (p.points)(n, 4), "{} {n}", p.name);
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
        assert_eq!(rotated(4, 0), [[0.375, 0.125], [0.875, 0.375], [0.125, 0.625], [0.625, 0.875]]);
    }

    #[test]
    fn no_two_rotated_samples_share_a_row_or_column() {
        for n in [4, 9, 16, 25, 64] {
            for axis in 0..2 {
                let mut values: Vec<f64> = rotated(n, 0).iter().map(|p| p[axis]).collect();
                values.sort_by(f64::total_cmp);
                assert!(values.windows(2).all(|w| w[1] - w[0] > 0.5 / f64::from(n)), "{n}");
            }
        }
    }

    #[test]
    fn square_counts_make_square_grids() {
        assert_eq!(regular(4, 0), [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]]);
    }

    #[test]
    fn an_unknown_pattern_is_named() {
        assert!(pattern("haltom").expect_err("no such pattern").to_string().contains("'halton'"));
    }
}
