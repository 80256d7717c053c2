//! Sequences: the k-th point is the same however many are asked for, so that any prefix is usable.

use super::{Counts, DensityControl, Job, Parameter, Pattern};
use crate::sampling::sequences::{fraction, owen_scrambled, radical_inverse, sobol_second};
use crate::sampling::stream::Stream;

pub(super) const RANDOM: Pattern = Pattern {
    name: "random",
    aliases: &[],
    summary: "independent random points: the worst case to compare with",
    source: "as old as chance",
    cost: "O(n)",
    seeded: true,
    progressive: true,
    counts: Counts::Any,
    density: DensityControl::Warping,
    parameters: &[],
    generate: random,
};

pub(super) const HALTON: Pattern = Pattern {
    name: "halton",
    summary: "radical inverses in bases 2 and 3, from index 1 (Halton 1960)",
    source: "Halton 1960, On the Efficiency of Certain Quasi-random Sequences of Points",
    seeded: false,
    parameters: &[
        Parameter::whole(
            "base_x",
            "of the first coordinate; the two have no factor in common, or the points lie on lines",
            2,
            BASES,
        ),
        Parameter::whole("base_y", "of the second coordinate", 3, BASES),
        Parameter::whole("start", "index of the first point; that of index 0 is the corner", 1, [0, 1_000_000]),
    ],
    generate: halton,
    ..RANDOM
};

const BASES: [u32; 2] = [2, 1000];

pub(super) const R2: Pattern = Pattern {
    name: "r2",
    summary: "multiples of the plastic number's powers, modulo 1 (Roberts 2018)",
    source: "Roberts 2018, The Unreasonable Effectiveness of Quasirandom Sequences",
    seeded: false,
    generate: |job| r2(job.n),
    ..RANDOM
};

pub(super) const SOBOL: Pattern = Pattern {
    name: "sobol",
    summary: "the first two dimensions of Sobol's sequence, from the corner",
    source: "Sobol' 1967, On the Distribution of Points in a Cube",
    seeded: false,
    counts: Counts::PowersOfTwo,
    parameters: &[Parameter::switch("centred", "1: moved by half a stratum of n, so that their mean is the middle", false)],
    generate: sobol,
    ..RANDOM
};

pub(super) const SOBOL_OWEN: Pattern = Pattern {
    name: "sobol-owen",
    summary: "Sobol's sequence, Owen-scrambled in both coordinates: every power of two of points is a net",
    source: "Owen 1995, Randomly Permuted (t,m,s)-Nets and (t,s)-Sequences",
    cost: "O(n), 64 hashes a point",
    counts: Counts::PowersOfTwo,
    generate: sobol_owen,
    ..RANDOM
};

fn random(job: &Job<'_>) -> Vec<[f64; 2]> {
    let mut chance = Stream::new(job.seed, 0);
    (0..job.n).map(|_| chance.point()).collect()
}

fn halton(job: &Job<'_>) -> Vec<[f64; 2]> {
    let (bases, start) = ([job.whole("base_x"), job.whole("base_y")], job.whole("start"));
    (start..start + job.n).map(|i| bases.map(|base| radical_inverse(base, i))).collect()
}

fn r2(n: u32) -> Vec<[f64; 2]> {
    // The plastic number, the real root of x^3 = x + 1.
    const PLASTIC: f64 = 1.324_717_957_244_746;
    (0..n).map(|i| [1.0 / PLASTIC, 1.0 / (PLASTIC * PLASTIC)].map(|step| (0.5 + f64::from(i + 1) * step).fract())).collect()
}

fn sobol(job: &Job<'_>) -> Vec<[f64; 2]> {
    let shift = if job.switch("centred") { 0.5 / f64::from(job.n) } else { 0.0 };
    let place = |bits: u32| (f64::from(bits) / 4_294_967_296.0 + shift).fract();
    (0..job.n).map(|i| [i.reverse_bits(), sobol_second(i)].map(place)).collect()
}

fn sobol_owen(job: &Job<'_>) -> Vec<[f64; 2]> {
    let mut chance = Stream::new(job.seed, 2);
    let seeds = [chance.bits(), chance.bits()];
    (0..job.n)
        .map(|i| {
            let [x, y] = [i.reverse_bits(), sobol_second(i)];
            [fraction(owen_scrambled(x, seeds[0])), fraction(owen_scrambled(y, seeds[1]))]
        })
        .collect()
}
