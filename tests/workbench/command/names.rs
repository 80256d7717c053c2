//! Names, numbers and sizes that do not exist, and methods that the adapter cannot run.

use std::time::Duration;

use super::desk::{Desk, SMALL};
use crate::common;

#[test]
fn an_unknown_name_is_2_and_the_nearest_is_suggested() {
    let desk = Desk::new();
    let expectations: [(&str, &[&str]); 12] = [
        ("capture edgs -o out.png", &["unknown scene 'edgs'", "did you mean 'edges'", "courtyard", ".gltf"]),
        ("capture edges -o out.png -m sssa", &["unknown method 'sssa'", "did you mean 'ssaa'", "none"]),
        ("capture edges -o out.png -m ssaa:sp=4", &["'sp'", "did you mean 'spp'", "pattern"]),
        ("capture edges -o out.png -m ssaa:pattern=haltn", &["'haltn'", "did you mean 'halton'", "rotated"]),
        ("capture edges -o out.png -m ssaa:filter=lanzcos", &["'lanzcos'", "did you mean 'lanczos'", "mitchell"]),
        ("capture edges -o out.png -m msaa:resolve=bx", &["'bx'", "did you mean 'box'"]),
        ("capture edges -o out.png --view depht --size 32x18", &["'depht'", "did you mean 'depth'", "motion"]),
        ("score edgs", &["unknown scene 'edgs'", "did you mean 'edges'"]),
        ("score edges -m nome", &["unknown method 'nome'", "did you mean 'none'"]),
        ("score edges --reference ssa:spp=4", &["unknown method 'ssa'", "did you mean 'ssaa'"]),
        ("list metric", &["'metric'", "'metrics'"]),
        ("man captur", &["unknown verb 'captur'", "did you mean 'capture'"]),
    ];
    for (arguments, words) in expectations {
        desk.refuses(arguments, 2, words);
    }
}

#[test]
fn options_out_of_their_range_are_2_with_the_range() {
    let desk = Desk::new();
    let expectations: [(&str, &[&str]); 12] = [
        ("ssaa:spp=0", &["spp=0", "1 to 4096"]),
        ("ssaa:spp=5000", &["spp=5000", "1 to 4096"]),
        ("ssaa:spp=-4", &["spp=-4", "1 to 4096"]),
        ("ssaa:spp=nan", &["spp=nan", "1 to 4096"]),
        ("ssaa:radius=inf", &["radius=inf", "radius takes"]),
        ("ssaa:spp", &["'spp' is no option", "NAME=VALUE"]),
        ("ssaa:spp=4,spp=5", &["spp is given twice"]),
        ("ssaa:", &["is no option", "NAME=VALUE"]),
        ("none:spp=4", &["none has no options"]),
        ("msaa:samples=3", &["2, 4, 8, 16"]),
        ("none+ssaa", &["only come first"]),
        ("none+", &["a method is missing", "METHOD+METHOD"]),
    ];
    for (method, words) in expectations {
        desk.refuses(&format!("capture edges -o out.png -m {method}"), 2, words);
        desk.refuses(&format!("score edges --json out.json -m {method}"), 2, words);
    }
}

#[test]
fn arguments_that_make_no_sense_are_2_and_say_how_to_write_them() {
    let desk = Desk::new();
    for size in ["0x5", "5x0", "nanx3", "3xinf", "-3x5", "3", "3x", "x", "1e3x5", "99999999999x1", "3x5x7", "3.5x2"] {
        desk.refuses(&format!("capture edges -o out.png --size={size}"), 2, &["WIDTHxHEIGHT", "at least 1"]);
        desk.refuses(&format!("score edges --json out.json --size={size}"), 2, &["WIDTHxHEIGHT"]);
    }
    let expectations: [(&str, &[&str]); 9] = [
        ("capture edges -o out.png --frame=-1", &["--frame", "-1"]),
        ("capture edges -o out.png --frame one", &["--frame", "one"]),
        ("capture edges -o out.png --bits 12", &["--bits", "8, 16"]),
        ("score edges --repeats 0", &["--repeats", "1..=1000"]),
        ("score edges --quiet --verbose", &["--quiet", "--verbose", "cannot be used with"]),
        ("score edges -m none -m none", &["none is given twice", "give it once"]),
        ("score edges fence edges", &["edges is given twice", "give it once"]),
        ("capture edges", &["--output"]),
        ("capture edges -o out.png --sizes 3x5", &["--sizes", "'--size'"]),
    ];
    for (arguments, words) in expectations {
        desk.refuses(arguments, 2, words);
    }
}

