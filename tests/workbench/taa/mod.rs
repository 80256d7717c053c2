//! What must hold of `taa`: it converges as supersampling does, neither drifts nor stalls, follows motion to the bit where that can be
//! asked for, forgets what is no number, and does what its options say.

mod drift;
mod firewall;
mod knobs;
mod peer;
mod repeats;
mod rig;
mod single;
mod still;
mod vectors;
mod whole_pixels;

use dejag::capture::{Shot, Studio};
use dejag::methods::Spec;
use dejag::picture::{DisplayPicture, LinearPicture, Pixel};
use dejag::scene::{Scene, Tick};

const PRESETS: [&str; 3] = ["taa:preset=fast", "taa:preset=balanced", "taa:preset=quality"];

/// A running mean of plain samples, and nothing else.
const PLAIN: &str = "taa:weight=none,input=box,clip=off,sharpen=0,limit=0";

/// A scene that stands still as in its first frame, while frames count on.
fn still(scene: &Scene, index: i64) -> Tick {
    Tick { time_s: 0.0, previous_time_s: 0.0, step_s: 0.0, ..Tick::of(scene, index) }
}

/// One that stands still while the picture moves right and down by so much a frame.
fn panned(scene: &Scene, index: i64, step_px: [f64; 2]) -> Tick {
    let shift_px = |index: i64| step_px.map(|step| step * index as f64);
    Tick { shift_px: shift_px(index), previous_shift_px: shift_px(index - 1), shift_step_px: step_px, ..still(scene, index) }
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

    fn take(&mut self, tick: Tick, reset: bool) {
        self.shot.move_to(tick, reset);
        self.studio.take(&mut self.shot, None, &mut ()).expect("draws");
    }

    fn linear(&self) -> LinearPicture {
        self.studio.read(&self.shot).expect("reads").linear.expect("taa makes light")
    }

    fn display(&self) -> DisplayPicture {
        self.studio.read(&self.shot).expect("reads").display
    }
}

/// As the display shows light, without a tone map.
fn shown(light: f32) -> f32 {
    let light = light.clamp(0.0, 1.0);
    if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 }
}

/// Largest difference of colours, each taken as `value` says.
fn farthest(a: &[Pixel], b: &[Pixel], value: fn(f32) -> f32) -> f32 {
    assert_eq!(a.len(), b.len());
    let colors = |pixels: &[Pixel]| pixels.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).map(value).collect::<Vec<_>>();
    colors(a).iter().zip(colors(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

/// Of display values, peak 1, in dB.
fn psnr(a: &DisplayPicture, b: &DisplayPicture) -> f64 {
    let squares = a.pixels().iter().zip(b.pixels()).flat_map(|(a, b)| (0..3).map(|c| f64::from(a[c] - b[c]).powi(2)));
    -10.0 * (squares.sum::<f64>() / (3 * a.pixels().len()) as f64).log10()
}

/// Sum of all colours.
fn energy(pixels: &[Pixel]) -> f64 {
    pixels.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).map(f64::from).sum()
}
