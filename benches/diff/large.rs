//! The largest pair that anybody is likely to have.

use std::io;
use std::path::Path;

use super::measure;
use super::pictures::{Kind, Pair, Scene};
use super::tools::Tool;

const SIZE: [u32; 2] = [16_384, 16_384];

/// Seconds and peak memory of the plain test and of FLIP.
pub(crate) fn table(scratch: &Path) -> io::Result<String> {
    let pair = Pair { expected: scratch.join("large.png"), actual: scratch.join("large2.png"), kind: Kind::Slight };
    let scene = Scene::of(0, SIZE);
    scene.save(&pair.expected)?;
    scene.patched().save(&pair.actual)?;
    let mut text = String::from("| 16384x16384, RGB | wall s | user s | peak MiB |\n|---|--:|--:|--:|\n");
    for options in [&[][..], &["--max-flip", "1"]] {
        let tool = Tool::dejag(options);
        let (times, _) = measure::run(&mut tool.command(&pair))?;
        let peak = measure::peak_bytes(&tool.command(&pair), scratch)?.unwrap_or(0) >> 20;
        text += &format!("| {} | {:.1} | {:.1} | {peak} |\n", tool.name, times.wall_s, times.user_s);
    }
    Ok(text)
}
