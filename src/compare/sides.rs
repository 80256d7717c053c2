//! Two pictures of one size, and where they differ.

use super::Scope;
use crate::picture::{Channels, Raster};

/// The expected and the actual picture, and which of their pixels count.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sides<'a> {
    pub(super) expected: &'a Raster,
    pub(super) actual: &'a Raster,
    pub(super) scope: &'a Scope,
}

/// A pixel that differs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gap {
    pub(super) x: usize,
    /// Largest difference of a channel, alpha too; 1 is the highest level.
    pub(super) largest: f64,
    /// Sum of the squared differences of red, green and blue.
    pub(super) squared: f64,
}

impl Sides<'_> {
    pub(super) fn size(&self) -> [u32; 2] {
        self.expected.size()
    }

    /// Whether either picture has an alpha channel.
    pub(super) fn have_alpha(&self) -> bool {
        self.expected.has_alpha() || self.actual.has_alpha()
    }

    /// Calls `found` for every pixel of row `y` that counts and differs, from the left. Pixels of display values that are
    /// transparent on both sides are equal whatever their colour; floats carry light there, which is seen.
    pub(super) fn differing_in_row(&self, y: u32, found: impl FnMut(Gap)) {
        let counted = self.scope.row(y, self.size()[0]);
        let visit = Visit { counted: counted.as_deref(), found };
        let alike = self.expected.channel_count() == self.actual.channel_count();
        match (self.expected.channels(), self.actual.channels()) {
            (Channels::Eight(a), Channels::Eight(b)) if alike => visit.by_count(self.own(a, y), self.own(b, y), self),
            (Channels::Sixteen(a), Channels::Sixteen(b)) if alike => visit.by_count(self.own(a, y), self.own(b, y), self),
            (Channels::Float(a), Channels::Float(b)) if alike => visit.by_count(self.own(a, y), self.own(b, y), self),
            _ => match (self.expected.row_of_levels(y), self.actual.row_of_levels(y)) {
                (Some(a), Some(b)) => visit.pixels(&a, &b),
                _ => visit.pixels::<f32, 4>(&self.expected.row(y), &self.actual.row(y)),
            },
        }
    }

    /// The part of all values of one of the two that is row `y`.
    fn own<'v, T>(&self, all: &'v [T], y: u32) -> &'v [T] {
        let length = self.size()[0] as usize * self.expected.channel_count();
        &all[y as usize * length..][..length]
    }
}

struct Visit<'c, F> {
    counted: Option<&'c [bool]>,
    found: F,
}

impl<F: FnMut(Gap)> Visit<'_, F> {
    fn by_count<S: Sample>(self, a: &[S], b: &[S], sides: &Sides<'_>) {
        // Most rows of most pairs end here.
        if a == b {
            return;
        }
        match sides.expected.channel_count() {
            1 => self.pixels(a.as_chunks::<1>().0, b.as_chunks::<1>().0),
            2 => self.pixels(a.as_chunks::<2>().0, b.as_chunks::<2>().0),
            3 => self.pixels(a.as_chunks::<3>().0, b.as_chunks::<3>().0),
            _ => self.pixels(a.as_chunks::<4>().0, b.as_chunks::<4>().0),
        }
    }

    fn pixels<S: Sample, const N: usize>(mut self, a: &[[S; N]], b: &[[S; N]]) {
        for (x, (a, b)) in a.iter().zip(b).enumerate() {
            if a == b || self.counted.is_some_and(|counted| !counted[x]) || unseen(a, b) {
                continue;
            }
            let gaps: [f64; N] = std::array::from_fn(|channel| a[channel].gap(b[channel]));
            let largest = gaps.into_iter().fold(0.0, f64::max);
            if largest > 0.0 {
                (self.found)(Gap { x, largest, squared: squared(&gaps) });
            }
        }
    }
}

/// Whether both pixels are wholly transparent.
fn unseen<S: Sample, const N: usize>(a: &[S; N], b: &[S; N]) -> bool {
    N.is_multiple_of(2) && a[N - 1].is_transparent() && b[N - 1].is_transparent()
}

/// Over red, green and blue; grey is all three of them.
fn squared<const N: usize>(gaps: &[f64; N]) -> f64 {
    match N {
        1 | 2 => 3.0 * gaps[0] * gaps[0],
        _ => gaps[..3].iter().map(|gap| gap * gap).sum(),
    }
}

/// A channel's value as a file stores it.
trait Sample: Copy + PartialEq {
    /// How far apart two values are, 1 being the highest level; infinite if one of two floats is no number.
    fn gap(self, other: Self) -> f64;

    /// Whether this alpha hides its colour.
    fn is_transparent(self) -> bool;
}

impl Sample for u8 {
    fn gap(self, other: Self) -> f64 {
        f64::from(self.abs_diff(other)) / 255.0
    }

    fn is_transparent(self) -> bool {
        self == 0
    }
}

impl Sample for u16 {
    fn gap(self, other: Self) -> f64 {
        f64::from(self.abs_diff(other)) / 65_535.0
    }

    fn is_transparent(self) -> bool {
        self == 0
    }
}

impl Sample for f32 {
    fn gap(self, other: Self) -> f64 {
        // Equal infinities have no difference that arithmetic knows of, and any two NaN are as good as each other.
        if self == other || self.is_nan() && other.is_nan() {
            return 0.0;
        }
        let gap = (f64::from(self) - f64::from(other)).abs();
        if gap.is_nan() { f64::INFINITY } else { gap }
    }

    fn is_transparent(self) -> bool {
        false
    }
}
