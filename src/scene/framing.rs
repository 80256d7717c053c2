//! Standing where a thing just fills the picture.

use glam::{DMat3, DVec3};

use super::{Projection, View};

/// Part of the picture that the thing may fill.
const FILL: f64 = 0.94;
/// Directions in which the outermost points are kept. More would follow a round thing's outline more closely.
const DIRECTIONS: u32 = 96;
/// Where a thing is looked at from: three quarters, from above.
const TOWARD_CAMERA: DVec3 = DVec3::new(0.62, 0.42, 1.0);
const FOV_Y_DEG: f64 = 32.0;

/// A thing to be framed, by the points that stand out.
#[derive(Debug, Clone)]
pub(super) struct Framing {
    outermost: Vec<DVec3>,
    radius: f64,
}

impl Framing {
    /// Of all these points; none where there are none.
    pub(super) fn around(points: impl Iterator<Item = DVec3>) -> Option<Self> {
        let directions: Vec<DVec3> = (0..DIRECTIONS).map(direction).collect();
        let mut outermost: Vec<DVec3> = Vec::new();
        let mut distances = vec![f64::NEG_INFINITY; directions.len()];
        for point in points {
            outermost.resize(directions.len(), point);
            for ((direction, distance), known) in directions.iter().zip(&mut distances).zip(&mut outermost) {
                let along = direction.dot(point);
                if along > *distance {
                    (*distance, *known) = (along, point);
                }
            }
        }
        let first = *outermost.first()?;
        let (low, high) = outermost.iter().fold((first, first), |(low, high), p| (low.min(*p), high.max(*p)));
        // A point has no extent; something must give the unit.
        Some(Self { outermost, radius: (0.5 * (high - low).length()).max(1e-6) })
    }

    /// The view for a picture of this size, as near as its borders allow.
    pub(super) fn view(&self, size: [u32; 2]) -> View {
        let fov_y = FOV_Y_DEG.to_radians();
        let tan_y = FILL * (0.5 * fov_y).tan();
        let tan_x = tan_y * f64::from(size[0]) / f64::from(size[1]);
        let projection = Projection::Perspective { fov_y, near: 0.01 * self.radius };
        let mut view = View::looking_at(TOWARD_CAMERA, DVec3::ZERO, DVec3::Y, projection);
        view.position = view.world_from_view * self.viewpoint(&view.world_from_view, tan_x, tan_y);
        view
    }

    /// The nearest point of view, in view space, from which everything lies between the picture's borders.
    ///
    /// Seen from (x, y, d) with z towards the viewer, a point lies left of the right border when its x + tan z is at most
    /// x + tan d, and right of the left border when -x + tan z is at most tan d - x. The outermost points of both sides give two
    /// equations for x and d.
    fn viewpoint(&self, world_from_view: &DMat3, tan_x: f64, tan_y: f64) -> DVec3 {
        let points: Vec<DVec3> = self.outermost.iter().map(|point| world_from_view.transpose() * *point).collect();
        let most = |measure: &dyn Fn(&DVec3) -> f64| points.iter().map(measure).fold(f64::NEG_INFINITY, f64::max);
        let width = most(&|p| p.x + tan_x * p.z) + most(&|p| tan_x * p.z - p.x);
        let height = most(&|p| p.y + tan_y * p.z) + most(&|p| tan_y * p.z - p.y);
        // What points straight at the viewer must not reach through the near plane.
        let nearest = most(&|p| p.z) + 0.1 * self.radius;
        let distance = (0.5 * width / tan_x).max(0.5 * height / tan_y).max(nearest);
        DVec3::new(middle(&points, 0, distance), middle(&points, 1, distance), distance)
    }
}

/// Where along an axis to stand at this distance, so that both borders are equally far on the picture.
fn middle(points: &[DVec3], axis: usize, distance: f64) -> f64 {
    let coordinates = || points.iter().map(|p| p[axis]);
    let (mut low, mut high) = (coordinates().fold(f64::INFINITY, f64::min), coordinates().fold(f64::NEG_INFINITY, f64::max));
    // As many halvings as a fraction of a pixel needs.
    for _ in 0..40 {
        let x = 0.5 * (low + high);
        let seen = || points.iter().map(|p| (p[axis] - x) / (distance - p.z));
        let (left, right) = (seen().fold(0.0, f64::min), seen().fold(0.0, f64::max));
        if left + right > 0.0 { low = x } else { high = x }
    }
    0.5 * (low + high)
}

/// Evenly spread over the sphere: a spiral of equal steps in height, a golden angle apart.
fn direction(k: u32) -> DVec3 {
    let y = 1.0 - (2.0 * f64::from(k) + 1.0) / f64::from(DIRECTIONS);
    let (sin, cos) = (f64::from(k) * 2.399_963_229_728_653).sin_cos();
    let radius = (1.0 - y * y).sqrt();
    DVec3::new(radius * cos, y, radius * sin)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest absolute coordinate on the picture along x and y, where 1 is the border.
    fn extent(points: &[DVec3], size: [u32; 2]) -> [f64; 2] {
        let view = Framing::around(points.iter().copied()).unwrap().view(size);
        let clip = view.clip_from_view(f64::from(size[0]) / f64::from(size[1])) * glam::DMat4::from(view.view_from_world());
        let seen: Vec<DVec3> = points
            .iter()
            .map(|p| {
                let p = clip * p.extend(1.0);
                assert!(p.w > 0.0, "in front of the camera");
                p.truncate() / p.w
            })
            .collect();
        [0, 1].map(|axis| seen.iter().map(|p| p[axis].abs()).fold(0.0, f64::max))
    }

    #[test]
    fn boxes_of_any_shape_nearly_touch_two_borders_of_pictures_of_any_shape() {
        for half in [DVec3::ONE, DVec3::new(10.0, 0.1, 1.0), DVec3::new(0.01, 5.0, 0.01), DVec3::new(1e5, 1.0, 3e5)] {
            let corners: Vec<DVec3> = (0..8)
                .map(|k| {
                    DVec3::new(7.0, -3.0, 2.0)
                        + half * (DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) * 2.0 - 1.0)
                })
                .collect();
            for size in [[640, 360], [360, 640], [100, 100], [16384, 16]] {
                let [x, y] = extent(&corners, size);
                assert!(x.max(y) <= FILL + 1e-6, "{half} at {size:?}: {x} {y}");
                assert!(x.max(y) > FILL - 0.02, "{half} at {size:?}: {x} {y}");
            }
        }
    }

    #[test]
    fn a_round_thing_fits_too() {
        let points: Vec<DVec3> = (0..5000)
            .map(|k| direction(k % DIRECTIONS).lerp(direction((k * 7 + 3) % DIRECTIONS), 0.3).normalize() * 4.0)
            .collect();
        let [x, y] = extent(&points, [640, 360]);
        assert!(x < 1.0 && y < 1.0 && y > 0.9, "{x} {y}");
    }

    #[test]
    fn a_single_point_and_none_at_all_are_no_trouble() {
        assert!(Framing::around(std::iter::empty()).is_none());
        let view = Framing::around(std::iter::once(DVec3::X)).unwrap().view([4, 4]);
        assert!(view.position.is_finite() && view.position.distance(DVec3::X) > 0.0);
    }
}
