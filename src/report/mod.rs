//! Results shown: a table for the terminal, JSON, JUnit XML and GitHub's annotations for programs, a folder with a page for people.

mod axis;
mod check;
mod edge_part;
mod folder;
mod frame;
mod frames_folder;
mod github;
mod head;
mod html;
mod junit;
mod labels;
mod lines;
mod page;
mod pair_words;
mod patterns;
mod placement;
mod plot;
mod points;
#[cfg(test)]
mod sample;
mod scene_part;
mod sequence;
mod terminal;
#[cfg(test)]
mod tests;
mod words;

pub use check::{CasePictures, CheckReport};
pub use frames_folder::FramesFolder;
pub use github::{annotations, job_summary};
pub use html::{HtmlReport, MethodPictures, ReportInput, ScenePictures, write_html};
pub use junit::{check_junit, diff_junit};
pub use lines::{LinePlot, Scale, Series};
pub use patterns::{DETAIL_PX, Panel, Panels, SeriesPicture, SeriesReport, deviation_map, integral_csv, power_map, spectrum_svg};
pub use sequence::{SequenceReport, Shown, strip_places};
pub use terminal::{
    TABLE_WIDTH, check_summary, check_text, diff_summary, diff_text, integral_table, pattern_table, sequence_table,
    spectrum_table, table,
};

use serde::Serialize;

/// Results as JSON, indented, its keys always in the same order, with a line feed at the end.
#[must_use]
pub fn json(results: &impl Serialize) -> String {
    let text = serde_json::to_string_pretty(results).expect("results have string keys and cannot fail to serialise");
    text + "\n"
}
