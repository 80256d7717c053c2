//! SMAA's modes of several samples in a program that is not ours: it answers draws with pictures of its own.

use dejag::methods::Spec;
use dejag::pass::{Encoding, Extras, FrameFacts, Inputs, Pass, Recorder, Role, Surface};
use dejag::picture::Pixel;
use wgpu::{TextureFormat as Format, TextureView};

use super::creations::{alive, made};
use super::host::Host;
use super::picture::{SIZE, mirrored, ramp, shapes};

const MODES: [&str; 4] = ["smaa:mode=s2x", "smaa:mode=t2x", "smaa:mode=4x", "smaa:mode=4x,reproject=off"];
const CODED: Surface = Surface { format: Format::Rgba8Unorm, values: Encoding::Display };

/// A mode with a host's targets: two pictures that draws take turns in, and motion vectors.
struct Embedded<'h> {
    host: &'h Host,
    pass: Box<dyn Pass>,
    pictures: [TextureView; 2],
    motion: TextureView,
}

impl<'h> Embedded<'h> {
    /// Each draw gives one of two pictures; the motion is the same everywhere.
    fn new(
        host: &'h Host,
        spec: &str,
        size: [u32; 2],
        surfaces: [Surface; 2],
        pictures: [&[Pixel]; 2],
        motion_px: [f32; 2],
    ) -> Self {
        let moved = vec![[motion_px[0], motion_px[1], 0.0, 1.0]; (size[0] * size[1]) as usize];
        Self {
            host,
            pass: host.build(spec, size, surfaces),
            pictures: pictures.map(|pixels| host.picture(size, surfaces[0].format, pixels)),
            motion: host.picture(size, Format::Rgba32Float, &moved),
        }
    }

    /// One frame in an encoder of its own. The first is a cut.
    fn frame(&mut self, index: u32, output: &TextureView) {
        let mut encoder = self.host.encoder();
        let mut facts = FrameFacts { index, reset: index == 0, ..FrameFacts::default() };
        for k in 0.. {
            facts.jitter_px = [0.0; 2];
            let Some(draw) = self.pass.next_draw(k, &facts) else { break };
            assert_eq!((draw.jitters.len(), draw.samples), (1, 1));
            facts.jitter_px = draw.jitters[0].offset_px;
            let color = &self.pictures[(index + k) as usize % 2];
            let inputs = Inputs { motion: Some(&self.motion), frame: facts, ..Inputs::picture(color) };
            self.pass.record(&mut Recorder::new(&mut encoder), k, &inputs, output);
        }
        self.host.queue.submit([encoder.finish()]);
    }
}

#[test]
fn modes_say_what_they_take() {
    for (spec, [draws, frames], motion) in [
        ("smaa:mode=s2x", [2, 0], false),
        ("smaa:mode=t2x", [1, 1], true),
        ("smaa:mode=4x", [2, 1], true),
        ("smaa:mode=4x,reproject=off", [2, 1], false),
    ] {
        let needs = Spec::parse(spec).expect(spec).first_needs();
        assert_eq!((needs.role, needs.samples, needs.features), (Role::Draws(Encoding::Display), 1, wgpu::Features::empty()));
        assert_eq!((needs.samples_per_pixel, needs.frames_before), (draws, frames), "{spec}");
        assert_eq!(needs.extras, Extras { motion, ..Extras::default() }, "{spec}");
    }
    let plain = Spec::parse("smaa:mode=1x").expect("exists").first_needs();
    assert_eq!((plain.role, plain.samples_per_pixel, plain.frames_before), (Role::Filters(Encoding::Display), 1, 0));
    let extras = Spec::parse("smaa:mode=t2x,edges=ids").expect("exists").first_needs().extras;
    assert_eq!(extras, Extras { motion: true, ids: true, ..Extras::default() });
}

#[test]
fn frames_of_modes_make_nothing() {
    let host = Host::open();
    for spec in MODES {
        let (a, b) = (shapes(SIZE), mirrored(SIZE));
        let mut embedded = Embedded::new(&host, spec, SIZE, [CODED; 2], [&a, &b], [0.3, -1.6]);
        let outputs = [(); 3].map(|()| host.target(SIZE, CODED.format));
        let mut frames = |range: std::ops::Range<u32>| range.for_each(|i| embedded.frame(i, &outputs[i as usize % 3]));
        // A cut, then the first frame in either slot that has one before it.
        frames(0..3);
        host.wait();
        let before = alive(&host);
        assert_eq!(made(&host, || frames(3..51)), Vec::<&str>::new(), "{spec}");
        host.wait();
        assert_eq!(alive(&host), before, "{spec}");
        host.check(spec);
    }
}

