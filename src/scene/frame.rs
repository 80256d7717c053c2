//! One frame of a scene: the camera and every instance, now and one frame earlier.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DMat4, DVec2, DVec3, DVec4};

use super::Mesh;

/// What stands where at one frame.
#[derive(Debug, Clone)]
pub struct Frame {
    /// The camera.
    pub view: View,
    /// The camera one frame earlier; the same where nothing came before.
    pub previous_view: View,
    /// Everything that is drawn, in drawing order.
    pub instances: Vec<Instance>,
}

/// A mesh, a material and where it stands.
#[derive(Debug, Clone)]
pub struct Instance {
    /// Shared between instances and frames where it does not change, so that `Arc::as_ptr` tells whether it did.
    pub mesh: Arc<Mesh>,
    /// Index into [`super::Scene::materials`].
    pub material: usize,
    /// Now.
    pub world_from_object: DAffine3,
    /// One frame earlier; the same where nothing came before.
    pub previous_world_from_object: DAffine3,
    /// From 1, the same in every frame; 0 is the background.
    pub id: u32,
}

/// A camera at one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// In world space.
    pub position: DVec3,
    /// Columns are the camera's right, up and backward directions in world space.
    pub world_from_view: DMat3,
    /// How depth becomes a picture.
    pub projection: Projection,
    /// How far the picture is moved within its plane, in clip space's units at w = 1: an off-axis projection.
    pub shift_ndc: DVec2,
}

/// How depth becomes a picture. Depth is reversed: 1 at the near plane, 0 at infinity or at the far plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// A pinhole, far plane at infinity.
    Perspective {
        /// Full vertical angle in radians, in (0, pi).
        fov_y: f64,
        /// Distance of the near plane in metres, above 0.
        near: f64,
    },
    /// Parallel rays.
    Orthographic {
        /// Height of the picture in metres, above 0.
        height: f64,
        /// Nearest depth in front of the camera that is drawn, in metres.
        near: f64,
        /// Farthest depth, above `near`.
        far: f64,
    },
}

impl View {
    /// At `position`, looking at `target`. Where `up` lies along the view another one is chosen.
    #[must_use]
    pub fn looking_at(position: DVec3, target: DVec3, up: DVec3, projection: Projection) -> Self {
        let backward = (position - target).try_normalize().unwrap_or(DVec3::Z);
        let right = up.cross(backward).try_normalize().unwrap_or_else(|| backward.any_orthonormal_vector());
        Self {
            position,
            world_from_view: DMat3::from_cols(right, backward.cross(right), backward),
            projection,
            shift_ndc: DVec2::ZERO,
        }
    }

    /// World to camera space (x right, y up, looking along -z).
    #[must_use]
    pub fn view_from_world(&self) -> DAffine3 {
        let view_from_world = self.world_from_view.transpose();
        DAffine3::from_mat3_translation(view_from_world, -(view_from_world * self.position))
    }

    /// Camera space to clip space for a picture of this width over height; y up, reversed depth.
    #[must_use]
    pub fn clip_from_view(&self, aspect: f64) -> DMat4 {
        let straight = match self.projection {
            Projection::Perspective { fov_y, near } => {
                let y = 1.0 / (0.5 * fov_y).tan();
                DMat4::from_cols(y / aspect * DVec4::X, y * DVec4::Y, -DVec4::W, near * DVec4::Z)
            }
            Projection::Orthographic { height, near, far } => {
                let y = 2.0 / height;
                let z = 1.0 / (far - near);
                DMat4::from_cols(y / aspect * DVec4::X, y * DVec4::Y, z * DVec4::Z, DVec4::new(0.0, 0.0, far * z, 1.0))
            }
        };
        DMat4::from_translation(self.shift_ndc.extend(0.0)) * straight
    }

    /// Where a still point at a clip-space position of this view was in clip space of an earlier one. The two cameras' distance is
    /// taken in f64, so it does not matter how far both are from the origin.
    #[must_use]
    pub fn previous_clip_from_clip(&self, previous: &Self, aspect: f64) -> DMat4 {
        let step = DAffine3::from_translation(self.position - previous.position);
        let turned = DAffine3::from_mat3(previous.world_from_view.transpose()) * step * DAffine3::from_mat3(self.world_from_view);
        previous.clip_from_view(aspect) * DMat4::from(turned) * self.clip_from_view(aspect).inverse()
    }

    /// Object to clip space without ever forming a world-space f32: the camera's position is taken off in f64.
    #[must_use]
    pub fn clip_from_object(&self, world_from_object: &DAffine3, aspect: f64) -> DMat4 {
        let mut camera_relative = *world_from_object;
        camera_relative.translation -= self.position;
        let view_from_camera_relative = DAffine3::from_mat3(self.world_from_view.transpose());
        self.clip_from_view(aspect) * DMat4::from(view_from_camera_relative * camera_relative)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn depth(view: &View, distance: f64) -> f64 {
        let clip = view.clip_from_view(1.0) * DVec4::new(0.0, 0.0, -distance, 1.0);
        clip.z / clip.w
    }

    #[test]
    fn depth_is_reversed_in_both_projections() {
        let view = |projection| View::looking_at(DVec3::ZERO, -DVec3::Z, DVec3::Y, projection);
        let pinhole = view(Projection::Perspective { fov_y: 1.0, near: 0.5 });
        assert!((depth(&pinhole, 0.5) - 1.0).abs() < 1e-12);
        assert!(depth(&pinhole, 1e12) < 1e-11);
        let parallel = view(Projection::Orthographic { height: 2.0, near: 1.0, far: 9.0 });
        assert!((depth(&parallel, 1.0) - 1.0).abs() < 1e-12);
        assert!(depth(&parallel, 9.0).abs() < 1e-12);
    }

    #[test]
    fn a_million_metres_away_looks_the_same() {
        let projection = Projection::Perspective { fov_y: 1.0, near: 0.1 };
        let clip_at = |origin: DVec3| {
            let view = View::looking_at(origin + DVec3::new(1.0, 2.0, 5.0), origin, DVec3::Y, projection);
            view.clip_from_object(&DAffine3::from_translation(origin + DVec3::X), 1.5)
        };
        let difference = clip_at(DVec3::ZERO) - clip_at(DVec3::new(1e6, -2e6, 3e6));
        assert!(difference.to_cols_array().iter().all(|d| d.abs() < 1e-8), "{difference}");
    }

    #[test]
    fn still_points_are_found_in_the_frame_before() {
        let projection = Projection::Perspective { fov_y: 1.0, near: 0.1 };
        let origin = DVec3::new(1e6, 0.0, -1e6);
        let now = View::looking_at(origin + DVec3::new(1.0, 2.0, 5.0), origin, DVec3::Y, projection);
        let before = View::looking_at(origin + DVec3::new(0.5, 2.1, 5.0), origin + DVec3::X, DVec3::Y, projection);
        let point = DAffine3::from_translation(origin + DVec3::new(0.3, -0.2, 0.1));
        let clip = |view: &View| view.clip_from_object(&point, 1.5) * DVec4::W;
        let found = now.previous_clip_from_clip(&before, 1.5) * clip(&now);
        let expected = clip(&before);
        assert!((found / found.w - expected / expected.w).length() < 1e-8, "{found} {expected}");
    }

    #[test]
    fn looking_straight_down_still_has_a_right() {
        let view = View::looking_at(DVec3::Y, DVec3::ZERO, DVec3::Y, Projection::Perspective { fov_y: 1.0, near: 0.1 });
        assert!((view.world_from_view.determinant() - 1.0).abs() < 1e-12);
    }
}
