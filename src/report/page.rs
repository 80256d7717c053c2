//! The report's page: what all scenes share. A scene's own part is in `scene_part`.

use super::head::head;
use super::html::SceneFiles;
use super::labels::{Labels, distinct};
use super::points::{self, Points};
use super::words::{self, score, three_digits};
use super::{edge_part, plot, scene_part};
use crate::suite::{Results, SceneResult};
use maud::{DOCTYPE, Markup, PreEscaped, html};

const SCRIPT: &str = include_str!("report.js");

/// The whole page, with its style and script in it: it loads nothing but the pictures beside it.
pub(super) fn page(results: &Results, files: &[SceneFiles], labels: &Labels) -> String {
    let methods = distinct(results).len();
    let extent = words::extent(&results.scenes, methods, results.size);
    html! {
        (DOCTYPE)
        html lang="en" {
            (head(&extent, ""))
            body {
                a.skip href="#overview" { "Skip to the results" }
                header {
                    h1 { "dejag" span.light { " anti-aliasing, speed against error" } }
                    p.extent { (extent) }
                    p.stamp { (words::stamp(&results.stamp)) }
                    nav aria-label="Scenes" { (navigation(results)) }
                }
                main {
                    (overview(results, labels))
                    @for (number, (scene, files)) in results.scenes.iter().zip(files).enumerate() {
                        (scene_part::section(number + 1, scene, files, results.size, labels))
                    }
                    @if let Some(edges) = &results.edges { (edge_part::section(edges)) }
                    (again(results))
                }
                script { (PreEscaped(SCRIPT)) }
            }
        }
    }
    .into_string()
}

fn navigation(results: &Results) -> Markup {
    html! {
        a href="#overview" { "All scenes" }
        @for (number, scene) in results.scenes.iter().enumerate() {
            a href={ "#scene-" (number + 1) } { (scene.name) }
        }
        @if results.edges.is_some() { a href="#edges" { "Straight edges" } }
        a href="#again" { "Run it again" }
    }
}

fn overview(results: &Results, labels: &Labels) -> Markup {
    let points = points::over_all(results, labels);
    html! {
        section #overview {
            h2 { "All scenes" }
            p {
                "Each method by the geometric mean of its times and the mean of its FLIP errors. "
                "Lower and further left is better. Those that no other beats in both are filled and joined."
            }
            (figure(&points))
            (overview_table(results, labels, &points))
        }
    }
}

/// A plot with a line about what it does not show.
pub(super) fn figure(points: &Points) -> Markup {
    html! {
        @if let Some(svg) = plot::svg(&points.shown) {
            div.plot { (PreEscaped(svg)) }
        }
        @if !points.omitted.is_empty() {
            p.note { "Not in the plot, for want of a time or an error: " (points.omitted.join(", ")) "." }
        }
    }
}

fn overview_table(results: &Results, labels: &Labels, points: &Points) -> Markup {
    let unbeaten = |label: &String| points.shown.iter().any(|point| point.unbeaten && point.label == *label);
    html! {
        div.scroll tabindex="0" role="region" aria-label="Table of all scenes" {
            table {
                caption { "Mean FLIP error by scene (lower is better)" }
                thead { tr {
                    th scope="col" { "method" }
                    th scope="col" title="geometric mean over the scenes, milliseconds" { "time" div.unit { "ms" } }
                    th scope="col" title="arithmetic mean over the scenes" { "all" }
                    @for scene in &results.scenes { th scope="col" { (scene.name) } }
                } }
                tbody {
                    @for spec in distinct(results) {
                        @let label = labels.get(&spec);
                        tr.unbeaten[unbeaten(&label)] {
                            th scope="row" title=(spec) { (star(unbeaten(&label))) (label) }
                            @match points::means(results, &spec) {
                                Some((time, error)) => { td { (three_digits(time)) } td { (format!("{error:.4}")) } }
                                None => { td { (words::NONE) } td { (words::NONE) } }
                            }
                            @for scene in &results.scenes { (flip_cell(scene, &spec)) }
                        }
                    }
                }
            }
        }
    }
}

fn flip_cell(scene: &SceneResult, spec: &str) -> Markup {
    let method = scene.methods.iter().find(|method| method.spec == spec);
    let failed = method.is_some_and(|method| matches!(method.outcome, crate::suite::Outcome::Failed { .. }));
    html! {
        @match method {
            Some(_) if failed => { td.failed { "failed" } }
            Some(method) => { (value_cell("flip", score(&method.outcome, "flip"))) }
            None => { td { (words::NONE) } }
        }
    }
}

/// A table cell with a metric's figure; words explain themselves.
pub(super) fn value_cell(metric: &str, value: crate::metrics::Figure) -> Markup {
    html! { td title=[words::explanation(value)] { (words::figure(metric, value)) } }
}

/// The mark of a method that no other beats, for eyes and for screen readers.
pub(super) fn star(unbeaten: bool) -> Markup {
    html! { @if unbeaten { span.star title="no other beats it in time and error" { "★" span.hidden { " unbeaten: " } } " " } }
}

fn again(results: &Results) -> Markup {
    let stamp = &results.stamp;
    html! {
        section #again {
            h2 { "Run it again" }
            p { "The same command on the same adapter and driver gives the same pictures and figures, but for the times:" }
            pre tabindex="0" { code { (words::shell_line("dejag", &results.command)) } }
            dl.facts {
                dt { "dejag" } dd { (stamp.dejag) }
                dt { "adapter" } dd { (stamp.adapter) " (" (stamp.kind) ")" }
                dt { "driver" } dd { (stamp.driver) " " (stamp.driver_version) }
                dt { "backend" } dd { (stamp.backend) }
                @for scene in &results.scenes {
                    dt { "reference of " (scene.name) } dd { code { (scene.reference.spec) } }
                }
            }
            p { "All figures, with the versions of the metrics: " a href="results.json" { "results.json" } "." }
        }
    }
}
