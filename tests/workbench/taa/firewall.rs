//! What is no number, what is far too bright and what is below zero, in one pixel of one frame.

use dejag::capture::Studio;
use dejag::gpu::Gpu;
use dejag::picture::Pixel;
use dejag::scene::Scene;
use wgpu::TextureFormat as Format;

use super::rig::{Facts, Rig, Uploaded};
use super::{farthest, shown, single};
use crate::common;

const SIZE: [u32; 2] = [64, 36];

/// As the presets have them.
const CYCLES: [(&str, u32); 3] = [("taa:preset=fast", 16), ("taa:preset=balanced", 32), ("taa:preset=quality", 64)];

const NAN: Pixel = [f32::NAN, 0.5, 0.5, 1.0];
const INFINITE: Pixel = [f32::INFINITY; 4];
const NEGATIVELY_INFINITE: Pixel = [0.2, f32::NEG_INFINITY, 0.2, 1.0];
const FIREFLY: Pixel = [65504.0; 4];
const BELOW_ZERO: Pixel = [-1.0, -65504.0, 0.1, -1.0];

/// A still scene's frames, one of which has something wrong in one pixel.
struct Disturbance<'g> {
    spec: String,
    cycle: u32,
    draws: Vec<Vec<Pixel>>,
    rig: Rig<'g>,
    clean: Vec<Uploaded>,
}

impl<'g> Disturbance<'g> {
    fn new(gpu: &'g Gpu, (preset, cycle): (&str, u32), options: &str) -> Self {
        let scene = Scene::load("edges").expect("shipped");
        let mut studio = Studio::new(gpu, &scene).expect("uploads");
        let draws = single::draws(&mut studio, &scene, cycle, SIZE);
        let spec = format!("{preset}{options}");
        let rig = Rig::with_input(gpu, &spec, SIZE, Format::Rgba16Float);
        let clean = draws.iter().map(|color| rig.upload(&Facts::still(color.clone()))).collect();
        Self { spec, cycle, draws, rig, clean }
    }

    /// The frame that is wrong: the last of the first cycle, when the mean is long.
    fn when(&self) -> u32 {
        self.cycle - 1
    }

    /// Mean deviation of a pixel's samples over the cycle, in green.
    fn unrest(&self, pixel: usize) -> f32 {
        let samples = || self.draws.iter().map(|draw| draw[pixel][1]);
        let mean = samples().sum::<f32>() / self.draws.len() as f32;
        samples().map(|sample| (sample - mean).abs()).sum::<f32>() / self.draws.len() as f32
    }

    /// The same of the 3 x 3 around it, together.
    fn unrest_around(&self, pixel: usize) -> f32 {
        let (x, y) = (pixel as u32 % SIZE[0], pixel as u32 / SIZE[0]);
        (0..9).map(|i| (x + i % 3 - 1) + (y + i / 3 - 1) * SIZE[0]).map(|i| self.unrest(i as usize)).sum()
    }

    /// A pixel where nothing changes, one that only has restless neighbours, and the most restless.
    fn places(&self) -> [usize; 3] {
        let inner =
            |i: &usize| (2..SIZE[0] - 2).contains(&(*i as u32 % SIZE[0])) && (2..SIZE[1] - 2).contains(&(*i as u32 / SIZE[0]));
        let inner = || (0..self.draws[0].len()).filter(inner);
        let beside = inner().filter(|i| self.unrest(*i) == 0.0);
        let beside = beside.max_by(|a, b| self.unrest_around(*a).total_cmp(&self.unrest_around(*b))).expect("some");
        let calm = inner().min_by(|a, b| self.unrest_around(*a).total_cmp(&self.unrest_around(*b))).expect("some");
        let restless = inner().max_by(|a, b| self.unrest(*a).total_cmp(&self.unrest(*b))).expect("some");
        assert!(self.unrest_around(calm) == 0.0 && self.unrest(restless) > 0.3);
        [calm, beside, restless]
    }

    /// Frames from the wrong one on, for two cycles and one frame more.
    fn frames(&mut self, wrong: Option<(usize, Pixel)>) -> Vec<Vec<Pixel>> {
        let when = self.when();
        let dirty = wrong.map(|(place, value)| {
            let mut color = self.draws[when as usize].clone();
            color[place] = value;
            self.rig.upload(&Facts::still(color))
        });
        (self.rig.frame.index, self.rig.frame.reset) = (0, true);
        let mut frames = Vec::new();
        for index in 0..=when + 2 * self.cycle {
            let clean = &self.clean[(index % self.cycle) as usize];
            self.rig.show(if index == when { dirty.as_ref().unwrap_or(clean) } else { clean });
            if index >= when {
                frames.push(self.rig.pixels());
            }
        }
        frames
    }

