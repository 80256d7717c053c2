//! Convex polygons in the plane.

use glam::DVec2;

/// Corners in order, either way round; fewer than three enclose nothing.
pub(super) type Polygon = Vec<DVec2>;

/// The part of a convex polygon where `inside` is not negative; `inside` must be linear (Sutherland and Hodgman 1974).
pub(super) fn clipped(polygon: &[DVec2], inside: impl Fn(DVec2) -> f64) -> Polygon {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, &current) in polygon.iter().enumerate() {
        let previous = polygon[(i + polygon.len() - 1) % polygon.len()];
        let (a, b) = (inside(previous), inside(current));
        if (a < 0.0) != (b < 0.0) {
            kept.push(previous + (current - previous) * (a / (a - b)));
        }
        if b >= 0.0 {
            kept.push(current);
        }
    }
    kept
}

/// The part within `low <= axis <= low + 1`.
pub(super) fn unit_slab(polygon: &[DVec2], axis: usize, low: f64) -> Polygon {
    clipped(&clipped(polygon, |p| p[axis] - low), |p| low + 1.0 - p[axis])
}

/// Signed area by the shoelace formula, about the first corner to keep digits far from the origin. Positive clockwise on a
/// screen whose y points down.
pub(super) fn signed_area(polygon: &[DVec2]) -> f64 {
    let Some(&origin) = polygon.first() else {
        return 0.0;
    };
    0.5 * polygon.windows(2).map(|w| (w[0] - origin).perp_dot(w[1] - origin)).sum::<f64>()
}

/// Area that two convex polygons share.
pub(super) fn shared_area(a: &[DVec2], b: &[DVec2]) -> f64 {
    let turn = signed_area(b).signum();
    let mut common = a.to_vec();
    for (i, &corner) in b.iter().enumerate() {
        let along = b[(i + 1) % b.len()] - corner;
        common = clipped(&common, |p| turn * along.perp_dot(p - corner));
    }
    signed_area(&common).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, side: f64) -> Polygon {
        [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)].map(|(u, v)| DVec2::new(x + u, y + v)).to_vec()
    }

    #[test]
    fn slabs_add_up_to_the_whole() {
        let triangle = vec![DVec2::new(0.3, 0.2), DVec2::new(7.9, 3.1), DVec2::new(2.2, 6.7)];
        let whole = signed_area(&triangle);
        let parts: f64 = (0..8)
            .flat_map(|y| (0..8).map(move |x| (x, y)))
            .map(|(x, y)| signed_area(&unit_slab(&unit_slab(&triangle, 1, f64::from(y)), 0, f64::from(x))))
            .sum();
        assert!((whole - parts).abs() < 1e-12 && whole > 0.0);
    }

    #[test]
    fn shared_areas() {
        assert!((shared_area(&square(0.0, 0.0, 2.0), &square(1.0, 1.0, 2.0)) - 1.0).abs() < 1e-12);
        assert_eq!(shared_area(&square(0.0, 0.0, 1.0), &square(1.0, 0.0, 1.0)), 0.0);
        let mut reversed = square(0.5, 0.5, 1.0);
        reversed.reverse();
        assert!((shared_area(&square(0.0, 0.0, 1.0), &reversed) - 0.25).abs() < 1e-12);
    }

    #[test]
    fn what_lies_outside_vanishes() {
        assert!(clipped(&square(0.0, 0.0, 1.0), |p| p.x - 5.0).is_empty());
        assert_eq!(signed_area(&[]), 0.0);
    }
}
