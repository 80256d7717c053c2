//! Points in buckets, for searches near a place: a few points are looked at whatever their number.

use std::ops::ControlFlow;

/// Ends a list.
const NONE: u32 = u32::MAX;

/// Points of the unit square in square cells, about one to a cell; on a torus, opposite sides touch.
#[derive(Debug, Clone)]
pub(super) struct Grid {
    torus: bool,
    /// Cells along a side.
    side: i32,
    points: Vec<[f64; 2]>,
    /// The latest point of each cell, and of each point the one before it in its cell.
    latest: Vec<u32>,
    before: Vec<u32>,
}

impl Grid {
    pub(super) fn new(torus: bool) -> Self {
        Self { torus, side: 1, points: Vec::new(), latest: vec![NONE], before: Vec::new() }
    }

    pub(super) fn of(points: &[[f64; 2]], torus: bool) -> Self {
        let mut grid = Self::new(torus);
        grid.points.extend_from_slice(points);
        grid.spread();
        grid
    }

    pub(super) fn len(&self) -> usize {
        self.points.len()
    }

    pub(super) fn into_points(self) -> Vec<[f64; 2]> {
        self.points
    }

    pub(super) fn insert(&mut self, point: [f64; 2]) {
        self.points.push(point);
        // Between half a point and two to a cell.
        if self.points.len() > 2 * self.latest.len() {
            self.spread();
        } else {
            self.link(self.points.len() - 1);
        }
    }

    /// Deals all points into cells anew, as many as suit their number.
    fn spread(&mut self) {
        self.side = (2.0 * self.points.len() as f64).sqrt().ceil() as i32;
        self.latest = vec![NONE; (self.side * self.side) as usize];
        self.before.clear();
        for index in 0..self.points.len() {
            self.link(index);
        }
    }

    fn link(&mut self, index: usize) {
        let [x, y] = self.cell_of(self.points[index]);
        let latest = &mut self.latest[(y * self.side + x) as usize];
        self.before.push(*latest);
        *latest = index as u32;
    }

    fn cell_of(&self, point: [f64; 2]) -> [i32; 2] {
        point.map(|x| ((x * f64::from(self.side)) as i32).min(self.side - 1))
    }

    /// Squared distance to the nearest point if it is more than `least`, else `None`; `most` if none is nearer than that.
    pub(super) fn nearest_beyond(&self, from: [f64; 2], least: f64, most: f64) -> Option<f64> {
        let mut nearest = most;
        for ring in 0..=self.side {
            let reach = self.reach(from, ring);
            if reach * reach >= nearest {
                break;
            }
            let found = self.visit_ring(from, ring, |_, [dx, dy]| {
                let distance = dx * dx + dy * dy;
                nearest = nearest.min(distance);
                if distance > least { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            });
            if found.is_break() {
                return None;
            }
        }
        Some(nearest)
    }

    /// No point of this ring of cells about that of `from` is nearer than this.
    pub(super) fn reach(&self, from: [f64; 2], ring: i32) -> f64 {
        if ring == 0 {
            return 0.0;
        }
        let side = f64::from(self.side);
        let inside = from.map(|x| (x * side).fract()).map(|x| x.min(1.0 - x));
        // Less a hair, for what rounding may have put into the next cell.
        ((f64::from(ring - 1) + inside[0].min(inside[1])) / side - 1e-12).max(0.0)
    }

    /// The last ring that holds points within `distance` of its middle; `None` if rings up to it go round, so that looking at all
    /// points is simpler.
    pub(super) fn rings_within(&self, distance: f64) -> Option<i32> {
        let rings = (distance * f64::from(self.side)).floor() + 1.0;
        (2.0 * rings + 1.0 <= f64::from(self.side)).then_some(rings as i32)
    }

    /// Rings beyond this are empty, except on a torus, which goes on for ever.
    pub(super) fn last_ring(&self) -> i32 {
        if self.torus { i32::MAX } else { self.side }
    }

    /// Shows every point of the square ring of cells at this distance about the cell of `from`: its index and its way from `from`.
    /// On a torus points are shown again as often as the ring goes round.
    pub(super) fn visit_ring(
        &self,
        from: [f64; 2],
        ring: i32,
        mut show: impl FnMut(usize, [f64; 2]) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let [x, y] = self.cell_of(from);
        for dy in -ring..=ring {
            let step = if dy.abs() == ring { 1 } else { 2 * ring };
            for dx in (-ring..=ring).step_by(step.max(1) as usize) {
                self.visit_cell([x + dx, y + dy], from, &mut show)?;
            }
        }
        ControlFlow::Continue(())
    }

    fn visit_cell(
        &self,
        cell: [i32; 2],
        from: [f64; 2],
        show: &mut impl FnMut(usize, [f64; 2]) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let inside = cell.iter().all(|c| (0..self.side).contains(c));
        if !inside && !self.torus {
            return ControlFlow::Continue(());
        }
        let ([x, y], turns) = if inside {
            (cell, [0.0; 2])
        } else {
            (cell.map(|c| c.rem_euclid(self.side)), cell.map(|c| f64::from(c.div_euclid(self.side))))
        };
        let mut index = self.latest[(y * self.side + x) as usize];
        while index != NONE {
            let point = self.points[index as usize];
            show(index as usize, [point[0] + turns[0] - from[0], point[1] + turns[1] - from[1]])?;
            index = self.before[index as usize];
        }
        ControlFlow::Continue(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::stream::Stream;

    #[test]
    fn searches_find_what_looking_at_every_point_finds() {
        for (torus, count) in [(false, 1), (true, 1), (false, 2), (true, 3), (false, 300), (true, 300)] {
            let mut chance = Stream::new(count, 0);
            let mut grid = Grid::new(torus);
            let points: Vec<_> = (0..count).map(|_| chance.point()).collect();
            points.iter().for_each(|p| grid.insert(*p));
            assert_eq!(grid.len(), points.len());
            for _ in 0..200 {
                let from = chance.point();
                let along = |a: f64, b: f64| if torus { (a - b).abs().min(1.0 - (a - b).abs()) } else { a - b };
                let distance = |p: &[f64; 2]| (0..2).map(|k| along(p[k], from[k]).powi(2)).sum::<f64>();
                let expected = points.iter().map(distance).fold(f64::INFINITY, f64::min);
                let found = grid.nearest_beyond(from, 0.0, f64::INFINITY).expect("not on a point");
                assert!((found - expected).abs() < 1e-15, "{count}: {found} {expected}");
                assert_eq!(grid.nearest_beyond(from, expected * 1.01, f64::INFINITY), None);
                assert_eq!(grid.nearest_beyond(from, 0.0, expected * 0.5), Some(expected * 0.5));
            }
        }
    }
}
