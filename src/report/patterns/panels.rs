//! Point sets side by side.

use maud::{Markup, html};

use crate::error::Result;
use crate::picture::{BitDepth, DisplayPicture, LinearPicture, Pixel};
use crate::report::words::printable;

/// One square.
#[derive(Debug, Clone)]
pub struct Panel {
    /// Above it, in files that have letters.
    pub title: String,
    /// What lies under the points, stretched to the square.
    pub ground: Option<DisplayPicture>,
    /// In the unit square, y down.
    pub points: Vec<[f64; 2]>,
    /// Of a dot, in sides of the square.
    pub radius: f64,
    /// Whether the points are in a disk, whose outline is drawn then instead of the square's.
    pub round: bool,
}

/// Squares in rows of at most six.
#[derive(Debug, Clone)]
pub struct Panels {
    /// From left to right, then down.
    pub panels: Vec<Panel>,
    /// Of each square, in pixels.
    pub side_px: u32,
}

const COLUMNS: usize = 6;

/// Between the squares and around them.
const GAP_PX: u32 = 16;

/// Height of a title, where there are any.
const TITLE_PX: u32 = 18;

/// Of a dot in a picture of pixels: a smaller one would only be paler.
const LEAST_RADIUS_PX: f64 = 0.7;

const INK: Pixel = [0.01, 0.01, 0.015, 1.0];
const PAPER: Pixel = [1.0, 1.0, 1.0, 1.0];
const OUTLINE: Pixel = [0.6, 0.6, 0.6, 1.0];

impl Panels {
    fn columns(&self) -> usize {
        self.panels.len().clamp(1, COLUMNS)
    }

    /// Width and height, and a panel's place by its number, where each has so much above it.
    fn layout(&self, above: u32) -> ([u32; 2], impl Fn(usize) -> [u32; 2]) {
        let columns = self.columns();
        let rows = self.panels.len().div_ceil(columns) as u32;
        let step = [self.side_px + GAP_PX, self.side_px + GAP_PX + above];
        let place = move |i: usize| [GAP_PX + (i % columns) as u32 * step[0], GAP_PX + above + (i / columns) as u32 * step[1]];
        ([GAP_PX + columns as u32 * step[0], GAP_PX + rows * step[1]], place)
    }

    /// Width and height of [`Panels::svg`].
    #[must_use]
    pub fn svg_size(&self) -> [u32; 2] {
        self.layout(TITLE_PX).0
    }

    /// As vectors, with titles; dots stand where they are to a hundredth of a pixel. The same panels give the same bytes.
    #[must_use]
    pub fn svg(&self) -> String {
        let ([width, height], place) = self.layout(TITLE_PX);
        let drawing = html! {
            svg xmlns="http://www.w3.org/2000/svg" width=(width) height=(height) viewBox=(format!("0 0 {width} {height}")) {
                rect width=(width) height=(height) fill="white" {}
                @for (i, panel) in self.panels.iter().enumerate() { (panel.markup(place(i), self.side_px)) }
            }
        };
        drawing.into_string()
    }

    /// As pixels, without titles, mixed in linear light.
    ///
    /// # Errors
    /// [`crate::Error::Request`] if it gets larger than a picture may be.
    pub fn picture(&self) -> Result<DisplayPicture> {
        let ([width, height], place) = self.layout(0);
        let mut canvas = Canvas { size: [width, height], pixels: Vec::new() };
        LinearPicture::from_fn(width, height, |_, _| PAPER).map(|paper| canvas.pixels = paper.into_pixels())?;
        for (i, panel) in self.panels.iter().enumerate() {
            panel.paint(&mut canvas, place(i), self.side_px);
        }
        Ok(LinearPicture::new(width, height, canvas.pixels)?.to_display())
    }
}

