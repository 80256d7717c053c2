//! `adaptive:scheme=whitted` against the recursion as it is written down, over plain draws of every sample.

use std::collections::{BTreeMap, BTreeSet};

use dejag::capture::{Capture, Shot, Studio};
use dejag::gpu::Gpu;
use dejag::methods::Spec;
use dejag::pass::{Context, Draw, Extras, FrameFacts, Inputs, Jitter, Needs, Pass, Recorder, Target, Technique};
use dejag::picture::LinearPicture;
use dejag::scene::Scene;

use crate::common;

/// One draw with one sample a pixel, anywhere in it.
#[derive(Debug, Clone, Copy)]
struct Plain(Jitter);

impl Technique for Plain {
    fn needs(&self) -> Needs {
        Needs::default()
    }

    fn build(&self, _: &Context<'_>) -> dejag::Result<Box<dyn Pass>> {
        Ok(Box::new(*self))
    }
}

impl Pass for Plain {
    fn next_draw(&mut self, k: u32, _: &FrameFacts) -> Option<Draw> {
        (k == 0).then(|| Draw { jitters: vec![self.0], target: Target::Output, ..Draw::default() })
    }

    fn record(&mut self, _: &mut Recorder<'_>, _: u32, _: &Inputs<'_>, _: &wgpu::TextureView) {}
}

/// Eighths of a pixel, of a pixel's side.
const SIDE: u32 = 8;

/// Every sample that any pixel may take, by its place in the pixel.
struct Samples {
    pictures: BTreeMap<[u32; 2], LinearPicture>,
    size: [u32; 2],
    exposure: f64,
}

impl Samples {
    fn draw(studio: &mut Studio<'_>, size: [u32; 2]) -> Self {
        let points = (0..25).map(|i| [2 * (i % 5), 2 * (i / 5)]);
        let centres = (0..16).map(|i| [2 * (i % 4) + 1, 2 * (i / 4) + 1]);
        let mut draw = |place: [u32; 2]| {
            let plain = Plain(Jitter { offset_px: place.map(|eighths| eighths as f32 / 8.0 - 0.5), weight: 1.0 });
            let mut shot = studio.shot_of(&[("plain", &plain)], 0, size, Extras::default()).expect("builds");
            studio.take(&mut shot, None, &mut ()).expect("draws");
            studio.read(&shot).expect("reads").linear.expect("linear")
        };
        let pictures = points.chain(centres).map(|place| (place, draw(place))).collect();
        Self { pictures, size, exposure: studio.scene.exposure.into() }
    }

    /// Which pixel a place is drawn by, in eighths from the picture's upper left.
    fn owner(&self, place: [u32; 2]) -> [u32; 2] {
        [0, 1].map(|axis| (place[axis] / SIDE).min(self.size[axis] - 1))
    }

    fn at(&self, place: [u32; 2]) -> [f64; 3] {
        let [x, y] = self.owner(place);
        let pixel = self.pictures[&[place[0] - SIDE * x, place[1] - SIDE * y]].pixel(x, y);
        [0, 1, 2].map(|channel| pixel[channel].into())
    }

    fn differ(&self, a: [f64; 3], b: [f64; 3], threshold: f64) -> bool {
        let seen = |linear: f64| (self.exposure * linear).clamp(0.0, 1.0).sqrt();
        a.iter().zip(b).any(|(a, b)| (seen(*a) - seen(b)).abs() > threshold)
    }

    /// Of a square, with every sample that it takes.
    fn mean(&self, square: [u32; 2], side: u32, threshold: f64, taken: &mut BTreeSet<[u32; 2]>) -> [f64; 3] {
        let centre_at = square.map(|x| x + side / 2);
        let centre = self.at(centre_at);
        taken.insert(centre_at);
        let mut sum = [0.0; 3];
        for child in [[0, 0], [1, 0], [0, 1], [1, 1]] {
            let to = |step: u32| [square[0] + step * child[0], square[1] + step * child[1]];
            let corner = self.at(to(side));
            taken.insert(to(side));
            let part = if side > 2 && self.differ(centre, corner, threshold) {
                self.mean(to(side / 2), side / 2, threshold, taken)
            } else {
                [0, 1, 2].map(|c| 0.5 * (centre[c] + corner[c]))
            };
            sum = [0, 1, 2].map(|c| sum[c] + part[c]);
        }
        sum.map(|sum| 0.25 * sum)
    }

