//! Materials, textures and procedural patterns: what a surface looks like.

use glam::{Vec3, Vec4};

/// A metallic-roughness surface, as in glTF 2.0 section 3.9.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Linear colour and opacity; multiplies the texture and the vertex colour.
    pub base_color: Vec4,
    /// sRGB-coded colour, linear opacity.
    pub base_color_texture: Option<TextureRef>,
    /// 0 dielectric to 1 metal; multiplies the texture's blue.
    pub metallic: f32,
    /// Perceptual roughness in [0, 1]; multiplies the texture's green.
    pub roughness: f32,
    /// Green: roughness, blue: metallic; linear.
    pub metallic_roughness_texture: Option<TextureRef>,
    /// Tangent-space normals, linear, y up.
    pub normal_texture: Option<TextureRef>,
    /// Scales the normal texture's x and y.
    pub normal_scale: f32,
    /// Linear light sent out, in scene units; not limited to 1.
    pub emissive: Vec3,
    /// sRGB-coded; multiplies `emissive`.
    pub emissive_texture: Option<TextureRef>,
    /// Opaque, or cut out by the opacity.
    pub alpha: AlphaMode,
    /// The base colour as it is, without light.
    pub unlit: bool,
    /// Draw back faces too, lit from their own side.
    pub double_sided: bool,
    /// Replaces or bends what the other fields say, per pattern.
    pub pattern: Pattern,
}

impl Default for Material {
    /// White, rough, opaque, lit.
    fn default() -> Self {
        Self {
            base_color: Vec4::ONE,
            base_color_texture: None,
            metallic: 0.0,
            roughness: 1.0,
            metallic_roughness_texture: None,
            normal_texture: None,
            normal_scale: 1.0,
            emissive: Vec3::ZERO,
            emissive_texture: None,
            alpha: AlphaMode::Opaque,
            unlit: false,
            double_sided: false,
            pattern: Pattern::None,
        }
    }
}

impl Material {
    /// Multiplies the light that it sends out by itself.
    pub(super) fn dim(&mut self, factor: f32) {
        self.emissive *= factor;
        if self.unlit {
            self.base_color = (self.base_color.truncate() * factor).extend(self.base_color.w);
            match &mut self.pattern {
                Pattern::Checker { other, .. } | Pattern::Stripes { other, .. } => *other *= factor,
                Pattern::Gradient { top } => *top *= factor,
                Pattern::None | Pattern::ZonePlate { .. } | Pattern::Bumps { .. } | Pattern::Leaf => {}
            }
        }
    }
}

/// What opacity does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AlphaMode {
    /// Opacity is ignored.
    Opaque,
    /// Drawn where the opacity is at least the cut-off in [0, 1], left out elsewhere.
    Mask {
        /// The least opacity that is drawn.
        cutoff: f32,
    },
}

/// A texture of the scene's list and which set of coordinates it follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct TextureRef {
    /// Index into [`super::Scene::textures`].
    pub texture: usize,
}

/// A picture on a surface. Mips are made when it is uploaded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Texture {
    /// Width in texels, at least 1.
    pub width: u32,
    /// Height in texels, at least 1.
    pub height: u32,
    /// Straight RGBA, 8 bits a channel, top row first.
    pub rgba8: Vec<u8>,
    /// Whether RGB is sRGB-coded.
    pub srgb: bool,
    /// Beyond [0, 1] along u and v.
    pub wrap: [Wrap; 2],
    /// Nearest texel instead of linear filtering when enlarged.
    pub nearest: bool,
    /// Most samples along the direction of anisotropy: 1 (none) to 16. More than 1 differs between drivers.
    pub anisotropy: u16,
}

/// What lies beyond a texture's border.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wrap {
    /// The texture again.
    Repeat,
    /// The texture mirrored.
    Mirror,
    /// The border's texel.
    Clamp,
}

/// A procedural pattern, a function of the surface's uv coordinates (metres along quads, see the shapes).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pattern {
    /// The material as it is.
    None,
    /// Squares of `cell` in uv units, alternating between the base colour and `other`.
    Checker {
        /// Side of a square in uv units, above 0.
        cell: f32,
        /// Linear colour of the odd squares.
        other: Vec3,
    },
    /// Stripes along v: the first `fill` of each `period` in u has the base colour, the rest `other`.
    Stripes {
        /// Width of a pair of stripes in uv units, above 0.
        period: f32,
        /// Part of the period that has the base colour, in (0, 1).
        fill: f32,
        /// Linear colour of the rest.
        other: Vec3,
    },
    /// Base colour times 0.5 + 0.5 cos(phase r^2), r the distance from uv (0, 0), one value for all channels.
    ZonePlate {
        /// In radians per squared uv unit.
        phase: f32,
    },
    /// Bends the normal by a sum of sines: fine bumps that make highlights glint.
    Bumps {
        /// Bumps per uv unit.
        frequency: f32,
        /// Steepest slope, 0 flat to about 2.
        slope: f32,
    },
    /// A pointed leaf in uv [0, 1]^2 as opacity, with a lighter vein along the middle; wants [`AlphaMode::Mask`].
    Leaf,
    /// Vertical blend in v from the base colour at v = 0 to `top` at v = 1: a sky.
    Gradient {
        /// Linear colour at v = 1.
        top: Vec3,
    },
}
