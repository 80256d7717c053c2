//! A toy method of two rounds, the second drawing only where a mask of its own says: what adaptive methods will do.
//!
//! It uses nothing but the crate's public contract, so it also shows that a method can be written outside the crate.

use dejag::capture::{Capture, Studio};
use dejag::methods::Spec;
use dejag::pass::{
    Context, Draw, Encoding, Extras, FrameFacts, Inputs, Jitter, Mask, Needs, Pass, Recorder, Role, Sum, Target, Technique,
};
use dejag::scene::{Scene, Tick};
use wgpu::TextureFormat as Format;

use crate::common;

const SIZE: [u32; 2] = [61, 35];

/// Those of `ssaa:spp=4,pattern=rotated`.
const JITTERS: [Jitter; 4] = [
    Jitter { offset_px: [-0.125, -0.375], weight: 1.0 },
    Jitter { offset_px: [0.375, -0.125], weight: 1.0 },
    Jitter { offset_px: [-0.375, 0.125], weight: 1.0 },
    Jitter { offset_px: [0.125, 0.375], weight: 1.0 },
];

/// What the mask holds inside; elsewhere it has two other bits.
const INSIDE: u32 = 2;

/// The mask: a disk in the middle of the picture, so that it cuts through edges and flat parts alike.
fn in_mask(x: u32, y: u32) -> bool {
    let from_middle = |i: u32, n: u32| i64::from(2 * i + 1) - i64::from(n);
    from_middle(x, SIZE[0]).pow(2) + from_middle(y, SIZE[1]).pow(2) < i64::from(SIZE[1]).pow(2)
}

const SHADER: &str = "
@vertex fn vs(@builtin(vertex_index) i: u32) -> @builtin(position) vec4<f32> {
    return vec4<f32>(4.0 * f32(i & 1u) - 1.0, 4.0 * f32(i >> 1u) - 1.0, 0.0, 1.0);
}
fn masked(p: vec2<i32>, size: vec2<i32>) -> bool {
    let d = 2 * p + 1 - size;
    return dot(d, d) < size.y * size.y;
}
@group(0) @binding(0) var first: texture_2d<f32>;
@group(0) @binding(1) var sum: texture_2d<f32>;
@fragment fn fs_mask(@builtin(position) p: vec4<f32>) -> @location(0) vec4<u32> {
    return vec4<u32>(select(5u, 2u, masked(vec2<i32>(p.xy), vec2<i32>(textureDimensions(first)))));
}
@fragment fn fs_copy(@builtin(position) p: vec4<f32>) -> @location(0) vec4<f32> {
    return textureLoad(first, vec2<i32>(p.xy), 0);
}
@fragment fn fs_merge(@builtin(position) p: vec4<f32>) -> @location(0) vec4<f32> {
    let total = textureLoad(sum, vec2<i32>(p.xy), 0);
    if total.a == 0.0 { return textureLoad(first, vec2<i32>(p.xy), 0); }
    return vec4<f32>(total.rgb / total.a, 1.0);
}";

/// What the second round does inside the mask.
#[derive(Debug, Clone, Copy, PartialEq)]
enum TwoRounds {
    /// Four jitters into a sum, merged with the first round's picture.
    Sum,
    /// A plain draw, shown as it is.
    Plain,
}

impl TwoRounds {
    /// Masks are of either.
    fn mask_format(self) -> Format {
        match self {
            Self::Sum => Format::R8Uint,
            Self::Plain => Format::R32Uint,
        }
    }
}

impl Technique for TwoRounds {
    fn needs(&self) -> Needs {
        Needs { wide_output: true, features: wgpu::Features::FLOAT32_BLENDABLE, samples_per_pixel: 5, ..Needs::default() }
    }

    fn build(&self, context: &Context<'_>) -> dejag::Result<Box<dyn Pass>> {
        let texture = |format| {
            let [width, height] = context.size;
            let texture = context.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("two rounds"),
                size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                    | wgpu::TextureUsages::TEXTURE_BINDING
                    | wgpu::TextureUsages::COPY_SRC,
                view_formats: &[],
            });
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        Ok(Box::new(TwoRoundsPass {
            second: *self,
            device: context.device.clone(),
            mask: texture(self.mask_format()),
            first: texture(context.input.format),
            sum: texture(Format::Rgba32Float),
            fill_mask: pipeline(context.device, "fs_mask", self.mask_format()),
            copy: pipeline(context.device, "fs_copy", context.input.format),
            show: pipeline(context.device, "fs_copy", context.output.format),
            merge: pipeline(context.device, "fs_merge", context.output.format),
        }))
    }
}

