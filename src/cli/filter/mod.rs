//! `dejag filter`: existing pictures, anti-aliased.

mod filters;
mod plan;
mod tally;
mod work;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use self::filters::Filters;
use self::plan::Plan;
use self::tally::Tally;
use self::work::Work;
use super::watch::Bar;
use super::{Drawing, output};
use crate::capture::PictureFilter;
use crate::methods::Spec;

/// Anti-alias existing pictures
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  dejag filter jagged.png -m smaa -o smooth.png
  dejag filter shots -m smaa -o smooth-shots
  dejag filter a.png b.jpg more/ -m smaa -o out --quality 98
  dejag filter jagged.png -m smaa --view weights -o weights.exr

OUT is a file where IN is one file, else a folder, which is made. A folder is read with all below it, relative paths are kept, \
and what ends in none of .png, .jpg, .jpeg, .webp and .exr is skipped. An OUT that lies in such a folder is not read. Older \
outputs are replaced; an input only with --force.

The output's extension says what is written. A PNG keeps 8 or 16 bits a channel, EXR linear light without a limit; grey, alpha, \
colour profiles and EXIF data are kept where the format can, and what it cannot is said. Pictures that lie on their side by \
their EXIF data come out upright. WebP is written losslessly. A transparent picture is not written as JPEG, animations are not \
read, and of an EXR file only the first layer with red, green and blue is.

A picture that cannot be read or written does not stop the others: it is reported, and the exit code is 3.")]
pub(super) struct Filter {
    /// Pictures, or folders of them
    #[arg(required = true, value_name = "IN")]
    inputs: Vec<PathBuf>,
    /// A filter with its options, or several joined by + (see `dejag list methods`)
    #[arg(short, long, value_name = "METHOD")]
    method: String,
    /// A file for one picture, a folder for several
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// Write an intermediate of the method instead of the result
    #[arg(long, value_name = "NAME")]
    view: Option<String>,
    /// Quality of JPEG files, 1 to 100
    #[arg(long, value_name = "N", default_value_t = 95, value_parser = clap::value_parser!(u8).range(1..=100))]
    quality: u8,
    /// Let outputs replace the very pictures they are made of
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    drawing: Drawing,
}

impl Filter {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        let spec = Spec::parse(&self.method)?;
        PictureFilter::check(&spec)?;
        let plan = Plan::of(&self.inputs, &self.output, self.force)?;
        let gpu = self.drawing.open()?;
        let mut filters = Filters::new(&gpu, &spec, self.view.as_deref())?;

        let mut bar = Bar::new(plan.jobs.len() as u64, self.drawing.quiet);
        bar.say(spec.to_string());
        let mut tally = Tally::new(&plan, &mut bar, self.drawing.verbose);
        Work { jobs: &plan.jobs, quality: self.quality }.run(&mut filters, &mut |index, outcome| tally.add(index, outcome))?;
        let ended = tally.end(&spec)?;
        bar.finish();
        if !self.drawing.quiet {
            ended.words.iter().for_each(|line| output::say(line));
        }
        Ok(if ended.failed { ExitCode::from(3) } else { ExitCode::SUCCESS })
    }
}
