//! What all plots share: the colours, the axes, the letters.

use super::axis::Axis;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Height of letters in pixels. The backend divides its font sizes by 1.24.
pub(super) const LETTERS: f64 = 13.0;

// The page's style sheet replaces these by name in a dark theme.
pub(super) const INK: RGBColor = RGBColor(0x1f, 0x23, 0x28);
pub(super) const MUTED: RGBColor = RGBColor(0x59, 0x63, 0x6e);
pub(super) const GRID: RGBColor = RGBColor(0xd9, 0xde, 0xe4);

pub(super) type Canvas<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
pub(super) type Drawn = Result<(), DrawingAreaErrorKind<std::io::Error>>;

/// Both axes of a plot, with what stands beside them.
#[derive(Debug)]
pub(super) struct Frame<'a> {
    /// What the axes enclose: left, top, right, bottom.
    pub(super) enclosed: [i32; 4],
    /// To the right, and what it measures.
    pub(super) x: (&'a Axis, &'a str),
    /// Upwards, and what it measures.
    pub(super) y: (&'a Axis, &'a str),
}

impl Frame<'_> {
    /// Grid, ticks, axes and titles.
    pub(super) fn draw(&self, canvas: &Canvas<'_>) -> Drawn {
        let [left, top, right, bottom] = self.enclosed;
        for (value, label) in self.x.0.ticks() {
            let x = self.x.0.pixel(value);
            canvas.draw(&PathElement::new([(x, top), (x, bottom)], GRID))?;
            write(canvas, &label, (x, bottom + 6), MUTED, HPos::Center, VPos::Top)?;
        }
        for (value, label) in self.y.0.ticks() {
            let y = self.y.0.pixel(value);
            canvas.draw(&PathElement::new([(left, y), (right, y)], GRID))?;
            write(canvas, &label, (left - 8, y), MUTED, HPos::Right, VPos::Center)?;
        }
        canvas.draw(&PathElement::new([(left, top), (left, bottom), (right, bottom)], MUTED))?;
        let middle = i32::midpoint(left, right);
        write(canvas, self.x.1, (middle, bottom + 28), MUTED, HPos::Center, VPos::Top)?;
        let upright = style(MUTED, HPos::Center, VPos::Top).transform(FontTransform::Rotate270);
        canvas.draw(&Text::new(self.y.1, (4, i32::midpoint(top, bottom)), upright))
    }
}

/// An SVG of this size in pixels; none if it could not be drawn.
pub(super) fn svg(size: (u32, u32), draw: impl FnOnce(&Canvas<'_>) -> Drawn) -> Option<String> {
    let mut text = String::new();
    let canvas = SVGBackend::with_string(&mut text, size).into_drawing_area();
    let drawn = draw(&canvas).and_then(|()| canvas.present());
    drop(canvas);
    drawn.ok().map(|()| text)
}

/// Within HTML the name space goes without saying, and a page should name no address at all.
pub(super) fn for_a_page(text: &str, about: &str) -> String {
    text.replacen(" xmlns=\"http://www.w3.org/2000/svg\"", &format!(" role=\"img\" aria-label=\"{about}\""), 1)
}

pub(super) fn write(canvas: &Canvas<'_>, text: &str, at: (i32, i32), color: RGBColor, horizontal: HPos, vertical: VPos) -> Drawn {
    canvas.draw(&Text::new(text.to_string(), at, style(color, horizontal, vertical)))
}

fn style(color: RGBColor, horizontal: HPos, vertical: VPos) -> TextStyle<'static> {
    let font = ("sans-serif", LETTERS * 1.24).into_font();
    TextStyle { font, color: color.to_backend_color(), pos: Pos::new(horizontal, vertical) }
}
