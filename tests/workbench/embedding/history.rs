//! `taa` in a program that is not ours: jitter, motion, the previous camera and resets come from outside.

use dejag::methods::Spec;
use dejag::pass::{Encoding, FrameFacts, Inputs, Pass, Recorder, Role, Surface};
use dejag::picture::Pixel;
use wgpu::{TextureFormat as Format, TextureUsages as Usages, TextureView};

use super::creations::{alive, made};
use super::host::Host;
use super::picture::{SIZE, mirrored, shapes};

const LIGHT: Surface = Surface::linear(Format::Rgba16Float);

/// Presets, and options that read other inputs.
const SPECS: [&str; 5] = [
    "taa:preset=fast",
    "taa",
    "taa:preset=quality",
    "taa:reject=depth,background=camera,storage=fp32",
    "taa:fallback=smaa,sharpen=0.5",
];

/// A pass with a host's own targets: two pictures by turns, and what lies beside them, the same everywhere.
struct Embedded<'h> {
    host: &'h Host,
    pass: Box<dyn Pass>,
    pictures: [TextureView; 2],
    motion: TextureView,
    depth: TextureView,
    ids: TextureView,
    previous_clip_from_clip: [[f32; 4]; 4],
    /// The draws that were asked for.
    jitters_px: Vec<[f32; 2]>,
}

