//! Files that are not what they should be.

use std::fs;

use dejag::picture::{Apng, DisplayPicture};

use super::desk::{Desk, levels, picture};

fn desk() -> Desk {
    let desk = Desk::new();
    desk.put("a.png", &picture(&levels()));
    desk
}

#[test]
fn a_png_cut_off_at_every_byte() {
    let desk = Desk::new();
    let small = DisplayPicture::from_rgba8(3, 2, &[9; 24]).expect("3x2");
    desk.put("a.png", &small);
    let whole = fs::read(desk.path("a.png")).expect("there");
    for length in 0..whole.len() {
        desk.write(format!("x/{length:03}.png"), &whole[..length]);
        desk.write(format!("y/{length:03}.png"), &whole);
        desk.write(format!("z/{length:03}.png"), &whole[..length]);
    }
    // Without the end chunk alone all pixels are there, and decoders take it.
    let (code, json) = desk.json("x y");
    let unreadable = json["counts"]["unreadable"].as_u64().expect("a count");
    assert_eq!(code, 3);
    assert!(unreadable >= whole.len() as u64 - 12, "{unreadable} of {}", whole.len());
    assert_eq!(json["counts"]["same"].as_u64().expect("a count") + unreadable, whole.len() as u64);
    // Nor does it help that both are cut off alike.
    assert_eq!(desk.json("x z").1["counts"]["unreadable"].as_u64(), Some(unreadable));
}

#[test]
fn bytes_decide_not_names() {
    let desk = desk();
    desk.write("a.jpg", fs::read(desk.path("a.png")).expect("there"));
    desk.line("a.png a.jpg").ended(0, &["equal"]);
    for (bytes, words) in [("", "it is empty"), ("no picture at all", "begins like none"), ("\u{89}PNG", "begins like none")] {
        desk.write("bad.png", bytes);
        desk.line("a.png bad.png").ended(3, &["unreadable", words]);
        desk.line("bad.png a.png").ended(3, &["unreadable", words]);
    }
}

#[test]
fn results_take_no_picture_s_place() {
    let desk = desk();
    let before = fs::read(desk.path("a.png")).expect("there");
    for option in ["--json", "--junit"] {
        desk.line(&format!("a.png a.png {option} a.png")).ended(2, &["holds something else"]);
    }
    assert_eq!(fs::read(desk.path("a.png")).expect("there"), before);
}

#[test]
fn a_bad_checksum_is_an_error() {
    let desk = desk();
    let mut bytes = fs::read(desk.path("a.png")).expect("there");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 0x10;
    desk.write("bad.png", bytes);
    desk.line("a.png bad.png").ended(3, &["unreadable"]);
}

#[test]
fn animations_and_several_pages_are_refused() {
    let desk = desk();
    let mut book = Apng::begin(&desk.path("book.png"), [32, 24], 2, 0.5).expect("begun");
    (0..2).for_each(|_| book.add(&picture(&levels())).expect("added"));
    book.finish().expect("written");
    desk.line("a.png book.png").ended(3, &["animation"]);
    for big in [false, true] {
        desk.write("pages.tif", tiff(2, big));
        desk.line("a.png pages.tif").ended(3, &["several pages"]);
        desk.write("page.tif", tiff(1, big));
        desk.line("page.tif page.tif").ended(0, &["equal"]);
    }
}

/// A TIFF of pages of one grey pixel each, classic or big.
fn tiff(pages: u16, big: bool) -> Vec<u8> {
    let offset = |bytes: &mut Vec<u8>, value: usize| {
        if big { bytes.extend((value as u64).to_le_bytes()) } else { bytes.extend((value as u32).to_le_bytes()) }
    };
    let mut bytes: Vec<u8> = if big { vec![b'I', b'I', 43, 0, 8, 0, 0, 0] } else { vec![b'I', b'I', 42, 0] };
    // The pixel stands behind the header, the first directory behind it.
    let pixel = if big { 16 } else { 8 };
    offset(&mut bytes, pixel + 2);
    bytes.extend([77, 0]);
    let entries: [(u16, u16, usize); 9] =
        [(256, 3, 1), (257, 3, 1), (258, 3, 8), (259, 3, 1), (262, 3, 1), (273, 4, pixel), (277, 3, 1), (278, 3, 1), (279, 4, 1)];
    for page in 1..=pages {
        let length = if big { 8 + 20 * entries.len() + 8 } else { 2 + 12 * entries.len() + 4 };
        let next = if page < pages { bytes.len() + length } else { 0 };
        if big {
            bytes.extend((entries.len() as u64).to_le_bytes());
        } else {
            bytes.extend((entries.len() as u16).to_le_bytes());
        }
        for (tag, kind, value) in entries {
            bytes.extend(tag.to_le_bytes());
            bytes.extend(kind.to_le_bytes());
            offset(&mut bytes, 1);
            offset(&mut bytes, value);
        }
        offset(&mut bytes, next);
    }
    bytes
}

