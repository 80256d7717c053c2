//! Adaptive supersampling: what it costs, what it may miss, and where it is biased.

use dejag::capture::{Capture, Studio, ViewKind};
use dejag::gpu::Gpu;
use dejag::methods::Spec;
use dejag::picture::LinearPicture;
use dejag::scene::Scene;

use crate::common;

const SIZE: [u32; 2] = [640, 360];

struct Bench {
    gpu: Gpu,
}

impl Bench {
    fn new() -> Self {
        Self { gpu: common::gpu() }
    }

    fn capture(&self, scene: &Scene, method: &str, size: [u32; 2]) -> Capture {
        let spec = Spec::parse(method).expect(method);
        Studio::new(&self.gpu, scene).expect("uploads").capture(&spec, 0, size, &mut ()).expect("draws")
    }

    fn linear(&self, scene: &Scene, method: &str, size: [u32; 2]) -> LinearPicture {
        self.capture(scene, method, size).linear.expect("linear")
    }
}

fn scene(name: &str) -> Scene {
    Scene::load(name).expect("shipped")
}

/// Mean squared difference of what a display shows.
fn squared_error(a: &Capture, b: &Capture) -> f64 {
    let (a, b) = (a.display.pixels(), b.display.pixels());
    let squares = a.iter().zip(b).flat_map(|(p, q)| (0..3).map(move |c| f64::from(p[c] - q[c]).powi(2)));
    squares.sum::<f64>() / (3 * a.len()) as f64
}

/// Largest difference of a channel between pictures.
fn largest_difference(a: &LinearPicture, b: &LinearPicture) -> f32 {
    let pairs = a.pixels().iter().zip(b.pixels());
    pairs.flat_map(|(p, q)| (0..3).map(move |c| (p[c] - q[c]).abs())).fold(0.0, f32::max)
}

/// It must not err more than uniform samples, so many times as many as it shaded.
fn worth(bench: &Bench, name: &str, method: &str, times: f64) {
    let scene = scene(name);
    let truth = bench.capture(&scene, "ssaa:spp=1024,pattern=larcher", SIZE);
    let adaptive = bench.capture(&scene, method, SIZE);
    let spp = (times * adaptive.samples_per_pixel).floor();
    let uniform = bench.capture(&scene, &format!("ssaa:spp={spp}"), SIZE);
    let [own, same] = [&adaptive, &uniform].map(|capture| squared_error(capture, &truth));
    println!("{name}: {:.2} samples err by {own:.2e}, {spp} everywhere by {same:.2e}", adaptive.samples_per_pixel);
    assert!(own <= same, "{name}: {own:e} > {same:e} of {spp} samples");
}

#[test]
fn a_third_of_the_samples_errs_no_more() {
    let bench = Bench::new();
    for name in ["edges", "wires", "fence"] {
        worth(&bench, name, "adaptive", 3.0);
    }
    // At this size four pixels of ten have an edge; at 1280x720 it is more than three times.
    worth(&bench, "courtyard", "adaptive", 2.5);
}

/// The bar above can be missed: without the outlines of the geometry probes miss what is thin.
#[test]
#[should_panic(expected = "wires")]
fn without_outlines_wires_are_missed() {
    worth(&Bench::new(), "wires", "adaptive:outline=off", 3.0);
}

/// Every pixel that geometry changes within gets all samples, so the picture is that of uniform ones, at sizes that fit no grid
/// and from a scene that is far away.
#[test]
fn no_edge_and_no_wire_is_missed() {
    let bench = Bench::new();
    for (name, size) in
        [("edges", SIZE), ("wires", SIZE), ("edges", [97, 61]), ("wires", [33, 201]), ("far", SIZE), ("wires", [7, 3])]
    {
        let scene = scene(name);
        let uniform = bench.linear(&scene, "ssaa:spp=64,pattern=larcher", size);
        let adaptive = bench.linear(&scene, "adaptive:threshold=1,pattern=larcher", size);
        let largest = largest_difference(&uniform, &adaptive);
        println!("{name} {size:?}: {largest}");
        // A sample of 64 is 0.016; probes are kept as halves.
        assert!(largest < 1e-3, "{name} {size:?}: {largest}");
    }
}

/// The map says how many samples each pixel got; their mean is what is reported.
#[test]
fn the_samples_reported_are_those_of_the_map() {
    let bench = Bench::new();
    let scene = scene("courtyard");
    for (method, beside) in [("adaptive", 0.0), ("adaptive:independent=on", 4.0)] {
        let spec = Spec::parse(method).expect(method);
        let mut studio = Studio::new(&bench.gpu, &scene).expect("uploads");
        let reported = studio.capture(&spec, 0, [160, 90], &mut ()).expect("draws").samples_per_pixel;
        let view = studio.view(&ViewKind::Intermediate("refine".into()), &spec, 0, [160, 90], &mut ()).expect("a view");
        let levels: Vec<f32> = view.data.pixels().iter().map(|p| p[0]).collect();
        // 4, 16 or 64 samples of 64 are a third, two thirds and all of the way from black to white.
        let counts = levels.iter().map(|level| 64f64.powf(f64::from(*level))).map(|count| 2f64.powf((count.log2()).round()));
        let mean = counts.sum::<f64>() / levels.len() as f64 + beside;
        println!("{method}: {reported} reported, {mean} in the map");
        assert!((mean - reported).abs() < 1e-6 * reported, "{method}: {reported}, {mean}");
    }
}

