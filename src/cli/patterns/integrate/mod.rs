//! `dejag patterns integrate`: how far the mean of a pixel's samples is from the mean over the pixel.

mod pixels;
mod scene;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use super::super::{Drawing, output, parse_size};
use super::choice::Listed;
use super::output::PictureKind;
use crate::capture::REFERENCE_SPEC;
use crate::error::{Error, Result};
use crate::picture::write_bytes_atomically;
use crate::report::{self, LinePlot, Scale, Series};
use crate::suite::IntegralRow;

/// Errors of pixel means by the number of samples, of exactly known functions or of a scene
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  dejag patterns integrate --test halfplane --patterns random,jittered,larcher-pillichshammer
  dejag patterns integrate --test checker --yaw 30 --spp 16,64 --csv checker.csv
  dejag patterns integrate --test zone --shift --patterns hammersley,halton --plot zone.svg
  dejag patterns integrate fence --patterns regular,jittered,sobol-owen --spp 4,16,64 --size 320x180

Tests run on the CPU against exact answers:
  halfplane       200 000 edges across a pixel, in all directions
  halfplane-axis  the same within atan(1/8) of the axes
  checker         a checkered floor up to the horizon: all, its first 31 rows (far), the lower half (near)
  zone            a zone plate of up to 4 cycles a pixel: all, and means over 8x8 pixels (lowpass)
There, a pattern that uses the seed has a set of its own for each pixel, drawn from as many sets as --pool says; another has the same \
set in each pixel (fixed), or with --shift that set moved on the torus by chance for each (shifted).

A scene is drawn with `ssaa` on the GPU, one set for all pixels, and held against its reference.")]
pub(super) struct Integrate {
    /// A shipped scene, a scene file or a model
    #[arg(value_name = "SCENE", required_unless_present = "test", conflicts_with_all = ["test", "yaw", "shift", "pool"])]
    scene: Option<String>,
    /// A function with exact answers: halfplane, halfplane-axis, checker, zone
    #[arg(long, value_name = "NAME", conflicts_with_all = ["size", "reference"])]
    test: Option<String>,
    #[command(flatten)]
    choice: Listed,
    /// Samples a pixel
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "1,4,16,64,256,1024", value_parser = clap::value_parser!(u32).range(1..=4096))]
    spp: Vec<u32>,
    /// Of the floor in `checker`, in degrees
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, allow_negative_numbers = true)]
    yaw: f64,
    /// Move patterns without a seed on the torus, by chance for each pixel
    #[arg(long)]
    shift: bool,
    /// Different sets of a pattern with a seed [default: 2^20 points, 256 to 65536 sets]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=262_144))]
    pool: Option<u32>,
    /// The first seed
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u32,
    /// Of a scene's picture, in pixels
    #[arg(long, value_name = "WxH", default_value = "640x360", value_parser = parse_size)]
    size: [u32; 2],
    /// What a scene is held against
    #[arg(long, value_name = "METHOD", default_value = REFERENCE_SPEC)]
    reference: String,
    /// Write the errors as comma-separated values
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Plot them into this .svg file; of a test's first part
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Write the figures as JSON; - for stdout, instead of the table
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    #[command(flatten)]
    drawing: Drawing,
}

impl Integrate {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        let specs = self.choice.specs()?;
        let figures = super::output::Figures::new(self.json.clone(), self.drawing.quiet);
        figures.check()?;
        self.check_files()?;
        let mut counts = self.spp.clone();
        counts.sort_unstable();
        counts.dedup();
        let rows = match (&self.test, &self.scene) {
            (Some(test), _) => self.on_pixels(test, &specs, &counts)?,
            (None, Some(scene)) => self.on_scene(scene, &specs, &counts)?,
            (None, None) => return Err(Error::Request("name a scene, or a function with --test".into()).into()),
        };
        self.write_files(&rows)?;
        figures.show(&rows, report::integral_table)?;
        Ok(ExitCode::SUCCESS)
    }

    fn check_files(&self) -> Result<()> {
        if let Some(path) = &self.csv {
            output::check_folder_of(path)?;
        }
        match &self.plot {
            Some(path) if PictureKind::check(path)? != PictureKind::Svg => {
                Err(Error::Request(format!("{}: a plot of lines is an .svg file", path.display())))
            }
            _ => Ok(()),
        }
    }

    fn write_files(&self, rows: &[IntegralRow]) -> Result<()> {
        if let Some(path) = &self.csv {
            write_bytes_atomically(path, report::integral_csv(rows).as_bytes())?;
        }
        if let Some(path) = &self.plot {
            PictureKind::Svg.write(path, || plot(rows).svg(), || unreachable!("an .svg file was checked for"))?;
        }
        Ok(())
    }
}

/// Errors of the first part by samples a pixel, a line a pattern.
fn plot(rows: &[IntegralRow]) -> LinePlot {
    let first = rows.first().map(|row| row.part.clone());
    let series = |row: &IntegralRow| Series {
        label: row.pattern.clone(),
        baseline: false,
        // What a logarithm does not have is left out.
        points: row.errors.iter().filter(|e| e.rms > 0.0).map(|e| (f64::from(e.spp), 1e3 * e.rms)).collect(),
    };
    LinePlot {
        x: ("samples a pixel (logarithmic)".into(), Scale::Logarithmic),
        y: ("RMS error, 1/1000 of full scale (logarithmic)".into(), Scale::Logarithmic),
        series: rows.iter().filter(|row| Some(&row.part) == first.as_ref()).map(series).collect(),
    }
}
