//! The scenes that come with the program: that they load, and that they are what their headers promise.

use std::path::Path;

use glam::{DMat4, DVec2, DVec3};

use crate::scene::fuzz::assert_drawable;
use crate::scene::{Frame, Pattern, SHIPPED, Scene};

const SIZES: [[u32; 2]; 4] = [[320, 180], [640, 360], [321, 181], [5, 3]];

fn frame(name: &str, size: [u32; 2]) -> (Scene, Frame) {
    let scene = Scene::load(name).unwrap();
    let frame = scene.frame(0, size).unwrap();
    (scene, frame)
}

/// All triangles on the picture, in pixels, y down.
fn triangles_px(frame: &Frame, size: [u32; 2]) -> Vec<[DVec2; 3]> {
    let size = DVec2::new(f64::from(size[0]), f64::from(size[1]));
    let on_picture = |clip: &DMat4, p: DVec3| {
        let p = clip.project_point3(p);
        DVec2::new(p.x * 0.5 + 0.5, 0.5 - p.y * 0.5) * size
    };
    frame
        .instances
        .iter()
        .flat_map(|instance| {
            let clip = frame.view.clip_from_object(&instance.world_from_object, size.x / size.y);
            instance.mesh.triangles().map(|t| t.map(|v| on_picture(&clip, v.position))).collect::<Vec<_>>()
        })
        .collect()
}

/// Whether two triangles share area: no line along one of their edges parts them.
fn overlap(a: &[DVec2; 3], b: &[DVec2; 3]) -> bool {
    let parted = |a: &[DVec2; 3], b: &[DVec2; 3]| {
        (0..3).any(|k| {
            let normal = (a[(k + 1) % 3] - a[k]).perp().normalize();
            let span = |t: &[DVec2; 3]| {
                let along = t.map(|p| p.dot(normal));
                (along.iter().copied().fold(f64::INFINITY, f64::min), along.iter().copied().fold(f64::NEG_INFINITY, f64::max))
            };
            let ((a_low, a_high), (b_low, b_high)) = (span(a), span(b));
            a_high <= b_low + 1e-9 || b_high <= a_low + 1e-9
        })
    };
    !parted(a, b) && !parted(b, a)
}

#[test]
fn every_scene_file_is_shipped_and_says_what_it_tests() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut files: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter_map(|name| name.strip_suffix(".toml").map(str::to_owned))
        .collect();
    files.sort();
    let mut names: Vec<&str> = SHIPPED.iter().map(|shipped| shipped.name).collect();
    names.sort_unstable();
    assert_eq!(files, names);
    for shipped in SHIPPED {
        let header: String = shipped.text.lines().take_while(|line| line.starts_with('#')).collect();
        assert!(header.starts_with(&format!("# {}: ", shipped.name)), "{}", shipped.name);
        assert!(header.contains("Tests: ") && header.contains("Right: "), "{}", shipped.name);
        assert!((10..=90).contains(&shipped.about().len()), "{}: {}", shipped.name, shipped.about());
    }
}

#[test]
fn the_readme_shows_a_scene_that_loads_and_names_every_shape() {
    let readme = include_str!("../../../scenes/README.md");
    let example = readme.split("```").nth(1).unwrap().strip_prefix("toml").unwrap();
    assert!(Scene::parse(example, "README.md", Path::new("")).is_ok());
    let unknown = Scene::parse(&example.replace("box =", "no_such_shape ="), "README.md", Path::new("")).unwrap_err().to_string();
    let shapes: Vec<&str> = unknown.split('`').skip(3).step_by(2).collect();
    assert!(shapes.len() >= 16, "{unknown}");
    for shape in shapes {
        assert!(readme.contains(&format!("| `{shape}` |")), "{shape}");
    }
}

#[test]
fn every_shipped_scene_loads_and_draws_its_frames_with_few_triangles() {
    for shipped in SHIPPED {
        let scene = Scene::load(shipped.name).unwrap();
        assert_eq!((scene.name.as_str(), scene.about.as_str()), (shipped.name, shipped.about().as_str()));
        assert!(scene.warnings.is_empty());
        for index in [0, 1, scene.frames / 2, scene.frames - 1].into_iter().filter(|&index| index < scene.frames) {
            let frame = scene.frame(index, [320, 180]).unwrap();
            assert!(!frame.instances.is_empty(), "{}", shipped.name);
            assert_drawable(&scene, &frame);
            let triangles: usize = frame.instances.iter().map(|instance| instance.mesh.indices.len() / 3).sum();
            assert!(triangles < 20_000, "{} draws {triangles} triangles", shipped.name);
        }
    }
}

