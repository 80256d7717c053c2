//! Depths, channels, encodings, colour spaces: what is compared as numbers and what is not.

use std::io::Cursor;

use dejag::picture::{BitDepth, DisplayPicture, LinearPicture};
use image::{DynamicImage, ImageBuffer, ImageFormat};

use super::desk::{Desk, changed, levels, picture};

/// Writes levels of 16 bits, opaque, each channel of pixel `i` by formula.
fn put_deep(desk: &Desk, name: &str, level: impl Fn(u32) -> u16) {
    let levels: Vec<u16> = (0..32 * 24).flat_map(|i| [level(i), level(i), level(i), 65_535]).collect();
    let picture = DisplayPicture::from_rgba16(32, 24, &levels).expect("32x24");
    picture.save_png(&desk.path(name), BitDepth::Sixteen, &[]).expect("saved");
}

fn encoded(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).expect("encoded");
    bytes.into_inner()
}

#[test]
fn sixteen_bits_are_never_reduced_to_eight() {
    let desk = Desk::new();
    put_deep(&desk, "a.png", |i| 1000 + i as u16);
    put_deep(&desk, "b.png", |i| 1000 + i as u16 + u16::from(i == 77));
    desk.line("a.png b.png").ended(1, &["1 of 768 pixels differ", "(1077, 1077, 1077, 65535)", "--per-channel 1/65535"]);
    desk.line("a.png b.png --per-channel 1/65535").ended(0, &[]);
    // 257 levels of 16 bits are one of 8.
    put_deep(&desk, "c.png", |i| 1000 + i as u16 + 257 * u16::from(i == 77));
    desk.line("a.png c.png --per-channel 1/255").ended(0, &[]);
    desk.line("a.png c.png --per-channel 256/65535").ended(1, &[]);
}

#[test]
fn equal_values_are_equal_in_any_depth_and_layout() {
    let desk = Desk::new();
    let grey: Vec<u8> = (0..32 * 24).map(|i: u32| (i % 251) as u8).collect();
    let of = |channels: usize| -> Vec<u8> { grey.iter().flat_map(|&l| [l, l, l, 255][4 - channels..].to_vec()).collect() };
    let buffers = [
        DynamicImage::ImageLuma8(ImageBuffer::from_raw(32, 24, grey.clone()).expect("32x24")),
        DynamicImage::ImageLumaA8(ImageBuffer::from_raw(32, 24, of(2)).expect("32x24")),
        DynamicImage::ImageRgb8(ImageBuffer::from_raw(32, 24, grey.iter().flat_map(|&l| [l, l, l]).collect()).expect("32x24")),
        DynamicImage::ImageRgba8(ImageBuffer::from_raw(32, 24, of(4)).expect("32x24")),
        DynamicImage::ImageLuma16(
            ImageBuffer::from_raw(32, 24, grey.iter().map(|&l| u16::from(l) * 257).collect()).expect("32x24"),
        ),
    ];
    for (i, image) in buffers.iter().enumerate() {
        desk.write(format!("{i}.png"), encoded(image, ImageFormat::Png));
    }
    for i in 1..buffers.len() {
        desk.line(&format!("0.png {i}.png")).ended(0, &["all 768 compared pixels are equal"]);
        let mut other = grey.clone();
        other[99] ^= 1;
        let other = DynamicImage::ImageLuma8(ImageBuffer::from_raw(32, 24, other).expect("32x24"));
        desk.write("other.png", encoded(&other, ImageFormat::Png));
        desk.line(&format!("{i}.png other.png")).ended(1, &["1 of 768 pixels differ", "at 3,3"]);
    }
}

#[test]
fn colour_under_an_alpha_of_0_does_not_count_but_alpha_does() {
    let desk = Desk::new();
    let with = |pixel: [u8; 4]| {
        let mut levels = levels();
        levels[400..404].copy_from_slice(&pixel);
        picture(&levels)
    };
    desk.put("clear.png", &with([10, 20, 30, 0]));
    desk.put("hidden.png", &with([200, 100, 30, 0]));
    desk.put("faint.png", &with([10, 20, 30, 1]));
    desk.line("clear.png hidden.png").ended(0, &["all 768 compared pixels are equal"]);
    desk.line("clear.png hidden.png --max-flip 0 --max-rmse 0").ended(0, &[]);
    desk.line("clear.png faint.png").ended(1, &["1 of 768", "(10, 20, 30, 0)", "(10, 20, 30, 1)", "1/255"]);
    // A change of alpha alone is seen by metrics of colours too.
    desk.put("opaque.png", &with([10, 20, 30, 255]));
    desk.line("clear.png opaque.png --max-flip 0").ended(1, &["--max-flip 0: missed"]);
    desk.line("clear.png opaque.png --min-psnr 60").ended(1, &["--min-psnr 60: missed"]);
}

