//! The colours around each point of a patch, and whether those of another patch lie among them.

use super::patch::{MARGIN, Patch};

/// Grid points a pixel, along each axis.
pub(super) const GRID: i32 = 4;

/// Farthest displacement, squared, in grid steps: 0.75 pixels.
const REACH_SQUARED: i32 = 9;

/// Half the side of the lattice of points that one displacement must explain, in grid steps: half a pixel.
pub(super) const WINDOW: i32 = 2;

/// What a hull is wider by, as a share of the contrast within [`MARGIN`] pixels of the less contrasting picture: filters with
/// negative lobes overshoot, and differ in how far they reach.
const OVERSHOOT: f32 = 0.08;

/// The same for differences of channels and for their sum, as shares of the largest contrast of a channel: what is a straight line
/// in linear light is a curve in coded values.
const BEND: [f32; 2] = [0.15, 0.5];

/// Of levels of 8 bits, which a rounded mixture may be off, where there is a contrast to mix.
const ROUNDING: f32 = 1.0 / 255.0;

/// Red, green, blue, red - green, green - blue, blue - red, their sum, alpha.
type Extents = [f32; 8];

fn extents([r, g, b, a]: [f32; 4]) -> Extents {
    [r, g, b, r - g, g - b, b - r, r + g + b, a]
}

/// A patch on a grid finer than its pixels.
#[derive(Debug)]
pub(super) struct Hull {
    side: i32,
    at: Vec<Extents>,
    /// Least and largest within 0.56 pixels of each point.
    low: Vec<Extents>,
    high: Vec<Extents>,
}

impl Hull {
    pub(super) fn of(patch: &Patch) -> Self {
        let side = (patch.side as i32 - 1) * GRID + 1;
        let at = interpolated(patch, side);
        let low = gathered(&at, side, f32::min);
        let high = gathered(&at, side, f32::max);
        Self { side, at, low, high }
    }

    /// Whether one displacement brings every point of the other patch around a pixel into this hull.
    pub(super) fn explains(&self, other: &Self, pixel: [u32; 2], tolerance: &Extents) -> bool {
        let [x, y] = pixel.map(|place| place as i32 * GRID);
        displacements().any(|[dx, dy]| {
            let steps = || (-WINDOW..=WINDOW).step_by(2);
            steps()
                .all(|v| steps().all(|u| self.holds([x + u + dx, y + v + dy], &other.at[other.index([x + u, y + v])], tolerance)))
        })
    }

    fn holds(&self, place: [i32; 2], found: &Extents, tolerance: &Extents) -> bool {
        let index = self.index(place);
        let (low, high) = (&self.low[index], &self.high[index]);
        // Written so that NaN is nowhere held.
        (0..found.len()).all(|k| found[k] >= low[k] - tolerance[k] && found[k] <= high[k] + tolerance[k])
    }

    fn index(&self, [x, y]: [i32; 2]) -> usize {
        (y * self.side + x) as usize
    }

    /// Range of each extent over the pixels around one.
    fn contrast(&self, pixel: [u32; 2]) -> Extents {
        let around = |place: u32| (place.saturating_sub(MARGIN)..=place + MARGIN).map(|place| place as i32 * GRID);
        let (mut low, mut high) = ([f32::INFINITY; 8], [f32::NEG_INFINITY; 8]);
        for y in around(pixel[1]).filter(|y| *y < self.side) {
            for x in around(pixel[0]).filter(|x| *x < self.side) {
                let found = &self.at[self.index([x, y])];
                low = std::array::from_fn(|k| low[k].min(found[k]));
                high = std::array::from_fn(|k| high[k].max(found[k]));
            }
        }
        std::array::from_fn(|k| high[k] - low[k])
    }
}

/// What hulls are wider by around a pixel.
pub(super) fn tolerance(a: &Hull, b: &Hull, pixel: [u32; 2]) -> Extents {
    let (a, b) = (a.contrast(pixel), b.contrast(pixel));
    let contrast: Extents = std::array::from_fn(|k| a[k].min(b[k]));
    let largest = contrast[0].max(contrast[1]).max(contrast[2]);
    std::array::from_fn(|k| {
        let wider = match k {
            3..=5 => BEND[0] * largest,
            6 => BEND[1] * largest,
            _ => OVERSHOOT * contrast[k],
        };
        wider + ROUNDING.min(0.25 * contrast[k].max(largest))
    })
}

/// All displacements within reach, the nearest first.
fn displacements() -> impl Iterator<Item = [i32; 2]> {
    (0..=REACH_SQUARED).flat_map(|squared| {
        let all = (-3..=3).flat_map(|dy: i32| (-3..=3).map(move |dx: i32| [dx, dy]));
        all.filter(move |[dx, dy]| dx * dx + dy * dy == squared)
    })
}

fn interpolated(patch: &Patch, side: i32) -> Vec<Extents> {
    let grid = GRID as usize;
    let pixels: Vec<Extents> = (0..patch.side).flat_map(|y| (0..patch.side).map(move |x| extents(patch.pixel(x, y)))).collect();
    let mix = |a: &Extents, b: &Extents, share: f32| -> Extents { std::array::from_fn(|k| a[k] + share * (b[k] - a[k])) };
    let mut at = Vec::with_capacity((side * side) as usize);
    for y in 0..side as usize {
        let (row, below) = (y / grid, (y / grid + 1).min(patch.side - 1));
        let down = (y % grid) as f32 / grid as f32;
        for x in 0..side as usize {
            let (column, beside) = (x / grid, (x / grid + 1).min(patch.side - 1));
            let right = (x % grid) as f32 / grid as f32;
            let along = |row: usize| mix(&pixels[row * patch.side + column], &pixels[row * patch.side + beside], right);
            at.push(mix(&along(row), &along(below), down));
        }
    }
    at
}

/// The least or largest over the 21 points within the square root of 5 grid steps: rows of 5 in the middle, of 3 above and below.
fn gathered(at: &[Extents], side: i32, pick: impl Fn(f32, f32) -> f32 + Copy) -> Vec<Extents> {
    let both = |a: &Extents, b: &Extents| -> Extents { std::array::from_fn(|k| pick(a[k], b[k])) };
    let index = |x: i32, y: i32| (y.clamp(0, side - 1) * side + x.clamp(0, side - 1)) as usize;
    let places = || (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
    let three: Vec<Extents> =
        places().map(|(x, y)| both(&both(&at[index(x - 1, y)], &at[index(x, y)]), &at[index(x + 1, y)])).collect();
    let five: Vec<Extents> = places().map(|(x, y)| both(&three[index(x - 1, y)], &three[index(x + 1, y)])).collect();
    places()
        .map(|(x, y)| {
            let middle = both(&both(&five[index(x, y - 1)], &five[index(x, y)]), &five[index(x, y + 1)]);
            both(&both(&three[index(x, y - 2)], &three[index(x, y + 2)]), &middle)
        })
        .collect()
}
