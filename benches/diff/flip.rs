//! `--max-flip`, a process a pair with all that it does, beside libraries that get decoded pictures handed to them.

use std::time::Instant;

use dejag::picture::{DisplayPicture, load};

use super::measure::{self, Times};
use super::options::Options;
use super::pictures::{Kind, Pair};
use super::table;
use super::tools::Tool;

/// Medians over the first pairs that are not equal, in turns.
pub(crate) fn table(pairs: &[Pair], options: &Options) -> Result<String, Box<dyn std::error::Error>> {
    let tool = Tool::dejag(&["--max-flip", "1"]);
    let (mut command, mut port, mut original) = (Vec::new(), Vec::new(), Vec::new());
    for pair in pairs.iter().filter(|pair| pair.kind != Kind::Identical).take(options.flips) {
        command.push(measure::run(&mut tool.command(pair))?.0);
        let pictures = [load(&pair.expected)?.into_display(), load(&pair.actual)?.into_display()];
        port.push(flip_rs(&pictures)?);
        original.extend(nv_flip(&pictures));
    }
    let mut rows = vec![(tool.name.as_str(), command), ("flip-rs, decoded before", port)];
    if original.is_empty() {
        println!("nv-flip is absent: build with --features flip-oracle");
    } else {
        rows.push(("nv-flip, decoded before", original));
    }
    Ok(table::flip(&rows))
}

fn timed<T>(work: impl FnOnce() -> T) -> (Times, T) {
    let (user, start) = (measure::own_user_s(), Instant::now());
    let answer = work();
    (Times { wall_s: start.elapsed().as_secs_f64(), user_s: measure::own_user_s() - user }, answer)
}

fn flip_rs(pictures: &[DisplayPicture; 2]) -> Result<Times, flip_rs::FlipError> {
    let [expected, actual] = pictures.each_ref().map(|picture| {
        let values = picture.pixels().iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect();
        flip_rs::RgbImage::new(picture.width() as usize, picture.height() as usize, values)
    });
    let (expected, actual) = (expected?, actual?);
    let (times, map) = timed(|| flip_rs::ldr_flip(&expected, &actual, flip_rs::DEFAULT_PPD));
    map.map(|_| times)
}

#[cfg(feature = "flip-oracle")]
fn nv_flip(pictures: &[DisplayPicture; 2]) -> Option<Times> {
    let [expected, actual] = pictures.each_ref().map(|picture| {
        let bytes: Vec<u8> = picture.to_rgba8().chunks_exact(4).flat_map(|pixel| pixel[..3].to_vec()).collect();
        nv_flip::FlipImageRgb8::with_data(picture.width(), picture.height(), &bytes)
    });
    Some(timed(|| nv_flip::flip(expected, actual, nv_flip::DEFAULT_PIXELS_PER_DEGREE)).0)
}

#[cfg(not(feature = "flip-oracle"))]
fn nv_flip(_: &[DisplayPicture; 2]) -> Option<Times> {
    None
}
