//! What a model may be, and everything that may be wrong with one.

use std::path::Path;

use glam::{DVec3, Vec2, Vec3, Vec4};
use serde_json::json;
use tempfile::TempDir;

use super::sample::{F32, I16, Sample, U8, floats, glb, png, png_header};
use crate::error::{Blame, Error, Result};
use crate::scene::{AlphaMode, Instance, Mesh, Scene, Wrap};

fn load(path: &Path) -> Result<Scene> {
    Scene::load(path.to_str().unwrap())
}

/// A sample as a scene.
fn scene(sample: &Sample) -> Result<Scene> {
    let folder = TempDir::new().unwrap();
    load(&sample.write(folder.path()))
}

/// Bytes as a model file with this ending.
fn bytes_as(ending: &str, bytes: &[u8]) -> Result<Scene> {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join(format!("model.{ending}"));
    std::fs::write(&path, bytes).unwrap();
    load(&path)
}

fn instances(scene: &Scene, index: u32) -> Vec<Instance> {
    scene.frame(index, [64, 36]).unwrap().instances
}

fn mesh(sample: &Sample) -> Mesh {
    (*instances(&scene(sample).unwrap(), 0)[0].mesh).clone()
}

/// The model is refused as making no sense, with these words.
fn refused(sample: &Sample, words: &str) {
    match scene(sample) {
        Err(Error::Model { path, message }) => {
            assert!(path.ends_with("model.gltf"), "{path}");
            assert!(message.contains(words), "{message}\nshould speak of: {words}");
        }
        Err(other) => panic!("{other:?}\nshould speak of: {words}"),
        Ok(_) => panic!("this was accepted; expected: {words}"),
    }
}

#[test]
fn a_triangle_is_the_same_in_all_containers() {
    let sample = Sample::triangle();
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("data.bin"), &sample.binary).unwrap();
    let mut external = Sample::triangle();
    external.json["buffers"][0] = json!({ "uri": "data.bin", "byteLength": sample.binary.len() });
    let path = folder.path().join("external.gltf");
    std::fs::write(&path, serde_json::to_vec(&external.json).unwrap()).unwrap();
    let scenes =
        [load(&path), bytes_as("gltf", &sample.inline()), bytes_as("glb", &sample.glb()), bytes_as("GLTF", &sample.glb())];
    for scene in scenes {
        let scene = scene.unwrap();
        assert!(scene.warnings.is_empty() && scene.frames == 1);
        let instances = instances(&scene, 0);
        assert_eq!(instances.len(), 1);
        let mesh = &instances[0].mesh;
        assert_eq!(mesh.indices, [0, 1, 2]);
        let positions: Vec<DVec3> = mesh.vertices.iter().map(|v| v.position).collect();
        assert_eq!(positions, [DVec3::ZERO, DVec3::X * 2.0, DVec3::Y * 2.0]);
        assert!(mesh.vertices.iter().all(|v| v.normal == Vec3::Z && v.color == Vec4::ONE));
        assert_eq!(scene.materials[instances[0].material].metallic, 1.0, "glTF's default material is a metal");
    }
}

#[test]
fn the_fingerprint_follows_every_file() {
    let folder = TempDir::new().unwrap();
    let mut sample = Sample::textured();
    sample.json["images"] = json!([{ "uri": "picture.png" }]);
    sample.json["buffers"][0] = json!({ "uri": "data.bin", "byteLength": sample.binary.len() });
    let path = folder.path().join("model.gltf");
    let fingerprint = |sample: &Sample, picture: &[u8]| {
        std::fs::write(&path, serde_json::to_vec(&sample.json).unwrap()).unwrap();
        std::fs::write(folder.path().join("data.bin"), &sample.binary).unwrap();
        std::fs::write(folder.path().join("picture.png"), picture).unwrap();
        load(&path).unwrap().fingerprint
    };
    let first = fingerprint(&sample, &png(2, 2));
    assert_eq!(first, fingerprint(&sample, &png(2, 2)));
    assert_ne!(first, fingerprint(&sample, &png(3, 2)));
    sample.binary[12] ^= 1;
    assert_ne!(first, fingerprint(&sample, &png(2, 2)));
}

