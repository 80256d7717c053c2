//! Solid shapes around the origin. Their uv coordinates are in metres along the surface unless said otherwise.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use serde::Deserialize;

use super::builder::{Builder, circle, corner};
use super::flat::convex;
use super::{SEGMENTS, default_segments};
use crate::error::Result;
use crate::scene::Mesh;
use crate::scene::place::Place;
use crate::scene::values::Numbers;

/// A box; uv in metres from the centre of each face.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(in crate::scene) struct Cuboid {
    /// Along x, y and z.
    size: Numbers<3>,
}

impl Cuboid {
    pub(super) fn mesh(&self, at: &Place<'_>) -> Result<Mesh> {
        let half = 0.5 * DVec3::from(at.key("size").all_positive(self.size.0)?);
        let [x, y, z] = [DVec3::X * half.x, DVec3::Y * half.y, DVec3::Z * half.z];
        let mut builder = Builder::default();
        // Outward direction, then what is right and up seen from there.
        for (out, right, up) in [(z, x, y), (-z, -x, y), (x, -z, y), (-x, z, y), (y, x, -z), (-y, x, z)] {
            builder.rectangle(out, right, up);
        }
        Ok(builder.finish())
    }
}

/// A sphere; u in metres along the equator, v along the meridian.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(in crate::scene) struct Sphere {
    radius: f64,
    /// Around the equator; half as many from pole to pole.
    #[serde(default = "default_segments")]
    segments: u32,
}

impl Sphere {
    pub(super) fn mesh(&self, at: &Place<'_>) -> Result<Mesh> {
        let radius = at.key("radius").positive(self.radius)?;
        let segments = at.key("segments").count(self.segments, SEGMENTS)?;
        let mut builder = Builder::default();
        builder.grid(segments, (segments / 2).max(2), |u, v| {
            let (around, up) = (circle(u), circle(0.5 * v - 0.25));
            let normal = DVec3::new(up.x * around.y, up.y, up.x * around.x);
            let tangent = DVec3::new(around.x, 0.0, -around.y);
            corner(radius * normal, normal, tangent, radius * DVec2::new(TAU * u, PI * (v - 0.5)))
        });
        Ok(builder.finish())
    }
}

/// The upper half of a sphere seen from inside, for a sky; u runs from 0 to 1 around, v from 0 at the horizon to 1 at the zenith.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(in crate::scene) struct Dome {
    radius: f64,
    #[serde(default = "default_segments")]
    segments: u32,
}

impl Dome {
    pub(super) fn mesh(&self, at: &Place<'_>) -> Result<Mesh> {
        let radius = at.key("radius").positive(self.radius)?;
        let segments = at.key("segments").count(self.segments, SEGMENTS)?;
        let mut builder = Builder::default();
        builder.grid(segments, (segments / 4).max(2), |u, v| {
            let (around, up) = (circle(-u), circle(0.25 * v));
            let outward = DVec3::new(up.x * around.y, up.y, up.x * around.x);
            let tangent = DVec3::new(-around.x, 0.0, around.y);
            corner(radius * outward, -outward, tangent, DVec2::new(u, v))
        });
        Ok(builder.finish())
    }
}

/// A cylinder or a cone along y, with caps.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(in crate::scene) struct Cylinder {
    /// At the bottom, and at the top unless that has its own.
    radius: f64,
    /// 0 makes a cone.
    top_radius: Option<f64>,
    height: f64,
    #[serde(default = "default_segments")]
    segments: u32,
}

impl Cylinder {
    pub(super) fn mesh(&self, at: &Place<'_>) -> Result<Mesh> {
        let bottom = at.key("radius").positive(self.radius)?;
        let top = at.key("top_radius").within(self.top_radius.unwrap_or(bottom), 0.0..=1e9)?;
        let height = at.key("height").positive(self.height)?;
        let segments = at.key("segments").count(self.segments, SEGMENTS)?;
        let mut builder = Builder::default();
        frustum(&mut builder, [bottom, top], height, segments);
        Ok(builder.finish())
    }
}

