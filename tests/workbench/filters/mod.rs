//! Filters held against what must be true of any picture, and against what their options say of themselves.
//!
//! Every filter of the registry is meant, with its defaults and with its strongest preset: a new one is tested by being there.

mod blending;
mod borders;
mod flat;
mod hard_values;
mod knobs;
mod picture;
mod repeats;
mod sizes;
mod symmetry;

use dejag::capture::PictureFilter;
use dejag::gpu::Gpu;
use dejag::methods::{METHODS, Spec};
use dejag::pass::{Encoding, Extras, Kind, Method, Role, Surface};
use half::f16;
use wgpu::TextureFormat;

use picture::Picture;

/// The registry's filters that a picture is enough for.
fn filters() -> Vec<&'static Method> {
    let takes_a_picture = |method: &&Method| {
        let needs = Spec::parse(method.name).expect(method.name).first_needs();
        matches!(needs.role, Role::Filters(_)) && needs.extras == Extras::default()
    };
    METHODS.iter().filter(takes_a_picture).collect()
}

/// Each filter as it is without options, and with its strongest preset if it has any.
fn specs() -> Vec<String> {
    let has_ultra = |method: &Method| {
        let of_preset = method.options.iter().find(|option| option.name == "preset");
        of_preset.is_some_and(|option| matches!(option.kind, Kind::Choice(names) if names().contains(&"ultra")))
    };
    let mut specs = Vec::new();
    for method in filters() {
        specs.push(method.name.to_owned());
        if has_ultra(method) {
            specs.push(format!("{}:preset=ultra", method.name));
        }
    }
    assert!(specs.len() >= 7, "{specs:?}");
    specs
}

fn eight_bit() -> Surface {
    Surface::display(TextureFormat::Rgba8Unorm)
}

fn half_float() -> Surface {
    Surface::display(TextureFormat::Rgba16Float)
}

fn float() -> Surface {
    Surface::display(TextureFormat::Rgba32Float)
}

fn linear_light() -> Surface {
    Surface::linear(TextureFormat::Rgba16Float)
}

/// A filter on pictures of one size and surface.
struct Filter<'g> {
    name: String,
    surface: Surface,
    built: PictureFilter<'g>,
}

impl<'g> Filter<'g> {
    fn new(gpu: &'g Gpu, spec: &str, size: [u32; 2], surface: Surface) -> Self {
        let built = PictureFilter::new(gpu, &Spec::parse(spec).expect(spec), size, surface);
        let values = if surface.values == Encoding::Linear { " linear" } else { "" };
        let name = format!("{spec} {:?}{values} {}x{}", surface.format, size[0], size[1]);
        Self { built: built.unwrap_or_else(|error| panic!("{name}: {error}")), name, surface }
    }

    fn apply(&mut self, picture: &Picture) -> Picture {
        let pixels = self.built.apply(&picture.pixels).unwrap_or_else(|error| panic!("{}: {error}", self.name));
        assert_eq!(pixels.len(), picture.pixels.len(), "{}", self.name);
        Picture { size: picture.size, pixels }
    }

    /// What the surface holds of a picture.
    fn stored(&self, picture: &Picture) -> Picture {
        let format = self.surface.format;
        let channel = |value: f32| match format {
            TextureFormat::Rgba8Unorm => (value.clamp(0.0, 1.0) * 255.0).round() / 255.0,
            TextureFormat::Rgba16Float => f16::from_f32(value).to_f32(),
            _ => value,
        };
        Picture { size: picture.size, pixels: picture.pixels.iter().map(|pixel| pixel.map(channel)).collect() }
    }

    /// The distance between two neighbouring values of the surface, as far as arithmetic is exact: in f32 it is not.
    fn step(&self, value: f32) -> f32 {
        match self.surface.format {
            TextureFormat::Rgba8Unorm => 1.0 / 255.0,
            // Below the smallest normal number steps do not shrink any more.
            TextureFormat::Rgba16Float => value.abs().max(6.2e-5) / 1024.0,
            _ => value.abs() * 1e-5 + 1e-6,
        }
    }
}
