//! Flat shapes: in the plane z = 0 facing +z unless said otherwise, uv in metres from the centre, u along x and v along y.

use glam::{DVec2, DVec3};
use serde::Deserialize;

use super::builder::{Builder, circle};
use crate::error::Result;
use crate::scene::Mesh;
use crate::scene::place::Place;
use crate::scene::values::Numbers;

/// How a quad's uv coordinates run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(in crate::scene) enum UvUnit {
    /// Metres from the centre.
    #[default]
    Metres,
    /// From 0 at the lower left corner to 1 at the upper right one.
    Unit,
}

/// A rectangle.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(in crate::scene) struct Quad {
    /// Width and height.
    size: Numbers<2>,
    #[serde(default)]
    uv: UvUnit,
}

impl Quad {
    pub(super) fn mesh(&self, at: &Place<'_>) -> Result<Mesh> {
        let [width, height] = at.key("size").all_positive(self.size.0)?;
        let mut builder = Builder::default();
        builder.rectangle(DVec3::ZERO, DVec3::X * (0.5 * width), DVec3::Y * (0.5 * height));
        let mut mesh = builder.finish();
        if self.uv == UvUnit::Unit {
            let size = DVec2::new(width, height);
            for vertex in &mut mesh.vertices {
                vertex.uv = (vertex.position.truncate() / size + 0.5).as_vec2();
            }
        }
        Ok(mesh)
    }
}

/// A level rectangle in the plane y = 0 facing up; u runs along +x, v along -z.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(in crate::scene) struct Ground {
    /// Along x and along z.
    size: Numbers<2>,
}

impl Ground {
    pub(super) fn mesh(&self, at: &Place<'_>) -> Result<Mesh> {
        let [width, depth] = at.key("size").all_positive(self.size.0)?;
        let mut builder = Builder::default();
        builder.rectangle(DVec3::ZERO, DVec3::X * (0.5 * width), DVec3::NEG_Z * (0.5 * depth));
        Ok(builder.finish())
    }
}

/// A disk, or a ring where it has a hole.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(in crate::scene) struct Disk {
    radius: f64,
    /// Radius of the hole.
    inner_radius: Option<f64>,
    #[serde(default = "super::default_segments")]
    segments: u32,
}

impl Disk {
    pub(super) fn mesh(&self, at: &Place<'_>) -> Result<Mesh> {
        let radius = at.key("radius").positive(self.radius)?;
        let segments = at.key("segments").count(self.segments, super::SEGMENTS)?;
        let rim = |radius: f64, k: u32| radius * circle(f64::from(k) / f64::from(segments));
        let mut builder = Builder::default();
        let Some(inner) = self.inner_radius else {
            let rim: Vec<DVec2> = (0..segments).map(|k| rim(radius, k)).collect();
            builder.polygon(&rim, 0.0, 1.0);
            return Ok(builder.finish());
        };
        let inner = at.key("inner_radius").within(inner, 1e-6..=radius * (1.0 - 1e-6))?;
        for k in 0..segments {
            let corners = [rim(inner, k), rim(radius, k), rim(radius, k + 1), rim(inner, k + 1)];
            builder.polygon(&corners, 0.0, 1.0);
        }
        Ok(builder.finish())
    }
}

/// A convex polygon; its points may run either way around.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(in crate::scene) struct Polygon {
    /// At least 3, in order.
    points: Vec<Numbers<2>>,
}

impl Polygon {
    pub(super) fn mesh(&self, at: &Place<'_>) -> Result<Mesh> {
        let points = convex(&self.points, &at.key("points"))?;
        let mut builder = Builder::default();
        builder.polygon(&points, 0.0, 1.0);
        Ok(builder.finish())
    }
}

/// The points counter-clockwise, or what keeps them from being a convex polygon.
pub(super) fn convex(points: &[Numbers<2>], at: &Place<'_>) -> Result<Vec<DVec2>> {
    let mut points: Vec<DVec2> = points.iter().map(|point| point.0.into()).collect();
    if !(3..=1024).contains(&points.len()) {
        return Err(at.error(format!("a polygon of {} points; expected 3 to 1024", points.len())));
    }
    if let Some(k) = (0..points.len()).find(|&k| points[k].distance(points[(k + 1) % points.len()]) < 1e-6) {
        return Err(at.item((k + 1) % points.len()).error("two points of the polygon coincide; expected an area"));
    }
    let twice_area: f64 = (0..points.len()).map(|k| points[k].perp_dot(points[(k + 1) % points.len()])).sum();
    if twice_area < 0.0 {
        points.reverse();
    }
    let edge = |k: usize| points[(k + 1) % points.len()] - points[k % points.len()];
    let mut turned = 0.0;
    for k in 0..points.len() {
        let (this, next) = (edge(k), edge(k + 1));
        let turn = this.angle_to(next);
        if turn < -1e-9 {
            return Err(at.error("the polygon is not convex; expected corners that all turn the same way"));
        }
        turned += turn;
    }
    if twice_area.abs() < 1e-12 || (turned - std::f64::consts::TAU).abs() > 1e-6 {
        return Err(at.error("the polygon has no area or crosses itself; expected a convex one"));
    }
    Ok(points)
}

/// A star of thin triangles that do not overlap: each has its tip on the inner circle and its base between two points of the outer.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(in crate::scene) struct Wedges {
    /// Evenly spread over the full turn.
    count: u32,
    inner_radius: f64,
    outer_radius: f64,
    /// Angle between a base's ends, seen from the centre.
    width_deg: f64,
    /// Where the first one points, counter-clockwise from +x.
    #[serde(default)]
    start_deg: f64,
}

impl Wedges {
    pub(super) fn mesh(&self, at: &Place<'_>) -> Result<Mesh> {
        let count = at.key("count").count(self.count, 1..=4096)?;
        let outer = at.key("outer_radius").positive(self.outer_radius)?;
        let inner = at.key("inner_radius").within(self.inner_radius, 0.0..=outer * 0.999)?;
        let pitch_deg = 360.0 / f64::from(count);
        let width = at.key("width_deg").within(self.width_deg, 1e-3..=pitch_deg.min(120.0))? / 360.0;
        let mut builder = Builder::default();
        for k in 0..count {
            let turns = (self.start_deg + f64::from(k) * pitch_deg) / 360.0;
            let corners = [inner * circle(turns), outer * circle(turns - 0.5 * width), outer * circle(turns + 0.5 * width)];
            builder.polygon(&corners, 0.0, 1.0);
        }
        Ok(builder.finish())
    }
}
