//! How densely points are to lie: a raster over the unit square, and the exact inversion of its distribution.

use crate::error::{Error, Result};

/// Relative density of points over the unit square, constant within each cell of a raster; y down. Only ratios count.
#[derive(Debug, Clone, PartialEq)]
pub struct Density {
    width: u32,
    height: u32,
    values: Vec<f64>,
}

impl Density {
    /// A grey picture: `values` in rows from the top, each finite and at least 0.
    ///
    /// # Errors
    /// [`Error::Request`] if the raster is empty, does not have `width * height` values, one of them is negative, infinite or not a
    /// number, or all are 0.
    pub fn new(width: u32, height: u32, values: Vec<f64>) -> Result<Self> {
        let refuse = |what: String| Err(Error::Request(format!("density: {what}")));
        if width == 0 || height == 0 {
            return refuse(format!("a raster of {width}x{height} is empty; give it at least one cell"));
        }
        if values.len() as u64 != u64::from(width) * u64::from(height) {
            return refuse(format!("{} values do not fill {width}x{height} cells", values.len()));
        }
        if let Some(at) = values.iter().position(|v| !v.is_finite() || *v < 0.0) {
            let (x, y) = (at as u64 % u64::from(width), at as u64 / u64::from(width));
            return refuse(format!("the value at column {x}, row {y} is {}; densities are finite and at least 0", values[at]));
        }
        let sum: f64 = values.iter().sum();
        if sum <= 0.0 {
            return refuse("all values are 0, so that points may lie nowhere; let one be above 0".into());
        }
        if !sum.is_finite() {
            return refuse("the values' sum overflows; scale them down".into());
        }
        Ok(Self { width, height, values })
    }

    /// `function` of (x, y) in the unit square, at the middles of `width` x `height` cells.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn from_fn(width: u32, height: u32, function: impl Fn([f64; 2]) -> f64) -> Result<Self> {
        let middle = |i: u32, count: u32| (f64::from(i) + 0.5) / f64::from(count);
        let cells = (0..height).flat_map(|y| (0..width).map(move |x| [middle(x, width), middle(y, height)]));
        Self::new(width, height, cells.map(function).collect())
    }

    /// The value of the cell that `point` of the unit square lies in.
    #[must_use]
    pub fn at(&self, point: [f64; 2]) -> f64 {
        let cell = |x: f64, count: u32| ((x * f64::from(count)) as usize).min(count as usize - 1);
        self.values[cell(point[1], self.height) * self.width as usize + cell(point[0], self.width)]
    }

    /// Columns and rows.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    pub(super) fn mean(&self) -> f64 {
        self.values.iter().sum::<f64>() / self.values.len() as f64
    }
}

/// Carries the unit square onto itself so that areas become shares of a density: the row by the inverse of the marginal cumulative
/// distribution, the place in it by that of the row's conditional one (Pharr, Jakob and Humphreys 2016, section 13.6.7). Exact for
/// a raster, and it keeps neighbours together, so that a set keeps its strata. Two binary searches a point.
#[derive(Debug, Clone)]
pub(super) struct Inversion {
    rows: Cumulative,
    columns: Vec<Cumulative>,
}

impl Inversion {
    pub(super) fn new(density: &Density) -> Self {
        let columns: Vec<_> = density.values.chunks(density.width as usize).map(Cumulative::new).collect();
        let masses: Vec<f64> = columns.iter().map(Cumulative::total).collect();
        Self { rows: Cumulative::new(&masses), columns }
    }

    pub(super) fn place(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let (row, inside) = self.rows.invert(v);
        let (column, across) = self.columns[row].invert(u);
        let share = |cell: usize, inside: f64, count: usize| (cell as f64 + inside) / count as f64;
        [share(column, across, self.columns[row].cells()), share(row, inside, self.rows.cells())]
    }
}

/// Sums of all cells before each, and of all.
#[derive(Debug, Clone)]
struct Cumulative(Vec<f64>);

impl Cumulative {
    fn new(values: &[f64]) -> Self {
        let mut sum = 0.0;
        let ends = values.iter().map(|value| {
            sum += value;
            sum
        });
        Self(std::iter::once(0.0).chain(ends).collect())
    }

    fn cells(&self) -> usize {
        self.0.len() - 1
    }

    fn total(&self) -> f64 {
        self.0[self.cells()]
    }

    /// The cell in which the share `u` of the total is reached, and how far into it. Never a cell of no mass.
    fn invert(&self, u: f64) -> (usize, f64) {
        let goal = u * self.total();
        // A product rounded up to the total would lie behind the last cell that has any mass.
        let heavy = self.0.partition_point(|end| *end < self.total()) - 1;
        let cell = (self.0.partition_point(|end| *end <= goal) - 1).min(heavy);
        (cell, ((goal - self.0[cell]) / (self.0[cell + 1] - self.0[cell])).min(1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn senseless_densities_are_refused() {
        for (width, height, values, word) in [
            (0, 3, vec![], "empty"),
            (2, 1, vec![1.0], "fill"),
            (2, 1, vec![1.0, f64::NAN], "column 1, row 0 is NaN"),
            (1, 2, vec![1.0, f64::INFINITY], "column 0, row 1 is inf"),
            (1, 1, vec![-1.0], "is -1"),
            (2, 1, vec![0.0, 0.0], "all values are 0"),
            (2, 1, vec![f64::MAX, f64::MAX], "overflows"),
        ] {
            let error = Density::new(width, height, values).expect_err(word).to_string();
            assert!(error.contains(word), "{error}");
        }
    }

    #[test]
    fn areas_become_shares_of_the_density() {
        let density = Density::new(3, 2, vec![0.0, 2.0, 0.0, 1.0, 0.0, 5.0]).expect("fine");
        let inversion = Inversion::new(&density);
        let mut shares = [0.0; 6];
        // Rows have 1/4 and 3/4 of the mass, cells 1/6 and 5/6 of theirs: 24 x 24 points divide evenly.
        for i in 0..576 {
            let [x, y] = inversion.place([f64::from(i % 24), f64::from(i / 24)].map(|x| (x + 0.5) / 24.0));
            shares[(y * 2.0) as usize * 3 + (x * 3.0) as usize] += 1.0 / 576.0;
        }
        for (share, value) in shares.iter().zip(&density.values) {
            assert!((share - value / 8.0).abs() < 1e-12, "{shares:?}");
        }
        // The ends too stay where there is mass.
        assert_eq!(inversion.place([0.0, 0.0]), [1.0 / 3.0, 0.0]);
        let [x, y] = inversion.place([1.0 - f64::EPSILON / 2.0; 2]);
        assert!(x > 0.99 && y > 0.99 && x <= 1.0 && y <= 1.0, "{x} {y}");
    }
}
