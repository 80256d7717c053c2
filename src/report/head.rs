//! What every page begins with.

use maud::{Markup, PreEscaped, html};

const STYLE: &str = include_str!("report.css");

/// Title, and the style of all pages with what this one adds to it.
pub(super) fn head(title: &str, style: &str) -> Markup {
    head_with(title, style, &html! {})
}

/// The same with further tags, which hold for all that follows them.
pub(super) fn head_with(title: &str, style: &str, first: &Markup) -> Markup {
    html! {
        head {
            meta charset="utf-8";
            (first)
            meta name="viewport" content="width=device-width, initial-scale=1";
            meta name="color-scheme" content="light dark";
            title { "dejag: " (title) }
            style { (PreEscaped(STYLE)) (PreEscaped(style)) }
        }
    }
}
