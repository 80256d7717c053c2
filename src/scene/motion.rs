//! Where an object is at a time.

use glam::{DAffine3, DMat3, DQuat, DVec3};

use super::camera::{bracket, check_order};
use super::document::{MotionDoc, ObjectDoc};
use super::place::Place;
use super::values::Numbers;
use crate::error::Result;

/// An object's place in the world over time.
#[derive(Debug, Clone)]
pub(super) struct Motion {
    /// At least one, in order of time.
    keys: Vec<MotionKey>,
    /// Metres per second.
    velocity: DVec3,
    /// In the object's own space; its length is radians per second.
    spin: DVec3,
}

#[derive(Debug, Clone, Copy)]
struct MotionKey {
    /// Seconds.
    time: f64,
    position: DVec3,
    rotation_deg: DVec3,
    scale: DVec3,
}

impl Motion {
    /// From an object of a scene file.
    pub(super) fn build(doc: &ObjectDoc, at: &Place<'_>) -> Result<Self> {
        let own = MotionKey {
            time: 0.0,
            position: doc.position.into(),
            rotation_deg: doc.rotation_deg.into(),
            scale: check_scale(doc.scale.0, &at.key("scale"))?,
        };
        let none = MotionDoc::default();
        let motion = doc.motion.as_ref().unwrap_or(&none);
        let motion_place = at.key("motion");
        let keys = keys(motion, own, &motion_place.key("keyframes"))?;
        Ok(Self { keys, velocity: motion.velocity.into(), spin: spin(motion, &motion_place)? })
    }

    /// Always there, untransformed.
    pub(super) fn still() -> Self {
        let key = MotionKey { time: 0.0, position: DVec3::ZERO, rotation_deg: DVec3::ZERO, scale: DVec3::ONE };
        Self { keys: vec![key], velocity: DVec3::ZERO, spin: DVec3::ZERO }
    }

    /// Whether the object never moves.
    pub(super) fn is_still(&self) -> bool {
        self.keys.len() == 1 && self.velocity == DVec3::ZERO && self.spin == DVec3::ZERO
    }

    /// Where the object is at a time in seconds.
    pub(super) fn at(&self, time: f64) -> DAffine3 {
        let (from, to, t) = bracket(&self.keys, |key| key.time, time);
        let rotation = rotation_xyz(from.rotation_deg.lerp(to.rotation_deg, t))
            * DMat3::from_quat(DQuat::from_scaled_axis(self.spin * time));
        let scale = DMat3::from_diagonal(from.scale.lerp(to.scale, t));
        DAffine3::from_mat3_translation(rotation * scale, from.position.lerp(to.position, t) + self.velocity * time)
    }
}

fn keys(doc: &MotionDoc, own: MotionKey, at: &Place<'_>) -> Result<Vec<MotionKey>> {
    if doc.keyframes.is_empty() {
        return Ok(vec![own]);
    }
    let mut keys = Vec::new();
    for (k, key) in doc.keyframes.iter().enumerate() {
        let scale_place = at.item(k);
        let scale_place = scale_place.key("scale");
        let scale = key.scale.map_or(Ok(own.scale), |scale| check_scale(scale.0, &scale_place))?;
        if scale.signum() != own.scale.signum() {
            return Err(scale_place.error("the scale changes its sign on the way; expected the object's own signs"));
        }
        keys.push(MotionKey {
            time: key.time,
            position: key.position.map_or(own.position, DVec3::from),
            rotation_deg: key.rotation_deg.map_or(own.rotation_deg, DVec3::from),
            scale,
        });
    }
    check_order(keys.iter().map(|key| key.time), at)?;
    Ok(keys)
}

fn spin(doc: &MotionDoc, at: &Place<'_>) -> Result<DVec3> {
    let axis = DVec3::from(doc.spin_axis.unwrap_or(Numbers([0.0, 0.0, 1.0])));
    let Some(axis) = axis.try_normalize().filter(|_| axis.length() >= 1e-6) else {
        return Err(at.key("spin_axis").error("the axis has no length; expected a direction"));
    };
    Ok(axis * doc.spin_deg_per_s.to_radians())
}

/// Mirrors are fine, flat things are not.
fn check_scale(scale: [f64; 3], at: &Place<'_>) -> Result<DVec3> {
    if scale.iter().all(|factor| (1e-6..=1e6).contains(&factor.abs())) {
        return Ok(scale.into());
    }
    Err(at.error("a factor of the scale is too close to 0 or too large; expected 1e-6 to 1e6, or negative to mirror"))
}

/// A rotation about the fixed axes x, then y, then z.
pub(super) fn rotation_xyz(degrees: DVec3) -> DMat3 {
    let [x, y, z] = degrees.to_array().map(f64::to_radians);
    DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion(velocity: DVec3, spin: DVec3) -> Motion {
        Motion { velocity, spin, ..Motion::still() }
    }

    #[test]
    fn rotations_apply_about_x_then_y_then_z() {
        let turned = rotation_xyz(DVec3::new(90.0, 90.0, 0.0)) * DVec3::Y;
        assert!(turned.distance(DVec3::X) < 1e-15, "{turned}");
    }

    #[test]
    fn a_moving_spinning_object_is_where_physics_puts_it() {
        let motion = motion(DVec3::X * 2.0, DVec3::Z * std::f64::consts::PI);
        let half_turn = motion.at(1.0).transform_point3(DVec3::X);
        assert!(half_turn.distance(DVec3::X) < 1e-12, "{half_turn}");
        assert_eq!(motion.at(0.0), DAffine3::IDENTITY);
        assert!(!motion.is_still() && Motion::still().is_still());
    }
}