#[test]
fn textures_come_from_views_files_and_data_uris_with_their_samplers() {
    let folder = TempDir::new().unwrap();
    std::fs::create_dir(folder.path().join("sub")).unwrap();
    std::fs::write(folder.path().join("sub/a b.png"), png(2, 2)).unwrap();
    let data = base64::Engine::encode(&base64::engine::general_purpose::STANDARD, png(2, 2));
    let images = [
        json!({ "bufferView": 2, "mimeType": "image/png" }),
        json!({ "uri": "sub/a%20b.png" }),
        json!({ "uri": "sub/a b.png" }),
        json!({ "uri": "sub\\a b.png" }),
        json!({ "uri": "sub/../sub/a b.png" }),
        json!({ "uri": format!("data:image/png;base64,{data}") }),
    ];
    for image in images {
        let mut sample = Sample::textured();
        sample.json["images"][0] = image.clone();
        sample.json["samplers"] = json!([{ "magFilter": 9728, "wrapS": 33071, "wrapT": 33648 }]);
        sample.json["textures"][0]["sampler"] = json!(0);
        let scene = load(&sample.write(folder.path())).unwrap_or_else(|error| panic!("{image}: {error}"));
        let material = &scene.materials[instances(&scene, 0)[0].material];
        let texture = &scene.textures[material.base_color_texture.unwrap().texture];
        assert_eq!((texture.width, texture.height, texture.srgb, texture.nearest), (2, 2, true, true));
        assert_eq!(texture.wrap, [Wrap::Clamp, Wrap::Mirror]);
        assert_eq!(&texture.rgba8[..8], [0, 0, 7, 255, 100, 0, 7, 255]);
    }
}

#[test]
fn a_picture_is_decoded_once_for_each_way_it_is_read() {
    let mut sample = Sample::textured();
    sample.json["materials"] = json!([{
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 }, "metallicRoughnessTexture": { "index": 0 } },
        "emissiveTexture": { "index": 0 }, "normalTexture": { "index": 0, "scale": 0.5 },
    }]);
    let scene = scene(&sample).unwrap();
    assert_eq!(scene.textures.iter().map(|t| t.srgb).collect::<Vec<_>>(), [true, false]);
    let material = &scene.materials[0];
    assert_eq!(material.base_color_texture, material.emissive_texture);
    assert_eq!(material.normal_texture, material.metallic_roughness_texture);
    assert_eq!(material.normal_scale, 0.5);
}

#[test]
fn materials_keep_their_factors() {
    let mut sample = Sample::textured();
    sample.json["extensionsUsed"] = json!(["KHR_materials_unlit", "KHR_materials_emissive_strength"]);
    sample.json["extensionsRequired"] = sample.json["extensionsUsed"].clone();
    sample.json["materials"] = json!([{
        "pbrMetallicRoughness": { "baseColorFactor": [0.5, 0.25, 1, 0.75], "metallicFactor": 0.25, "roughnessFactor": 0.5 },
        "emissiveFactor": [1, 0.5, 0],
        "alphaMode": "MASK",
        "alphaCutoff": 0.25,
        "doubleSided": true,
        "extensions": { "KHR_materials_unlit": {}, "KHR_materials_emissive_strength": { "emissiveStrength": 20 } },
    }]);
    let scene = scene(&sample).unwrap();
    let material = &scene.materials[0];
    assert_eq!(material.base_color, Vec4::new(0.5, 0.25, 1.0, 0.75));
    assert_eq!((material.metallic, material.roughness), (0.25, 0.5));
    assert_eq!(material.emissive, Vec3::new(20.0, 10.0, 0.0));
    assert_eq!(material.alpha, AlphaMode::Mask { cutoff: 0.25 });
    assert!(material.unlit && material.double_sided && scene.warnings.is_empty());
}

