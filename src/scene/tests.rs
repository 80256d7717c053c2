//! Scenes as a whole: what a file says, what it may not say, and what stands where at a frame.

use std::path::Path;
use std::sync::Arc;

use glam::{DVec3, Vec3};

use super::*;

mod shipped;

const CAMERA: &str = "[camera]\nprojection = 'perspective'\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\n";

fn parse(text: &str) -> Result<Scene> {
    Scene::parse(text, "s.toml", Path::new(""))
}

/// A scene of one object.
fn with_object(object: &str) -> String {
    format!("{CAMERA}[[objects]]\n{object}\n")
}

/// The error's line and column, and its words.
fn refused(text: &str) -> (usize, usize, String) {
    match parse(text) {
        Err(Error::Document { path, line, column, message }) => {
            assert_eq!(path, "s.toml");
            (line, column, message)
        }
        Err(other) => panic!("{other:?}\n{text}"),
        Ok(_) => panic!("this was accepted:\n{text}"),
    }
}

#[test]
fn defaults_are_what_the_documentation_says() {
    let scene = parse(&with_object("shape = { quad = { size = [1, 1] } }")).unwrap();
    assert_eq!((scene.name.as_str(), scene.frames, scene.exposure), ("s", 1, 1.0));
    assert_eq!(scene.time_step, 1.0 / 60.0);
    assert_eq!((scene.tone_map, scene.background, scene.ambient), (ToneMap::Clamp, Vec3::ZERO, Vec3::ZERO));
    assert_eq!(scene.materials, [Material::default()]);
    let frame = scene.frame(0, [64, 36]).unwrap();
    assert_eq!(frame.view, frame.previous_view);
    assert_eq!(frame.instances.len(), 1);
    assert_eq!(frame.instances[0].id, 1);
}