    /// All 41 of a pixel by their weights: a centre's is half its square, a corner's an eighth of each square that touches it.
    fn mean_of_all(&self, pixel: [u32; 2]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for place in self.pictures.keys() {
            let squares = |eighths: u32| if eighths == 0 || eighths == SIDE { 1.0 } else { 2.0 };
            let weight = if place[0] % 2 == 1 { 0.5 } else { 0.125 * squares(place[0]) * squares(place[1]) };
            let value = self.at([0, 1].map(|axis| SIDE * pixel[axis] + place[axis]));
            sum = [0, 1, 2].map(|c| sum[c] + weight / 16.0 * value[c]);
        }
        sum
    }
}

fn take(studio: &mut Studio<'_>, spec: &str, size: [u32; 2]) -> (Shot, Capture) {
    let mut shot = studio.shot(&Spec::parse(spec).expect(spec), 0, size).expect("builds");
    studio.take_alone(&mut shot, &mut ()).expect("draws");
    let capture = studio.read(&shot).expect("reads");
    (shot, capture)
}

fn error(found: [f32; 4], expected: [f64; 3]) -> f64 {
    (0..3).map(|c| (f64::from(found[c]) - expected[c]).abs()).fold(0.0, f64::max)
}

/// What the map shows of so many samples.
fn grey(samples: u32) -> f32 {
    (f64::from(samples).log2() / 5.0).min(1.0) as f32
}

fn pixels([width, height]: [u32; 2]) -> impl Iterator<Item = [u32; 2]> {
    (0..height).flat_map(move |y| (0..width).map(move |x| [x, y]))
}

/// Pixels, their means and their counts are those of the recursion, to the sample.
fn holds(gpu: &Gpu, name: &str, size: [u32; 2], threshold: f64) {
    let scene = Scene::load(name).expect("shipped");
    let mut studio = Studio::new(gpu, &scene).expect("uploads");
    let samples = Samples::draw(&mut studio, size);
    let (mut shot, capture) = take(&mut studio, &format!("adaptive:scheme=whitted,threshold={threshold}"), size);
    let map = gpu.read_linear(shot.view(gpu, "refine").expect("there is one").texture()).expect("reads");
    let linear = capture.linear.expect("linear");
    let mut taken = BTreeSet::new();
    for [x, y] in pixels(size) {
        let expected = samples.mean([SIDE * x, SIDE * y], SIDE, threshold, &mut taken);
        let error = error(linear.pixel(x, y), expected);
        assert!(error < 1e-5, "{name} {size:?} at {x},{y}: {error}");
    }
    let mut counts: BTreeMap<[u32; 2], u32> = BTreeMap::new();
    for place in &taken {
        *counts.entry(samples.owner(*place)).or_default() += 1;
    }
    for ([x, y], count) in counts {
        assert!((map.pixel(x, y)[0] - grey(count)).abs() < 0.6 / 255.0, "{name} {size:?} at {x},{y}: {count} samples");
    }
    let [width, height] = size.map(f64::from);
    let expected = taken.len() as f64 / (width * height);
    println!("{name} {size:?} at {threshold}: {expected:.2} samples a pixel");
    assert!((capture.samples_per_pixel - expected).abs() < 1e-9, "{name} {size:?}: {} for {expected}", capture.samples_per_pixel);
}

#[test]
fn means_and_counts_are_those_of_the_recursion() {
    let gpu = common::gpu();
    // Thresholds that no difference of two halves meets to the last bit.
    for (name, size) in [("edges", [37, 21]), ("fence", [40, 23]), ("foliage", [1, 1]), ("edges", [3, 5]), ("fence", [1, 30])] {
        holds(&gpu, name, size, 0.0213);
    }
    holds(&gpu, "courtyard", [33, 18], 0.1017);
}

#[test]
fn without_a_threshold_all_samples_count_by_area() {
    const SIZE: [u32; 2] = [48, 27];
    let gpu = common::gpu();
    let scene = Scene::load("zoneplate").expect("shipped");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    let samples = Samples::draw(&mut studio, SIZE);
    let linear = take(&mut studio, "adaptive:scheme=whitted,threshold=0", SIZE).1.linear.expect("linear");
    let mut refined = 0;
    for [x, y] in pixels(SIZE) {
        let mut taken = BTreeSet::new();
        samples.mean([SIDE * x, SIDE * y], SIDE, 0.0, &mut taken);
        // Where a corner happens to be of its centre's very colour, the rest of its quadrant is not looked at.
        if taken.len() == 41 {
            refined += 1;
            let error = error(linear.pixel(x, y), samples.mean_of_all([x, y]));
            assert!(error < 1e-3, "{x},{y}: {error}");
        }
    }
    assert!(refined * 10 > SIZE[0] * SIZE[1] * 9, "{refined} of {SIZE:?} pixels have all samples");
}

