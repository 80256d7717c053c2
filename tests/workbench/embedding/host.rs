//! Somebody else's device: the least that WebGPU's downlevel limits promise, and an ear for every error.

use std::sync::{Arc, Mutex};

use dejag::gpu::{decode_texels, encode_texels};
use dejag::methods::Spec;
use dejag::pass::{Context, Inputs, Pass, Recorder, Surface};
use dejag::picture::Pixel;
use wgpu::{TextureFormat, TextureUsages as Usages};

use crate::common;

pub(super) struct Host {
    pub(super) instance: wgpu::Instance,
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    failures: Arc<Mutex<Vec<String>>>,
}

impl Host {
    /// Without features, within `downlevel_defaults`.
    pub(super) fn open() -> Self {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = wgpu::Backends::PRIMARY;
        // Of its own: what is counted on it (see `creations`) is made by one test alone.
        let instance = wgpu::Instance::new(descriptor);
        let software = common::adapter() == "software";
        let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
        let suits = |adapter: &wgpu::Adapter| (adapter.get_info().device_type == wgpu::DeviceType::Cpu) == software;
        let adapter = adapters.iter().find(|a| suits(a)).or(adapters.first()).expect("the tests need an adapter");
        let descriptor = wgpu::DeviceDescriptor { required_limits: wgpu::Limits::downlevel_defaults(), ..Default::default() };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor)).expect("the least that there is");
        let failures = Arc::new(Mutex::new(Vec::new()));
        let heard = Arc::clone(&failures);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            heard.lock().expect("nothing panics meanwhile").push(error.to_string());
        }));
        Self { instance, device, queue, failures }
    }

    /// Fails with what wgpu had to say since the last time.
    pub(super) fn check(&self, what: &str) {
        let failures = std::mem::take(&mut *self.failures.lock().expect("nothing panics meanwhile"));
        assert_eq!(failures, Vec::<String>::new(), "{what}");
    }

    pub(super) fn build(&self, method: &str, size: [u32; 2], [input, output]: [Surface; 2]) -> Box<dyn Pass> {
        let spec = Spec::parse(method).expect(method);
        let technique = &spec.stages[0].technique;
        technique.needs().check(method, wgpu::Features::empty(), &[1, 4]).expect("nothing is lacking");
        let context = Context { device: &self.device, queue: &self.queue, size, input, input_samples: 1, output };
        let pass = technique.build(&context).unwrap_or_else(|error| panic!("{method}, {input:?} to {output:?}: {error}"));
        self.check(method);
        pass
    }

    /// What a pass reads: no more usages than that takes.
    pub(super) fn picture(&self, size: [u32; 2], format: TextureFormat, pixels: &[Pixel]) -> wgpu::TextureView {
        let texture = self.texture(size, format, Usages::TEXTURE_BINDING | Usages::COPY_DST);
        self.write(texture.as_image_copy(), size, &encode_texels(format, pixels).expect("a picture's format"));
        texture.create_view(&wgpu::TextureViewDescriptor::default())
    }

    /// What a pass writes: no more usages than that and a look at it take.
    pub(super) fn target(&self, size: [u32; 2], format: TextureFormat) -> wgpu::TextureView {
        let texture = self.texture(size, format, Usages::RENDER_ATTACHMENT | Usages::COPY_SRC);
        texture.create_view(&wgpu::TextureViewDescriptor::default())
    }

    /// A picture to read and one to write, with the usages that let a software adapter copy one and write into the copy.
    pub(super) fn copyable(&self, size: [u32; 2], format: TextureFormat, pixels: &[Pixel]) -> [wgpu::TextureView; 2] {
        let read = Usages::TEXTURE_BINDING | Usages::COPY_DST | Usages::COPY_SRC;
        let written = Usages::RENDER_ATTACHMENT | Usages::COPY_SRC | Usages::COPY_DST | Usages::STORAGE_BINDING;
        let [color, output] = [read, written].map(|usage| self.texture(size, format, usage));
        self.write(color.as_image_copy(), size, &encode_texels(format, pixels).expect("a picture's format"));
        [color, output].map(|texture| texture.create_view(&wgpu::TextureViewDescriptor::default()))
    }

    pub(super) fn texture(&self, [width, height]: [u32; 2], format: TextureFormat, usage: Usages) -> wgpu::Texture {
        self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage,
            view_formats: &[],
        })
    }

    /// Fills one mip of one layer.
    pub(super) fn write(&self, place: wgpu::TexelCopyTextureInfo<'_>, [width, height]: [u32; 2], bytes: &[u8]) {
        let row = bytes.len() as u32 / height;
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
        self.queue.write_texture(place, bytes, layout, wgpu::Extent3d { width, height, depth_or_array_layers: 1 });
    }

    pub(super) fn encoder(&self) -> wgpu::CommandEncoder {
        self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default())
    }

    /// One frame in an encoder of its own.
    pub(super) fn run(&self, pass: &mut dyn Pass, color: &wgpu::TextureView, output: &wgpu::TextureView) {
        let mut encoder = self.encoder();
        pass.record(&mut Recorder::new(&mut encoder), 0, &Inputs::picture(color), output);
        self.queue.submit([encoder.finish()]);
    }

    /// The bytes of a target.
    pub(super) fn bytes(&self, view: &wgpu::TextureView) -> Vec<u8> {
        let texture = view.texture();
        self.read(texture.as_image_copy(), [texture.width(), texture.height()])
    }

    /// The bytes of one mip of one layer.
    pub(super) fn read(&self, place: wgpu::TexelCopyTextureInfo<'_>, [width, height]: [u32; 2]) -> Vec<u8> {
        let row = width * place.texture.format().block_copy_size(None).expect("a colour format");
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(padded) * u64::from(height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(padded), rows_per_image: None };
        let mut encoder = self.encoder();
        encoder.copy_texture_to_buffer(
            place,
            wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        self.queue.submit([encoder.finish()]);
        buffer.map_async(wgpu::MapMode::Read, .., |_| ());
        self.wait();
        self.check("reading back");
        let mapped = buffer.get_mapped_range(..).expect("mapped");
        mapped.chunks(padded as usize).flat_map(|padded| &padded[..row as usize]).copied().collect()
    }

    /// The numbers of a target, as they are stored.
    pub(super) fn pixels(&self, view: &wgpu::TextureView) -> Vec<Pixel> {
        decode_texels(view.texture().format(), &self.bytes(view)).expect("a picture's format")
    }

    pub(super) fn wait(&self) {
        self.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
    }
}
