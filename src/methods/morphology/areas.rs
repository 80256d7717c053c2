//! How much of the pixels beside an edge lies behind it, once the edge's staircase is drawn as a line again.
//!
//! Jimenez 2012, section 3: an edge that ends in crossing edges stands for a line through the middles of those crossings; the
//! pixels beside it are blended by what the line cuts off. The published tables hold these areas in 8 bits, distances compressed
//! by a square root and areas beside diagonals counted on a grid. These are exact at every distance, in 16 bits.

use crate::pass::Context;

/// A point in pixels.
type Point = [f64; 2];

/// What a line cuts off the pixels below and above an edge.
type Areas = [f64; 2];

/// Areas by the patterns at both ends (four each) and the distances to them.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AreaTable {
    /// Distances go from 0 to `side - 1`.
    pub(crate) side: usize,
    /// `4 * side` squared, columns by the first end's pattern and distance; two unorm16 each.
    pub(crate) texels: Vec<u32>,
}

impl AreaTable {
    /// From a function of the ends' patterns and distances.
    pub(crate) fn from_fn(side: usize, areas: impl Fn([usize; 2], [usize; 2]) -> Areas) -> Self {
        let width = 4 * side;
        let texel = |i: usize| {
            let (x, y) = (i % width, i / width);
            let [a, b] =
                areas([x / side, y / side], [x % side, y % side]).map(|area| (area.clamp(0.0, 1.0) * 65535.0).round() as u32);
            a | b << 16
        };
        Self { side, texels: (0..width * width).map(texel).collect() }
    }

    /// Beside horizontal and vertical lines. Patterns: 1 an edge crosses above, 2 below, 3 both. `offset_px` is how far along its
    /// edges and above them the scene's line lies from the picture's: samples off the pixels' centres find it that far off.
    /// `smooth` softens short U shapes as SMAA does.
    pub(crate) fn lines(reach: u32, offset_px: Point, smooth: bool) -> Self {
        Self::from_fn(reach as usize + 1, |ends, distances| beside_line(ends, distances, offset_px, smooth))
    }

    /// Beside staircases. Patterns: 1 and 2 by which of the two edges at the end goes on. `offset_px` as above, to the right and
    /// up for a staircase that rises to the right.
    pub(crate) fn diagonals(reach: u32, offset_px: Point) -> Self {
        Self::from_fn(reach as usize + 1, |ends, distances| beside_diagonal(ends, distances, offset_px))
    }

    /// As a texture.
    pub(crate) fn upload(&self, context: &Context<'_>) -> wgpu::TextureView {
        let width = 4 * self.side as u32;
        let texture = context.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("areas"),
            size: wgpu::Extent3d { width, height: width, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::R32Uint,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * width), rows_per_image: None };
        context.queue.write_texture(texture.as_image_copy(), bytemuck::cast_slice(&self.texels), layout, texture.size());
        texture.create_view(&wgpu::TextureViewDescriptor::default())
    }
}

/// A line's patterns come as above = 1, below = 2; y points up here, the edge lies at 0.
fn beside_line(ends: [usize; 2], [left, right]: [usize; 2], [along, across]: Point, smooth: bool) -> Areas {
    let d = (left + right + 1) as f64;
    let (above, below) = (0.5 + across, -0.5 + across);
    let (at, middle) = (left as f64, d / 2.0 + along);
    // A line that is moved along itself goes on as it was where it ended.
    let whole = |from: f64, to: f64| {
        let lower = (to - from) / d * along;
        cut_off([0.0, from - lower], [d, to - lower], at)
    };
    let from_start = |y: f64| cut_off([0.0, 2.0 * y * middle / d], [middle, 0.0], at);
    let to_end = |y: f64| cut_off([middle, 0.0], [d, 2.0 * y * (d - middle) / d], at);
    let soften = |area: Areas| if smooth { area.map(|a| softened(a, d)) } else { area };
    let u_shape = |y: f64| sum(soften(from_start(y)), soften(to_end(y)));
    match ends {
        [1, 0] => from_start(above),
        [2, 0] => from_start(below),
        [0, 1] => to_end(above),
        [0, 2] => to_end(below),
        [1, 1] => u_shape(above),
        [2, 2] => u_shape(below),
        [1, 2] | [1, 3] | [3, 2] => whole(above, below),
        [2, 1] | [2, 3] | [3, 1] => whole(below, above),
        _ => [0.0; 2],
    }
}

/// Short U shapes are blunt: a square root widens their small areas, less and less up to 32 pixels (Jimenez 2012).
fn softened(area: f64, length: f64) -> f64 {
    let wide = (2.0 * area).sqrt() / 2.0;
    wide + (area - wide) * (length / 32.0).clamp(0.0, 1.0)
}

