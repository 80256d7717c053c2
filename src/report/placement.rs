//! Labels beside their points, so that they hide neither points nor each other where that can be helped.

/// A rectangle in pixels: left, top, right, bottom.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Rect(pub(super) [i32; 4]);

impl Rect {
    /// The area that both cover, in square pixels.
    fn overlap(self, other: Self) -> i64 {
        let ([l, t, r, b], [ol, ot, or, ob]) = (self.0, other.0);
        let length = |from: i32, to: i32| i64::from((to - from).max(0));
        length(l.max(ol), r.min(or)) * length(t.max(ot), b.min(ob))
    }

    fn area(self) -> i64 {
        let [l, t, r, b] = self.0;
        i64::from(r - l) * i64::from(b - t)
    }
}

/// Half the side of what a point covers.
const POINT: i32 = 6;

/// For each point (x, y, width and height of its label) the rectangle of its label within `bounds`, off the line where that can
/// be. The first points choose first; a label goes to the right of its point if there is room.
pub(super) fn place(points: &[(i32, i32, i32, i32)], line: &[(i32, i32)], bounds: Rect) -> Vec<Rect> {
    let line = along(line);
    let dots: Vec<Rect> = points.iter().map(|&(x, y, _, _)| Rect([x - POINT, y - POINT, x + POINT, y + POINT])).collect();
    let mut placed: Vec<Rect> = Vec::new();
    for &point in points {
        let hidden = |rect: &Rect| {
            let others = dots.iter().chain(&placed).chain(&line).map(|other| rect.overlap(*other)).sum::<i64>();
            // Leaving the plot is worse than covering something in it.
            others + 4 * (rect.area() - rect.overlap(bounds))
        };
        let best = candidates(point).into_iter().min_by_key(hidden);
        placed.extend(best);
    }
    placed
}

/// Small squares along a line, a few pixels apart.
fn along(line: &[(i32, i32)]) -> Vec<Rect> {
    let square = |x: i32, y: i32| Rect([x - 3, y - 3, x + 3, y + 3]);
    let mut squares = Vec::new();
    for ends in line.windows(2) {
        let ((x, y), (dx, dy)) = (ends[0], (ends[1].0 - ends[0].0, ends[1].1 - ends[0].1));
        let steps = (dx.abs().max(dy.abs()) / 6).max(1);
        squares.extend((0..steps).map(|i| square(x + dx * i / steps, y + dy * i / steps)));
    }
    squares
}

/// Places around a point, the preferred first.
fn candidates((x, y, width, height): (i32, i32, i32, i32)) -> Vec<Rect> {
    let at = |left: i32, top: i32| Rect([left, top, left + width, top + height]);
    let (right, left, middle) = (x + POINT + 3, x - POINT - 3 - width, x - width / 2);
    let (level, above, below) = (y - height / 2, y - POINT - height, y + POINT);
    let mut places = vec![at(right, level), at(left, level), at(middle, above), at(middle, below)];
    for step in 1..=4 {
        let shift = step * (height / 2 + 1);
        places.extend([at(right, level - shift), at(right, level + shift), at(left, level - shift), at(left, level + shift)]);
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Rect = Rect([0, 0, 400, 300]);

    #[test]
    fn a_lone_label_stands_to_the_right() {
        let placed = place(&[(100, 100, 60, 14)], &[], BOUNDS);
        assert_eq!(placed, [Rect([109, 93, 169, 107])]);
    }

    #[test]
    fn a_label_at_the_right_edge_goes_to_the_left() {
        let Rect([_, _, right, _]) = place(&[(390, 100, 60, 14)], &[], BOUNDS)[0];
        assert!(right < 390);
    }

    #[test]
    fn a_label_leaves_the_line_free() {
        let line = [(10, 90), (100, 100), (300, 110)];
        let placed = place(&[(100, 100, 60, 14)], &line, BOUNDS)[0];
        assert!(along(&line).iter().all(|square| placed.overlap(*square) == 0), "{placed:?}");
    }

    #[test]
    fn neighbours_do_not_cover_each_other() {
        let points: Vec<_> = (0..6).map(|i| (200 + 2 * i, 100 + 3 * i, 80, 14)).collect();
        let placed = place(&points, &[], BOUNDS);
        for (i, a) in placed.iter().enumerate() {
            assert!(placed[..i].iter().all(|b| a.overlap(*b) == 0), "{placed:?}");
        }
    }
}