/// Where every draw and every frame gives the same picture without edges, it goes through no arithmetic but the formats'.
#[test]
fn what_has_no_edges_passes_through() {
    let host = Host::open();
    let formats = [Format::Rgba8Unorm, Format::Bgra8Unorm, Format::Rgba8UnormSrgb, Format::Rgba16Float, Format::Rgba32Float];
    for spec in MODES {
        for size in [SIZE, [1, 1], [1, 17], [33, 2]] {
            for input in formats {
                for output in [input, Format::Bgra8UnormSrgb, Format::Rgba16Float] {
                    let pixels = ramp(size);
                    let surfaces = [input, output].map(Surface::display);
                    let mut embedded = Embedded::new(&host, spec, size, surfaces, [&pixels, &pixels], [0.0; 2]);
                    let target = host.target(size, output);
                    (0..3).for_each(|index| embedded.frame(index, &target));
                    let what = format!("{spec} {size:?} {input:?} to {output:?}");
                    host.check(&what);
                    let found = host.pixels(&target);
                    let off = found.iter().flatten().zip(pixels.iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
                    let same = input == output && !input.is_srgb();
                    assert!(off <= if same { 1e-3 / 255.0 + half_step(input) } else { 1.5 / 255.0 }, "{what}: {off}");
                }
            }
        }
    }
}

fn half_step(format: Format) -> f32 {
    if format == Format::Rgba16Float { 1.0 / 2048.0 } else { 0.0 }
}

/// Other formats give the same picture, as finely as they hold it.
#[test]
fn modes_are_the_same_in_every_format() {
    let host = Host::open();
    for spec in MODES {
        let (a, b) = (shapes(SIZE), mirrored(SIZE));
        let of = |input: Format, output: Format| {
            let mut embedded = Embedded::new(&host, spec, SIZE, [input, output].map(Surface::display), [&a, &b], [0.3, -1.6]);
            let target = host.target(SIZE, output);
            (0..3).for_each(|index| embedded.frame(index, &target));
            host.check(spec);
            host.pixels(&target)
        };
        let finest = of(Format::Rgba32Float, Format::Rgba32Float);
        for (input, output) in [
            (Format::Rgba8Unorm, Format::Rgba8Unorm),
            (Format::Bgra8UnormSrgb, Format::Rgba8Unorm),
            (Format::Rgb10a2Unorm, Format::Rgba16Float),
            (Format::Rgba16Float, Format::Bgra8UnormSrgb),
        ] {
            let found = of(input, output);
            let colors = found.iter().zip(&finest).flat_map(|(a, b)| (0..3).map(|c| (a[c] - b[c]).abs()));
            let (mut worst, mut sum) = (0.0_f32, 0.0_f32);
            colors.for_each(|off| (worst, sum) = (worst.max(off), sum + off));
            let mean = sum / (3 * finest.len()) as f32;
            println!("{spec} {input:?} to {output:?}: off by {:.2}/255, in the mean {:.3}", 255.0 * worst, 255.0 * mean);
            assert!(worst < 6.0 / 255.0 && mean < 0.5 / 255.0, "{spec} {input:?} to {output:?}: {worst}, {mean}");
        }
    }
}

/// What is no number shows in its own frame at most.
#[test]
fn what_is_no_number_leaves_no_trace() {
    let host = Host::open();
    let surface = Surface::display(Format::Rgba16Float);
    for spec in MODES {
        let clean = shapes(SIZE);
        let mut dirty = clean.clone();
        dirty[(SIZE[0] * 9 + 30) as usize] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1.0];
        let target = host.target(SIZE, surface.format);
        // By turns: two draws a frame see both pictures, else one frame is clean and one is not.
        let mut embedded = Embedded::new(&host, spec, SIZE, [surface; 2], [&clean, &dirty], [0.4, 0.7]);
        (0..3).for_each(|index| embedded.frame(index, &target));
        assert!(host.pixels(&target).iter().flatten().all(|value| value.is_finite()), "{spec}");
    }
}

/// Motion vectors that lead anywhere, or are no numbers.
#[test]
fn wild_motion_takes_nothing_from_the_frame_before() {
    let host = Host::open();
    let (a, b) = (shapes(SIZE), mirrored(SIZE));
    let target = host.target(SIZE, CODED.format);
    let frames = |motion_px: [f32; 2], count: u32| {
        let mut embedded = Embedded::new(&host, "smaa:mode=t2x,velocity_scale=0", SIZE, [CODED; 2], [&a, &b], motion_px);
        // A cut at 0; else the frame before is the other picture.
        (2 - count..2).for_each(|index| embedded.frame(index, &target));
        host.bytes(&target)
    };
    let alone = frames([0.0; 2], 1);
    for wild in [[1e9, 0.0], [0.0, -3e38], [f32::NAN, 0.0], [f32::INFINITY, f32::NEG_INFINITY], [0.0, 35.0], [-62.0, 0.5]] {
        assert!(frames(wild, 2) == alone, "{wild:?}");
    }
    assert!(frames([0.0; 2], 2) != alone);
}

/// A picture that has moved by whole pixels finds the one before bit for bit.
#[test]
fn whole_pixels_of_motion_are_exact() {
    const BY: [i32; 2] = [3, -2];
    let host = Host::open();
    let (before, target) = (shapes(SIZE), host.target(SIZE, CODED.format));
    let [width, height] = SIZE.map(|side| side as i32);
    let at = |x: i32, y: i32| before[(y.clamp(0, height - 1) * width + x.clamp(0, width - 1)) as usize];
    let now: Vec<Pixel> = (0..width * height).map(|i| at(i % width + BY[0], i / width + BY[1])).collect();
    let second = |pictures: [&[Pixel]; 2], motion_px: [f32; 2]| {
        let mut embedded = Embedded::new(&host, "smaa:mode=t2x,search=2,diag=4", SIZE, [CODED; 2], pictures, motion_px);
        (0..2).for_each(|index| embedded.frame(index, &target));
        host.pixels(&target)
    };
    let still = second([&now, &now], [0.0; 2]);
    // A history offset this near to a whole pixel is meant to be one.
    for near in [0.0, 0.0009, -0.0009] {
        let moved = second([&before, &now], BY.map(|by| by as f32 + near));
        // What lies within a search's reach of the border differs: beyond it there are no edges.
        let inside = |i: &i32| (10..width - 10).contains(&(i % width)) && (10..height - 10).contains(&(i / width));
        let same = (0..width * height).filter(inside).all(|i| moved[i as usize] == still[i as usize]);
        assert!(same, "{near}");
    }
}