#[test]
fn what_is_wrong_is_named_with_its_line_and_column() {
    let object = |object: &str| with_object(object);
    let quad = "shape = { quad = { size = [1, 1] } }";
    let cases: &[(String, (usize, usize), &str)] = &[
        ("frames = 1\n".into(), (1, 1), "missing field `camera`"),
        (CAMERA.into(), (1, 1), "nothing to draw"),
        (format!("frames = 0\n{CAMERA}[[objects]]\n{quad}"), (1, 10), "expected 1 to"),
        (format!("frames = -3\n{CAMERA}[[objects]]\n{quad}"), (1, 10), "expected a whole number from 0"),
        (format!("time_step = 0\n{CAMERA}[[objects]]\n{quad}"), (1, 13), "expected 0.000001 to"),
        (format!("framez = 1\n{CAMERA}[[objects]]\n{quad}"), (1, 1), "unknown field `framez`"),
        (format!("background = [0, 0]\n{CAMERA}[[objects]]\n{quad}"), (1, 14), "three linear numbers"),
        (format!("background = [0, -1, 0]\n{CAMERA}[[objects]]\n{quad}"), (1, 18), "-1 is out of range"),
        (format!("background = '#12'\n{CAMERA}[[objects]]\n{quad}"), (1, 14), "expected \"#rrggbb\""),
        (format!("exposure_ev = inf\n{CAMERA}[[objects]]\n{quad}"), (1, 15), "inf is not a number"),
        (format!("tone_map = 'filmic'\n{CAMERA}[[objects]]\n{quad}"), (1, 12), "expected one of `clamp`"),
        ("camera = 3\n".into(), (1, 10), "expected a table"),
        (object("shape = 3"), (6, 9), "a table with a name as its only key"),
        (object("shape = 'quad'"), (6, 9), "this name as its key"),
        (object("shape = { quad = {}, box = {} }"), (6, 9), "only one key"),
        (object("shape = { quad = { size = ['1', 1] } }"), (6, 28), "expected a number"),
        (object(&format!("{quad}\nmaterial = 3")), (7, 12), "a material: the name of one"),
        (object("shape = { quad = { size = [1, 0] } }"), (6, 31), "too small"),
        (object("shape = { quad = { size = [-1, 1] } }"), (6, 28), "too small"),
        (object("shape = { quad = { size = [1, nan] } }"), (6, 31), "nan is not a number"),
        (object("shape = { quad = { size = [1, 1e300] } }"), (6, 31), "1e300 is not a number"),
        (object("shape = { quad = { size = [1, 1, 1] } }"), (6, 27), "an array of 2 numbers"),
        (object("shape = { quad = { sise = [1, 1] } }"), (6, 20), "unknown field `sise`"),
        (object("shape = { quod = { size = [1, 1] } }"), (6, 11), "unknown variant `quod`"),
        (object("shape = { polygon = { points = [] } }"), (6, 32), "0 points; expected 3"),
        (object("shape = { polygon = { points = [[0, 0], [1, 1], [2, 2]] } }"), (6, 32), "no area"),
        (object("shape = { polygon = { points = [[0, 0], [2, 0], [1, 0.2], [1, 2]] } }"), (6, 32), "not convex"),
        (object("shape = { polygon = { points = [[0, 0], [2, 0], [2, 0], [1, 2]] } }"), (6, 49), "coincide"),
        (object("shape = { polygon = { points = [[0,10],[6,-8],[-9,3],[9,3],[-6,-8]] } }"), (6, 32), "crosses itself"),
        (object("shape = { sphere = { radius = 1, segments = 2 } }"), (6, 45), "expected 3 to 1024"),
        (
            object("shape = { wedges = { count = 9, inner_radius = 1, outer_radius = 2, width_deg = 41 } }"),
            (6, 81),
            "expected 0.001 to 40",
        ),
        (object("shape = { wire = { points = [[0, 0, 0], [1, 0, 0]] } }"), (6, 18), "either width_px or width_m"),
        (object("shape = { wire = { points = [[0, 0, 0]], width_m = 1 } }"), (6, 29), "1 points; expected 2"),
        (object("shape = { wire = { points = [[0, 0, 0], [0, 0, 0]], width_m = 1 } }"), (6, 41), "coincides"),
        (object("shape = { text = { string = 'é', pixel = 1 } }"), (6, 29), "'é'"),
        (object("shape = { text = { string = ' ', pixel = 1 } }"), (6, 29), "a text of 1 to"),
        (object(&format!("{quad}\nscale = 0")), (7, 9), "too close to 0"),
        (object(&format!("{quad}\nscale = [1, 0, 1]")), (7, 9), "too close to 0"),
        (object(&format!("{quad}\nscale = [1, 1]")), (7, 9), "one number or three"),
        (object(&format!("{quad}\nmaterial = 'gold'")), (7, 12), "unknown material 'gold'"),
        (object(&format!("{quad}\nmaterial = {{ colour = [1, 1, 1] }}")), (7, 14), "unknown field `colour`"),
        (object(&format!("{quad}\nmaterial = {{ roughness = 1.5 }}")), (7, 26), "expected 0 to 1"),
        (object(&format!("{quad}\nmaterial = {{ color = [1, 1, -2] }}")), (7, 29), "out of range"),
        (
            object(&format!("{quad}\nmaterial = {{ pattern = {{ checker = {{ cell = 0, other = [0, 0, 0] }} }} }}")),
            (7, 45),
            "too small",
        ),
        (object(&format!("{quad}\nmaterial = {{ pattern = 'plaid' }}")), (7, 24), "unknown variant `plaid`"),
        (object(&format!("{quad}\nrepeat = [{{ count = 0 }}]")), (7, 21), "expected 1 to"),
        (object(&format!("{quad}\nrepeat = [{{ count = 300 }}, {{ count = 300 }}]")), (7, 38), "too many"),
        (object(&format!("{quad}\nrepeat = [{{ count = 3000, scale = 2 }}]")), (7, 35), "times as large"),
        (object(&format!("{quad}\nscatter = {{ count = 70000, min = [0, 0, 0], max = [1, 1, 1] }}")), (7, 21), "too many"),
        (object(&format!("{quad}\nscatter = {{ count = 7, min = [0, 2, 0], max = [1, 1, 1] }}")), (7, 47), "below that of `min`"),
        (
            object(&format!("{quad}\nscatter = {{ count = 7, min = [0, 0, 0], max = [1, 1, 1], scale = [2, 1] }}")),
            (7, 66),
            "not a range",
        ),
        (
            object(&format!("{quad}\nscatter = {{ count = 7, min = [0, 0, 0], max = [1, 1, 1], shade = [1, 2] }}")),
            (7, 66),
            "join = true",
        ),
        (object(&format!("{quad}\nmotion = {{ spin_axis = [0, 0, 0], spin_deg_per_s = 1 }}")), (7, 24), "no length"),
        (object(&format!("{quad}\nmotion = {{ keyframes = [{{ time = 1 }}, {{ time = 1 }}] }}")), (7, 48), "not after"),
        (object(&format!("{quad}\nmotion = {{ keyframes = [{{ time = 1, scale = 0 }}] }}")), (7, 45), "too close to 0"),
        (object(&format!("{quad}\nmotion = {{ keyframes = [{{ time = 1, scale = -1 }}] }}")), (7, 45), "changes its sign"),
        (object("shape = { gltf = { path = 'no.glb' } }\nmaterial = {}"), (7, 12), "its own materials"),
        (object("shape = { quad = { size = [1, 1] } "), (6, 35), "inline table"),
    ];
    let mut wrong = Vec::new();
    for (text, place, words) in cases {
        let (line, column, message) = refused(text);
        if !message.contains(words) || (line, column) != *place {
            wrong.push(format!("{line}:{column}: {message}\n  expected {place:?} and: {words}\n{text}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn cameras_and_lights_that_make_no_sense_are_refused_where_they_stand() {
    let scene = |camera: &str| format!("[camera]\n{camera}\n[[objects]]\nshape = {{ quad = {{ size = [1, 1] }} }}\n");
    let pose = "position = [0, 0, 5]\ntarget = [0, 0, 0]";
    let cases: &[(String, (usize, usize), &str)] = &[
        (scene("projection = 'perspective'"), (1, 1), "position"),
        (scene("projection = 'fisheye'"), (2, 14), "unknown variant"),
        (scene(&format!("projection = 'perspective'\nfov_y_deg = 0\n{pose}")), (3, 13), "0.01 to 179"),
        (scene(&format!("projection = 'perspective'\nfov_y_deg = 180\n{pose}")), (3, 13), "0.01 to 179"),
        (scene(&format!("projection = 'perspective'\nfov_y_deg = nan\n{pose}")), (3, 13), "nan"),
        (scene(&format!("projection = 'perspective'\nnear = -1\n{pose}")), (3, 8), "too small"),
        (scene(&format!("projection = 'perspective'\nheight = 3\n{pose}")), (3, 10), "means nothing"),
        (scene(&format!("projection = 'orthographic'\n{pose}")), (1, 1), "needs `height`"),
        (scene(&format!("projection = 'orthographic'\nheight = 0\n{pose}")), (3, 10), "too small"),
        (scene(&format!("projection = 'pixels'\nnear = 5\nfar = 5\n{pose}")), (4, 7), "not behind"),
        (scene("projection = 'perspective'\nposition = [1, 1, 1]\ntarget = [1, 1, 1]"), (4, 10), "stands on its target"),
        (scene(&format!("projection = 'perspective'\nup = [0, 0, 0]\n{pose}")), (3, 6), "no length"),
        (
            scene(&format!(
                "projection = 'perspective'\n{pose}\nkeyframes = [{{ time = 0, position = [0, 0, 1], target = [0, 0, 0] }}]"
            )),
            (5, 13),
            "take the place",
        ),
        (format!("[light]\n{}", scene(&format!("projection = 'perspective'\n{pose}"))), (1, 1), "either `direction`"),
        (
            format!("[light]\nto_light = [0, 0, 0]\n{}", scene(&format!("projection = 'perspective'\n{pose}"))),
            (2, 12),
            "no length",
        ),
        (
            format!("[light]\nto_light = [0, 1, 0]\nintensity = -1\n{}", scene(&format!("projection = 'perspective'\n{pose}"))),
            (3, 13),
            "out of range",
        ),
    ];
    let mut wrong = Vec::new();
    for (text, place, words) in cases {
        let (line, column, message) = refused(text);
        if !message.contains(words) || (line, column) != *place {
            wrong.push(format!("{line}:{column}: {message}\n  expected {place:?} and: {words}\n{text}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_frame_that_does_not_exist_and_a_picture_without_pixels_are_refused() {
    let scene = parse(&format!("frames = 8\n{}", with_object("shape = { quad = { size = [1, 1] } }"))).unwrap();
    assert!(scene.frame(7, [1, 1]).is_ok());
    let error = scene.frame(8, [1, 1]).unwrap_err();
    assert_eq!(error.to_string(), "scene 's' has no frame 8; choose one from 0 to 7");
    assert!(matches!(scene.frame(0, [0, 9]), Err(Error::Request(_))));
}

#[test]
fn too_much_geometry_is_refused_before_it_is_made() {
    let joined = "shape = { sphere = { radius = 1, segments = 1024 } }\njoin = true\nrepeat = [{ count = 900000 }]";
    assert!(refused(&with_object(joined)).2.contains("at most 4000000"));
    let quads = "shape = { quad = { size = [1, 1] } }\nrepeat = [{ count = 40000 }]\n";
    let (line, _, message) = refused(&format!("{}[[objects]]\n{quads}", with_object(quads)));
    assert!(message.contains("more than 65535 instances"), "{message}");
    assert_eq!(line, 9);
}

#[test]
fn previous_transforms_are_those_of_the_frame_before() {
    let object = "shape = { quad = { size = [1, 1] } }\nmotion = { velocity = [6, 0, 0] }";
    let scene = parse(&format!("frames = 3\ntime_step = 0.5\n{}", with_object(object))).unwrap();
    let at = |index| scene.frame(index, [16, 9]).unwrap().instances[0].clone();
    assert_eq!(at(0).world_from_object, at(0).previous_world_from_object);
    assert_eq!(at(2).previous_world_from_object, at(1).world_from_object);
    assert_eq!(at(2).world_from_object.translation, DVec3::X * 6.0);
    assert!(Arc::ptr_eq(&at(0).mesh, &at(2).mesh), "a mesh that does not change is shared");
}

#[test]
fn ids_count_from_one_over_objects_and_copies_and_know_their_object() {
    let text = format!(
        "{CAMERA}[[objects]]\nname = 'post'\nshape = {{ quad = {{ size = [1, 1] }} }}\nrepeat = [{{ count = 3, step = [2, 0, 0] }}]\n\
         [[objects]]\nshape = {{ disk = {{ radius = 1 }} }}\n"
    );
    let scene = parse(&text).unwrap();
    let ids: Vec<u32> = scene.frame(0, [16, 9]).unwrap().instances.iter().map(|instance| instance.id).collect();
    assert_eq!(ids, [1, 2, 3, 4]);
    let names: Vec<Option<&str>> = (0..6).map(|id| scene.object_name(id)).collect();
    assert_eq!(names, [None, Some("post"), Some("post"), Some("post"), None, None]);
}

#[test]
fn rows_of_rows_stand_where_they_should() {
    let object = "position = [1, 0, 0]\nshape = { quad = { size = [1, 1] } }\nrotation_deg = [0, 0, 30]\n\
                  repeat = [{ count = 2, rotate_deg = [0, 0, 90], around = [0, 0, 0] }, { count = 2, step = [1, 0, 0], scale = 0.5 }]";
    let scene = parse(&with_object(object)).unwrap();
    let origins: Vec<DVec3> =
        scene.frame(0, [16, 9]).unwrap().instances.iter().map(|instance| instance.world_from_object.translation).collect();
    let expected = [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 2.0, 0.0]];
    for (origin, expected) in origins.iter().zip(expected) {
        assert!(origin.distance(expected.into()) < 1e-12, "{origins:?}");
    }
}

#[test]
fn copies_turn_on_the_spot_unless_they_turn_around_a_point() {
    let object = "position = [1, 0, 0]\nscale = [2, 1, 1]\nshape = { quad = { size = [1, 1] } }\nmotion = { velocity = [0, 1, 0] }\n\
                  repeat = [{ count = 2, step = [0, 0, 1], rotate_deg = [0, 0, 90] }]";
    let scene = parse(&format!("frames = 2\ntime_step = 1\n{}", with_object(object))).unwrap();
    let world = scene.frame(1, [16, 9]).unwrap().instances[1].world_from_object;
    assert!(world.transform_point3(DVec3::ZERO).distance(DVec3::new(1.0, 1.0, 1.0)) < 1e-12);
    assert!(world.transform_vector3(DVec3::X).distance(DVec3::Y * 2.0) < 1e-12);
}

#[test]
fn scattered_copies_stay_in_their_region_and_follow_their_seed() {
    let object = |seed| {
        format!(
            "position = [10, 0, 0]\nshape = {{ quad = {{ size = [1, 1] }} }}\n\
             scatter = {{ count = 200, seed = {seed}, min = [-2, -1, 0], max = [2, 1, 0], within = 'ellipsoid', scale = [0.5, 2] }}"
        )
    };
    let instances = |seed| parse(&with_object(&object(seed))).unwrap().frame(0, [16, 9]).unwrap().instances;
    for instance in instances(1) {
        let p = instance.world_from_object.translation - DVec3::X * 10.0;
        assert!((p.x / 2.0).powi(2) + p.y.powi(2) <= 1.0 + 1e-12 && p.z == 0.0);
        let size = instance.world_from_object.matrix3.x_axis.length();
        assert!((0.5..=2.0).contains(&size));
    }
    let places = |seed| instances(seed).iter().map(|i| i.world_from_object.translation).collect::<Vec<_>>();
    assert_eq!(places(1), places(1));
    assert_ne!(places(1), places(2));
}

#[test]
fn mirroring_is_allowed() {
    let scene = parse(&with_object("shape = { box = { size = [1, 1, 1] } }\nscale = [-1, 1, 1]")).unwrap();
    assert!(scene.frame(0, [16, 9]).unwrap().instances[0].world_from_object.matrix3.determinant() < 0.0);
}

#[test]
fn a_moving_wire_has_previous_transforms_that_move_its_ribbon_back() {
    let object = "shape = { wire = { points = [[-1, 0, 0], [1, 0, 0]], width_px = 2 } }\nmotion = { velocity = [0, 60, 0] }";
    let scene = parse(&format!("frames = 2\n{}", with_object(object))).unwrap();
    let frame = scene.frame(1, [160, 90]).unwrap();
    let instance = &frame.instances[0];
    let now: DVec3 = instance.mesh.vertices.iter().map(|v| v.position).sum::<DVec3>() / 4.0;
    assert!(now.distance(DVec3::Y) < 1e-12, "{now}");
    assert!(instance.previous_world_from_object.transform_point3(now).length() < 1e-12);
}

#[test]
fn the_fingerprint_follows_the_text() {
    let text = with_object("shape = { quad = { size = [1, 1] } }");
    let (one, same, other) = (parse(&text), parse(&text), parse(&format!("{text}\n# a remark")));
    assert_eq!(one.as_ref().unwrap().fingerprint, same.unwrap().fingerprint);
    assert_ne!(one.unwrap().fingerprint, other.unwrap().fingerprint);
}

#[test]
fn files_that_are_no_scene_are_the_worlds_fault() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bad.toml");
    let name = path.to_str().unwrap();
    assert!(matches!(Scene::load(name), Err(Error::Io { .. })));
    for bytes in [&b""[..], b" \n", b"\xff\xfe\x00", b"\x89PNG\r\n\x1a\n", b"a = 1\0", b"\xef\xbb\xbf"] {
        std::fs::write(&path, bytes).unwrap();
        let error = Scene::load(name).unwrap_err();
        assert!(matches!(error, Error::Format { .. }), "{error:?}");
        assert!(error.to_string().contains("bad.toml"));
    }
    assert!(matches!(Scene::load(&format!("{}.toml", folder.path().join("no/such").display())), Err(Error::Io { .. })));
    std::fs::create_dir(folder.path().join("folder.toml")).unwrap();
    assert!(matches!(Scene::load(folder.path().join("folder.toml").to_str().unwrap()), Err(Error::Io { .. })));
    // Cut in the middle of a line it is still text: the place of the cut is what helps.
    std::fs::write(&path, &SHIPPED[0].text[..SHIPPED[0].text.find("wedges = {").unwrap() + 12]).unwrap();
    assert!(matches!(Scene::load(name), Err(Error::Document { line, .. }) if line > 10));
    std::fs::write(&path, format!("\u{feff}{}", SHIPPED[0].text)).unwrap();
    assert!(Scene::load(name).is_ok(), "a byte order mark is fine");
}

#[test]
fn an_unknown_scene_lists_the_known_ones_and_says_that_paths_work() {
    let text = Scene::load("edgse").unwrap_err().to_string();
    assert!(text.contains("did you mean 'edges'?") && text.contains(".toml, .gltf or .glb"), "{text}");
    assert!(matches!(Scene::load("picture.png"), Err(Error::Request(_))));
    assert!(matches!(Scene::load(""), Err(Error::Request(_))));
}

#[test]
fn scenes_can_be_shared_between_threads() {
    fn shared<T: Send + Sync + Clone>() {}
    shared::<Scene>();
}
