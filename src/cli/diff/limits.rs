//! Limits, and what counts, on the command line.

use clap::Args;
use std::path::PathBuf;

use crate::check::Tolerance;
use crate::compare::{Allowance, Rectangle, Scope, Settings, parse_difference, parse_limit};
use crate::error::Result;
use crate::picture::Raster;

/// What a pair must meet, and which pixels of it.
#[derive(Debug, Args)]
pub(super) struct LimitOptions {
    /// Most pixels that may differ, as a count or a share (0.1%) [default: 0, unless only metrics are limited]
    #[arg(long, value_name = "N|P%", help_heading = LIMITS)]
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
    #[arg(long, value_name = "X,Y,W,H", help_heading = COUNTS)]
    ignore: Vec<Rectangle>,
}

const LIMITS: &str = "Limits: all that are given must be met";
const COUNTS: &str = "What counts";

impl LimitOptions {
    pub(super) fn settings(&self, max_bytes: u64, watch: fn() -> Result<()>) -> Result<Settings> {
        let mask = self.mask.as_ref().map(|path| Raster::read(path, max_bytes)).transpose()?;
        Ok(Settings {
            limits: self.tolerance().limits(),
            scope: Scope::new(mask, self.ignore.clone()),
            ignore_profile: self.ignore_profile,
            sweep: self.sweep,
            max_bytes,
            watch,
        })
    }

    /// What a manifest would say.
    fn tolerance(&self) -> Tolerance {
        Tolerance {
            max_pixels: self.max_pixels,
            per_channel: self.per_channel,
            max_rmse: self.max_rmse,
            min_psnr: self.min_psnr,
            min_ssim: self.min_ssim,
            max_flip: self.max_flip,
            allow_edges: Some(self.allow_edges),
            ignore_profile: Some(self.ignore_profile),
        }
    }
}

/// A number of bytes with or without a unit.
pub(in super::super) fn parse_bytes(text: &str) -> Result<u64, String> {
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
    fn sizes() {
        assert_eq!([parse_bytes("2GiB"), parse_bytes("10"), parse_bytes("3 mib")], [Ok(1 << 31), Ok(10), Ok(3 << 20)]);
        for bad in ["", "0", "GiB", "1TB", "-1", "1.5GiB", "99999999999GiB"] {
            assert!(parse_bytes(bad).is_err(), "{bad}");
        }
    }
}
