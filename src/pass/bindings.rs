//! Resources of a pass, and the bind group that is kept for as long as they stay the same.

/// A resource at binding 0, 1, ... of group 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Binding {
    Texture(wgpu::TextureView),
    Buffer(wgpu::Buffer),
}

impl Binding {
    fn resource(&self) -> wgpu::BindingResource<'_> {
        match self {
            Self::Texture(view) => wgpu::BindingResource::TextureView(view),
            Self::Buffer(buffer) => buffer.as_entire_binding(),
        }
    }
}

/// Bind groups of the resources that were given last: pictures that come in by turns need none made anew.
#[derive(Debug, Default)]
pub(super) struct Bound(Vec<(Vec<Binding>, wgpu::BindGroup)>);

impl Bound {
    const MOST: usize = 4;

    /// The group of these resources, the latest first; made anew only for others than the last few.
    pub(super) fn group(
        &mut self,
        device: &wgpu::Device,
        label: &str,
        layout: impl FnOnce() -> wgpu::BindGroupLayout,
        bindings: &[&Binding],
    ) -> Option<&wgpu::BindGroup> {
        match self.0.iter().position(|(bound, _)| bound.iter().eq(bindings.iter().copied())) {
            Some(index) => self.0.swap(0, index),
            None => {
                let entries: Vec<_> = bindings
                    .iter()
                    .zip(0..)
                    .map(|(b, binding)| wgpu::BindGroupEntry { binding, resource: b.resource() })
                    .collect();
                let descriptor = wgpu::BindGroupDescriptor { label: Some(label), layout: &layout(), entries: &entries };
                self.0.truncate(Self::MOST - 1);
                self.0.insert(0, (bindings.iter().map(|b| (*b).clone()).collect(), device.create_bind_group(&descriptor)));
            }
        }
        self.0.first().map(|(_, group)| group)
    }
}
