//! One scene in the report's page: facts, plot, table, and the pictures to compare.

use super::html::{MethodFiles, SceneFiles};
use super::labels::Labels;
use super::page::{figure, star, value_cell};
use super::points;
use super::words::{self, NONE, score, three_digits};
use crate::metrics::METRICS;
use crate::suite::{MethodResult, Outcome, PassTiming, SceneResult, Spread, Timing};
use maud::{Markup, html};

/// The part of the scene of that number, from 1.
pub(super) fn section(number: usize, scene: &SceneResult, files: &SceneFiles, size: [u32; 2], labels: &Labels) -> Markup {
    html! {
        section #{ "scene-" (number) } {
            h2 { (scene.name) }
            p { (scene.about) }
            p.note { "Frame " (scene.frame) ". " (sentence(&words::reference(&scene.reference))) }
            (figure(&points::of_scene(scene, labels)))
            (table(scene, labels))
            (viewer(scene, files, size, labels))
        }
    }
}

/// A line of words as a sentence.
fn sentence(line: &str) -> String {
    let mut characters = line.chars();
    let first = characters.next().map(|c| c.to_uppercase().to_string()).unwrap_or_default();
    format!("{first}{}.", characters.as_str())
}

fn table(scene: &SceneResult, labels: &Labels) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label={ "Table of " (scene.name) } {
            table {
                caption {
                    "Times are medians, with their range; ★ marks what no other beats in both time and mean FLIP"
                }
                thead { tr {
                    th scope="col" { "method" }
                    th scope="col" title="the scene's own draws, milliseconds" { "draw" div.unit { "ms" } }
                    th scope="col" title="the method's passes, milliseconds" { "passes" div.unit { "ms" } }
                    th scope="col" title="draws and passes, milliseconds" { "total" div.unit { "ms" } }
                    th scope="col" title="samples shaded a pixel" { "spp" }
                    th scope="col" title="10^6 bytes of all targets" { "MB" }
                    @for metric in METRICS {
                        th scope="col" title={ (metric.summary) "; " (metric.better.as_str()) " is better; " (metric.id) } {
                            (metric.name)
                            @if !metric.unit.is_empty() { div.unit { (metric.unit) } }
                        }
                    }
                } }
                tbody { @for method in &scene.methods { (row(method, labels)) } }
            }
        }
    }
}

fn row(method: &MethodResult, labels: &Labels) -> Markup {
    let label = labels.get(&method.spec);
    match &method.outcome {
        Outcome::Scored { samples_per_pixel, target_bytes, timing, non_finite, .. } => html! {
            tr.unbeaten[timing.unbeaten] {
                th scope="row" {
                    (star(timing.unbeaten)) (label)
                    @if label != method.spec { div.spec { (method.spec) } }
                    @if let Some(found) = non_finite {
                        div.failed {
                            (found.pixels) " pixels are NaN or infinite, the first in column " (found.first[0])
                            ", row " (found.first[1])
                        }
                    }
                }
                (times(timing))
                td { (words::samples(*samples_per_pixel)) }
                td { (words::megabytes(*target_bytes)) }
                @for metric in METRICS { (value_cell(metric.name, score(&method.outcome, metric.name))) }
            }
        },
        Outcome::Failed { error } => html! {
            tr {
                th scope="row" { (label) @if label != method.spec { div.spec { (method.spec) } } }
                td.failed colspan=(5 + METRICS.len()) { "failed: " (error) }
            }
        },
    }
}

fn times(timing: &Timing) -> Markup {
    let passes: f64 = timing.passes.iter().map(|pass| pass.ms.median).sum();
    html! {
        td { (three_digits(timing.draw_ms.median)) (range(&timing.draw_ms)) }
        td {
            @if timing.passes.is_empty() { (NONE) } @else { (three_digits(passes)) }
            @for pass in &timing.passes { (pass_time(pass)) }
        }
        td title=(timing.clock) { (three_digits(timing.total_ms.median)) (range(&timing.total_ms)) }
    }
}

