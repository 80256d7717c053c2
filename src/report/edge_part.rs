//! Filters on straight edges in the report's page.

use super::lines::{LinePlot, Scale, Series};
use crate::suite::{EdgeCurve, EdgeErrors};
use maud::{Markup, PreEscaped, html};

/// The section with its plot and table.
pub(super) fn section(edges: &EdgeErrors) -> Markup {
    html! {
        section #edges {
            h2 { "Straight edges" }
            p {
                "The filters on straight edges between two greys, against the exact coverage: root mean square error in linear "
                "light, where 1 is the step between the greys, over the pixels that an edge crosses; errors beside it count in. "
                "16 places of the edge within its pixels at each angle. Lower is better."
            }
            p.note {
                "What a filter is given is one sample a pixel. At 0 and 45 degrees it does not tell where in its pixels an edge "
                "lies, so that no filter can do more than guess there."
            }
            @if let Some(svg) = plot(edges).svg_for_a_page("error on straight edges by their angle") {
                div.plot { (PreEscaped(svg)) }
            }
            (table(edges))
        }
    }
}

fn plot(edges: &EdgeErrors) -> LinePlot {
    let series = |curve: &EdgeCurve| Series {
        label: curve.name.clone(),
        baseline: curve.baseline,
        points: edges.degrees.iter().map(|d| f64::from(*d)).zip(curve.rms.iter().copied()).collect(),
    };
    LinePlot {
        x: ("degrees from a vertical edge".into(), Scale::LinearTo(90.0)),
        y: ("RMS error, linear light".into(), Scale::Linear),
        series: edges.curves.iter().map(series).collect(),
    }
}

fn table(edges: &EdgeErrors) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label="Table of straight edges" {
            table {
                caption { "Root mean square error, and the angle where it is largest" }
                thead { tr {
                    th scope="col" { "method" }
                    th scope="col" { "all angles" }
                    th scope="col" { "least" }
                    th scope="col" { "largest" }
                    th scope="col" { "at" div.unit { "degrees" } }
                } }
                tbody { @for curve in &edges.curves { (row(edges, curve)) } }
            }
        }
    }
}

fn row(edges: &EdgeErrors, curve: &EdgeCurve) -> Markup {
    let by_size = |a: &(&f64, &u32), b: &(&f64, &u32)| a.0.total_cmp(b.0);
    let angles = || curve.rms.iter().zip(&edges.degrees);
    html! {
        tr {
            th scope="row" { (curve.name) }
            td { (format!("{:.4}", curve.over_all)) }
            @if let (Some(least), Some(largest)) = (angles().min_by(by_size), angles().max_by(by_size)) {
                td { (format!("{:.4}", least.0)) }
                td { (format!("{:.4}", largest.0)) }
                td { (largest.1) }
            }
        }
    }
}