#[test]
fn in_edges_and_wires_nothing_overlaps_and_everything_is_on_the_picture() {
    for name in ["edges", "wires", "far"] {
        for size in [[320, 180], [640, 360]] {
            let (scene, frame) = frame(name, size);
            let triangles = triangles_px(&frame, size);
            assert!((100..=200).contains(&triangles.len()), "{name}: {}", triangles.len());
            for (k, a) in triangles.iter().enumerate() {
                assert!(
                    a.iter().all(|p| p.cmpgt(DVec2::ZERO).all() && p.cmplt(DVec2::new(size[0].into(), size[1].into())).all())
                );
                assert!(triangles[k + 1..].iter().all(|b| !overlap(a, b)), "{name} at {size:?}");
            }
            let plain = |k: usize| scene.materials[k].unlit && scene.materials[k].pattern == Pattern::None;
            assert!(frame.instances.iter().all(|instance| plain(instance.material)), "{name} has constant colours");
        }
    }
}

#[test]
fn edges_has_a_wedge_at_every_angle() {
    let (_, frame) = frame("edges", [320, 180]);
    let mut angles_deg: Vec<f64> = triangles_px(&frame, [320, 180])
        .iter()
        .map(|[tip, right, left]| {
            let axis = (*right + *left) * 0.5 - *tip;
            axis.y.atan2(axis.x).to_degrees()
        })
        .collect();
    angles_deg.sort_by(f64::total_cmp);
    assert_eq!(angles_deg.len(), 104);
    let pitch = 360.0 / 104.0;
    assert!(angles_deg.windows(2).all(|pair| (pair[1] - pair[0] - pitch).abs() < 1e-6), "{angles_deg:?}");
}

#[test]
fn far_is_edges_to_a_millionth_of_a_pixel() {
    for size in SIZES {
        let (edges, far) = (frame("edges", size).1, frame("far", size).1);
        let (edges, far) = (triangles_px(&edges, size), triangles_px(&far, size));
        assert_eq!(edges.len(), far.len());
        for (near, far) in edges.iter().flatten().zip(far.iter().flatten()) {
            assert!(near.distance(*far) < 1e-6, "{near} {far}");
        }
    }
}

#[test]
fn the_wires_have_their_widths_at_any_size() {
    let widths = [0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0, 1.3, 1.6, 2.0];
    for size in SIZES {
        let (_, frame) = frame("wires", size);
        assert_eq!(frame.instances.len(), 60);
        for (k, pair) in triangles_px(&frame, size).chunks_exact(2).enumerate() {
            // A strip's first two triangles are (a, b, c) and (a, c, d): from a to d is across.
            let across = pair[0][0].distance(pair[1][2]);
            assert!((across - widths[k / 6]).abs() < 1e-6, "wire {k} is {across} px wide");
        }
    }
}

#[test]
fn text_stands_on_the_pixel_grid_at_any_size() {
    for size in SIZES {
        let (_, frame) = frame("text", size);
        for corner in triangles_px(&frame, size).iter().flatten() {
            assert!(corner.distance(corner.round()) < 1e-6, "{corner} in {size:?}");
        }
    }
}

#[test]
fn the_zone_plate_fills_the_picture_and_reaches_the_nyquist_limit_at_its_border() {
    let (scene, frame) = frame("zoneplate", [320, 180]);
    let Pattern::ZonePlate { phase } = scene.materials[frame.instances[0].material].pattern else { panic!() };
    let (low, high) = frame.instances[0].mesh.bounds().unwrap();
    assert!(low.cmple(DVec3::new(-160.0, -90.0, 0.0)).all() && high.cmpge(DVec3::new(160.0, 90.0, 0.0)).all());
    let cycles_per_pixel = f64::from(phase) * 160.0 / std::f64::consts::PI;
    assert!((cycles_per_pixel - 0.5).abs() < 1e-6, "{cycles_per_pixel}");
}

#[test]
fn stars_are_smaller_than_a_pixel_and_drift_by_fractions_of_one() {
    let (scene, frame) = frame("stars", [320, 180]);
    for [a, b, c] in triangles_px(&frame, [320, 180]) {
        let mut sides = [a.distance(b), b.distance(c), c.distance(a)];
        sides.sort_by(f64::total_cmp);
        assert!(sides[1] < 0.95, "{sides:?}");
    }
    let next = scene.frame(1, [320, 180]).unwrap();
    for (now, next) in frame.instances.iter().zip(&next.instances) {
        let step = next.world_from_object.translation.distance(now.world_from_object.translation);
        assert!(step > 0.05 && step < 0.7, "{step}");
    }
}

#[test]
fn neon_shines_a_hundred_times_brighter_than_white() {
    let (scene, frame) = frame("neon", [320, 180]);
    assert!(frame.instances.iter().all(|instance| scene.materials[instance.material].emissive.max_element() == 100.0));
    assert_eq!(scene.background, glam::Vec3::ZERO);
}

#[test]
fn the_fast_wheel_turns_nearly_one_spoke_a_frame() {
    let scene = Scene::load("wheel").unwrap();
    let x_axis = |index| {
        let frame = scene.frame(index, [320, 180]).unwrap();
        let wheel = frame.instances.iter().find(|i| scene.object_name(i.id) == Some("fast wheel")).unwrap();
        wheel.world_from_object.matrix3.x_axis
    };
    let turn_deg = x_axis(0).angle_between(x_axis(1)).to_degrees();
    assert!((turn_deg - 14.2).abs() < 1e-9, "{turn_deg} of the 15 degrees between two spokes");
}
