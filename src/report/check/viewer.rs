//! What a case opens into, empty until the script fills it, and the list of keys.

use maud::{Markup, html};

/// The page's script: parts that share one scope, none of which reaches the page's.
pub(super) const SCRIPT: &str = concat!(
    "(() => {\n\"use strict\";\n\n",
    include_str!("js/png.js"),
    "\n",
    include_str!("js/pixels.js"),
    "\n",
    include_str!("js/window.js"),
    "\n",
    include_str!("js/viewer.js"),
    "\n",
    include_str!("js/list.js"),
    "})();\n"
);

const VIEWS: [(&str, &str); 6] = [
    ("side", "Side by side"),
    ("slider", "Slider"),
    ("flip", "Flip"),
    ("blink", "Blink"),
    ("difference", "Difference"),
    ("heat", "Heat map"),
];

const ZOOMS: [(&str, &str, &str); 5] = [
    ("out", "−", "Zoom out"),
    ("in", "+", "Zoom in"),
    ("one", "1:1", "One picture pixel a screen pixel"),
    ("fit", "Fit", "Fit the whole picture"),
    ("worst", "Worst", "Go to the pixel that differs most"),
];

const KEYS: [(&[&str], &str); 11] = [
    (&["j", "k"], "next and previous case, in the list and in an opened case; in the list ↓ and ↑ too"),
    (&["Enter"], "open the case"),
    (&["Esc"], "close it"),
    (&["1", "…", "6"], "side by side, slider, flip, blink, difference, heat map"),
    (&["Space"], "flip; start and stop blinking"),
    (&["+", "-", "0"], "zoom in, zoom out, fit"),
    (&["←", "→", "↑", "↓"], "move the picture; on the slider move it"),
    (&["Shift", "←", "→", "↑", "↓"], "move the crosshair by a pixel"),
    (&["w"], "go to the pixel that differs most"),
    (&["/"], "find by id"),
    (&["?"], "this list"),
];

pub(super) fn dialogs() -> Markup {
    html! {
        dialog #viewer data-view="side" aria-labelledby="title" {
            (heading())
            (toolbar())
            (panes())
            p #values.values role="status" aria-live="off" {}
            p #said.hidden role="status" {}
            div #facts {}
        }
        dialog #help aria-labelledby="help-title" {
            h2 #help-title { "Keys" }
            dl.facts { @for (keys, what) in KEYS { dt { @for key in keys { kbd { (key) } " " } } dd { (what) } } }
            p.note { "A wheel over the picture zooms, dragging moves it, a double click zooms in. Keys rest while you type." }
            form method="dialog" { button { "Close" } }
        }
    }
}

fn heading() -> Markup {
    html! {
        div.heading {
            h2 #title { span #outcome.outcome {} " " bdi #name {} }
            div.group {
                button #previous type="button" title="Previous case (k)" { "←" span.hidden { " previous case" } }
                button #next type="button" title="Next case (j)" { span.hidden { "next case " } "→" }
                button #close type="button" title="Close (Esc)" { "Close" }
            }
        }
    }
}

fn toolbar() -> Markup {
    html! {
        div.toolbar {
            div.group role="group" aria-label="View" {
                @for (number, (view, name)) in (1..).zip(VIEWS) {
                    button type="button" data-view=(view) aria-pressed=(number == 1) title={ (name) " (" (number) ")" } { (name) }
                }
            }
            div.group role="group" aria-label="Zoom" {
                @for (zoom, name, title) in ZOOMS { button type="button" data-zoom=(zoom) title=(title) aria-label=(title) { (name) } }
            }
            label #split-control { "expected " input #split type="range" min="0" max="100" step="0.5" value="50" aria-label="Share of the expected picture, percent"; " actual" }
            button #flip type="button" { "Flip" }
            button #blink type="button" aria-pressed="false" { "Blink" }
            label #gain-control { "Amplified " select #gain { @for gain in [1, 4, 16, 64] { option value=(gain) { (gain) "×" } } } }
        }
    }
}

/// The second window is seen side by side only; in the other views the first holds every picture.
fn panes() -> Markup {
    let pane = |id: &str, inside: Markup| {
        html! {
            figure {
                div.window id=(id) tabindex="0" role="group" {
                    (inside)
                    div.cross hidden {}
                }
                figcaption {}
            }
        }
    };
    let layers = html! {
        div.layer { canvas #expected {} }
        div.layer #over { canvas #actual {} }
        div.layer { canvas #difference {} img #heat alt=""; }
        div.divider aria-hidden="true" {}
    };
    html! { div #panes.panes data-view="side" data-shown="expected" { (pane("one", layers)) (pane("two", html! {})) } }
}
