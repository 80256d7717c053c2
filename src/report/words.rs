//! Figures and names as people read them; shared by the terminal's table and the page.

use crate::metrics::{Figure, METRICS};
use crate::suite::{NoiseFloor, Outcome, ReferenceResult, SceneResult, Spread, Stamp};

/// What stands where there is no figure.
pub(super) const NONE: &str = "–";

/// A non-negative figure to three digits in at most five characters, such as milliseconds or megabytes.
pub(super) fn three_digits(x: f64) -> String {
    match x {
        _ if !x.is_finite() => NONE.into(),
        0.0 => "0".into(),
        _ if x < 0.000_5 => "<.001".into(),
        _ if x < 0.099_95 => format!("{x:.3}"),
        _ if x < 9.995 => format!("{x:.2}"),
        _ if x < 99.95 => format!("{x:.1}"),
        _ if x < 99_999.5 => format!("{x:.0}"),
        _ => format!("{x:.0e}"),
    }
}

/// Samples a pixel: a whole number as such, else to three digits.
pub(super) fn samples(x: f64) -> String {
    if x.fract() == 0.0 && (0.0..1e5).contains(&x) { format!("{x:.0}") } else { three_digits(x) }
}

/// Bytes as 10^6 bytes.
pub(super) fn megabytes(bytes: u64) -> String {
    three_digits(bytes as f64 / 1e6)
}

/// Half the range of the measurements, in percent of the median.
pub(super) fn spread_percent(spread: &Spread) -> String {
    let percent = 50.0 * (spread.max - spread.min) / spread.median;
    match percent {
        _ if !percent.is_finite() => NONE.into(),
        _ if percent > 999.0 => ">999%".into(),
        _ => format!("{percent:.0}%"),
    }
}

/// A metric's figure with the digits that mean something. An infinite PSNR is that of equal pictures.
pub(super) fn figure(metric: &str, value: Figure) -> String {
    match value {
        Figure::Number(x) => number(metric, x),
        Figure::Infinite => "inf".into(),
        Figure::NonFinite => "NaN".into(),
        Figure::NotApplicable => NONE.into(),
    }
}

/// What [`figure`]'s words mean, for those who point at them.
pub(super) fn explanation(value: Figure) -> Option<&'static str> {
    match value {
        Figure::Number(_) => None,
        Figure::Infinite => Some("infinite: the pictures are equal in what this metric reads"),
        Figure::NonFinite => Some("not a number: a picture has pixels that are NaN or infinite"),
        Figure::NotApplicable => Some("this metric does not apply here"),
    }
}

fn number(metric: &str, x: f64) -> String {
    let digits = match metric {
        "psnr" | "psnr-linear" => 2,
        "max-error" => 1,
        _ => 4,
    };
    if x.abs() < 1e5 { format!("{x:.digits$}") } else { format!("{x:.1e}") }
}

/// The figure of the metric of that name; [`Figure::NotApplicable`] if the results do not have it in the version known here.
pub(super) fn score(outcome: &Outcome, metric: &str) -> Figure {
    let id = METRICS.iter().find(|known| known.name == metric).map(|known| known.id);
    match outcome {
        Outcome::Scored { scores, .. } => {
            let found = scores.iter().find(|score| Some(score.metric.as_str()) == id);
            found.map_or(Figure::NotApplicable, |score| score.value)
        }
        Outcome::Failed { .. } => Figure::NotApplicable,
    }
}

/// What drew the pictures, in a line.
pub(super) fn stamp(stamp: &Stamp) -> String {
    let Stamp { dejag, adapter, kind, driver, driver_version, backend } = stamp;
    printable(&format!("{adapter} ({kind}) · {driver} {driver_version} · {backend} · dejag {dejag}"))
}

/// The reference and how far it can be trusted, in a line.
pub(super) fn reference(reference: &ReferenceResult) -> String {
    let mut parts = vec![format!("reference {}", printable(&reference.spec))];
    parts.extend(reference.noise_floor.as_ref().map(noise_floor));
    let analytic = reference.analytic.as_ref();
    parts.extend(analytic.map(|distance| format!("from exact RMS {:.1e}, max {:.1e}", distance.rms, distance.max)));
    parts.join(" · ")
}

