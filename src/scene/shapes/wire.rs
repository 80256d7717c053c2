//! Wires: ribbons that always face the camera, so that a wire can be a fixed number of pixels wide.
//!
//! A ribbon is made for one view, in f64. In an orthographic view its width on the screen is exactly what was asked for; in a
//! perspective view it is so at each of its points, and therefore everywhere on the straight pieces between them.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use glam::{DAffine3, DVec2, DVec3};
use serde::Deserialize;

use super::builder::Builder;
use crate::error::Result;
use crate::scene::place::Place;
use crate::scene::values::Numbers;
use crate::scene::{Mesh, Projection, View};

/// Sharper corners are cut off instead of mitred: cosine of the angle between the two pieces' directions.
const SHARPEST: f64 = -0.8;

/// A line through points.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(in crate::scene) struct WireShape {
    /// At least 2.
    points: Vec<Numbers<3>>,
    /// Width on the screen, in pixels.
    width_px: Option<f64>,
    /// Width in space, in metres.
    width_m: Option<f64>,
    /// How far the middle of each span hangs below the straight line, in metres.
    #[serde(default)]
    sag: f64,
    /// Pieces of a hanging span.
    #[serde(default = "default_pieces")]
    segments: u32,
}

fn default_pieces() -> u32 {
    12
}

impl WireShape {
    pub(super) fn wire(&self, at: &Place<'_>) -> Result<Wire> {
        let width = match (self.width_px, self.width_m) {
            (Some(px), None) => Width::Pixels(at.key("width_px").within(px, 1e-3..=1e4)?),
            (None, Some(m)) => Width::Metres(at.key("width_m").positive(m)?),
            _ => return Err(at.error("expected a wire to have either width_px or width_m")),
        };
        let points_place = at.key("points");
        if !(2..=10_000).contains(&self.points.len()) {
            return Err(points_place.error(format!("a wire of {} points; expected 2 to 10000", self.points.len())));
        }
        let points: Vec<DVec3> = self.points.iter().copied().map(DVec3::from).collect();
        if let Some(k) = (1..points.len()).find(|&k| points[k].distance(points[k - 1]) < 1e-6) {
            return Err(points_place.item(k).error("a point of the wire coincides with the one before; expected a length"));
        }
        let sag = at.key("sag").within(self.sag, 0.0..=1e6)?;
        let pieces = at.key("segments").count(self.segments, 1..=256)?;
        Ok(Wire { points: if sag > 0.0 { hang(&points, sag, pieces) } else { points }, width, ribbons: Mutex::default() })
    }
}

/// Each span as a parabola, close enough to a catenary for a wire that sags little.
fn hang(points: &[DVec3], sag: f64, pieces: u32) -> Vec<DVec3> {
    let spans = points.windows(2).flat_map(|span| {
        let (from, to) = (span[0], span[1]);
        (0..pieces).map(move |k| {
            let t = f64::from(k) / f64::from(pieces);
            from.lerp(to, t) - DVec3::Y * (4.0 * sag * t * (1.0 - t))
        })
    });
    spans.chain(points.last().copied()).collect()
}

#[derive(Debug, Clone, Copy)]
enum Width {
    Pixels(f64),
    Metres(f64),
}

/// A wire whose numbers have been checked.
#[derive(Debug)]
pub(in crate::scene) struct Wire {
    points: Vec<DVec3>,
    width: Width,
    /// The latest ribbon of each instance: where nothing moves a frame shares it with the frame before.
    ribbons: Mutex<BTreeMap<u32, (RibbonKey, Arc<Mesh>)>>,
}

/// All that a ribbon depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
struct RibbonKey {
    world_from_object: DAffine3,
    view: View,
    size: [u32; 2],
}

impl Wire {
    /// Triangles of an instance's ribbon at most.
    pub(in crate::scene) fn triangle_limit(&self) -> usize {
        2 * (self.points.len() - 1)
    }

