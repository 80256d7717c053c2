//! Pictures through files with all that files carry, and what must be refused or said.

use super::*;
use crate::Error;
use image::codecs::{jpeg::JpegEncoder, webp::WebPEncoder};
use image::{ExtendedColorType, ImageEncoder};
use png::{BitDepth as Bits, ColorType};
use std::path::{Path, PathBuf};

/// Enough of an ICC profile to say what it describes.
fn profile(space: &[u8; 4]) -> Vec<u8> {
    let mut bytes: Vec<u8> = (0..200).collect();
    bytes[16..20].copy_from_slice(space);
    bytes
}

/// EXIF data that hold an orientation and nothing else.
fn exif(orientation: u8) -> Vec<u8> {
    let entry = [0x12, 0x01, 3, 0, 1, 0, 0, 0, orientation, 0, 0, 0];
    [b"II\x2a\0\x08\0\0\0\x01\0".as_slice(), &entry, &[0; 4]].concat()
}

fn save_png(path: &Path, color: ColorType, bits: Bits, describe: impl FnOnce(&mut png::Info<'static>)) -> Vec<u8> {
    let mut info = png::Info::with_size(3, 2);
    (info.color_type, info.bit_depth) = (color, bits);
    describe(&mut info);
    let bytes: Vec<u8> = (0..6 * info.bytes_per_pixel()).map(|i| (i * 41 % 251) as u8).collect();
    let mut file = Vec::new();
    let mut writer = png::Encoder::with_info(&mut file, info).expect("fits").write_header().expect("a header");
    writer.write_image_data(&bytes).expect("pixels");
    writer.finish().expect("an end");
    std::fs::write(path, file).expect("written");
    bytes
}

fn read_png(path: &Path) -> (png::Info<'static>, Vec<u8>) {
    let file = std::io::BufReader::new(std::fs::File::open(path).expect("there"));
    let mut reader = png::Decoder::new(file).read_info().expect("a PNG");
    let mut bytes = vec![0; reader.output_buffer_size().expect("small")];
    reader.next_frame(&mut bytes).expect("pixels");
    (reader.info().clone(), bytes)
}

fn encode_with(mut encoder: impl ImageEncoder, icc: Option<Vec<u8>>, exif: Option<Vec<u8>>) {
    icc.map_or(Ok(()), |icc| encoder.set_icc_profile(icc)).expect("takes profiles");
    exif.map_or(Ok(()), |exif| encoder.set_exif_metadata(exif)).expect("takes EXIF data");
    let pixels: Vec<u8> = (0..24 * 16 * 3).map(|i: u32| (i % 24 * 10) as u8).collect();
    encoder.write_image(&pixels, 24, 16, ExtendedColorType::Rgb8).expect("encoded");
}

fn folder_and(name: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join(name);
    (folder, path)
}

fn again(input: &Path, output: &Path) -> PictureFile {
    let kind = FileKind::of_path(output).expect("known");
    PictureFile::read(input).expect("read").encoded_for(kind).save(output, kind, 95).expect("saved");
    PictureFile::read(output).expect("read again")
}

#[test]
fn every_form_of_png_stays_what_it_is_bit_by_bit() {
    let (folder, path) = folder_and("in.png");
    for color in [ColorType::Grayscale, ColorType::GrayscaleAlpha, ColorType::Rgb, ColorType::Rgba] {
        for bits in [Bits::Eight, Bits::Sixteen] {
            let bytes = save_png(&path, color, bits, |_| {});
            let out = folder.path().join("out.png");
            again(&path, &out);
            let (info, found) = read_png(&out);
            assert_eq!((info.color_type, info.bit_depth, found), (color, bits, bytes), "{color:?} {bits:?}");
        }
    }
}

#[test]
fn a_png_keeps_what_it_says_of_its_colours_its_size_and_its_author() {
    let (folder, path) = folder_and("in.png");
    let out = folder.path().join("out.png");
    save_png(&path, ColorType::Rgb, Bits::Eight, |info| {
        info.icc_profile = Some(profile(b"RGB ").into());
        info.source_gamma = Some(png::ScaledFloat::new(0.625));
        info.pixel_dims = Some(png::PixelDimensions { xppu: 3780, yppu: 3779, unit: png::Unit::Meter });
        info.exif_metadata = Some(exif(1).into());
        info.uncompressed_latin1_text.push(png::text_metadata::TEXtChunk::new("Author", "somebody"));
    });
    again(&path, &out);
    let info = read_png(&out).0;
    assert_eq!(info.icc_profile.as_deref(), Some(&profile(b"RGB ")[..]));
    assert_eq!(info.gama_chunk, Some(png::ScaledFloat::new(0.625)));
    assert_eq!(info.pixel_dims.map(|dims| (dims.xppu, dims.yppu)), Some((3780, 3779)));
    assert_eq!(info.exif_metadata.as_deref(), Some(&exif(1)[..]));
    assert_eq!(info.uncompressed_latin1_text[0].text, "somebody");
    assert_eq!(info.srgb, None, "nobody said sRGB");

    save_png(&path, ColorType::Rgb, Bits::Eight, |info| info.srgb = Some(png::SrgbRenderingIntent::Saturation));
    again(&path, &out);
    assert_eq!(read_png(&out).0.srgb, Some(png::SrgbRenderingIntent::Saturation));
}

#[test]
fn code_points_of_hdr_pngs_are_kept() {
    let (folder, path) = folder_and("in.png");
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, 1, 1);
    encoder.set_color(ColorType::Rgb);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_chunk(png::chunk::ChunkType(*b"cICP"), &[9, 16, 0, 1]).expect("a chunk");
    writer.write_image_data(&[1, 2, 3]).expect("pixels");
    drop(writer);
    std::fs::write(&path, file).expect("written");
    let out = folder.path().join("out.png");
    again(&path, &out);
    let points = read_png(&out).0.coding_independent_code_points.expect("kept");
    assert_eq!((points.color_primaries, points.transfer_function, points.is_video_full_range_image), (9, 16, true));
}

