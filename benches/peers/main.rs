//! What our filters cost beside the `smaa` crate: `cargo bench --bench peers [-- PICTURE ... --rounds N --only METHOD --plots]`.
//!
//! In one process, in turns, medians. A time is that of one frame, from its first recorded command until the device is idle again:
//! recording, one submission, waiting. The picture lies on the device before the clock starts, for everyone alike.
//!
//! The crate draws its own frame: `start_frame` hands out the target that the scene is to be drawn into, and `resolve` records its
//! three passes, submits them and leaves that target as it is. So the picture is drawn into it once, outside the time, and the
//! time is that of `start_frame`, `resolve` and waiting. It is SMAA 1x, HIGH, by luma: our `smaa:preset=high` is its twin.
//!
//! The floors are what any filter pays at least: a fragment pass that loads each pixel and stores it, and a plain texture copy.

#![expect(clippy::print_stdout, reason = "its tables are its output")]

mod contestants;
mod measure;
mod options;
mod pictures;
mod plots;

use dejag::gpu::{AdapterChoice, Gpu};
use dejag::methods::Spec;

use contestants::Line;
use measure::{pass_table, table};
use options::Options;

fn main() -> dejag::Result<()> {
    let Some(options) = Options::read(std::env::args().skip(1)) else { return Ok(()) };
    let choice = std::env::var("DEJAG_ADAPTER").map_or(AdapterChoice::Auto, |name| name.parse().expect("infallible"));
    let gpu = Gpu::open(&choice)?;
    println!("{}; medians of {} rounds in turns", gpu.card, options.rounds);
    let specs = specs(&options)?;
    for picture in pictures::all(&gpu, &options)? {
        let [width, height] = picture.size;
        println!("\n{}, {width}x{height}", picture.name);
        let mut line = Line::up(&gpu, &specs, &picture)?;
        let rows = line.measure(&gpu, options.rounds)?;
        print!("{}", table(&rows));
        print!("{}", pass_table(&line.passes(&gpu, options.rounds)?));
    }
    if options.plots {
        plots::by_size(&gpu, &options)?;
        plots::by_density(&gpu, &options)?;
    }
    Ok(())
}

/// What was asked for, or every filter at each of its presets.
fn specs(options: &Options) -> dejag::Result<Vec<Spec>> {
    let texts = if options.only.is_empty() { contestants::every_preset() } else { options.only.clone() };
    texts.iter().map(|text| Spec::parse(text)).collect()
}