#[test]
fn what_is_left_out_is_said_once() {
    let mut sample = Sample::textured();
    sample.json["extensionsUsed"] = json!(["KHR_materials_clearcoat"]);
    sample.json["materials"][0]["alphaMode"] = json!("BLEND");
    sample.json["materials"][0]["name"] = json!("haze");
    sample.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = json!(1);
    sample.json["nodes"] = json!([{ "mesh": 0, "skin": 0, "children": [1, 2] }, { "mesh": 1 }, { "mesh": 0 }]);
    sample.json["skins"] = json!([{ "joints": [1] }]);
    let position = sample.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"].clone();
    sample.json["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": position }]);
    let points = json!({ "primitives": [{ "attributes": { "POSITION": position }, "mode": 0 }] });
    sample.json["meshes"].as_array_mut().unwrap().push(points);
    let scene = scene(&sample).unwrap();
    let expected = ["KHR_materials_clearcoat", "'haze' blends", "TEXCOORD_0", "skin", "morph targets", "points or lines"];
    assert_eq!(scene.warnings.len(), expected.len(), "{:?}", scene.warnings);
    for words in expected {
        assert!(scene.warnings.iter().any(|warning| warning.contains(words)), "{words}: {:?}", scene.warnings);
    }
    assert_eq!(scene.materials[0].alpha, AlphaMode::Opaque);
    assert_eq!(instances(&scene, 0).len(), 2);
}

#[test]
fn strips_fans_and_vertex_colours_are_drawn() {
    let corners = floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0]);
    for (mode, order) in [(5, [0, 1, 2, 3]), (6, [0, 1, 3, 2])] {
        let mut sample = Sample::triangle();
        sample.attribute("POSITION", &corners, F32, "VEC3", 4);
        sample.attribute("NORMAL", &floats(&[0.0, 0.0, 1.0].repeat(4)), F32, "VEC3", 4);
        sample.attribute("COLOR_0", &[255, 51, 0].repeat(4), U8, "VEC3", 4);
        sample.json["accessors"][3]["normalized"] = json!(true);
        sample.indices(&order);
        sample.json["meshes"][0]["primitives"][0]["mode"] = json!(mode);
        let mesh = mesh(&sample);
        assert_eq!(mesh.indices.len(), 6, "mode {mode}");
        for [a, b, c] in mesh.triangles() {
            assert!((b.position - a.position).cross(c.position - a.position).z > 0.0, "mode {mode} faces the viewer");
        }
        assert_eq!(mesh.vertices[0].color, Vec4::new(1.0, 0.2, 0.0, 1.0));
    }
}

#[test]
fn quantised_sparse_and_interleaved_accessors_are_read() {
    let mut quantised = Sample::triangle();
    let corners: Vec<u8> = [0_i16, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0, 0].iter().flat_map(|x| x.to_le_bytes()).collect();
    quantised.attribute("POSITION", &corners, I16, "VEC3", 3);
    quantised.json["bufferViews"][1]["byteStride"] = json!(8);
    quantised.json["accessors"][1]["normalized"] = json!(true);
    quantised.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    quantised.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    let positions: Vec<DVec3> = mesh(&quantised).vertices.iter().map(|v| v.position).collect();
    assert_eq!(positions, [DVec3::ZERO, DVec3::X, DVec3::NEG_Y]);

    let mut sparse = Sample::triangle();
    let (places, values) = (sparse.view(&[2, 0]), sparse.view(&floats(&[0.0, 5.0, 0.0])));
    sparse.json["accessors"][0]["sparse"] = json!({
        "count": 1,
        "indices": { "bufferView": places, "componentType": U8 },
        "values": { "bufferView": values },
    });
    assert_eq!(mesh(&sparse).vertices[2].position, DVec3::Y * 5.0);
}

#[test]
fn texture_transforms_are_baked_where_all_textures_share_them() {
    let transform = json!({ "KHR_texture_transform": { "offset": [0.5, 0], "scale": [2, 3] } });
    let mut sample = Sample::textured();
    sample.json["extensionsUsed"] = json!(["KHR_texture_transform"]);
    sample.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = transform.clone();
    sample.json["materials"][0]["normalTexture"] = json!({ "index": 0, "extensions": transform });
    let shared = scene(&sample).unwrap();
    assert!(shared.warnings.is_empty(), "{:?}", shared.warnings);
    let uvs: Vec<Vec2> = instances(&shared, 0)[0].mesh.vertices.iter().map(|v| v.uv).collect();
    assert_eq!(uvs, [Vec2::new(0.5, 3.0), Vec2::new(2.5, 3.0), Vec2::new(0.5, 0.0)]);

    sample.json["materials"][0]["normalTexture"] = json!({ "index": 0 });
    let warnings = scene(&sample).unwrap().warnings;
    assert!(warnings.len() == 1 && warnings[0].contains("differently"), "{warnings:?}");
}