#[test]
fn profiles_and_exif_data_go_through_jpeg_and_webp() {
    let (folder, path) = folder_and("in");
    let encode: [fn(&mut Vec<u8>); 2] = [
        |file| encode_with(JpegEncoder::new_with_quality(file, 90), Some(profile(b"RGB ")), Some(exif(1))),
        |file| encode_with(WebPEncoder::new_lossless(file), Some(profile(b"RGB ")), Some(exif(1))),
    ];
    for encode in encode {
        let mut file = Vec::new();
        encode(&mut file);
        std::fs::write(&path, file).expect("written");
        for name in ["out.jpg", "out.webp", "out.png"] {
            let found = again(&path, &folder.path().join(name)).carried;
            assert_eq!(found.icc, Some(profile(b"RGB ")), "{name}");
            assert_eq!(found.exif, Some(exif(1)), "{name}");
        }
    }
}

#[test]
fn a_lying_picture_comes_out_upright_and_says_so() {
    let (folder, path) = folder_and("in.webp");
    let mut file = Vec::new();
    encode_with(WebPEncoder::new_lossless(&mut file), None, Some(exif(6)));
    std::fs::write(&path, file).expect("written");
    let lying = load(&path).expect("read").into_display();
    for name in ["out.webp", "out.png", "out.exr"] {
        let found = again(&path, &folder.path().join(name));
        assert!(found.carried.exif.is_none_or(|found| found == exif(1)), "{name} would be turned twice");
        let upright = found.picture.into_display().quantized(BitDepth::Eight);
        assert_eq!(upright.size(), [16, 24], "{name}");
        // A quarter turn clockwise: the left column becomes the top row, read from below.
        assert_eq!(upright.pixel(0, 0), lying.pixel(0, 15), "{name}");
        assert_eq!(upright.pixel(0, 23), lying.pixel(23, 15), "{name}");
    }
}

#[test]
fn exr_keeps_halves_floats_and_alpha_as_they_are() {
    let (folder, path) = folder_and("in.exr");
    let out = folder.path().join("out.exr");
    let [red, green, blue, white] = [(0.7, 0.3), (0.2, 0.8), (0.1, 0.05), (0.3, 0.3)].map(|(x, y)| exr::prelude::Vec2(x, y));
    let primaries = exr::meta::attribute::Chromaticities { red, green, blue, white };
    for (half, alpha) in [(false, false), (false, true), (true, false), (true, true)] {
        let last = if alpha { 0.25 } else { 1.0 };
        let picture = LinearPicture::from_fn(9, 5, |x, y| [x as f32 * 700.0, y as f32 * -0.25, 0.5, last]).expect("a size");
        write_atomically(&path, |file| picture.encode_exr_as(file, half, alpha, Some(primaries))).expect("saved");
        let found = again(&path, &out);
        assert_eq!(found.picture, Loaded::Linear(picture), "{half} {alpha}");
        assert_eq!((found.carried.samples, found.carried.alpha), (if half { Samples::Half } else { Samples::Float }, alpha));
        assert_eq!(found.carried.primaries, Some(primaries));
        assert_eq!(std::fs::read(&path).expect("there"), std::fs::read(&out).expect("there"));
    }
}

