//! Did it change? Small pictures, kept for each environment that draws its own bits.
//!
//! `DEJAG_GOLDENS=update` writes those that differ or are missing. A missing picture fails; an environment without any is listed
//! as not applicable. Lavapipe gives the same bits whatever its threads; across CPUs its arithmetic may differ in the last digit,
//! which lit surfaces show as 1/255 here and there. Two knobs, then: nothing may differ by more than 1/255, and only 1% of pixels at
//! all. Unlit scenes may not differ.

use std::path::{Path, PathBuf};

use dejag::capture::Studio;
use dejag::gpu::Gpu;
use dejag::methods::Spec;
use dejag::picture::{BitDepth, DisplayPicture, load};
use dejag::scene::Scene;

use crate::common;

const SIZE: [u32; 2] = [160, 90];

/// Scene, method, and the share of pixels that may differ by 1/255.
const GOLDENS: &[(&str, &str, f64)] = &[
    ("edges", "none", 0.0),
    ("edges", "msaa:samples=4", 0.0),
    ("edges", "ssaa:spp=16", 0.0),
    ("edges", "adaptive", 0.0),
    ("edges", "fxaa", 0.0),
    ("edges", "mlaa", 0.0),
    ("edges", "smaa", 0.0),
    ("edges", "smaa:mode=s2x", 0.0),
    ("edges", "smaa:mode=t2x", 0.0),
    ("edges", "smaa:mode=4x", 0.0),
    ("edges", "cmaa2", 0.0),
    ("edges", "taa", 0.01),
    ("pan", "taa:preset=quality", 0.01),
    ("wires", "ssaa:spp=64,filter=mitchell", 0.0),
    ("foliage", "msaa:samples=4,a2c=on", 0.01),
    ("neon", "msaa:samples=4,weight=luma", 0.01),
    ("text", "none", 0.0),
    ("courtyard", "none", 0.01),
    ("courtyard", "ssaa:spp=16", 0.01),
    ("courtyard", "adaptive", 0.01),
];

/// `llvmpipe-mesa-22.3.6` from the driver's own words.
fn environment(gpu: &Gpu) -> String {
    let driver = gpu.card.driver.to_lowercase();
    let version = gpu.card.driver_version.to_lowercase();
    let words = version.split_whitespace().take(2).collect::<Vec<_>>().join("-");
    format!("{driver}-{words}").replace(|c: char| !c.is_ascii_alphanumeric() && c != '.', "-")
}

fn file_name(scene: &str, method: &str) -> String {
    format!("{scene}-{}.png", method.replace([':', ',', '='], "-"))
}

/// Whether goldens are written instead of compared.
fn updating() -> bool {
    match std::env::var("DEJAG_GOLDENS").as_deref() {
        Err(_) | Ok("") => false,
        Ok("update") => true,
        Ok(other) => panic!("DEJAG_GOLDENS={other} is not update"),
    }
}

/// Pixels that differ, and the most any channel does in 1/255.
fn difference(a: &DisplayPicture, b: &DisplayPicture) -> (usize, u8) {
    let (a, b) = (a.to_rgba8(), b.to_rgba8());
    let worst = |(p, q): (&[u8], &[u8])| p.iter().zip(q).map(|(x, y)| x.abs_diff(*y)).max().unwrap_or(0);
    let worst: Vec<u8> = a.chunks(4).zip(b.chunks(4)).map(worst).collect();
    (worst.iter().filter(|w| **w > 0).count(), worst.iter().copied().max().unwrap_or(0))
}

fn check(found: &DisplayPicture, path: &Path, share: f64) -> Result<(), String> {
    let golden = load(path).map_err(|e| format!("no golden: {e}"))?.into_display();
    if golden.size() != found.size() {
        return Err(format!("{:?} where the golden is {:?}", found.size(), golden.size()));
    }
    let (pixels, worst) = difference(found, &golden);
    let allowed = (share * golden.pixels().len() as f64) as usize;
    if pixels > allowed || worst > 1 {
        return Err(format!("{pixels} pixels differ (at most {allowed} may), the most by {worst}/255 (at most 1)"));
    }
    Ok(())
}

#[test]
fn pictures_are_the_golden_ones() {
    let gpu = common::gpu();
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("captures");
    let folder = root.join("golden").join(environment(&gpu));
    if !folder.is_dir() && !updating() {
        common::not_applicable(&gpu, "golden pictures (there are none for this environment)");
        return;
    }
    let mut wrong = Vec::new();
    for (name, method, share) in GOLDENS {
        let scene = Scene::load(name).expect("shipped");
        let spec = Spec::parse(method).expect("exists");
        let found = Studio::new(&gpu, &scene).expect("uploads").capture(&spec, 0, SIZE, &mut ()).expect("draws").display;
        let file = file_name(name, method);
        let Err(why) = check(&found, &folder.join(&file), *share) else { continue };
        let actual = if updating() { folder.join(&file) } else { root.join("out/golden").join(&file) };
        std::fs::create_dir_all(actual.parent().expect("in a folder")).expect("a folder");
        found.save_png(&actual, BitDepth::Eight, &[]).expect("writes");
        wrong.push(format!("{file}: {why}; see {}", actual.display()));
    }
    assert!(updating() || wrong.is_empty(), "{}\nlook at them, then: DEJAG_GOLDENS=update", wrong.join("\n"));
}

#[test]
fn the_comparison_can_fail() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("golden.png");
    let picture = |level: u8, size: u32| {
        let level = f32::from(level) / 255.0;
        DisplayPicture::from_fn(size, 10, |_, _| [level, level, level, 1.0]).expect("fits")
    };
    assert!(check(&picture(100, 10), &path, 1.0).is_err(), "a missing golden must fail");
    picture(100, 10).save_png(&path, BitDepth::Eight, &[]).expect("writes");
    assert_eq!(check(&picture(100, 10), &path, 0.0), Ok(()));
    assert!(check(&picture(100, 11), &path, 1.0).is_err(), "another size must fail");
    assert!(check(&picture(101, 10), &path, 0.99).is_err(), "too many pixels must fail");
    assert_eq!(check(&picture(101, 10), &path, 1.0), Ok(()));
    assert!(check(&picture(102, 10), &path, 1.0).is_err(), "too much must fail");
    std::fs::write(&path, b"not a picture").expect("writes");
    assert!(check(&picture(100, 10), &path, 1.0).is_err(), "an unreadable golden must fail");
}
