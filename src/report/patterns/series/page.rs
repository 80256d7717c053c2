//! The page: for each chapter a table of errors, then the pictures.

use maud::{DOCTYPE, Markup, html};

use super::{DETAIL_PX, SeriesPicture};
use crate::report::head::head;
use crate::report::words::{self, NONE};
use crate::suite::{Chapter, SampledPicture, Series, SeriesResults, Subject};

const SERIES_STYLE: &str = include_str!("series.css");

/// How much larger details are shown.
const MAGNIFIED: u32 = 4;

/// The whole page, with its style in it: it loads nothing but the pictures beside it.
pub(super) fn page(results: &SeriesResults) -> String {
    html! {
        (DOCTYPE)
        html lang="en" {
            (head("sampling patterns", SERIES_STYLE))
            body {
                a.skip href="#chapter-0" { "Skip to the results" }
                header {
                    h1 { "dejag" span.light { " where to sample" } }
                    p.stamp { (words::stamp(&results.stamp)) }
                    nav aria-label="Chapters" {
                        @for (number, chapter) in results.chapters.iter().enumerate() {
                            a href={ "#chapter-" (number) } { (chapter.title) }
                        }
                        a href="#again" { "Run it again" }
                    }
                }
                main {
                    @for (number, chapter) in results.chapters.iter().enumerate() { (section(number, chapter)) }
                    (again(results))
                }
            }
        }
    }
    .into_string()
}

fn section(number: usize, chapter: &Chapter) -> Markup {
    html! {
        section id={ "chapter-" (number) } {
            h2 { (chapter.title) }
            p { (chapter.about) }
            p.note {
                "The exact picture comes first. Below each its worst part, " (MAGNIFIED) " times as large. Errors are those of linear values, \
                 root mean square in 1/1000 of full scale, and in dB below it. A picture opens by itself."
            }
            dl.facts {
                @for subject in &chapter.subjects { dt { (subject.name) } dd { (subject.about) "; held against " (subject.exact) } }
            }
            (table(number, chapter))
            @for (place, series) in chapter.series.iter().enumerate() {
                @if first_of_its_title(chapter, place) { h3 id=(anchor(number, place)) { (series.title) } }
                (strip(number, chapter, place))
            }
        }
    }
}

fn first_of_its_title(chapter: &Chapter, place: usize) -> bool {
    place == 0 || chapter.series[place - 1].title != chapter.series[place].title
}

/// Where the pictures of a title begin.
fn anchor(number: usize, place: usize) -> String {
    format!("series-{number}-{place}")
}

fn table(number: usize, chapter: &Chapter) -> Markup {
    let counts: Vec<u32> = chapter.series.first().map(|s| s.pictures.iter().map(|p| p.spp).collect()).unwrap_or_default();
    html! {
        div.scroll tabindex="0" role="region" aria-label={ "Errors: " (chapter.title) } {
            table {
                caption { "RMS error, 1/1000 of full scale, by samples a pixel" }
                thead { tr {
                    th scope="col" { "pattern" }
                    th.of scope="col" { "of" }
                    @for spp in &counts { th scope="col" { (spp) } }
                } }
                tbody {
                    @for (place, series) in chapter.series.iter().enumerate() {
                        tr {
                            th scope="row" {
                                @if first_of_its_title(chapter, place) { a href={ "#" (anchor(number, place)) } { (series.title) } }
                                @else { span.hidden { (series.title) } }
                            }
                            td.of { (subject_of(chapter, series).map_or(NONE, |subject| subject.name.as_str())) }
                            @for picture in &series.pictures { td { (thousandths(picture)) } }
                        }
                    }
                }
            }
        }
    }
}

fn subject_of<'c>(chapter: &'c Chapter, series: &Series) -> Option<&'c Subject> {
    chapter.subjects.get(series.subject)
}

fn strip(number: usize, chapter: &Chapter, place: usize) -> Markup {
    let series = &chapter.series[place];
    let Some(subject) = subject_of(chapter, series) else { return html! {} };
    let exact = SeriesPicture::Exact { subject: series.subject }.file(number);
    html! {
        div.series tabindex="0" role="region" aria-label={ (series.title) ", " (subject.name) } {
            (figure(&exact, subject, &format!("{}: {}", subject.name, subject.exact)))
            @for (k, picture) in series.pictures.iter().enumerate() {
                @let file = SeriesPicture::Sampled { series: place, picture: k }.file(number);
                (figure(&file, subject, &caption(picture)))
            }
        }
    }
}

fn caption(picture: &SampledPicture) -> String {
    let SampledPicture { pattern, sets, spp, .. } = picture;
    format!("{pattern}, {sets}, {spp} a pixel: RMS {}, {:.1} dB", thousandths(picture), picture.psnr_db())
}

fn thousandths(picture: &SampledPicture) -> String {
    format!("{:.1}", 1e3 * picture.rms)
}

/// A picture, and below it its detail.
fn figure(file: &str, subject: &Subject, caption: &str) -> Markup {
    let [width, height] = subject.size;
    let shown = [width, height].map(|side| MAGNIFIED * side.min(DETAIL_PX));
    let [left, top] = subject.detail.map(|at| MAGNIFIED * at);
    html! {
        figure {
            a href=(file) { img src=(file) width=(width) height=(height) loading="lazy" alt=(caption); }
            div.detail style={ "width:" (shown[0]) "px;height:" (shown[1]) "px" } {
                img src=(file) width=(MAGNIFIED * width) height=(MAGNIFIED * height) loading="lazy"
                    style={ "left:-" (left) "px;top:-" (top) "px" } alt={ "detail of " (caption) };
            }
            figcaption { (caption) }
        }
    }
}

fn again(results: &SeriesResults) -> Markup {
    html! {
        section #again {
            h2 { "Run it again" }
            p { "The same command on the same adapter and driver gives the same bytes:" }
            pre tabindex="0" { code { (words::shell_line("dejag", &results.command)) } }
            p { "All figures: " a href="results.json" { "results.json" } "." }
        }
    }
}