    /// What is left of a wrong value after two cycles, in steps of the display. At no time is anything no number, or wide.
    fn left(&mut self, clean: &[Vec<Pixel>], place: usize, value: Pixel) -> f32 {
        let dirty = self.frames(Some((place, value)));
        let mut widest_px = 0;
        for (age, (clean, dirty)) in clean.iter().zip(&dirty).enumerate() {
            let sound = dirty.iter().flatten().all(|value| value.is_finite() && *value >= 0.0);
            assert!(sound, "{}, {value:?}, {age} frames on", self.spec);
            widest_px = widest_px.max(reach(clean, dirty, place));
        }
        let of = |age: usize| 255.0 * farthest(&clean[age], &dirty[age], shown);
        let (first, last) = (of(0), of(2 * self.cycle as usize));
        let (x, y) = (place as u32 % SIZE[0], place as u32 / SIZE[0]);
        println!(
            "{} at {x},{y}: of {value:?} {first:.2}/255 shows, {last:.3}/255 after two cycles, {widest_px} px wide",
            self.spec
        );
        // The 3 x 3 that a pixel looks at, and the 3 x 3 that sharpening looks at.
        assert!(widest_px <= 2, "{}, {value:?}: spreads by {widest_px} px", self.spec);
        last
    }
}

/// How far from a pixel anything differs, in pixels.
fn reach(a: &[Pixel], b: &[Pixel], from: usize) -> u32 {
    let place = |i: usize| [i as u32 % SIZE[0], i as u32 / SIZE[0]];
    let away = |i: usize| (0..2).map(|k| place(i)[k].abs_diff(place(from)[k])).max().unwrap_or(0);
    (0..a.len()).filter(|i| a[*i] != b[*i]).map(away).max().unwrap_or(0)
}

/// The most that is left of any of the values after two cycles, with any preset, at any of the places.
fn most_left(values: &[Pixel], places: &[usize]) -> f32 {
    let gpu = common::gpu();
    let mut most: f32 = 0.0;
    for preset in CYCLES {
        let mut disturbance = Disturbance::new(&gpu, preset, "");
        let clean = disturbance.frames(None);
        for place in places.iter().map(|place| disturbance.places()[*place]).collect::<Vec<_>>() {
            most = values.iter().map(|value| disturbance.left(&clean, place, *value)).fold(most, f32::max);
        }
    }
    most
}

#[test]
fn wrong_values_leave_no_trace_where_all_is_calm() {
    let left = most_left(&[NAN, INFINITE, NEGATIVELY_INFINITE, FIREFLY, BELOW_ZERO], &[0]);
    assert!(left <= 1.0, "{left}/255 are left after two cycles");
}

#[test]
fn what_is_no_number_leaves_no_trace_at_an_edge() {
    let left = most_left(&[NAN, INFINITE, NEGATIVELY_INFINITE], &[1, 2]);
    assert!(left <= 1.0, "{left}/255 are left after two cycles");
}

/// There the box is as wide as the edge, and what the limit leaves of it would fade only as the mean forgets.
#[test]
fn a_firefly_leaves_no_trace_at_an_edge() {
    let left = most_left(&[FIREFLY], &[1, 2]);
    assert!(left <= 1.0, "{left}/255 are left after two cycles");
}

/// Without a limit a firefly fades as the mean forgets.
#[test]
fn a_firefly_without_a_limit_fades() {
    let gpu = common::gpu();
    for clip in ["clip", "off"] {
        let mut disturbance = Disturbance::new(&gpu, CYCLES[1], &format!(",limit=0,clip={clip}"));
        let clean = disturbance.frames(None);
        let place = disturbance.places()[2];
        let dirty = disturbance.frames(Some((place, FIREFLY)));
        let left = |age: usize| farthest(&clean[age], &dirty[age], |light| light);
        let decay = [0, 1, 2, 4, 8, 16, 32, 64].map(|age| format!("{:.4} after {age}", left(age)));
        println!("{}: light left: {}", disturbance.spec, decay.join(", "));
        assert!(left(64) < 0.2 * left(0), "{} does not fade", disturbance.spec);
    }
}

#[test]
fn black_stays_black() {
    let gpu = common::gpu();
    for (spec, cycle) in CYCLES {
        let mut rig = Rig::new(&gpu, &format!("{spec},sharpen=1"), SIZE);
        let black = rig.upload(&Facts::flat([0.0; 3]));
        (0..2 * cycle).for_each(|_| rig.show(&black));
        assert!(rig.pixels().iter().all(|pixel| *pixel == [0.0, 0.0, 0.0, 1.0]), "{spec}");
    }
}
