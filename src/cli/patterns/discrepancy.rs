//! `dejag patterns discrepancy`: where boxes hold too many points or too few.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use super::super::output;
use super::Sets;
use super::choice::{Choice, all};
use super::draw::DOT_RADIUS;
use super::output::PictureKind;
use crate::error::Error;
use crate::report::{Panel, Panels, deviation_map};
use crate::sampling::PatternSpec;
use crate::sampling::measure::{deviations, star};

/// Draw a map of anchored boxes: red where a box from the upper left corner to here has too many points, blue where too few
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  dejag patterns discrepancy hammersley -n 256 -o map.png
  dejag patterns discrepancy random jittered larcher-pillichshammer -n 64 -o maps.svg

The strongest colour is the largest deviation on the map; the star discrepancy is printed for each pattern. y points down.")]
pub(super) struct Discrepancy {
    #[command(flatten)]
    choice: Choice,
    #[command(flatten)]
    sets: Sets,
    /// Where to write: a .png or .svg file
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Of each map, in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 512, value_parser = clap::value_parser!(u32).range(1..=4096))]
    size: u32,
}

impl Discrepancy {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        let specs = self.choice.specs(all)?;
        let kind = PictureKind::check(&self.output)?;
        let mut lines = Vec::new();
        let mut panels = Panels { panels: Vec::new(), side_px: self.size };
        for spec in &specs {
            let (panel, star) = self.panel(spec)?;
            lines.push(format!("{spec}: star discrepancy {star:.6}"));
            panels.panels.push(panel);
        }
        kind.write(&self.output, || Some(panels.svg()), || panels.picture())?;
        output::print(&lines.join("\n"))?;
        Ok(ExitCode::SUCCESS)
    }

    fn panel(&self, spec: &PatternSpec) -> Result<(Panel, f64), Error> {
        let points = self.sets.of_trial(spec, 0)?;
        let star = star(&points);
        let panel = Panel {
            title: format!("{spec}, n = {}, star {star:.4}", self.sets.n),
            ground: Some(deviation_map(&deviations(&points, self.size as usize), self.size)?),
            radius: 0.5 * DOT_RADIUS / f64::from(self.sets.n).sqrt(),
            points,
            round: false,
        };
        Ok((panel, star))
    }
}
