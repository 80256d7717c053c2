//! A model's materials.

use glam::{Vec2, Vec3, Vec4};
use gltf::json;
use json::material::AlphaMode as JsonAlpha;
use json::validation::Checked;
use serde_json::Value;

use super::image::Textures;
use super::{Document, Failure};
use crate::error::Result;
use crate::scene::{AlphaMode, Material};

/// KHR_texture_transform: scaled, turned, then shifted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct UvTransform {
    offset: Vec2,
    /// Radians. As the extension's sample viewer has it: counter-clockwise where v points down.
    rotation: f32,
    scale: Vec2,
}

impl UvTransform {
    const NONE: Self = Self { offset: Vec2::ZERO, rotation: 0.0, scale: Vec2::ONE };

    pub(super) fn apply(&self, uv: Vec2) -> Vec2 {
        let (sin, cos) = self.rotation.sin_cos();
        let uv = uv * self.scale;
        Vec2::new(cos * uv.x + sin * uv.y, cos * uv.y - sin * uv.x) + self.offset
    }

    fn is_finite(&self) -> bool {
        self.offset.is_finite() && self.scale.is_finite() && self.rotation.is_finite()
    }
}

/// A material, and what is to be done to the uv coordinates of the meshes that wear it.
pub(super) struct Worn {
    pub(super) material: Material,
    pub(super) uv: UvTransform,
}

impl Worn {
    /// Where a primitive names no material.
    pub(super) fn default_material() -> Self {
        Self { material: Material { metallic: 1.0, ..Material::default() }, uv: UvTransform::NONE }
    }
}

/// All of a model's materials.
pub(super) fn materials(document: &mut Document, textures: &mut Textures) -> Result<Vec<Worn>> {
    (0..document.root.materials.len()).map(|index| material(document, textures, index)).collect()
}

fn material(document: &mut Document, textures: &mut Textures, index: usize) -> Result<Worn> {
    let json = document.get(&document.root.materials, index, "material")?.clone();
    let pbr = &json.pbr_metallic_roughness;
    let extensions = json.extensions.as_ref();
    let strength = extensions.and_then(|e| e.emissive_strength.as_ref()).map_or(1.0, |e| e.emissive_strength.0);
    let normal_scale = json.normal_texture.as_ref().map_or(1.0, |normal| normal.scale);
    let mut texture = |info: Option<usize>, srgb| info.map(|info| textures.get(document, info, srgb)).transpose();
    let material = Material {
        base_color: Vec4::from(pbr.base_color_factor.0).max(Vec4::ZERO),
        base_color_texture: texture(pbr.base_color_texture.as_ref().map(|info| info.index.value()), true)?,
        metallic: pbr.metallic_factor.0.clamp(0.0, 1.0),
        roughness: pbr.roughness_factor.0.clamp(0.0, 1.0),
        metallic_roughness_texture: texture(pbr.metallic_roughness_texture.as_ref().map(|info| info.index.value()), false)?,
        normal_texture: texture(json.normal_texture.as_ref().map(|info| info.index.value()), false)?,
        normal_scale,
        emissive: (Vec3::from(json.emissive_factor.0) * strength).max(Vec3::ZERO),
        emissive_texture: texture(json.emissive_texture.as_ref().map(|info| info.index.value()), true)?,
        alpha: alpha(&json, index, document)?,
        unlit: extensions.is_some_and(|e| e.unlit.is_some()),
        double_sided: json.double_sided,
        ..Material::default()
    };
    let numbers = [material.metallic, material.roughness, material.normal_scale];
    if !(material.base_color.is_finite() && material.emissive.is_finite() && numbers.iter().all(|x| x.is_finite())) {
        return Err(document.failure(format!("material {index} holds a number that is not finite")));
    }
    Ok(Worn { material, uv: uv_transform(document, &json, index)? })
}

