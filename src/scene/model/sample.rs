//! Small models for the tests, made here so that none has to be shipped.

use std::path::{Path, PathBuf};

use base64::Engine;
use serde_json::{Value, json};

/// A model under construction.
pub(super) struct Sample {
    pub(super) json: Value,
    pub(super) binary: Vec<u8>,
}

/// componentType
pub(super) const F32: u32 = 5126;
pub(super) const U16: u32 = 5123;
pub(super) const I16: u32 = 5122;
pub(super) const U8: u32 = 5121;

impl Sample {
    /// One triangle in the plane z = 0, in a node of its own.
    pub(super) fn triangle() -> Self {
        let mut sample = Self {
            json: json!({
                "asset": { "version": "2.0" },
                "scene": 0,
                "scenes": [{ "nodes": [0] }],
                "nodes": [{ "mesh": 0 }],
                "meshes": [{ "primitives": [{ "attributes": {} }] }],
                "accessors": [],
                "bufferViews": [],
                "buffers": [{}],
            }),
            binary: Vec::new(),
        };
        sample.attribute("POSITION", &floats(&[0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 2.0, 0.0]), F32, "VEC3", 3);
        sample
    }

    /// The triangle with uv coordinates and a texture of 2x2 texels in the buffer.
    pub(super) fn textured() -> Self {
        let mut sample = Self::triangle();
        sample.attribute("TEXCOORD_0", &floats(&[0.0, 1.0, 1.0, 1.0, 0.0, 0.0]), F32, "VEC2", 3);
        let view = sample.view(&png(2, 2));
        sample.json["images"] = json!([{ "bufferView": view, "mimeType": "image/png" }]);
        sample.json["textures"] = json!([{ "source": 0 }]);
        sample.json["materials"] = json!([{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]);
        sample.json["meshes"][0]["primitives"][0]["material"] = json!(0);
        sample
    }

    /// The triangle, moved along x from 0 to 6 m within two seconds.
    pub(super) fn animated() -> Self {
        let mut sample = Self::triangle();
        let input = sample.accessor(&floats(&[0.0, 1.0, 2.0]), F32, "SCALAR", 3);
        let output = sample.accessor(&floats(&[0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 6.0, 0.0, 0.0]), F32, "VEC3", 3);
        sample.json["animations"] = json!([{
            "channels": [{ "sampler": 0, "target": { "node": 0, "path": "translation" } }],
            "samplers": [{ "input": input, "output": output }],
        }]);
        sample
    }

    /// Appends bytes to the buffer and returns the index of a view of them.
    pub(super) fn view(&mut self, bytes: &[u8]) -> usize {
        while !self.binary.len().is_multiple_of(4) {
            self.binary.push(0);
        }
        let view = json!({ "buffer": 0, "byteOffset": self.binary.len(), "byteLength": bytes.len() });
        self.binary.extend_from_slice(bytes);
        let views = self.json["bufferViews"].as_array_mut().unwrap();
        views.push(view);
        views.len() - 1
    }

    pub(super) fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        let view = self.view(bytes);
        let accessors = self.json["accessors"].as_array_mut().unwrap();
        accessors.push(json!({ "bufferView": view, "componentType": component, "type": kind, "count": count }));
        accessors.len() - 1
    }

    /// An attribute of the first primitive.
    pub(super) fn attribute(&mut self, name: &str, bytes: &[u8], component: u32, kind: &str, count: usize) {
        let accessor = self.accessor(bytes, component, kind, count);
        self.json["meshes"][0]["primitives"][0]["attributes"][name] = json!(accessor);
    }

    /// Indices of the first primitive.
    pub(super) fn indices(&mut self, indices: &[u16]) {
        let bytes: Vec<u8> = indices.iter().flat_map(|index| index.to_le_bytes()).collect();
        let accessor = self.accessor(&bytes, U16, "SCALAR", indices.len());
        self.json["meshes"][0]["primitives"][0]["indices"] = json!(accessor);
    }

    /// The model with its buffer inside, as JSON text.
    pub(super) fn inline(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        let data = base64::engine::general_purpose::STANDARD.encode(&self.binary);
        json["buffers"][0] =
            json!({ "uri": format!("data:application/octet-stream;base64,{data}"), "byteLength": self.binary.len() });
        serde_json::to_vec(&json).unwrap()
    }

    /// The model as a binary container.
    pub(super) fn glb(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        json["buffers"][0] = json!({ "byteLength": self.binary.len() });
        glb(&serde_json::to_vec(&json).unwrap(), &self.binary)
    }

    /// The model as a file with its buffer inside.
    pub(super) fn write(&self, folder: &Path) -> PathBuf {
        let path = folder.join("model.gltf");
        std::fs::write(&path, self.inline()).unwrap();
        path
    }
}

pub(super) fn glb(json: &[u8], binary: &[u8]) -> Vec<u8> {
    let padded = |bytes: &[u8], filler: u8| {
        let mut bytes = bytes.to_vec();
        bytes.resize(bytes.len().next_multiple_of(4), filler);
        bytes
    };
    let (json, binary) = (padded(json, b' '), padded(binary, 0));
    let u32 = |x: usize| (x as u32).to_le_bytes();
    let parts: [&[u8]; 9] = [
        b"glTF",
        &u32(2),
        &u32(28 + json.len() + binary.len()),
        &u32(json.len()),
        b"JSON",
        &json,
        &u32(binary.len()),
        b"BIN\0",
        &binary,
    ];
    parts.concat()
}

pub(super) fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

/// A grey PNG.
pub(super) fn png(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    let picture = image::RgbaImage::from_fn(width, height, |x, y| image::Rgba([(x * 100) as u8, (y * 100) as u8, 7, 255]));
    picture.write_to(&mut std::io::Cursor::new(&mut bytes), image::ImageFormat::Png).unwrap();
    bytes
}

/// The beginning of a PNG that claims this size: signature, header, and the checksum that makes it credible.
pub(super) fn png_header(width: u32, height: u32) -> Vec<u8> {
    let mut chunk = b"IHDR".to_vec();
    chunk.extend(width.to_be_bytes());
    chunk.extend(height.to_be_bytes());
    chunk.extend([8, 6, 0, 0, 0]);
    let mut bytes = b"\x89PNG\r\n\x1a\n\0\0\0\x0d".to_vec();
    bytes.extend_from_slice(&chunk);
    bytes.extend(crc32(&chunk).to_be_bytes());
    bytes.extend(b"\0\0\0\x01IDAT\0");
    bytes.extend(crc32(b"IDAT\0").to_be_bytes());
    bytes
}

fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, _| if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 };
    !bytes.iter().fold(!0, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), step))
}
