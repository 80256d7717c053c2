//! Bars on the command line.

use clap::Args;

use crate::scene::Thresholds;

/// What a method must meet; it is a test with exit code 1 then.
#[derive(Debug, Args)]
#[command(next_help_heading = "Bars: exit code 1 if a method misses one (a scene file's [thresholds] hold where none is given)")]
pub(super) struct Bars {
    /// Least PSNR over all frames, in dB
    #[arg(long, value_name = "DB", value_parser = parse_bar)]
    min_psnr: Option<f64>,
    /// Least PSNR of the worst frame, in dB
    #[arg(long, value_name = "DB", value_parser = parse_bar)]
    min_worst_psnr: Option<f64>,
    /// Least PSNR of the differences between frames, in dB
    #[arg(long, value_name = "DB", value_parser = parse_bar)]
    min_tpsnr: Option<f64>,
    /// Largest mean FLIP
    #[arg(long, value_name = "F", value_parser = parse_bar)]
    max_flip: Option<f64>,
    /// Largest flicker beyond the reference's, either way, over any 1 to 4 frames, in display values (1/255 is 0.0039)
    #[arg(long, value_name = "F", value_parser = parse_bar)]
    max_flicker: Option<f64>,
    /// Largest share that is left of a thing where it was 4 to 8 frames ago
    #[arg(long, value_name = "F", value_parser = parse_bar)]
    max_ghost: Option<f64>,
    /// For how many frames 1/255 of a thing may be left where it was
    #[arg(long, value_name = "FRAMES", value_parser = parse_bar)]
    max_trail: Option<f64>,
    /// Least share of the reference's thin lines
    #[arg(long, value_name = "F", value_parser = parse_bar)]
    min_continuity: Option<f64>,
    /// Largest difference of the energy from the reference's, as a share of it
    #[arg(long, value_name = "F", value_parser = parse_bar)]
    max_energy_error: Option<f64>,
    /// Largest mean crawl of a still picture, in display values
    #[arg(long, value_name = "F", value_parser = parse_bar)]
    max_crawl: Option<f64>,
    /// Most frames until a still picture is within half a dB of what it settles at
    #[arg(long, value_name = "FRAMES", value_parser = parse_bar)]
    max_convergence: Option<f64>,
    /// Most frames until nine tenths of a change of the light are seen
    #[arg(long, value_name = "FRAMES", value_parser = parse_bar)]
    max_response: Option<f64>,
    /// Largest RMS error of where straight edges are, in pixels
    #[arg(long, value_name = "PX", value_parser = parse_bar)]
    max_edge_error: Option<f64>,
    /// Ignore the bars that the scene file sets
    #[arg(long)]
    no_thresholds: bool,
}

impl Bars {
    /// Those of the command line, and where it says nothing, the scene's.
    pub(super) fn over(&self, scene: Thresholds) -> Thresholds {
        if self.no_thresholds { self.own() } else { self.own().or(scene) }
    }

    /// Those of the command line.
    pub(super) fn own(&self) -> Thresholds {
        let Self {
            min_psnr,
            min_worst_psnr,
            min_tpsnr,
            max_flip,
            max_flicker,
            max_ghost,
            max_trail,
            min_continuity,
            max_energy_error,
            max_crawl,
            max_convergence,
            max_response,
            max_edge_error,
            no_thresholds: _,
        } = *self;
        Thresholds {
            min_psnr,
            min_worst_psnr,
            min_tpsnr,
            max_flip,
            max_flicker,
            max_ghost,
            max_trail,
            min_continuity,
            max_energy_error,
            max_crawl,
            max_convergence,
            max_response,
            max_edge_error,
        }
    }
}

fn parse_bar(text: &str) -> Result<f64, String> {
    let bar = text.trim().parse::<f64>().ok().filter(|bar| *bar >= 0.0 && bar.is_finite());
    bar.ok_or_else(|| format!("'{text}' is no bar; write a number of at least 0"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_are_finite_numbers_from_0() {
        assert_eq!(parse_bar(" 1e-3 "), Ok(0.001));
        for bad in ["", "-1", "nan", "inf", "x"] {
            assert!(parse_bar(bad).is_err(), "{bad}");
        }
    }
}
