//! Point sets measured, as `dejag patterns` prints them with `--json`. Plain values, not scaled.

use serde::{Deserialize, Serialize};

/// One pattern in the table. Means are over the trials.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PatternRow {
    /// The pattern with the parameters that differ from its defaults.
    pub pattern: String,
    /// Points a set.
    pub n: u32,
    /// Sets, each with a seed of its own; 1 for a pattern without a seed.
    pub trials: usize,
    /// Star discrepancy: largest deviation over anchored boxes.
    pub star: f64,
    /// Its standard deviation.
    pub star_sd: f64,
    /// Its root mean square form.
    pub l2: f64,
    /// Its standard deviation.
    pub l2_sd: f64,
    /// Root mean square deviation over all rectangles, averaged over the trials.
    pub stroud: f64,
    /// Root of the mean of its squares over the trials.
    pub stroud_rms: f64,
    /// Its variance over the trials.
    pub stroud_variance: f64,
    /// Root of that.
    pub stroud_sd: f64,
    /// Standard error of `stroud`.
    pub stroud_se: f64,
    /// Steps a side of the lattice that the four above were summed over; absent for the closed form.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lattice: Option<u32>,
    /// The same over the rectangles of the torus, averaged; absent unless asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stroud_torus: Option<f64>,
    /// Distances to nearest neighbours in the square; absent for one point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nearest: Option<NearestFigures>,
    /// Those on the torus.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nearest_torus: Option<NearestFigures>,
    /// Depends on the clock; absent unless asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub timing: Option<PatternTiming>,
}

/// Distances to nearest neighbours, in sides of the square, averaged over the trials.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct NearestFigures {
    /// Of a set's closest two.
    pub smallest: f64,
    /// Over a set's points.
    pub mean: f64,
}

/// What a set costs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PatternTiming {
    /// Milliseconds to make one on one thread: the fastest of the trials, which other threads disturb least.
    pub generate_ms: f64,
}

/// A pattern's power spectrum in figures and curves. Frequencies of figures are relative to the principal one, sqrt(n).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SpectrumRow {
    /// The pattern with the parameters that differ from its defaults.
    pub pattern: String,
    /// Points a set.
    pub n: u32,
    /// Sets that the spectrum is averaged over.
    pub trials: u32,
    /// Mean power below a quarter of the principal frequency.
    pub low_quarter: f64,
    /// Below half of it.
    pub low_half: f64,
    /// Largest power there.
    pub low_largest: f64,
    /// Largest radial mean.
    pub peak: f64,
    /// Where it is.
    pub peak_frequency: f64,
    /// Where the radial mean first exceeds one half; absent if it never does.
    pub onset_frequency: Option<f64>,
    /// Radial variance over squared radial mean, in dB; absent where every ring is even.
    pub anisotropy_db: Option<f64>,
    /// What chance alone leaves of it: -10 log10(trials).
    pub anisotropy_floor_db: f64,
    /// Mean power on the axes.
    pub axis: f64,
    /// At radii of 1, 2, 3, ... cycles a side.
    pub radial_mean: Vec<f64>,
    /// The same; null where there is no power.
    pub radial_anisotropy_db: Vec<Option<f64>>,
}

/// How far a pattern's pixel means are from the exact ones.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct IntegralRow {
    /// What was integrated: a test's name, or a scene's.
    pub test: String,
    /// Which part of it.
    pub part: String,
    /// The pattern with the parameters that differ from its defaults.
    pub pattern: String,
    /// `fresh` for another set a pixel, `shifted` for one set moved anew for each, `fixed` for the same set in each pixel.
    pub sets: String,
    /// By samples a pixel, rising.
    pub errors: Vec<IntegralError>,
    /// Of a straight line through the errors in logarithms of both: -0.5 for random sets. Absent if fewer than two are above 0.
    pub slope: Option<f64>,
}

/// At one number of samples.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct IntegralError {
    /// Samples a pixel.
    pub spp: u32,
    /// Root mean square over pixels; 1 is full scale.
    pub rms: f64,
}

impl IntegralRow {
    /// Least squares in logarithms, over the errors that have one.
    #[must_use]
    pub fn slope_of(errors: &[IntegralError]) -> Option<f64> {
        let logs: Vec<[f64; 2]> = errors.iter().filter(|e| e.rms > 0.0).map(|e| [f64::from(e.spp).ln(), e.rms.ln()]).collect();
        let n = logs.len() as f64;
        let [mean_x, mean_y] = [0, 1].map(|k| logs.iter().map(|p| p[k]).sum::<f64>() / n);
        let (above, below) = logs.iter().fold((0.0, 0.0), |(above, below), [x, y]| {
            (above + (x - mean_x) * (y - mean_y), below + (x - mean_x) * (x - mean_x))
        });
        (below > 0.0).then(|| above / below)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_powers() {
        let errors = |power: f64| [1, 4, 16, 64].map(|spp| IntegralError { spp, rms: 0.3 * f64::from(spp).powf(power) });
        for power in [-0.5, -0.75, -1.5] {
            let slope = IntegralRow::slope_of(&errors(power)).expect("four errors");
            assert!((slope - power).abs() < 1e-12, "{slope}");
        }
        assert_eq!(IntegralRow::slope_of(&errors(-0.5)[..1]), None);
        assert_eq!(IntegralRow::slope_of(&[]), None);
        let one_of_three = [(1, 0.0), (4, 0.1), (16, 0.0)].map(|(spp, rms)| IntegralError { spp, rms });
        assert_eq!(IntegralRow::slope_of(&one_of_three), None);
    }
}
