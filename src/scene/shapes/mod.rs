//! The built-in shapes. Each is a struct that a scene file fills in and that knows how to become triangles, in f64.
//!
//! Front faces are counter-clockwise, normals have unit length, tangents run along u, and v grows along normal x tangent.
//! To add a shape: a struct with a `mesh` method, and a line in [`Shape`] and in [`Shape::build`].

mod builder;
mod composite;
mod flat;
mod solid;
mod text;
mod wire;

use std::ops::RangeInclusive;

use serde::Deserialize;

use super::Mesh;
use super::place::Place;
use crate::error::Result;

pub(super) use wire::Wire;

/// How finely a round shape may be cut.
const SEGMENTS: RangeInclusive<u32> = 3..=1024;

fn default_segments() -> u32 {
    32
}

/// What an object is made of, by the shape's name.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case", expecting = "a shape: a table with the shape's name as its key")]
pub(super) enum Shape {
    Quad(flat::Quad),
    Ground(flat::Ground),
    Disk(flat::Disk),
    Polygon(flat::Polygon),
    Wedges(flat::Wedges),
    Box(solid::Cuboid),
    Sphere(solid::Sphere),
    Dome(solid::Dome),
    Cylinder(solid::Cylinder),
    Torus(solid::Torus),
    Prism(solid::Prism),
    Wheel(composite::Wheel),
    Arch(composite::Arch),
    Wire(wire::WireShape),
    Text(text::Text),
    Gltf(GltfShape),
}

/// A glTF file beside the scene's.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct GltfShape {
    /// Relative to the scene's folder.
    pub(super) path: String,
}

/// A shape after its numbers have been checked.
pub(super) enum Built {
    Mesh(Mesh),
    Wire(Wire),
    /// Still to be read, from this path.
    Model(String),
}

impl Shape {
    /// Checks the shape's numbers and makes its triangles.
    pub(super) fn build(&self, at: &Place<'_>) -> Result<Built> {
        let mesh = match self {
            Self::Quad(shape) => shape.mesh(&at.key("quad")),
            Self::Ground(shape) => shape.mesh(&at.key("ground")),
            Self::Disk(shape) => shape.mesh(&at.key("disk")),
            Self::Polygon(shape) => shape.mesh(&at.key("polygon")),
            Self::Wedges(shape) => shape.mesh(&at.key("wedges")),
            Self::Box(shape) => shape.mesh(&at.key("box")),
            Self::Sphere(shape) => shape.mesh(&at.key("sphere")),
            Self::Dome(shape) => shape.mesh(&at.key("dome")),
            Self::Cylinder(shape) => shape.mesh(&at.key("cylinder")),
            Self::Torus(shape) => shape.mesh(&at.key("torus")),
            Self::Prism(shape) => shape.mesh(&at.key("prism")),
            Self::Wheel(shape) => shape.mesh(&at.key("wheel")),
            Self::Arch(shape) => shape.mesh(&at.key("arch")),
            Self::Text(shape) => shape.mesh(&at.key("text")),
            Self::Wire(shape) => return shape.wire(&at.key("wire")).map(Built::Wire),
            Self::Gltf(shape) => return Ok(Built::Model(shape.path.clone())),
        }?;
        Ok(Built::Mesh(mesh))
    }
}

#[cfg(test)]
mod tests;
