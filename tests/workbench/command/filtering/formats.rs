//! What goes in comes out: depths, alpha, profiles, linear light, sizes, views.

use std::path::Path;

use dejag::capture::PictureFilter;
use dejag::methods::{METHODS, Spec};
use dejag::picture::{BitDepth, DisplayPicture, FileKind, LinearPicture, Loaded, PictureFile, load};

use super::{Desk, filter, jagged, put, refused, smoothed};

/// A file as the crate reads it, made of PNG bytes of this form.
fn put_png(desk: &Desk, name: &str, color: png::ColorType, depth: png::BitDepth, icc: Option<&[u8]>) {
    let mut info = png::Info::with_size(16, 9);
    (info.color_type, info.bit_depth) = (color, depth);
    info.icc_profile = icc.map(|icc| icc.to_vec().into());
    let bytes: Vec<u8> = (0..16 * 9 * info.bytes_per_pixel()).map(|i| (i * 89 % 251) as u8).collect();
    let mut file = Vec::new();
    let mut writer = png::Encoder::with_info(&mut file, info).expect("fits").write_header().expect("a header");
    writer.write_image_data(&bytes).expect("pixels");
    writer.finish().expect("an end");
    desk.write(name, file);
}

fn info_of(path: &Path) -> png::Info<'static> {
    let file = std::io::BufReader::new(std::fs::File::open(path).expect("there"));
    png::Decoder::new(file).read_info().expect("a PNG").info().clone()
}

fn profile() -> Vec<u8> {
    let mut bytes: Vec<u8> = (0..200).collect();
    bytes[16..20].copy_from_slice(b"RGB ");
    bytes
}

#[test]
fn an_edge_is_smoothed_and_a_line_says_so() {
    let desk = Desk::new();
    put(&desk, "in.png", &jagged(64, 48, 1.0));
    let ran = smoothed(&desk, "in.png -o out.png");
    assert_eq!((ran.stdout.as_str(), ran.stderr), ("", format!("out.png: in.png with {}, 64x48\n", filter())));
    let picture = load(&desk.path("out.png")).expect("a picture").into_display();
    let between = picture.pixels().iter().filter(|pixel| pixel[0] > 0.15 && pixel[0] < 0.85).count();
    assert!(between > 20, "{between} pixels are neither dark nor bright");
    assert_eq!(smoothed(&desk, "in.png -o out.png -q").stderr, "");
    let twice = desk.run(&format!("filter in.png -o twice.png -m {0}+{0}", filter()));
    twice.succeeded();
    assert_ne!(desk.read("twice.png"), desk.read("out.png"), "the second stage did nothing");
}

#[test]
fn a_png_keeps_its_form_and_its_profile() {
    use png::{BitDepth as Bits, ColorType};
    let desk = Desk::new();
    for color in [ColorType::Grayscale, ColorType::GrayscaleAlpha, ColorType::Rgb, ColorType::Rgba] {
        for depth in [Bits::Eight, Bits::Sixteen] {
            let icc = (color == ColorType::Rgb).then(profile);
            put_png(&desk, "in.png", color, depth, icc.as_deref());
            let ran = smoothed(&desk, "in.png -o out.png");
            assert!(!ran.stderr.contains("warning"), "{ran}");
            let info = info_of(&desk.path("out.png"));
            assert_eq!((info.color_type, info.bit_depth), (color, depth));
            assert_eq!(info.icc_profile.as_deref(), icc.as_deref());
        }
    }
}

#[test]
fn levels_finer_than_8_bits_survive() {
    let desk = Desk::new();
    // Neighbours differ by a few of 65536 levels: nothing is an edge, all would be one colour in 8 bits.
    let levels: Vec<u16> = (0..32 * 8).flat_map(|i: u16| [30_000 + i % 97, 30_000 + i % 89, 30_000, 40_000 + i]).collect();
    let picture = DisplayPicture::from_rgba16(32, 8, &levels).expect("32x8");
    picture.save_png(&desk.path("in.png"), BitDepth::Sixteen, &[]).expect("saved");
    smoothed(&desk, "in.png -o out.png");
    assert_eq!(load(&desk.path("out.png")).expect("a picture").into_display().to_rgba16(), levels);
    let ran = smoothed(&desk, "in.png -o out.webp");
    assert!(ran.stderr.contains("warning: out.webp: 16 bits a channel became 8"), "{ran}");
}

#[test]
fn a_flat_picture_comes_out_bit_for_bit_alpha_too() {
    let desk = Desk::new();
    for alpha in [0_u8, 1, 77, 254, 255] {
        let flat = DisplayPicture::from_rgba8(9, 7, &[13, 130, 240, alpha].repeat(63)).expect("9x7");
        put(&desk, "in.png", &flat);
        for name in ["out.png", "out.webp"] {
            smoothed(&desk, &format!("in.png -o {name}"));
            assert_eq!(load(&desk.path(name)).expect("a picture"), Loaded::Display(flat.clone()), "{name} {alpha}");
        }
    }
}