fn pipeline(device: &wgpu::Device, fragment: &str, format: Format) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("two rounds"),
        source: wgpu::ShaderSource::Wgsl(SHADER.into()),
    });
    let options = wgpu::PipelineCompilationOptions::default;
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(fragment),
        layout: None,
        vertex: wgpu::VertexState { module: &module, entry_point: Some("vs"), compilation_options: options(), buffers: &[] },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(fragment),
            compilation_options: options(),
            targets: &[Some(format.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

#[derive(Debug)]
struct TwoRoundsPass {
    second: TwoRounds,
    device: wgpu::Device,
    mask: wgpu::TextureView,
    first: wgpu::TextureView,
    sum: wgpu::TextureView,
    fill_mask: wgpu::RenderPipeline,
    copy: wgpu::RenderPipeline,
    show: wgpu::RenderPipeline,
    merge: wgpu::RenderPipeline,
}

impl TwoRoundsPass {
    fn screen(
        &self,
        recorder: &mut Recorder<'_>,
        pipeline: &wgpu::RenderPipeline,
        inputs: &[(u32, &wgpu::TextureView)],
        to: &wgpu::TextureView,
    ) {
        let entries: Vec<_> = inputs
            .iter()
            .map(|(binding, view)| wgpu::BindGroupEntry { binding: *binding, resource: wgpu::BindingResource::TextureView(view) })
            .collect();
        let layout = pipeline.get_bind_group_layout(0);
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries });
        screen(recorder, pipeline, &group, to);
    }
}

fn screen(recorder: &mut Recorder<'_>, pipeline: &wgpu::RenderPipeline, group: &wgpu::BindGroup, to: &wgpu::TextureView) {
    let attachment = wgpu::RenderPassColorAttachment {
        view: to,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store },
    };
    let descriptor =
        wgpu::RenderPassDescriptor { label: Some("toy"), color_attachments: &[Some(attachment)], ..Default::default() };
    recorder.render(&descriptor, |pass| {
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.draw(0..3, 0..1);
    });
}

impl Pass for TwoRoundsPass {
    fn next_draw(&mut self, k: u32, _: &FrameFacts) -> Option<Draw> {
        let mask = Some(Mask { view: self.mask.clone(), bits: INSIDE });
        match (k, self.second) {
            (0, _) => Some(Draw::default()),
            (1, TwoRounds::Sum) => {
                let sum = Sum { view: self.sum.clone(), clear: true };
                Some(Draw { jitters: JITTERS.to_vec(), mask, target: Target::Sum(sum), ..Draw::default() })
            }
            (1, TwoRounds::Plain) => Some(Draw { mask, ..Draw::default() }),
            _ => None,
        }
    }

    fn record(&mut self, recorder: &mut Recorder<'_>, k: u32, inputs: &Inputs<'_>, output: &wgpu::TextureView) {
        match (k, self.second) {
            (0, _) => {
                self.screen(recorder, &self.copy, &[(0, inputs.color)], &self.first);
                self.screen(recorder, &self.fill_mask, &[(0, inputs.color)], &self.mask);
            }
            (_, TwoRounds::Sum) => self.screen(recorder, &self.merge, &[(0, &self.first), (1, &self.sum)], output),
            (_, TwoRounds::Plain) => self.screen(recorder, &self.show, &[(0, inputs.color)], output),
        }
    }

    fn views(&self) -> &'static [&'static str] {
        &["sum"]
    }

    fn view(&mut self, _: &mut Recorder<'_>, name: &str) -> Option<wgpu::TextureView> {
        (name == "sum").then(|| self.sum.clone())
    }
}

fn capture(studio: &mut Studio<'_>, technique: &dyn Technique) -> Capture {
    let mut shot = studio.shot_of(&[("toy", technique)], 0, SIZE, Extras::default()).expect("builds");
    studio.take(&mut shot, None, &mut ()).expect("draws");
    studio.read(&shot).expect("reads")
}

fn by_name(studio: &mut Studio<'_>, method: &str) -> Capture {
    studio.capture(&Spec::parse(method).expect("exists"), 0, SIZE, &mut ()).expect("draws")
}

