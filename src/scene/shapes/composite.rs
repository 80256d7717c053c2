//! Shapes put together from simpler ones.

use glam::{DAffine3, DQuat, DVec2, DVec3};
use serde::Deserialize;

use super::builder::{Builder, circle, corner};
use super::solid::{frustum, torus};
use super::{SEGMENTS, default_segments};
use crate::error::Result;
use crate::scene::Mesh;
use crate::scene::place::Place;
use crate::scene::values::Numbers;

/// A spoked wheel around z: a round rim, a hub, and spokes between them.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(in crate::scene) struct Wheel {
    /// To the outside of the rim.
    radius: f64,
    /// Half the rim's thickness.
    rim_radius: f64,
    spokes: u32,
    spoke_radius: f64,
    hub_radius: f64,
    /// Along the axle.
    hub_width: f64,
    #[serde(default = "default_segments")]
    segments: u32,
}

impl Wheel {
    pub(super) fn mesh(&self, at: &Place<'_>) -> Result<Mesh> {
        let radius = at.key("radius").positive(self.radius)?;
        let rim = at.key("rim_radius").within(self.rim_radius, 1e-6..=radius * 0.25)?;
        let hub = at.key("hub_radius").within(self.hub_radius, 1e-6..=radius * 0.5)?;
        let spoke = at.key("spoke_radius").within(self.spoke_radius, 1e-6..=hub)?;
        let hub_width = at.key("hub_width").positive(self.hub_width)?;
        let spokes = at.key("spokes").count(self.spokes, 1..=512)?;
        let segments = at.key("segments").count(self.segments, SEGMENTS)?;

        let mut rim_builder = Builder::default();
        torus(&mut rim_builder, [radius - rim, rim], 1.0, [segments, 8]);
        let mut mesh = rim_builder.finish();
        // From inside the hub to the middle of the rim, so that no gap shows.
        let (inner, outer) = (0.5 * hub, radius - rim);
        let bar = bar(spoke, outer - inner, 6);
        for k in 0..spokes {
            let turn = DQuat::from_rotation_z(f64::from(k) / f64::from(spokes) * std::f64::consts::TAU);
            mesh.append(&bar, &DAffine3::from_rotation_translation(turn, turn * DVec3::Y * (0.5 * (inner + outer))));
        }
        mesh.append(&bar_along_z(hub, hub_width, 16), &DAffine3::IDENTITY);
        Ok(mesh)
    }
}

fn bar(radius: f64, length: f64, sides: u32) -> Mesh {
    let mut builder = Builder::default();
    frustum(&mut builder, [radius; 2], length, sides);
    builder.finish()
}

fn bar_along_z(radius: f64, length: f64, sides: u32) -> Mesh {
    let mut mesh = Mesh::default();
    mesh.append(&bar(radius, length, sides), &DAffine3::from_quat(DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2)));
    mesh
}

/// A piece of wall with a round-headed opening, standing on y = 0, centred in x and z; uv of its faces in metres.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(in crate::scene) struct Arch {
    /// Width, height and depth of the wall.
    size: Numbers<3>,
    /// Width of the opening.
    opening: f64,
    /// Height at which the opening's half circle begins.
    spring: f64,
    /// Along the half circle.
    #[serde(default = "default_segments")]
    segments: u32,
}

impl Arch {
    pub(super) fn mesh(&self, at: &Place<'_>) -> Result<Mesh> {
        let [width, height, depth] = at.key("size").all_positive(self.size.0)?;
        let opening = at.key("opening").within(self.opening, 1e-6..=width * 0.999)?;
        let spring = at.key("spring").within(self.spring, 1e-6..=height - 0.5001 * opening)?;
        let segments = at.key("segments").count(self.segments, SEGMENTS)?;

        let outline = Outline { half_width: 0.5 * width, height, radius: 0.5 * opening, spring, segments };
        let mut builder = Builder::default();
        for (z, up) in [(0.5 * depth, 1.0), (-0.5 * depth, -1.0)] {
            outline.face(&mut builder, z, up);
        }
        outline.reveal(&mut builder, 0.5 * depth);
        outline.shell(&mut builder, 0.5 * depth);
        Ok(builder.finish())
    }
}

/// An arch seen from the front.
struct Outline {
    half_width: f64,
    height: f64,
    radius: f64,
    spring: f64,
    segments: u32,
}

impl Outline {
    /// A point of the half circle, `k` of `segments` from left to right.
    fn head(&self, k: u32) -> DVec2 {
        DVec2::new(0.0, self.spring) + self.radius * circle(0.5 - 0.5 * f64::from(k) / f64::from(self.segments))
    }

    /// The front (`up` +1) or the back (-1).
    fn face(&self, builder: &mut Builder, z: f64, up: f64) {
        let block = |builder: &mut Builder, [x0, x1]: [f64; 2], [y0, y1]: [f64; 2]| {
            builder.polygon(&[DVec2::new(x0, y0), DVec2::new(x1, y0), DVec2::new(x1, y1), DVec2::new(x0, y1)], z, up);
        };
        // The piers are cut at the springing, where the head's first corner lies on their edge: no crack opens there.
        for x in [[-self.half_width, -self.radius], [self.radius, self.half_width]] {
            block(builder, x, [0.0, self.spring]);
            block(builder, x, [self.spring, self.height]);
        }
        for k in 0..self.segments {
            let (left, right) = (self.head(k), self.head(k + 1));
            let corners = [left, right, DVec2::new(right.x, self.height), DVec2::new(left.x, self.height)];
            builder.polygon(&corners, z, up);
        }
    }

    /// The inside of the opening: jambs and curved head.
    fn reveal(&self, builder: &mut Builder, half_depth: f64) {
        let depth = DVec3::NEG_Z * half_depth;
        for side in [-1.0, 1.0] {
            let centre = DVec3::new(side * self.radius, 0.5 * self.spring, 0.0);
            builder.rectangle(centre, depth * -side, DVec3::Y * (0.5 * self.spring));
        }
        builder.grid(self.segments, 1, |u, v| {
            let outward = circle(0.5 * u);
            let across = half_depth * (2.0 * v - 1.0);
            // Seen from below, where u grows to the right the front of the wall (+z) is down.
            let position = (DVec2::new(0.0, self.spring) + self.radius * outward).extend(-across);
            let uv = DVec2::new(std::f64::consts::PI * self.radius * u, across);
            corner(position, -outward.extend(0.0), outward.perp().extend(0.0), uv)
        });
    }

    /// The two ends and the top.
    fn shell(&self, builder: &mut Builder, half_depth: f64) {
        let half_height = 0.5 * self.height;
        for side in [-1.0, 1.0] {
            let centre = DVec3::new(side * self.half_width, half_height, 0.0);
            builder.rectangle(centre, DVec3::NEG_Z * (half_depth * side), DVec3::Y * half_height);
        }
        builder.rectangle(DVec3::Y * self.height, DVec3::X * self.half_width, DVec3::NEG_Z * half_depth);
    }
}