/// Side and caps of a cut cone along y, centred.
pub(super) fn frustum(builder: &mut Builder, [bottom, top]: [f64; 2], height: f64, segments: u32) {
    let slant = DVec2::new(bottom - top, height).length();
    builder.grid(segments, 1, |u, v| {
        let around = circle(u);
        let radius = bottom + (top - bottom) * v;
        let normal = DVec3::new(around.y * height, bottom - top, around.x * height) / slant;
        let position = DVec3::new(around.y * radius, (v - 0.5) * height, around.x * radius);
        let uv = DVec2::new(TAU * bottom.max(top) * u, slant * (v - 0.5));
        corner(position, normal, DVec3::new(around.x, 0.0, -around.y), uv)
    });
    for (radius, up) in [(bottom, -1.0), (top, 1.0)] {
        if radius > 0.0 {
            cap(builder, radius, 0.5 * height * up, up, segments);
        }
    }
}

/// A level disk at the height `y` facing up (+1) or down (-1).
fn cap(builder: &mut Builder, radius: f64, y: f64, up: f64, segments: u32) {
    let rim: Vec<u32> = (0..segments)
        .map(|k| {
            let p = radius * circle(f64::from(k) * up / f64::from(segments));
            builder.vertex(DVec3::new(p.y, y, p.x), DVec3::Y * up, DVec3::X, DVec2::new(p.y, -p.x * up))
        })
        .collect();
    for pair in rim.windows(2).skip(1) {
        builder.triangle([rim[0], pair[0], pair[1]]);
    }
}

/// A ring with a round section around z, in the plane z = 0; u in metres around, v in metres along the section.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(in crate::scene) struct Torus {
    /// To the middle of the tube.
    radius: f64,
    /// The tube's own radius.
    tube_radius: f64,
    /// Counter-clockwise from +x; less than 360 leaves the tube's ends open.
    #[serde(default = "full_turn")]
    arc_deg: f64,
    #[serde(default = "default_segments")]
    segments: u32,
    /// Around the tube.
    #[serde(default = "default_sides")]
    sides: u32,
}

fn full_turn() -> f64 {
    360.0
}

fn default_sides() -> u32 {
    12
}

impl Torus {
    pub(super) fn mesh(&self, at: &Place<'_>) -> Result<Mesh> {
        let radius = at.key("radius").positive(self.radius)?;
        let tube = at.key("tube_radius").within(self.tube_radius, 1e-6..=radius)?;
        let arc = at.key("arc_deg").within(self.arc_deg, 1e-3..=360.0)? / 360.0;
        let segments = at.key("segments").count(self.segments, SEGMENTS)?;
        let sides = at.key("sides").count(self.sides, SEGMENTS)?;
        let mut builder = Builder::default();
        torus(&mut builder, [radius, tube], arc, [segments, sides]);
        Ok(builder.finish())
    }
}

/// A tube of radius `tube` along `arc` turns of a circle around z.
pub(super) fn torus(builder: &mut Builder, [radius, tube]: [f64; 2], arc: f64, [segments, sides]: [u32; 2]) {
    builder.grid(segments, sides, |u, v| {
        let (around, section) = (circle(u * arc), circle(v));
        let normal = (around * section.x).extend(section.y);
        let position = (around * radius).extend(0.0) + tube * normal;
        corner(position, normal, around.perp().extend(0.0), TAU * DVec2::new(radius * arc * u, tube * v))
    });
}

/// A convex polygon in xy given a thickness along z; uv of its ends in metres as (x, y), of its sides from the middle of each.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(in crate::scene) struct Prism {
    points: Vec<Numbers<2>>,
    depth: f64,
}

impl Prism {
    pub(super) fn mesh(&self, at: &Place<'_>) -> Result<Mesh> {
        let points = convex(&self.points, &at.key("points"))?;
        let half_depth = 0.5 * at.key("depth").positive(self.depth)?;
        let mut builder = Builder::default();
        builder.polygon(&points, half_depth, 1.0);
        builder.polygon(&points, -half_depth, -1.0);
        for k in 0..points.len() {
            let (from, to) = (points[k], points[(k + 1) % points.len()]);
            builder.rectangle((0.5 * (from + to)).extend(0.0), (0.5 * (to - from)).extend(0.0), DVec3::Z * half_depth);
        }
        Ok(builder.finish())
    }
}
