//! Models that are none, or that ask for more than anybody has.

use std::time::Duration;

use serde_json::{Value, json};

use super::desk::Desk;

const CAPTURE: &str = "capture m.gltf --size 32x18 -o out.png";

/// One triangle with its buffer beside it.
fn model() -> Value {
    json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "indices": 2, "material": 0 }] }],
        "materials": [{ "pbrMetallicRoughness": {} }],
        "buffers": [{ "byteLength": 66, "uri": "m.bin" }],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": 36 },
            { "buffer": 0, "byteOffset": 36, "byteLength": 24 },
            { "buffer": 0, "byteOffset": 60, "byteLength": 6 },
        ],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0] },
            { "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2" },
            { "bufferView": 2, "componentType": 5123, "count": 3, "type": "SCALAR" },
        ],
    })
}

fn buffer(indices: [u16; 3]) -> Vec<u8> {
    let floats: [f32; 15] = [0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 1.];
    let floats = floats.iter().flat_map(|x| x.to_le_bytes());
    floats.chain(indices.iter().flat_map(|i| i.to_le_bytes())).collect()
}

/// The model with one value changed, found by a JSON pointer; a last key that is not there yet is added.
fn with(pointer: &str, value: Value) -> Value {
    let mut model = model();
    let (parent, key) = pointer.rsplit_once('/').expect("a pointer has a slash");
    match model.pointer_mut(parent).unwrap_or_else(|| panic!("{parent} is in the model")) {
        Value::Array(list) => list[key.parse::<usize>().expect("an index")] = value,
        object => object[key] = value,
    }
    model
}

fn textured(uri: &str) -> Value {
    let mut model = with("/materials/0/pbrMetallicRoughness/baseColorTexture", json!({ "index": 0 }));
    model["textures"] = json!([{ "source": 0 }]);
    model["images"] = json!([{ "uri": uri }]);
    model
}

fn desk_with(model: &Value) -> Desk {
    let desk = Desk::new();
    desk.write("m.bin", buffer([0, 1, 2]));
    desk.write("m.gltf", model.to_string());
    desk
}

/// Refused at once, and without the memory that the file claims to need.
fn refused(desk: &Desk, code: i32, words: &[&str]) {
    let command = if cfg!(target_os = "linux") { desk.limited("ulimit -v 524288", CAPTURE) } else { desk.command(CAPTURE) };
    let ran = desk.refuses_command(command, code, words);
    assert!(ran.took < Duration::from_secs(2), "{ran}");
}

#[test]
fn the_model_that_these_tests_spoil_is_a_good_one() {
    let desk = desk_with(&model());
    desk.run(CAPTURE).succeeded();
    assert_eq!(desk.names(), ["m.bin", "m.gltf", "out.png"]);
}

#[test]
fn files_that_are_no_gltf_are_3() {
    let expectations: [(&[u8], &[&str]); 4] = [
        (b"", &["m.gltf is not a readable glTF model"]),
        (b"hello", &["m.gltf is not a readable glTF model"]),
        (b"\x89PNG\r\n\x1a\n\0\0\0", &["m.gltf is not a readable glTF model"]),
        (b"glTF\x02\0\0\0\xff\xff\xff\x7f\x10\0\0\0JSON{}", &["m.gltf is not a readable glTF model", "cut short"]),
    ];
    let desk = Desk::new();
    for (bytes, words) in expectations {
        desk.write("m.gltf", bytes);
        refused(&desk, 3, words);
    }
    let text = model().to_string();
    for length in (1..text.len()).step_by(97) {
        desk.write("m.gltf", &text[..length]);
        refused(&desk, 3, &["m.gltf is not a readable glTF model"]);
    }
}

#[test]
fn buffers_and_pictures_that_are_not_there_are_3() {
    refused(&desk_with(&with("/buffers/0/uri", json!("none.bin"))), 3, &["none.bin", "check the path"]);
    refused(&desk_with(&textured("none.png")), 3, &["none.png", "check the path"]);
    refused(&desk_with(&with("/buffers/0/byteLength", json!(1_000_000))), 3, &["1000000 bytes", "has 66"]);
    refused(&desk_with(&with("/buffers/0/byteLength", json!(1u64 << 60))), 3, &["has 66"]);
}

