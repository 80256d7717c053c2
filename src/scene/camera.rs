//! Where the camera is at a time.

use glam::DVec3;

use super::document::{CameraDoc, ProjectionDoc};
use super::framing::Framing;
use super::place::Place;
use super::values::Numbers;
use super::{Projection, View};
use crate::error::Result;

/// A camera over time.
#[derive(Debug, Clone)]
pub(super) enum Camera {
    /// As the scene file says.
    Placed(PlacedCamera),
    /// At rest, where a thing fills the picture whatever its shape.
    Framing(Framing),
}

#[derive(Debug, Clone)]
pub(super) struct PlacedCamera {
    lens: Lens,
    up: DVec3,
    /// Metres per second.
    velocity: DVec3,
    /// At least one, in order of time.
    keys: Vec<CameraKey>,
}

#[derive(Debug, Clone, Copy)]
enum Lens {
    Fixed(Projection),
    /// Orthographic, as many units high as the picture has pixels.
    Pixels {
        near: f64,
        far: f64,
    },
}

#[derive(Debug, Clone, Copy)]
struct CameraKey {
    /// Seconds.
    time: f64,
    position: DVec3,
    target: DVec3,
}

impl Camera {
    /// From a scene file's `[camera]`.
    pub(super) fn build(doc: &CameraDoc, at: &Place<'_>) -> Result<Self> {
        let up = DVec3::from(doc.up.unwrap_or(Numbers([0.0, 1.0, 0.0])));
        if up.length() < 1e-6 {
            return Err(at.key("up").error("the camera's up direction has no length; expected a direction"));
        }
        Ok(Self::Placed(PlacedCamera { lens: lens(doc, at)?, up, velocity: doc.velocity.into(), keys: keys(doc, at)? }))
    }

    /// At a time in seconds, for a picture of this size.
    pub(super) fn view(&self, time: f64, size: [u32; 2]) -> View {
        match self {
            Self::Placed(camera) => camera.view(time, size),
            Self::Framing(framing) => framing.view(size),
        }
    }
}

impl PlacedCamera {
    fn view(&self, time: f64, size: [u32; 2]) -> View {
        let projection = match self.lens {
            Lens::Fixed(projection) => projection,
            Lens::Pixels { near, far } => Projection::Orthographic { height: f64::from(size[1]), near, far },
        };
        let (position, target) = interpolate(&self.keys, time);
        let moved = self.velocity * time;
        let mut view = View::looking_at(position + moved, target + moved, self.up, projection);
        if let Lens::Pixels { .. } = self.lens {
            // The middle of an odd number of pixels lies inside one: the axis goes to that pixel's left upper corner instead.
            let [odd_x, odd_y] = size.map(|pixels| f64::from(pixels % 2));
            view.position += view.world_from_view * DVec3::new(0.5 * odd_x, -0.5 * odd_y, 0.0);
        }
        view
    }
}

fn lens(doc: &CameraDoc, at: &Place<'_>) -> Result<Lens> {
    let kind = doc.projection;
    let belongs = |key: &str, given: bool, here: bool| match given && !here {
        true => Err(at.key(key).error(format!("`{key}` means nothing to this projection; remove it or choose another"))),
        false => Ok(()),
    };
    belongs("fov_y_deg", doc.fov_y_deg.is_some(), kind == ProjectionDoc::Perspective)?;
    belongs("height", doc.height.is_some(), kind == ProjectionDoc::Orthographic)?;
    belongs("far", doc.far.is_some(), kind != ProjectionDoc::Perspective)?;
    if kind == ProjectionDoc::Perspective {
        let fov_y = at.key("fov_y_deg").within(doc.fov_y_deg.unwrap_or(45.0), 0.01..=179.0)?.to_radians();
        let near = at.key("near").positive(doc.near.unwrap_or(0.1))?;
        return Ok(Lens::Fixed(Projection::Perspective { fov_y, near }));
    }
    let near = doc.near.unwrap_or(0.0);
    let far = doc.far.unwrap_or(near + 1000.0);
    if far - near < 1e-6 {
        return Err(at.key("far").error(format!("{far} is not behind the near plane; expected more than {near}")));
    }
    if kind == ProjectionDoc::Pixels {
        return Ok(Lens::Pixels { near, far });
    }
    let Some(height) = doc.height else {
        return Err(at.error("an orthographic camera needs `height`, the picture's in metres"));
    };
    Ok(Lens::Fixed(Projection::Orthographic { height: at.key("height").positive(height)?, near, far }))
}

