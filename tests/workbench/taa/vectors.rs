//! Motion vectors against the scene's own transforms, projected in f64.

use std::path::Path;

use dejag::capture::{Geometry, GeometryShot, Studio};
use dejag::scene::{Frame, Instance, Scene, Tick};
use glam::{DMat4, DVec2, DVec3};
use half::f16;

use super::panned;
use crate::common;

const SIZE: [u32; 2] = [128, 72];

/// What is asked of them.
const MOST_PX: f64 = 1.0 / 256.0;

/// A box and a quad that go, turn and spin, on a floor, under a camera that goes as the test says.
fn moving_scene(camera: &str, motion: &str) -> Scene {
    let text = format!(
        "[camera]
projection = 'perspective'
fov_y_deg = 50
near = 0.1
position = [0.3, 1.2, 5]
target = [0, 0.5, 0]
{camera}
[[objects]]
shape = {{ ground = {{ size = [30, 30] }} }}
[[objects]]
position = [-0.8, 0.7, 0.5]
rotation_deg = [10, 35, 5]
shape = {{ box = {{ size = [1, 1.2, 0.8] }} }}
{motion}
[[objects]]
position = [1.1, 0.9, -0.4]
rotation_deg = [0, 20, 30]
shape = {{ quad = {{ size = [1.4, 1.0] }} }}
{motion}"
    );
    Scene::parse(&text, "test.toml", Path::new(".")).expect("a good scene")
}

/// Where a triangle's point seen at a place is in the frame before, with its depth; both pictures in pixels.
fn followed(at_px: DVec2, now: [DMat4; 2], corners: [DVec3; 3]) -> Option<(f64, DVec2)> {
    let pixels = DVec2::from(SIZE.map(f64::from));
    let clip = corners.map(|corner| now[0] * corner.extend(1.0));
    let ndc = 2.0 * at_px / pixels - 1.0;
    let ndc = DVec2::new(ndc.x, -ndc.y);
    // A point of the triangle is seen here if the edges' planes through the eye agree: weights of the corners, unnormalised.
    let seen = clip.map(|c| DVec3::new(c.x - ndc.x * c.w, c.y - ndc.y * c.w, c.w));
    let area = |a: DVec3, b: DVec3| a.x * b.y - a.y * b.x;
    let weights = DVec3::new(area(seen[1], seen[2]), area(seen[2], seen[0]), area(seen[0], seen[1]));
    let sum = weights.element_sum();
    // A hair beyond the edge is still the triangle to a rasteriser that snaps its corners.
    if sum == 0.0 || (weights / sum).min_element() < -0.02 {
        return None;
    }
    let [a, b, c] = corners;
    let weights = weights / sum;
    let point = (weights.x * a + weights.y * b + weights.z * c).extend(1.0);
    let [here, before] = now.map(|clip_from_object| clip_from_object * point);
    let depth = here.z / here.w;
    let before = DVec2::new(before.x, -before.y) / before.w;
    (here.w > 0.0 && (0.0..=1.0).contains(&depth)).then(|| (depth, 0.5 * (before + 1.0) * pixels - at_px))
}

/// The exact motion of what an instance shows at a place; of several surfaces, of that whose depth is nearest to the drawn one.
fn exact(frame: &Frame, instance: &Instance, at_px: DVec2, depth: f32) -> Option<DVec2> {
    let aspect = f64::from(SIZE[0]) / f64::from(SIZE[1]);
    let now = frame.view.clip_from_object(&instance.world_from_object, aspect);
    let before = frame.previous_view.clip_from_object(&instance.previous_world_from_object, aspect);
    let corner = |index: &u32| instance.mesh.vertices[*index as usize].position;
    let triangles = instance.mesh.indices.as_chunks::<3>().0.iter().map(|triangle| triangle.each_ref().map(corner));
    let found = triangles.filter_map(|corners| followed(at_px, [now, before], corners));
    let off = |found: &(f64, DVec2)| (found.0 - f64::from(depth)).abs();
    found.min_by(|a, b| off(a).total_cmp(&off(b))).map(|(_, motion_px)| motion_px)
}