#[test]
fn a_frame_that_no_scene_has_is_2_before_any_is_drawn() {
    let desk = Desk::new();
    desk.refuses("capture edges -o out.png --frame 1", 2, &["edges", "no frame 1", "0 to 0"]);
    desk.refuses("capture pan -o out.png --frame 4000000000", 2, &["pan", "no frame 4000000000", "0 to "]);
    let score = format!("score pan edges -m none --frame 1 --json out.json --report report {SMALL}");
    desk.refuses(&score, 2, &["edges", "no frame 1", "0 to 0"]);
    assert!(desk.references().is_empty(), "pan was drawn before it was seen that edges has no such frame");
}

#[test]
fn an_exact_answer_that_a_scene_lacks_is_2_before_any_is_drawn() {
    let desk = Desk::new();
    let score = "score edges fence -m none --reference analytic --size 32x18 --json out.json --report report";
    desk.refuses(score, 2, &["fence has no analytic reference", "edges, far, wires and zoneplate"]);
}

#[test]
fn a_picture_larger_than_the_device_is_2_at_once() {
    let desk = Desk::new();
    let side = common::gpu().device.limits().max_texture_dimension_2d;
    let limit = side.to_string();
    for size in [format!("{0}x{0}", side + 1), format!("1x{}", side + 1), "4294967295x4294967295".into()] {
        for rest in
            ["capture edges -o out.png", "capture edges -o out.exr -m ssaa", "score edges fence --json out.json --report report"]
        {
            let ran = desk.refuses(&format!("{rest} --size {size}"), 2, &[&size, "largest side", &limit]);
            assert!(ran.took < Duration::from_secs(5), "{ran}");
        }
    }
}

/// A sample count that a method may ask for and the adapter lacks.
fn missing_count() -> Option<u32> {
    let has = common::gpu().sample_counts();
    [16, 8, 2].into_iter().find(|count| !has.contains(count))
}

#[test]
fn a_sample_count_that_the_adapter_lacks_is_an_error_that_lists_those_it_has() {
    let Some(count) = missing_count() else {
        println!("not applicable: this adapter has every sample count");
        return;
    };
    let desk = Desk::new();
    let has: Vec<String> = common::gpu().sample_counts().iter().map(u32::to_string).collect();
    let method = format!("msaa:samples={count}");
    let words = [format!("needs {count} samples"), has.join(", ")];
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    desk.refuses(&format!("capture edges -o out.png --size 32x18 -m {method}"), 2, &words);

    let beside = desk.run(&format!("score edges -m none -m {method} --json - {SMALL}"));
    let methods = &beside.succeeded().json()["scenes"][0]["methods"];
    assert_eq!((&methods[0]["status"], &methods[1]["status"]), (&"scored".into(), &"failed".into()), "{beside}");
    assert!(words.iter().all(|word| methods[1]["error"].to_string().contains(word)), "{beside}");

    let alone = desk.run(&format!("score edges -m {method} {SMALL}"));
    alone.failed(4, &["nothing was compared", "dejag doctor"]);
    assert!(words.iter().all(|word| alone.stdout.contains(word)), "the table says why: {alone}");
}

#[test]
fn an_adapter_that_is_not_there_is_3_and_lists_those_that_are() {
    let desk = Desk::new();
    let name = common::gpu().card.name;
    let words = ["no adapter's name contains 'Voodoo'", &name];
    desk.refuses("capture edges -o out.png --adapter Voodoo", 3, &words);
    desk.refuses("score edges --json out.json --report report --adapter Voodoo", 3, &words);
    desk.refuses("doctor --adapter Voodoo", 3, &words);
}