fn keys(doc: &CameraDoc, at: &Place<'_>) -> Result<Vec<CameraKey>> {
    let keyframes = at.key("keyframes");
    if doc.keyframes.is_empty() {
        let (Some(position), Some(target)) = (doc.position, doc.target) else {
            return Err(at.error("the camera needs `position` and `target`, or keyframes"));
        };
        return Ok(vec![key(0.0, position, target, at)?]);
    }
    if doc.position.is_some() || doc.target.is_some() {
        return Err(keyframes.error("keyframes take the place of the camera's position and target; remove one or the other"));
    }
    let keys = doc.keyframes.iter().enumerate();
    let keys: Vec<CameraKey> =
        keys.map(|(k, doc)| key(doc.time, doc.position, doc.target, &keyframes.item(k))).collect::<Result<_>>()?;
    check_order(keys.iter().map(|key| key.time), &keyframes)?;
    Ok(keys)
}

fn key(time: f64, position: Numbers<3>, target: Numbers<3>, at: &Place<'_>) -> Result<CameraKey> {
    let (position, target) = (DVec3::from(position), DVec3::from(target));
    if position.distance(target) < 1e-6 {
        return Err(at.key("target").error("the camera stands on its target; expected another point to look at"));
    }
    Ok(CameraKey { time, position, target })
}

/// Keyframes must come one after another.
pub(super) fn check_order(times: impl Iterator<Item = f64>, at: &Place<'_>) -> Result<()> {
    let mut before = f64::NEG_INFINITY;
    for (k, time) in times.enumerate() {
        if time - before < 1e-6 {
            return Err(at
                .item(k)
                .key("time")
                .error(format!("{time} is not after the keyframe before; expected more than {before}")));
        }
        before = time;
    }
    Ok(())
}

fn interpolate(keys: &[CameraKey], time: f64) -> (DVec3, DVec3) {
    let (from, to, t) = bracket(keys, |key| key.time, time);
    (from.position.lerp(to.position, t), from.target.lerp(to.target, t))
}

/// The keyframes around a time and how far it is from the first to the second, in [0, 1]. Needs at least one.
pub(super) fn bracket<T>(keys: &[T], time_of: impl Fn(&T) -> f64, time: f64) -> (&T, &T, f64) {
    let after = keys.partition_point(|key| time_of(key) <= time);
    let (from, to) = (&keys[after.saturating_sub(1)], &keys[after.min(keys.len() - 1)]);
    let span = time_of(to) - time_of(from);
    (from, to, if span > 0.0 { (time - time_of(from)) / span } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixels() -> PlacedCamera {
        let key = CameraKey { time: 0.0, position: DVec3::new(0.0, 0.0, 10.0), target: DVec3::ZERO };
        PlacedCamera { lens: Lens::Pixels { near: 0.0, far: 100.0 }, up: DVec3::Y, velocity: DVec3::ZERO, keys: vec![key] }
    }

    #[test]
    fn in_a_pixel_view_whole_coordinates_are_pixel_borders_at_any_size() {
        for size in [[320, 180], [321, 180], [320, 181], [1, 1], [3, 5], [1921, 1081]] {
            let view = pixels().view(0.0, size);
            let clip = view.clip_from_view(f64::from(size[0]) / f64::from(size[1])) * glam::DMat4::from(view.view_from_world());
            for (x, y) in [(0.0, 0.0), (7.0, -3.0)] {
                let p = clip.project_point3(DVec3::new(x, y, 0.0));
                let screen = [(p.x * 0.5 + 0.5) * f64::from(size[0]), (0.5 - p.y * 0.5) * f64::from(size[1])];
                let expected = [f64::from(size[0] / 2) + x, f64::from(size[1] / 2) - y];
                for axis in 0..2 {
                    assert!((screen[axis] - expected[axis]).abs() < 1e-9, "{size:?}: {screen:?} instead of {expected:?}");
                }
            }
        }
    }

    #[test]
    fn keyframes_are_linear_between_and_at_rest_outside() {
        let keys = [(1.0, 0.0), (2.0, 10.0), (4.0, 0.0)];
        let at = |time| {
            let (from, to, t) = bracket(&keys, |key| key.0, time);
            from.1 + (to.1 - from.1) * t
        };
        for (time, expected) in [(0.0, 0.0), (1.0, 0.0), (1.5, 5.0), (2.0, 10.0), (3.0, 5.0), (4.0, 0.0), (9.0, 0.0)] {
            assert_eq!(at(time), expected, "{time}");
        }
    }
}
