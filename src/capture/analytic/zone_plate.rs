//! The zone plate: 0.5 + 0.5 cos(phase (u^2 + v^2)) over a pixel is made of the integrals of cos(phase u^2) and sin(phase u^2)
//! along each axis, because the cosine of a sum is a difference of products.

use glam::DVec2;

use super::{Answer, screen_points};
use crate::picture::LinearPicture;
use crate::scene::{Frame, Instance, Pattern, Scene, Vertex};

pub(super) fn exact(scene: &Scene, frame: &Frame, size: [u32; 2]) -> Answer<LinearPicture> {
    let [instance] = &frame.instances[..] else {
        return Err("there is more than the zone plate");
    };
    let material = &scene.materials[instance.material];
    let (Pattern::ZonePlate { phase }, true) = (material.pattern, material.unlit) else {
        return Err("the zone plate is lit");
    };
    let axes = uv_axes(instance, frame, size)?;
    let [columns, rows] =
        [0, 1].map(|axis| (0..size[axis]).map(|i| mean_phasor(f64::from(phase), axes[axis], f64::from(i))).collect::<Vec<_>>());
    let base = material.base_color.truncate().as_dvec3();
    let pixels = rows.iter().flat_map(|row| {
        columns.iter().map(move |column| {
            let value = 0.5 + 0.5 * (column.x * row.x - column.y * row.y);
            (base * value).as_vec3().extend(1.0).to_array()
        })
    });
    LinearPicture::new(size[0], size[1], pixels.collect()).map_err(|_| "the picture has no pixels")
}

/// A uv coordinate along a screen axis: value at pixel 0 and step a pixel.
#[derive(Clone, Copy)]
struct Axis {
    start: f64,
    step: f64,
}

/// u along x and v along y, if the surface fills the picture and its uv run straight along the picture's sides.
fn uv_axes(instance: &Instance, frame: &Frame, size: [u32; 2]) -> Answer<[Axis; 2]> {
    let to_screen = screen_points(instance, &frame.view, size);
    let mut axes: Option<[Axis; 2]> = None;
    let mut area = 0.0;
    for triangle in instance.mesh.triangles() {
        let points = triangle.map(|v: &Vertex| to_screen(v.position));
        let [a, b, c] = [points[0]?, points[1]?, points[2]?];
        let uv = triangle.map(|v| v.uv.as_dvec2());
        area += 0.5 * (b - a).perp_dot(c - a).abs();
        let found = [0, 1].map(|axis| axis_of([a, b, c], uv.map(|p| p[axis]), axis));
        let found = [found[0]?, found[1]?];
        let same = |x: Axis, y: Axis| (x.start - y.start).abs() + (x.step - y.step).abs() < 1e-9 * (1.0 + x.start.abs());
        if axes.is_some_and(|known| !same(known[0], found[0]) || !same(known[1], found[1])) {
            return Err("the zone plate is bent");
        }
        axes = Some(found);
    }
    let pixels = f64::from(size[0]) * f64::from(size[1]);
    if area < pixels * (1.0 - 1e-9) {
        return Err("the zone plate does not fill the picture");
    }
    axes.ok_or("the zone plate has no surface")
}

/// Solves value = start + step * screen[axis], and checks that the other screen axis has no part in it.
fn axis_of([a, b, c]: [DVec2; 3], values: [f64; 3], axis: usize) -> Answer<Axis> {
    let (ab, ac) = (b - a, c - a);
    let turn = ab.perp_dot(ac);
    let (db, dc) = (values[1] - values[0], values[2] - values[0]);
    let gradient = DVec2::new(db * ac.y - dc * ab.y, dc * ab.x - db * ac.x) / turn;
    if !gradient.is_finite() || gradient[1 - axis].abs() > 1e-9 * gradient[axis].abs() {
        return Err("the zone plate is turned");
    }
    Ok(Axis { start: values[0] - gradient[axis] * a[axis], step: gradient[axis] })
}

/// Mean of (cos, sin) of phase u^2 over pixel `i`.
fn mean_phasor(phase: f64, axis: Axis, i: f64) -> DVec2 {
    let at = |x: f64| {
        let u = axis.start + axis.step * x;
        let (sin, cos) = (phase * u * u).sin_cos();
        DVec2::new(cos, sin)
    };
    adaptive(&at, i, i + 1.0, 0)
}

/// Gauss-Legendre with 5 points over the whole against both halves; halves again where they disagree.
fn adaptive(f: &impl Fn(f64) -> DVec2, a: f64, b: f64, depth: u32) -> DVec2 {
    const TOLERANCE: f64 = 1e-12;
    const DEEPEST: u32 = 24;
    let middle = 0.5 * (a + b);
    let whole = gauss_5(f, a, b);
    let halves = gauss_5(f, a, middle) + gauss_5(f, middle, b);
    if (whole - halves).abs().max_element() < TOLERANCE || depth == DEEPEST {
        return halves;
    }
    adaptive(f, a, middle, depth + 1) + adaptive(f, middle, b, depth + 1)
}

/// Nodes and weights in closed form.
fn gauss_5(f: &impl Fn(f64) -> DVec2, a: f64, b: f64) -> DVec2 {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let root = |sign: f64| (5.0 + sign * 2.0 * (10.0f64 / 7.0).sqrt()).sqrt() / 3.0;
    let weight = |sign: f64| (322.0 + sign * 13.0 * 70.0f64.sqrt()) / 900.0;
    let pair = |node: f64| f(middle - half * node) + f(middle + half * node);
    half * (128.0 / 225.0 * f(middle) + weight(1.0) * pair(root(-1.0)) + weight(-1.0) * pair(root(1.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quadrature_meets_a_known_integral() {
        // The Fresnel integrals at 1: C(1) and S(1) of pi t^2 / 2.
        let phasor = adaptive(
            &|t| {
                let (s, c) = (0.5 * std::f64::consts::PI * t * t).sin_cos();
                DVec2::new(c, s)
            },
            0.0,
            1.0,
            0,
        );
        assert!((phasor.x - 0.779_893_400_376_822_8).abs() < 1e-12, "{phasor}");
        assert!((phasor.y - 0.438_259_147_390_354_8).abs() < 1e-12, "{phasor}");
    }
}