#[test]
fn what_is_there_but_leads_nowhere_is_2() {
    let mut no_uri = model();
    no_uri["buffers"] = json!([{ "byteLength": 66 }]);
    let expectations: [(Value, &str); 15] = [
        (no_uri, "no uri"),
        (with("/buffers/0/uri", json!("http://127.0.0.1/m.bin")), "files beside the model"),
        (with("/bufferViews/0/byteLength", json!(1_000_000_000)), "beyond its buffer"),
        (with("/bufferViews/0/byteOffset", json!(1u64 << 63)), "beyond its buffer"),
        (with("/bufferViews/0/byteStride", json!(0)), "byteStride"),
        (with("/accessors/0/count", json!(4_000_000_000u64)), "beyond its buffer view"),
        (with("/accessors/0/byteOffset", json!(1u64 << 62)), "beyond its buffer view"),
        (with("/accessors/0/bufferView", json!(99)), "no buffer view 99"),
        (with("/accessors/0", json!({ "componentType": 5126, "count": 1_000_000_000, "type": "VEC3" })), "at most"),
        (with("/meshes/0/primitives/0/indices", json!(77)), "no accessor 77"),
        (with("/nodes/0/mesh", json!(5)), "no mesh 5"),
        (with("/nodes/0/translation", json!([1e39, 0, 0])), "not finite"),
        (with("/scenes/0/nodes", json!([9])), "no node 9"),
        (with("/scene", json!(4)), "no scene 4"),
        (with("/extensionsRequired", json!(["KHR_draco_mesh_compression"])), "KHR_draco_mesh_compression"),
    ];
    for (model, word) in expectations {
        refused(&desk_with(&model), 2, &["m.gltf", word]);
    }
}

#[test]
fn an_index_beyond_the_vertices_is_2() {
    let desk = desk_with(&model());
    desk.write("m.bin", buffer([0, 1, 60_000]));
    refused(&desk, 2, &["m.gltf", "60000", "3 vertices"]);
}

#[test]
fn nodes_in_a_circle_are_2() {
    let circles = [
        json!([{ "children": [0], "mesh": 0 }]),
        json!([{ "children": [1] }, { "children": [0], "mesh": 0 }]),
        json!([{ "children": [1, 2] }, { "children": [3] }, { "children": [3] }, { "mesh": 0 }]),
    ];
    for nodes in circles {
        refused(&desk_with(&with("/nodes", nodes)), 2, &["m.gltf", "is met twice"]);
    }
}

#[test]
fn a_chain_of_many_nodes_is_drawn() {
    let mut nodes: Vec<Value> = (1..=20_000).map(|next| json!({ "children": [next] })).collect();
    nodes.push(json!({ "mesh": 0 }));
    desk_with(&with("/nodes", json!(nodes))).run(CAPTURE).succeeded();
}

/// A PNG that claims this size and has hardly any data.
fn claiming(side: u32, with_data: bool) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, side, side);
    encoder.set_color(png::ColorType::Rgba);
    let mut writer = encoder.write_header().expect("a header");
    if with_data {
        // An empty zlib stream.
        writer.write_chunk(png::chunk::IDAT, &[0x78, 0x9c, 0x03, 0, 0, 0, 0, 1]).expect("a chunk");
    }
    drop(writer);
    bytes
}

#[test]
fn a_picture_that_claims_ten_billion_pixels_is_3() {
    let desk = desk_with(&textured("huge.png"));
    desk.write("huge.png", claiming(100_000, true));
    refused(&desk, 3, &["huge.png", "100000x100000", "expected 1 to 16384"]);
    desk.write("huge.png", claiming(100_000, false));
    refused(&desk, 3, &["huge.png", "not a readable PNG or JPEG"]);
    desk.write("huge.png", &claiming(100_000, true)[..40]);
    refused(&desk, 3, &["huge.png", "not a readable PNG or JPEG"]);
}