const SCENES: [&str; 3] = ["edges", "fence", "foliage"];

#[test]
fn the_second_round_draws_only_where_the_mask_says() {
    let gpu = common::gpu();
    for name in SCENES {
        let scene = Scene::load(name).expect("shipped");
        let mut studio = Studio::new(&gpu, &scene).expect("uploads");
        let toy = capture(&mut studio, &TwoRounds::Sum).linear.expect("linear");
        let none = by_name(&mut studio, "none").linear.expect("linear");
        let four = by_name(&mut studio, "ssaa:spp=4,pattern=rotated").linear.expect("linear");
        let (mut differing, mut inside) = (0, 0);
        for y in 0..SIZE[1] {
            for x in 0..SIZE[0] {
                if in_mask(x, y) {
                    inside += 1;
                    differing += u32::from(toy.pixel(x, y) != none.pixel(x, y));
                    // The same four samples, summed in another order.
                    let error = (0..3).map(|c| (toy.pixel(x, y)[c] - four.pixel(x, y)[c]).abs()).fold(0.0, f32::max);
                    assert!(error < 1e-5, "{name} at {x},{y}: {error}");
                } else {
                    assert_eq!(toy.pixel(x, y), none.pixel(x, y), "{name} at {x},{y}, outside the mask");
                }
            }
        }
        assert!(inside > 900 && differing > 20, "{name}: the second round changed {differing} of {inside} pixels");
    }
}

#[test]
fn a_masked_plain_draw_leaves_the_clear_colour_elsewhere() {
    let gpu = common::gpu();
    let scene = Scene::load("fence").expect("shipped");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    let toy = capture(&mut studio, &TwoRounds::Plain).linear.expect("linear");
    let none = by_name(&mut studio, "none").linear.expect("linear");
    let background = scene.background.to_array();
    for y in 0..SIZE[1] {
        for x in 0..SIZE[0] {
            let found = toy.pixel(x, y);
            if in_mask(x, y) {
                assert_eq!(found, none.pixel(x, y), "{x},{y}");
            } else {
                assert!((0..3).all(|c| (found[c] - background[c]).abs() < 1e-3), "{x},{y}: {found:?}");
            }
        }
    }
}

#[test]
fn outside_the_mask_nothing_is_added() {
    let gpu = common::gpu();
    let scene = Scene::load("edges").expect("shipped");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    let mut shot = studio.shot_of(&[("toy", &TwoRounds::Sum)], 0, SIZE, Extras::default()).expect("builds");
    studio.take(&mut shot, None, &mut ()).expect("draws");
    let sum = shot.view(&gpu, "sum").expect("there is one");
    let sum = gpu.read_linear(sum.texture()).expect("reads");
    for y in 0..SIZE[1] {
        for x in 0..SIZE[0] {
            let weight = if in_mask(x, y) { 4.0 } else { 0.0 };
            assert_eq!(sum.pixel(x, y)[3], weight, "{x},{y}");
        }
    }
}

#[test]
fn taking_a_shot_again_gives_the_same_bits() {
    let gpu = common::gpu();
    let scene = Scene::load("foliage").expect("shipped");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    let mut shot = studio.shot_of(&[("toy", &TwoRounds::Sum)], 0, SIZE, Extras::default()).expect("builds");
    let mut take = || {
        studio.take(&mut shot, None, &mut ()).expect("draws");
        studio.read(&shot).expect("reads").linear
    };
    assert!(take() == take());
}

/// A filter that passes its picture on, and checks that it is given what it asks for.
#[derive(Debug, Clone, Copy)]
struct Echo {
    takes: Encoding,
    extras: Extras,
    expects_samples: bool,
}

impl Technique for Echo {
    fn needs(&self) -> Needs {
        Needs { role: Role::Filters(self.takes), output: self.takes, extras: self.extras, ..Needs::default() }
    }

    fn build(&self, context: &Context<'_>) -> dejag::Result<Box<dyn Pass>> {
        let pass = pipeline(context.device, "fs_copy", context.output.format);
        Ok(Box::new(EchoPass { echo: *self, device: context.device.clone(), pass }))
    }
}

#[derive(Debug)]
struct EchoPass {
    echo: Echo,
    device: wgpu::Device,
    pass: wgpu::RenderPipeline,
}