fn pass_time(pass: &PassTiming) -> Markup {
    html! {
        div.range { (pass.pass) @if pass.runs != 1 { " ×" (pass.runs) } " " (three_digits(pass.ms.median)) }
    }
}

fn range(spread: &Spread) -> Markup {
    html! { div.range { (three_digits(spread.min)) " – " (three_digits(spread.max)) } }
}

const ERROR_CAPTION: &str = "FLIP error map: black 0, pale yellow 1, green not finite";

/// The pictures of the scene. The script makes it move; without it the first method is seen beside its reference.
fn viewer(scene: &SceneResult, files: &SceneFiles, size: [u32; 2], labels: &Labels) -> Markup {
    let shown: Vec<(&MethodResult, &MethodFiles)> =
        scene.methods.iter().filter_map(|method| Some((method, files.method(&method.spec)?))).collect();
    let Some((_, first)) = shown.first() else {
        return html! { p.note { "No method made a picture of this scene." } };
    };
    html! {
        div.viewer data-width=(size[0]) data-height=(size[1]) {
            h3 { "Pictures" }
            div.strip role="group" aria-label="Method to compare" {
                @for (method, files) in &shown { (choice(method, files, labels)) }
            }
            (toolbar())
            div.panes data-mode="side" {
                (pane("capture", "capture", &[&first.capture], size))
                (pane("reference", "reference", &[&files.reference], size))
                (pane("error", ERROR_CAPTION, &[first.error_map.as_deref().unwrap_or("")], size))
                (pane("slider", "left: capture, right: reference", &[&first.capture, &files.reference], size))
            }
            label.split {
                span { "capture" }
                input type="range" min="0" max="100" step="0.5" value="50" aria-label="Share of the capture, percent";
                span { "reference" }
            }
            p.keys {
                "Drag to move, double-click or " kbd { "+" } " " kbd { "−" } " to zoom, click a picture and use the wheel, "
                "arrows to move, " kbd { "0" } " fits, " kbd { "1" } " is one to one, "
                kbd { "space" } " flips between capture and reference."
            }
        }
    }
}

fn choice(method: &MethodResult, files: &MethodFiles, labels: &Labels) -> Markup {
    let label = labels.get(&method.spec);
    let flip = words::figure("flip", score(&method.outcome, "flip"));
    html! {
        button type="button" aria-pressed="false" title=(method.spec) data-label=(label)
            data-capture=(files.capture) data-error=(files.error_map.as_deref().unwrap_or("")) {
            img src=(files.capture) alt="" loading="lazy";
            span.name { (label) }
            span.flip { "FLIP " (flip) }
        }
    }
}

fn toolbar() -> Markup {
    let modes = [("side", "Side by side"), ("slider", "Slider"), ("error", "Error map")];
    let zooms = [
        ("out", "−", "Zoom out"),
        ("in", "+", "Zoom in"),
        ("one", "1:1", "One picture pixel a screen pixel"),
        ("fit", "Fit", "Fit the whole picture"),
    ];
    html! {
        div.toolbar {
            div.group role="group" aria-label="View" {
                @for (mode, name) in modes { button type="button" data-mode=(mode) aria-pressed=(mode == "side") { (name) } }
            }
            div.group role="group" aria-label="Zoom" {
                @for (zoom, name, title) in zooms {
                    button type="button" data-zoom=(zoom) title=(title) aria-label=(title) { (name) }
                }
            }
            output {}
        }
    }
}

/// A window onto one picture, or onto two of which the second covers the right part.
fn pane(kind: &str, caption: &str, pictures: &[&str], [width, height]: [u32; 2]) -> Markup {
    html! {
        figure data-pane=(kind) {
            div.window tabindex="0" role="group" aria-label=(caption) style={ "aspect-ratio: " (width) " / " (height) } {
                @for picture in pictures {
                    div.layer {
                        @if !picture.is_empty() { img src=(picture) alt="" width=(width) height=(height) draggable="false"; }
                    }
                }
                @if pictures.len() > 1 { div.divider aria-hidden="true" {} }
            }
            figcaption { (caption) }
        }
    }
}
