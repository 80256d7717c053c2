//! Every entry point through naga's other back ends: what Direct3D, Metal and OpenGL ES would be given. No adapter of this machine
//! compiles them, so that this is the only place where a shader that only Vulkan takes is noticed.

use naga::back::{PipelineConstants, glsl, hlsl, msl, pipeline_constants::process_overrides};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{AddressSpace, EntryPoint, ImageClass, Module, TypeInner};

use super::{modules, parse};

/// One entry point by itself, its overrides resolved.
struct Entry {
    module: Module,
    info: ModuleInfo,
}

impl Entry {
    fn of(module: &Module, entry: &EntryPoint) -> Self {
        let info = Validator::new(ValidationFlags::all(), Capabilities::default()).validate(module).expect("valid");
        let mut constants = PipelineConstants::default();
        // An override without a default gets its value when the pipeline is made; which one, no translation depends on.
        for (_, missing) in module.overrides.iter().filter(|(_, o)| o.init.is_none()) {
            constants.insert(missing.name.clone().unwrap_or_default(), 1.0);
        }
        let (module, info) = process_overrides(module, &info, Some((entry.stage, &entry.name)), &constants)
            .unwrap_or_else(|error| panic!("{}: {error}", entry.name));
        Self { module: module.into_owned(), info: info.into_owned() }
    }

    fn entry(&self) -> &EntryPoint {
        &self.module.entry_points[0]
    }

    /// What the module's bound variables are, in the order of their declaration.
    fn resources(&self) -> impl Iterator<Item = (naga::ResourceBinding, AddressSpace, &TypeInner)> {
        let variables = self.module.global_variables.iter().map(|(_, variable)| variable);
        variables.filter_map(|v| Some((v.binding?, v.space, &self.module.types[v.ty].inner)))
    }

    fn to_hlsl(&self) -> Result<String, String> {
        // The oldest model that wgpu compiles for; nothing may be faked.
        let mut options =
            hlsl::Options { shader_model: hlsl::ShaderModel::V5_1, fake_missing_bindings: false, ..Default::default() };
        for (register, (binding, _, _)) in (0..).zip(self.resources()) {
            let target = hlsl::BindTarget { space: binding.group as u8, register, ..Default::default() };
            options.binding_map.insert(binding, target);
            let samplers = hlsl::SamplerIndexBufferKey { group: binding.group };
            options.sampler_buffer_binding_map.entry(samplers).or_insert(hlsl::BindTarget { space: 255, ..target });
        }
        options.special_constants_binding = Some(hlsl::BindTarget { space: 254, ..Default::default() });
        let mut text = String::new();
        let pipeline = hlsl::PipelineOptions { entry_point: Some((self.entry().stage, self.entry().name.clone())) };
        let mut writer = hlsl::Writer::new(&mut text, &options, &pipeline);
        let written = writer.write(&self.module, &self.info, None).map_err(|error| error.to_string())?;
        written.entry_point_names.into_iter().collect::<Result<Vec<_>, _>>().map_err(|error| error.to_string())?;
        Ok(text)
    }

    fn to_msl(&self) -> Result<String, String> {
        let mut resources = msl::EntryPointResources { sizes_buffer: Some(30), ..Default::default() };
        for (slot, (binding, space, inner)) in (0..).zip(self.resources()) {
            let mut target = msl::BindTarget { mutable: writable(space, inner), ..Default::default() };
            match inner {
                TypeInner::Image { .. } => target.texture = Some(slot),
                TypeInner::Sampler { .. } => target.sampler = Some(msl::BindSamplerTarget::Resource(slot)),
                _ => target.buffer = Some(slot),
            }
            resources.resources.insert(binding, target);
        }
        let options = msl::Options {
            // macOS 10.14: the oldest that knows @invariant, which the scene's draws count on.
            lang_version: (2, 1),
            fake_missing_bindings: false,
            per_entry_point_map: [(self.entry().name.clone(), resources)].into(),
            ..Default::default()
        };
        let pipeline =
            msl::PipelineOptions { entry_point: Some((self.entry().stage, self.entry().name.clone())), ..Default::default() };
        let written = msl::write_string(&self.module, &self.info, &options, &pipeline);
        let (text, info) = written.map_err(|error| error.to_string())?;
        info.entry_point_names.into_iter().collect::<Result<Vec<_>, _>>().map_err(|error| error.to_string())?;
        Ok(text)
    }

    fn to_glsl(&self) -> Result<String, String> {
        let options = glsl::Options {
            version: glsl::Version::new_gles(310),
            binding_map: (0..).zip(self.resources()).map(|(slot, (binding, _, _))| (binding, slot)).collect(),
            ..Default::default()
        };
        let (shader_stage, entry_point) = (self.entry().stage, self.entry().name.clone());
        let pipeline = glsl::PipelineOptions { shader_stage, entry_point, multiview: None };
        let mut text = String::new();
        let policies = naga::proc::BoundsCheckPolicies::default();
        let writer = glsl::Writer::new(&mut text, &self.module, &self.info, &options, &pipeline, policies);
        writer.and_then(|mut writer| writer.write()).map_err(|error| error.to_string())?;
        Ok(text)
    }

