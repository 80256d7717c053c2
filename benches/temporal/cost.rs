//! What a frame of a temporal pass costs, a pass at a time, beside a copy of the picture.

use dejag::bench::Clock;
use dejag::capture::Studio;
use dejag::gpu::{Gpu, TextureSpec};
use dejag::methods::Spec;
use dejag::pass::{Context, Draw, FrameFacts, Inputs, Needs, Pass, Recorder, Surface, Technique};
use dejag::picture::LinearPicture;
use dejag::scene::Scene;
use wgpu::TextureFormat as Format;

/// A frame that has been drawn: the courtyard, all of it moved alike.
struct Drawn {
    color: wgpu::TextureView,
    depth: wgpu::TextureView,
    motion: wgpu::TextureView,
    ids: wgpu::TextureView,
}

impl Drawn {
    fn new(gpu: &Gpu, size: [u32; 2], motion_px: [f32; 2]) -> dejag::Result<Self> {
        let scene = Scene::load("courtyard")?;
        let picture =
            Studio::new(gpu, &scene)?.capture(&Spec::parse("none")?, 0, size, &mut ())?.linear.expect("of linear light");
        let target = |label, format| gpu.target(TextureSpec { label, size, format, samples: 1 });
        let color = target("color", Format::Rgba16Float);
        gpu.upload(&color, picture.pixels())?;
        let motion = LinearPicture::from_fn(size[0], size[1], |_, _| [motion_px[0], motion_px[1], 0.0, 1.0])?;
        let depth = view(&target("depth", Format::Depth32Float));
        clear(gpu, &depth)?;
        // Textures begin as zeros: one object.
        let ids = view(&target("ids", Format::R32Uint));
        Ok(Self { color: view(&color), depth, motion: view(&gpu.upload_linear(&motion)), ids })
    }

    fn inputs(&self, frame: FrameFacts) -> Inputs<'_> {
        let [depth, motion, ids] = [&self.depth, &self.motion, &self.ids].map(Some);
        Inputs { color: &self.color, samples: None, depth, motion, ids, signature: None, frame }
    }
}

fn clear(gpu: &Gpu, depth: &wgpu::TextureView) -> dejag::Result<()> {
    let ops = wgpu::Operations { load: wgpu::LoadOp::Clear(0.5), store: wgpu::StoreOp::Store };
    let attachment = wgpu::RenderPassDepthStencilAttachment { view: depth, depth_ops: Some(ops), stencil_ops: None };
    let mut encoder = gpu.encoder();
    let descriptor = wgpu::RenderPassDescriptor { depth_stencil_attachment: Some(attachment), ..Default::default() };
    Recorder::new(&mut encoder).render(&descriptor, |_| {});
    gpu.submit(encoder)
}

fn view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// The floor: each pixel loaded and stored again.
#[derive(Debug)]
pub(crate) struct Copy;

impl Technique for Copy {
    fn needs(&self) -> Needs {
        Needs::default()
    }

    fn build(&self, context: &Context<'_>) -> dejag::Result<Box<dyn Pass>> {
        let blitter = wgpu::util::TextureBlitter::new(context.device, context.output.format);
        Ok(Box::new(CopyPass { device: context.device.clone(), blitter }))
    }
}

#[derive(Debug)]
struct CopyPass {
    device: wgpu::Device,
    blitter: wgpu::util::TextureBlitter,
}

impl Pass for CopyPass {
    fn next_draw(&mut self, _: u32, _: &FrameFacts) -> Option<Draw> {
        None
    }

    fn record(&mut self, recorder: &mut Recorder<'_>, _: u32, inputs: &Inputs<'_>, output: &wgpu::TextureView) {
        recorder.clocked("copy", |encoder| self.blitter.copy(&self.device, encoder, inputs.color, output));
    }
}

/// Someone on the line, and their milliseconds: one list a pass.
struct Lane {
    label: String,
    pass: Box<dyn Pass>,
    ms: Vec<(String, Vec<f64>)>,
}

impl Lane {
    fn run(&mut self, gpu: &Gpu, drawn: &Drawn, index: u32, output: &wgpu::TextureView) -> dejag::Result<()> {
        let facts = FrameFacts { index, reset: index == 0, ..FrameFacts::default() };
        let jitter_px = self.pass.next_draw(0, &facts).map_or([0.0; 2], |draw| draw.jitters[0].offset_px);
        let frame = FrameFacts { jitter_px, ..facts };
        let mut clock = Clock::new(gpu);
        let mut encoder = gpu.encoder();
        self.pass.record(&mut Recorder::timed(&mut encoder, &mut clock), 0, &drawn.inputs(frame), output);
        gpu.submit(encoder)?;
        // The first two frames build what is built once.
        for time in clock.finish()?.into_iter().filter(|_| index > 1) {
            match self.ms.iter_mut().find(|(name, _)| *name == time.label) {
                Some((_, ms)) => ms.push(time.ms),
                None => self.ms.push((time.label, vec![time.ms])),
            }
        }
        Ok(())
    }
}

/// Everyone in turns, so many frames each.
pub(crate) fn table(gpu: &Gpu, size: [u32; 2], rounds: u32, methods: &[(&str, &dyn Technique)]) -> dejag::Result<()> {
    for (situation, motion_px) in [("at rest", [0.0, 0.0]), ("panned by 0.37 px a frame", [0.37, 0.0])] {
        let drawn = Drawn::new(gpu, size, motion_px)?;
        let output = gpu.target(TextureSpec { label: "output", size, format: Format::Rgba16Float, samples: 1 });
        let surface = Surface::linear(output.format());
        let context = Context { device: &gpu.device, queue: &gpu.queue, size, input: surface, input_samples: 1, output: surface };
        let lane = |(label, technique): &(&str, &dyn Technique)| {
            Ok(Lane { label: (*label).to_owned(), pass: technique.build(&context)?, ms: Vec::new() })
        };
        let mut lanes = methods.iter().map(lane).collect::<dejag::Result<Vec<_>>>()?;
        for index in 0..rounds + 2 {
            for lane in &mut lanes {
                lane.run(gpu, &drawn, index, &view(&output))?;
            }
        }
        println!("\n{situation}, median ms of {rounds} frames");
        for lane in lanes {
            let medians: Vec<(String, f64)> = lane.ms.into_iter().map(|(name, ms)| (name, median(ms))).collect();
            let total: f64 = medians.iter().map(|(_, ms)| ms).sum();
            let passes: Vec<String> = medians.iter().map(|(name, ms)| format!("{name} {ms:.1}")).collect();
            println!("{:<22}{total:>9.1}   {}", lane.label, passes.join(", "));
        }
    }
    Ok(())
}

fn median(mut ms: Vec<f64>) -> f64 {
    ms.sort_by(f64::total_cmp);
    ms.get(ms.len() / 2).copied().unwrap_or(f64::NAN)
}