impl Panel {
    fn markup(&self, [left, top]: [u32; 2], side: u32) -> Markup {
        let coordinate = |origin: u32, u: f64| format!("{:.2}", f64::from(origin) + u * f64::from(side));
        let (radius, half) = (format!("{:.2}", self.radius * f64::from(side)), f64::from(side) / 2.0);
        html! {
            text x=(left) y=(top - 5) font-family="sans-serif" font-size="13" fill="#1f2328" { (printable(&self.title)) }
            @if let Some(ground) = &self.ground {
                image x=(left) y=(top) width=(side) height=(side) style="image-rendering:pixelated" href=(data_url(ground)) {}
            }
            @if self.round {
                circle cx=(coordinate(left, 0.5)) cy=(coordinate(top, 0.5)) r=(half) fill="none" stroke="#c8ced5" {}
            } @else {
                rect x=(left) y=(top) width=(side) height=(side) fill="none" stroke="#c8ced5" {}
            }
            g fill="#1f2328" {
                @for [x, y] in &self.points { circle cx=(coordinate(left, *x)) cy=(coordinate(top, *y)) r=(radius) {} }
            }
        }
    }

    fn paint(&self, canvas: &mut Canvas, place: [u32; 2], side: u32) {
        let [left, top] = place;
        if let Some(ground) = &self.ground {
            let linear = ground.to_linear();
            let at = |offset: u32, extent: u32| (u64::from(offset) * u64::from(extent) / u64::from(side)) as u32;
            for (y, x) in (0..side).flat_map(|y| (0..side).map(move |x| (y, x))) {
                let pixel = linear.pixel(at(x, linear.width()), at(y, linear.height()));
                canvas.blend([left + x, top + y], pixel, 1.0);
            }
        }
        self.paint_outline(canvas, place, side);
        let radius = (self.radius * f64::from(side)).max(LEAST_RADIUS_PX);
        for p in &self.points {
            let center = [f64::from(left) + p[0] * f64::from(side), f64::from(top) + p[1] * f64::from(side)];
            canvas.ring(center, radius, |outside| (0.5 - outside).clamp(0.0, 1.0), INK);
        }
    }

    fn paint_outline(&self, canvas: &mut Canvas, [left, top]: [u32; 2], side: u32) {
        if self.round {
            let half = f64::from(side) / 2.0;
            let center = [f64::from(left) + half, f64::from(top) + half];
            return canvas.ring(center, half, |outside| (1.0 - outside.abs()).clamp(0.0, 1.0), OUTLINE);
        }
        for i in 0..=side + 1 {
            let ends = [[i, 0], [i, side + 1], [0, i], [side + 1, i]];
            ends.iter().for_each(|[x, y]| canvas.blend([left + x - 1, top + y - 1], OUTLINE, 1.0));
        }
    }
}

/// Linear light in rows.
struct Canvas {
    size: [u32; 2],
    pixels: Vec<Pixel>,
}

impl Canvas {
    fn blend(&mut self, [x, y]: [u32; 2], color: Pixel, coverage: f32) {
        let pixel = &mut self.pixels[(y * self.size[0] + x) as usize];
        *pixel = [0, 1, 2, 3].map(|k| pixel[k] + coverage * (color[k] - pixel[k]));
    }

    /// Everything around a centre, covered by the distance outside of a circle in pixels.
    fn ring(&mut self, center: [f64; 2], radius: f64, coverage: impl Fn(f64) -> f64, color: Pixel) {
        let range = |k: usize| {
            let to = (center[k] + radius + 1.0).ceil().min(f64::from(self.size[k])) as u32;
            (center[k] - radius - 1.0).floor().max(0.0) as u32..to
        };
        let (columns, rows) = (range(0), range(1));
        for (y, x) in rows.flat_map(|y| columns.clone().map(move |x| (y, x))) {
            let distance = (f64::from(x) + 0.5 - center[0]).hypot(f64::from(y) + 0.5 - center[1]);
            self.blend([x, y], color, coverage(distance - radius) as f32);
        }
    }
}

fn data_url(picture: &DisplayPicture) -> String {
    use base64::Engine as _;
    let mut bytes = Vec::new();
    picture.encode_png(&mut bytes, BitDepth::Eight, &[]).expect("memory takes every byte");
    format!("data:image/png;base64,{}", base64::engine::general_purpose::STANDARD.encode(bytes))
}
