//! Where the recursive scheme samples a pixel: its corners and centre, then those of its quadrants, then those of theirs.

use crate::pass::Jitter;

/// A place in a pixel, halved twice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sample {
    /// A corner of squares: one of 5 by 5, in quarters of the pixel from its upper left. The last of each row and column are the
    /// first of the next pixel's, and drawn for themselves only where there is no next pixel.
    Point([u32; 2]),
    /// The centre of one of the 4 by 4 finest squares.
    Centre([u32; 2]),
}

/// Samples of a pixel of which nothing is shared.
pub(super) const MOST: u32 = 41;

/// Those that a pixel owns, where it has neighbours to its right and below: a layer each.
pub(super) const OWNED: u32 = 32;

/// Levels of squares: the pixel, its quadrants, and theirs.
pub(super) const LEVELS: u32 = 3;

impl Sample {
    /// All of them by level. The first is one that every pixel owns and takes.
    pub(super) fn all() -> Vec<Self> {
        let lattice = |side: u32| (0..side * side).map(move |i| [i % side, i / side]);
        let mut all: Vec<Self> = lattice(5).map(Self::Point).chain(lattice(4).map(Self::Centre)).collect();
        all.sort_by_key(|sample| sample.level());
        all
    }

    /// The size of the largest squares that it belongs to: 0 for the pixel, halved a level.
    pub(super) fn level(self) -> u32 {
        match self {
            Self::Point([2, 2] | [0 | 4, 0 | 4]) => 0,
            Self::Point([x, y]) if (x + y) % 2 == 0 => 1,
            Self::Point(_) | Self::Centre(_) => 2,
        }
    }

    pub(super) fn jitter(self) -> Jitter {
        let offset_px = match self {
            Self::Point(place) => place.map(|quarters| quarters as f32 / 4.0 - 0.5),
            Self::Centre(place) => place.map(|quarters| (quarters as f32 + 0.5) / 4.0 - 0.5),
        };
        Jitter { offset_px, weight: 1.0 }
    }

    /// Where whitted.wgsl looks for it, in the pixel that owns it.
    pub(super) fn layer(self) -> u32 {
        match self {
            Self::Point([x, y]) => x % 4 + 4 * (y % 4),
            Self::Centre([x, y]) => 16 + x + 4 * y,
        }
    }

    /// Whether it lies on the pixel's right border, and on its lower one.
    pub(super) fn on_far_border(self) -> [bool; 2] {
        match self {
            Self::Point(place) => place.map(|quarters| quarters == 4),
            Self::Centre(_) => [false; 2],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_share_41_samples_of_which_a_pixel_owns_32() {
        let all = Sample::all();
        let at = |level| all.iter().filter(|sample| sample.level() == level).count();
        assert_eq!(((0..LEVELS).map(at).collect::<Vec<_>>(), all.len()), (vec![5, 8, 28], MOST as usize));
        let owned: Vec<&Sample> = all.iter().filter(|sample| sample.on_far_border() == [false; 2]).collect();
        let mut layers: Vec<u32> = owned.iter().map(|sample| sample.layer()).collect();
        layers.sort_unstable();
        assert_eq!(layers, (0..OWNED).collect::<Vec<_>>());
        assert_eq!(all[0], Sample::Point([0, 0]));
    }
}
