//! The decoders' entry under bytes that nobody would write.

use crate::picture::{BitDepth, DisplayPicture, LinearPicture, Raster};
use image::{DynamicImage, ImageFormat};
use std::fs;
use std::io::Cursor;

/// Mutations of each file.
const MUTATIONS: u64 = 800;

/// A number that looks random, of a counter (splitmix64).
fn mixed(counter: u64) -> u64 {
    let mut z = counter.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// A small file of every kind and depth.
fn files() -> Vec<Vec<u8>> {
    let picture = DisplayPicture::from_fn(9, 7, |x, y| [x as f32 / 8.0, y as f32 / 6.0, 0.5, 0.75]).expect("a size");
    let mut exr = Cursor::new(Vec::new());
    LinearPicture::from_fn(9, 7, |x, _| [x as f32, 2.0, 0.5, 1.0]).expect("a size").encode_exr(&mut exr, &[]).expect("encoded");
    let mut files = vec![exr.into_inner()];
    for depth in [BitDepth::Eight, BitDepth::Sixteen] {
        let mut png = Vec::new();
        picture.encode_png(&mut png, depth, &[("key", "value")]).expect("encoded");
        files.push(png);
    }
    let image = DynamicImage::ImageRgb8(image::ImageBuffer::from_fn(9, 7, |x, y| image::Rgb([20 * x as u8, 30 * y as u8, 99])));
    for format in [ImageFormat::Jpeg, ImageFormat::WebP, ImageFormat::Tiff] {
        let mut bytes = Cursor::new(Vec::new());
        image.write_to(&mut bytes, format).expect("encoded");
        files.push(bytes.into_inner());
    }
    files
}

/// One to four bytes changed, and of some the end cut off or doubled.
fn mutated(bytes: &[u8], seed: u64) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for k in 0..=mixed(seed) % 4 {
        let place = mixed(seed ^ (k + 1) << 32) as usize % bytes.len();
        let value = mixed(seed ^ (k + 1) << 48);
        bytes[place] = if value & 256 == 0 { value as u8 } else { bytes[place] ^ (1 << (value % 8)) };
    }
    match mixed(!seed) % 8 {
        0 => bytes.truncate(mixed(seed ^ 5) as usize % bytes.len()),
        1 => bytes.extend_from_within(bytes.len() / 2..),
        _ => {}
    }
    bytes
}

#[test]
fn no_bytes_break_the_decoders() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("file");
    let (mut read, mut refused) = (0, 0);
    for (kind, file) in files().iter().enumerate() {
        fs::write(&path, file).expect("written");
        Raster::read(&path, 1 << 20).expect("sound before it is changed");
        for mutation in 0..MUTATIONS {
            fs::write(&path, mutated(file, (kind as u64) << 20 | mutation)).expect("written");
            // Not guarded: a panic fails the test.
            match Raster::read(&path, 1 << 20) {
                Ok(raster) => {
                    read += 1;
                    let [width, height] = raster.size();
                    assert!(raster.row(height - 1).len() == width as usize);
                }
                Err(error) => {
                    refused += 1;
                    assert!(matches!(error, crate::Error::Format { .. } | crate::Error::Io { .. }), "{error:?}");
                }
            }
        }
    }
    assert!(read > 100 && refused > 1000, "{read} read, {refused} refused");
}