#[test]
fn nodes_multiply_their_transforms() {
    let mut sample = Sample::triangle();
    let half = std::f64::consts::FRAC_1_SQRT_2;
    sample.json["nodes"] = json!([
        { "translation": [1, 0, 0], "scale": [2, 2, 2], "children": [1] },
        { "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 5, 0, 1], "mesh": 0, "children": [2] },
        { "rotation": [0, 0, half, half], "mesh": 0 },
    ]);
    let instances = instances(&scene(&sample).unwrap(), 0);
    let corner = |k: usize| instances[k].world_from_object.transform_point3(DVec3::X);
    assert!(corner(0).distance(DVec3::new(1.0, 12.0, 0.0)) < 1e-6, "{}", corner(0));
    assert!(corner(1).distance(DVec3::new(-1.0, 10.0, 0.0)) < 1e-6, "{}", corner(1));
    assert!(std::sync::Arc::ptr_eq(&instances[0].mesh, &instances[1].mesh));
    assert_eq!(instances.iter().map(|instance| instance.id).collect::<Vec<_>>(), [1, 2]);
}

#[test]
fn without_a_scene_all_roots_are_drawn() {
    let mut sample = Sample::triangle();
    sample.json["nodes"] = json!([{ "mesh": 0 }, { "children": [0] }, { "mesh": 0 }]);
    sample.json.as_object_mut().unwrap().remove("scene");
    sample.json.as_object_mut().unwrap().remove("scenes");
    assert_eq!(instances(&scene(&sample).unwrap(), 0).len(), 2);
}

#[test]
fn an_animation_plays_and_begins_again() {
    let animated = scene(&Sample::animated()).unwrap();
    assert_eq!(animated.frames, 120);
    let instance = instances(&animated, 30).remove(0);
    assert!((instance.world_from_object.translation.x - 1.5).abs() < 1e-9);
    assert!((instance.previous_world_from_object.translation.x - 1.45).abs() < 1e-9);

    let folder = TempDir::new().unwrap();
    Sample::animated().write(folder.path());
    let text = "frames = 200\n[camera]\nprojection = 'perspective'\nposition = [0, 0, 9]\ntarget = [0, 0, 0]\n\
                [[objects]]\nposition = [0, 1, 0]\nshape = { gltf = { path = 'model.gltf' } }\nrepeat = [{ count = 2, step = [0, 0, -5] }]\n";
    let looped = Scene::parse(text, "s.toml", folder.path()).unwrap();
    let instances = instances(&looped, 150);
    assert_eq!(instances.len(), 2);
    assert!(instances[1].world_from_object.translation.distance(DVec3::new(1.5, 1.0, -5.0)) < 1e-6);
}

#[test]
fn what_an_animation_shrinks_to_nothing_is_not_drawn() {
    let mut sample = Sample::animated();
    sample.json["nodes"] = json!([{ "mesh": 0, "scale": [1, 1, 1] }, { "mesh": 0 }]);
    sample.json["scenes"][0]["nodes"] = json!([0, 1]);
    sample.json["animations"][0]["channels"][0]["target"]["path"] = json!("scale");
    let scene = scene(&sample).unwrap();
    let ids: Vec<u32> = instances(&scene, 0).iter().map(|instance| instance.id).collect();
    assert_eq!(ids, [2], "its scale is 0 at the first key, and ids stay");
}

#[test]
fn materials_and_textures_of_models_in_a_scene_do_not_mix() {
    let folder = TempDir::new().unwrap();
    Sample::textured().write(folder.path());
    let text = "[camera]\nprojection = 'perspective'\nposition = [0, 0, 9]\ntarget = [0, 0, 0]\n[materials.red]\ncolor = [1, 0, 0]\n\
                [[objects]]\nshape = { gltf = { path = 'model.gltf' } }\n[[objects]]\nshape = { gltf = { path = './model.gltf' } }\n\
                [[objects]]\nshape = { quad = { size = [1, 1] } }\nmaterial = 'red'\n";
    let scene = Scene::parse(text, "s.toml", folder.path()).unwrap();
    let instances = instances(&scene, 0);
    let textures: Vec<_> = instances.iter().map(|i| scene.materials[i.material].base_color_texture.map(|t| t.texture)).collect();
    assert_eq!(textures, [Some(0), Some(1), None]);
    assert_eq!(scene.materials[instances[2].material].base_color, Vec4::new(1.0, 0.0, 0.0, 1.0));
    let missing = text.replace("./model", "no");
    let error = Scene::parse(&missing, "s.toml", folder.path()).unwrap_err();
    assert!(matches!(error, Error::Io { .. }), "{error:?}");
    assert!(error.to_string().contains("no.gltf"));
}

#[test]
fn indices_that_lead_nowhere_are_refused() {
    let cases: &[(&str, serde_json::Value, &str)] = &[
        ("/scene", json!(4), "no scene 4"),
        ("/scenes/0/nodes/0", json!(7), "no node 7"),
        ("/nodes/0/mesh", json!(1), "no mesh 1"),
        ("/nodes/0", json!({ "children": [3] }), "no node 3"),
        ("/meshes/0/primitives/0/attributes/POSITION", json!(99), "no accessor 99"),
        ("/meshes/0/primitives/0/attributes/TEXCOORD_0", json!(99), "no accessor 99"),
        ("/meshes/0/primitives/0/material", json!(3), "no material 3"),
        ("/accessors/0/bufferView", json!(44), "no buffer view 44"),
        ("/bufferViews/0/buffer", json!(2), "no buffer 2"),
        ("/materials/0/pbrMetallicRoughness/baseColorTexture/index", json!(5), "no texture 5"),
        ("/textures/0/source", json!(9), "no image 9"),
        ("/textures/0", json!({ "source": 0, "sampler": 3 }), "no sampler 3"),
        ("/images/0/bufferView", json!(12), "no buffer view 12"),
    ];
    for (pointer, value, words) in cases {
        let mut sample = Sample::textured();
        *sample.json.pointer_mut(pointer).unwrap_or_else(|| panic!("{pointer}")) = value.clone();
        refused(&sample, words);
    }
    let mut sample = Sample::animated();
    sample.json["animations"][0]["channels"][0]["target"]["node"] = json!(5);
    refused(&sample, "no node 5");
    sample.json["animations"][0]["channels"][0]["target"]["node"] = json!(0);
    sample.json["animations"][0]["channels"][0]["sampler"] = json!(5);
    refused(&sample, "no animation sampler 5");
}

#[test]
fn accessors_beyond_their_bytes_are_refused() {
    let cases: &[(&str, serde_json::Value, &str)] = &[
        ("/accessors/0/count", json!(4), "beyond its buffer view of 36 bytes"),
        ("/accessors/0/count", json!(u64::MAX), "beyond its buffer view"),
        (
            "/accessors/0",
            json!({ "bufferView": 0, "byteOffset": 4, "componentType": F32, "type": "VEC3", "count": 3 }),
            "beyond its buffer view",
        ),
        (
            "/accessors/0",
            json!({ "bufferView": 0, "byteOffset": u64::MAX, "componentType": F32, "type": "VEC3", "count": 3 }),
            "beyond its buffer view",
        ),
        ("/bufferViews/0/byteLength", json!(100_000), "beyond its buffer of"),
        ("/bufferViews/0/byteOffset", json!(u64::MAX), "beyond its buffer of"),
        ("/bufferViews/0", json!({ "buffer": 0, "byteLength": 36, "byteStride": 8 }), "byteStride of 8"),
        ("/bufferViews/0", json!({ "buffer": 0, "byteLength": 36, "byteStride": 0 }), "byteStride of 0"),
        ("/bufferViews/0", json!({ "buffer": 0, "byteLength": 36, "byteStride": u64::MAX >> 1 }), "beyond its buffer view"),
        ("/accessors/0/componentType", json!(1), "componentType"),
        ("/accessors/0/type", json!("VEC9"), "type should be"),
        ("/accessors/0/type", json!("MAT4"), "type should be"),
        ("/accessors/0/type", json!("VEC2"), "3 components"),
        ("/accessors/0", json!({ "componentType": F32, "type": "VEC3", "count": 1_u64 << 40 }), "without bytes"),
        ("/accessors/1/count", json!(2), "as many as positions"),
        ("/meshes/0/primitives/0/mode", json!(9), ""),
    ];
    for (pointer, value, words) in cases {
        let mut sample = Sample::textured();
        sample.json["meshes"][0]["primitives"][0]["mode"] = json!(4);
        sample.json["bufferViews"][0]["byteOffset"] = json!(0);
        *sample.json.pointer_mut(pointer).unwrap_or_else(|| panic!("{pointer}")) = value.clone();
        refused(&sample, words);
    }
    for (indices, values, words) in [([3_u8, 0], 12_usize, "sparse index"), ([2, 0], 8, "beyond its buffer view")] {
        let mut sample = Sample::triangle();
        let (places, values) = (sample.view(&indices), sample.view(&floats(&[0.0; 3])[..values]));
        sample.json["accessors"][0]["sparse"] = json!({
            "count": 1, "indices": { "bufferView": places, "componentType": U8 }, "values": { "bufferView": values },
        });
        refused(&sample, words);
    }
}

#[test]
fn vertices_that_do_not_exist_or_are_no_numbers_are_refused() {
    let mut sample = Sample::triangle();
    sample.indices(&[0, 1, 3]);
    refused(&sample, "index 3 and only 3 vertices");
    let mut sample = Sample::triangle();
    let float_indices = sample.accessor(&floats(&[0.0, 1.0, 2.0]), F32, "SCALAR", 3);
    sample.json["meshes"][0]["primitives"][0]["indices"] = json!(float_indices);
    refused(&sample, "unsigned integers");
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut sample = Sample::triangle();
        sample.attribute("POSITION", &floats(&[0.0, 0.0, bad, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]), F32, "VEC3", 3);
        refused(&sample, "not finite");
    }
    let mut sample = Sample::triangle();
    sample.attribute("POSITION", &floats(&[0.0, 0.0, 1e30, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]), F32, "VEC3", 3);
    refused(&sample, "beyond 1e12");
    let mut sample = Sample::triangle();
    sample.json["meshes"][0]["primitives"][0]["attributes"] = json!({});
    refused(&sample, "no POSITION");
}

