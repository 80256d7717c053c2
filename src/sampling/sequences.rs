//! Radical inverses, scrambles and the one hash that stands for chance.

/// The digits of `index` in `base`, mirrored at the radix point: the van der Corput sequence, in [0, 1).
#[must_use]
pub fn radical_inverse(base: u32, mut index: u32) -> f64 {
    let mut value = 0.0;
    let mut place = 1.0;
    while index > 0 {
        place /= f64::from(base);
        value += place * f64::from(index % base);
        index /= base;
    }
    value
}

/// The second coordinate of the (0, m, 2)-net of Larcher and Pillichshammer (2001), as a binary fraction of 2^32: bit k of the
/// index toggles the k + 1 leading bits.
#[must_use]
pub fn larcher_pillichshammer(index: u32) -> u32 {
    (0..32).filter(|k| index >> k & 1 == 1).fold(0, |bits, k| bits ^ !(u32::MAX.checked_shr(k + 1).unwrap_or(0)))
}

/// The second coordinate of Sobol's sequence (1967), as a binary fraction of 2^32: direction numbers of the polynomial x + 1, each
/// the one before, shifted and added to it without carry.
#[must_use]
pub fn sobol_second(index: u32) -> u32 {
    let directions = std::iter::successors(Some(1u32 << 31), |v| Some(v ^ v >> 1));
    directions.zip((0..32).map(|k| index >> k & 1)).fold(0, |bits, (direction, digit)| bits ^ (direction * digit))
}

/// Owen's nested uniform scrambling in base 2 (1995) of a binary fraction of 2^32: each bit is flipped by a coin that depends on
/// all the bits before it.
#[must_use]
pub fn owen_scrambled(bits: u32, seed: u32) -> u32 {
    (0..32).fold(0, |scrambled, depth| {
        // A leading one marks where the prefix starts, so that prefixes of different lengths never share a coin.
        let prefix = (1u64 << depth) | (u64::from(bits) >> (32 - depth));
        let coin = hash(u64::from(seed) << 33 ^ prefix) as u32 & 1;
        let bit = bits >> (31 - depth) & 1;
        scrambled | (bit ^ coin) << (31 - depth)
    })
}

/// SplitMix64's output function (Steele et al. 2014): the same 64 bits for the same number, everywhere.
#[must_use]
pub fn hash(x: u64) -> u64 {
    let mut z = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ z >> 31
}

/// Leading bits as a number in [0, 1).
pub(super) fn unit(bits: u64) -> f64 {
    const BITS: u32 = 53;
    (bits >> (64 - BITS)) as f64 / (1u64 << BITS) as f64
}

/// A binary fraction of 2^32, read at the middle of its last place: in (0, 1).
pub(super) fn fraction(bits: u32) -> f64 {
    (f64::from(bits) + 0.5) / 4_294_967_296.0
}

/// How far along the Hilbert curve (1891) of 2^16 cells a side a point of the unit square lies.
pub(super) fn hilbert_index(point: [f64; 2]) -> u32 {
    const ORDER: u32 = 16;
    let last = f64::from((1u32 << ORDER) - 1);
    let [mut x, mut y] = point.map(|u| (u * f64::from(1u32 << ORDER)).clamp(0.0, last) as u32);
    let mut index = 0;
    for level in (0..ORDER).rev() {
        let (right, lower) = (x >> level & 1, y >> level & 1);
        index = index << 2 | ((3 * right) ^ lower);
        // Turn the quarter so that the curve enters and leaves it at the right corners.
        if lower == 0 {
            if right == 1 {
                (x, y) = (!x, !y);
            }
            (x, y) = (y, x);
        }
    }
    index
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radical_inverses_mirror_the_digits() {
        assert_eq!([1, 2, 3, 4, 6].map(|i| radical_inverse(2, i)), [0.5, 0.25, 0.75, 0.125, 0.375]);
        assert!((radical_inverse(3, 5) - (2.0 / 3.0 + 1.0 / 9.0)).abs() < 1e-15);
    }

    #[test]
    fn larcher_pillichshammer_starts_as_published() {
        let quarters = [0, 1, 2, 3].map(|i| larcher_pillichshammer(i) >> 30);
        assert_eq!(quarters, [0, 2, 3, 1]);
    }

    #[test]
    fn sobol_starts_as_published() {
        let eighths = [0, 1, 2, 3, 4, 5, 6, 7].map(|i| sobol_second(i) >> 29);
        assert_eq!(eighths, [0, 4, 6, 2, 5, 1, 3, 7]);
    }

    #[test]
    fn owen_scrambling_keeps_the_strata() {
        // Whatever the coins, 2^k points of the van der Corput sequence fall one into each interval of length 2^-k.
        for seed in 0..8 {
            let mut seen = [false; 64];
            for i in 0u32..64 {
                seen[(owen_scrambled(i.reverse_bits(), seed) >> 26) as usize] = true;
            }
            assert!(seen.iter().all(|s| *s));
        }
        assert_ne!(owen_scrambled(0, 1), owen_scrambled(0, 2));
    }

    #[test]
    fn the_hilbert_curve_visits_neighbours() {
        let mut cells: Vec<(u32, [i32; 2])> = (0..16)
            .flat_map(|x| (0..16).map(move |y| [x, y]))
            .map(|c| (hilbert_index(c.map(|i| (f64::from(i) + 0.5) / 16.0)) >> 24, c))
            .collect();
        cells.sort_unstable();
        for (pair, i) in cells.windows(2).zip(0..) {
            assert_eq!((pair[0].0, pair[1].0), (i, i + 1));
            let step: i32 = (0..2).map(|k| (pair[0].1[k] - pair[1].1[k]).abs()).sum();
            assert_eq!(step, 1, "{pair:?}");
        }
    }
}
