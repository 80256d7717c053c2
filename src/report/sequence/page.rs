//! The page of a sequence's report.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::{Shown, StripPicture, curves};
use crate::metrics::Figure;
use crate::metrics::temporal::MEASURES;
use crate::report::head::head;
use crate::report::words::{self, NONE};
use crate::suite::{SequenceFigures, SequenceOutcome, SequenceResult, SequenceResults};

const STRIP_STYLE: &str = include_str!("strip.css");

/// The whole page, with its style in it: it loads nothing but the pictures beside it.
pub(super) fn page(results: &SequenceResults, strip: &[StripPicture]) -> String {
    let result = &results.result;
    let [width, height] = result.size;
    let extent =
        format!("{}, {} frames of {width}x{height}, {} methods", result.scene, result.frames.len(), result.methods.len());
    html! {
        (DOCTYPE)
        html lang="en" {
            (head(&extent, STRIP_STYLE))
            body {
                a.skip href="#figures" { "Skip to the results" }
                header {
                    h1 { "dejag" span.light { " anti-aliasing in motion" } }
                    p.extent { (extent) }
                    p.stamp { (words::stamp(&results.stamp)) }
                    nav aria-label="Parts" {
                        a href="#figures" { "Figures" }
                        a href="#strip" { "Film strip" }
                        a href="#curves" { "Curves" }
                        a href="#again" { "Run it again" }
                    }
                }
                main {
                    (figures(result))
                    (film_strip(result, strip))
                    (curve_section(result))
                    (again(results))
                }
            }
        }
    }
    .into_string()
}

fn figures(result: &SequenceResult) -> Markup {
    html! {
        section #figures {
            h2 { (result.scene) }
            p { (result.about) }
            p.note { "Held against " code { (result.reference.spec) } ", frame by frame." }
            div.scroll tabindex="0" role="region" aria-label="Table of figures" {
                table {
                    caption { "Over all frames; point at a heading for what it means" }
                    thead { tr {
                        th scope="col" { "method" }
                        @for measure in MEASURES { th scope="col" title=(measure.summary) { (measure.name) } }
                        th scope="col" title="frames for which 1/255 is left of a thing where it was" { "trail" }
                    } }
                    tbody { @for method in &result.methods { (row(&method.spec, &method.outcome)) } }
                }
            }
        }
    }
}

fn row(spec: &str, outcome: &SequenceOutcome) -> Markup {
    html! {
        tr {
            th scope="row" { (spec) }
            @match outcome {
                SequenceOutcome::Measured(figures) => { (cells(figures)) }
                SequenceOutcome::Failed { error } => { td.failed colspan=(MEASURES.len() + 1) { "failed: " (error) } }
            }
        }
    }
}

fn cells(figures: &SequenceFigures) -> Markup {
    let overall = |id| figures.figure(id).map(|found| found.overall);
    html! {
        @for measure in MEASURES {
            td {
                @match overall(measure.id) {
                    Some(figure) => { (shown(measure.unit, figure)) }
                    None => { (NONE) }
                }
            }
        }
        td { @match figures.ghost.trail.number() { Some(frames) => { (frames) } None => { (words::figure("", figures.ghost.trail)) } } }
    }
}

fn film_strip(result: &SequenceResult, strip: &[StripPicture]) -> Markup {
    let row = |shown: Shown| strip.iter().filter(move |picture| picture.shown == shown);
    html! {
        section #strip {
            h2 { "Film strip" }
            p.note { "Each method's frames, and under them where they are wrong: FLIP, black 0, pale yellow 1. A picture opens at its full size." }
            div.film tabindex="0" role="region" aria-label="Film strip" {
                (frames("reference", result, row(Shown::Reference)))
                @for (number, method) in result.methods.iter().enumerate() {
                    (frames(&method.spec, result, row(Shown::Capture(number))))
                    (frames(&format!("{}: error", method.spec), result, row(Shown::ErrorMap(number))))
                }
            }
        }
    }
}

fn frames<'p>(label: &str, result: &SequenceResult, pictures: impl Iterator<Item = &'p StripPicture>) -> Markup {
    let [width, height] = result.size;
    html! {
        div.reel {
            div.label { (label) }
            @for picture in pictures {
                @let frame = result.frames.get(picture.place).map_or(0, |frame| frame.index);
                a href=(picture.file) {
                    img src=(picture.file) width=(width) height=(height) loading="lazy" alt={ (label) ", frame " (frame) };
                    span { (frame) }
                }
            }
        }
    }
}

fn curve_section(result: &SequenceResult) -> Markup {
    html! {
        section #curves {
            h2 { "Curves" }
            @for curves in curves::all(result) {
                h3 { (curves.title) }
                p.note { (curves.about) }
                @if let Some(svg) = curves.plot.svg_for_a_page(curves.about) { div.plot { (PreEscaped(svg)) } }
            }
        }
    }
}

fn again(results: &SequenceResults) -> Markup {
    html! {
        section #again {
            h2 { "Run it again" }
            p { "The same command on the same adapter and driver gives the same pictures and figures, but for the times:" }
            pre tabindex="0" { code { (words::shell_line("dejag", &results.command)) } }
            p { "All figures, of each frame: " a href="results.json" { "results.json" } "." }
        }
    }
}

/// Decibels to two digits, everything else to four.
fn shown(unit: &str, figure: Figure) -> String {
    match figure {
        Figure::Number(x) if unit == "dB" => format!("{x:.2}"),
        Figure::Number(x) => format!("{x:.4}"),
        other => words::figure("", other),
    }
}
