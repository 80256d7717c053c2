//! Puts meshes together from corners, quads and curved grids.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3, Vec4};

use crate::scene::{Mesh, Vertex};

/// A triangle whose height is this part of its longest edge, or less, is left out: it covers nothing and has no normal.
const FLATTEST: f64 = 1e-9;

/// A mesh under construction.
#[derive(Debug, Default)]
pub(super) struct Builder {
    mesh: Mesh,
}

impl Builder {
    /// A corner; the bitangent, along which v grows, is normal x tangent. Returns its index.
    pub(super) fn vertex(&mut self, position: DVec3, normal: DVec3, tangent: DVec3, uv: DVec2) -> u32 {
        self.corner(corner(position, normal, tangent, uv))
    }

    /// A corner as it is. Returns its index.
    pub(super) fn corner(&mut self, vertex: Vertex) -> u32 {
        self.mesh.vertices.push(vertex);
        self.mesh.vertices.len() as u32 - 1
    }

    /// A triangle of three corners, counter-clockwise from the front; none where it would be degenerate.
    pub(super) fn triangle(&mut self, corners: [u32; 3]) {
        let [a, b, c] = corners.map(|index| self.mesh.vertices[index as usize].position);
        let longest = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
        if (b - a).cross(c - a).length() > FLATTEST * longest {
            self.mesh.indices.extend(corners);
        }
    }

    /// Two triangles of four corners, counter-clockwise from the front.
    pub(super) fn quad(&mut self, [a, b, c, d]: [u32; 4]) {
        self.triangle([a, b, c]);
        self.triangle([a, c, d]);
    }

    /// A rectangle around `centre` spanned by two perpendicular half edges, seen from `right` x `up`; uv in metres from its centre.
    pub(super) fn rectangle(&mut self, centre: DVec3, right: DVec3, up: DVec3) {
        let (tangent, normal) = (right.normalize(), right.cross(up).normalize());
        let half = DVec2::new(right.length(), up.length());
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, y)| self.vertex(centre + x * right + y * up, normal, tangent, half * DVec2::new(x, y)));
        self.quad(corners);
    }

    /// A flat convex polygon in the plane z = `z`, seen from above (`up` is +1) or from below (-1); uv is (x, y) in metres.
    /// The points run counter-clockwise seen from above.
    pub(super) fn polygon(&mut self, points: &[DVec2], z: f64, up: f64) {
        let corners: Vec<u32> =
            points.iter().map(|p| self.vertex(p.extend(z), DVec3::Z * up, DVec3::X * up, DVec2::new(p.x * up, p.y))).collect();
        for pair in corners.windows(2).skip(1) {
            let [a, b] = [pair[0], pair[1]];
            self.triangle(if up > 0.0 { [corners[0], a, b] } else { [corners[0], b, a] });
        }
    }

    /// A surface over [0, 1]^2 in `columns` x `rows` cells; its front is where the first parameter grows right and the second up.
    pub(super) fn grid(&mut self, columns: u32, rows: u32, at: impl Fn(f64, f64) -> Vertex) {
        let first = self.mesh.vertices.len() as u32;
        for row in 0..=rows {
            for column in 0..=columns {
                self.corner(at(f64::from(column) / f64::from(columns), f64::from(row) / f64::from(rows)));
            }
        }
        let index = |column, row| first + row * (columns + 1) + column;
        for row in 0..rows {
            for column in 0..columns {
                let corners = [(column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)];
                self.quad(corners.map(|(column, row)| index(column, row)));
            }
        }
    }

    /// The mesh.
    pub(super) fn finish(self) -> Mesh {
        self.mesh
    }
}

/// A corner with the bitangent normal x tangent.
pub(super) fn corner(position: DVec3, normal: DVec3, tangent: DVec3, uv: DVec2) -> Vertex {
    Vertex { position, normal: normal.as_vec3(), tangent: tangent.as_vec3().extend(1.0), uv: uv.as_vec2(), color: Vec4::ONE }
}

/// The point of the unit circle at `turns` of a full turn; exact at the quarters, so that seams close and poles meet.
pub(super) fn circle(turns: f64) -> DVec2 {
    let turns = turns.rem_euclid(1.0);
    let quarter = (turns * 4.0).round();
    let (sin, cos) = ((turns - quarter * 0.25) * TAU).sin_cos();
    match quarter as u32 % 4 {
        0 => DVec2::new(cos, sin),
        1 => DVec2::new(-sin, cos),
        2 => DVec2::new(-cos, -sin),
        _ => DVec2::new(sin, -cos),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_circle_is_exact_at_the_quarters_and_right_between() {
        for (turns, x, y) in
            [(0.0, 1.0, 0.0), (0.25, 0.0, 1.0), (0.5, -1.0, 0.0), (0.75, 0.0, -1.0), (1.0, 1.0, 0.0), (-0.25, 0.0, -1.0)]
        {
            assert_eq!(circle(turns), DVec2::new(x, y), "{turns}");
        }
        for step in 0..360 {
            let turns = f64::from(step) / 360.0;
            assert!(circle(turns).distance(DVec2::from_angle(turns * TAU)) < 1e-15);
        }
    }

    #[test]
    fn degenerate_triangles_are_left_out() {
        let mut builder = Builder::default();
        let [a, b, c, d] =
            [DVec3::ZERO, DVec3::X, DVec3::X * 2.0, DVec3::Y].map(|p| builder.vertex(p, DVec3::Z, DVec3::X, DVec2::ZERO));
        builder.triangle([a, b, c]);
        builder.triangle([a, b, b]);
        builder.triangle([a, b, d]);
        assert_eq!(builder.finish().indices, [a, b, d]);
    }
}
