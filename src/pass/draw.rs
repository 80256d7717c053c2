//! What a pass asks its host to draw.

/// One request to draw the scene. The default is a plain draw: one sample at the pixel's centre.
#[derive(Debug, Clone)]
pub struct Draw {
    /// Where each pixel is sampled. More than one only with [`Target::Sum`].
    pub jitters: Vec<Jitter>,
    /// Hardware samples a pixel.
    pub samples: u32,
    /// Draw only where it says so; elsewhere the target keeps the clear colour, or with [`Target::Sum`] what it holds.
    pub mask: Option<Mask>,
    /// Mark in this r8uint texture, with 1, every pixel that an edge of the geometry may touch: silhouettes, borders and creases that
    /// are not behind what was drawn. Only with one sample and without a sum. A host that cannot leaves the texture as it is, all 0.
    pub outline: Option<wgpu::TextureView>,
    /// Whether alpha-tested surfaces write their opacity as coverage. Needs several samples.
    pub alpha_to_coverage: bool,
    /// When in the frame's interval the scene is seen: 0 at the frame's own moment, -0.5 and 0.5 half an interval around it.
    pub time: f32,
    /// Where it goes.
    pub target: Target,
}

impl Default for Draw {
    fn default() -> Self {
        Self {
            jitters: vec![Jitter::CENTRE],
            samples: 1,
            mask: None,
            outline: None,
            alpha_to_coverage: false,
            time: 0.0,
            target: Target::Input,
        }
    }
}

/// Which pixels a draw is for: those where a texture has any of some bits, so that one texture serves many draws.
#[derive(Debug, Clone)]
pub struct Mask {
    /// An r8uint or r32uint texture of the picture's size.
    pub view: wgpu::TextureView,
    /// Which of its bits count; none of them forbids every pixel.
    pub bits: u32,
}

impl Mask {
    /// Every pixel where the texture is not 0.
    #[must_use]
    pub const fn non_zero(view: wgpu::TextureView) -> Self {
        Self { view, bits: u32::MAX }
    }
}

/// A sample's place in every pixel and its weight in a sum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jitter {
    /// From the pixel's centre in pixels, y down: the geometry moves the other way.
    pub offset_px: [f32; 2],
    /// Factor in a [`Target::Sum`]; elsewhere it has no meaning.
    pub weight: f32,
}

impl Jitter {
    /// The pixel's centre, weight 1.
    pub const CENTRE: Self = Self { offset_px: [0.0; 2], weight: 1.0 };
}

/// Where a draw goes.
#[derive(Debug, Clone)]
pub enum Target {
    /// Into the host's own target, handed to the pass as its input.
    Input,
    /// Straight into the output: the pass has nothing to add.
    Output,
    /// Added to a sum, weight by weight.
    Sum(Sum),
}

/// A sum of weighted draws: for each jitter, every drawn pixel (background included) gains weight times (red, green, blue, 1).
#[derive(Debug, Clone)]
pub struct Sum {
    /// An rgba32float texture of the pass.
    pub view: wgpu::TextureView,
    /// Set it to zero first.
    pub clear: bool,
}