    /// The largest coordinate of its points.
    pub(in crate::scene) fn reach(&self) -> f64 {
        self.points.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max)
    }

    /// The ribbon in world space for this view and picture size; without triangles where it lies behind the camera.
    pub(in crate::scene) fn ribbon(&self, id: u32, world_from_object: &DAffine3, view: &View, size: [u32; 2]) -> Arc<Mesh> {
        let key = RibbonKey { world_from_object: *world_from_object, view: *view, size };
        let mut ribbons = self.ribbons.lock().unwrap_or_else(PoisonError::into_inner);
        match ribbons.get(&id) {
            Some((known, mesh)) if *known == key => mesh.clone(),
            _ => {
                let mesh = Arc::new(Ribbon { key, width: self.width }.mesh(&self.points));
                ribbons.insert(id, (key, mesh.clone()));
                mesh
            }
        }
    }
}

/// A wire being turned towards a view.
struct Ribbon {
    key: RibbonKey,
    width: Width,
}

impl Ribbon {
    fn mesh(&self, points: &[DVec3]) -> Mesh {
        let mut builder = Builder::default();
        let mut length = 0.0;
        let mut run: Vec<(DVec3, f64)> = Vec::new();
        for pair in points.windows(2) {
            let span = [pair[0], pair[1]].map(|p| self.key.world_from_object.transform_point3(p));
            let lengths = [length, length + span[0].distance(span[1])];
            length = lengths[1];
            let Some([from, to]) = self.clip(span.map(|p| self.to_view(p)), lengths) else {
                continue;
            };
            // A piece that was cut off at its beginning starts a new run.
            if run.last() != Some(&from) {
                self.strip(&mut builder, &run);
                run = vec![from];
            }
            run.push(to);
        }
        self.strip(&mut builder, &run);
        builder.finish()
    }

    fn to_view(&self, world: DVec3) -> DVec3 {
        self.key.view.world_from_view.transpose() * (world - self.key.view.position)
    }

    fn to_world(&self, view: DVec3) -> DVec3 {
        self.key.view.world_from_view * view + self.key.view.position
    }

    /// The part of a piece in front of the near plane of a perspective view, each end with its length along the wire.
    fn clip(&self, [from, to]: [DVec3; 2], [from_length, to_length]: [f64; 2]) -> Option<[(DVec3, f64); 2]> {
        let near = match self.key.view.projection {
            Projection::Perspective { near, .. } => near,
            Projection::Orthographic { .. } => return Some([(from, from_length), (to, to_length)]),
        };
        let (from_depth, to_depth) = (-from.z, -to.z);
        if from_depth.max(to_depth) <= near {
            return None;
        }
        let crossing = (near - from_depth) / (to_depth - from_depth);
        let cut = (from.lerp(to, crossing), from_length + (to_length - from_length) * crossing);
        Some([if from_depth < near { cut } else { (from, from_length) }, if to_depth < near { cut } else { (to, to_length) }])
    }

    /// A strip of quads along view-space points, mitred where it bends a little and cut where it bends sharply.
    fn strip(&self, builder: &mut Builder, run: &[(DVec3, f64)]) {
        // What lies along the line of sight has no direction on the screen.
        let mut points = run.to_vec();
        points.dedup_by(|b, a| self.on_screen(a.0).distance(self.on_screen(b.0)) < 1e-12);
        let across: Vec<DVec2> =
            points.windows(2).map(|pair| (self.on_screen(pair[1].0) - self.on_screen(pair[0].0)).normalize().perp()).collect();
        let Some((first, last)) = across.first().zip(across.last()) else {
            return;
        };
        let mut edge = self.edge(builder, points[0], *first, *first);
        for k in 1..points.len() {
            let before = across[k - 1];
            let after = if k < across.len() { across[k] } else { *last };
            let sharp = before.dot(after) < SHARPEST;
            let end = self.edge(builder, points[k], if sharp { before } else { mitre(before, after) }, before);
            builder.quad([edge[0], end[0], end[1], edge[1]]);
            edge = if sharp { self.edge(builder, points[k], after, after) } else { end };
        }
    }