#[test]
fn trees_with_cycles_or_two_parents_are_refused() {
    let trees = [
        json!([{ "children": [1] }, { "children": [0] }]),
        json!([{ "children": [0] }]),
        json!([{ "children": [1, 2] }, { "children": [3] }, { "children": [3] }, {}]),
        json!([{ "children": [1, 1] }, {}]),
    ];
    for tree in trees {
        let mut sample = Sample::triangle();
        sample.json["nodes"] = tree;
        refused(&sample, "is met twice");
    }
    let mut deep = Sample::triangle();
    let last = 100_000;
    let nodes: Vec<_> =
        (0..=last).map(|k| if k == last { json!({ "mesh": 0 }) } else { json!({ "children": [k + 1] }) }).collect();
    deep.json["nodes"] = json!(nodes);
    assert_eq!(instances(&scene(&deep).unwrap(), 0).len(), 1, "a deep tree is no cycle, and no stack overflows");
}

#[test]
fn transforms_that_are_none_are_refused() {
    let cases = [
        (json!({ "mesh": 0, "rotation": [0, 0, 0, 0] }), "no rotation"),
        (json!({ "mesh": 0, "scale": [1e39, 1, 1] }), "not finite"),
        (json!({ "mesh": 0, "translation": [1e20, 0, 0] }), "beyond"),
        (json!({ "mesh": 0, "matrix": [1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] }), "not an affine"),
        (json!({ "mesh": 0, "matrix": [1e39, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] }), "not finite"),
    ];
    for (node, words) in cases {
        let mut sample = Sample::triangle();
        sample.json["nodes"] = json!([node]);
        refused(&sample, words);
    }
    // A flat or vanished node is nothing to draw, but no mistake either.
    let mut sample = Sample::triangle();
    sample.json["nodes"] = json!([{ "mesh": 0, "scale": [0, 0, 0] }]);
    assert!(instances(&scene(&sample).unwrap(), 0).is_empty());
}

