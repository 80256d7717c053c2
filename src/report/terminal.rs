//! Results as a table for a terminal of 100 columns.

use super::words::{self, figure, printable, score, shorten, three_digits, wrap};
use crate::suite::{MethodResult, Outcome, Results, SceneResult, Timing};

mod check;
mod diff;
mod grid;
mod ink;
mod patterns;
mod probes;
mod sequence;

pub use check::{check_summary, check_text};
pub use diff::{diff_summary, diff_text};
use grid::Grid;
use ink::Ink;
pub use patterns::{integral_table, pattern_table, spectrum_table};
pub use sequence::sequence_table;

/// The width that every line keeps to, in characters.
pub const TABLE_WIDTH: usize = 100;

const HEADINGS: [&str; 13] =
    ["method", "draw", "passes", "total", "±", "spp", "MB", "PSNR", "linear", "SSIM", "FLIP", "p99", "max"];

const LEGEND: &str = "★ no other method of the scene beats it in time and error (mean FLIP). draw, passes, total: \
    milliseconds, each a median of its own, so they need not add up; ±: half the range of the total. spp: samples shaded a \
    pixel. MB: bytes of all targets. PSNR, linear (PSNR of linear values): dB. FLIP: mean; p99: 99th percentile. \
    max: largest error in 1/255. Softness that the reference's filter does not have counts as error.";

/// A block for each scene, a line for each method. No line is longer than [`TABLE_WIDTH`] characters; a method whose name does
/// not fit stands on a line of its own, above its figures. With `color`, ANSI escapes mark what matters.
#[must_use]
pub fn table(results: &Results, color: bool) -> String {
    let ink = Ink { color };
    let mut lines = Vec::new();
    for scene in &results.scenes {
        title(scene, results.size, &ink, &mut lines);
        block(scene, &ink, &mut lines);
        lines.push(String::new());
    }
    lines.extend(wrap(LEGEND, TABLE_WIDTH).iter().map(|line| ink.dim(line)));
    lines.extend(wrap(&words::stamp(&results.stamp), TABLE_WIDTH).iter().map(|line| ink.dim(line)));
    lines.join("\n") + "\n"
}

fn title(scene: &SceneResult, [width, height]: [u32; 2], ink: &Ink, lines: &mut Vec<String>) {
    let name = shorten(&printable(&scene.name), TABLE_WIDTH - 40);
    lines.push(ink.bold(&format!("{name} · {width}x{height}, frame {}", scene.frame)));
    lines.extend(wrap(&printable(&scene.about), TABLE_WIDTH));
    lines.extend(wrap(&words::reference(&scene.reference), TABLE_WIDTH).iter().map(|line| ink.dim(line)));
}

/// The scene's table. What spans its columns (long names, errors, notes) goes between its lines.
fn block(scene: &SceneResult, ink: &Ink, lines: &mut Vec<String>) {
    let scored = scene.methods.iter().filter_map(|method| Some((name(method)?, figures(method)?.to_vec())));
    let grid = Grid::new(&HEADINGS, &scored.collect::<Vec<_>>());
    lines.extend(grid.heading.iter().map(|line| ink.dim(line)));
    let mut laid_out = grid.lines.into_iter();
    for method in &scene.methods {
        push_method(method, grid.room, &mut laid_out, ink, lines);
    }
}

fn push_method(
    method: &MethodResult,
    room: usize,
    laid_out: &mut impl Iterator<Item = String>,
    ink: &Ink,
    lines: &mut Vec<String>,
) {
    match &method.outcome {
        Outcome::Scored { timing, non_finite, .. } => {
            let marked = |line: &str| if timing.unbeaten { ink.green(line) } else { line.to_string() };
            lines
                .extend(name(method).filter(|name| name.chars().count() > room).map(|name| marked(&shorten(&name, TABLE_WIDTH))));
            lines.extend(laid_out.next().map(|line| marked(&line)));
            if let Some(found) = non_finite {
                let [x, y] = found.first;
                let note = format!("    {} pixels are NaN or infinite, the first in column {x}, row {y}", found.pixels);
                lines.push(ink.yellow(&note));
            }
        }
        Outcome::Failed { error } => {
            lines.push(ink.red(&shorten(&format!("✗ {}", printable(&method.spec)), TABLE_WIDTH)));
            let text = format!("failed: {}", printable(error));
            lines.extend(wrap(&text, TABLE_WIDTH - 4).iter().map(|line| ink.red(&format!("    {line}"))));
        }
    }
}