fn sum(a: Areas, b: Areas) -> Areas {
    [a[0] + b[0], a[1] + b[1]]
}

/// Between the line from `p` to `q` and the axis, over the pixel that begins at `x`: below and above.
fn cut_off(p: Point, q: Point, x: f64) -> Areas {
    let (from, to) = (x.max(p[0]), (x + 1.0).min(q[0]));
    if from >= to {
        return [0.0; 2];
    }
    let slope = (q[1] - p[1]) / (q[0] - p[0]);
    let height = |x: f64| p[1] + slope * (x - p[0]);
    let (y0, y1) = (height(from), height(to));
    let width = to - from;
    // A line that crosses the axis makes two triangles, else there is one trapezoid.
    let area = |y0: f64, y1: f64| match (y0 > 0.0, y1 > 0.0) {
        (true, true) => (y0 + y1) / 2.0 * width,
        (true, false) => y0 * y0 / (y0 - y1) / 2.0 * width,
        (false, true) => y1 * y1 / (y1 - y0) / 2.0 * width,
        (false, false) => 0.0,
    };
    [area(-y0, -y1), area(y0, y1)]
}

/// The lines that a staircase may stand for, by the patterns at its ends: from each first point to the second one, which counts
/// from the staircase's far end. Where two are possible, their mean.
pub(crate) fn diagonal_lines(ends: [usize; 2]) -> &'static [[Point; 2]] {
    const OO: Point = [0.0, 0.0];
    const IO: Point = [1.0, 0.0];
    const II: Point = [1.0, 1.0];
    match ends {
        [1, 0] => &[[IO, OO], [IO, IO]],
        [0, 2] => &[[OO, IO], [IO, IO]],
        [1, 2] => &[[IO, IO]],
        [2, 0] => &[[II, OO], [II, IO]],
        [3, 0] => &[[II, OO], [IO, IO]],
        [2, 2] => &[[II, IO]],
        [3, 2] => &[[II, IO], [IO, IO]],
        [0, 1] => &[[OO, II], [IO, II]],
        [1, 1] => &[[IO, II]],
        [0, 3] => &[[OO, II], [IO, IO]],
        [1, 3] => &[[IO, II], [IO, IO]],
        [2, 1] => &[[II, II]],
        [3, 1] => &[[II, II], [IO, II]],
        [2, 3] => &[[II, II], [II, IO]],
        _ => &[[II, II], [IO, IO]],
    }
}

fn beside_diagonal(ends: [usize; 2], [left, right]: [usize; 2], offset: Point) -> Areas {
    let d = (left + right + 1) as f64;
    let left = left as f64;
    let moved = |p: Point, end: usize, by: f64| {
        let offset = if end > 0 { offset } else { [0.0; 2] };
        [p[0] + offset[0] + by, p[1] + offset[1] + by]
    };
    let lines = diagonal_lines(ends);
    let areas = lines.iter().map(|[p, q]| {
        let (p, q) = (moved(*p, ends[0], 0.0), moved(*q, ends[1], d));
        [1.0 - square_behind(p, q, [1.0 + left, left]), square_behind(p, q, [1.0 + left, 1.0 + left])]
    });
    areas.fold([0.0; 2], sum).map(|a| a / lines.len() as f64)
}

/// How much of the unit square at `corner` lies behind the line from `p` to `q`; all of it where the two are one point.
fn square_behind(p: Point, q: Point, corner: Point) -> f64 {
    if p == q {
        return 1.0;
    }
    let side = |v: Point| (q[1] - p[1]) * (v[0] - p[0]) + (p[0] - q[0]) * (v[1] - p[1]);
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| [corner[0] + x, corner[1] + y]);
    // Clipped corner by corner; the area by the shoelace formula, from the square's own corner for precision.
    let mut clipped: Vec<Point> = Vec::with_capacity(5);
    for (i, v) in square.iter().enumerate() {
        let w = square[(i + 1) % 4];
        let (a, b) = (side(*v), side(w));
        if a > 0.0 {
            clipped.push(*v);
        }
        if (a > 0.0) != (b > 0.0) {
            let t = a / (a - b);
            clipped.push([v[0] + t * (w[0] - v[0]), v[1] + t * (w[1] - v[1])]);
        }
    }
    let relative: Vec<Point> = clipped.iter().map(|v| [v[0] - corner[0], v[1] - corner[1]]).collect();
    let twice: f64 = (0..relative.len())
        .map(|i| {
            let (v, w) = (relative[i], relative[(i + 1) % relative.len()]);
            v[0] * w[1] - w[0] * v[1]
        })
        .sum();
    (twice / 2.0).abs()
}
