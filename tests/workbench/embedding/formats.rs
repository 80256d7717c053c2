//! Every format in and out: the same picture, as finely as the coarser of the two holds it.

use dejag::pass::{Encoding, Surface};
use dejag::picture::Pixel;
use wgpu::TextureFormat as Format;

use super::host::Host;
use super::picture::{SIZE, ramp, shapes};

const FORMATS: [Format; 7] = [
    Format::Rgba8Unorm,
    Format::Rgba8UnormSrgb,
    Format::Bgra8Unorm,
    Format::Bgra8UnormSrgb,
    Format::Rgba16Float,
    Format::Rgb10a2Unorm,
    Format::Rgba32Float,
];

/// Those formats with display values in them.
fn displays() -> [Surface; 7] {
    FORMATS.map(Surface::display)
}

/// Light, as an engine draws it.
const LIGHT: Surface = Surface::linear(Format::Rgba16Float);

/// All pairs of those, and light to light, to a swap chain's usual format, and from it.
fn pairs() -> Vec<[Surface; 2]> {
    let swap_chain = Surface::display(Format::Bgra8UnormSrgb);
    let pairs = displays().into_iter().flat_map(|input| displays().map(|output| [input, output]));
    pairs.chain([[LIGHT, LIGHT], [LIGHT, swap_chain], [swap_chain, LIGHT]]).collect()
}

/// Whether the texture itself holds light: an `-srgb` one holds display values and only shows light to shaders.
fn holds_light(surface: Surface) -> bool {
    surface.values == Encoding::Linear && !surface.format.is_srgb()
}

fn coded(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

fn decoded(coded: f32) -> f32 {
    if coded <= 0.040_45 { coded / 12.92 } else { ((coded + 0.055) / 1.055).powf(2.4) }
}

/// The same picture, as a surface holds it; and back.
fn with_colors(pixels: &[Pixel], convert: fn(f32) -> f32) -> Vec<Pixel> {
    pixels.iter().map(|[r, g, b, a]| [convert(*r), convert(*g), convert(*b), *a]).collect()
}

/// How far colours and alphas may lie from the exact ones: half a step of the format that they are stored in, and what hardware
/// does in between.
fn bounds([input, output]: [Surface; 2]) -> [f32; 2] {
    let srgb = |surface: Surface, steps: f32| if surface.format.is_srgb() { steps / 255.0 } else { 0.0 };
    let [color, alpha] = match output.format {
        Format::Rgba16Float | Format::Rgba32Float => [0.0; 2],
        Format::Rgb10a2Unorm => [0.5 / 1023.0, 0.5 / 3.0],
        _ => [0.5 / 255.0; 2],
    };
    // Half floats on the way; lavapipe decodes 0.3 of a step beside the curve, and may code a tenth beside it.
    let halves = 0.2 / 255.0;
    [color + halves + srgb(input, 0.35) + srgb(output, 0.1), alpha + halves]
}

/// The picture filtered, in display values whatever the surface.
fn filtered(host: &Host, method: &str, surfaces: [Surface; 2]) -> Vec<Pixel> {
    let [input, output] = surfaces;
    let pixels = if holds_light(input) { with_colors(&shapes(SIZE), decoded) } else { shapes(SIZE) };
    let (color, target) = (host.picture(SIZE, input.format, &pixels), host.target(SIZE, output.format));
    host.run(host.build(method, SIZE, surfaces).as_mut(), &color, &target);
    let found = host.pixels(&target);
    if holds_light(output) { with_colors(&found, coded) } else { found }
}

/// Largest differences of colours and of alphas, `apart` pixels of the largest ones left out.
fn differences(a: &[Pixel], b: &[Pixel], apart: usize) -> [f32; 2] {
    let largest = |difference: fn(&Pixel, &Pixel) -> f32| {
        let mut all: Vec<f32> = a.iter().zip(b).map(|(a, b)| difference(a, b)).collect();
        all.sort_by(f32::total_cmp);
        all[all.len() - 1 - apart]
    };
    [largest(|a, b| (0..3).map(|c| (a[c] - b[c]).abs()).fold(0.0, f32::max)), largest(|a, b| (a[3] - b[3]).abs())]
}

/// One method over all pairs.
fn every_pair(method: &str) {
    let host = Host::open();
    let exact = filtered(&host, method, [Surface::display(Format::Rgba8Unorm), Surface::display(Format::Rgba32Float)]);
    let [color, alpha] = differences(&exact, &shapes(SIZE), 50);
    assert!(color > 0.1 && alpha > 0.05, "{method} changes the picture and its alpha: {color} {alpha}");
    // FXAA ends a search at a quarter of the edge's step, which on two flat colours is just what it meets half way between two
    // pixels: there the last bits of a luma decide, here at up to 33 pixels of 2135.
    let ties = if method == "fxaa" { 2 } else { 0 };
    let mut worst = 0.0_f32;
    for [input, output] in pairs() {
        let found = differences(&filtered(&host, method, [input, output]), &exact, ties);
        let most = bounds([input, output]);
        worst = worst.max(found[0] / most[0]);
        assert!(found[0] <= most[0] && found[1] <= most[1], "{method}, {input:?} to {output:?}: {found:?} over {most:?}");
    }
    println!("{method}: {worst:.2} of what formats may differ by");
}

/// A picture without edges goes through bit by bit, between formats that are the same.
fn no_edges(method: &str) {
    let host = Host::open();
    for surface in displays().into_iter().chain([LIGHT]) {
        let pixels = if holds_light(surface) { with_colors(&ramp(SIZE), decoded) } else { ramp(SIZE) };
        let color = host.picture(SIZE, surface.format, &pixels);
        let target = host.target(SIZE, surface.format);
        host.run(host.build(method, SIZE, [surface; 2]).as_mut(), &color, &target);
        let expected = dejag::gpu::encode_texels(surface.format, &pixels).expect("a picture's format");
        assert!(host.bytes(&target) == expected, "{method}, {surface:?}");
    }
}

/// A test for each filter, so that they run beside each other; the last makes sure that none is missing.
macro_rules! for_each_filter {
    ($($method:ident),*) => {
        mod pairs {
            $(#[test] fn $method() { super::every_pair(stringify!($method)); })*
        }
        mod without_edges {
            $(#[test] fn $method() { super::no_edges(stringify!($method)); })*
        }
        #[test]
        fn no_filter_is_missing() {
            assert_eq!(super::filters(), [$(stringify!($method)),*]);
        }
    };
}

for_each_filter!(fxaa, mlaa, smaa, cmaa2);
