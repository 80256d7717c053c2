//! What holds for every shape, and what is known of single ones.

use glam::{DAffine3, DVec2, DVec3};

use crate::scene::{Mesh, Scene};

/// Each shape, and whether it is closed.
const SHAPES: &[(&str, bool)] = &[
    ("quad = { size = [2, 1] }", false),
    ("quad = { size = [2, 1], uv = 'unit' }", false),
    ("ground = { size = [2, 3] }", false),
    ("disk = { radius = 1.5 }", false),
    ("disk = { radius = 1.5, inner_radius = 1.0, segments = 7 }", false),
    ("polygon = { points = [[0, 0], [2, 0], [2, 1], [0.5, 1.5]] }", false),
    ("polygon = { points = [[0, 0], [0, 1], [1, 0]] }", false),
    ("wedges = { count = 13, inner_radius = 0.2, outer_radius = 2, width_deg = 9, start_deg = 5 }", false),
    ("box = { size = [1, 2, 3] }", true),
    ("sphere = { radius = 2, segments = 48 }", true),
    ("dome = { radius = 100 }", false),
    ("cylinder = { radius = 0.5, height = 2 }", true),
    ("cylinder = { radius = 0.5, top_radius = 0, height = 2 }", true),
    ("cylinder = { radius = 0.5, top_radius = 0.8, height = 2 }", true),
    ("torus = { radius = 1, tube_radius = 0.2 }", true),
    ("torus = { radius = 1, tube_radius = 0.2, arc_deg = 90 }", false),
    ("prism = { points = [[0, 0], [0, 1], [1, 0]], depth = 0.3 }", true),
    ("wheel = { radius = 1, rim_radius = 0.05, spokes = 12, spoke_radius = 0.02, hub_radius = 0.1, hub_width = 0.2 }", true),
    ("arch = { size = [3, 4, 0.5], opening = 2, spring = 2.5 }", false),
    ("text = { string = 'Ag!\\n~#', pixel = 0.125 }", false),
];

fn scene(shape: &str, rest: &str) -> Scene {
    let text = format!(
        "[camera]\nprojection = 'orthographic'\nheight = 9\nposition = [0, 0, 10]\ntarget = [0, 0, 0]\n[[objects]]\nshape = {{ {shape} }}\n{rest}\n"
    );
    Scene::parse(&text, "test.toml", "".as_ref()).unwrap()
}

fn mesh(shape: &str) -> Mesh {
    (*scene(shape, "").frame(0, [16, 9]).unwrap().instances[0].mesh).clone()
}

fn area(mesh: &Mesh) -> f64 {
    mesh.triangles().map(|[a, b, c]| 0.5 * (b.position - a.position).cross(c.position - a.position).length()).sum()
}

fn volume(mesh: &Mesh) -> f64 {
    mesh.triangles().map(|[a, b, c]| a.position.dot(b.position.cross(c.position)) / 6.0).sum()
}

/// What the renderer relies on.
fn check(mesh: &Mesh, what: &str) {
    assert!(!mesh.indices.is_empty() && mesh.indices.len().is_multiple_of(3), "{what}");
    assert!(mesh.indices.iter().all(|&index| (index as usize) < mesh.vertices.len()), "{what}");
    for vertex in &mesh.vertices {
        assert!(vertex.position.is_finite() && vertex.uv.is_finite() && vertex.color.is_finite(), "{what}");
        assert!((vertex.normal.length() - 1.0).abs() < 1e-5, "{what}: {:?}", vertex.normal);
        assert!((vertex.tangent.truncate().length() - 1.0).abs() < 1e-5, "{what}: {:?}", vertex.tangent);
        assert!(vertex.tangent.truncate().dot(vertex.normal).abs() < 1e-5, "{what}: {:?} {:?}", vertex.tangent, vertex.normal);
        assert!(vertex.tangent.w.abs() == 1.0, "{what}");
    }
    for [a, b, c] in mesh.triangles() {
        let (ab, ac) = (b.position - a.position, c.position - a.position);
        let face = ab.cross(ac).normalize();
        assert!(face.is_finite(), "{what}: a triangle without area");
        assert!(face.dot(a.normal.as_dvec3()) > 0.1, "{what}: {face} against {}", a.normal);
        // u grows along the tangent, v along the bitangent.
        let (uv1, uv2) = ((b.uv - a.uv).as_dvec2(), (c.uv - a.uv).as_dvec2());
        let determinant = uv1.perp_dot(uv2);
        if determinant.abs() > 1e-12 {
            let along_u = (ab * uv2.y - ac * uv1.y) / determinant;
            let along_v = (ac * uv1.x - ab * uv2.x) / determinant;
            let tangent = a.tangent.truncate().as_dvec3();
            let bitangent = a.normal.as_dvec3().cross(tangent) * f64::from(a.tangent.w);
            assert!(along_u.normalize().dot(tangent) > 0.4, "{what}: u runs along {along_u}, the tangent along {tangent}");
            assert!(along_v.normalize().dot(bitangent) > 0.4, "{what}: v runs along {along_v}, the bitangent along {bitangent}");
        }
    }
}

#[test]
fn every_shape_has_unit_normals_tangents_along_u_and_front_faces_outside() {
    for (shape, _) in SHAPES {
        check(&mesh(shape), shape);
    }
}

#[test]
fn closed_shapes_have_no_holes() {
    for (shape, closed) in SHAPES {
        if !closed {
            continue;
        }
        // The area vectors of a closed surface add up to nothing.
        let sum: DVec3 = mesh(shape).triangles().map(|[a, b, c]| (b.position - a.position).cross(c.position - a.position)).sum();
        assert!(sum.length() < 1e-9, "{shape}: {sum}");
    }
}

