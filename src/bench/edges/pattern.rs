//! The pictures: straight edges of one angle, and the exact answer to them.

use glam::DVec2;

use crate::capture::analytic::half_plane_share;
use crate::picture::{Pixel, srgb_decode, srgb_encode};

/// Side of a picture in pixels.
pub(super) const SIDE: u32 = 192;

/// From edge to edge in pixels. The sixteenth gives each of 16 neighbours a place of its own within its pixels; the 8 keep them
/// out of each other's sight: no filter looks farther across an edge.
const SPACING: f64 = 8.0 + 1.0 / 16.0;

/// Of all edges, in pixels: without it each that rises would mirror one that falls, and no edge may run along pixels' borders or
/// centres.
const SHIFT: f64 = 1.0 / 64.0;

/// The part that is scored: so far from the middle across the edges and along them. 16 edges fit where they are upright. What is
/// left beyond it along them is 64 pixels: a run of 1 degree is 57 long, and its end must be in sight.
const SCORED: [f64; 2] = [65.0, 32.0];

/// Display values of the two sides. Strong enough for any threshold, and near enough to each other that blending display values
/// instead of light is not all there is to be seen.
const SIDES: [u8; 2] = [88, 168];

/// Parallel edges that turn from dark to bright and back.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pattern {
    normal: DVec2,
}

impl Pattern {
    /// Edges of so many degrees from the vertical.
    pub(super) fn of(degrees: u32) -> Self {
        let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
        Self { normal: DVec2::new(cos, sin) }
    }

    /// Signed distance from the middle of the picture, across the edges.
    fn across(&self, at: DVec2) -> f64 {
        self.normal.dot(at - DVec2::splat(0.5 * f64::from(SIDE))) + SHIFT
    }

    /// How far a pixel's centre is from the nearest edge, signed; and whether the side that counts up is the bright one.
    fn nearest(&self, [x, y]: [u32; 2]) -> (f64, bool) {
        let place = self.across(centre([x, y])) / SPACING;
        let band = place.floor();
        ((place - band - 0.5) * SPACING, band.rem_euclid(2.0) == 0.0)
    }

    /// Whether a point lies on a bright side.
    pub(super) fn is_bright(&self, at: DVec2) -> bool {
        (self.across(at) / SPACING + 0.5).floor().rem_euclid(2.0) == 1.0
    }

    /// How much of a pixel is bright.
    pub(super) fn share(&self, pixel: [u32; 2]) -> f64 {
        if !self.is_crossed(pixel) {
            return f64::from(self.is_bright(centre(pixel)));
        }
        let (distance, rises) = self.nearest(pixel);
        let beyond = half_plane_share(DVec2::splat(-0.5), self.normal, -distance);
        if rises { beyond } else { 1.0 - beyond }
    }

    /// Whether an edge passes through the inside of a pixel.
    pub(super) fn is_crossed(&self, pixel: [u32; 2]) -> bool {
        self.nearest(pixel).0.abs() < 0.5 * (self.normal.x.abs() + self.normal.y.abs())
    }

    /// Whether a pixel lies in the part that is scored.
    fn is_scored(&self, pixel: [u32; 2]) -> bool {
        let from_middle = (centre(pixel) - DVec2::splat(0.5 * f64::from(SIDE))).abs();
        let [across, along] =
            if self.normal.x >= self.normal.y { [from_middle.x, from_middle.y] } else { [from_middle.y, from_middle.x] };
        across < SCORED[0] && along < SCORED[1]
    }

    /// The picture that one sample a pixel makes, display values.
    pub(super) fn aliased(&self) -> Vec<Pixel> {
        Self::picture(|pixel| shown(f64::from(self.is_bright(centre(pixel)))))
    }

    /// A picture made of the exact shares, or of whatever stands for them.
    pub(super) fn picture(value: impl Fn([u32; 2]) -> Pixel) -> Vec<Pixel> {
        pixels().map(value).collect()
    }

    /// The exact answer.
    pub(super) fn truth(&self) -> Truth {
        let scored = pixels().zip(0..).filter(|(pixel, _)| self.is_scored(*pixel));
        let (mut shares, mut crossed) = (Vec::new(), 0);
        for (pixel, index) in scored {
            crossed += u32::from(self.is_crossed(pixel));
            shares.push((index, self.share(pixel)));
        }
        Truth { shares, crossed }
    }
}

/// What the scored pixels of a pattern should hold.
#[derive(Debug)]
pub(super) struct Truth {
    /// Place of a pixel in reading order, and how much of it is bright.
    shares: Vec<(usize, f64)>,
    /// How many of them an edge crosses.
    crossed: u32,
}

