//! Pictures through files and back, and what must be refused.

use super::*;
use std::fs;
use std::path::{Path, PathBuf};

fn sample(width: u32, height: u32) -> DisplayPicture {
    let value = |x: u32, y: u32, k: u32| ((x * 7 + y * 13 + k * 5) % 17) as f32 / 16.0;
    DisplayPicture::from_fn(width, height, |x, y| [value(x, y, 0), value(x, y, 1), value(x, y, 2), value(x, y, 3)])
        .expect("a size")
}

fn linear_sample(width: u32, height: u32) -> LinearPicture {
    LinearPicture::from_fn(width, height, |x, y| [x as f32 * 0.37, y as f32 * -2.5, 1e-8, 0.5]).expect("a size")
}

fn write(folder: &tempfile::TempDir, name: &str, bytes: &[u8]) -> PathBuf {
    let path = folder.path().join(name);
    fs::write(&path, bytes).expect("written");
    path
}

fn png_bytes(picture: &DisplayPicture) -> Vec<u8> {
    let mut bytes = Vec::new();
    picture.encode_png(&mut bytes, BitDepth::Eight, &[]).expect("encoded");
    bytes
}

#[test]
fn sizes_are_checked() {
    assert!(LinearPicture::new(2, 2, vec![[0.0; 4]; 3]).is_err());
    assert!(LinearPicture::new(0, 5, vec![]).is_err());
    assert!(DisplayPicture::from_fn(3, 0, |_, _| [0.0; 4]).is_err());
    assert!(LinearPicture::new(u32::MAX, u32::MAX, vec![]).is_err());
}

#[test]
fn png_keeps_its_levels_at_both_depths() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("picture.png");
    for depth in [BitDepth::Eight, BitDepth::Sixteen] {
        let picture = sample(13, 7);
        picture.save_png(&path, depth, &[("method", "ssaa:spp=4"), ("note", "naïve")]).expect("saved");
        assert_eq!(load(&path).expect("loaded"), Loaded::Display(picture.quantized(depth)));
    }
}

#[test]
fn exr_keeps_every_bit() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("picture.exr");
    let picture = linear_sample(33, 65);
    picture.save_exr(&path, &[("scene", "edges"), ("note", "naïve")]).expect("saved");
    assert_eq!(load(&path).expect("loaded"), Loaded::Linear(picture));
}

#[test]
fn the_same_picture_gives_the_same_bytes() {
    let metadata = [("scene", "edges"), ("method", "none"), ("adapter", "a"), ("driver", "b")];
    let exr = || {
        let mut bytes = std::io::Cursor::new(Vec::new());
        linear_sample(64, 64).encode_exr(&mut bytes, &metadata).expect("encoded");
        bytes.into_inner()
    };
    assert_eq!(exr(), exr());
    assert_eq!(png_bytes(&sample(64, 64)), png_bytes(&sample(64, 64)));
}

#[test]
fn metadata_and_the_srgb_mark_are_in_the_png() {
    let mut bytes = Vec::new();
    sample(2, 2).encode_png(&mut bytes, BitDepth::Eight, &[("scene", "edges")]).expect("encoded");
    let reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a header");
    let info = reader.info();
    assert!(info.srgb.is_some());
    assert_eq!(info.uncompressed_latin1_text[0].text, "edges");
    assert!(sample(2, 2).encode_png(Vec::new(), BitDepth::Eight, &[("", "no key")]).is_err());
}

#[test]
fn unknown_extensions_list_what_exists() {
    assert_eq!(FileFormat::of_path(Path::new("a/B.PNG")).expect("known"), FileFormat::Png);
    for path in ["picture.bmp", "picture"] {
        let text = FileFormat::of_path(Path::new(path)).expect_err("unknown").to_string();
        assert!(text.contains(".png") && text.contains(".exr"), "{text}");
    }
}

#[test]
fn absent_files_and_folders_are_io_errors() {
    let folder = tempfile::tempdir().expect("a folder");
    for path in [folder.path().join("absent.png"), folder.path().to_path_buf()] {
        assert!(matches!(load(&path), Err(Error::Io { .. })), "{}", path.display());
    }
}

#[test]
fn damaged_files_are_format_errors() {
    let folder = tempfile::tempdir().expect("a folder");
    let good = png_bytes(&sample(40, 30));
    let mut flipped = good.clone();
    let middle = flipped.len() / 2;
    flipped[middle] ^= 0x10;
    let mut exr = std::io::Cursor::new(Vec::new());
    linear_sample(40, 30).encode_exr(&mut exr, &[]).expect("encoded");
    let exr = exr.into_inner();
    let cases: [(&str, &[u8], &str); 7] = [
        ("empty.png", b"", "empty"),
        ("text.png", b"not a picture at all", "none of them"),
        ("pointer.png", b"version https://git-lfs.github.com/spec/v1", "git lfs pull"),
        ("short.png", &good[..good.len() / 2], "PNG"),
        ("flipped.png", &flipped, "PNG"),
        ("short.exr", &exr[..exr.len() - 20], "OpenEXR"),
        ("header.exr", &exr[..30], "OpenEXR"),
    ];
    for (name, bytes, expected) in cases {
        let error = load(&write(&folder, name, bytes)).expect_err(name);
        assert!(matches!(error, Error::Format { .. }), "{name}: {error:?}");
        assert!(error.to_string().contains(expected), "{name}: {error}");
    }
}

#[test]
fn a_giant_header_is_refused_before_its_pixels_are_allocated() {
    let folder = tempfile::tempdir().expect("a folder");
    for (width, height) in [(100_000_u32, 100_000_u32), (131_073, 1)] {
        let mut bytes = Vec::new();
        let mut writer = png::Encoder::new(&mut bytes, width, height).write_header().expect("a header");
        writer.write_chunk(png::chunk::IDAT, &[0x78, 0x01]).expect("a chunk");
        drop(writer);
        let error = load(&write(&folder, "giant.png", &bytes)).expect_err("too large").to_string();
        assert!(error.contains("pixels a side"), "{error}");
    }
}