#[test]
fn areas_and_volumes_are_those_of_geometry() {
    use std::f64::consts::PI;
    let close = |value: f64, expected: f64, what: &str| {
        assert!((value / expected - 1.0).abs() < 0.02, "{what}: {value} against {expected}");
    };
    close(area(&mesh("quad = { size = [2, 3] }")), 6.0, "quad");
    close(area(&mesh("disk = { radius = 2, segments = 64 }")), 4.0 * PI, "disk");
    close(area(&mesh("disk = { radius = 2, inner_radius = 1, segments = 64 }")), 3.0 * PI, "ring");
    close(volume(&mesh("box = { size = [1, 2, 3] }")), 6.0, "box");
    close(volume(&mesh("sphere = { radius = 1, segments = 64 }")), 4.0 / 3.0 * PI, "sphere");
    close(volume(&mesh("cylinder = { radius = 1, height = 2, segments = 64 }")), 2.0 * PI, "cylinder");
    close(volume(&mesh("cylinder = { radius = 1, top_radius = 0, height = 3, segments = 64 }")), PI, "cone");
    close(
        volume(&mesh("torus = { radius = 2, tube_radius = 0.5, segments = 64, sides = 64 }")),
        2.0 * PI * PI * 2.0 * 0.25,
        "torus",
    );
    close(volume(&mesh("prism = { points = [[0, 0], [2, 0], [0, 2]], depth = 0.5 }")), 1.0, "prism");
    // Front and back without the opening, jambs, half of a tube, two ends and the top.
    let wall = 2.0 * (12.0 - 2.0 * 2.5 - 0.5 * PI) + 2.0 * 2.5 * 0.5 + PI * 0.5 + 2.0 * 4.0 * 0.5 + 3.0 * 0.5;
    close(area(&mesh("arch = { size = [3, 4, 0.5], opening = 2, spring = 2.5, segments = 64 }")), wall, "arch");
}

#[test]
fn wedges_lie_in_sectors_of_their_own() {
    let mesh = mesh("wedges = { count = 40, inner_radius = 0.5, outer_radius = 3, width_deg = 9, start_deg = 1 }");
    let triangles: Vec<[DVec2; 3]> = mesh.triangles().map(|t| t.map(|v| v.position.truncate())).collect();
    assert_eq!(triangles.len(), 40);
    for (k, triangle) in triangles.iter().enumerate() {
        let middle = DVec2::from_angle((1.0 + 9.0 * k as f64).to_radians());
        for corner in triangle {
            assert!(middle.angle_to(*corner).abs() <= 4.5_f64.to_radians() + 1e-9);
        }
    }
}

#[test]
fn a_unit_quad_spans_the_unit_square_of_uv() {
    let mesh = mesh("quad = { size = [2, 4], uv = 'unit' }");
    let uvs: Vec<[f32; 2]> = mesh.vertices.iter().map(|v| v.uv.to_array()).collect();
    assert_eq!(uvs, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
}

#[test]
fn joined_copies_are_one_mesh_that_looks_like_the_single_ones() {
    let rest = "position = [1, 2, 0]\nrotation_deg = [0, 0, 30]\nscale = [-2, 1, 1]\nrepeat = [{ count = 3, step = [5, 0, 0], rotate_deg = [0, 10, 0] }, { count = 2, step = [0, 5, 0], scale = 0.5 }]";
    let shape = "box = { size = [1, 2, 3] }";
    let single = scene(shape, rest).frame(0, [16, 9]).unwrap();
    let joined = scene(shape, &format!("{rest}\njoin = true")).frame(0, [16, 9]).unwrap();
    assert_eq!((single.instances.len(), joined.instances.len()), (6, 1));
    check(&joined.instances[0].mesh, "joined");
    assert_eq!(joined.instances[0].world_from_object, DAffine3::IDENTITY);
    let expected: Vec<DVec3> = single
        .instances
        .iter()
        .flat_map(|instance| instance.mesh.vertices.iter().map(|v| instance.world_from_object.transform_point3(v.position)))
        .collect();
    let positions: Vec<DVec3> = joined.instances[0].mesh.vertices.iter().map(|v| v.position).collect();
    assert_eq!(positions.len(), expected.len());
    for (position, expected) in positions.iter().zip(&expected) {
        assert!(position.distance(*expected) < 1e-9);
    }
    assert!(volume(&joined.instances[0].mesh) > 0.0, "mirrored boxes are turned right side out");
}

#[test]
fn joined_copies_of_something_that_moves_move_together() {
    let rest =
        "position = [1, 0, 0]\nmotion = { velocity = [60, 0, 0] }\nrepeat = [{ count = 2, step = [0, 3, 0] }]\njoin = true";
    let mut moving = scene("box = { size = [1, 1, 1] }", rest);
    moving.frames = 2;
    let frame = moving.frame(1, [16, 9]).unwrap();
    let instance = &frame.instances[0];
    assert!(instance.world_from_object.translation.distance(DVec3::X * 2.0) < 1e-12);
    assert!(instance.previous_world_from_object.translation.distance(DVec3::X) < 1e-12);
    let (low, high) = instance.mesh.bounds().unwrap();
    assert_eq!((low.y, high.y), (-0.5, 3.5));
}

#[test]
fn pixel_text_has_whole_coordinates() {
    let mesh = mesh("text = { string = 'odd Line', pixel = 1, align = 'center' }");
    assert!(mesh.vertices.iter().all(|v| v.position == v.position.round()));
}