#[test]
fn bombs_are_refused_by_their_headers() {
    let desk = desk();
    // 60000 x 4000 pixels of RGBA in the header, and no pixel.
    let mut bomb = fs::read(desk.path("a.png")).expect("there");
    bomb[16..24].copy_from_slice(&[0, 0, 0xea, 0x60, 0, 0, 0x0f, 0xa0]);
    let crc = crc(&bomb[12..29]);
    bomb[29..33].copy_from_slice(&crc.to_be_bytes());
    desk.write("bomb.png", &bomb);
    desk.line("a.png bomb.png --max-memory 500MiB")
        .ended(3, &["60000x4000 pixels take 915 MiB", "limit for a picture is 500 MiB"]);
    desk.line("a.png bomb.png").ended(3, &["unreadable"]);
    desk.line("a.png a.png --max-memory 3071").ended(3, &["32x24 pixels take 3072 bytes"]);
    desk.line("a.png a.png --max-memory 3072").ended(0, &[]);
    bomb[16] = 0x7f;
    let crc = self::crc(&bomb[12..29]);
    bomb[29..33].copy_from_slice(&crc.to_be_bytes());
    desk.write("bomb.png", &bomb);
    desk.line("a.png bomb.png --max-memory 9999GiB").ended(3, &["unreadable"]);
}

/// The checksum of a PNG's chunk.
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc: u32, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg()))
    })
}

#[test]
fn a_cmyk_jpeg_is_compared_in_rgb() {
    let desk = desk();
    desk.write("cmyk.jpg", CMYK);
    desk.line("cmyk.jpg cmyk.jpg").ended(0, &["all 64 compared pixels are equal"]);
    let red = DisplayPicture::from_rgba8(8, 8, &[255, 0, 0, 255].repeat(64)).expect("8x8");
    desk.put("red.png", &red);
    desk.line("red.png cmyk.jpg --per-channel 8/255").ended(0, &[]);
}

#[cfg(unix)]
#[test]
fn pipes_folders_and_devices_are_not_waited_for() {
    let desk = desk();
    let made = std::process::Command::new("mkfifo").arg(desk.path("pipe.png")).status().expect("mkfifo runs");
    assert!(made.success());
    desk.line("a.png pipe.png").ended(3, &["no regular file"]);
    desk.line("a.png /dev/null").ended(3, &["no regular file"]);
    fs::create_dir(desk.path("folder.png")).expect("made");
    desk.line("a.png folder.png").ended(2, &["name two folders or two files"]);
}

/// Red, 8x8, as cyan, magenta, yellow and black.
const CMYK: &[u8] = &[
    255, 216, 255, 238, 0, 14, 65, 100, 111, 98, 101, 0, 100, 0, 0, 0, 0, 0, 255, 219, 0, 67, 0, 3, 2, 2, 3, 2, 2, 3, 3, 3, 3, 4,
    3, 3, 4, 5, 8, 5, 5, 4, 4, 5, 10, 7, 7, 6, 8, 12, 10, 12, 12, 11, 10, 11, 11, 13, 14, 18, 16, 13, 14, 17, 14, 11, 11, 16, 22,
    16, 17, 19, 20, 21, 21, 21, 12, 15, 23, 24, 22, 20, 24, 18, 20, 21, 20, 255, 192, 0, 20, 8, 0, 8, 0, 8, 4, 67, 17, 0, 77, 17,
    0, 89, 17, 0, 75, 17, 0, 255, 196, 0, 20, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9, 255, 196, 0, 20, 16, 1, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 218, 0, 14, 4, 67, 0, 77, 0, 89, 0, 75, 0, 0, 63, 0, 84, 197, 80, 170, 42,
    111, 255, 217,
];
