//! All that is known of a case beside its pictures: limits, causes, the golden's making, how to accept.

use maud::{Markup, html};

use super::case::{limit, number, value};
use super::files::{CaseFiles, Picture};
use super::is_same;
use crate::report::words::{self, NONE, printable};
use crate::suite::{CheckedCase, ClassFigures, Golden, Knob, PixelFigures};

pub(super) fn facts(case: &CheckedCase, files: &CaseFiles) -> Markup {
    html! {
        (pictures(files))
        @if !case.likely_causes.is_empty() {
            p { "What may explain it:" }
            ul.causes { @for cause in &case.likely_causes { li { (printable(cause)) } } }
        }
        @if !case.pair.knobs.is_empty() { (limits(&case.pair.knobs)) }
        dl.facts {
            @if case.entry != case.id { dt { "entry" } dd { bdi { (printable(&case.entry)) } } }
            @if let Some([expected, actual]) = case.pair.sizes { dt { "size" } dd { (sizes(expected, actual)) } }
            @if let Some(pixels) = &case.pair.pixels { (places(pixels)) }
            @if let Some(classes) = &case.pair.classes { (objects(classes)) }
            @match &case.golden {
                Some(golden) => { (made(golden)) }
                None => { dt { "golden" } dd { "none was found" } }
            }
            @if !is_same(case) { (accept(case)) }
        }
    }
}

/// Links to what can be seen in full, and words for what cannot.
fn pictures(files: &CaseFiles) -> Markup {
    let sides = [("expected", &files.expected), ("actual", &files.actual), ("heat map", &files.heat)];
    html! {
        @for (name, picture) in sides {
            @match picture {
                Picture::Unreadable(why) => { p.failed { "The " (name) " picture cannot be shown: " (printable(why)) } }
                Picture::Absent if name != "heat map" => { p.note { "The " (name) " picture is not at hand." } }
                _ => {}
            }
        }
        @if sides.iter().any(|(_, picture)| picture.full().is_some()) {
            p.note.full {
                "In full: "
                @for (name, file) in sides.iter().filter_map(|(name, picture)| Some((name, picture.full()?))) { a href=(file) { (name) } " " }
            }
        }
    }
}

fn limits(knobs: &[Knob]) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label="Limits" {
            table {
                thead { tr {
                    th scope="col" { "option" } th scope="col" { "metric" } th scope="col" { "value" } th scope="col" { "limit" }
                    th scope="col" { "verdict" } th scope="col" { "passes at" }
                } }
                tbody { @for knob in knobs { (limit_row(knob)) } }
            }
        }
    }
}

fn limit_row(knob: &Knob) -> Markup {
    let (word, class) = match knob.met {
        Some(true) => ("met", "well"),
        Some(false) => ("missed", "bad"),
        None => ("no limit", ""),
    };
    html! {
        tr {
            th scope="row" { code { (printable(&knob.option)) } }
            td { (printable(&knob.metric)) }
            td title=[words::explanation(knob.value)] { (value(knob)) }
            td { (limit(knob)) }
            td class=(class) { (word) }
            td { (knob.passes_at.map_or(NONE.into(), |at| at.to_string())) }
        }
    }
}

fn sizes(expected: [u32; 2], actual: [u32; 2]) -> String {
    let word = |[width, height]: [u32; 2]| format!("{width}x{height}");
    if expected == actual { word(actual) } else { format!("expected {}, actual {}", word(expected), word(actual)) }
}

fn places(pixels: &PixelFigures) -> Markup {
    html! {
        dt { "pixels" } dd { (pixels.differing) " of " (pixels.compared) " differ by more than the tolerance" }
        @if let Some(bounds) = pixels.bounds { dt { "all within" } dd { (place(bounds)) } }
        @if let Some(worst) = &pixels.worst {
            dt { "worst" }
            dd {
                "at " (worst.at[0]) "," (worst.at[1]) ": expected (" (channels(&worst.expected)) "), actual (" (channels(&worst.actual)) ")"
            }
        }
    }
}

fn place([x, y, width, height]: [u32; 4]) -> String {
    format!("{width}x{height} at {x},{y}")
}

fn channels(values: &[Option<f64>]) -> String {
    let words: Vec<String> = values.iter().map(|value| value.map_or("not finite".into(), number)).collect();
    words.join(", ")
}

fn objects(classes: &ClassFigures) -> Markup {
    html! {
        dt { "of these" }
        dd {
            (classes.edge_pixels) " on resampled edges, " (classes.object_pixels) " in " (classes.object_count)
            (if classes.object_count == 1 { " changed object" } else { " changed objects" })
            @for (i, object) in classes.largest_objects.iter().enumerate() {
                (if i == 0 { ", the largest: " } else { "; " }) (place(object.bounds)) " (" (object.pixels) ")"
            }
        }
    }
}

fn made(golden: &Golden) -> Markup {
    html! {
        dt { "golden of" } dd { bdi { (printable(&golden.environment)) } }
        @for (key, value) in &golden.provenance { dt { (printable(key)) } dd { (printable(value)) } }
    }
}

fn accept(case: &CheckedCase) -> Markup {
    // What looks like an option would be taken for one.
    let guard = case.id.starts_with('-').then(|| "--".to_owned());
    let arguments: Vec<String> = ["bless".to_owned()].into_iter().chain(guard).chain([case.id.clone()]).collect();
    let line = words::shell_line("dejag", &arguments);
    html! {
        dt { "to accept" }
        dd {
            @if line == printable(&line) { code.command { (line) } }
            @else { "its id holds control characters, which no command line should; rename it" }
        }
        dt { "which writes" } dd { code { (printable(&case.blessed_as)) } }
    }
}
