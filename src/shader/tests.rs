//! Every shader through naga, and every shared struct against the module that reads it.

mod translation;

use std::collections::BTreeSet;
use std::path::Path;

use naga::valid::{Capabilities, ValidationFlags, Validator};

use super::{Source, layout::Layout};
use crate::capture::Present;
use crate::forward;
use crate::methods::METHODS;

/// Every module with the structs it shares.
fn modules() -> Vec<(Source, &'static [Layout])> {
    let methods = METHODS.iter().flat_map(|m| m.shaders.iter().map(|s| (*s, m.layouts)));
    methods
        .chain([
            (forward::SHADER, forward::LAYOUTS),
            (forward::OUTLINE_SHADER, forward::LAYOUTS),
            (Present::SHADER, Present::LAYOUTS),
        ])
        .collect()
}

fn parse(source: &Source) -> naga::Module {
    let text = source.text();
    naga::front::wgsl::parse_str(&text).unwrap_or_else(|error| {
        let place = error.location(&text).map(|l| source.locate(l.line_number as usize));
        panic!("{place:?}: {}", error.emit_to_string(&text))
    })
}

#[test]
fn every_module_is_valid() {
    let modules = modules();
    assert!(modules.len() >= 4, "modules are missing from the list");
    for (source, _) in &modules {
        let module = parse(source);
        let checked = Validator::new(ValidationFlags::all(), Capabilities::default()).validate(&module);
        checked.unwrap_or_else(|error| panic!("{}: {}", source.name, error.emit_to_string(&source.text())));
    }
}

#[test]
fn every_file_under_shaders_is_part_of_a_module() {
    let used: BTreeSet<&str> = modules().iter().flat_map(|(source, _)| source.parts.iter().map(|p| p.file)).collect();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders");
    let mut folders = vec![root.clone()];
    let mut found = 0;
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("readable").map(|e| e.expect("readable").path()) {
            if entry.is_dir() {
                folders.push(entry);
                continue;
            }
            let file = entry.strip_prefix(&root).expect("below the root").to_string_lossy().replace('\\', "/");
            assert!(used.contains(file.as_str()), "{file} is in no module");
            found += 1;
        }
    }
    assert_eq!(found, used.len());
}

#[test]
fn shared_structs_are_the_same_on_both_sides() {
    let (mut declared, mut read) = (BTreeSet::new(), BTreeSet::new());
    for (source, layouts) in modules() {
        let module = parse(&source);
        for (name, handle) in structs_in_buffers(&module) {
            let layout = layouts.iter().find(|l| l.name == name);
            let layout = layout.unwrap_or_else(|| panic!("{}: {name} has no twin in Rust", source.name));
            assert_eq!(differences(&module, handle, layout), Vec::<String>::new(), "{}: {name}", source.name);
            // A method's modules have one list of layouts; each must be read by one of them.
            read.insert((layouts.as_ptr(), layout.name));
        }
        declared.extend(layouts.iter().map(|layout| (layouts.as_ptr(), layout.name)));
    }
    assert_eq!(declared, read, "declared and read by no module");
}

#[test]
fn a_drifted_struct_is_noticed() {
    use crate::shader::layout::Field;
    let module = naga::front::wgsl::parse_str(
        "struct Drift { a: f32, b: u32 } @group(0) @binding(0) var<uniform> drift: Drift;\n@fragment fn f() { _ = drift.a; }",
    )
    .expect("valid");
    let handle = structs_in_buffers(&module)[0].1;
    let field = |name, offset, kind| Field { name, offset, kind };
    let right = [field("a", 0, "f32"), field("b", 4, "u32")];
    let swapped = [field("b", 0, "u32"), field("a", 4, "f32")];
    let retyped = [field("a", 0, "f32"), field("b", 4, "f32")];
    let layout = |fields: &[Field], size| Layout { name: "Drift", size, fields: fields.to_vec().leak() };
    assert!(differences(&module, handle, &layout(&right, 8)).is_empty());
    assert!(!differences(&module, handle, &layout(&swapped, 8)).is_empty());
    assert!(!differences(&module, handle, &layout(&retyped, 8)).is_empty());
    assert!(!differences(&module, handle, &layout(&right, 12)).is_empty());
    assert!(!differences(&module, handle, &layout(&right[..1], 8)).is_empty());
}

type Type = naga::Handle<naga::Type>;

/// Structs that uniform and storage buffers hold, by name, arrays looked into. Plain numbers and vectors have no fields to drift.
fn structs_in_buffers(module: &naga::Module) -> Vec<(String, Type)> {
    let buffers = module
        .global_variables
        .iter()
        .filter(|(_, variable)| matches!(variable.space, naga::AddressSpace::Uniform | naga::AddressSpace::Storage { .. }));
    let held = buffers.map(|(_, variable)| match module.types[variable.ty].inner {
        naga::TypeInner::Array { base, .. } => base,
        _ => variable.ty,
    });
    held.filter(|handle| matches!(module.types[*handle].inner, naga::TypeInner::Struct { .. }))
        .map(|handle| (module.types[handle].name.clone().unwrap_or_default(), handle))
        .collect()
}

fn differences(module: &naga::Module, handle: Type, layout: &Layout) -> Vec<String> {
    let naga::TypeInner::Struct { members, span } = &module.types[handle].inner else {
        return vec!["is no struct in WGSL".into()];
    };
    let mut found = Vec::new();
    // A trailing gap is WGSL's own rounding; what comes after the last field must not differ otherwise.
    if *span as usize != layout.size {
        found.push(format!("{span} bytes in WGSL, {} in Rust", layout.size));
    }
    if members.len() != layout.fields.len() {
        found.push(format!("{} fields in WGSL, {} in Rust", members.len(), layout.fields.len()));
    }
    for (member, field) in members.iter().zip(layout.fields) {
        let wgsl = (member.name.clone().unwrap_or_default(), member.offset as usize, kind(module, member.ty));
        let rust = (field.name.to_owned(), field.offset, field.kind.to_owned());
        if wgsl != rust {
            found.push(format!("{wgsl:?} in WGSL, {rust:?} in Rust"));
        }
    }
    found
}

fn kind(module: &naga::Module, handle: Type) -> String {
    use naga::{Scalar, TypeInner, VectorSize};
    let scalar = |s: Scalar| match s {
        Scalar::F32 => "f32",
        Scalar::U32 => "u32",
        Scalar::I32 => "i32",
        _ => "?",
    };
    let size = |s: VectorSize| s as u32;
    match &module.types[handle].inner {
        TypeInner::Scalar(s) => scalar(*s).into(),
        TypeInner::Vector { size: n, scalar: s } => format!("vec{}<{}>", size(*n), scalar(*s)),
        TypeInner::Matrix { columns, rows, scalar: s } => format!("mat{}x{}<{}>", size(*columns), size(*rows), scalar(*s)),
        other => format!("{other:?}"),
    }
}
