//! Limits, and what counts, on the command line.

use clap::Args;
use std::path::PathBuf;

use crate::compare::{Allowance, Limits, Measure, MetricLimit, Rectangle, Scope, Settings};
use crate::error::Result;
use crate::picture::Raster;

/// What a pair must meet, and which pixels of it.
#[derive(Debug, Args)]
pub(super) struct LimitOptions {
    /// Most pixels that may differ, as a count or a share (0.1%) [default: 0, unless only metrics are limited]
    #[arg(long, value_name = "N|P%", value_parser = parse_allowance, help_heading = LIMITS)]
    max_pixels: Option<Allowance>,
    /// How far a channel may be off before its pixel differs: N/255, N/65535 or a number [default: 0]
    #[arg(long, value_name = "D", value_parser = parse_difference, help_heading = LIMITS)]
    per_channel: Option<f64>,
    /// Largest mean FLIP error, 0 to 1
    #[arg(long, value_name = "F", value_parser = parse_limit, help_heading = LIMITS)]
    max_flip: Option<f64>,
    /// Largest root mean square difference of the colours' values
    #[arg(long, value_name = "F", value_parser = parse_limit, help_heading = LIMITS)]
    max_rmse: Option<f64>,
    /// Least PSNR of display values, in dB
    #[arg(long, value_name = "DB", value_parser = parse_limit, help_heading = LIMITS)]
    min_psnr: Option<f64>,
    /// Least structural similarity of display values, up to 1
    #[arg(long, value_name = "F", value_parser = parse_limit, help_heading = LIMITS)]
    min_ssim: Option<f64>,
    /// Let pixels of resampled edges differ, and count only those of changed objects (see docs/diff.md)
    #[arg(long, help_heading = LIMITS)]
    allow_edges: bool,
    /// Compare values even if they mean different colours
    #[arg(long, help_heading = LIMITS)]
    ignore_profile: bool,
    /// Look at every metric, and say which limit would have passed
    #[arg(long, help_heading = LIMITS)]
    sweep: bool,
    /// A picture of the same size; only pixels that are at least half white in it count
    #[arg(long, value_name = "FILE", help_heading = COUNTS)]
    mask: Option<PathBuf>,
    /// A rectangle whose pixels do not count, from column X, row Y; give it again for more
    #[arg(long, value_name = "X,Y,W,H", value_parser = parse_rectangle, help_heading = COUNTS)]
    ignore: Vec<Rectangle>,
}

const LIMITS: &str = "Limits: all that are given must be met";
const COUNTS: &str = "What counts";

impl LimitOptions {
    pub(super) fn settings(&self, max_bytes: u64, watch: fn() -> Result<()>) -> Result<Settings> {
        let mask = self.mask.as_ref().map(|path| Raster::read(path, max_bytes)).transpose()?;
        Ok(Settings {
            limits: self.limits(),
            scope: Scope::new(mask, self.ignore.clone()),
            ignore_profile: self.ignore_profile,
            sweep: self.sweep,
            max_bytes,
            watch,
        })
    }

    fn limits(&self) -> Limits {
        let metrics = [
            (Measure::Rmse, self.max_rmse),
            (Measure::Psnr, self.min_psnr),
            (Measure::Ssim, self.min_ssim),
            (Measure::Flip, self.max_flip),
        ];
        let given = metrics.into_iter().filter_map(|(measure, limit)| Some(MetricLimit { measure, limit: limit? }));
        Limits {
            max_pixels: self.max_pixels,
            per_channel: self.per_channel,
            metrics: given.collect(),
            allow_edges: self.allow_edges,
        }
    }
}

fn parse_limit(text: &str) -> Result<f64, String> {
    number(text).ok_or_else(|| format!("'{text}' is no limit; write a number of at least 0"))
}

fn number(text: &str) -> Option<f64> {
    text.trim().parse::<f64>().ok().filter(|x| *x >= 0.0 && x.is_finite())
}

fn parse_allowance(text: &str) -> Result<Allowance, String> {
    let allowance = match text.trim().strip_suffix('%') {
        Some(percent) => number(percent).filter(|percent| *percent <= 100.0).map(|percent| Allowance::Share(percent / 100.0)),
        None => text.trim().parse().ok().map(Allowance::Count),
    };
    allowance
        .ok_or_else(|| format!("'{text}' is no number of pixels; write a whole number, or a share of at most 100 such as 0.1%"))
}

fn parse_difference(text: &str) -> Result<f64, String> {
    let difference = match text.split_once('/') {
        Some((levels, of)) => number(levels).zip(number(of).filter(|of| *of > 0.0)).map(|(levels, of)| levels / of),
        None => number(text),
    };
    difference.ok_or_else(|| format!("'{text}' is no difference; write 2/255, 300/65535, or a number of at least 0 such as 0.01"))
}

fn parse_rectangle(text: &str) -> Result<Rectangle, String> {
    let numbers: Vec<Option<u32>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    match numbers[..] {
        [Some(x), Some(y), Some(width @ 1..), Some(height @ 1..)] => Ok(Rectangle { start: [x, y], size: [width, height] }),
        _ => Err(format!("'{text}' is no rectangle; write X,Y,W,H in pixels, W and H at least 1")),
    }
}

/// A number of bytes with or without a unit.
pub(super) fn parse_bytes(text: &str) -> Result<u64, String> {
    let text = text.trim();
    let digits = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    let unit = match text[digits..].trim().to_ascii_lowercase().as_str() {
        "" | "b" => Some(1),
        "k" | "kib" => Some(1 << 10),
        "m" | "mib" => Some(1 << 20),
        "g" | "gib" => Some(1 << 30),
        _ => None,
    };
    let bytes = text[..digits].parse::<u64>().ok().zip(unit).and_then(|(count, unit)| count.checked_mul(unit));
    bytes
        .filter(|bytes| *bytes > 0)
        .ok_or_else(|| format!("'{text}' is no size; write a whole number of bytes, or of KiB, MiB or GiB"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_and_counts() {
        assert_eq!(parse_allowance("12"), Ok(Allowance::Count(12)));
        assert_eq!(parse_allowance("0.1%"), Ok(Allowance::Share(0.001)));
        assert_eq!(Allowance::Share(0.003).pixels(1000), 3);
        assert_eq!(Allowance::Share(0.0039).pixels(1000), 3);
        for bad in ["", "%", "-1", "1.5", "101%", "nan%", "many"] {
            assert!(parse_allowance(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn differences() {
        assert_eq!(parse_difference("2/255"), Ok(2.0 / 255.0));
        assert_eq!(parse_difference("0.5"), Ok(0.5));
        for bad in ["", "/", "1/0", "-1/255", "1/2/3", "inf", "nan"] {
            assert!(parse_difference(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn rectangles_and_sizes() {
        assert_eq!(parse_rectangle("1, 2,3,4"), Ok(Rectangle { start: [1, 2], size: [3, 4] }));
        for bad in ["", "1,2,3", "1,2,0,4", "1,2,3,0", "-1,2,3,4", "1,2,3,4,5", "a,b,c,d", "1.5,2,3,4"] {
            assert!(parse_rectangle(bad).is_err(), "{bad}");
        }
        assert_eq!([parse_bytes("2GiB"), parse_bytes("10"), parse_bytes("3 mib")], [Ok(1 << 31), Ok(10), Ok(3 << 20)]);
        for bad in ["", "0", "GiB", "1TB", "-1", "1.5GiB", "99999999999GiB"] {
            assert!(parse_bytes(bad).is_err(), "{bad}");
        }
    }
}
