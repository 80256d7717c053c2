//! Pictures of every size that the adapter can hold.

use super::desk::Desk;

fn captured(size: &str, methods: &[&str]) {
    let desk = Desk::new();
    let sides: Vec<u32> = size.split('x').map(|side| side.parse().expect("a number")).collect();
    for method in methods {
        for name in ["out.png", "out.exr"] {
            desk.run(&format!("capture courtyard --size {size} -m {method} -o {name} -q")).succeeded();
            let found = dejag::picture::load(&desk.path(name)).unwrap_or_else(|error| panic!("{method}: {error}"));
            assert_eq!(found.size(), sides[..], "{method}");
            assert_eq!(found.into_linear().non_finite(), None, "{method}");
        }
    }
}

const METHODS: &[&str] = &["none", "ssaa:spp=2", "msaa", "msaa:resolve=mitchell,weight=luma"];

#[test]
fn one_pixel() {
    captured("1x1", METHODS);
}

#[test]
fn three_by_five() {
    captured("3x5", METHODS);
}

#[test]
fn odd_and_larger_than_full_hd() {
    captured("1921x1081", &["none"]);
}

#[test]
fn as_wide_as_most_adapters_go() {
    captured("16384x16", METHODS);
}

#[test]
fn as_high_as_most_adapters_go() {
    captured("16x16384", &["none"]);
}

#[test]
fn every_view_of_one_pixel() {
    let desk = Desk::new();
    for view in ["colour", "color", "depth", "motion", "ids"] {
        for name in ["out.png", "out.exr"] {
            desk.run(&format!("capture pan --frame 2 --view {view} --size 1x1 -o {name}")).succeeded();
        }
    }
}

#[test]
fn one_pixel_is_scored() {
    let desk = Desk::new();
    let ran = desk.run("score edges --size 1x1 -m none -m ssaa:spp=2 --reference ssaa:spp=4 --repeats 1 --json -");
    assert_eq!(ran.succeeded().json()["size"], serde_json::json!([1, 1]));
}
