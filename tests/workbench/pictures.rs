//! Properties of pictures that hold whatever the scene.

use dejag::capture::{Capture, Studio, ViewKind};
use dejag::gpu::Gpu;
use dejag::methods::{METHODS, Spec};
use dejag::pass::{Context, Draw, Extras, FrameFacts, Inputs, Jitter, Needs, Pass, Recorder, Target, Technique};
use dejag::picture::LinearPicture;
use dejag::sampling;
use dejag::scene::{SHIPPED, Scene};

use crate::common;

fn capture(gpu: &Gpu, scene: &Scene, method: &str, size: [u32; 2]) -> Capture {
    let spec = Spec::parse(method).expect("exists");
    Studio::new(gpu, scene).expect("uploads").capture(&spec, 0, size, &mut ()).expect("draws")
}

fn linear(gpu: &Gpu, scene: &Scene, method: &str, size: [u32; 2]) -> LinearPicture {
    capture(gpu, scene, method, size).linear.expect("linear")
}

/// Largest difference of any channel, in units of full scale or of the value where that is larger.
fn largest_difference(a: &LinearPicture, b: &LinearPicture) -> f32 {
    assert_eq!(a.size(), b.size());
    let pairs = a.pixels().iter().zip(b.pixels());
    pairs.flat_map(|(p, q)| (0..3).map(move |c| (p[c] - q[c]).abs() / p[c].abs().max(1.0))).fold(0.0, f32::max)
}

#[test]
fn every_shipped_scene_is_drawn_finite_and_not_empty() {
    let gpu = common::gpu();
    for shipped in SHIPPED {
        let scene = Scene::load(shipped.name).expect("shipped");
        let capture = capture(&gpu, &scene, "none", [64, 36]);
        let linear = capture.linear.expect("linear");
        assert_eq!(linear.non_finite(), None, "{}", shipped.name);
        let first = linear.pixel(0, 0);
        assert!(linear.pixels().iter().any(|p| *p != first), "{} is flat", shipped.name);
        assert!(capture.display.pixels().iter().flatten().all(|x| (0.0..=1.0).contains(x)), "{}", shipped.name);
    }
}

/// Pixels with a channel that differs by more than rgba16float's rounding.
fn differing(a: &LinearPicture, b: &LinearPicture) -> usize {
    let differ = |p: &[f32; 4], q: &[f32; 4]| (0..3).any(|c| (p[c] - q[c]).abs() > 2e-3 * p[c].abs().max(0.5));
    a.pixels().iter().zip(b.pixels()).filter(|(p, q)| differ(p, q)).count()
}

#[test]
fn a_sum_of_one_jitter_is_the_plain_draw() {
    let gpu = common::gpu();
    for shipped in SHIPPED {
        let scene = Scene::load(shipped.name).expect("shipped");
        let [sum, plain] = ["ssaa:spp=1", "none"].map(|method| linear(&gpu, &scene, method, [160, 90]));
        let count = differing(&sum, &plain);
        println!("{}: {count} of 14400 pixels differ", shipped.name);
        // Where surfaces cross, the two kinds of depth may put the line of crossing on either side of a pixel's centre.
        assert!(count <= 3, "{}: {count} pixels differ", shipped.name);
    }
}

#[test]
fn a_sum_of_many_jitters_is_the_sum_of_each() {
    // Fifty jitters share a pass and follow one another through the slices of its depth; one alone has a pass to itself. Overlap,
    // cut-outs and surfaces at equal depth must come out alike. The mean over all of them is held against 64 passes of one.
    let gpu = common::gpu();
    let size = [160, 90];
    for shipped in SHIPPED {
        let scene = Scene::load(shipped.name).expect("shipped");
        let together = linear(&gpu, &scene, "ssaa:spp=64", size);
        let apart = one_by_one(&gpu, &scene, 64, size);
        let count = differing(&together, &apart);
        let largest = largest_difference(&together, &apart);
        println!("{}: {count} of 14400 pixels differ, the most by {largest:.4}", shipped.name);
        // Where surfaces cross, a sample or two of the 64 may fall on the other side.
        assert!(count <= 14 && largest <= 2.0 / 64.0, "{}: {count} pixels differ, the most by {largest}", shipped.name);
    }
}