/// The difference of the reference's two halves, in words.
pub(super) fn noise_floor(floor: &NoiseFloor) -> String {
    format!("noise floor RMS {:.1e}, max {:.1e}", floor.rms, floor.max)
}

/// Scenes, methods and size of a run, such as "4 scenes, 6 methods, 320x180".
pub(super) fn extent(scenes: &[SceneResult], methods: usize, [width, height]: [u32; 2]) -> String {
    let plural = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
    format!("{}, {}, {width}x{height}", plural(scenes.len(), "scene"), plural(methods, "method"))
}

/// Text without control characters, which could move a terminal's cursor or break an SVG.
pub(super) fn printable(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect()
}

/// At most `width` characters, the middle left out where there are more: both ends of a method's options matter.
pub(super) fn shorten(text: &str, width: usize) -> String {
    let characters: Vec<char> = text.chars().collect();
    if characters.len() <= width {
        return text.into();
    }
    let kept = width.saturating_sub(1);
    let (head, tail) = (kept.div_ceil(2), kept / 2);
    let ends = [&characters[..head], &['…'], &characters[characters.len() - tail..]];
    ends.concat().into_iter().collect()
}

/// Lines of at most `width` characters, broken at spaces, or within a word that is longer than a line.
pub(super) fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let mut word: Vec<char> = word.chars().collect();
        while !word.is_empty() {
            let line = lines.last_mut().expect("there is always a line");
            let used = line.chars().count();
            let gap = usize::from(used > 0);
            if used + gap + word.len() <= width {
                line.push_str(&" ".repeat(gap));
                line.extend(word.drain(..));
            } else if used > 0 {
                lines.push(String::new());
            } else {
                line.extend(word.drain(..width.min(word.len())));
            }
        }
    }
    lines
}

/// A command that a POSIX shell reads back as these arguments.
pub(super) fn shell_line(program: &str, arguments: &[String]) -> String {
    let quoted = |argument: &String| {
        let plain = |c: char| c.is_ascii_alphanumeric() || "-_./:=,+@%".contains(c);
        if !argument.is_empty() && argument.chars().all(plain) {
            argument.clone()
        } else {
            format!("'{}'", argument.replace('\'', r"'\''"))
        }
    };
    let parts: Vec<String> = std::iter::once(program.to_string()).chain(arguments.iter().map(quoted)).collect();
    parts.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_digits_fit_five_characters() {
        let shown =
            [0.0, 0.0001, 0.0123, 0.0999, 0.5, 1.234, 9.996, 12.34, 99.96, 1234.5, 99_999.9, 1e300, f64::NAN].map(three_digits);
        assert_eq!(shown, ["0", "<.001", "0.012", "0.100", "0.50", "1.23", "10.0", "12.3", "100", "1234", "1e5", "1e300", NONE]);
        assert!(shown.iter().all(|text| text.chars().count() <= 5));
    }

    #[test]
    fn shortened_text_keeps_both_ends() {
        assert_eq!(shorten("abcdefghij", 7), "abc…hij");
        assert_eq!(shorten("abc", 3), "abc");
        assert_eq!(shorten("abc", 1), "…");
    }

    #[test]
    fn wrapped_lines_fit() {
        assert_eq!(wrap("one two three", 7), ["one two", "three"]);
        assert_eq!(wrap("abcdefgh ij", 3), ["abc", "def", "gh", "ij"]);
        assert_eq!(wrap("", 3), [""]);
    }

    #[test]
    fn commands_are_quoted_for_the_shell() {
        let arguments = ["score", "it's", "", "a b", "smaa:preset=ultra"].map(String::from);
        assert_eq!(shell_line("dejag", &arguments), r"dejag score 'it'\''s' '' 'a b' smaa:preset=ultra");
    }

    #[test]
    fn words_stand_for_what_is_no_number() {
        assert_eq!(figure("psnr", Figure::Infinite), "inf");
        assert_eq!(figure("flip", Figure::NonFinite), "NaN");
        assert_eq!(figure("flip", Figure::NotApplicable), NONE);
        assert_eq!(figure("psnr", Figure::Number(35.2006)), "35.20");
        assert_eq!(figure("rel-rmse", Figure::Number(1.25e7)), "1.2e7");
    }
}