#[test]
fn floats_are_compared_as_they_are() {
    let desk = Desk::new();
    let put = |name: &str, light: f32| {
        let pixel = |x: u32, y: u32| if (x, y) == (3, 2) { [light, 2.0, 0.5, 1.0] } else { [8.0, 2.0, 0.5, 1.0] };
        LinearPicture::from_fn(16, 8, pixel).expect("a size").save_exr(&desk.path(name), &[]).expect("saved");
    };
    put("a.exr", 40.0);
    put("same.exr", 40.0);
    put("b.exr", 40.5);
    put("nan.exr", f32::NAN);
    desk.line("a.exr same.exr").ended(0, &[]);
    desk.line("a.exr b.exr").ended(1, &["1 of 128", "(40, 2, 0.5, 1)", "(40.5, 2, 0.5, 1)", "--per-channel 0.5"]);
    desk.line("a.exr b.exr --per-channel 0.5").ended(0, &[]);
    desk.line("a.exr b.exr --per-channel 0.4999").ended(1, &[]);
    desk.line("a.exr nan.exr --per-channel 1000").ended(1, &["NaN", "no number"]);
    desk.line("a.exr nan.exr --max-rmse 1000").ended(1, &["missed"]);
    desk.line("nan.exr nan.exr").ended(0, &[]);
    // What a display cannot show is seen by the plain test alone.
    desk.line("a.exr b.exr --min-psnr 90").ended(0, &["met"]);
}

#[test]
fn tiffs_of_all_depths() {
    let desk = Desk::new();
    let rgb = DynamicImage::ImageRgba8(ImageBuffer::from_raw(32, 24, levels()).expect("32x24"));
    desk.put("a.png", &picture(&levels()));
    desk.write("a.tif", encoded(&rgb, ImageFormat::Tiff));
    desk.write("deep.tiff", encoded(&rgb.to_rgb16().into(), ImageFormat::Tiff));
    desk.write("float.tiff", encoded(&rgb.to_rgb32f().into(), ImageFormat::Tiff));
    desk.put("b.png", &changed(&[(3, 4, 0, 1)]));
    for name in ["a.tif", "deep.tiff"] {
        desk.line(&format!("a.png {name}")).ended(0, &["equal"]);
        desk.line(&format!("b.png {name}")).ended(1, &["1 of 768 pixels differ"]);
    }
    desk.line("float.tiff float.tiff").ended(0, &[]);
    desk.line("a.png float.tiff").ended(1, &["profile", "expected sRGB, actual linear light"]);
}

/// A PNG of 32x24 grey pixels with these chunks of colour.
fn marked(mark: impl Fn(&mut png::Info<'_>)) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut info = png::Info::with_size(32, 24);
    info.color_type = png::ColorType::Rgb;
    info.bit_depth = png::BitDepth::Eight;
    mark(&mut info);
    let encoder = png::Encoder::with_info(&mut bytes, info).expect("a form");
    let mut writer = encoder.write_header().expect("written");
    writer.write_image_data(&[128; 32 * 24 * 3]).expect("written");
    writer.finish().expect("written");
    bytes
}

#[test]
fn values_of_other_colours_are_not_compared_as_numbers() {
    let desk = Desk::new();
    desk.write("plain.png", marked(|_| ()));
    desk.write("srgb.png", marked(|info| info.srgb = Some(png::SrgbRenderingIntent::Perceptual)));
    desk.write("usual.png", marked(|info| info.source_gamma = Some(png::ScaledFloat::from_scaled(45_455))));
    desk.write("linear.png", marked(|info| info.source_gamma = Some(png::ScaledFloat::from_scaled(100_000))));
    desk.write("p3.png", marked(|info| info.icc_profile = Some(vec![1; 200].into())));
    desk.write("p4.png", marked(|info| info.icc_profile = Some(vec![2; 200].into())));
    for same in ["plain.png srgb.png", "srgb.png usual.png", "p3.png p3.png", "linear.png linear.png"] {
        desk.line(same).ended(0, &[]);
    }
    for (pair, words) in [
        ("plain.png linear.png", "expected sRGB, actual gamma 1"),
        ("srgb.png p3.png", "expected sRGB, actual an ICC profile of 200 bytes"),
        ("p3.png p4.png", "ICC profile"),
        ("linear.png p3.png", "gamma 1"),
    ] {
        desk.line(pair).ended(1, &["profile", words]);
        desk.line(&format!("{pair} --ignore-profile")).ended(0, &["equal"]);
        let (code, json) = desk.json(pair);
        assert_eq!((code, &json["pairs"][0]["outcome"], &json["counts"]["profile"]), (1, &"profile".into(), &1.into()));
    }
}

#[test]
fn jpeg_and_webp() {
    let desk = Desk::new();
    let rgb = DynamicImage::ImageRgba8(ImageBuffer::from_raw(32, 24, levels()).expect("32x24"));
    desk.write("a.webp", encoded(&rgb, ImageFormat::WebP));
    desk.write("a.jpg", encoded(&rgb.to_rgb8().into(), ImageFormat::Jpeg));
    desk.put("a.png", &picture(&levels()));
    desk.line("a.png a.webp").ended(0, &["equal"]);
    desk.line("a.png a.jpg").ended(1, &["different"]);
    desk.line("a.jpg a.jpg").ended(0, &[]);
}