/// The jitters of `ssaa:spp=N`, each drawn plainly, averaged here in f64.
fn one_by_one(gpu: &Gpu, scene: &Scene, spp: u32, size: [u32; 2]) -> LinearPicture {
    let pattern = sampling::pattern("larcher").expect("exists");
    let unit = sampling::filter("box").expect("exists");
    let mut sums = vec![[0.0f64; 3]; (size[0] * size[1]) as usize];
    let mut studio = Studio::new(gpu, scene).expect("uploads");
    for sample in sampling::weighted_offsets(pattern, spp, 0, unit, 0.5) {
        let once = Once(Jitter { offset_px: sample.offset_px.map(|x| x as f32), weight: 1.0 });
        let mut shot = studio.shot_of(&[("once", &once)], 0, size, Extras::default()).expect("builds");
        studio.take(&mut shot, None, &mut ()).expect("draws");
        let picture = studio.read(&shot).expect("reads").linear.expect("linear");
        for (sum, pixel) in sums.iter_mut().zip(picture.pixels()) {
            *sum = [0, 1, 2].map(|c| sum[c] + f64::from(pixel[c]) / f64::from(spp));
        }
    }
    let pixels = sums.iter().map(|sum| [sum[0] as f32, sum[1] as f32, sum[2] as f32, 1.0]);
    LinearPicture::new(size[0], size[1], pixels.collect()).expect("fits")
}

/// One plain draw, moved.
#[derive(Debug, Clone, Copy)]
struct Once(Jitter);

impl Technique for Once {
    fn needs(&self) -> Needs {
        Needs::default()
    }

    fn build(&self, _: &Context<'_>) -> dejag::Result<Box<dyn Pass>> {
        Ok(Box::new(*self))
    }
}

impl Pass for Once {
    fn next_draw(&mut self, k: u32, _: &FrameFacts) -> Option<Draw> {
        (k == 0).then(|| Draw { jitters: vec![self.0], target: Target::Output, ..Draw::default() })
    }

    fn record(&mut self, _: &mut Recorder<'_>, _: u32, _: &Inputs<'_>, _: &wgpu::TextureView) {}
}

#[test]
fn sizes_down_to_one_pixel_and_up_to_odd_ones() {
    let gpu = common::gpu();
    let scene = Scene::load("edges").expect("shipped");
    for size in [[1, 1], [3, 5], [257, 3], [1, 100]] {
        for method in METHODS {
            let spec = if method.name == "ssaa" { "ssaa:spp=3" } else { method.name };
            let picture = capture(&gpu, &scene, spec, size).display;
            assert_eq!(picture.size(), size, "{spec}");
            assert_eq!(picture.non_finite(), None, "{spec} {size:?}");
        }
    }
}

#[test]
fn memory_does_not_grow_with_samples() {
    let gpu = common::gpu();
    let scene = Scene::load("edges").expect("shipped");
    let bytes = |spp: u32| capture(&gpu, &scene, &format!("ssaa:spp={spp}"), [64, 36]).target_bytes;
    assert_eq!(bytes(2), bytes(4096));
}

#[test]
fn too_large_is_refused_before_anything_is_made() {
    let gpu = common::gpu();
    let scene = Scene::load("edges").expect("shipped");
    let limit = gpu.device.limits().max_texture_dimension_2d;
    let studio = Studio::new(&gpu, &scene).expect("uploads");
    let refusal = studio.shot(&Spec::parse("none").expect("exists"), 0, [limit + 1, 1]).expect_err("too large").to_string();
    assert!(refusal.contains(&limit.to_string()), "{refusal}");
}

/// Half white, half transparent to black: an ambient-lit scene with nothing in it but its background.
const FLAT: &str = "
background = [0.25, 0.5, 0.7]
[camera]
projection = \"orthographic\"
height = 2
near = 0
far = 20
position = [0, 0, 10]
target = [0, 0, 0]
[[objects]]
shape = { quad = { size = [20, 20] } }
material = { color = [0.3, 0.6, 0.1], unlit = true }
";

fn scene_of(text: &str) -> Scene {
    Scene::parse(text, "test.toml", std::path::Path::new(".")).expect("a good scene")
}

