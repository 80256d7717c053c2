//! Spectra: what periodograms look like, and their radial curves below.

use maud::{PreEscaped, html};

use super::Panels;
use crate::report::lines::{LinePlot, Scale, Series};
use crate::suite::SpectrumRow;

/// Range of the plot of anisotropies in dB: from below what a thousand sets leave to above what a grid has.
const ANISOTROPY_DB: (f64, f64) = (-32.0, 24.0);

/// Periodograms in a row, radial means and anisotropies below, one line a pattern. A plot that would be empty is left out, as that of
/// anisotropies is where every ring is even.
#[must_use]
pub fn spectrum_svg(periodograms: &Panels, rows: &[SpectrumRow]) -> String {
    let over_frequency = |title: &str, y: Scale, values: &dyn Fn(&SpectrumRow) -> Vec<Option<f64>>| LinePlot {
        x: ("frequency / sqrt(n)".into(), Scale::Linear),
        y: (title.into(), y),
        series: rows.iter().map(|row| curve(row, &values(row))).collect(),
    };
    let means = over_frequency("radial mean power", Scale::Linear, &|row| row.radial_mean.iter().copied().map(Some).collect());
    let (low, high) = ANISOTROPY_DB;
    let anisotropies = over_frequency("anisotropy in dB", Scale::Between(low, high), &|row| row.radial_anisotropy_db.clone());
    let plots = [means, anisotropies].into_iter().filter_map(|plot| Some((plot.svg()?, plot.size())));
    let parts: Vec<(String, [u32; 2])> = std::iter::once((periodograms.svg(), periodograms.svg_size())).chain(plots).collect();
    stacked(&parts)
}

fn curve(row: &SpectrumRow, values: &[Option<f64>]) -> Series {
    let frequency = |radius: u32| f64::from(radius) / f64::from(row.n).sqrt();
    let points = (1..).zip(values).filter_map(|(radius, value)| Some((frequency(radius), (*value)?)));
    Series { label: row.pattern.clone(), baseline: false, points: points.collect() }
}

/// One drawing below the other.
fn stacked(parts: &[(String, [u32; 2])]) -> String {
    let width = parts.iter().map(|(_, size)| size[0]).max().unwrap_or(0);
    let height: u32 = parts.iter().map(|(_, size)| size[1]).sum();
    let mut top = 0;
    let mut inner = String::new();
    for (drawing, [_, own]) in parts {
        inner += &drawing.replacen("<svg ", &format!("<svg y=\"{top}\" "), 1);
        top += own;
    }
    let drawing = html! {
        svg xmlns="http://www.w3.org/2000/svg" width=(width) height=(height) viewBox=(format!("0 0 {width} {height}")) {
            rect width=(width) height=(height) fill="white" {}
            (PreEscaped(inner))
        }
    };
    drawing.into_string()
}
