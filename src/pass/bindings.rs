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

/// The bind group of the resources that were given last.
#[derive(Debug, Default)]
pub(super) struct Bound(Option<(Vec<Binding>, wgpu::BindGroup)>);

impl Bound {
    /// The group of these resources; made anew only when they change.
    pub(super) fn group(
        &mut self,
        device: &wgpu::Device,
        label: &str,
        layout: impl FnOnce() -> wgpu::BindGroupLayout,
        bindings: &[&Binding],
    ) -> Option<&wgpu::BindGroup> {
        let same = |bound: &[Binding]| bound.iter().eq(bindings.iter().copied());
        if self.0.as_ref().is_none_or(|(bound, _)| !same(bound)) {
            let entries: Vec<_> =
                bindings.iter().zip(0..).map(|(b, binding)| wgpu::BindGroupEntry { binding, resource: b.resource() }).collect();
            let group =
                device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(label), layout: &layout(), entries: &entries });
            self.0 = Some((bindings.iter().map(|b| (*b).clone()).collect(), group));
        }
        self.0.as_ref().map(|(_, group)| group)
    }
}