#[test]
fn what_a_format_cannot_keep_is_said() {
    let (_folder, path) = folder_and("in.png");
    save_png(&path, ColorType::Rgb, Bits::Sixteen, |info| info.icc_profile = Some(profile(b"RGB ").into()));
    let carried = PictureFile::read(&path).expect("read").carried;
    assert_eq!(carried.losses(FileKind::Png), Vec::<String>::new());
    let said = |carried: &Carried, kind| carried.losses(kind).join("; ");
    assert_eq!(said(&carried, FileKind::WebP), "16 bits a channel became 8, which is what WebP holds");
    assert!(said(&carried, FileKind::Exr).contains("profile was left out"));

    save_png(&path, ColorType::Rgb, Bits::Eight, |info| info.icc_profile = Some(profile(b"CMYK").into()));
    let mut file = PictureFile::read(&path).expect("read");
    assert_eq!(said(&file.carried, FileKind::Png), "its colour profile was left out: it describes CMYK, not RGB");
    file.save(&path, FileKind::Png, 95).expect("saved");
    file = PictureFile::read(&path).expect("read");
    assert_eq!(file.carried.icc, None);

    file.carried.samples = Samples::Half;
    assert!(said(&file.carried, FileKind::Jpeg).contains("outside 0 to 1 is cut off"));
}

#[test]
fn grey_stays_grey_only_while_it_is() {
    let (folder, path) = folder_and("in.png");
    let out = folder.path().join("out.jpg");
    save_png(&path, ColorType::Grayscale, Bits::Eight, |info| info.icc_profile = Some(profile(b"GRAY").into()));
    let found = again(&path, &out).carried;
    assert_eq!((found.grey, found.icc), (true, Some(profile(b"GRAY"))));
    let mut file = PictureFile::read(&path).expect("read");
    file.picture = Loaded::Display(DisplayPicture::new(1, 1, vec![[0.2, 0.4, 0.6, 1.0]]).expect("a pixel"));
    file.save(&out, FileKind::Jpeg, 95).expect("saved");
    let found = PictureFile::read(&out).expect("read").carried;
    assert_eq!((found.grey, found.icc), (false, None));
}

#[test]
fn what_a_format_cannot_hold_is_refused_and_nothing_is_written() {
    let (folder, path) = folder_and("in.png");
    save_png(&path, ColorType::Rgba, Bits::Eight, |_| {});
    let mut file = PictureFile::read(&path).expect("read");
    let refusal = |file: &PictureFile, name: &str, kind| {
        let out = folder.path().join(name);
        let error = file.save(&out, kind, 95).expect_err(name);
        assert!(matches!(error, Error::Request(_)) && !out.exists(), "{error:?}");
        error.to_string()
    };
    assert!(refusal(&file, "out.jpg", FileKind::Jpeg).contains("transparent"));
    assert!(refusal(&file, "out.exr", FileKind::Exr).contains("another encoding"));
    file.picture = Loaded::Display(DisplayPicture::from_fn(16_385, 1, |_, _| [1.0; 4]).expect("a size"));
    assert!(refusal(&file, "out.webp", FileKind::WebP).contains("16384 pixels a side"));
}

#[test]
fn animations_are_refused() {
    let (_folder, path) = folder_and("in");
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, 1, 1);
    encoder.set_animated(2, 0).expect("two frames");
    let mut writer = encoder.write_header().expect("a header");
    (0..2).for_each(|level| writer.write_image_data(&[level]).expect("a frame"));
    writer.finish().expect("an end");
    let animated_webp = [b"RIFF\x20\0\0\0WEBPVP8X\x0a\0\0\0\x02".as_slice(), &[0; 20]].concat();
    for bytes in [file, animated_webp] {
        std::fs::write(&path, bytes).expect("written");
        let error = PictureFile::read(&path).expect_err("several frames");
        assert!(matches!(error, Error::Format { .. }) && error.to_string().contains("animation"), "{error}");
    }
}

#[test]
fn measuring_reads_the_header_alone() {
    let (_folder, path) = folder_and("in.png");
    save_png(&path, ColorType::Rgb, Bits::Eight, |_| {});
    let bytes = std::fs::read(&path).expect("there");
    // Up to and into the pixels.
    std::fs::write(&path, &bytes[..45]).expect("written");
    assert_eq!(measure(&path).expect("a header"), [3, 2]);
    assert!(PictureFile::read(&path).is_err() && load(&path).is_err());
}