    /// The two corners of a ribbon at one of its points: right and left of its direction.
    fn edge(&self, builder: &mut Builder, (point, length): (DVec3, f64), offset: DVec2, across: DVec2) -> [u32; 2] {
        let half_width = 0.5 * self.width_at(-point.z);
        let to_camera = self.key.view.world_from_view.z_axis;
        let along = self.key.view.world_from_view * -across.perp().extend(0.0);
        [-1.0, 1.0].map(|side| {
            let position = self.to_world(point + (offset * (side * half_width)).extend(0.0));
            builder.vertex(position, to_camera, along, DVec2::new(length, 0.5 + 0.5 * side))
        })
    }

    /// Width in view space at this depth.
    fn width_at(&self, depth: f64) -> f64 {
        let height_px = f64::from(self.key.size[1]);
        match (self.width, self.key.view.projection) {
            (Width::Metres(m), _) => m,
            (Width::Pixels(px), Projection::Orthographic { height, .. }) => px * height / height_px,
            (Width::Pixels(px), Projection::Perspective { fov_y, .. }) => px * 2.0 * depth * (0.5 * fov_y).tan() / height_px,
        }
    }

    /// Where a view-space point is seen, in units that are square but otherwise free.
    fn on_screen(&self, point: DVec3) -> DVec2 {
        match self.key.view.projection {
            Projection::Orthographic { .. } => point.truncate(),
            Projection::Perspective { .. } => point.truncate() / -point.z,
        }
    }
}