#[test]
fn a_flat_picture_stays_flat() {
    let gpu = common::gpu();
    let scene = scene_of(FLAT);
    let expected = linear(&gpu, &scene, "none", [17, 9]).pixel(0, 0);
    for method in [
        "none",
        "msaa:samples=4",
        "msaa:samples=4,resolve=mitchell,weight=luma",
        "msaa:samples=4,resolve=lanczos,weight=max3",
        "ssaa:spp=7",
        "ssaa:spp=64,filter=catmull-rom",
        "ssaa:spp=1000,filter=lanczos,pattern=r2",
    ] {
        let picture = linear(&gpu, &scene, method, [17, 9]);
        for pixel in picture.pixels() {
            // A store to rgba16float may lose a unit of its 11th bit (lavapipe cuts off), and a resolve stores a second time.
            let error = (0..3).map(|c| (pixel[c] - expected[c]).abs() / expected[c]).fold(0.0, f32::max);
            assert!(error < 1.001 / 1024.0, "{method}: {pixel:?} for {expected:?}");
            let unevenness = (0..3).map(|c| (pixel[c] - picture.pixel(8, 4)[c]).abs() / expected[c]).fold(0.0, f32::max);
            assert!(unevenness < 1.001 / 1024.0, "{method}: not flat");
        }
    }
}

#[test]
fn an_unclipped_sum_is_finer_than_half_floats() {
    let gpu = common::gpu();
    let picture = linear(&gpu, &scene_of(FLAT), "ssaa:spp=64", [4, 4]);
    let error = [0.3f32, 0.6, 0.1].iter().zip(picture.pixel(1, 1)).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(error < 1e-6, "{error}");
}

/// A triangle and its mirror image: the second scene is the first with x negated.
fn leaning_triangle(sign: f64) -> Scene {
    let points: Vec<String> =
        [(-0.9, -0.7), (0.55, -0.45), (-0.25, 0.8)].iter().map(|(x, y)| format!("[{}, {y}]", sign * x)).collect();
    scene_of(&format!(
        "background = [0, 0, 0]\n[camera]\nprojection = \"orthographic\"\nheight = 2\nnear = 0\nfar = 20\nposition = [0, 0, 10]\n\
         target = [0, 0, 0]\n[[objects]]\nshape = {{ polygon = {{ points = [{}] }} }}\nmaterial = {{ color = [1, 1, 1], unlit = true, \
         double_sided = true }}\n",
        points.join(", ")
    ))
}

#[test]
fn a_mirrored_scene_gives_the_mirrored_picture() {
    let gpu = common::gpu();
    let size = [64, 64];
    for method in ["ssaa:spp=64,pattern=regular", "ssaa:spp=1024,pattern=regular,filter=gaussian"] {
        let picture = linear(&gpu, &leaning_triangle(1.0), method, size);
        let mirrored = linear(&gpu, &leaning_triangle(-1.0), method, size);
        let back = LinearPicture::from_fn(64, 64, |x, y| mirrored.pixel(63 - x, y)).expect("fits");
        // The rasteriser rounds corners to 1/256 px and gives samples on an edge to its left or top: a sample more or less.
        let difference = largest_difference(&picture, &back);
        println!("{method}: mirrored within {difference}");
        assert!(difference <= 2.0 / 64.0, "{method}: {difference}");
    }
}

#[test]
fn slivers_make_no_fireflies() {
    // A rasteriser rounds corners to its grid, which can give a triangle of hardly any area enough to cover samples with; what is
    // interpolated over it may be no number. Lit triangles a tenth of a micrometre thin, in all directions.
    let gpu = common::gpu();
    let sliver = |k: u32| {
        let (number, angle) = (f64::from(k), 0.05 + f64::from(k) * 0.021);
        let along = |t: f64, off: f64| [t * angle.cos() - off * angle.sin(), t * angle.sin() + off * angle.cos()];
        let points = format!("[{:?}, {:?}, {:?}]", along(-0.9, 0.0), along(0.8, 0.0), along(0.13, 1e-7));
        let (y, z) = (0.9 - 0.012 * number, -0.3 * number.sin());
        let (lean, turn) = (7 * k % 60, 11 * k % 70);
        format!(
            "[[objects]]\nposition = [0, {y}, {z}]\nrotation_deg = [{lean}, {turn}, 0]\nshape = {{ polygon = {{ points = {points} }} }}\n\
             material = {{ color = [0.8, 0.8, 0.8], double_sided = true }}\n"
        )
    };
    let slivers: String = (0..150).map(sliver).collect();
    let scene = scene_of(&format!(
        "ambient = [0.2, 0.2, 0.2]\n[light]\nto_light = [0.3, 0.5, 1]\n[camera]\nprojection = \"perspective\"\nfov_y_deg = 40\n\
         near = 0.1\nposition = [0, 0, 3]\ntarget = [0, 0, 0]\n{slivers}"
    ));
    let picture = linear(&gpu, &scene, "ssaa:spp=2000", [160, 90]);
    assert_eq!(picture.non_finite(), None);
    let brightest = picture.pixels().iter().flat_map(|p| &p[..3]).fold(0.0f32, |a, b| a.max(*b));
    // A sliver covers at most a hundredth of a pixel.
    assert!(brightest > 0.0 && brightest < 0.1, "{brightest}");
}

