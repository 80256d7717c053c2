//! Mass on square pixels, summed along rows, so that a convex cell's mass and centre cost a few operations a row.

use super::Distribution;

/// Sums up to a column: mass, and mass times x.
type Sums = [f64; 2];

/// The unit square in pixels, each with the distribution's density at its centre.
#[derive(Debug)]
pub(super) struct Raster {
    side: i64,
    /// For each row the sums before each column, and those of the whole row.
    sums: Vec<Sums>,
}

impl Raster {
    pub(super) fn new(distribution: &Distribution, side: u32) -> Self {
        let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(side);
        let mut sums = Vec::with_capacity(side as usize * (side as usize + 1));
        for row in 0..side {
            let mut before = [0.0; 2];
            sums.push(before);
            for column in 0..side {
                let mass = distribution.at([middle(column), middle(row)]);
                before = [before[0] + mass, before[1] + mass * middle(column)];
                sums.push(before);
            }
        }
        Self { side: i64::from(side), sums }
    }

    /// Centre of the mass of all pixels whose centres lie in a convex polygon, given by its corners relative to `site`; `None` if
    /// they have none. What lies beyond the square's sides goes on at the opposite ones.
    pub(super) fn centre(&self, site: [f64; 2], corners: &[[f64; 2]], rows: &mut Spans) -> Option<[f64; 2]> {
        rows.scan(corners.iter().map(|c| [c[0] + site[0], c[1] + site[1]]), self.side as f64);
        let (mut mass, mut moment) = (0.0, [0.0; 2]);
        for (row, [left, right]) in (rows.first..).zip(&rows.spans) {
            let (from, to) = (self.before(row, left.ceil() as i64), self.before(row, right.ceil() as i64));
            let weight = to[0] - from[0];
            mass += weight;
            moment = [moment[0] + to[1] - from[1], moment[1] + weight * ((row as f64 + 0.5) / self.side as f64)];
        }
        (mass > 0.0).then(|| moment.map(|m| m / mass))
    }

    /// Sums of a row from column 0 to before `column`, either of which may lie beyond the sides.
    fn before(&self, row: i64, column: i64) -> Sums {
        let row = row.rem_euclid(self.side) * (self.side + 1);
        let at = |column: i64| self.sums[(row + column) as usize];
        if (0..=self.side).contains(&column) {
            return at(column);
        }
        let turns = column.div_euclid(self.side) as f64;
        let ([mass, moment], [whole, whole_moment]) = (at(column.rem_euclid(self.side)), at(self.side));
        let turned = moment + turns * (mass + whole_moment) + whole * turns * (turns - 1.0) / 2.0;
        [mass + turns * whole, turned]
    }
}

/// Where a convex polygon starts and ends in each row of pixels, in columns, pixel centres at whole numbers. Kept for its memory.
#[derive(Debug, Default)]
pub(super) struct Spans {
    first: i64,
    spans: Vec<[f64; 2]>,
}

impl Spans {
    fn scan(&mut self, corners: impl ExactSizeIterator<Item = [f64; 2]> + Clone, side: f64) {
        let in_pixels = corners.map(|c| c.map(|x| x * side - 0.5));
        let [top, bottom] = in_pixels.clone().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], c| [a.min(c[1]), b.max(c[1])]);
        self.first = top.ceil() as i64;
        self.spans.clear();
        self.spans.resize((bottom.ceil() as i64 - self.first) as usize, [f64::INFINITY, f64::NEG_INFINITY]);
        let next = in_pixels.clone().cycle().skip(1);
        for (a, b) in in_pixels.zip(next) {
            let (upper, lower) = if a[1] < b[1] { (a, b) } else { (b, a) };
            for row in upper[1].ceil() as i64..lower[1].ceil() as i64 {
                let x = upper[0] + (row as f64 - upper[1]) / (lower[1] - upper[1]) * (lower[0] - upper[0]);
                let [left, right] = &mut self.spans[(row - self.first) as usize];
                (*left, *right) = (left.min(x), right.max(x));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By looking at every pixel of three turns each way.
    fn slow_centre(side: i64, inside: impl Fn([f64; 2]) -> bool) -> [f64; 2] {
        let middle = |i: i64| (i as f64 + 0.5) / side as f64;
        let pixels = (-side..2 * side).flat_map(|y| (-side..2 * side).map(move |x| [middle(x), middle(y)]));
        let found: Vec<_> = pixels.filter(|p| inside(*p)).collect();
        [0, 1].map(|k| found.iter().map(|p| p[k]).sum::<f64>() / found.len() as f64)
    }

    #[test]
    fn centres_are_those_of_the_pixels_inside() {
        let raster = Raster::new(&Distribution::default(), 64);
        let mut rows = Spans::default();
        // A triangle, also where it lies across sides.
        for site in [[0.4, 0.3], [0.05, 0.9], [0.93, 0.02]] {
            let corners = [[-0.11, -0.07], [0.19, 0.03], [-0.02, 0.16]];
            let inside = |p: [f64; 2]| {
                (0..3).all(|k| {
                    let (a, b) = (corners[k], corners[(k + 1) % 3]);
                    (b[0] - a[0]) * (p[1] - site[1] - a[1]) - (b[1] - a[1]) * (p[0] - site[0] - a[0]) >= 0.0
                })
            };
            let (found, expected) = (raster.centre(site, &corners, &mut rows).expect("has mass"), slow_centre(64, inside));
            assert!((0..2).all(|k| (found[k] - expected[k]).abs() < 1e-12), "{found:?} {expected:?}");
        }
    }
}