/// The offset at a bend whose distance from both pieces' middle lines is 1.
fn mitre(before: DVec2, after: DVec2) -> DVec2 {
    (before + after) / (1.0 + before.dot(after))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wire(points: &[[f64; 3]], width: Width) -> Wire {
        Wire { points: points.iter().copied().map(DVec3::from).collect(), width, ribbons: Mutex::default() }
    }

    fn orthographic() -> View {
        let projection = Projection::Orthographic { height: 9.0, near: 0.0, far: 100.0 };
        View::looking_at(DVec3::new(1e6, 2.0, 10.0), DVec3::new(1e6, 2.0, 0.0), DVec3::Y, projection)
    }

    fn perspective() -> View {
        let projection = Projection::Perspective { fov_y: 1.0, near: 0.1 };
        View::looking_at(DVec3::new(0.0, 1.0, 5.0), DVec3::ZERO, DVec3::Y, projection)
    }

    /// Corners in pixels of a picture of 160 x 90.
    fn pixels(mesh: &Mesh, view: &View) -> Vec<DVec2> {
        let size = DVec2::new(160.0, 90.0);
        let clip = view.clip_from_object(&DAffine3::IDENTITY, size.x / size.y);
        mesh.vertices
            .iter()
            .map(|vertex| {
                let p = clip * vertex.position.extend(1.0);
                (p.truncate().truncate() / p.w * 0.5 + 0.5) * size
            })
            .collect()
    }

    #[test]
    fn in_an_orthographic_view_the_width_in_pixels_is_exact() {
        for width in [0.1, 0.5, 1.0, 2.0] {
            for angle_deg in [0.0_f64, 7.0, 45.0, 90.0, 133.0] {
                let to = DVec2::from_angle(angle_deg.to_radians()) * 3.0;
                let points = [[1e6, 2.0, 0.0], [1e6 + to.x, 2.0 + to.y, 4.0]];
                let view = orthographic();
                let mesh = wire(&points, Width::Pixels(width)).ribbon(1, &DAffine3::IDENTITY, &view, [160, 90]);
                let corners = pixels(&mesh, &view);
                assert!((corners[0].distance(corners[1]) - width).abs() < 1e-6, "{width} px at {angle_deg}");
                assert!((corners[2].distance(corners[3]) - width).abs() < 1e-6);
                assert!((corners[1] - corners[0]).dot(corners[2] - corners[0]).abs() < 1e-5, "a rectangle");
            }
        }
    }

    #[test]
    fn in_a_perspective_view_both_ends_have_the_width_in_pixels() {
        let view = perspective();
        let mesh =
            wire(&[[-1.0, 0.0, 3.0], [2.0, 1.0, -8.0]], Width::Pixels(1.5)).ribbon(1, &DAffine3::IDENTITY, &view, [160, 90]);
        let corners = pixels(&mesh, &view);
        assert!((corners[0].distance(corners[1]) - 1.5).abs() < 1e-9);
        assert!((corners[2].distance(corners[3]) - 1.5).abs() < 1e-9);
    }

    #[test]
    fn ribbons_face_the_camera_and_mitres_keep_the_width() {
        let view = orthographic();
        let points = [[1e6, 0.0, 0.0], [1e6 + 1.0, 1.0, 0.0], [1e6 + 2.0, 0.0, 0.0], [1e6 + 3.0, 0.1, 0.0]];
        let mesh = wire(&points, Width::Metres(0.2)).ribbon(1, &DAffine3::IDENTITY, &view, [160, 90]);
        assert_eq!(mesh.indices.len(), 3 * 6);
        for [a, b, c] in mesh.triangles() {
            assert!((b.position - a.position).cross(c.position - a.position).z > 0.0);
            assert_eq!(a.normal.z, 1.0);
        }
        // Opposite sides of the second piece are 0.2 m apart although its ends are mitred.
        let side = (mesh.vertices[4].position - mesh.vertices[2].position).normalize();
        let gap = (mesh.vertices[3].position - mesh.vertices[2].position).cross(side).length();
        assert!((gap - 0.2).abs() < 1e-9, "{gap}");
    }

    #[test]
    fn a_wire_through_the_camera_is_cut_at_the_near_plane_and_one_behind_it_is_empty() {
        let view = perspective();
        let mesh = wire(&[[0.3, 0.0, 20.0], [0.0, 0.0, -5.0], [9.0, 0.0, 30.0]], Width::Pixels(1.0)).ribbon(
            1,
            &DAffine3::IDENTITY,
            &view,
            [160, 90],
        );
        assert_eq!(mesh.indices.len(), 3 * 4);
        for vertex in &mesh.vertices {
            assert!((view.view_from_world().transform_point3(vertex.position)).z <= -0.1 + 1e-9);
        }
        let behind = wire(&[[0.0, 0.0, 9.0], [1.0, 0.0, 8.0]], Width::Pixels(1.0));
        assert!(behind.ribbon(1, &DAffine3::IDENTITY, &view, [160, 90]).indices.is_empty());
    }

    #[test]
    fn a_ribbon_is_shared_until_something_changes() {
        let (view, wire) = (orthographic(), wire(&[[1e6, 0.0, 0.0], [1e6 + 1.0, 0.0, 0.0]], Width::Pixels(1.0)));
        let first = wire.ribbon(1, &DAffine3::IDENTITY, &view, [160, 90]);
        assert!(Arc::ptr_eq(&first, &wire.ribbon(1, &DAffine3::IDENTITY, &view, [160, 90])));
        assert!(!Arc::ptr_eq(&first, &wire.ribbon(1, &DAffine3::IDENTITY, &view, [320, 180])));
    }

    #[test]
    fn a_hanging_span_sags_by_what_was_asked_for() {
        let points = hang(&[DVec3::ZERO, DVec3::X * 4.0, DVec3::X * 8.0], 0.5, 8);
        assert_eq!(points.len(), 17);
        assert_eq!(points[4], DVec3::new(2.0, -0.5, 0.0));
        assert_eq!(points[8], DVec3::X * 4.0);
    }
}
