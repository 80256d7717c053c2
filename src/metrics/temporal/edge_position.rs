//! Where a straight edge is, to fractions of a pixel.

use super::rgb;
use crate::picture::LinearPicture;

/// Rows and columns at the picture's borders that are not looked at, in pixels: filters know nothing beyond them.
const MARGIN: usize = 8;

/// How far an edge lies from where it should, across itself, in pixels, for each row (or column, for edges nearer to level) that it
/// crosses well inside the picture: above 0 the bright side is too large.
///
/// `angle` is the angle in radians of the edge's normal from the x axis; `dark` and `bright` are the linear values of its sides. What a
/// row has too much of light, over the step, is its displacement, however the edge is smoothed.
#[must_use]
pub fn edge_displacements(test: &LinearPicture, exact: &LinearPicture, angle: f64, [dark, bright]: [f64; 2]) -> Vec<f64> {
    let [width, height] = test.size().map(|side| side as usize);
    let (sin, cos) = angle.sin_cos();
    let upright = cos.abs() >= sin.abs();
    let (lines, length) = if upright { (height, width) } else { (width, height) };
    let pixel = |line: usize, at: usize| if upright { line * width + at } else { at * width + line };
    let level = |picture: &LinearPicture, line, at| rgb(picture.pixels()[pixel(line, at)]).iter().sum::<f64>() / 3.0;
    let middle = 0.5 * (dark + bright);
    let crosses = |line: usize| {
        let side = |at: usize| level(exact, line, at) > middle;
        (1..length).find(|at| side(*at) != side(at - 1)).is_some_and(|at| (MARGIN..length.saturating_sub(MARGIN)).contains(&at))
    };
    let displacement = |line: usize| {
        let excess: f64 = (0..length).map(|at| level(test, line, at) - level(exact, line, at)).sum();
        excess / (bright - dark) * cos.abs().max(sin.abs())
    };
    (MARGIN..lines.saturating_sub(MARGIN)).filter(|line| crosses(*line)).map(displacement).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIDE: u32 = 48;
    const SIDES: [f64; 2] = [0.2, 0.8];

    /// A ramp of `width` pixels across an edge that is moved by `shift` pixels along its normal.
    fn edge(angle: f64, shift: f64, width: f64) -> LinearPicture {
        LinearPicture::from_fn(SIDE, SIDE, |x, y| {
            let (dx, dy) = (f64::from(x) - 23.3, f64::from(y) - 23.6);
            let across = angle.cos() * dx + angle.sin() * dy + shift;
            let level = (0.2 + 0.6 * (across / width + 0.5).clamp(0.0, 1.0)) as f32;
            [level, level, level, 1.0]
        })
        .expect("a size")
    }

    #[test]
    fn a_shifted_edge_gives_its_shift_at_every_angle() {
        for degrees in [0.0f64, 7.5, 30.0, 45.0, 60.0, 82.5, 90.0] {
            let angle = degrees.to_radians();
            let found = edge_displacements(&edge(angle, 0.3, 4.0), &edge(angle, 0.0, 4.0), angle, SIDES);
            assert!(found.len() >= 20, "{degrees}: {} lines", found.len());
            // The ramp is sampled, not integrated: a line may be off a little, all together are not.
            assert!(found.iter().all(|d| (d - 0.3).abs() < 0.06), "{degrees}: {found:?}");
            assert!((found.iter().sum::<f64>() / found.len() as f64 - 0.3).abs() < 0.01, "{degrees}: {found:?}");
        }
    }

    #[test]
    fn blur_moves_nothing() {
        let found = edge_displacements(&edge(0.3, 0.0, 6.0), &edge(0.3, 0.0, 2.0), 0.3, SIDES);
        assert!(found.iter().all(|d| d.abs() < 0.06), "{found:?}");
    }

    #[test]
    fn a_small_picture_has_no_lines_to_look_at() {
        let small = edge(0.0, 0.0, 2.0).crop(0, 0, 9, 9).expect("inside");
        assert!(edge_displacements(&small, &small, 0.0, SIDES).is_empty());
    }
}
