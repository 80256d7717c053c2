//! Modes of several samples a pixel, and what they make of the frame before.

use dejag::capture::{Cache, Shot, Studio};
use dejag::gpu::Gpu;
use dejag::methods::Spec;
use dejag::picture::Pixel;
use dejag::scene::{Scene, Tick};

use super::Lab;

const SIZE: [u32; 2] = [160, 90];

/// The `edges` scene, moved.
struct Stage<'g> {
    scene: &'g Scene,
    studio: Studio<'g>,
}

impl<'g> Stage<'g> {
    fn new(gpu: &'g Gpu, scene: &'g Scene) -> Self {
        Self { studio: Studio::new(gpu, scene).expect("uploads"), scene }
    }

    /// A frame, so far to the right and so much farther than the one before.
    fn tick(&self, index: i64, shift_px: f64, step_px: f64) -> Tick {
        let tick =
            Tick { shift_px: [shift_px, 0.0], previous_shift_px: [shift_px - step_px, 0.0], ..Tick::of(self.scene, index) };
        Tick { time_s: 0.0, previous_time_s: 0.0, ..tick }
    }

    /// The last of several frames, and the shot that took them.
    fn last(&mut self, spec: &str, ticks: &[Tick]) -> (Vec<Pixel>, Shot) {
        let mut shot = self.studio.shot(&Spec::parse(spec).expect(spec), 0, SIZE).expect("builds");
        for (i, tick) in ticks.iter().enumerate() {
            shot.move_to(*tick, i == 0);
            self.studio.take(&mut shot, None, &mut ()).expect("draws");
        }
        (self.studio.read(&shot).expect("reads").display.pixels().to_vec(), shot)
    }

    /// RMS error of the last of several frames against many samples.
    fn error(&mut self, spec: &str, ticks: &[Tick]) -> f64 {
        let folder = tempfile::tempdir().expect("a folder");
        let cache = Cache::in_folder(folder.path().into(), 1 << 30);
        let reference = Spec::parse("ssaa:spp=256").expect("exists");
        let tick = ticks.last().expect("some");
        let exact = self.studio.reference(&reference, tick, SIZE, &cache, &mut ()).expect("draws").display;
        let error = distance(&self.last(spec, ticks).0, exact.pixels());
        println!("{spec}: RMS {error:.4}");
        error
    }
}

fn distance(a: &[Pixel], b: &[Pixel]) -> f64 {
    let squares = a.iter().zip(b).flat_map(|(a, b)| (0..3).map(|c| f64::from(a[c] - b[c]).powi(2)));
    (squares.sum::<f64>() / (3 * a.len()) as f64).sqrt()
}

pub(super) fn more_samples_are_nearer_to_the_reference(lab: &Lab, _: &str) {
    let scene = Scene::load("edges").expect("shipped");
    let mut stage = Stage::new(&lab.gpu, &scene);
    let still = [0, 1, 2].map(|index| stage.tick(index, 0.0, 0.0));
    let of = ["1x", "s2x", "t2x", "4x"].map(|mode| stage.error(&format!("smaa:mode={mode}"), &still));
    assert!(of[1] < 0.9 * of[0] && of[2] < 0.9 * of[0] && of[3] < 0.9 * of[2], "{of:?}");
    assert_eq!(of[1], of[2], "the same two places");
}

pub(super) fn followed_motion_is_nearer_to_the_reference(lab: &Lab, _: &str) {
    let scene = Scene::load("edges").expect("shipped");
    let mut stage = Stage::new(&lab.gpu, &scene);
    let moved = [0, 1, 2].map(|index| stage.tick(index, 2.3 * index as f64, 2.3));
    for mode in ["t2x", "4x"] {
        let [on, off] = ["on", "off"].map(|reproject| stage.error(&format!("smaa:mode={mode},reproject={reproject}"), &moved));
        assert!(2.0 * on < off, "{mode}: {on}, {off}");
    }
}

pub(super) fn a_change_of_speed_takes_weight(lab: &Lab, _: &str) {
    let scene = Scene::load("edges").expect("shipped");
    let mut stage = Stage::new(&lab.gpu, &scene);
    // At rest, then by a pixel: a change of 1/160 of the picture's width, which weighs (1 - scale * 0.079) / 2.
    let starts = [stage.tick(0, 0.0, 0.0), stage.tick(1, 0.0, 0.0), stage.tick(2, 1.0, 1.0)];
    let steady = [stage.tick(0, -1.0, 1.0), stage.tick(1, 0.0, 1.0), stage.tick(2, 1.0, 1.0)];
    let mut mixed = |scale: &str, ticks: &[Tick]| {
        let (picture, mut shot) = stage.last(&format!("smaa:mode=t2x,velocity_scale={scale}"), ticks);
        let current = shot.view(&lab.gpu, "current").expect("a view");
        distance(&picture, lab.gpu.read_linear(current.texture()).expect("reads").pixels())
    };
    let found = ["0", "4", "8", "30"].map(|scale| mixed(scale, &starts));
    println!("smaa: the frame before changes a picture that starts to move by {found:.5?} with velocity_scale=0, 4, 8, 30");
    assert!(found.is_sorted_by(|more, less| more > less) && found[3] == 0.0, "{found:?}");
    let [trusting, wary] = ["0", "30"].map(|scale| mixed(scale, &steady));
    assert!((trusting - wary).abs() < 0.1 * trusting, "steady motion loses little: {trusting}, {wary}");
}