fn star(timing: &Timing) -> &'static str {
    if timing.unbeaten { "★ " } else { "  " }
}

/// The method with its mark; none if it has no figures.
fn name(method: &MethodResult) -> Option<String> {
    let Outcome::Scored { timing, .. } = &method.outcome else {
        return None;
    };
    Some(format!("{}{}", star(timing), printable(&method.spec)))
}

/// The figures of a line, after the method.
fn figures(method: &MethodResult) -> Option<[String; 12]> {
    let Outcome::Scored { samples_per_pixel, target_bytes, timing, .. } = &method.outcome else {
        return None;
    };
    let passes: f64 = timing.passes.iter().map(|pass| pass.ms.median).sum();
    let scored = |metric: &str| figure(metric, score(&method.outcome, metric));
    Some([
        three_digits(timing.draw_ms.median),
        if timing.passes.is_empty() { words::NONE.into() } else { three_digits(passes) },
        three_digits(timing.total_ms.median),
        words::spread_percent(&timing.total_ms),
        words::samples(*samples_per_pixel),
        words::megabytes(*target_bytes),
        scored("psnr"),
        scored("psnr-linear"),
        scored("ssim"),
        scored("flip"),
        scored("flip-p99"),
        scored("max-error"),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

    #[test]
    fn every_line_fits_whatever_the_names() {
        let mut results = sample::results(12);
        let long = "ssaa:spp=2500,pattern=rotated-grid,filter=blackman-harris,radius=1.5+cmaa2:quality=ultra,extra=".repeat(3);
        results.scenes[0].methods[2].spec = long.clone();
        results.scenes[0].reference.spec = long.clone();
        results.scenes[0].name = long.clone();
        results.scenes[0].about = "An explanation that goes on. ".repeat(9);
        results.scenes[0].methods[3].outcome = Outcome::Failed { error: format!("it needs {long} and more of it") };
        let text = table(&results, false);
        for line in text.lines() {
            assert!(line.chars().count() <= TABLE_WIDTH, "{} characters: {line}", line.chars().count());
        }
        assert!(!text.contains('\u{1b}'));
    }

    #[test]
    fn marks_words_and_failures_are_shown() {
        let text = table(&sample::results(6), false);
        let line =
            |start: &str| text.lines().find(|line| line.starts_with(start)).unwrap_or_else(|| panic!("no {start} in\n{text}"));
        assert!(line("★ none").contains("24.10"));
        assert!(line("✗ msaa:samples=16").len() > 5 && text.contains("failed: this adapter has 1 and 4 samples, not 16"));
        assert!(text.contains("inf") && text.contains("NaN"));
        assert!(text.contains("3 pixels are NaN or infinite, the first in column 4, row 2"));
        assert!(text.contains("reference ssaa:spp=2500 · noise floor RMS 1.2e-4, max 3.1e-3"));
    }

    #[test]
    fn colour_only_adds_escapes() {
        let results = sample::results(6);
        let mut plain = table(&results, true);
        for code in [0, 1, 2, 31, 32, 33] {
            plain = plain.replace(&format!("\u{1b}[{code}m"), "");
        }
        assert_eq!(plain, table(&results, false));
    }

    #[test]
    fn a_name_cannot_move_the_cursor() {
        let mut results = sample::results(2);
        results.scenes[0].name = "a\u{1b}[2Jb\nc".into();
        assert!(!table(&results, false).contains('\u{1b}'));
    }
}
