//! A checkered floor in perspective, up to the horizon.

use super::{PixelFunction, SIDE};

/// The row that the horizon is the upper side of.
pub(super) const HORIZON: usize = 16;

/// Of the camera, in pixels.
const FOCAL: f64 = 256.0;

/// A square's side; the camera is 1 above the floor.
const CELL: f64 = 0.25;

type Polygon = Vec<[f64; 2]>;

/// The floor, turned about the camera's foot point. Places of the picture are relative to where the view meets the horizon.
#[derive(Debug, Clone, Copy)]
pub(super) struct Floor {
    /// Along each of the floor's axes, in cells times the distance below the horizon: a coefficient of x and a constant.
    axes: [[f64; 2]; 2],
}

impl Floor {
    pub(super) fn turned(yaw_radians: f64) -> Self {
        let (sin, cos) = yaw_radians.sin_cos();
        Self { axes: [[cos, sin * FOCAL], [-sin, cos * FOCAL]].map(|axis| axis.map(|x| x / CELL)) }
    }

    /// Pixels of the horizon's row and above are the sky, black.
    pub(super) fn with_means(self) -> (Box<dyn PixelFunction>, Vec<f64>) {
        let means = (0..SIDE * SIDE).map(|pixel| if pixel / SIDE <= HORIZON { 0.0 } else { self.white_area(pixel) }).collect();
        (Box::new(self), means)
    }

    /// The place of the floor seen here, in cells along one of its axes.
    fn cells(&self, axis: usize, [x, y]: [f64; 2]) -> f64 {
        let [slope, constant] = self.axes[axis];
        (slope * x + constant) / y
    }

    /// The pixel cut into strips along one axis and those into cells along the other. What is a straight line on the floor is
    /// one in the picture, so all pieces are convex polygons.
    fn white_area(&self, pixel: usize) -> f64 {
        let [left, top] = corner(pixel);
        let outline = vec![[left, top], [left + 1.0, top], [left + 1.0, top + 1.0], [left, top + 1.0]];
        let mut area = 0.0;
        self.cut(0, outline, |column, strip| {
            self.cut(1, strip, |row, cell| {
                if is_white(column, row) {
                    area += area_of(&cell);
                }
            });
        });
        area
    }

    /// Hands over what of a polygon is in each interval between whole numbers along an axis.
    fn cut(&self, axis: usize, polygon: Polygon, mut piece: impl FnMut(f64, Polygon)) {
        if polygon.len() < 3 {
            return;
        }
        let along = polygon.iter().map(|&at| self.cells(axis, at));
        let (first, last) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), k| (a.min(k.floor()), b.max(k.floor())));
        let mut rest = polygon;
        let mut k = first;
        while k < last {
            let [slope, constant] = self.axes[axis];
            let (below, above) = split(&rest, |[x, y]| slope * x + constant - (k + 1.0) * y);
            piece(k, below);
            rest = above;
            k += 1.0;
        }
        piece(last, rest);
    }
}

impl PixelFunction for Floor {
    fn value(&self, pixel: usize, at: [f64; 2]) -> f64 {
        if pixel / SIDE <= HORIZON {
            return 0.0;
        }
        let [left, top] = corner(pixel);
        let place = [left + at[0], top + at[1]];
        f64::from(is_white(self.cells(0, place).floor(), self.cells(1, place).floor()))
    }
}

/// A pixel's upper left corner from where the view meets the horizon.
fn corner(pixel: usize) -> [f64; 2] {
    [(pixel % SIDE) as f64 - (SIDE / 2) as f64, (pixel / SIDE) as f64 - HORIZON as f64]
}

fn is_white(column: f64, row: f64) -> bool {
    (column + row).rem_euclid(2.0) == 1.0
}

/// The parts of a convex polygon where a linear function is negative, and where it is not.
fn split(polygon: &[[f64; 2]], side: impl Fn([f64; 2]) -> f64) -> (Polygon, Polygon) {
    let (mut below, mut above) = (Polygon::with_capacity(polygon.len() + 2), Polygon::with_capacity(polygon.len() + 2));
    for (i, &here) in polygon.iter().enumerate() {
        let next = polygon[(i + 1) % polygon.len()];
        let (a, b) = (side(here), side(next));
        let part = if a < 0.0 { &mut below } else { &mut above };
        part.push(here);
        if (a < 0.0) != (b < 0.0) {
            let share = a / (a - b);
            let crossing = [0, 1].map(|k| here[k] + share * (next[k] - here[k]));
            below.push(crossing);
            above.push(crossing);
        }
    }
    (below, above)
}

/// Half the sum of cross products, about the first corner to keep the digits.
fn area_of(polygon: &[[f64; 2]]) -> f64 {
    let Some((first, rest)) = polygon.split_first() else { return 0.0 };
    let from_first = |p: &[f64; 2]| [p[0] - first[0], p[1] - first[1]];
    let cross = |pair: &[[f64; 2]]| {
        let (a, b) = (from_first(&pair[0]), from_first(&pair[1]));
        a[0] * b[1] - a[1] * b[0]
    };
    0.5 * rest.windows(2).map(cross).sum::<f64>().abs()
}
