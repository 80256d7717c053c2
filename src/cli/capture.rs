//! `dejag capture`: one frame of a scene, anti-aliased, as a picture.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;

use super::watch::{Bar, check_interrupt};
use super::{Drawing, output, parse_size};
use crate::capture::{Studio, View, ViewKind};
use crate::error::Error;
use crate::methods::Spec;
use crate::picture::{BitDepth, FileFormat};
use crate::scene::Scene;

/// Draw one frame of a scene with a method and write the picture
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  dejag capture edges -o edges.png
  dejag capture courtyard -m ssaa:spp=256,filter=mitchell -o courtyard.png --bits 16
  dejag capture my-scene.toml -m msaa:samples=4,weight=luma -o linear.exr
  dejag capture pan --frame 12 --view motion -o motion.png

PNG files hold display values (exposed, tone-mapped, sRGB), EXR files linear ones before the exposure.

Views, at the pixels' centres whatever the method:
  depth   reversed, 1 at the near plane (near / distance in perspective), 0 at infinity; EXR: red, PNG: its fourth root
  motion  pixels from this frame to the one before, right and down; EXR: red and green, PNG: grey at rest, full at 16
  ids     whole numbers from 1, 0 for the background; EXR: red, PNG: a colour each
An intermediate of a method (half-a and half-b of ssaa) is written as it is, without exposure and tone map.")]
pub(super) struct Capture {
    /// A shipped scene's name, a scene file (.toml), or a model (.gltf, .glb), which is framed automatically
    scene: String,
    /// The method with its options, such as ssaa:spp=64 (see `dejag list methods`)
    #[arg(short, long, value_name = "METHOD", default_value = "none")]
    method: String,
    /// Where to write: a .png or .exr file
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "640x360", value_parser = parse_size)]
    size: [u32; 2],
    /// Which frame, from 0
    #[arg(long, value_name = "N", default_value_t = 0)]
    frame: u32,
    /// colour, depth, motion, ids, or an intermediate of the method
    #[arg(long, value_name = "WHAT", default_value = "colour")]
    view: ViewKind,
    /// Bits a channel in a PNG file
    #[arg(long, value_name = "N", default_value = "8", value_parser = ["8", "16"])]
    bits: String,
    #[command(flatten)]
    drawing: Drawing,
}

impl Capture {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        let spec = Spec::parse(&self.method)?;
        let format = output::check_file(&self.output)?;
        let scene = load(&self.scene, self.drawing.quiet)?;
        let gpu = self.drawing.open()?;
        let mut studio = Studio::new(&gpu, &scene)?;
        let mut bar = Bar::new(u64::from(spec.first_needs().samples_per_pixel), self.drawing.quiet);
        bar.say(format!("{} {spec}", scene.name));
        let view = studio.view(&self.view, &spec, self.frame, self.size, &mut bar)?;
        check_interrupt()?;
        let (spec, frame, card) = (spec.to_string(), self.frame.to_string(), gpu.card.to_string());
        let metadata = [
            ("Software", concat!("dejag ", env!("CARGO_PKG_VERSION"))),
            ("scene", scene.name.as_str()),
            ("method", &spec),
            ("frame", &frame),
            ("adapter", &card),
        ];
        let depth = if self.bits == "16" { BitDepth::Sixteen } else { BitDepth::Eight };
        save(&view, &self.output, format, depth, &metadata)?;
        bar.finish();
        if !self.drawing.quiet {
            let ([width, height], path, name) = (self.size, self.output.display(), &scene.name);
            output::say(&format!("{path}: {} of {name} with {spec}, frame {frame}, {width}x{height}", self.view));
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// Writes a view: its numbers into an EXR file, its colours into a PNG.
fn save(view: &View, path: &Path, format: FileFormat, depth: BitDepth, metadata: &[(&str, &str)]) -> Result<(), Error> {
    match format {
        FileFormat::Png => view.display.save_png(path, depth, metadata),
        FileFormat::Exr => view.data.save_exr(path, metadata),
    }
}

/// Loads a scene and says what of it is drawn differently from what it asks.
pub(super) fn load(name: &str, quiet: bool) -> Result<Scene, Error> {
    let scene = Scene::load(name)?;
    if !quiet {
        for warning in &scene.warnings {
            output::say(&format!("warning: {name}: {warning}"));
        }
    }
    Ok(scene)
}