#[test]
fn linear_light_above_1_stays_linear_light_above_1() {
    let desk = Desk::new();
    let picture = LinearPicture::from_fn(16, 8, |x, _| if x < 8 { [40.0, 8.0, 0.5, 1.0] } else { [60.0, 9.0, 0.25, 0.5] });
    picture.expect("a size").save_exr(&desk.path("in.exr"), &[]).expect("saved");
    smoothed(&desk, "in.exr -o out.exr");
    let Loaded::Linear(found) = load(&desk.path("out.exr")).expect("a picture") else { panic!("not linear") };
    assert_eq!((found.pixel(0, 0), found.pixel(15, 7)), ([40.0, 8.0, 0.5, 1.0], [60.0, 9.0, 0.25, 0.5]));

    let ran = smoothed(&desk, "in.exr -o out.png");
    assert!(ran.stderr.contains("warning: out.png: linear light became sRGB"), "{ran}");
    let info = info_of(&desk.path("out.png"));
    assert_eq!((info.bit_depth, info.srgb.is_some()), (png::BitDepth::Sixteen, true));
}

#[test]
fn formats_become_each_other_as_the_output_is_named() {
    let desk = Desk::new();
    let flat = DisplayPicture::from_rgba8(20, 10, &[200, 100, 50, 255].repeat(200)).expect("20x10");
    put(&desk, "0.png", &flat);
    let names = ["0.png", "1.jpg", "2.webp", "3.exr", "4.JPEG", "5.png"];
    for pair in names.windows(2) {
        smoothed(&desk, &format!("{} -o {} --quality 100", pair[0], pair[1]));
        let file = PictureFile::read(&desk.path(pair[1])).expect("a picture");
        assert_eq!(file.carried.kind, FileKind::of_path(Path::new(pair[1])).expect("known"));
        for (found, wanted) in file.picture.into_display().to_rgba8().iter().zip(flat.to_rgba8()) {
            assert!(found.abs_diff(wanted) <= 3, "{}: {found} for {wanted}", pair[1]);
        }
    }
    let size = |quality: u32| {
        smoothed(&desk, &format!("0.png -o q.jpg --quality {quality}"));
        desk.read("q.jpg").len()
    };
    put(&desk, "0.png", &jagged(64, 48, 1.0));
    assert!(size(10) < size(98));
}

#[test]
fn transparency_is_never_dropped_silently() {
    let desk = Desk::new();
    put(&desk, "in.png", &jagged(16, 16, 0.5));
    refused(&desk, "in.png -o out.jpg", 2, &["out.jpg", "transparent", "JPEG cannot hold", ".png"]);
    put(&desk, "in.png", &jagged(16, 16, 1.0));
    smoothed(&desk, "in.png -o out.jpg");
}

#[test]
fn every_size_down_to_one_pixel() {
    let desk = Desk::new();
    for [width, height] in [[1, 1], [1, 7], [7, 1], [2, 2], [3, 5], [65, 33]] {
        put(&desk, "in.png", &jagged(width, height, 1.0));
        for name in ["out.png", "out.jpg", "out.webp", "out.exr"] {
            smoothed(&desk, &format!("in.png -o {name}"));
            assert_eq!(load(&desk.path(name)).expect("a picture").size(), [width, height], "{name}");
        }
    }
}

#[test]
fn views_are_written_or_those_there_are_listed() {
    let desk = Desk::new();
    put(&desk, "in.png", &jagged(32, 24, 1.0));
    let gpu = crate::common::gpu();
    for method in METHODS.iter().map(|method| method.name) {
        let spec = Spec::parse(method).expect("exists");
        if PictureFilter::check(&spec).is_err() {
            continue;
        }
        let surface = dejag::pass::Surface::display(wgpu::TextureFormat::Rgba8Unorm);
        let built = PictureFilter::new(&gpu, &spec, [1, 1], surface).expect("builds");
        let names = built.views();
        assert!(names.contains(&"edges"), "{method}: {names:?}");
        for name in &names {
            for out in ["view.png", "view.exr"] {
                desk.run(&format!("filter in.png -o {out} -m {method} --view {name}")).succeeded();
                let view = load(&desk.path(out)).expect("a picture").into_display();
                assert!(view.pixels().iter().any(|pixel| *pixel != view.pixel(0, 0)), "{method}: {name} shows nothing");
            }
        }
        let unknown = desk.run(&format!("filter in.png -o no.png -m {method} --view nonsense"));
        unknown.failed(2, &["view"]).failed(2, &names);
        assert!(!desk.path("no.png").exists());
    }
}
