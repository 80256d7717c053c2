//! Who runs: our filters, the `smaa` crate, and the floors.

use std::time::Instant;

use dejag::bench::{Clock, PassTime};
use dejag::capture::PictureFilter;
use dejag::gpu::{Gpu, TextureSpec};
use dejag::methods::{METHODS, Spec};
use dejag::pass::{Kind, Role, Surface};
use smaa::{SmaaMode, SmaaTarget};

use crate::measure::Row;
use crate::pictures::Picture;

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Every filter of the registry: at each value of its option `preset`, or as it is.
pub(crate) fn every_preset() -> Vec<String> {
    let mut texts = Vec::new();
    for method in METHODS.iter().filter(|method| is_filter(method.name)) {
        let presets = method.options.iter().find(|option| option.name == "preset").map(|option| &option.kind);
        match presets {
            Some(Kind::Choice(names)) => texts.extend(names().iter().map(|name| format!("{}:preset={name}", method.name))),
            _ => texts.push(method.name.to_owned()),
        }
    }
    texts
}

/// Every filter of the registry with its defaults.
pub(crate) fn every_default() -> Vec<String> {
    METHODS.iter().filter(|method| is_filter(method.name)).map(|method| method.name.to_owned()).collect()
}

fn is_filter(name: &str) -> bool {
    Spec::parse(name).is_ok_and(|spec| matches!(spec.first_needs().role, Role::Filters(_)))
}

/// Everyone on the line, the picture taken in.
pub(crate) struct Line<'g> {
    ours: Vec<(String, PictureFilter<'g>)>,
    smaa: SmaaTarget,
    copy: CopyPass,
    input: wgpu::Texture,
    output: wgpu::Texture,
}

impl<'g> Line<'g> {
    /// Builds everyone for a picture and gives it to them. Methods that cannot run on it are named and left out.
    pub(crate) fn up(gpu: &'g Gpu, specs: &[Spec], picture: &Picture) -> dejag::Result<Self> {
        let size = picture.size;
        let mut ours = Vec::new();
        for spec in specs {
            match PictureFilter::new(gpu, spec, size, Surface::display(FORMAT)) {
                Ok(filter) => {
                    filter.upload(&picture.pixels)?;
                    ours.push((spec.to_string(), filter));
                }
                Err(error) => println!("{spec} is left out: {error}"),
            }
        }
        let target = |label| gpu.target(TextureSpec { label, size, format: FORMAT, samples: 1 });
        let (input, output) = (target("picture"), target("filtered"));
        gpu.upload(&input, &picture.pixels)?;
        let copy = CopyPass::new(gpu, &view(&input));
        let mut smaa = SmaaTarget::new(&gpu.device, &gpu.queue, size[0], size[1], FORMAT, SmaaMode::Smaa1X);
        let filtered = view(&output);
        let frame = smaa.start_frame(&gpu.device, &gpu.queue, &filtered);
        copy.run(gpu, &frame)?;
        frame.resolve();
        gpu.wait()?;
        Ok(Self { ours, smaa, copy, input, output })
    }

    /// Everyone's milliseconds, in turns; the first round warms up.
    pub(crate) fn measure(&mut self, gpu: &Gpu, rounds: u32) -> dejag::Result<Vec<Row>> {
        let names = self.ours.iter().map(|(name, _)| name.clone());
        let peers = ["smaa crate (1x, high)", "copy pass", "texture copy"].map(String::from);
        let mut rows: Vec<Row> = names.chain(peers).map(Row::new).collect();
        for round in 0..=rounds {
            for (index, row) in rows.iter_mut().enumerate() {
                let start = Instant::now();
                self.run(gpu, index)?;
                let ms = 1e3 * start.elapsed().as_secs_f64();
                if round == 0 {
                    row.changed = self.changed(gpu, index)?;
                } else {
                    row.ms.push(ms);
                }
            }
        }
        Ok(rows)
    }

    fn run(&mut self, gpu: &Gpu, index: usize) -> dejag::Result<()> {
        let output = view(&self.output);
        match index.checked_sub(self.ours.len()) {
            None => return self.ours[index].1.run(None),
            Some(0) => self.smaa.start_frame(&gpu.device, &gpu.queue, &output).resolve(),
            Some(1) => self.copy.run(gpu, &output)?,
            Some(_) => {
                let mut encoder = gpu.encoder();
                encoder.copy_texture_to_texture(self.input.as_image_copy(), self.output.as_image_copy(), self.input.size());
                gpu.submit(encoder)?;
            }
        }
        gpu.wait()
    }

    /// Share of the pixels that the last run made different: who does nothing is fast, too.
    fn changed(&self, gpu: &Gpu, index: usize) -> dejag::Result<f64> {
        let output = self.ours.get(index).map_or(&self.output, |(_, filter)| filter.output());
        let (before, after) = (gpu.read_linear(&self.input)?, gpu.read_linear(output)?);
        let changed = before.pixels().iter().zip(after.pixels()).filter(|(p, q)| p[..3] != q[..3]).count();
        Ok(changed as f64 / before.pixels().len() as f64)
    }

    /// Our filters a pass at a time, with the bench's own clock.
    pub(crate) fn passes(&mut self, gpu: &Gpu, rounds: u32) -> dejag::Result<Vec<(String, Vec<Vec<PassTime>>)>> {
        let mut found: Vec<(String, Vec<Vec<PassTime>>)> = self.ours.iter().map(|(name, _)| (name.clone(), Vec::new())).collect();
        for _ in 0..rounds {
            for ((_, runs), (_, filter)) in found.iter_mut().zip(&mut self.ours) {
                let mut clock = Clock::new(gpu);
                filter.run(Some(&mut clock))?;
                runs.push(clock.finish()?);
            }
        }
        Ok(found)
    }
}

fn view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// Each pixel loaded and stored again.
struct CopyPass {
    pipeline: wgpu::RenderPipeline,
    group: wgpu::BindGroup,
}

impl CopyPass {
    const SHADER: &str = "
        @group(0) @binding(0) var picture: texture_2d<f32>;
        @vertex fn vs(@builtin(vertex_index) i: u32) -> @builtin(position) vec4<f32> {
            return vec4<f32>(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
        }
        @fragment fn fs(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
            return textureLoad(picture, vec2<i32>(at.xy), 0);
        }";

    fn new(gpu: &Gpu, input: &wgpu::TextureView) -> Self {
        let source = wgpu::ShaderSource::Wgsl(Self::SHADER.into());
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some("copy"), source });
        let compilation_options = wgpu::PipelineCompilationOptions::default();
        let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("copy"),
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vs"),
                compilation_options: compilation_options.clone(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fs"),
                compilation_options,
                targets: &[Some(FORMAT.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        let entry = wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(input) };
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("copy"),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[entry],
        });
        Self { pipeline, group }
    }

    fn run(&self, gpu: &Gpu, output: &wgpu::TextureView) -> dejag::Result<()> {
        let mut encoder = gpu.encoder();
        let ops = wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store };
        let attachment = wgpu::RenderPassColorAttachment { view: output, depth_slice: None, resolve_target: None, ops };
        let descriptor =
            wgpu::RenderPassDescriptor { label: Some("copy"), color_attachments: &[Some(attachment)], ..Default::default() };
        let mut pass = encoder.begin_render_pass(&descriptor);
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.draw(0..3, 0..1);
        drop(pass);
        gpu.submit(encoder)
    }
}