#[test]
fn animations_that_do_not_add_up_are_refused() {
    let with = |input: &[f32], output_count: usize, interpolation: &str| {
        let mut sample = Sample::triangle();
        let input_accessor = sample.accessor(&floats(input), F32, "SCALAR", input.len());
        let output = sample.accessor(&floats(&vec![1.0; 3 * output_count]), F32, "VEC3", output_count);
        sample.json["animations"] = json!([{
            "channels": [{ "sampler": 0, "target": { "node": 0, "path": "translation" } }],
            "samplers": [{ "input": input_accessor, "output": output, "interpolation": interpolation }],
        }]);
        sample
    };
    assert!(scene(&with(&[0.0, 1.0], 6, "CUBICSPLINE")).is_ok());
    refused(&with(&[0.0, 1.0], 2, "CUBICSPLINE"), "do not go together");
    refused(&with(&[0.0, 1.0], 3, "LINEAR"), "do not go together");
    refused(&with(&[1.0, 1.0], 2, "LINEAR"), "ascending");
    refused(&with(&[2.0, 1.0], 2, "STEP"), "ascending");
    refused(&with(&[-1.0, 1.0], 2, "STEP"), "ascending");
    refused(&with(&[0.0, 1e9], 2, "STEP"), "ascending");
    refused(&with(&[0.0, f32::NAN], 2, "STEP"), "not finite");
    refused(&with(&[0.0, 1.0], 2, "WOBBLE"), "interpolation");
}

