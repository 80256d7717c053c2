//! From what a scene file says about light and surfaces to the renderer's terms.

use glam::{DVec3, Vec3};

use super::document::{LightDoc, MaterialDoc, PatternDoc, ToneMapDoc};
use super::place::Place;
use super::values::Color;
use super::{AlphaMode, Light, Material, Pattern, ToneMap};
use crate::error::Result;

/// Colours are light: not negative, and far from what an f16 or an f32 cannot hold.
const BRIGHTEST: f64 = 1e6;

pub(super) fn color(color: Color, at: &Place<'_>) -> Result<Vec3> {
    for (channel, &value) in color.0.iter().enumerate() {
        at.item(channel).within(value, 0.0..=BRIGHTEST)?;
    }
    Ok(DVec3::from(color.0).as_vec3())
}

pub(super) fn tone_map(doc: ToneMapDoc) -> ToneMap {
    match doc {
        ToneMapDoc::Clamp => ToneMap::Clamp,
        ToneMapDoc::Reinhard => ToneMap::Reinhard,
        ToneMapDoc::Aces => ToneMap::Aces,
        ToneMapDoc::Agx => ToneMap::AgX,
    }
}

/// Without a `[light]` there is none.
pub(super) fn light(doc: Option<&LightDoc>, at: &Place<'_>) -> Result<Light> {
    let Some(doc) = doc else {
        return Ok(Light { to_light: Vec3::Y, color: Vec3::ZERO });
    };
    let (to_light, key) = match (doc.direction, doc.to_light) {
        (Some(direction), None) => (-DVec3::from(direction), "direction"),
        (None, Some(to_light)) => (DVec3::from(to_light), "to_light"),
        _ => return Err(at.error("expected the light to have either `direction` or `to_light`")),
    };
    let Some(to_light) = to_light.try_normalize().filter(|_| to_light.length() >= 1e-6) else {
        return Err(at.key(key).error("the light's direction has no length; expected a direction"));
    };
    let intensity = at.key("intensity").within(doc.intensity, 0.0..=BRIGHTEST)?;
    Ok(Light { to_light: to_light.as_vec3(), color: color(doc.color, &at.key("color"))? * intensity as f32 })
}

pub(super) fn material(doc: &MaterialDoc, at: &Place<'_>) -> Result<Material> {
    let unit = |key: &str, value: f64| at.key(key).within(value, 0.0..=1.0).map(|value| value as f32);
    let strength = at.key("emissive_strength").within(doc.emissive_strength, 0.0..=BRIGHTEST)?;
    Ok(Material {
        base_color: color(doc.color, &at.key("color"))?.extend(1.0),
        metallic: unit("metallic", doc.metallic)?,
        roughness: unit("roughness", doc.roughness)?,
        emissive: color(doc.emissive, &at.key("emissive"))? * strength as f32,
        alpha: match doc.cutoff {
            Some(cutoff) => AlphaMode::Mask { cutoff: unit("cutoff", cutoff)? },
            None => AlphaMode::Opaque,
        },
        unlit: doc.unlit,
        double_sided: doc.double_sided,
        pattern: doc.pattern.map_or(Ok(Pattern::None), |pattern| self::pattern(pattern, &at.key("pattern")))?,
        ..Material::default()
    })
}

fn pattern(doc: PatternDoc, at: &Place<'_>) -> Result<Pattern> {
    Ok(match doc {
        PatternDoc::Checker(doc) => {
            let at = at.key("checker");
            Pattern::Checker { cell: at.key("cell").positive(doc.cell)? as f32, other: color(doc.other, &at.key("other"))? }
        }
        PatternDoc::Stripes(doc) => {
            let at = at.key("stripes");
            Pattern::Stripes {
                period: at.key("period").positive(doc.period)? as f32,
                fill: at.key("fill").within(doc.fill, 0.001..=0.999)? as f32,
                other: color(doc.other, &at.key("other"))?,
            }
        }
        PatternDoc::ZonePlate(doc) => Pattern::ZonePlate { phase: at.key("zone_plate").key("phase").positive(doc.phase)? as f32 },
        PatternDoc::Bumps(doc) => {
            let at = at.key("bumps");
            Pattern::Bumps {
                frequency: at.key("frequency").positive(doc.frequency)? as f32,
                slope: at.key("slope").within(doc.slope, 0.0..=10.0)? as f32,
            }
        }
        PatternDoc::Leaf => Pattern::Leaf,
        PatternDoc::Gradient(doc) => Pattern::Gradient { top: color(doc.top, &at.key("gradient").key("top"))? },
    })
}
