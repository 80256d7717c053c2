//! What is left of a thing where it was.

use super::tracks::fetch;
use super::{Place, rgb};
use crate::metrics::Figure;
use crate::picture::DisplayPicture;

/// Ages at which ghosts are looked for, in frames since a surface was uncovered: 1 to this.
pub const AGES: usize = 8;

/// Ages at which a ghost should be gone.
pub const SETTLED_AGES: std::ops::RangeInclusive<usize> = 4..=AGES;

/// Least distance in display RGB of what was in front and what is there now: where they look alike, no ghost can be told.
pub const GHOST_FLOOR: f64 = 0.1;

/// What is left, as a share of 1, that no display shows.
const INVISIBLE: f64 = 1.0 / 255.0;

/// A pixel that another surface hid not long ago.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Uncovered {
    /// In reading order.
    pub pixel: usize,
    /// How many frames ago it was hidden last, from 1.
    pub age: usize,
    /// Where in that frame.
    pub place: Place,
}

/// How much of what was in front is still in the picture, by how long ago it was there.
///
/// With R the right colour and C what was in front as the reference showed it then, the share is the one that fits T = R + g (C - R)
/// best over all pixels of an age: sum of <T - R, C - R> over sum of |C - R|^2. Summed before it is divided, errors that have nothing
/// to do with C cancel; a mean of each pixel's share, clipped at 0, would take a jagged edge for a ghost.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct GhostSums {
    /// For each age from 1: the sum over the line, and the sum below it.
    sums: [[f64; 2]; AGES],
}

impl GhostSums {
    /// Of one frame. `before` is what the reference showed so many frames ago, from 1.
    #[must_use]
    pub fn of<'p>(
        test: &DisplayPicture,
        reference: &DisplayPicture,
        uncovered: &[Uncovered],
        before: impl Fn(usize) -> Option<&'p DisplayPicture>,
    ) -> Self {
        let mut found = Self::default();
        for Uncovered { pixel, age, place } in uncovered {
            let Some(front) = before(*age).and_then(|picture| fetch(picture, *place)) else { continue };
            let [t, r] = [test, reference].map(|picture| rgb(picture.pixels()[*pixel]));
            let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|c| a[c] * b[c]).sum::<f64>();
            let [error, contrast] = [t, front].map(|color| [0, 1, 2].map(|c| color[c] - r[c]));
            let square = dot(contrast, contrast);
            if square >= GHOST_FLOOR * GHOST_FLOOR {
                let [over, below] = &mut found.sums[age - 1];
                *over += dot(error, contrast);
                *below += square;
            }
        }
        found
    }

    /// Adds those of another frame.
    pub fn add(&mut self, other: &Self) {
        for (own, other) in self.sums.iter_mut().zip(&other.sums) {
            *own = [own[0] + other[0], own[1] + other[1]];
        }
    }

    /// The share that is left at some ages together, 0 to about 1; not applicable where nothing was uncovered.
    #[must_use]
    pub fn left(&self, ages: impl Iterator<Item = usize>) -> Figure {
        let [over, below] = ages.map(|age| self.sums[age - 1]).fold([0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
        match over / below {
            _ if below == 0.0 => Figure::NotApplicable,
            // Less than nothing is an error of another kind.
            share if share < 0.0 => Figure::Number(0.0),
            share => Figure::from(share),
        }
    }

    /// The share at each age from 1.
    #[must_use]
    pub fn by_age(&self) -> Vec<Figure> {
        (1..=AGES).map(|age| self.left(std::iter::once(age))).collect()
    }

    /// For how many frames a ghost can be seen: the last age that has 1/255 or more, 0 for none; infinite if it is the last one
    /// looked at.
    #[must_use]
    pub fn trail(&self) -> Figure {
        let by_age = self.by_age();
        if by_age.iter().all(|figure| *figure == Figure::NotApplicable) {
            return Figure::NotApplicable;
        }
        if by_age.contains(&Figure::NonFinite) {
            return Figure::NonFinite;
        }
        let seen = |figure: &Figure| figure.number().is_some_and(|share| share >= INVISIBLE);
        match by_age.iter().rposition(seen) {
            None => Figure::Number(0.0),
            Some(last) if last + 1 == AGES => Figure::Infinite,
            Some(last) => Figure::Number((last + 1) as f64),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::temporal::Tracks;
    use crate::metrics::temporal::sample::box_over_wall;

    const SIZE: [u32; 2] = [40, 6];

    /// A dark box on a bright wall, and behind it what `left` says is left of it at each age.
    fn frame(now: i32, left: impl Fn(i32) -> f32) -> DisplayPicture {
        DisplayPicture::from_fn(SIZE[0], SIZE[1], |x, _| {
            let behind = now - x as i32;
            let share = if (-3..=0).contains(&behind) {
                1.0
            } else if behind > 0 {
                left((behind + 1) / 2)
            } else {
                0.0
            };
            let level = |wall: f32, dark: f32| wall + share * (dark - wall);
            [level(0.9, 0.1), level(0.7, 0.2), level(0.5, 0.3), 1.0]
        })
        .expect("a size")
    }

    /// The box moves two pixels a frame and is at column 26 now.
    fn sums(left: impl Fn(i32) -> f32) -> GhostSums {
        let flows: Vec<_> = (0..AGES as i32).map(|ago| box_over_wall(SIZE, 26 - 2 * ago, 4, 2)).collect();
        let tracks = Tracks::follow(SIZE, &flows.iter().collect::<Vec<_>>());
        let before: Vec<DisplayPicture> = (1..=AGES as i32).map(|ago| frame(26 - 2 * ago, |_| 0.0)).collect();
        GhostSums::of(&frame(26, left), &frame(26, |_| 0.0), tracks.uncovered(), |age| before.get(age - 1))
    }

    #[test]
    fn a_trail_of_known_decay_has_that_decay() {
        let by_age = sums(|age| 0.5f32.powi(age)).by_age();
        for (age, found) in (1..).zip(by_age) {
            let found = found.number().expect("all ages are there");
            assert!((found - 0.5f64.powi(age)).abs() < 1e-6, "age {age}: {found}");
        }
    }

    #[test]
    fn a_trail_ends_where_nobody_sees_it() {
        assert_eq!(sums(|age| 0.1f32.powi(age)).trail(), Figure::Number(2.0));
        assert_eq!(sums(|_| 0.0).trail(), Figure::Number(0.0));
        assert_eq!(sums(|_| 0.5).trail(), Figure::Infinite);
        assert_eq!(sums(|_| f32::NAN).trail(), Figure::NonFinite);
        assert_eq!(GhostSums::default().trail(), Figure::NotApplicable);
    }

    #[test]
    fn the_right_picture_has_no_ghost_and_the_opposite_is_none() {
        assert_eq!(sums(|_| 0.0).left(1..=AGES), Figure::Number(0.0));
        assert_eq!(sums(|_| -0.2).left(1..=AGES), Figure::Number(0.0));
        assert_eq!(GhostSums::default().left(1..=AGES), Figure::NotApplicable);
    }

    #[test]
    fn frames_are_summed_before_they_are_divided() {
        let mut both = sums(|_| 0.2);
        both.add(&sums(|_| -0.2));
        assert!(both.left(1..=AGES).number().expect("a number") < 1e-6);
    }
}
