//! SMAA's modes of several samples a pixel, on sequences: still, moving, cut, repeated and dropped frames.

mod history;
mod quality;

use dejag::capture::{Shot, Studio};
use dejag::methods::Spec;
use dejag::picture::DisplayPicture;
use dejag::scene::{Scene, Tick};

/// The picture moved right and down by so much a frame.
fn moving(scene: &Scene, index: i64, step_px: [f64; 2]) -> Tick {
    let shift_px = |index: i64| step_px.map(|step| step * index as f64);
    let still = Tick { time_s: 0.0, previous_time_s: 0.0, step_s: 0.0, ..Tick::of(scene, index) };
    Tick { shift_px: shift_px(index), previous_shift_px: shift_px(index - 1), shift_step_px: step_px, ..still }
}

/// A method that is given one frame after another.
struct Sequence<'s, 'g> {
    studio: &'s mut Studio<'g>,
    shot: Shot,
}

impl<'s, 'g> Sequence<'s, 'g> {
    fn new(studio: &'s mut Studio<'g>, method: &str, size: [u32; 2]) -> Self {
        let shot = studio.shot(&Spec::parse(method).expect(method), 0, size).expect("builds");
        Self { studio, shot }
    }

    fn take(&mut self, tick: Tick, reset: bool) -> DisplayPicture {
        self.shot.move_to(tick, reset);
        self.studio.take(&mut self.shot, None, &mut ()).expect("draws");
        self.studio.read(&self.shot).expect("reads").display
    }
}
