//! CMAA2 after a multisampled draw: what the resolve has smoothed is left alone.

use dejag::capture::{Capture, Studio};
use dejag::gpu::Gpu;
use dejag::methods::Spec;
use dejag::scene::Scene;

use crate::common;

const SIZE: [u32; 2] = [160, 90];

fn capture(gpu: &Gpu, scene: &Scene, method: &str) -> Capture {
    let spec = Spec::parse(method).expect(method);
    Studio::new(gpu, scene).expect("uploads").capture(&spec, 0, SIZE, &mut ()).expect("draws")
}

/// Whether each pixel differs between two pictures by more than rounding.
fn differing(a: &Capture, b: &Capture) -> Vec<bool> {
    let (a, b) = (a.display.to_rgba8(), b.display.to_rgba8());
    a.chunks(4).zip(b.chunks(4)).map(|(a, b)| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 1)).collect()
}

fn count(flags: &[bool]) -> usize {
    flags.iter().filter(|flag| **flag).count()
}

#[test]
fn cmaa2_leaves_resolved_pixels_alone() {
    let gpu = common::gpu();
    let scene = Scene::load("edges").expect("shipped");
    let [none, resolved, filtered] = ["none", "msaa:samples=4", "msaa:samples=4+cmaa2"].map(|m| capture(&gpu, &scene, m));
    // The scene has few colours, each flat: any other is a mean of different samples.
    let is_mixed: Vec<bool> = {
        let flat: std::collections::BTreeSet<[u8; 4]> =
            none.display.to_rgba8().chunks(4).map(|p| [p[0], p[1], p[2], p[3]]).collect();
        let near = |a: &[u8; 4], b: &[u8]| a.iter().zip(b).all(|(a, b)| a.abs_diff(*b) <= 1);
        resolved.display.to_rgba8().chunks(4).map(|pixel| !flat.iter().any(|color| near(color, pixel))).collect()
    };
    let changed = differing(&resolved, &filtered);
    let mixed_and_changed = is_mixed.iter().zip(&changed).filter(|(mixed, changed)| **mixed && **changed).count();
    println!("edges: {} pixels mixed, {} changed, {mixed_and_changed} both", count(&is_mixed), count(&changed));
    assert!(count(&is_mixed) > 1000 && mixed_and_changed == 0, "{mixed_and_changed} resolved pixels were changed");
    // Alone, it changes the pixels that the resolve would have smoothed.
    let alone = differing(&none, &capture(&gpu, &scene, "none+cmaa2"));
    assert!(is_mixed.iter().zip(&alone).filter(|(mixed, changed)| **mixed && **changed).count() > 100);
}

#[test]
fn cmaa2_smooths_what_samples_do_not_see() {
    // Leaves are cut out by their opacity, which is the same for all samples of a pixel.
    let gpu = common::gpu();
    let scene = Scene::load("foliage").expect("shipped");
    let [resolved, filtered] = ["msaa:samples=4", "msaa:samples=4+cmaa2"].map(|method| capture(&gpu, &scene, method));
    let changed = count(&differing(&resolved, &filtered));
    println!("foliage: {changed} pixels changed after multisampling");
    assert!(changed > 200, "{changed}");
}
