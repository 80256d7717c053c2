//! Pictures of pixel means beside exact ones, as `dejag patterns report` shows them. The same command gives the same bytes.

use serde::{Deserialize, Serialize};

use super::Stamp;

/// Version of the JSON's shape; it rises when a key changes its meaning or goes away.
pub const SERIES_SCHEMA_VERSION: u32 = 1;

/// The whole report.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SeriesResults {
    /// [`SERIES_SCHEMA_VERSION`].
    pub schema_version: u32,
    /// What drew the scenes.
    pub stamp: Stamp,
    /// The command line that makes this report again, without the name of the program.
    pub command: Vec<String>,
    /// In the page's order.
    pub chapters: Vec<Chapter>,
}

/// What belongs together: the same subjects, sampled in different ways.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Chapter {
    /// Its heading.
    pub title: String,
    /// What to look for.
    pub about: String,
    /// What is sampled.
    pub subjects: Vec<Subject>,
    /// Pictures of one subject in a row; rows of the same title stand together.
    pub series: Vec<Series>,
}

/// A picture that is known, and what it is of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Subject {
    /// A function's name, or a scene's.
    pub name: String,
    /// How it is sampled.
    pub about: String,
    /// What it is known by: `exact means`, or the reference's method.
    pub exact: String,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Upper left corner of the part that is shown magnified.
    pub detail: [u32; 2],
}

/// One subject under rising numbers of samples.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// Its heading: a pattern, or the subject.
    pub title: String,
    /// Which of the chapter's subjects, from 0.
    pub subject: usize,
    /// From left to right, after the exact one.
    pub pictures: Vec<SampledPicture>,
}

/// A picture of pixel means.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SampledPicture {
    /// The pattern with the parameters that differ from its defaults.
    pub pattern: String,
    /// `fresh` for another set a pixel, `fixed` for the same set in each.
    pub sets: String,
    /// Samples a pixel.
    pub spp: u32,
    /// Root mean square error of linear values over the subject's pixels; 1 is full scale.
    pub rms: f64,
}

impl SampledPicture {
    /// The same error in dB below full scale; infinite for none.
    #[must_use]
    pub fn psnr_db(&self) -> f64 {
        -20.0 * self.rms.log10()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tenth_of_full_scale_is_20_db() {
        let picture = |rms| SampledPicture { pattern: "r2".into(), sets: "fixed".into(), spp: 4, rms };
        assert!((picture(0.1).psnr_db() - 20.0).abs() < 1e-12);
        assert_eq!(picture(0.0).psnr_db(), f64::INFINITY);
    }
}
