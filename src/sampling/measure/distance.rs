//! Distances between neighbours.

/// What lies beyond the sides of the square.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Surroundings {
    /// Nothing.
    Open,
    /// The square again: left of it its right part, above it its lower one.
    Torus,
}

/// How far points are from their nearest neighbours, in sides of the square.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// Of the closest two.
    pub smallest: f64,
    /// Over all points.
    pub mean: f64,
}

/// Distances to the nearest neighbours, none for fewer than two points. O(n^2).
///
/// On the torus no set of n points has all its neighbours further away than `sqrt(2 / (sqrt(3) n))`, as a hexagonal grid has.
#[must_use]
pub fn nearest(points: &[[f64; 2]], surroundings: Surroundings) -> Option<Nearest> {
    if points.len() < 2 {
        return None;
    }
    let along = |a: f64, b: f64| {
        let apart = (a - b).abs();
        if surroundings == Surroundings::Torus { apart.min(1.0 - apart) } else { apart }
    };
    let mut squared = vec![f64::INFINITY; points.len()];
    for (i, a) in points.iter().enumerate() {
        for (j, b) in points[..i].iter().enumerate() {
            let (x, y) = (along(a[0], b[0]), along(a[1], b[1]));
            let distance = x * x + y * y;
            squared[i] = squared[i].min(distance);
            squared[j] = squared[j].min(distance);
        }
    }
    let distances = squared.iter().map(|d| d.sqrt());
    let smallest = distances.clone().fold(f64::INFINITY, f64::min);
    Some(Nearest { smallest, mean: distances.sum::<f64>() / points.len() as f64 })
}
