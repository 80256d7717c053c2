//! What becomes of pictures: copied, converted, left out, or said to be missing.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use super::*;
use crate::picture::{Channels, LinearPicture, Raster};

fn pictures(expected: Option<PathBuf>, actual: Option<PathBuf>) -> CasePictures {
    CasePictures { expected, actual, heat: None }
}

/// The PNGs in the script of the case of that number.
fn in_script(desk: &Desk, number: usize) -> Vec<Vec<u8>> {
    let text = fs::read_to_string(desk.path(&format!("report/pixels/{number:05}.js"))).expect("a script");
    let quoted = text.split('"').skip(3).step_by(2);
    quoted.map(|png| STANDARD.decode(png).expect("base64")).collect()
}

fn names(desk: &Desk, folder: &str) -> Vec<String> {
    let entries = fs::read_dir(desk.path("report").join(folder)).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn plain_pictures_are_copied_byte_for_byte_and_shown_small() {
    let desk = Desk::new();
    let (expected, actual) = (desk.put("e.png", 0.2), desk.put("a.png", 0.4));
    desk.write(&two(), &[], |_| pictures(Some(expected.clone()), Some(actual.clone())));
    let own = [fs::read(&expected).expect("read"), fs::read(&actual).expect("read")];
    assert_eq!(in_script(&desk, 2), own);
    assert_eq!(fs::read(desk.path("report/pictures/00002-expected.png")).expect("read"), own[0]);
    // What is the same is kept small, its values in the script alone.
    let all = ["00001-actual-small.png", "00001-expected-small.png", "00002-actual-small.png", "00002-actual.png"];
    assert_eq!(names(&desk, "pictures")[..4], all);
    let small = |number| Raster::read(&desk.path(&format!("report/pictures/0000{number}-actual-small.png")), 1 << 20);
    assert_eq!(small(1).expect("read").size(), [134, 67]);
    assert_eq!(small(2).expect("read").size(), [200, 100]);
}

#[test]
fn twins_are_kept_once() {
    let desk = Desk::new();
    let (expected, actual) = (desk.put("e.png", 0.5), desk.put("a.png", 0.5));
    let mut run = two();
    // The first by its pixels, the second by its hashes, of which the golden is then not even read.
    run.cases[1] = case("calmer", DiffOutcome::Same, 0);
    run.cases[1].candidate_hash = Some("aa".into());
    let absent = desk.path("absent.png");
    let page = desk.write(&run, &[], |case| {
        pictures(Some(if case.id == "calm" { expected.clone() } else { absent.clone() }), Some(actual.clone()))
    });
    assert_eq!(names(&desk, "pictures"), ["00001-actual-small.png", "00002-actual-small.png"]);
    assert_eq!((in_script(&desk, 1).len(), in_script(&desk, 2).len()), (1, 1));
    assert!(!page.contains("cannot be shown") && !page.contains("not at hand"));
}

#[test]
fn what_passes_without_being_equal_keeps_both() {
    let desk = Desk::new();
    let (expected, actual) = (desk.put("e.png", 0.5), desk.put("a.png", 0.51));
    desk.write(&two(), &[], |_| pictures(Some(expected.clone()), Some(actual.clone())));
    assert_eq!(in_script(&desk, 1).len(), 2);
}

#[test]
fn missing_and_unreadable_pictures_are_said_and_do_no_harm() {
    let desk = Desk::new();
    let (good, absent, broken) = (desk.put("good.png", 0.5), desk.path("absent.png"), desk.path("broken.png"));
    fs::write(&broken, b"\x89PNG\r\n\x1a\n and then nothing").expect("written");
    let ids = ["none", "absent", "broken"];
    let run = results(ids.iter().map(|id| case(id, DiffOutcome::Different, 20)).collect());
    let page = desk.write(&run, &[], |case| match case.id.as_str() {
        "none" => CasePictures::default(),
        "absent" => CasePictures { expected: Some(absent.clone()), actual: Some(good.clone()), heat: Some(absent.clone()) },
        _ => pictures(Some(broken.clone()), Some(desk.path(""))),
    });
    assert_eq!(page.matches("picture is not at hand").count(), 2);
    assert_eq!(page.matches("picture cannot be shown").count(), 4);
    assert_eq!(values(&page, "data-pixels"), ["pixels/00002.js"]);
    assert_eq!(names(&desk, "pixels"), ["00002.js"]);
}

#[test]
fn deep_pictures_keep_16_bits_and_floats_become_display_values() {
    let desk = Desk::new();
    let (deep, float) = (desk.path("deep.png"), desk.path("float.exr"));
    let picture = DisplayPicture::from_rgba16(2, 1, &[1, 257, 65_534, 40_000, 9, 8, 7, 65_535]).expect("two pixels");
    picture.save_png(&deep, BitDepth::Sixteen, &[]).expect("written");
    let light = LinearPicture::new(2, 1, vec![[0.5, 2.0, f32::NAN, 1.0], [0.0, 0.18, 1.0, 1.0]]).expect("two pixels");
    light.save_exr(&float, &[]).expect("written");
    desk.write(&two(), &[], |_| pictures(Some(deep.clone()), Some(float.clone())));
    let levels: Vec<Vec<u16>> = in_script(&desk, 2)
        .iter()
        .map(|png| {
            fs::write(desk.path("copy.png"), png).expect("written");
            let raster = Raster::read(&desk.path("copy.png"), 1 << 20).expect("read");
            let Channels::Sixteen(levels) = raster.channels() else { panic!("not of 16 bits") };
            levels.to_vec()
        })
        .collect();
    assert_eq!(levels[0], [1, 257, 65_534, 40_000, 9, 8, 7, 65_535]);
    // sRGB of 0.5 and 0.18; what is above 1 is cut off, what is no number is 0.
    assert_eq!(levels[1], [48_192, 65_535, 0, 65_535, 0, 30_235, 65_535, 65_535]);
}