/// The largest errors of what was drawn, in pixels: as it is, and in halves.
fn errors(scene: &Scene, tick: &Tick) -> [f64; 2] {
    let gpu = common::gpu();
    let mut studio = Studio::new(&gpu, scene).expect("uploads");
    let drawn = GeometryShot::new(&studio, SIZE).expect("builds").take(&mut studio, tick).expect("draws");
    let frame = scene.at(tick, SIZE).expect("sensible");
    let Geometry { motion_px, ids, depth, .. } = &drawn;
    let (mut worst, mut fastest, mut compared) = ([0.0_f64; 2], 0.0_f64, 0);
    for (i, id) in ids.iter().enumerate() {
        let at_px = DVec2::new((i as u32 % SIZE[0]) as f64 + 0.5, (i as u32 / SIZE[0]) as f64 + 0.5);
        let Some(instance) = frame.instances.iter().find(|instance| instance.id == *id) else { continue };
        let Some(exact) = exact(&frame, instance, at_px, depth[i]) else { continue };
        compared += 1;
        fastest = fastest.max(exact.length());
        for axis in 0..2 {
            let found = motion_px[i][axis];
            let halved = f16::from_f32(found).to_f32();
            worst[0] = worst[0].max((f64::from(found) - exact[axis]).abs());
            worst[1] = worst[1].max((f64::from(halved) - exact[axis]).abs());
        }
    }
    println!("{compared} pixels, up to {fastest:.2} px a frame: off by {:.6} px, in halves by {:.6} px", worst[0], worst[1]);
    assert!(compared > 1000 && fastest > 0.3, "{compared} pixels, {fastest} px");
    worst
}

fn are_exact(what: &str, scene: &Scene, tick: &Tick) {
    println!("{what}:");
    let [found, _] = errors(scene, tick);
    assert!(found <= MOST_PX, "{what}: {found} px");
}

#[test]
fn translations_are_exact() {
    let scene = moving_scene("", "motion = { velocity = [9, 2, -4] }");
    are_exact("translation", &scene, &Tick::of(&scene, 7));
    let scene = moving_scene("velocity = [14, 1, 0]", "");
    are_exact("a camera that goes sideways", &scene, &Tick::of(&scene, 3));
    are_exact("a shifted picture", &scene, &panned(&scene, 3, [0.37, -1.2]));
}

#[test]
fn rotations_are_exact() {
    let scene = moving_scene("", "motion = { spin_axis = [1, 2, 0.5], spin_deg_per_s = 500 }");
    are_exact("rotation", &scene, &Tick::of(&scene, 9));
    let turn = "keyframes = [{ time = 0, position = [0, 1, 5], target = [0, 0.5, 0] }, { time = 0.1, position = [0, 1, 5], target = [2, 0.4, 0] }]";
    let text = format!(
        "[camera]\nprojection = 'perspective'\nnear = 0.1\n{turn}\n[[objects]]\nshape = {{ ground = {{ size = [30, 30] }} }}\n"
    );
    let scene = Scene::parse(&text, "test.toml", Path::new(".")).expect("a good scene");
    are_exact("a camera that turns", &scene, &Tick::of(&scene, 3));
}

#[test]
fn zooms_are_exact() {
    let scene = moving_scene("velocity = [0, 0, -20]", "");
    are_exact("a camera that goes forward", &scene, &Tick::of(&scene, 4));
}

#[test]
fn far_from_the_origin_they_are_exact() {
    let text = include_str!("../../../scenes/far.toml");
    let goes = text.replacen("near = 0\n", "near = 0\nvelocity = [40.3, -22.7, 0]\n", 1);
    let goes = goes.replacen("material = {", "motion = { velocity = [90, 31, 0], spin_deg_per_s = 60 }\nmaterial = {", 1);
    assert!(goes.contains("velocity = [40.3") && goes.contains("velocity = [90"));
    let scene = Scene::parse(&goes, "far.toml", Path::new(".")).expect("a good scene");
    are_exact("far", &scene, &Tick::of(&scene, 5));
}
