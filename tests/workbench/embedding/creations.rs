//! What a frame makes on the device: nothing.
//!
//! wgpu hands out ids kind by kind: the one that was given back last comes first, one epoch older. So a thing that is made, looked
//! at and dropped tells whether any of its kind was made or dropped since the last look, even if it is gone by now.

use super::filters;
use super::host::Host;
use super::picture::{SIZE, mirrored, shapes};
use dejag::pass::Surface;

const SURFACE: Surface = Surface::linear(wgpu::TextureFormat::Rgba16Float);

const SHADER: &str = "
@group(0) @binding(0) var<storage, read_write> word: u32;
@compute @workgroup_size(1) fn cs() { word = 1u; }
@vertex fn vs() -> @builtin(position) vec4<f32> { return vec4<f32>(0.0); }
@fragment fn fs() -> @location(0) vec4<f32> { return vec4<f32>(0.0); }";

/// An id that wgpu handed out.
#[derive(Debug, Clone, PartialEq)]
struct Id {
    kind: &'static str,
    index: u32,
    epoch: u32,
}

impl Id {
    /// Read from the thing's debug text: there is no other way to see it.
    fn of(kind: &'static str, thing: &dyn std::fmt::Debug) -> Self {
        let text = format!("{thing:?}");
        let inside = text.split_once(&format!(" {kind}Id(")).and_then(|(_, rest)| rest.split_once(')'));
        let (index, epoch) = inside.and_then(|(ids, _)| ids.split_once(',')).unwrap_or_else(|| panic!("no {kind} id: {text}"));
        Self { kind, index: index.parse().expect("a number"), epoch: epoch.parse().expect("a number") }
    }

    fn next(self) -> Self {
        Self { epoch: self.epoch + 1, ..self }
    }
}

/// One of each kind that a pass has, made and dropped.
fn look(host: &Host) -> Vec<Id> {
    let device = &host.device;
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 4,
        usage: wgpu::BufferUsages::STORAGE,
        mapped_at_creation: false,
    });
    let view = host.target([1, 1], wgpu::TextureFormat::Rgba8Unorm);
    let module = device
        .create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source: wgpu::ShaderSource::Wgsl(SHADER.into()) });
    let options = wgpu::PipelineCompilationOptions::default;
    let compute = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: Some("cs"),
        compilation_options: options(),
        cache: None,
    });
    let render = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        vertex: wgpu::VertexState { module: &module, entry_point: Some("vs"), compilation_options: options(), buffers: &[] },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fs"),
            compilation_options: options(),
            targets: &[Some(wgpu::TextureFormat::Rgba8Unorm.into())],
        }),
        multiview_mask: None,
        cache: None,
    });
    let layout = compute.get_bind_group_layout(0);
    let entries = [wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() }];
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries });
    host.check("a look");
    vec![
        Id::of("Buffer", &buffer),
        Id::of("Texture", view.texture()),
        Id::of("TextureView", &view),
        Id::of("ShaderModule", &module),
        Id::of("ComputePipeline", &compute),
        Id::of("RenderPipeline", &render),
        Id::of("BindGroupLayout", &layout),
        Id::of("BindGroup", &group),
    ]
}

/// The kinds of which something was made or dropped meanwhile.
pub(super) fn made(host: &Host, meanwhile: impl FnOnce()) -> Vec<&'static str> {
    let before = look(host);
    meanwhile();
    let after = look(host);
    before.into_iter().zip(after).filter(|(before, after)| before.clone().next() != *after).map(|(id, _)| id.kind).collect()
}

/// Things alive, as wgpu counts them itself.
pub(super) fn alive(host: &Host) -> [usize; 6] {
    let hub = host.instance.generate_report().expect("wgpu's own core").hub;
    [&hub.buffers, &hub.textures, &hub.texture_views, &hub.bind_groups, &hub.compute_pipelines, &hub.render_pipelines]
        .map(|registry| registry.num_allocated)
}

#[test]
fn frames_make_nothing() {
    let host = Host::open();
    for method in filters() {
        let mut pass = host.build(method, SIZE, [SURFACE; 2]);
        let color = host.picture(SIZE, SURFACE.format, &shapes(SIZE));
        // By turns, as those of a swap chain.
        let outputs = [(); 3].map(|()| host.target(SIZE, SURFACE.format));
        let mut frames = |count: usize| (0..count).for_each(|i| host.run(pass.as_mut(), &color, &outputs[i % 3]));
        // The first makes the bind groups.
        frames(2);
        host.wait();
        let before = alive(&host);
        assert_eq!(made(&host, || frames(48)), Vec::<&str>::new(), "{method}");
        host.wait();
        assert_eq!(alive(&host), before, "{method}");
        host.check(method);
    }
}

#[test]
fn another_input_takes_other_bind_groups_and_no_more() {
    let host = Host::open();
    for method in filters() {
        let mut pass = host.build(method, SIZE, [SURFACE; 2]);
        let output = host.target(SIZE, SURFACE.format);
        let inputs = [shapes(SIZE), mirrored(SIZE)].map(|pixels| host.picture(SIZE, SURFACE.format, &pixels));
        host.run(pass.as_mut(), &inputs[0], &output);
        let found = made(&host, || host.run(pass.as_mut(), &inputs[1], &output));
        assert!(found.iter().all(|kind| ["BindGroup", "BindGroupLayout"].contains(kind)), "{method}: {found:?}");
        // So this test sees what the one above would miss if it looked at nothing.
        assert!(found.contains(&"BindGroup"), "{method}");
        // Pictures by turns need nothing new.
        let found = made(&host, || host.run(pass.as_mut(), &inputs[0], &output));
        assert_eq!(found, Vec::<&str>::new(), "{method}");
    }
}

#[test]
fn what_is_made_and_dropped_at_once_is_noticed() {
    let host = Host::open();
    assert_eq!(made(&host, || ()), Vec::<&str>::new());
    assert_eq!(made(&host, || drop(host.target([1, 1], SURFACE.format))), ["Texture", "TextureView"]);
    assert_eq!(made(&host, || drop(look(&host))).len(), 8);
}