impl Truth {
    /// Root mean square error of a picture of display values, where 1 is an edge's step in linear light. The squares of all scored
    /// pixels are summed and divided by the number of those that an edge crosses: what a filter spoils beside an edge counts, and
    /// the flat rest changes nothing.
    pub(super) fn rms(&self, picture: &[Pixel]) -> f64 {
        let error = |(index, share): &(usize, f64)| {
            picture[*index][..3].iter().map(|v| (shown_share(f64::from(*v)) - share).powi(2)).sum::<f64>() / 3.0
        };
        (self.shares.iter().map(error).sum::<f64>() / f64::from(self.crossed.max(1))).sqrt()
    }
}

/// The columns and rows of all pixels in reading order.
fn pixels() -> impl Iterator<Item = [u32; 2]> {
    (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| [x, y]))
}

/// Where a pixel is sampled.
pub(super) fn centre([x, y]: [u32; 2]) -> DVec2 {
    DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)
}

fn linear_sides() -> [f64; 2] {
    SIDES.map(|side| srgb_decode(f64::from(side) / 255.0))
}

/// So much of the bright side, in 8 bits.
pub(super) fn shown(share: f64) -> Pixel {
    let [dark, bright] = linear_sides();
    grey((srgb_encode(dark + share * (bright - dark)) * 255.0).round())
}

/// So much of the bright side where it is display values that are blended, in 8 bits.
pub(super) fn blended(share: f64) -> Pixel {
    let [dark, bright] = SIDES.map(f64::from);
    grey((dark + share * (bright - dark)).round())
}

fn grey(level: f64) -> Pixel {
    let value = (level / 255.0) as f32;
    [value, value, value, 1.0]
}

/// How much of the bright side a display value stands for.
fn shown_share(display: f64) -> f64 {
    let [dark, bright] = linear_sides();
    (srgb_decode(display) - dark) / (bright - dark)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the centres of crossed pixels that lie evenly: integrated by hand over the distance from the edge.
    fn rms_of_one_sample(degrees: u32) -> f64 {
        let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
        let (a, b) = (cos.max(sin), cos.min(sin));
        let squares = a / 3.0 * (0.125 - (b / (2.0 * a)).powi(3)) + b.powi(3) / (20.0 * a * a);
        (squares / (0.5 * (a + b))).sqrt()
    }

    #[test]
    fn one_sample_a_pixel_has_the_error_that_theory_says() {
        assert!((rms_of_one_sample(0) - (1.0f64 / 12.0).sqrt()).abs() < 1e-12);
        for degrees in 0..90 {
            let pattern = Pattern::of(degrees);
            let (found, theory) = (pattern.truth().rms(&pattern.aliased()), rms_of_one_sample(degrees));
            assert!((found / theory - 1.0).abs() < 0.03, "{degrees} degrees: {found}, in theory {theory}");
        }
    }

    #[test]
    fn shares_are_those_of_many_samples() {
        const SIDE: u32 = 64;
        for degrees in [0, 1, 13, 44, 45, 71, 89] {
            let pattern = Pattern::of(degrees);
            for pixel in
                [[96, 96], [97, 90], [40, 101], [120, 33], [66, 150]].into_iter().flat_map(|[x, y]| [[x, y], [x + 3, y + 5]])
            {
                let at = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE) - 0.5;
                let bright = |i: &u32| pattern.is_bright(centre(pixel) + DVec2::new(at(i % SIDE), at(i / SIDE)));
                let sampled = (0..SIDE * SIDE).filter(bright).count() as f64 / f64::from(SIDE * SIDE);
                let exact = pattern.share(pixel);
                assert!((exact - sampled).abs() < 1.5 / f64::from(SIDE), "{degrees} degrees, {pixel:?}: {exact}, {sampled}");
            }
        }
    }

    #[test]
    fn upright_edges_have_sixteen_places_in_their_pixels() {
        let truth = Pattern::of(0).truth();
        let mut places: Vec<u64> = truth.shares.iter().map(|(_, share)| (share * 64.0).round() as u64).collect();
        places.sort_unstable();
        places.dedup();
        // Beside nothing and all of a pixel.
        assert_eq!(places.len(), 18, "{places:?}");
    }

    #[test]
    fn the_exact_shares_have_no_error_but_that_of_eight_bits() {
        let pattern = Pattern::of(17);
        let exact = Pattern::picture(|pixel| shown(pattern.share(pixel)));
        assert!(pattern.truth().rms(&exact) < 0.005);
        let shifted = Pattern::picture(|[x, y]| shown(pattern.share([x.saturating_sub(1), y])));
        assert!(pattern.truth().rms(&shifted) > 0.3);
    }
}