/// Probes alone are plain uniform samples.
#[test]
fn probes_alone_are_uniform_samples() {
    let bench = Bench::new();
    let scene = scene("edges");
    let size = [61, 35];
    let capture = bench.capture(&scene, "adaptive:probe=4,max=4,pattern=larcher", size);
    assert_eq!(capture.samples_per_pixel, 4.0);
    let capture = capture.linear.expect("linear");
    let uniform = bench.linear(&scene, "ssaa:spp=4,pattern=larcher", size);
    let largest = largest_difference(&capture, &uniform);
    assert!(largest < 2e-3, "{largest}: more than halves lose");
}

/// Mean of squared z-scores over pixels: about 1 where the mean of many seeds is the truth but for chance.
fn mean_square_z(bench: &Bench, scene: &Scene, method: &str, size: [u32; 2], seeds: u32) -> f64 {
    let truth = bench.linear(scene, "ssaa:spp=4096,pattern=larcher", size);
    let mut sums = vec![[0.0f64; 2]; truth.pixels().len()];
    for seed in 0..seeds {
        let picture = bench.linear(scene, &format!("{method},seed={}", 2 * seed), size);
        for (sum, pixel) in sums.iter_mut().zip(picture.pixels()) {
            let x = f64::from(pixel[1]);
            *sum = [sum[0] + x, sum[1] + x * x];
        }
    }
    let n = f64::from(seeds);
    let scores = sums.iter().zip(truth.pixels()).filter_map(|(sum, truth)| {
        let mean = sum[0] / n;
        let variance = (sum[1] / n - mean * mean) / (n - 1.0);
        // A pixel that never varies has nothing to say.
        (variance > 1e-7).then(|| (mean - f64::from(truth[1])).powi(2) / variance)
    });
    let (sum, count) = scores.fold((0.0, 0), |(sum, count), z| (sum + z, count + 1));
    assert!(count > 50, "{count} pixels vary");
    sum / f64::from(count)
}

/// A pixel whose probes happen to agree keeps them: the mean over many seeds is off. Probes that only decide leave it right.
#[test]
fn independent_probes_are_unbiased_and_others_are_not() {
    let bench = Bench::new();
    let scene = scene("checker");
    let method = "adaptive:probe=2,max=8,pattern=random,outline=off,dilate=0,threshold=0.1";
    let [biased, unbiased] =
        ["off", "on"].map(|word| mean_square_z(&bench, &scene, &format!("{method},independent={word}"), [48, 27], 120));
    println!("mean square z: {biased:.2} with probes that count, {unbiased:.2} with independent ones");
    assert!(unbiased < 1.25, "{unbiased}");
    assert!(biased > 1.5, "{biased}");
}

#[test]
fn contradicting_options_are_refused() {
    let error = Spec::parse("adaptive:probe=8,max=4").expect_err("more probes than samples").to_string();
    assert!(error.contains("max=4") && error.contains("probe=8"), "{error}");
}

/// Every criterion draws, and all of them together refine no less than each.
#[test]
fn criteria_see_what_they_are_for() {
    let bench = Bench::new();
    let spp = |name: &str, criterion: &str| {
        let method = format!("adaptive:max=16,outline=off,dilate=0,criterion={criterion}");
        bench.capture(&scene(name), &method, [160, 90]).samples_per_pixel
    };
    for name in ["checker", "courtyard"] {
        let each = ["color", "gradient", "variance", "depth", "ids"].map(|criterion| spp(name, criterion));
        let all = spp(name, "all");
        println!("{name}: {each:?}, all {all}");
        assert!(each.iter().all(|spp| *spp > 4.0 && *spp <= all), "{name}");
    }
    // A textured floor is one surface in one light.
    let [color, signature] = ["color", "signature"].map(|criterion| spp("checker", criterion));
    println!("checker: by colour {color}, by signature {signature}");
    assert!(signature > 4.0 && signature - 4.0 < 0.1 * (color - 4.0), "{color}, {signature}");
    // The sides of an arch are of one material, in the light and out of it.
    let [ids, signature] = ["ids", "signature"].map(|criterion| spp("courtyard", criterion));
    assert!(signature > 4.0 && signature != ids, "{ids}, {signature}");
}
