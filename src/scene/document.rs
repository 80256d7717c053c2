//! What a scene file may say, as plain structs. Unknown keys are refused; what the numbers mean is checked when a scene is built.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::shapes::Shape;
use super::thresholds::Thresholds;
use super::values::{Color, MaterialUse, Numbers, Scale};

/// A whole scene file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct SceneDoc {
    /// The file's name without its ending, if left out.
    pub(super) name: Option<String>,
    /// What the scene tests, in a line.
    #[serde(default)]
    pub(super) about: String,
    #[serde(default = "one")]
    pub(super) frames: u32,
    /// Seconds between frames.
    #[serde(default = "sixtieth")]
    pub(super) time_step: f64,
    #[serde(default)]
    pub(super) background: Color,
    /// Stops: each doubles the exposure.
    #[serde(default)]
    pub(super) exposure_ev: f64,
    #[serde(default)]
    pub(super) tone_map: ToneMapDoc,
    /// Samples along the direction of anisotropy in the models' textures. More than 1 differs between drivers.
    #[serde(default = "one")]
    pub(super) anisotropy: u32,
    pub(super) camera: CameraDoc,
    pub(super) light: Option<LightDoc>,
    /// Light from everywhere.
    #[serde(default)]
    pub(super) ambient: Color,
    /// To be used by name.
    #[serde(default)]
    pub(super) materials: BTreeMap<String, MaterialDoc>,
    #[serde(default)]
    pub(super) objects: Vec<ObjectDoc>,
    /// Bars for `dejag sequence`.
    #[serde(default)]
    pub(super) thresholds: Thresholds,
}

fn one() -> u32 {
    1
}

fn sixtieth() -> f64 {
    1.0 / 60.0
}

#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "snake_case", expecting = "the name of a tone map")]
pub(super) enum ToneMapDoc {
    #[default]
    Clamp,
    Reinhard,
    Aces,
    Agx,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case", expecting = "the name of a projection")]
pub(super) enum ProjectionDoc {
    /// A pinhole: `fov_y_deg`, `near`.
    Perspective,
    /// Parallel rays: `height`, `near`, `far`.
    Orthographic,
    /// Parallel rays, a unit is a pixel: `near`, `far`. The camera's axis meets the picture at the pixel corner nearest to its
    /// middle, so that whole coordinates are pixel borders at any picture size.
    Pixels,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct CameraDoc {
    pub(super) projection: ProjectionDoc,
    pub(super) fov_y_deg: Option<f64>,
    pub(super) height: Option<f64>,
    pub(super) near: Option<f64>,
    pub(super) far: Option<f64>,
    pub(super) position: Option<Numbers<3>>,
    pub(super) target: Option<Numbers<3>>,
    pub(super) up: Option<Numbers<3>>,
    /// Metres per second, of position and target.
    #[serde(default)]
    pub(super) velocity: Numbers<3>,
    /// Instead of `position` and `target`.
    #[serde(default)]
    pub(super) keyframes: Vec<CameraKeyDoc>,
}

/// Between two keyframes position and target move on straight lines; before the first and after the last they rest.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct CameraKeyDoc {
    /// Seconds.
    pub(super) time: f64,
    pub(super) position: Numbers<3>,
    pub(super) target: Numbers<3>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct LightDoc {
    /// The way the light goes.
    pub(super) direction: Option<Numbers<3>>,
    /// The way to where it comes from; instead of `direction`.
    pub(super) to_light: Option<Numbers<3>>,
    #[serde(default = "Color::white")]
    pub(super) color: Color,
    #[serde(default = "unity")]
    pub(super) intensity: f64,
}

fn unity() -> f64 {
    1.0
}

/// A surface. Colours are linear unless written as `"#rrggbb"`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct MaterialDoc {
    #[serde(default = "Color::white")]
    pub(super) color: Color,
    #[serde(default)]
    pub(super) metallic: f64,
    #[serde(default = "unity")]
    pub(super) roughness: f64,
    #[serde(default)]
    pub(super) emissive: Color,
    /// Multiplies `emissive`.
    #[serde(default = "unity")]
    pub(super) emissive_strength: f64,
    /// Makes the material a mask: drawn where its opacity is at least this.
    pub(super) cutoff: Option<f64>,
    #[serde(default)]
    pub(super) unlit: bool,
    #[serde(default)]
    pub(super) double_sided: bool,
    pub(super) pattern: Option<PatternDoc>,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case", expecting = "a pattern: \"leaf\", or a table with the pattern's name as its key")]
