//! Filters on straight edges: nearer to the exact coverage than none at all, and even where the edge is nearly level.

use std::collections::BTreeSet;

use dejag::bench::edge_errors;
use dejag::capture::PictureFilter;
use dejag::gpu::Gpu;
use dejag::methods::{METHODS, Spec};
use dejag::pass::{Encoding, Extras, Role, Surface};
use dejag::picture::Pixel;

use crate::common;

/// The filters that take a picture and need nothing beside it, with their defaults.
fn filters() -> Vec<Spec> {
    let specs = METHODS.iter().map(|method| Spec::parse(method.name).expect(method.name));
    let takes_a_picture = |spec: &Spec| {
        let needs = spec.first_needs();
        needs.role == Role::Filters(Encoding::Display) && needs.extras == Extras::default()
    };
    specs.filter(takes_a_picture).collect()
}

#[test]
fn every_filter_is_nearer_to_straight_edges_than_none() {
    let gpu = common::gpu();
    let filters = filters();
    let Some(errors) = edge_errors(&gpu, &filters, &mut ()).expect("runs") else {
        assert!(filters.is_empty());
        return;
    };
    let (baselines, found): (Vec<_>, Vec<_>) = errors.curves.iter().partition(|curve| curve.baseline);
    assert_eq!((baselines.len(), found.len()), (3, filters.len()));
    for curve in &errors.curves {
        println!("{}: RMS {:.4}, at 2 degrees {:.4}, at 45 {:.4}", curve.name, curve.over_all, curve.rms[2], curve.rms[45]);
    }
    for curve in found {
        assert!(curve.over_all < 0.9 * baselines[0].over_all, "{}: {}", curve.name, curve.over_all);
    }
}

#[test]
fn without_a_filter_there_are_no_curves() {
    let methods = ["none", "ssaa:spp=4"].map(|text| Spec::parse(text).expect("exists"));
    assert_eq!(edge_errors(&common::gpu(), &methods, &mut ()).expect("nothing to run"), None);
}

/// Display values that a filter makes of an edge between black and white that rises one pixel in `run`, drawn with one sample a
/// pixel: those that are neither.
fn steps(gpu: &Gpu, name: &str, run: u32) -> BTreeSet<u32> {
    const SIZE: [u32; 2] = [256, 64];
    let mut filter =
        PictureFilter::new(gpu, &Spec::parse(name).expect("exists"), SIZE, Surface::display(FORMAT)).expect("builds");
    let level = |i: u32| {
        let [x, y] = [i % SIZE[0], i / SIZE[0]].map(|at| f64::from(at) + 0.5);
        f32::from(y > 0.5 * f64::from(SIZE[1]) + (0.5 * f64::from(SIZE[0]) - x) / f64::from(run))
    };
    let picture: Vec<Pixel> = (0..SIZE[0] * SIZE[1]).map(|i| [level(i), level(i), level(i), 1.0]).collect();
    let filtered = filter.apply(&picture).expect("filters");
    // Runs that the picture's borders cut off end anywhere.
    let inside = |i: &usize| (64..192).contains(&(i % SIZE[0] as usize));
    let levels = filtered.iter().enumerate().filter(|(i, _)| inside(i)).map(|(_, pixel)| (pixel[1] * 255.0).round() as u32);
    levels.filter(|level| !matches!(level, 0 | 255)).collect()
}

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

#[test]
fn morphological_filters_make_gradients_of_more_than_sixteen_steps() {
    let gpu = common::gpu();
    for name in ["mlaa", "smaa"].into_iter().filter(|name| METHODS.iter().any(|method| method.name == *name)) {
        for run in [24, 30] {
            let steps = steps(&gpu, name, run);
            println!("{name}: {} steps where an edge rises one pixel in {run}", steps.len());
            assert!(steps.len() >= 17, "{name}, one in {run}: {steps:?}");
        }
    }
}
