//! Several lines over one axis, such as an error by angle or a time by size, with a legend beside them.

use super::axis::Axis;
use super::frame::{self, Canvas, Drawn, Frame, INK, LETTERS, write};
use super::words::{printable, shorten};
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

/// Width in pixels, and height where the legend fits; a page may scale it.
const SIZE: (u32, u32) = (760, 400);

/// What the axes enclose: left, top, right, bottom.
const FRAME: [i32; 4] = [70, 16, 520, 346];

/// Height of a line of the legend, and its longest label in characters.
const LEGEND: (i32, usize) = (18, 25);

/// Told apart on light and dark paper, and by most who see colours differently; then they come again, dashed.
const COLORS: [RGBColor; 8] = [
    RGBColor(0x0a, 0x6b, 0xd6),
    RGBColor(0xd0, 0x55, 0x1f),
    RGBColor(0x1c, 0x8f, 0x5f),
    RGBColor(0xa0, 0x4a, 0xc8),
    RGBColor(0xb0, 0x86, 0x0a),
    RGBColor(0xc7, 0x36, 0x70),
    RGBColor(0x1f, 0x9a, 0xb4),
    RGBColor(0x7a, 0x6a, 0x50),
];

/// Of what a line is only to be held against. The page's style sheet replaces it by name in a dark theme.
const BASELINE: RGBColor = RGBColor(0x8c, 0x95, 0x9f);

/// Dash and gap in pixels of the second, third and fourth line of a colour.
const DASHES: [(i32, i32); 3] = [(9, 5), (2, 4), (14, 3)];

/// How an axis runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scale {
    /// From 0 to a little more than the largest value.
    Linear,
    /// From 0 to here.
    LinearTo(f64),
    /// From the first to the second.
    Between(f64, f64),
    /// By powers.
    Logarithmic,
}

/// One line.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Its name in the legend.
    pub label: String,
    /// Whether the others are held against it: drawn in grey.
    pub baseline: bool,
    /// From left to right.
    pub points: Vec<(f64, f64)>,
}

/// A plot of lines.
#[derive(Debug, Clone, PartialEq)]
pub struct LinePlot {
    /// What the axis to the right measures, and how it runs.
    pub x: (String, Scale),
    /// What the axis upwards measures, and how it runs.
    pub y: (String, Scale),
    /// The lines, in the order of the legend.
    pub series: Vec<Series>,
}

impl LinePlot {
    /// As a file of its own. The same lines give the same bytes. None if there is nothing to draw.
    #[must_use]
    pub fn svg(&self) -> Option<String> {
        let [width, height] = self.size();
        let empty = self.series.iter().all(|series| series.points.is_empty());
        if empty { None } else { frame::svg((width, height), |canvas| self.draw(canvas)) }
    }

    /// Width and height in pixels: as high as the legend asks for.
    pub(super) fn size(&self) -> [u32; 2] {
        [SIZE.0, SIZE.1.max(self.series.len() as u32 * LEGEND.0 as u32 + 32)]
    }

    /// As a part of a page.
    pub(super) fn svg_for_a_page(&self, about: &str) -> Option<String> {
        self.svg().map(|text| frame::for_a_page(&text, about))
    }

    fn draw(&self, canvas: &Canvas<'_>) -> Drawn {
        let [left, top, right, bottom] = FRAME;
        let values = || self.series.iter().flat_map(|series| &series.points);
        let x = self.x.1.axis(values().map(|(x, _)| *x), [left, right]);
        let y = self.y.1.axis(values().map(|(_, y)| *y), [bottom, top]);
        Frame { enclosed: FRAME, x: (&x, &self.x.0), y: (&y, &self.y.0) }.draw(canvas)?;
        let (mut baselines, mut others) = (0, 0);
        for (row, series) in (0..).zip(&self.series) {
            let count = if series.baseline { &mut baselines } else { &mut others };
            let stroke = Stroke::of(series.baseline, *count);
            *count += 1;
            stroke.draw(canvas, series.points.iter().map(|point| (x.pixel(point.0), y.pixel(point.1))).collect())?;
            let level = top + LEGEND.0 / 2 + row * LEGEND.0;
            stroke.draw(canvas, vec![(right + 14, level), (right + 40, level)])?;
            let label = shorten(&printable(&series.label), LEGEND.1);
            write(canvas, &label, (right + 48, level - (LETTERS / 2.0) as i32), INK, HPos::Left, VPos::Top)?;
        }
        Ok(())
    }
}

/// A line's looks.
#[derive(Debug, Clone, Copy)]
struct Stroke {
    color: RGBColor,
    /// How many lines had the colour before.
    turn: usize,
}

impl Stroke {
    /// Of the line of that number among the baselines or among the others.
    fn of(baseline: bool, number: usize) -> Self {
        if baseline {
            Self { color: BASELINE, turn: number }
        } else {
            Self { color: COLORS[number % COLORS.len()], turn: number / COLORS.len() }
        }
    }

    fn draw(self, canvas: &Canvas<'_>, path: Vec<(i32, i32)>) -> Drawn {
        let style = self.color.stroke_width(2);
        match self.turn.checked_sub(1).map(|turn| DASHES[turn % DASHES.len()]) {
            None => canvas.draw(&PathElement::new(path, style)),
            Some((dash, gap)) => canvas.draw(&DashedPathElement::new(path, dash, gap, style)),
        }
    }
}

impl Scale {
    fn axis(self, values: impl Iterator<Item = f64>, pixels: [i32; 2]) -> Axis {
        match self {
            Self::Linear => Axis::from_zero(values, pixels),
            Self::LinearTo(most) => Axis::between(0.0, most, pixels),
            Self::Between(least, most) => Axis::between(least, most, pixels),
            Self::Logarithmic => Axis::logarithmic(values, pixels),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(lines: usize) -> LinePlot {
        let series = |i: usize| Series {
            label: format!("<line> {i}"),
            baseline: i == 0,
            points: (0..=90).map(|x| (f64::from(x), (i + 1) as f64 * f64::from(x))).collect(),
        };
        LinePlot {
            x: ("degrees".into(), Scale::LinearTo(90.0)),
            y: ("error".into(), Scale::Linear),
            series: (0..lines).map(series).collect(),
        }
    }

    #[test]
    fn lines_have_a_colour_and_a_name_each() {
        let svg = plot(4).svg().expect("lines");
        for text in ["degrees", "error", "&lt;line&gt; 3", "#8C959F", "#0A6BD6", "#1C8F5F"] {
            assert!(svg.contains(text), "{text} in {svg}");
        }
        assert_eq!(Some(&svg), plot(4).svg().as_ref());
        assert!(svg.contains("xmlns") && !plot(4).svg_for_a_page("lines").expect("lines").contains("http"));
    }

    #[test]
    fn odd_lines_draw_without_panic() {
        assert_eq!(plot(0).svg(), None);
        assert!(plot(40).svg().is_some_and(|svg| svg.contains("line&gt; 39")));
        let mut short = plot(2);
        short.series[0].points.truncate(1);
        short.series[1].points.clear();
        short.y.1 = Scale::Logarithmic;
        assert!(short.svg().is_some());
    }
}