#[test]
fn samples_an_adapter_lacks_are_refused_with_those_it_has() {
    let gpu = common::gpu();
    let lacking = ["2", "8", "16"].into_iter().find(|n| !gpu.sample_counts().contains(&n.parse().expect("a number")));
    let Some(count) = lacking else { return };
    let scene = Scene::load("edges").expect("shipped");
    let studio = Studio::new(&gpu, &scene).expect("uploads");
    let spec = Spec::parse(&format!("msaa:samples={count}")).expect("exists");
    let refusal = studio.shot(&spec, 0, [8, 8]).expect_err("lacks it").to_string();
    assert!(refusal.contains("this adapter has 1, 4"), "{refusal}");
}

#[test]
fn multisampling_equals_the_mean_at_its_sample_positions() {
    let gpu = common::gpu();
    let scene = scene_of(FLAT);
    let edges = Scene::load("edges").expect("shipped");
    assert!(largest_difference(&linear(&gpu, &scene, "msaa", [9, 9]), &linear(&gpu, &scene, "none", [9, 9])) < 1e-3);
    // Rotated-grid offsets are the hardware's standard four, so both see the same coverage, up to rounding of shared edges.
    let hardware = linear(&gpu, &edges, "msaa:samples=4", [320, 180]);
    let jittered = linear(&gpu, &edges, "ssaa:spp=4,pattern=rotated", [320, 180]);
    let differing =
        hardware.pixels().iter().zip(jittered.pixels()).filter(|(p, q)| (0..3).any(|c| (p[c] - q[c]).abs() > 0.01)).count();
    assert!(differing < 120, "{differing} of 57600 pixels differ");
}

#[test]
fn our_own_box_resolve_is_the_hardwares() {
    let gpu = common::gpu();
    let scene = Scene::load("edges").expect("shipped");
    let hardware = linear(&gpu, &scene, "msaa:samples=4", [160, 90]);
    let ours = linear(&gpu, &scene, "msaa:samples=4,radius=0.5", [160, 90]);
    assert!(largest_difference(&hardware, &ours) < 1e-3);
}

#[test]
fn tone_map_weights_keep_bright_edges_smooth() {
    let gpu = common::gpu();
    let scene = Scene::load("neon").expect("shipped");
    let pixels = |method: &str| capture(&gpu, &scene, method, [320, 180]).display;
    let [plain, luma, max3] = ["msaa:samples=4", "msaa:samples=4,weight=luma", "msaa:samples=4,weight=max3"].map(pixels);
    // A box resolve of a hundredfold emitter saturates wherever one sample hits: hardly a pixel is between black and full.
    let between = |p: &dejag::picture::DisplayPicture| {
        p.pixels().iter().filter(|p| p[0].max(p[1]).max(p[2]) > 0.05 && p[0].max(p[1]).max(p[2]) < 0.95).count()
    };
    println!("pixels between black and full: box {}, luma {}, max3 {}", between(&plain), between(&luma), between(&max3));
    assert!(between(&luma) > 2 * between(&plain) && between(&max3) > 2 * between(&plain));
    assert!(luma.pixels() != max3.pixels(), "the two weights differ on coloured light");
}