impl Pass for EchoPass {
    fn record(&mut self, recorder: &mut Recorder<'_>, _: u32, inputs: &Inputs<'_>, output: &wgpu::TextureView) {
        assert_eq!(inputs.depth.is_some(), self.echo.extras.depth);
        assert_eq!(inputs.motion.is_some(), self.echo.extras.motion);
        assert_eq!(inputs.ids.is_some(), self.echo.extras.ids);
        assert_eq!(inputs.signature.is_some(), self.echo.extras.signature);
        assert_eq!(inputs.samples.map(|view| view.texture().sample_count()), self.echo.expects_samples.then_some(4));
        let display = self.echo.takes == Encoding::Display;
        assert_eq!(inputs.color.texture().format() == Format::Rgba8Unorm, display);
        let layout = self.pass.get_bind_group_layout(0);
        let entries = [wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(inputs.color) }];
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries });
        screen(recorder, &self.pass, &group, output);
    }
}

#[test]
fn filters_get_the_picture_in_their_encoding_and_what_they_ask_for() {
    let gpu = common::gpu();
    let scene = Scene::load("fence").expect("shipped");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    let everything = Extras { depth: true, motion: true, ids: true, signature: true };
    for first in ["none", "msaa:samples=4", "ssaa:spp=4"] {
        let spec = Spec::parse(first).expect("exists");
        for takes in [Encoding::Linear, Encoding::Display] {
            let extras = if first == "none" { everything } else { Extras::default() };
            let echo = Echo { takes, extras, expects_samples: first.starts_with("msaa") };
            let stages: [(&str, &dyn Technique); 2] = [(first, &*spec.stages[0].technique), ("echo", &echo)];
            let mut shot = studio.shot_of(&stages, 0, SIZE, Extras::default()).expect("builds");
            studio.take(&mut shot, None, &mut ()).expect("draws");
            let echoed = studio.read(&shot).expect("reads");
            let plain = by_name(&mut studio, first);
            // The echo stores rgba16float or rgba8unorm, the sum of jitters is finer: a step of 8 bits either way.
            let pairs = echoed.display.to_rgba8().into_iter().zip(plain.display.to_rgba8());
            let largest = pairs.map(|(a, b)| a.abs_diff(b)).max();
            assert!(largest <= Some(1), "{first} through {takes:?}: {largest:?}");
            assert_eq!(echoed.linear.is_some(), takes == Encoding::Linear);
        }
    }
}

#[test]
fn a_filter_alone_is_given_one_plain_draw() {
    let gpu = common::gpu();
    let scene = Scene::load("fence").expect("shipped");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    let echo = Echo { takes: Encoding::Display, extras: Extras::default(), expects_samples: false };
    let echoed = capture(&mut studio, &echo).display.to_rgba8();
    assert!(echoed == by_name(&mut studio, "none").display.to_rgba8());
}

#[test]
fn depth_beside_a_sum_is_refused() {
    let gpu = common::gpu();
    let scene = Scene::load("fence").expect("shipped");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    let spec = Spec::parse("ssaa:spp=4").expect("exists");
    let extras = Extras { depth: true, ..Extras::default() };
    let echo = Echo { takes: Encoding::Linear, extras, expects_samples: false };
    let stages: [(&str, &dyn Technique); 2] = [("ssaa", &*spec.stages[0].technique), ("echo", &echo)];
    let mut shot = studio.shot_of(&stages, 0, SIZE, Extras::default()).expect("builds");
    let refusal = studio.take(&mut shot, None, &mut ()).expect_err("no single depth").to_string();
    assert!(refusal.contains("sums jitters"), "{refusal}");
}

#[test]
fn a_shot_moves_from_frame_to_frame() {
    let gpu = common::gpu();
    let scene = Scene::load("pan").expect("shipped");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    let none = Spec::parse("none").expect("exists");
    let mut moved = studio.shot(&none, 0, SIZE).expect("builds");
    studio.take(&mut moved, None, &mut ()).expect("draws");
    moved.move_to(Tick::of(&scene, 7), false);
    studio.take(&mut moved, None, &mut ()).expect("draws");
    let there = studio.capture(&none, 7, SIZE, &mut ()).expect("draws");
    let begun = studio.capture(&none, 0, SIZE, &mut ()).expect("draws");
    let moved = studio.read(&moved).expect("reads");
    assert!(moved.linear == there.linear && moved.linear != begun.linear);
}