pub(super) enum PatternDoc {
    Checker(CheckerDoc),
    Stripes(StripesDoc),
    ZonePlate(ZonePlateDoc),
    Bumps(BumpsDoc),
    Leaf,
    Gradient(GradientDoc),
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct CheckerDoc {
    pub(super) cell: f64,
    pub(super) other: Color,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct StripesDoc {
    pub(super) period: f64,
    pub(super) fill: f64,
    pub(super) other: Color,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct ZonePlateDoc {
    pub(super) phase: f64,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct BumpsDoc {
    pub(super) frequency: f64,
    pub(super) slope: f64,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct GradientDoc {
    pub(super) top: Color,
}

/// A thing, or many alike.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct ObjectDoc {
    pub(super) name: Option<String>,
    pub(super) shape: Shape,
    #[serde(default)]
    pub(super) position: Numbers<3>,
    /// About x, then y, then z, each fixed in space.
    #[serde(default)]
    pub(super) rotation_deg: Numbers<3>,
    #[serde(default)]
    pub(super) scale: Scale,
    pub(super) material: Option<MaterialUse>,
    pub(super) motion: Option<MotionDoc>,
    /// Copies of copies: the last entry's rows stand inside the first one's.
    #[serde(default)]
    pub(super) repeat: Vec<RepeatDoc>,
    /// Copies at these points, relative to the object's position; instead of the object itself.
    #[serde(default)]
    pub(super) places: Vec<Numbers<3>>,
    pub(super) scatter: Option<ScatterDoc>,
    /// Makes all copies one mesh with one id.
    #[serde(default)]
    pub(super) join: bool,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct MotionDoc {
    /// Metres per second.
    #[serde(default)]
    pub(super) velocity: Numbers<3>,
    /// In the object's own space.
    pub(super) spin_axis: Option<Numbers<3>>,
    #[serde(default)]
    pub(super) spin_deg_per_s: f64,
    /// Take the place of the object's position, rotation and scale; linear in between, at rest outside.
    #[serde(default)]
    pub(super) keyframes: Vec<MotionKeyDoc>,
}

/// What is left out is the object's own.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct MotionKeyDoc {
    /// Seconds.
    pub(super) time: f64,
    pub(super) position: Option<Numbers<3>>,
    pub(super) rotation_deg: Option<Numbers<3>>,
    pub(super) scale: Option<Scale>,
}

/// A row of copies, each standing to the one before as the second to the first.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct RepeatDoc {
    /// With the first.
    pub(super) count: u32,
    /// Metres from each to the next.
    #[serde(default)]
    pub(super) step: Numbers<3>,
    /// Turn from each to the next, about x, then y, then z.
    #[serde(default)]
    pub(super) rotate_deg: Numbers<3>,
    /// The point that copies turn around; without it each turns on its spot.
    pub(super) around: Option<Numbers<3>>,
    /// Size of each against the one before.
    #[serde(default = "unity")]
    pub(super) scale: f64,
}

/// Copies at random places around the object's position.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct ScatterDoc {
    pub(super) count: u32,
    #[serde(default)]
    pub(super) seed: u32,
    /// Corners of a box, relative to the object's position.
    pub(super) min: Numbers<3>,
    pub(super) max: Numbers<3>,
    #[serde(default)]
    pub(super) within: Region,
    /// Smallest and largest factor on the size.
    #[serde(default = "same_size")]
    pub(super) scale: Numbers<2>,
    /// Largest turn either way, about x, then y, then z.
    #[serde(default)]
    pub(super) rotate_deg: Numbers<3>,
    /// Smallest and largest factor on the colour; needs `join`.
    pub(super) shade: Option<Numbers<2>>,
}

fn same_size() -> Numbers<2> {
    Numbers([1.0; 2])
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case", expecting = "\"box\" or \"ellipsoid\"")]
pub(super) enum Region {
    #[default]
    Box,
    /// The ellipsoid that touches the box's sides.
    Ellipsoid,
}
