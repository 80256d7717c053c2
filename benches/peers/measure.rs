//! Figures and their tables.

use std::fmt::Write as _;

use dejag::bench::PassTime;

/// One contestant's figures.
pub(crate) struct Row {
    pub(crate) name: String,
    pub(crate) ms: Vec<f64>,
    /// Share of the pixels that it changed.
    pub(crate) changed: f64,
}

impl Row {
    pub(crate) fn new(name: String) -> Self {
        Self { name, ms: Vec::new(), changed: 0.0 }
    }

    pub(crate) fn median(&self) -> f64 {
        quantile(&self.ms, 0.5)
    }

    /// Whether it is no filter: something that ours are held against.
    pub(crate) fn is_floor(&self) -> bool {
        self.name.contains("copy")
    }
}

/// Between the two nearest where it falls between them.
fn quantile(samples: &[f64], share: f64) -> f64 {
    let mut sorted = samples.to_vec();
    sorted.sort_by(f64::total_cmp);
    let place = share * sorted.len().saturating_sub(1) as f64;
    let (below, above) = (sorted[place.floor() as usize], sorted[place.ceil() as usize]);
    below + place.fract() * (above - below)
}

/// Median, quartiles, and ratios to the crate and to the copy pass.
pub(crate) fn table(rows: &[Row]) -> String {
    let median = |part: &str| rows.iter().find(|row| row.name.starts_with(part)).map_or(f64::NAN, Row::median);
    let (smaa, copy) = (median("smaa crate"), median("copy pass"));
    let mut text =
        format!("{:<28} {:>9} {:>19} {:>9} {:>9} {:>9}\n", "", "median ms", "quartiles", "to crate", "to copy", "changed");
    for row in rows {
        let quartiles = format!("{:.2} to {:.2}", quantile(&row.ms, 0.25), quantile(&row.ms, 0.75));
        let own = row.median();
        let changed = format!("{:.2}%", 100.0 * row.changed);
        let ratios = (own / smaa, own / copy);
        writeln!(text, "{:<28} {own:>9.2} {quartiles:>19} {:>9.3} {:>9.2} {changed:>9}", row.name, ratios.0, ratios.1)
            .expect("a string takes it");
    }
    text
}

/// Medians a pass at a time; a pass that runs more than once counts as the sum of its runs.
pub(crate) fn pass_table(methods: &[(String, Vec<Vec<PassTime>>)]) -> String {
    let mut text = String::from(if methods.is_empty() { "" } else { "a pass at a time, ms\n" });
    for (name, runs) in methods {
        let mut labels: Vec<&str> = Vec::new();
        for pass in runs.iter().flatten() {
            if !labels.contains(&pass.label.as_str()) {
                labels.push(&pass.label);
            }
        }
        let of = |label: &str| {
            let sums: Vec<f64> =
                runs.iter().map(|run| run.iter().filter(|p| p.label == label).map(|p| p.ms).sum::<f64>()).collect();
            quantile(&sums, 0.5)
        };
        let parts: Vec<String> = labels.iter().map(|label| format!("{label} {:.2}", of(label))).collect();
        writeln!(text, "{name:<28} {}", parts.join(", ")).expect("a string takes it");
    }
    text
}
