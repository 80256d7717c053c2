//! Edges by what lies beside the colour: on a small scene with textures, silhouettes, and a shallow step.

use dejag::capture::{Studio, ViewKind};
use dejag::methods::Spec;
use dejag::scene::Scene;

use super::Lab;
use super::pictures::equal_luma;

/// A unit is a pixel. A textured quad on the left, on the right a small quad close before a large one; steps of colour are 0.16
/// within the texture and all around it, or twice that.
const SCENE: &str = "
background = '#d0d0d0'
[camera]
projection = 'orthographic'
height = 90
near = 0
far = 20
position = [0, 0, 10]
target = [0, 0, 0]
[[objects]]
position = [-38, 0, 0]
rotation_deg = [0, 0, 7]
shape = { quad = { size = [60, 64] } }
material = { color = '#808080', unlit = true, pattern = { checker = { cell = 9, other = '#a8a8a8' } } }
[[objects]]
position = [40, 0, 0]
rotation_deg = [0, 0, 7]
shape = { quad = { size = [50, 64] } }
material = { color = '#a8a8a8', unlit = true }
[[objects]]
position = [40, 0, 0.5]
rotation_deg = [0, 0, 20]
shape = { quad = { size = [20, 30] } }
material = { color = '#808080', unlit = true }
";

const SIZE: [u32; 2] = [160, 90];

/// Changed pixels: at silhouettes, and on surfaces three pixels or more away from any.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Changed {
    silhouettes: usize,
    surfaces: usize,
}

fn changed(lab: &Lab, spec: &str) -> Changed {
    let scene = Scene::parse(SCENE, "test.toml", std::path::Path::new(".")).expect("a good scene");
    let mut studio = Studio::new(&lab.gpu, &scene).expect("uploads");
    let [none, filter] = ["none", spec].map(|text| Spec::parse(text).expect(text));
    let ids = studio.view(&ViewKind::Ids, &none, 0, SIZE, &mut ()).expect("draws").data;
    let [before, after] = [&none, &filter].map(|spec| studio.capture(spec, 0, SIZE, &mut ()).expect("draws").display.to_rgba8());
    let is_surface = |x: u32, y: u32| {
        let near = |at: u32, side: u32| at.saturating_sub(3)..=(at + 3).min(side - 1);
        near(y, SIZE[1]).all(|ny| near(x, SIZE[0]).all(|nx| ids.pixel(nx, ny) == ids.pixel(x, y)))
    };
    let mut found = Changed { silhouettes: 0, surfaces: 0 };
    for (i, (a, b)) in before.chunks(4).zip(after.chunks(4)).enumerate() {
        // Where nothing is filtered, the scene's colours may still be rounded another way.
        if a.iter().zip(b).all(|(a, b)| a.abs_diff(*b) <= 1) {
            continue;
        }
        match is_surface(i as u32 % SIZE[0], i as u32 / SIZE[0]) {
            true => found.surfaces += 1,
            false => found.silhouettes += 1,
        }
    }
    println!("{spec}: {found:?}");
    found
}

pub(super) fn edges_are_what_they_are_of(lab: &Lab, method: &str) {
    let of = |edges: &str| changed(lab, &format!("{method}:edges={edges}"));
    let [luma, color, depth, ids] = ["luma", "color", "depth", "ids"].map(of);
    assert!(luma.surfaces > 50 && luma.silhouettes > 50 && color.surfaces > 50, "{luma:?}, {color:?}");
    for geometry in [depth, ids] {
        assert!(geometry.surfaces == 0 && geometry.silhouettes > 50, "{method}: {geometry:?}");
    }
    let [by_luma, by_color] = lab.changed_by(&format!("{method}:edges"), ["luma", "color"], &equal_luma());
    assert!(by_luma == 0 && by_color > 30, "{method}: {by_luma}, {by_color}");
}

pub(super) fn a_higher_depth_step_misses_shallow_steps(lab: &Lab, method: &str) {
    // The small quad lies 0.5 before the large one: 0.05 of its depth. The background is a whole depth away.
    let of = |step: &str| changed(lab, &format!("{method}:edges=depth,depth_step={step}"));
    let [fine, coarse] = ["0.02", "0.2"].map(of);
    assert!(fine.silhouettes > coarse.silhouettes + 20 && coarse.silhouettes > 50, "{method}: {fine:?}, {coarse:?}");
}

pub(super) fn predication_spares_textures(lab: &Lab, _: &str) {
    let of = |by: &str| changed(lab, &format!("smaa:contrast=0,predication={by}"));
    let off = of("off");
    for guided in ["depth", "ids"].map(of) {
        assert!(off.surfaces > 50 && guided.surfaces == 0, "{off:?}, {guided:?}");
        assert!(guided.silhouettes * 10 > off.silhouettes * 8, "{off:?}, {guided:?}");
    }
    // What is a silhouette to depth is up to `depth_step`.
    let [fine, coarse] = ["0.02", "0.2"].map(|step| of(&format!("depth,depth_step={step}")));
    assert!(coarse.silhouettes + 20 < fine.silhouettes, "{coarse:?}, {fine:?}");
}

pub(super) fn scale_raises_the_threshold(lab: &Lab, _: &str) {
    let of = |scale: &str| changed(lab, &format!("smaa:contrast=0,predication=ids,strength=0,scale={scale}"));
    let [one, two, four] = ["1", "2", "4"].map(of);
    let total = |found: Changed| found.surfaces + found.silhouettes;
    assert!(one == changed(lab, "smaa:contrast=0"), "scale=1 raises nothing");
    assert!(one.surfaces > 50 && two.surfaces == 0, "{one:?}, {two:?}");
    assert!(total(one) > total(two) && total(two) > total(four), "{one:?}, {two:?}, {four:?}");
}

pub(super) fn strength_takes_it_back_at_silhouettes(lab: &Lab, _: &str) {
    let of = |strength: &str| changed(lab, &format!("smaa:contrast=0,predication=ids,scale=3,strength={strength}"));
    let [none, half, whole] = ["0", "0.5", "1"].map(of);
    assert!(none.silhouettes < half.silhouettes && half.silhouettes <= whole.silhouettes, "{none:?}, {half:?}, {whole:?}");
    assert!([none, half, whole].iter().all(|found| found.surfaces == 0), "{none:?}, {half:?}, {whole:?}");
}