#[test]
fn alpha_to_coverage_smooths_cut_out_edges() {
    let gpu = common::gpu();
    let scene = Scene::load("foliage").expect("shipped");
    let reference = linear(&gpu, &scene, "ssaa:spp=256", [160, 90]);
    let rms = |method: &str| {
        let picture = linear(&gpu, &scene, method, [160, 90]);
        let squares = picture.pixels().iter().zip(reference.pixels()).map(|(p, q)| f64::from(p[1] - q[1]).powi(2));
        (squares.sum::<f64>() / reference.pixels().len() as f64).sqrt()
    };
    let (without, with) = (rms("msaa:samples=4"), rms("msaa:samples=4,a2c=on"));
    println!("foliage, RMS of green: msaa {without:.4}, with alpha to coverage {with:.4}");
    assert!(with < 0.9 * without);
}

#[test]
fn views_show_what_lies_beside_the_colour() {
    let gpu = common::gpu();
    let scene = Scene::load("pan").expect("shipped");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    let none = Spec::parse("none").expect("exists");
    let mut view = |kind: ViewKind, frame| studio.view(&kind, &none, frame, [64, 36], &mut ()).expect("draws").data;
    let depth = view(ViewKind::Depth, 1);
    assert!(depth.pixels().iter().all(|p| (0.0..=1.0).contains(&p[0])));
    assert!(depth.pixels().iter().any(|p| p[0] > 0.0));
    let ids = view(ViewKind::Ids, 1);
    let mut distinct: Vec<u32> = ids.pixels().iter().map(|p| p[0] as u32).collect();
    distinct.sort_unstable();
    distinct.dedup();
    assert!(distinct.len() > 3, "{distinct:?}");
    let still = view(ViewKind::Motion, 0);
    assert!(still.pixels().iter().all(|p| p[0] == 0.0 && p[1] == 0.0), "nothing moves before the first frame");
    let moving = view(ViewKind::Motion, 1);
    assert!(moving.pixels().iter().any(|p| p[0].abs() > 0.05), "the camera pans");
    let unknown = studio.view(&ViewKind::Intermediate("edges".into()), &none, 0, [8, 8], &mut ()).expect_err("has none");
    assert!(unknown.to_string().contains("colour, depth, motion, ids"), "{unknown}");
}

#[test]
fn the_background_moves_as_the_camera_turns() {
    let gpu = common::gpu();
    // Turned by a keyframe a second: at 60 frames a second, a degree to the right between two frames.
    let scene = scene_of(
        "frames = 2\ntime_step = 1\nbackground = [1, 1, 1]\n[camera]\nprojection = \"perspective\"\nfov_y_deg = 90\nnear = 0.1\n\
         keyframes = [{ time = 0, position = [0, 0, 0], target = [0, 0, -10] }, { time = 1, position = [5, 0, 0], target = [6, 0, -10] \
         }]\n[[objects]]\nposition = [0, -1, -5]\nshape = { quad = { size = [0.1, 0.1] } }\n",
    );
    let none = Spec::parse("none").expect("exists");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    let motion = studio.view(&ViewKind::Motion, &none, 1, [100, 100], &mut ()).expect("draws").data;
    // A direction straight ahead was 0.1 = tan of the turn to the right of the middle, of a half-width of 50 px at tan 1. The
    // camera's own step does not move what is infinitely far.
    let found = motion.pixel(50, 50);
    let ahead = 0.01f64; // The pixel's centre lies 0.5 px right and below the middle.
    let was = 50.0 * (ahead + 0.1) / (1.0 - ahead * 0.1);
    assert!((f64::from(found[0]) - (was - 0.5)).abs() < 1e-3, "{found:?} for {}", was - 0.5);
    assert!(f64::from(found[1]).abs() < 0.05, "{found:?}");
}

#[test]
fn every_method_builds_and_records_without_a_gpu() {
    let gpu = Gpu::noop().expect("the no-op backend answers");
    let scene = Scene::load("edges").expect("shipped");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    for method in METHODS {
        let spec = Spec::parse(method.name).expect("exists");
        match studio.shot(&spec, 0, [37, 21]) {
            Ok(mut shot) => studio.take(&mut shot, None, &mut ()).unwrap_or_else(|e| panic!("{}: {e}", method.name)),
            // The no-op device may lack a feature; that has to be said, not met.
            Err(error) => assert!(error.to_string().contains("lacks"), "{}: {error}", method.name),
        }
    }
}