/// A unit is a pixel of a picture one pixel high; the upper three sixteenths of it are white.
const LEVEL_EDGE: &str = "
background = [0, 0, 0]
[camera]
projection = 'orthographic'
height = 1
near = 0
far = 20
position = [0, 0, 10]
target = [0, 0, 0]
[[objects]]
position = [0, 0.8125, 0]
shape = { quad = { size = [4, 1] } }
material = { color = [1, 1, 1], unlit = true }
";

fn parsed(text: &str) -> Scene {
    Scene::parse(text, "test.toml", std::path::Path::new(".")).expect("a good scene")
}

/// By hand: of the 5 of the pixel the upper corners are white and all else black, so the upper quadrants are refined. They add
/// 2 centres and 3 middles of edges (10); of those one lies on the upper border, so their 4 upper squares are refined and add
/// 4 centres and 5 middles (19). Each of the 4 is white at its centre and its upper corners, 1/2 + 2/8, and a sixteenth of the pixel.
#[test]
fn a_level_edge_takes_19_of_41_samples() {
    let gpu = common::gpu();
    let scene = parsed(LEVEL_EDGE);
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    let (mut shot, capture) = take(&mut studio, "adaptive:scheme=whitted", [1, 1]);
    assert_eq!(capture.samples_per_pixel, 19.0);
    assert_eq!(capture.linear.expect("linear").pixel(0, 0)[..3], [4.0 / 16.0 * (1.0 / 2.0 + 2.0 / 8.0); 3]);
    let map = gpu.read_linear(shot.view(&gpu, "refine").expect("there is one").texture()).expect("reads");
    assert!((map.pixel(0, 0)[0] - grey(19)).abs() < 0.6 / 255.0, "{:?}", map.pixel(0, 0));
}

/// The same edge in a row of pixels: all but the last leave what lies on their right border to the next.
#[test]
fn neighbours_share_samples() {
    let gpu = common::gpu();
    let scene = parsed(LEVEL_EDGE);
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    let (_, capture) = take(&mut studio, "adaptive:scheme=whitted", [3, 1]);
    // Two of the corners and two middles (at a quarter and at half the height) lie on the right border.
    assert_eq!(capture.samples_per_pixel * 3.0, f64::from(2 * (19 - 4) + 19));
}

#[test]
fn a_constant_picture_takes_two_samples_a_pixel() {
    let gpu = common::gpu();
    let scene = parsed(&LEVEL_EDGE.replace("0.8125", "9").replace("[0, 0, 0]\n[camera]", "[0.3, 0.05, 0.7]\n[camera]"));
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    for size in [[1, 1], [7, 1], [64, 35]] {
        let (_, capture) = take(&mut studio, "adaptive:scheme=whitted,threshold=0", size);
        // And the corners on the right and lower border of the picture.
        let [width, height] = size.map(f64::from);
        assert_eq!(capture.samples_per_pixel * width * height, 2.0 * width * height + width + height + 1.0, "{size:?}");
        let none = take(&mut studio, "none", size).1.linear.expect("linear");
        let linear = capture.linear.expect("linear");
        assert!(pixels(size).all(|[x, y]| linear.pixel(x, y) == none.pixel(x, y)), "{size:?}");
    }
}

#[test]
fn taking_a_shot_again_gives_the_same_bits() {
    let gpu = common::gpu();
    let scene = Scene::load("fence").expect("shipped");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    let mut shot = studio.shot(&Spec::parse("adaptive:scheme=whitted").expect("exists"), 0, [61, 35]).expect("builds");
    let mut again = || {
        studio.take(&mut shot, None, &mut ()).expect("draws");
        studio.read(&shot).expect("reads")
    };
    let [first, second] = [again(), again()];
    assert!(first.linear == second.linear && first.samples_per_pixel == second.samples_per_pixel);
}

#[test]
fn options_of_the_flat_scheme_are_refused() {
    for option in ["probe=4", "max=16", "criterion=all", "dilate=0", "pattern=random", "seed=1", "independent=on", "outline=off"]
    {
        let error = Spec::parse(&format!("adaptive:scheme=whitted,{option}")).expect_err(option).to_string();
        let name = option.split('=').next().expect("has one");
        assert!(error.contains(name) && error.contains("scheme=flat"), "{error}");
    }
}
