//! One Voronoi cell: a convex polygon, cut by the bisectors to its neighbours.

use std::ops::ControlFlow;

use super::grid::Grid;

/// Corners of a convex polygon in turn, relative to its site. Kept from cell to cell for its memory.
#[derive(Debug, Default)]
pub(super) struct Cell {
    corners: Vec<[f64; 2]>,
    cut: Vec<[f64; 2]>,
    /// Squared distance of the farthest corner.
    reach: f64,
}

impl Cell {
    /// Becomes the cell of `site` among all points of the grid. Neighbours are asked for ring by ring, until those to come are
    /// farther off than twice the farthest corner: their bisectors pass the cell by.
    pub(super) fn fit(&mut self, site: [f64; 2], grid: &Grid, torus: bool) {
        // On a torus a site is its own neighbour, one turn on.
        let [low, high] = if torus { [[-0.5; 2], [0.5; 2]] } else { [site.map(|x| -x), site.map(|x| 1.0 - x)] };
        self.corners.clear();
        self.corners.extend([low, [high[0], low[1]], high, [low[0], high[1]]]);
        self.measure();
        for ring in 0..=grid.last_ring() {
            let nearest = grid.reach(site, ring);
            if nearest * nearest >= 4.0 * self.reach {
                break;
            }
            // Nothing stops it.
            let _ = grid.visit_ring(site, ring, |_, way| {
                self.clip(way);
                ControlFlow::Continue(())
            });
        }
    }

    /// Leaves what is nearer to the site than to the point `way` from it.
    fn clip(&mut self, way: [f64; 2]) {
        let half = 0.5 * (way[0] * way[0] + way[1] * way[1]);
        // The bisector is at half the way, beyond the farthest corner; or the point is the site itself.
        if half >= 2.0 * self.reach || half == 0.0 {
            return;
        }
        let beyond = |corner: &[f64; 2]| corner[0] * way[0] + corner[1] * way[1] - half;
        self.cut.clear();
        for (k, corner) in self.corners.iter().enumerate() {
            let next = &self.corners[(k + 1) % self.corners.len()];
            let (here, there) = (beyond(corner), beyond(next));
            if here <= 0.0 {
                self.cut.push(*corner);
            }
            if (here < 0.0 && there > 0.0) || (here > 0.0 && there < 0.0) {
                let t = here / (here - there);
                self.cut.push([corner[0] + t * (next[0] - corner[0]), corner[1] + t * (next[1] - corner[1])]);
            }
        }
        std::mem::swap(&mut self.corners, &mut self.cut);
        self.measure();
    }

    fn measure(&mut self) {
        self.reach = self.corners.iter().map(|c| c[0] * c[0] + c[1] * c[1]).fold(0.0, f64::max);
    }

    pub(super) fn corners(&self) -> &[[f64; 2]] {
        &self.corners
    }

    /// Area and centre of area, the latter relative to the site; `None` for a cell of no area.
    pub(super) fn centre(&self) -> Option<[f64; 2]> {
        let (mut doubled, mut moment) = (0.0, [0.0; 2]);
        for (k, a) in self.corners.iter().enumerate() {
            let b = &self.corners[(k + 1) % self.corners.len()];
            let cross = a[0] * b[1] - b[0] * a[1];
            doubled += cross;
            moment = [moment[0] + cross * (a[0] + b[0]), moment[1] + cross * (a[1] + b[1])];
        }
        (doubled > 0.0).then(|| moment.map(|m| m / (3.0 * doubled)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::stream::Stream;

    fn area(cell: &Cell) -> f64 {
        let corners = cell.corners();
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(a, b)| 0.5 * (a[0] * b[1] - b[0] * a[1])).sum()
    }

    #[test]
    fn cells_share_the_square_out() {
        for torus in [false, true] {
            for count in [1, 2, 3, 5, 40, 700] {
                let mut chance = Stream::new(count, 0);
                let sites: Vec<_> = (0..count).map(|_| chance.point()).collect();
                let (grid, mut cell) = (Grid::of(&sites, torus), Cell::default());
                let areas = sites.iter().map(|site| {
                    cell.fit(*site, &grid, torus);
                    area(&cell)
                });
                assert!((areas.sum::<f64>() - 1.0).abs() < 1e-12, "{count} {torus}");
            }
        }
    }

    #[test]
    fn a_cell_of_a_lattice_is_its_square() {
        let sites: Vec<_> = (0..16).map(|i| [f64::from(i % 4), f64::from(i / 4)].map(|x| (x + 0.3) / 4.0)).collect();
        let (grid, mut cell) = (Grid::of(&sites, true), Cell::default());
        for site in &sites {
            cell.fit(*site, &grid, true);
            assert!((area(&cell) - 1.0 / 16.0).abs() < 1e-15);
            assert!(cell.centre().expect("has an area").iter().all(|x| x.abs() < 1e-15));
        }
    }
}
