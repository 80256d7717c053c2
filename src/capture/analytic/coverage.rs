//! Exact coverage: every triangle clipped to every pixel it touches.

use std::collections::HashMap;

use glam::{DVec2, DVec3, Vec3, Vec4};

use super::polygon::{Polygon, shared_area, signed_area, unit_slab};
use super::{Answer, screen_points};
use crate::picture::LinearPicture;
use crate::scene::{AlphaMode, Frame, Instance, Material, Pattern, Scene};

/// Shared area in square pixels below which two surfaces count as side by side.
const TOUCHING: f64 = 1e-9;

pub(super) fn exact(scene: &Scene, frame: &Frame, size: [u32; 2]) -> Answer<LinearPicture> {
    let mut canvas = Canvas::new(scene.background, size);
    for instance in &frame.instances {
        let material = &scene.materials[instance.material];
        let color = flat_color(material)?;
        let to_screen = screen_points(instance, &frame.view, size);
        for triangle in instance.mesh.triangles() {
            let corners = triangle.map(|v| to_screen(v.position));
            let polygon = corners.into_iter().collect::<Answer<Polygon>>()?;
            // Counter-clockwise with y up is counter-clockwise on the screen too: negative area where y points down.
            let mirrored = instance.world_from_object.matrix3.determinant() < 0.0;
            let faces_away = (signed_area(&polygon) > 0.0) != mirrored;
            if faces_away && !material.double_sided {
                continue;
            }
            let vertex_color = triangle[0].color;
            if triangle.iter().any(|v| v.color != vertex_color) {
                return Err("a surface's colour varies");
            }
            canvas.add(&polygon, (color * vertex_color).truncate())?;
        }
    }
    canvas.picture()
}

/// The one colour of a surface, if it has just one.
fn flat_color(material: &Material) -> Answer<Vec4> {
    let plain = material.unlit
        && material.pattern == Pattern::None
        && material.base_color_texture.is_none()
        && material.emissive_texture.is_none()
        && matches!(material.alpha, AlphaMode::Opaque);
    if plain {
        Ok(material.base_color + material.emissive.extend(0.0))
    } else {
        Err("a surface is lit, textured, patterned or cut out")
    }
}

/// Colour in f64 and what covers each pixel so far.
struct Canvas {
    size: [u32; 2],
    background: DVec3,
    pixels: Vec<DVec3>,
    /// What partly or wholly covers a pixel, to notice overlaps.
    covers: HashMap<(u32, u32), Vec<Polygon>>,
}

impl Canvas {
    fn new(background: Vec3, size: [u32; 2]) -> Self {
        let background = background.as_dvec3();
        Self { size, background, pixels: vec![background; size[0] as usize * size[1] as usize], covers: HashMap::new() }
    }

    fn add(&mut self, polygon: &Polygon, color: Vec3) -> Answer<()> {
        let step = color.as_dvec3() - self.background;
        for y in touched(polygon, 1, self.size[1]) {
            let row = unit_slab(polygon, 1, f64::from(y));
            for x in touched(&row, 0, self.size[0]) {
                let part = unit_slab(&row, 0, f64::from(x));
                let area = signed_area(&part).abs();
                if area == 0.0 {
                    continue;
                }
                self.pixels[(y * self.size[0] + x) as usize] += area * step;
                let covers = self.covers.entry((x, y)).or_default();
                if covers.iter().any(|other| shared_area(other, &part) > TOUCHING) {
                    return Err("surfaces overlap");
                }
                covers.push(part);
            }
        }
        Ok(())
    }

    fn picture(self) -> Answer<LinearPicture> {
        let pixels = self.pixels.iter().map(|p| p.as_vec3().extend(1.0).to_array()).collect();
        LinearPicture::new(self.size[0], self.size[1], pixels).map_err(|_| "the picture has no pixels")
    }
}

/// Pixels along an axis that a polygon may touch.
fn touched(polygon: &[DVec2], axis: usize, count: u32) -> std::ops::Range<u32> {
    let low = polygon.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
    let high = polygon.iter().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max);
    // Of nothing: infinities, which saturate to an empty range.
    let clamp = |x: f64| x.clamp(0.0, f64::from(count)) as u32;
    clamp(low.floor())..clamp(high.ceil())
}

/// How many outlines cross each pixel, row by row: 0 inside and outside, 1 on a clean edge, more where a tip or a thin part lies.
/// An outline is an edge that only one triangle of its mesh has.
///
/// # Errors
/// [`crate::Error::Request`] for a frame that the scene does not have or that crosses the near plane.
pub fn edges_crossing(scene: &Scene, frame: u32, size: [u32; 2]) -> crate::Result<Vec<u8>> {
    let drawn = scene.frame(frame, size)?;
    let mut counts = vec![0u8; size[0] as usize * size[1] as usize];
    for instance in &drawn.instances {
        let to_screen = screen_points(instance, &drawn.view, size);
        for [a, b] in outlines(instance) {
            let point = |p| to_screen(p).map_err(|why| crate::Error::Request(why.into()));
            let segment = [point(a)?, point(b)?];
            for y in touched(&segment, 1, size[1]) {
                for x in touched_in_row(segment, y, size[0]) {
                    let count = &mut counts[(y * size[0] + x) as usize];
                    *count = count.saturating_add(1);
                }
            }
        }
    }
    Ok(counts)
}

/// Columns whose pixel in row `y` the segment passes through.
fn touched_in_row([a, b]: [DVec2; 2], y: u32, width: u32) -> std::ops::Range<u32> {
    let along = b - a;
    let at = |level: f64| {
        if along.y == 0.0 { [0.0, 1.0] } else { [((level - a.y) / along.y).clamp(0.0, 1.0); 2] }
    };
    let (first, last) = (at(f64::from(y)), at(f64::from(y) + 1.0));
    touched(&[a + along * first[0], a + along * last[1]], 0, width)
}

fn outlines(instance: &Instance) -> Vec<[DVec3; 2]> {
    let key = |p: DVec3| p.to_array().map(f64::to_bits);
    let mut edges: Vec<([DVec3; 2], u32)> = Vec::new();
    let mut seen: HashMap<_, usize> = HashMap::new();
    for t in instance.mesh.triangles() {
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            let (a, b) = (t[a].position, t[b].position);
            let unordered = if key(a) < key(b) { (key(a), key(b)) } else { (key(b), key(a)) };
            let index = *seen.entry(unordered).or_insert_with(|| {
                edges.push(([a, b], 0));
                edges.len() - 1
            });
            edges[index].1 += 1;
        }
    }
    edges.into_iter().filter(|(_, count)| *count == 1).map(|(edge, _)| edge).collect()
}