#[test]
fn grey_and_opaque_pngs_become_rgba() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 2, 1);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header().expect("a header").write_image_data(&[0, 255]).expect("pixels");
    let picture = load(&write(&folder, "grey.png", &bytes)).expect("loaded").into_display();
    assert_eq!(picture.pixels(), [[0.0, 0.0, 0.0, 1.0], [1.0; 4]]);
}

#[test]
fn jpegs_are_read_and_cut_ones_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let flat = DisplayPicture::from_rgba8(40, 40, &[200, 100, 50, 255].repeat(40 * 40)).expect("40x40");
    let bytes = jpeg_bytes(&flat);
    let [r, g, b, a] = load(&write(&folder, "good.jpg", &bytes)).expect("loaded").into_display().pixel(20, 20);
    let near = |value: f32, level: f32| (255.0 * value - level).abs() <= 3.0;
    assert!(near(r, 200.0) && near(g, 100.0) && near(b, 50.0) && a == 1.0, "{r} {g} {b} {a}");
    let cut = load(&write(&folder, "cut.jpg", &bytes[..bytes.len() - 60]));
    assert!(matches!(cut, Err(Error::Format { .. })), "{cut:?}");
}

fn webp_bytes(picture: &DisplayPicture) -> Vec<u8> {
    let mut bytes = Vec::new();
    let encoder = image::codecs::webp::WebPEncoder::new_lossless(&mut bytes);
    encoder.encode(&picture.to_rgba8(), picture.width(), picture.height(), image::ExtendedColorType::Rgba8).expect("encoded");
    bytes
}

fn jpeg_bytes(picture: &DisplayPicture) -> Vec<u8> {
    let mut bytes = Vec::new();
    let channels: Vec<u8> = picture.to_rgba8().chunks(4).flat_map(|pixel| pixel[..3].to_vec()).collect();
    let mut encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut bytes, 90);
    encoder.encode(&channels, picture.width(), picture.height(), image::ExtendedColorType::Rgb8).expect("encoded");
    bytes
}

#[test]
fn webps_are_read_and_cut_ones_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let (picture, bytes) = (sample(13, 7), webp_bytes(&sample(13, 7)));
    let found = load(&write(&folder, "good.webp", &bytes)).expect("loaded");
    assert_eq!(found, Loaded::Display(picture.quantized(BitDepth::Eight)));
    let cut = load(&write(&folder, "cut.webp", &bytes[..bytes.len() / 2])).expect_err("cut");
    assert!(matches!(cut, Error::Format { .. }) && cut.to_string().contains("WebP"), "{cut}");
}

#[test]
fn non_finite_pixels_are_counted_from_the_first() {
    let mut pixels = vec![[0.0; 4]; 12];
    assert_eq!(LinearPicture::new(4, 3, pixels.clone()).expect("12 pixels").non_finite(), None);
    pixels[6][1] = f32::NAN;
    pixels[6][2] = f32::INFINITY;
    pixels[11][3] = f32::NEG_INFINITY;
    let found = LinearPicture::new(4, 3, pixels).expect("12 pixels").non_finite();
    assert_eq!(found, Some(NonFinite { pixels: 2, first: [2, 1] }));
}

#[test]
fn crops_and_magnified_pictures() {
    let picture = sample(5, 4);
    let crop = picture.crop(1, 2, 3, 2).expect("inside");
    assert_eq!((crop.size(), crop.pixel(0, 0)), ([3, 2], picture.pixel(1, 2)));
    let large = crop.magnify(3).expect("fits");
    assert_eq!((large.size(), large.pixel(8, 5)), ([9, 6], picture.pixel(3, 3)));
    assert!(picture.crop(3, 0, 3, 1).is_err());
    assert!(picture.crop(u32::MAX, 0, 2, 1).is_err());
    assert!(picture.crop(0, 0, 0, 1).is_err());
    assert!(picture.magnify(0).is_err());
    assert!(picture.magnify(u32::MAX).is_err());
}

#[test]
fn debug_names_encoding_and_size() {
    assert_eq!(format!("{:?}", sample(3, 2)), "DisplayPicture(3x2)");
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(1000))]

    /// Whatever is wrong with a file's bytes, the answer is a picture or an error.
    #[test]
    fn no_bytes_make_loading_panic(
        kind in 0..4,
        changes in proptest::collection::vec((0_usize..4000, 0_u8..=255), 1..6),
        cut in 0_usize..4000,
    ) {
        let mut bytes = match kind {
            0 => {
                let mut bytes = std::io::Cursor::new(Vec::new());
                linear_sample(9, 5).encode_exr(&mut bytes, &[("scene", "edges")]).expect("encoded");
                bytes.into_inner()
            }
            1 => webp_bytes(&sample(9, 5)),
            2 => jpeg_bytes(&sample(9, 5)),
            _ => png_bytes(&sample(9, 5)),
        };
        for (place, byte) in changes {
            let place = 4 + place % (bytes.len() - 4);
            bytes[place] = byte;
        }
        if cut < bytes.len() / 8 {
            bytes.truncate(bytes.len() - cut);
        }
        let folder = tempfile::tempdir().expect("a folder");
        let path = write(&folder, "picture", &bytes);
        let _ = (load(&path), measure(&path));
        if let Ok(file) = PictureFile::read(&path) {
            // Whatever was read can be written, unless the format cannot hold it.
            let kind = file.carried.kind;
            let _ = file.save(&folder.path().join("again"), kind, 95);
        }
    }
}
