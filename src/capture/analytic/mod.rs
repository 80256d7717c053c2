//! Exact answers on the CPU in f64, for scenes that have one: the box filter over each pixel, integrated and not sampled.
//!
//! Flat scenes (unlit surfaces of one colour that do not overlap on screen) are exact polygon coverage. A zone plate that fills a
//! parallel view is a product of one-dimensional integrals, done by adaptive quadrature. Nothing is shared with the renderer but
//! the scene itself.

mod coverage;
mod half_plane;
mod polygon;
mod zone_plate;

pub use coverage::edges_crossing;
pub use half_plane::half_plane_share;

use crate::error::{Error, Result};
use crate::picture::LinearPicture;
use crate::scene::{Pattern, Scene};

/// The exact picture of a frame, linear and not exposed.
///
/// # Errors
/// [`Error::Request`] that says why the scene has no exact answer.
pub fn exact(scene: &Scene, frame: u32, size: [u32; 2]) -> Result<LinearPicture> {
    let drawn = scene.frame(frame, size)?;
    let zone_plate = drawn.instances.iter().any(|i| matches!(scene.materials[i.material].pattern, Pattern::ZonePlate { .. }));
    let answer = if zone_plate { zone_plate::exact(scene, &drawn, size) } else { coverage::exact(scene, &drawn, size) };
    answer.map_err(|why| {
        Error::Request(format!("{} has no analytic reference: {why}; edges, far, wires and zoneplate have one", scene.name))
    })
}

/// Why a scene has no exact answer.
type Answer<T> = std::result::Result<T, &'static str>;

/// Where a point of an instance lands on the picture, in pixels, y down.
fn screen_points(
    instance: &crate::scene::Instance,
    view: &crate::scene::View,
    size: [u32; 2],
) -> impl Fn(glam::DVec3) -> Answer<glam::DVec2> {
    let [width, height] = size.map(f64::from);
    let clip_from_object = view.clip_from_object(&instance.world_from_object, width / height);
    move |point| {
        let clip = clip_from_object * point.extend(1.0);
        if clip.w <= 0.0 || clip.z > clip.w || clip.z < 0.0 {
            return Err("a surface crosses the near or far plane");
        }
        Ok(glam::DVec2::new((0.5 + 0.5 * clip.x / clip.w) * width, (0.5 - 0.5 * clip.y / clip.w) * height))
    }
}
