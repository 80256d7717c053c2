//! Time against error as an SVG picture.

use super::axis::Axis;
use super::frame::{self, Canvas, Drawn, Frame, INK, LETTERS, MUTED, write};
use super::placement::{Rect, place};
use super::points::Point;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

/// Size of a plot in pixels; a page may scale it.
const SIZE: (u32, u32) = (760, 400);

/// What the axes enclose: left, top, right, bottom.
const FRAME: [i32; 4] = [70, 16, 744, 346];

// Replaced in a dark theme, as the others.
const UNBEATEN: RGBColor = RGBColor(0x0a, 0x6b, 0xd6);
const BEATEN: RGBColor = RGBColor(0x8c, 0x95, 0x9f);

/// Total milliseconds (logarithmic) against mean FLIP error, a labelled dot for each point; the unbeaten ones are filled and
/// joined by a line. The same points give the same bytes. None if there is nothing to draw.
pub(super) fn svg(points: &[Point]) -> Option<String> {
    if points.is_empty() {
        return None;
    }
    frame::svg(SIZE, |canvas| draw(canvas, points)).map(|text| frame::for_a_page(&text, "total time against mean FLIP error"))
}

fn draw(canvas: &Canvas<'_>, points: &[Point]) -> Drawn {
    let [left, top, right, bottom] = FRAME;
    let times = Axis::logarithmic(points.iter().map(|point| point.time_ms), [left, right]);
    let errors = Axis::from_zero(points.iter().map(|point| point.error), [bottom, top]);
    Frame { enclosed: FRAME, x: (&times, "total time in ms (logarithmic)"), y: (&errors, "mean FLIP error") }.draw(canvas)?;

    let mut points: Vec<&Point> = points.iter().collect();
    points.sort_by(|a, b| a.time_ms.total_cmp(&b.time_ms).then(a.error.total_cmp(&b.error)));
    let at = |point: &Point| (times.pixel(point.time_ms), errors.pixel(point.error));
    let front: Vec<(i32, i32)> = points.iter().filter(|point| point.unbeaten).map(|point| at(point)).collect();
    canvas.draw(&PathElement::new(front.clone(), UNBEATEN.stroke_width(2)))?;
    for point in &points {
        let color = if point.unbeaten { UNBEATEN } else { BEATEN };
        let style = if point.unbeaten { color.filled() } else { color.stroke_width(2) };
        canvas.draw(&Circle::new(at(point), 5, style))?;
    }
    draw_labels(canvas, &points, &front, at)
}

fn draw_labels(canvas: &Canvas<'_>, points: &[&Point], front: &[(i32, i32)], at: impl Fn(&Point) -> (i32, i32)) -> Drawn {
    let boxes: Vec<(i32, i32, i32, i32)> = points
        .iter()
        .map(|point| {
            let (x, y) = at(point);
            (x, y, width_of(&point.label), LETTERS as i32 + 2)
        })
        .collect();
    for ((point, beside), Rect([left, top, right, bottom])) in points.iter().zip(&boxes).zip(place(&boxes, front, Rect(FRAME))) {
        let color = if point.unbeaten { INK } else { MUTED };
        // Anchored at the side of the point: how wide the letters come out is only known to within a tenth.
        let (x, anchor) = match beside.0 {
            x if x < left => (left, HPos::Left),
            x if x > right => (right, HPos::Right),
            _ => (i32::midpoint(left, right), HPos::Center),
        };
        write(canvas, &point.label, (x, i32::midpoint(top, bottom)), color, anchor, VPos::Center)?;
    }
    Ok(())
}

/// About how wide a label is in a proportional sans-serif face.
fn width_of(label: &str) -> i32 {
    (label.chars().count() as f64 * 0.58 * LETTERS).ceil() as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(label: &str, time_ms: f64, error: f64, unbeaten: bool) -> Point {
        Point { label: label.into(), time_ms, error, unbeaten }
    }

    #[test]
    fn points_are_labelled_and_the_unbeaten_joined() {
        let points = [point("none", 1.0, 0.05, true), point("ssaa", 9.0, 0.01, true), point("slow", 20.0, 0.04, false)];
        let svg = svg(&points).expect("points");
        for text in ["none", "ssaa", "slow", "total time in ms (logarithmic)", "mean FLIP error"] {
            assert!(svg.contains(text), "{text} in {svg}");
        }
        assert_eq!(svg.matches("<circle").count(), 3);
        assert!(!svg.contains("http"));
        assert_eq!(Some(svg), super::svg(&points));
    }

    #[test]
    fn odd_points_draw_without_panic() {
        assert_eq!(svg(&[]), None);
        for (time, error) in [(0.0, 0.0), (1e-300, 1e-300), (1e300, 1e300), (5.0, 0.0)] {
            assert!(svg(&[point("only", time, error, true)]).is_some(), "{time}, {error}");
        }
        let crowd: Vec<Point> = (0..40).map(|i| point("the same", 1.0, 0.01, i % 2 == 0)).collect();
        assert!(svg(&crowd).is_some());
    }

    #[test]
    fn labels_are_escaped() {
        let svg = svg(&[point("<b>&", 1.0, 0.1, true)]).expect("a point");
        assert!(svg.contains("&lt;b&gt;&amp;") && !svg.contains("<b>"));
    }
}