fn alpha(json: &json::Material, index: usize, document: &mut Document) -> Result<AlphaMode> {
    match json.alpha_mode {
        Checked::Valid(JsonAlpha::Opaque) => Ok(AlphaMode::Opaque),
        Checked::Valid(JsonAlpha::Mask) => {
            Ok(AlphaMode::Mask { cutoff: json.alpha_cutoff.map_or(0.5, |cutoff| cutoff.0).clamp(0.0, 1.0) })
        }
        Checked::Valid(JsonAlpha::Blend) => {
            document.warn(format!("material {} blends; it is drawn opaque", named(index, json.name.as_deref())));
            Ok(AlphaMode::Opaque)
        }
        Checked::Invalid => Err(document.failure(format!("material {index} has an alphaMode that does not exist"))),
    }
}

fn named(index: usize, name: Option<&str>) -> String {
    name.map_or_else(|| index.to_string(), |name| format!("'{name}'"))
}

/// The one transform of all the material's textures. Vertices carry one set of uv coordinates, so others cannot be drawn.
fn uv_transform(document: &mut Document, json: &json::Material, index: usize) -> Result<UvTransform> {
    let infos = [
        ("/pbrMetallicRoughness/baseColorTexture", json.pbr_metallic_roughness.base_color_texture.as_ref().map(|t| t.tex_coord)),
        (
            "/pbrMetallicRoughness/metallicRoughnessTexture",
            json.pbr_metallic_roughness.metallic_roughness_texture.as_ref().map(|t| t.tex_coord),
        ),
        ("/normalTexture", json.normal_texture.as_ref().map(|t| t.tex_coord)),
        ("/emissiveTexture", json.emissive_texture.as_ref().map(|t| t.tex_coord)),
    ];
    let mut transforms = Vec::new();
    let mut other_sets = false;
    for (pointer, set) in infos {
        let Some(set) = set else { continue };
        let extension = document.raw.pointer(&format!("/materials/{index}{pointer}/extensions/KHR_texture_transform"));
        let overridden = extension.and_then(|e| e.get("texCoord")).and_then(Value::as_u64).unwrap_or(u64::from(set));
        other_sets |= overridden != 0;
        transforms.push(extension.map_or(UvTransform::NONE, read_transform));
    }
    let name = named(index, json.name.as_deref());
    if other_sets {
        document.warn(format!("material {name} asks for other texture coordinates than TEXCOORD_0; the first set is used"));
    }
    let first = transforms.first().copied().unwrap_or(UvTransform::NONE);
    if transforms.iter().any(|transform| *transform != first) {
        document.warn(format!("material {name} transforms its textures differently; all follow the first"));
    }
    if !first.is_finite() {
        return Err(document.failure(format!("material {index} has a texture transform that is not finite")));
    }
    Ok(first)
}

fn read_transform(extension: &Value) -> UvTransform {
    let number = |value: Option<&Value>, default: f64| value.and_then(Value::as_f64).unwrap_or(default) as f32;
    let pair = |key: &str, default: f64| {
        let at = |k: usize| number(extension.get(key).and_then(|pair| pair.get(k)), default);
        Vec2::new(at(0), at(1))
    };
    UvTransform { offset: pair("offset", 0.0), rotation: number(extension.get("rotation"), 0.0), scale: pair("scale", 1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uv_are_scaled_then_turned_then_shifted() {
        let transform =
            UvTransform { offset: Vec2::new(0.5, 0.25), rotation: std::f32::consts::FRAC_PI_2, scale: Vec2::new(2.0, 3.0) };
        assert!(transform.apply(Vec2::new(1.0, 0.0)).distance(Vec2::new(0.5, -1.75)) < 1e-6);
        assert!(transform.apply(Vec2::new(0.0, 1.0)).distance(Vec2::new(3.5, 0.25)) < 1e-6);
        assert_eq!(UvTransform::NONE.apply(Vec2::new(0.3, 0.7)), Vec2::new(0.3, 0.7));
    }
}
