//! Structs that the renderer's module reads, and how a scene fills them.

use glam::{DAffine3, DMat3, DMat4, DVec3, Mat4, Vec3};

use crate::pass::Jitter;
use crate::scene::{AlphaMode, Instance, Material, Pattern, Projection, Scene, View};
use crate::shader::layout::{Layout, gpu_struct};

pub(super) const LAYOUTS: &[Layout] = &[FrameUniforms::LAYOUT, Object::LAYOUT, JitterData::LAYOUT, MaterialUniforms::LAYOUT];

type Matrix = [[f32; 4]; 4];

gpu_struct! {
    /// `FrameUniforms` of scene.wgsl.
    struct FrameUniforms {
        to_light: [f32; 4],
        light_color: [f32; 4],
        ambient: [f32; 4],
        background: [f32; 4],
        to_camera: [f32; 4],
        previous_clip_from_clip: Matrix,
        size_px: [f32; 2],
        sum_of_weights: f32,
        mask_bits: u32,
    }
}

gpu_struct! {
    /// `Object` of scene.wgsl.
    struct Object {
        clip_from_object: Matrix,
        previous_clip_from_object: Matrix,
        camera_relative_from_object: Matrix,
        normal_from_object: Matrix,
        id: u32,
        handedness: f32,
        padding: [u32; 2],
    }
}

gpu_struct! {
    /// `MaterialUniforms` of scene.wgsl.
    struct MaterialUniforms {
        base_color: [f32; 4],
        emissive: [f32; 4],
        other: [f32; 4],
        pattern: [f32; 4],
        metallic: f32,
        roughness: f32,
        normal_scale: f32,
        alpha_cutoff: f32,
    }
}

/// `Jitter` of scene.wgsl.
pub(super) use jitter::Jitter as JitterData;

mod jitter {
    use crate::shader::layout::gpu_struct;

    gpu_struct! {
        /// A jitter as the shader wants it.
        struct Jitter {
            offset_ndc: [f32; 2],
        }
    }
}

fn padded(v: Vec3, w: f32) -> [f32; 4] {
    v.extend(w).to_array()
}

/// Computed in f64, rounded once.
fn matrix(m: DMat4) -> Matrix {
    m.as_mat4().to_cols_array_2d()
}

impl FrameUniforms {
    pub(super) fn of(scene: &SceneLight, view: &View, previous_view: &View, size: [u32; 2]) -> Self {
        let aspect = f64::from(size[0]) / f64::from(size[1]);
        let parallel = matches!(view.projection, Projection::Orthographic { .. });
        Self {
            to_light: padded(scene.to_light, 0.0),
            light_color: padded(scene.light_color, 0.0),
            ambient: padded(scene.ambient, 0.0),
            background: padded(scene.background, 0.0),
            to_camera: padded(view.world_from_view.z_axis.as_vec3(), f32::from(u8::from(parallel))),
            previous_clip_from_clip: matrix(view.previous_clip_from_clip(previous_view, aspect)),
            size_px: size.map(|s| s as f32),
            sum_of_weights: 1.0,
            mask_bits: 0,
        }
    }
}

/// The part of a scene that every frame's uniforms repeat.
#[derive(Debug, Clone, Copy)]
pub(super) struct SceneLight {
    to_light: Vec3,
    light_color: Vec3,
    ambient: Vec3,
    background: Vec3,
}

impl SceneLight {
    pub(super) fn of(scene: &Scene) -> Self {
        Self {
            to_light: scene.light.to_light,
            light_color: scene.light.color,
            ambient: scene.ambient,
            background: scene.background,
        }
    }
}

impl Object {
    /// `centre` is what was taken off the mesh's vertices when they became f32.
    pub(super) fn of(instance: &Instance, centre: DVec3, view: &View, previous_view: &View, aspect: f64) -> Self {
        let recentred = |transform: &DAffine3| *transform * DAffine3::from_translation(centre);
        let world_from_object = recentred(&instance.world_from_object);
        let previous = recentred(&instance.previous_world_from_object);
        let mut camera_relative = world_from_object;
        camera_relative.translation -= view.position;
        Self {
            clip_from_object: matrix(view.clip_from_object(&world_from_object, aspect)),
            previous_clip_from_object: matrix(previous_view.clip_from_object(&previous, aspect)),
            camera_relative_from_object: matrix(DMat4::from(camera_relative)),
            normal_from_object: Mat4::from_mat3(normal_matrix(camera_relative.matrix3).as_mat3()).to_cols_array_2d(),
            id: instance.id,
            handedness: if camera_relative.matrix3.determinant() < 0.0 { -1.0 } else { 1.0 },
            padding: [0; 2],
        }
    }
}

