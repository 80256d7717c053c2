//! Time against error as an SVG picture.

use super::axis::Axis;
use super::placement::{Rect, place};
use super::points::Point;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Size of a plot in pixels; a page may scale it.
const SIZE: (u32, u32) = (760, 400);

/// What the axes enclose: left, top, right, bottom.
const FRAME: [i32; 4] = [70, 16, 744, 346];

/// Height of letters in pixels. The backend divides its font sizes by 1.24.
const LETTERS: f64 = 13.0;

// The page's style sheet replaces these by name in a dark theme.
const INK: RGBColor = RGBColor(0x1f, 0x23, 0x28);
const MUTED: RGBColor = RGBColor(0x59, 0x63, 0x6e);
const GRID: RGBColor = RGBColor(0xd9, 0xde, 0xe4);
const UNBEATEN: RGBColor = RGBColor(0x0a, 0x6b, 0xd6);
const BEATEN: RGBColor = RGBColor(0x8c, 0x95, 0x9f);

type Canvas<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
type Drawn = Result<(), DrawingAreaErrorKind<std::io::Error>>;

/// Total milliseconds (logarithmic) against mean FLIP error, a labelled dot for each point; the unbeaten ones are filled and
/// joined by a line. The same points give the same bytes. None if there is nothing to draw.
pub(super) fn svg(points: &[Point]) -> Option<String> {
    if points.is_empty() {
        return None;
    }
    let mut text = String::new();
    let canvas = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
    let drawn = draw(&canvas, points).and_then(|()| canvas.present());
    drop(canvas);
    drawn.ok().map(|()| for_a_page(&text))
}

/// Within HTML the name space goes without saying, and a page should name no address at all.
fn for_a_page(text: &str) -> String {
    text.replacen(" xmlns=\"http://www.w3.org/2000/svg\"", " role=\"img\" aria-label=\"total time against mean FLIP error\"", 1)
}

fn draw(canvas: &Canvas<'_>, points: &[Point]) -> Drawn {
    let [left, top, right, bottom] = FRAME;
    let times = Axis::logarithmic(points.iter().map(|point| point.time_ms), [left, right]);
    let errors = Axis::from_zero(points.iter().map(|point| point.error), [bottom, top]);
    draw_axes(canvas, &times, &errors)?;

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

fn draw_axes(canvas: &Canvas<'_>, times: &Axis, errors: &Axis) -> Drawn {
    let [left, top, right, bottom] = FRAME;
    for (value, label) in times.ticks() {
        let x = times.pixel(value);
        canvas.draw(&PathElement::new([(x, top), (x, bottom)], GRID))?;
        write(canvas, &label, (x, bottom + 6), MUTED, HPos::Center, VPos::Top)?;
    }
    for (value, label) in errors.ticks() {
        let y = errors.pixel(value);
        canvas.draw(&PathElement::new([(left, y), (right, y)], GRID))?;
        write(canvas, &label, (left - 8, y), MUTED, HPos::Right, VPos::Center)?;
    }
    canvas.draw(&PathElement::new([(left, top), (left, bottom), (right, bottom)], MUTED))?;
    let middle = i32::midpoint(left, right);
    write(canvas, "total time in ms (logarithmic)", (middle, bottom + 28), MUTED, HPos::Center, VPos::Top)?;
    let upright = style(MUTED, HPos::Center, VPos::Top).transform(FontTransform::Rotate270);
    canvas.draw(&Text::new("mean FLIP error", (4, i32::midpoint(top, bottom)), upright))
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

fn style(color: RGBColor, horizontal: HPos, vertical: VPos) -> TextStyle<'static> {
    let font = ("sans-serif", LETTERS * 1.24).into_font();
    TextStyle { font, color: color.to_backend_color(), pos: Pos::new(horizontal, vertical) }
}

fn write(canvas: &Canvas<'_>, text: &str, at: (i32, i32), color: RGBColor, horizontal: HPos, vertical: VPos) -> Drawn {
    canvas.draw(&Text::new(text.to_string(), at, style(color, horizontal, vertical)))
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