    /// What the entry point reads or writes that GLSL ES 3.10 has no word for; `None` where it must translate.
    fn beyond_gles(&self) -> Option<&'static str> {
        let used = self.info.get_entry_point(0);
        let variables = self.module.global_variables.iter().filter(|(handle, _)| !used[*handle].is_empty());
        variables.map(|(_, variable)| &self.module.types[variable.ty].inner).find_map(|inner| match inner {
            // Depth can only be compared there, and naga refuses to load it.
            TypeInner::Image { class: ImageClass::Depth { .. }, .. } => Some("a depth texture"),
            TypeInner::Image { class: ImageClass::Storage { format, .. }, .. } if !in_gles(*format) => Some("a storage format"),
            _ => None,
        })
    }
}

fn writable(space: AddressSpace, inner: &TypeInner) -> bool {
    let store = naga::StorageAccess::STORE;
    match (space, inner) {
        (AddressSpace::Storage { access }, _) => access.contains(store),
        (_, TypeInner::Image { class: ImageClass::Storage { access, .. }, .. }) => access.contains(store),
        _ => false,
    }
}

/// Image formats of section 4.4.7 of the GLSL ES 3.10 specification.
fn in_gles(format: naga::StorageFormat) -> bool {
    use naga::StorageFormat as F;
    matches!(
        format,
        F::Rgba32Float | F::Rgba16Float | F::R32Float | F::Rgba8Unorm | F::Rgba8Snorm | F::Rgba32Sint | F::Rgba16Sint
    ) || matches!(format, F::Rgba8Sint | F::R32Sint | F::Rgba32Uint | F::Rgba16Uint | F::Rgba8Uint | F::R32Uint)
}

/// Each entry point of every module, with a name for messages.
fn entries() -> Vec<(String, Entry)> {
    let mut entries = Vec::new();
    for (source, _) in modules() {
        let module = parse(&source);
        for entry in &module.entry_points {
            entries.push((format!("{}, {}", source.name, entry.name), Entry::of(&module, entry)));
        }
    }
    entries
}

#[test]
fn every_entry_point_translates_to_hlsl_and_msl() {
    let entries = entries();
    assert!(entries.len() >= 8, "entry points are missing from the list");
    for (name, entry) in entries {
        let hlsl = entry.to_hlsl().unwrap_or_else(|error| panic!("{name}, to HLSL: {error}"));
        let msl = entry.to_msl().unwrap_or_else(|error| panic!("{name}, to MSL: {error}"));
        assert!(hlsl.contains(&entry.entry().name) && msl.contains(&entry.entry().name), "{name}");
    }
}

#[test]
fn every_entry_point_translates_to_glsl_es_unless_the_language_cannot_say_it() {
    for (name, entry) in entries() {
        match (entry.beyond_gles(), entry.to_glsl()) {
            (None, outcome) => assert!(outcome.is_ok(), "{name}, to GLSL ES: {outcome:?}"),
            // An exception that is none any more must go: else it would hide the next failure.
            (Some(why), outcome) => assert!(outcome.is_err(), "{name} has {why} and translates all the same"),
        }
    }
}

#[test]
fn what_cannot_be_translated_is_noticed() {
    let entry = |text: &str| {
        let module = naga::front::wgsl::parse_str(text).expect("WGSL");
        Entry::of(&module, &module.entry_points[0])
    };
    let depth = entry(
        "@group(0) @binding(0) var depth: texture_depth_2d;
         @fragment fn f() -> @location(0) vec4<f32> { return vec4<f32>(textureLoad(depth, vec2<i32>(0), 0)); }",
    );
    assert!(depth.to_glsl().is_err() && depth.beyond_gles().is_some());
    assert!(depth.to_hlsl().is_ok() && depth.to_msl().is_ok());
    // A texture under two samplers, which OpenGL joins with it; no exception covers that.
    let samplers = entry(
        "@group(0) @binding(0) var picture: texture_2d<f32>;
         @group(0) @binding(1) var near: sampler;
         @group(0) @binding(2) var far: sampler;
         @fragment fn f() -> @location(0) vec4<f32> {
             return textureSample(picture, near, vec2<f32>(0.0)) + textureSample(picture, far, vec2<f32>(0.5));
         }",
    );
    assert!(samplers.to_glsl().is_err() && samplers.beyond_gles().is_none());
    // A binding that no map has: nothing is faked in its place.
    let mut unbound =
        entry("@group(0) @binding(0) var<uniform> u: vec4<f32>; @fragment fn f() -> @location(0) vec4<f32> { return u; }");
    assert!(unbound.to_hlsl().is_ok() && unbound.to_msl().is_ok());
    let handle = unbound.module.global_variables.iter().next().map(|(handle, _)| handle).expect("one");
    unbound.module.global_variables.get_mut(handle).binding = None;
    assert!(unbound.to_msl().is_err());
}
