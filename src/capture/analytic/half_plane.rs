//! A straight edge, exactly.

use glam::DVec2;

use super::polygon::{clipped, signed_area};

/// Share of the pixel with this top left corner that lies where `normal . point` is at least `distance`.
#[must_use]
pub fn half_plane_share(corner: DVec2, normal: DVec2, distance: f64) -> f64 {
    let pixel = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|c| corner + c);
    signed_area(&clipped(&pixel, |p| normal.dot(p) - distance)).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_that_need_no_calculation() {
        let share = |normal, distance| half_plane_share(DVec2::new(3.0, 7.0), normal, distance);
        assert_eq!(share(DVec2::X, 3.25), 0.75);
        assert_eq!(share(-DVec2::Y, -7.25), 0.25);
        assert_eq!(share(DVec2::ONE, 11.0), 0.5);
        assert_eq!(share(DVec2::ONE, 10.5), 0.875);
        assert_eq!((share(DVec2::X, 2.0), share(DVec2::X, 4.0)), (1.0, 0.0));
    }

    #[test]
    fn shares_are_those_of_many_samples() {
        const SIDE: u32 = 400;
        for (degrees, distance) in [(0.0_f64, 0.3), (7.0, 0.1), (33.0, 0.9), (45.0, 0.707), (81.0, 0.5), (163.0, -0.4)] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let normal = DVec2::new(cos, sin);
            let at = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE);
            let inside = (0..SIDE * SIDE).filter(|i| normal.dot(DVec2::new(at(i % SIDE), at(i / SIDE))) >= distance).count();
            let sampled = inside as f64 / f64::from(SIDE * SIDE);
            let exact = half_plane_share(DVec2::ZERO, normal, distance);
            // A sample may fall to either side along the whole edge.
            assert!((exact - sampled).abs() < 1.5 / f64::from(SIDE), "{degrees} degrees: {exact}, sampled {sampled}");
        }
    }
}
