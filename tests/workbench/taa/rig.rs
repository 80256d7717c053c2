//! A host that draws nothing: it hands `taa` pictures, motion, ids and depths that a test made up.

use dejag::gpu::{Gpu, TextureSpec};
use dejag::methods::Spec;
use dejag::pass::{Context, FrameFacts, Inputs, Pass, Recorder, Surface};
use dejag::picture::{LinearPicture, Pixel};
use wgpu::TextureFormat as Format;

/// What a frame shows. One value for all pixels, or one a pixel.
#[derive(Debug, Clone)]
pub(super) struct Facts {
    pub(super) color: Vec<Pixel>,
    /// To where each surface was in the frame before.
    pub(super) motion_px: Vec<[f32; 2]>,
    pub(super) ids: Vec<u32>,
    pub(super) depths: Vec<f32>,
}

impl Facts {
    /// A picture of one surface at rest.
    pub(super) fn still(color: Vec<Pixel>) -> Self {
        Self { color, motion_px: vec![[0.0; 2]], ids: vec![1], depths: vec![0.5] }
    }

    /// The same of one colour.
    pub(super) fn flat(color: [f32; 3]) -> Self {
        Self::still(vec![[color[0], color[1], color[2], 1.0]])
    }

    /// The same in motion.
    pub(super) fn moved(self, motion_px: [f32; 2]) -> Self {
        Self { motion_px: vec![motion_px], ..self }
    }
}

/// A frame on the device.
pub(super) struct Uploaded {
    color: wgpu::TextureView,
    motion: wgpu::TextureView,
    ids: wgpu::TextureView,
    depth: wgpu::TextureView,
}

pub(super) struct Rig<'g> {
    gpu: &'g Gpu,
    size: [u32; 2],
    input: Format,
    pass: Box<dyn Pass>,
    output: wgpu::Texture,
    /// What every frame is told; its index counts up.
    pub(super) frame: FrameFacts,
}

impl<'g> Rig<'g> {
    /// With pictures in f32.
    pub(super) fn new(gpu: &'g Gpu, spec: &str, size: [u32; 2]) -> Self {
        Self::with_input(gpu, spec, size, Format::Rgba32Float)
    }

    pub(super) fn with_input(gpu: &'g Gpu, spec: &str, size: [u32; 2], input: Format) -> Self {
        let parsed = Spec::parse(spec).expect(spec);
        let output = gpu.target(TextureSpec { label: "output", size, format: Format::Rgba32Float, samples: 1 });
        let context = Context {
            device: &gpu.device,
            queue: &gpu.queue,
            size,
            input: Surface::linear(input),
            input_samples: 1,
            output: Surface::linear(output.format()),
        };
        let pass = parsed.stages[0].technique.build(&context).expect("builds");
        gpu.check().expect(spec);
        Self { gpu, size, input, pass, output, frame: FrameFacts { reset: true, ..FrameFacts::default() } }
    }

    pub(super) fn upload(&self, facts: &Facts) -> Uploaded {
        let gpu = self.gpu;
        let color = gpu.target(TextureSpec { label: "color", size: self.size, format: self.input, samples: 1 });
        gpu.upload(&color, &self.filled(&facts.color)).expect("fits");
        let motion: Vec<Pixel> = self.filled(&facts.motion_px).iter().map(|[x, y]| [*x, *y, 0.0, 1.0]).collect();
        let depths: Vec<Pixel> = self.filled(&facts.depths).iter().map(|depth| [*depth, 0.0, 0.0, 1.0]).collect();
        let ids = gpu.target(TextureSpec { label: "ids", size: self.size, format: Format::R32Uint, samples: 1 });
        let rows = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * self.size[0]), rows_per_image: None };
        gpu.queue.write_texture(ids.as_image_copy(), bytemuck::cast_slice(&self.filled(&facts.ids)), rows, ids.size());
        let [motion, depths] = [motion, depths].map(|pixels| self.plane(pixels));
        let [color, ids] = [color, ids].map(|texture| view_of(&texture));
        Uploaded { color, motion, ids, depth: self.depth(&depths) }
    }

    fn filled<T: Clone>(&self, values: &[T]) -> Vec<T> {
        let count = (self.size[0] * self.size[1]) as usize;
        if values.len() == 1 { vec![values[0].clone(); count] } else { values.to_vec() }
    }

    fn plane(&self, pixels: Vec<Pixel>) -> wgpu::TextureView {
        view_of(&self.gpu.upload_linear(&LinearPicture::new(self.size[0], self.size[1], pixels).expect("fits")))
    }

    /// Depth textures take no uploads: they are drawn.
    fn depth(&self, depths: &wgpu::TextureView) -> wgpu::TextureView {
        let gpu = self.gpu;
        let target = gpu.target(TextureSpec { label: "depth", size: self.size, format: Format::Depth32Float, samples: 1 });
        let target = view_of(&target);
        let pipeline = depth_pipeline(&gpu.device);
        let entries = [wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(depths) }];
        let layout = pipeline.get_bind_group_layout(0);
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries });
        let ops = wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Store };
        let attachment = wgpu::RenderPassDepthStencilAttachment { view: &target, depth_ops: Some(ops), stencil_ops: None };
        let mut encoder = gpu.encoder();
        let descriptor = wgpu::RenderPassDescriptor { depth_stencil_attachment: Some(attachment), ..Default::default() };
        Recorder::new(&mut encoder).render(&descriptor, |pass| {
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.draw(0..3, 0..1);
        });
        gpu.submit(encoder).expect("draws");
        target
    }

    /// Where the next frame is to be sampled.
    pub(super) fn jitter_px(&mut self) -> [f32; 2] {
        self.pass.next_draw(0, &self.frame).expect("a draw a frame").jitters[0].offset_px
    }

    /// One frame, in a submission of its own.
    pub(super) fn show(&mut self, shown: &Uploaded) {
        self.frame.jitter_px = self.jitter_px();
        let inputs = Inputs {
            color: &shown.color,
            samples: None,
            depth: Some(&shown.depth),
            motion: Some(&shown.motion),
            ids: Some(&shown.ids),
            signature: None,
            frame: self.frame,
        };
        let mut encoder = self.gpu.encoder();
        self.pass.record(&mut Recorder::new(&mut encoder), 0, &inputs, &view_of(&self.output));
        self.gpu.submit(encoder).expect("runs");
        self.frame = FrameFacts { index: self.frame.index.wrapping_add(1), reset: false, ..self.frame };
    }

    /// The picture as it stands.
    pub(super) fn pixels(&self) -> Vec<Pixel> {
        self.gpu.read_linear(&self.output).expect("reads").into_pixels()
    }

    /// One frame and its picture.
    pub(super) fn take(&mut self, facts: &Facts) -> Vec<Pixel> {
        let shown = self.upload(facts);
        self.show(&shown);
        self.pixels()
    }
}

fn depth_pipeline(device: &wgpu::Device) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::include_wgsl!("depth.wgsl"));
    let options = wgpu::PipelineCompilationOptions::default;
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("depths"),
        layout: None,
        vertex: wgpu::VertexState { module: &module, entry_point: Some("vs"), compilation_options: options(), buffers: &[] },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: Format::Depth32Float,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Always),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fs"),
            compilation_options: options(),
            targets: &[],
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn view_of(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