#[test]
fn extensions_and_versions_that_we_lack_are_refused() {
    let mut sample = Sample::triangle();
    sample.json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    refused(&sample, "requires the extension KHR_draco_mesh_compression");
    for version in ["1.0", "3.0", "two"] {
        let mut sample = Sample::triangle();
        sample.json["asset"]["version"] = json!(version);
        refused(&sample, "expected 2.0");
    }
    let mut old = Sample::triangle().glb();
    old[4] = 1;
    assert!(matches!(bytes_as("glb", &old), Err(Error::Model { .. })));
}

#[test]
fn missing_and_short_buffers_are_the_worlds_fault() {
    let mut sample = Sample::triangle();
    let folder = TempDir::new().unwrap();
    let write = |json: &serde_json::Value| {
        let path = folder.path().join("m.gltf");
        std::fs::write(&path, serde_json::to_vec(json).unwrap()).unwrap();
        load(&path).unwrap_err()
    };
    sample.json["buffers"][0] = json!({ "uri": "gone.bin", "byteLength": 36 });
    let error = write(&sample.json);
    assert!(matches!(&error, Error::Io { path, .. } if path.ends_with("gone.bin")), "{error:?}");
    std::fs::write(folder.path().join("gone.bin"), [0; 35]).unwrap();
    let error = write(&sample.json);
    assert!(matches!(error, Error::Format { .. }) && error.to_string().contains("should have 36 bytes and has 35"), "{error}");
    sample.json["buffers"][0] = json!({ "byteLength": 36 });
    assert!(matches!(write(&sample.json), Error::Model { .. }));
    for uri in ["http://example.org/a.bin", "data:nothing", "data:;base64,!!!!", "ftp:x"] {
        sample.json["buffers"][0] = json!({ "uri": uri, "byteLength": 36 });
        assert!(matches!(write(&sample.json), Error::Model { .. }), "{uri}");
    }
    sample.json["buffers"][0] = json!({ "uri": ".", "byteLength": 36 });
    assert!(matches!(write(&sample.json), Error::Io { .. }), "a folder is no buffer");
}

