//! Sets whose first coordinate counts evenly and whose second mixes: nets in base 2, and a lattice.

use super::{Counts, DensityControl, Job, Parameter, Pattern};
use crate::sampling::sequences::{fraction, larcher_pillichshammer, owen_scrambled};
use crate::sampling::stream::Stream;

const CENTRED: Parameter =
    Parameter::switch("centred", "1: at the middles of the n strata, so that the mean is the middle; 0: at their starts", true);
const XOR: Parameter = Parameter::switch(
    "xor",
    "1: the seed toggles bits of both coordinates, a random digital shift that keeps the net and leaves nothing to centre",
    false,
);

pub(super) const HAMMERSLEY: Pattern = Pattern {
    name: "hammersley",
    aliases: &[],
    summary: "i/n against the radical inverse in base 2 (Hammersley 1960)",
    source: "Hammersley 1960, Monte Carlo Methods for Solving Multivariable Problems",
    cost: "O(n)",
    seeded: false,
    progressive: false,
    counts: Counts::PowersOfTwo,
    density: DensityControl::Warping,
    parameters: &[CENTRED, XOR],
    generate: |job| net(job, u32::reverse_bits),
};

pub(super) const HAMMERSLEY_OWEN: Pattern = Pattern {
    name: "hammersley-owen",
    summary: "Hammersley with an Owen-scrambled second coordinate (Owen 1995)",
    source: "Owen 1995, Randomly Permuted (t,m,s)-Nets and (t,s)-Sequences",
    cost: "O(n), 32 hashes a point",
    seeded: true,
    parameters: &[],
    generate: |job| {
        let y = |i: u32| fraction(owen_scrambled(i.reverse_bits(), job.seed));
        (0..job.n).map(|i| [(f64::from(i) + 0.5) / f64::from(job.n), y(i)]).collect()
    },
    ..HAMMERSLEY
};

pub(super) const LARCHER_PILLICHSHAMMER: Pattern = Pattern {
    name: "larcher-pillichshammer",
    aliases: &["larcher"],
    summary: "the digital net of Larcher and Pillichshammer (2001): lowest discrepancy of all",
    source: "Larcher and Pillichshammer 2001, Walsh Series Analysis of the L2-discrepancy of Symmetrisized Point Sets",
    generate: |job| net(job, larcher_pillichshammer),
    ..HAMMERSLEY
};

pub(super) const FIBONACCI: Pattern = Pattern {
    name: "fibonacci",
    summary: "a lattice of one generator: i/n against multiples of the golden ratio, modulo 1",
    source: "Zaremba 1966, Good Lattice Points, Discrepancy, and Numerical Integration",
    counts: Counts::Any,
    parameters: &[CENTRED],
    generate: fibonacci,
    ..HAMMERSLEY
};

/// x the n strata in turn, y a binary fraction, which for a power of two lies in another stratum each time.
fn net(job: &Job<'_>, second: fn(u32) -> u32) -> Vec<[f64; 2]> {
    let n = f64::from(job.n);
    if job.switch("xor") {
        let mut chance = Stream::new(job.seed, 2);
        let masks = [chance.bits(), chance.bits()];
        let first = |i: u32| ((u64::from(i) << 32) / u64::from(job.n)) as u32;
        return (0..job.n).map(|i| [fraction(first(i) ^ masks[0]), fraction(second(i) ^ masks[1])]).collect();
    }
    if job.switch("centred") {
        return (0..job.n).map(|i| [(f64::from(i) + 0.5) / n, (fraction(second(i)) + 0.5 / n).fract()]).collect();
    }
    (0..job.n).map(|i| [f64::from(i) / n, f64::from(second(i)) / 4_294_967_296.0]).collect()
}

fn fibonacci(job: &Job<'_>) -> Vec<[f64; 2]> {
    // The golden ratio less 1; ratios of neighbouring Fibonacci numbers tend to it.
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    let start = if job.switch("centred") { 0.5 } else { 0.0 };
    let steps = (0..job.n).map(|i| f64::from(i) + start);
    steps.map(|step| [step / f64::from(job.n), (step * GOLDEN).fract()]).collect()
}
