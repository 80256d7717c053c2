//! A toy technique: one draw at one given jitter, straight into the output.

use dejag::capture::Studio;
use dejag::pass::{Context, Draw, Extras, FrameFacts, Inputs, Jitter, Needs, Pass, Recorder, Target, Technique};
use dejag::picture::Pixel;
use dejag::sampling::{jitter_cycle, pattern};
use dejag::scene::Scene;

use super::still;

#[derive(Debug, Clone, Copy)]
struct Single {
    offset_px: [f32; 2],
}

impl Technique for Single {
    fn needs(&self) -> Needs {
        Needs::default()
    }

    fn build(&self, _: &Context<'_>) -> dejag::Result<Box<dyn Pass>> {
        Ok(Box::new(*self))
    }
}

impl Pass for Single {
    fn next_draw(&mut self, k: u32, _: &FrameFacts) -> Option<Draw> {
        let jitters = vec![Jitter { offset_px: self.offset_px, weight: 1.0 }];
        (k == 0).then(|| Draw { jitters, target: Target::Output, ..Draw::default() })
    }

    fn record(&mut self, _: &mut Recorder<'_>, _: u32, _: &Inputs<'_>, _: &wgpu::TextureView) {}
}

/// The jitters that `taa` takes by default, one after another.
pub(super) fn jitters(cycle: u32) -> Vec<[f32; 2]> {
    jitter_cycle(pattern("halton").expect("exists"), cycle, 0).iter().map(|p| p.map(|x| x as f32)).collect()
}

/// The scene's first frame at each of a cycle's jitters.
pub(super) fn draws(studio: &mut Studio<'_>, scene: &Scene, cycle: u32, size: [u32; 2]) -> Vec<Vec<Pixel>> {
    let mut draw = |offset_px| {
        let technique = Single { offset_px };
        let mut shot = studio.shot_of(&[("single", &technique)], 0, size, Extras::default()).expect("builds");
        shot.move_to(still(scene, 0), true);
        studio.take(&mut shot, None, &mut ()).expect("draws");
        studio.read(&shot).expect("reads").linear.expect("light").pixels().to_vec()
    };
    jitters(cycle).into_iter().map(&mut draw).collect()
}

/// What `count` draws of a cycle are in the mean.
pub(super) fn mean(draws: &[Vec<Pixel>], count: usize) -> Vec<Pixel> {
    let at = |pixel: usize, channel: usize| {
        let sum: f64 = (0..count).map(|n| f64::from(draws[n % draws.len()][pixel][channel])).sum();
        (sum / count as f64) as f32
    };
    (0..draws[0].len()).map(|pixel| [at(pixel, 0), at(pixel, 1), at(pixel, 2), 1.0]).collect()
}