#[test]
fn pictures_that_lie_about_their_size_or_are_none_are_refused_at_once() {
    let with_picture = |bytes: &[u8]| {
        let mut sample = Sample::textured();
        let view = sample.view(bytes);
        sample.json["images"][0]["bufferView"] = json!(view);
        scene(&sample).unwrap_err()
    };
    let cases: [(&[u8], &str); 6] = [
        (&png_header(100_000, 100_000), "100000x100000 pixels"),
        (&png_header(16_385, 1), "16385x1 pixels"),
        (&png_header(64, 64), "image 0"),
        (&png(4, 4)[..40], "image 0"),
        (b"\xff\xd8\xff\xe0 is how a JPEG begins", "image 0"),
        (b"GIF89a", "neither"),
    ];
    for (bytes, words) in cases {
        let error = with_picture(bytes);
        assert!(matches!(error, Error::Format { .. }) && error.blame() == Blame::World, "{error:?}");
        assert!(error.to_string().contains(words), "{error}\nshould speak of: {words}");
    }
    let mut sample = Sample::textured();
    sample.json["images"][0] = json!({ "uri": "gone.png" });
    assert!(matches!(scene(&sample), Err(Error::Io { .. })));
    sample.json["images"][0] = json!({});
    refused(&sample, "neither a uri nor a bufferView");
}

#[test]
fn bytes_that_are_no_model_are_the_worlds_fault_and_json_that_is_none_is_the_models() {
    for (ending, bytes) in [
        ("gltf", &b""[..]),
        ("gltf", b"\xff\xfe\0\0"),
        ("gltf", b"{ \"asset\": { \"version\": \"2.0\" "),
        ("glb", b"glTF"),
        ("glb", b"glTF\x02\0\0\0"),
        ("glb", b"glTF\x02\0\0\0\x05\0\0\0"),
        ("glb", b"glTF\x02\0\0\0\x0c\0\0\0"),
        ("glb", b"glTF\x02\0\0\0\x14\0\0\0\xff\xff\xff\xffJSON"),
        ("glb", b"glTF\x02\0\0\0\x14\0\0\0\0\0\0\0BIN\0"),
    ] {
        let error = bytes_as(ending, bytes).unwrap_err();
        assert!(matches!(error, Error::Format { .. }), "{bytes:?}: {error:?}");
    }
    for bytes in [&b"{}"[..], b"[]", b"3", b"{ \"asset\": { \"version\": \"2.0\" }, \"nodes\": 4 }"] {
        assert!(matches!(bytes_as("gltf", bytes), Err(Error::Model { .. })));
    }
    let nothing = json!({ "asset": { "version": "2.0" } });
    assert!(bytes_as("gltf", &serde_json::to_vec(&nothing).unwrap()).unwrap_err().to_string().contains("nothing to draw"));
    let folder = TempDir::new().unwrap();
    assert!(matches!(load(&folder.path().join("gone.glb")), Err(Error::Io { .. })));
}

#[test]
fn a_binary_container_cut_anywhere_is_refused() {
    let whole = Sample::textured().glb();
    assert!(bytes_as("glb", &whole).is_ok());
    for length in 0..whole.len() {
        assert!(bytes_as("glb", &whole[..length]).is_err(), "cut at {length} of {}", whole.len());
    }
    let chunkless =
        glb(&serde_json::to_vec(&json!({ "asset": { "version": "2.0" }, "buffers": [{ "byteLength": 4 }] })).unwrap(), &[]);
    assert!(bytes_as("glb", &chunkless).is_err());
}

#[test]
fn the_camera_shows_the_model_and_not_the_floor_that_dwarfs_it() {
    let distance = |scene: &Scene| scene.frame(0, [64, 36]).unwrap().view.position.length();
    let alone = distance(&scene(&Sample::triangle()).unwrap());
    let mut sample = Sample::triangle();
    sample.json["nodes"] = json!([{ "mesh": 0 }, { "mesh": 0 }, { "mesh": 0, "scale": [500, 500, 500] }]);
    sample.json["scenes"][0]["nodes"] = json!([0, 1, 2]);
    assert!((distance(&scene(&sample).unwrap()) - alone).abs() < 1e-6);
}