impl<'h> Embedded<'h> {
    fn new(host: &'h Host, spec: &str, surfaces: [Surface; 2], motion_px: [f32; 2]) -> Self {
        let moved = vec![[motion_px[0], motion_px[1], 0.0, 1.0]; (SIZE[0] * SIZE[1]) as usize];
        let beside = |format| {
            let texture = host.texture(SIZE, format, Usages::TEXTURE_BINDING | Usages::RENDER_ATTACHMENT);
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        Self {
            host,
            pass: host.build(spec, SIZE, surfaces),
            pictures: [shapes(SIZE), mirrored(SIZE)].map(|pixels| picture(host, surfaces[0].format, &pixels)),
            motion: host.picture(SIZE, Format::Rgba16Float, &moved),
            // Never drawn to: zeroes, the background.
            depth: beside(Format::Depth32Float),
            ids: beside(Format::R32Uint),
            previous_clip_from_clip: FrameFacts::default().previous_clip_from_clip,
            jitters_px: Vec::new(),
        }
    }

    /// One frame in an encoder and a submission of its own.
    fn frame(&mut self, index: u32, reset: bool, output: &TextureView) {
        let mut encoder = self.host.encoder();
        let previous_clip_from_clip = self.previous_clip_from_clip;
        let mut facts = FrameFacts { index, reset, previous_clip_from_clip, ..FrameFacts::default() };
        for k in 0.. {
            facts.jitter_px = [0.0; 2];
            let Some(draw) = self.pass.next_draw(k, &facts) else { break };
            assert_eq!((draw.jitters.len(), draw.samples), (1, 1));
            facts.jitter_px = draw.jitters[0].offset_px;
            self.jitters_px.push(facts.jitter_px);
            let inputs = Inputs {
                motion: Some(&self.motion),
                depth: Some(&self.depth),
                ids: Some(&self.ids),
                signature: None,
                frame: facts,
                ..Inputs::picture(&self.pictures[index as usize % 2])
            };
            self.pass.record(&mut Recorder::new(&mut encoder), k, &inputs, output);
        }
        self.host.queue.submit([encoder.finish()]);
    }
}

/// A picture in a format that an engine draws light in.
fn picture(host: &Host, format: Format, pixels: &[Pixel]) -> TextureView {
    if format != Format::Rg11b10Ufloat {
        return host.picture(SIZE, format, pixels);
    }
    let texture = host.texture(SIZE, format, Usages::TEXTURE_BINDING | Usages::COPY_DST);
    let bytes: Vec<u8> = pixels.iter().flat_map(|pixel| packed_floats(*pixel).to_le_bytes()).collect();
    host.write(texture.as_image_copy(), SIZE, &bytes);
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// Red and green with 6 bits after the point, blue with 5: the upper bits of halves, cut off.
fn packed_floats([r, g, b, _]: Pixel) -> u32 {
    let cut = |value: f32, bits: u32| u32::from(half::f16::from_f32(value).to_bits()) >> (15 - bits);
    cut(r, 11) | cut(g, 11) << 11 | cut(b, 10) << 22
}

#[test]
fn taa_says_what_it_takes() {
    for (spec, [depth, ids]) in [
        ("taa:dilation=off,reject=off", [false, false]),
        ("taa:dilation=off,reject=ids", [false, true]),
        ("taa:dilation=full,reject=off", [true, false]),
        ("taa:dilation=off,reject=depth", [true, false]),
    ] {
        let needs = Spec::parse(spec).expect(spec).first_needs();
        assert_eq!((needs.role, needs.output), (Role::Draws(Encoding::Linear), Encoding::Linear), "{spec}");
        assert_eq!((needs.samples, needs.samples_per_pixel, needs.features), (1, 1, wgpu::Features::empty()), "{spec}");
        assert_eq!((needs.extras.motion, needs.extras.depth, needs.extras.ids), (true, depth, ids), "{spec}");
        assert!(needs.frames_before > 0, "{spec}");
    }
}

#[test]
fn frames_with_history_make_nothing() {
    let host = Host::open();
    for spec in SPECS {
        let mut embedded = Embedded::new(&host, spec, [LIGHT; 2], [0.3, -1.6]);
        // One picture: the pass takes turns with its history, the host with its outputs.
        embedded.pictures[1] = embedded.pictures[0].clone();
        let outputs = [(); 3].map(|()| host.target(SIZE, LIGHT.format));
        let mut frames =
            |range: std::ops::Range<u32>| range.for_each(|i| embedded.frame(i, i % 20 == 0, &outputs[i as usize % 3]));
        // One for each of the two histories.
        frames(0..2);
        host.wait();
        let before = alive(&host);
        assert_eq!(made(&host, || frames(2..50)), Vec::<&str>::new(), "{spec}");
        host.wait();
        assert_eq!(alive(&host), before, "{spec}");
        host.check(spec);
    }
}

/// Jitters are asked for by the frame's index alone, and repeat.
#[test]
fn jitters_follow_the_index() {
    let host = Host::open();
    let target = host.target(SIZE, LIGHT.format);
    let asked = |from: u32| {
        let mut embedded = Embedded::new(&host, "taa:cycle=4", [LIGHT; 2], [0.0; 2]);
        (from..from + 8).for_each(|index| embedded.frame(index, index == from, &target));
        embedded.jitters_px
    };
    let (found, later) = (asked(0), asked(6));
    assert_eq!(found[..4], found[4..]);
    assert_eq!(later[..6], [&found[2..4], &found[..4]].concat()[..]);
    assert!(found.iter().all(|[x, y]| x.abs() <= 0.5 && y.abs() <= 0.5) && found[0] != found[1], "{found:?}");
}

/// What a program draws light in, and what it shows.
#[test]
fn taa_takes_and_gives_every_format() {
    let host = Host::open();
    for spec in SPECS {
        let of = |input: Format, output: Surface| {
            let mut embedded = Embedded::new(&host, spec, [Surface::linear(input), output], [0.3, -1.6]);
            let target = host.target(SIZE, output.format);
            (0..4).for_each(|index| embedded.frame(index, index == 0, &target));
            host.check(spec);
            let pixels = host.pixels(&target);
            if output.format.is_srgb() { pixels.iter().map(|pixel| pixel.map(decoded)).collect() } else { pixels }
        };
        let finest = of(Format::Rgba32Float, Surface::linear(Format::Rgba32Float));
        for (input, output, most) in [
            (Format::Rgba16Float, LIGHT, 2.0 / 1024.0),
            (Format::Rgba32Float, Surface::display(Format::Rgba8UnormSrgb), 2.0 / 255.0),
            (Format::Rgba16Float, Surface::display(Format::Bgra8UnormSrgb), 2.0 / 255.0),
            // 1/32 is a step of blue.
            (Format::Rg11b10Ufloat, LIGHT, 1.0 / 32.0),
            (Format::Rg11b10Ufloat, Surface::display(Format::Rgba8UnormSrgb), 1.0 / 32.0 + 1.0 / 255.0),
        ] {
            let found = of(input, output);
            let off = |a: &Pixel, b: &Pixel| (0..3).map(|c| (a[c] - b[c]).abs()).fold(0.0, f32::max);
            let mut all: Vec<f32> = found.iter().zip(&finest).map(|(a, b)| off(a, b)).collect();
            all.sort_by(f32::total_cmp);
            // Where an edge is just met or just missed by the fallback, formats decide.
            let worst = all[all.len() - 1 - all.len() / 200];
            println!("{spec}, {input:?} to {:?}: off by {worst:.5} of {most:.5}", output.format);
            assert!(worst <= most, "{spec}, {input:?} to {output:?}: {worst}");
        }
    }
}

fn decoded(coded: f32) -> f32 {
    if coded <= 0.040_45 { coded / 12.92 } else { ((coded + 0.055) / 1.055).powf(2.4) }
}

/// A reset shows what a pass that has seen nothing shows.
#[test]
fn a_reset_forgets() {
    let host = Host::open();
    let target = host.target(SIZE, LIGHT.format);
    for spec in SPECS {
        let last = |first: u32, cut: u32| {
            let mut embedded = Embedded::new(&host, spec, [LIGHT; 2], [0.3, -1.6]);
            (first..6).for_each(|index| embedded.frame(index, index == cut, &target));
            host.bytes(&target)
        };
        // The first frame of a pass has nothing to forget, said or not.
        assert!(last(0, 4) == last(4, 4) && last(4, 4) == last(4, 99), "{spec}");
        assert!(last(0, 0) != last(4, 4), "{spec}: the frames before are seen");
    }
}

/// The background of a program whose motion vectors only hold surfaces moves as its camera does.
#[test]
fn the_previous_camera_moves_the_background() {
    let host = Host::open();
    let target = host.target(SIZE, LIGHT.format);
    let second = |spec: &str, motion_px: [f32; 2], camera_px: f32| {
        let mut embedded = Embedded::new(&host, spec, [LIGHT; 2], motion_px);
        embedded.frame(0, true, &target);
        embedded.previous_clip_from_clip[3][0] = 2.0 * camera_px / SIZE[0] as f32;
        embedded.frame(1, false, &target);
        host.bytes(&target)
    };
    let by_camera = |camera_px| second("taa:background=camera", [0.0; 2], camera_px);
    assert!(by_camera(4.0) == second("taa", [4.0, 0.0], 0.0) && by_camera(4.0) != by_camera(0.0));
}

/// Motion vectors that lead anywhere, or are no numbers.
#[test]
fn wild_motion_takes_nothing_from_history() {
    let host = Host::open();
    let target = host.target(SIZE, LIGHT.format);
    for spec in SPECS {
        for wild in [[1e9, 0.0], [0.0, -3e38], [f32::NAN, 0.0], [f32::INFINITY, f32::NEG_INFINITY], [0.0, 35.0], [-62.0, 0.5]] {
            let mut embedded = Embedded::new(&host, spec, [LIGHT; 2], wild);
            (0..3).for_each(|index| embedded.frame(index, index == 0, &target));
            assert!(host.pixels(&target).iter().flatten().all(|value| value.is_finite()), "{spec}, {wild:?}");
        }
        host.check(spec);
    }
}