/// Cofactors: the inverse transpose up to a factor, which normalising removes, and defined for flat objects too. The factor's
/// sign is kept, so that mirrored objects keep their outside.
fn normal_matrix(m: DMat3) -> DMat3 {
    let cofactors = DMat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis));
    let scale = cofactors.x_axis.length().max(cofactors.y_axis.length()).max(cofactors.z_axis.length()).max(f64::MIN_POSITIVE);
    cofactors * (m.determinant().signum() / scale)
}

impl JitterData {
    /// A sample right of the centre is the geometry moved left; clip space has y up.
    pub(super) fn of(jitter: &Jitter, size: [u32; 2]) -> Self {
        let [x, y] = jitter.offset_px.map(f64::from);
        let [width, height] = size.map(f64::from);
        Self { offset_ndc: [(-2.0 * x / width) as f32, (2.0 * y / height) as f32] }
    }
}

impl MaterialUniforms {
    /// `number` tells it from the scene's other materials.
    pub(super) fn of(material: &Material, number: u32) -> Self {
        let (other, pattern) = match material.pattern {
            Pattern::None | Pattern::Leaf => (Vec3::ZERO, [0.0; 4]),
            Pattern::Checker { cell, other } => (other, [1.0 / cell, 0.0, 0.0, 0.0]),
            Pattern::Stripes { period, fill, other } => (other, [1.0 / period, fill, 0.0, 0.0]),
            Pattern::ZonePlate { phase } => (Vec3::ZERO, [phase, 0.0, 0.0, 0.0]),
            Pattern::Bumps { frequency, slope } => (Vec3::ZERO, [frequency, slope, 0.0, 0.0]),
            Pattern::Gradient { top } => (top, [0.0; 4]),
        };
        Self {
            base_color: material.base_color.to_array(),
            // Exact below 2^24.
            emissive: padded(material.emissive, number as f32),
            other: padded(other, 0.0),
            pattern,
            metallic: material.metallic,
            roughness: material.roughness,
            normal_scale: material.normal_scale,
            alpha_cutoff: match material.alpha {
                AlphaMode::Opaque => 0.0,
                AlphaMode::Mask { cutoff } => cutoff,
            },
        }
    }
}

/// Number of a pattern in pattern.wgsl.
pub(super) fn pattern_number(pattern: &Pattern) -> u8 {
    match pattern {
        Pattern::None => 0,
        Pattern::Checker { .. } => 1,
        Pattern::Stripes { .. } => 2,
        Pattern::ZonePlate { .. } => 3,
        Pattern::Bumps { .. } => 4,
        Pattern::Leaf => 5,
        Pattern::Gradient { .. } => 6,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_stay_perpendicular_and_outside() {
        for scale in [DVec3::new(1.0, 2.0, 3.0), DVec3::new(-1.0, 2.0, 0.5), DVec3::new(1.0, 1.0, 1e-9)] {
            let m = DMat3::from_rotation_y(0.7) * DMat3::from_diagonal(scale);
            let normal = normal_matrix(m) * DVec3::Z;
            assert!(normal.dot(m * DVec3::X).abs() < 1e-9 && normal.dot(m * DVec3::Y).abs() < 1e-9, "{scale}");
            assert!(normal.dot(m * DVec3::Z) > 0.0, "{scale}");
        }
    }

    #[test]
    fn a_jitter_to_the_lower_right_moves_the_geometry_to_the_upper_left() {
        let data = JitterData::of(&Jitter { offset_px: [0.5, 0.25], weight: 1.0 }, [10, 20]);
        assert_eq!(data.offset_ndc, [-0.1, 0.025]);
    }
}
