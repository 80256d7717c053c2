//! `dejag patterns` as a user runs it.

use serde_json::Value;

use super::desk::{Desk, Ran};

/// The row of a pattern in what `--json -` printed.
fn row(ran: &Ran, pattern: &str) -> Value {
    let rows = ran.succeeded().json();
    let found = rows.as_array().expect("a list").iter().find(|row| row["pattern"] == pattern);
    found.unwrap_or_else(|| panic!("no {pattern} in {ran}")).clone()
}

fn number(row: &Value, key: &str) -> f64 {
    row[key].as_f64().unwrap_or_else(|| panic!("no {key} in {row}"))
}

#[test]
fn a_table_has_plain_figures_and_comes_out_the_same_again() {
    let desk = Desk::new();
    let run = || desk.run("patterns table regular hammersley jittered --trials 4 --json -");
    let first = run();
    let regular = row(&first, "regular");
    assert!((number(&regular, "stroud") - 7.37199e-3).abs() < 1e-8, "{first}");
    assert!((number(&row(&first, "hammersley"), "stroud") - 0.805_623e-3).abs() < 1e-9, "{first}");
    assert_eq!((&regular["trials"], &regular["n"], &regular["stroud_variance"]), (&1.into(), &1024.into(), &0.0.into()));
    let jittered = row(&first, "jittered");
    assert_eq!(jittered["trials"], 4);
    let (mean, rms, variance) =
        (number(&jittered, "stroud"), number(&jittered, "stroud_rms"), number(&jittered, "stroud_variance"));
    // Of the mean of squares: the square of the mean and the variance of the four.
    assert!((rms * rms - mean * mean - 0.75 * variance).abs() < 1e-15 && variance > 0.0, "{first}");
    assert!(!first.stdout.contains("timing") && !first.stdout.contains("stroud_torus"), "{first}");
    assert_eq!(first.stdout, run().stdout);
    assert_ne!(first.stdout, desk.run("patterns table regular hammersley jittered --trials 4 --seed 9 --json -").stdout);
    assert_eq!(desk.names(), Vec::<String>::new(), "nothing was asked to be written");
}

#[test]
fn the_published_quadrature_and_the_torus_are_figures_of_their_own() {
    let desk = Desk::new();
    let lattice = row(&desk.run("patterns table --patterns regular --lattice 100 --json -"), "regular");
    assert!((number(&lattice, "stroud") - 7.4684e-3).abs() < 1e-7 && lattice["lattice"] == 100, "{lattice}");
    let torus = row(&desk.run("patterns table --patterns regular --torus --timing --json -"), "regular");
    assert!((number(&torus, "stroud_torus") - 10.42e-3).abs() < 1e-5 && torus["timing"]["generate_ms"].is_f64(), "{torus}");
}

#[test]
fn one_point_has_a_row_without_neighbours() {
    let desk = Desk::new();
    let ran = desk.run("patterns table regular random -n 1 --trials 3 --json figures.json");
    assert!(ran.succeeded().stdout.contains("regular"), "{ran}");
    let rows: Value = serde_json::from_slice(&desk.read("figures.json")).expect("JSON");
    assert!((number(&rows[0], "star") - 0.75).abs() < 1e-15 && rows[0]["nearest"].is_null(), "{rows}");
    assert_eq!(desk.names(), ["figures.json"]);
}

#[test]
fn what_makes_no_sense_is_2() {
    let desk = Desk::new();
    desk.write("white.png", white_png());
    let nan = image::Rgb32FImage::from_pixel(4, 4, image::Rgb([0.5, f32::NAN, 0.5]));
    nan.save(desk.path("nan.exr")).expect("written");
    for (arguments, words) in [
        ("patterns table -n 0", &["'0'", "1..=65536"][..]),
        ("patterns table -n 1000000000", &["'1000000000'", "1..=65536"]),
        ("patterns table --trials 0", &["--trials", "1..=100000"]),
        ("patterns table --lattice 0", &["--lattice"]),
        ("patterns table haltom", &["did you mean 'halton'?"]),
        ("patterns table halton,r2,halton", &["halton is given twice"]),
        ("patterns table --patterns lloyd:generation=3", &["did you mean 'generations'?"]),
        ("patterns table --patterns halton:base_x=1", &["base_x=1 is out of range"]),
        ("patterns draw -o picture.jpg", &["picture.jpg", ".png or .svg"]),
        ("patterns draw jittered --prefix 4,16 -o a.svg", &["--prefix", "only even as a whole", "mitchell"]),
        ("patterns draw --prefix 0 -o a.svg", &["--prefix", "'0'"]),
        ("patterns draw random --generation 3 -o a.svg", &["random has no parameters"]),
        ("patterns draw --density white.png -n 8 -o a.svg", &["all values are 0"]),
        ("patterns draw --density nan.exr -n 8 -o a.svg", &["NaN", "finite and at least 0"]),
        ("patterns discrepancy r2", &["--output"]),
        ("patterns spectrum r2 -n 16 -o a.pdf", &[".png or .svg"]),
        ("patterns integrate", &["<SCENE>"]),
        ("patterns integrate --test zones", &["did you mean 'zone'?"]),
        ("patterns integrate edges --test zone", &["cannot be used with"]),
        ("patterns integrate --test zone --spp 0", &["--spp"]),
        ("patterns integrate --test zone --pool 262144", &["--pool", "262144 sets of 1024 points"]),
        ("patterns integrate --test checker --yaw NaN", &["-180 to 180"]),
        ("patterns integrate --test zone --plot plot.png", &["plot.png", ".svg"]),
        ("patterns integrate edges --patterns halton:base_x=5", &["under their defaults"]),
        ("patterns report --patterns halton:base_x=5", &["under their defaults"]),
        ("patterns report --spp 0", &["--spp"]),
        ("patterns report --size 0x4", &["'0x4'"]),
    ] {
        desk.refuses(arguments, 2, words);
    }
}

#[test]
fn what_cannot_be_read_or_written_is_3() {
    let desk = Desk::new();
    desk.write("empty.png", b"");
    desk.refuses("patterns draw --density absent.png -o a.svg", 3, &["absent.png", "check the path"]);
    desk.refuses("patterns draw --density empty.png -o a.svg", 3, &["empty.png"]);
    desk.refuses("patterns draw -o absent/a.svg", 3, &["absent"]);
    desk.refuses("patterns table --json absent/a.json", 3, &["absent"]);
    desk.refuses("patterns integrate --test zone --csv absent/a.csv", 3, &["absent"]);
}

#[test]
fn pictures_are_what_their_names_say_and_the_same_again() {
    let desk = Desk::new();
    for (arguments, file) in [
        ("patterns draw random --prefix 4,16 -o a.svg", "a.svg"),
        ("patterns draw lloyd --generation 1,2 -n 64 -o b.png", "b.png"),
        ("patterns draw jittered --domain disk -n 64 -o c.svg", "c.svg"),
        ("patterns discrepancy hammersley r2 -n 64 --size 64 -o d.png", "d.png"),
        ("patterns discrepancy hammersley -n 64 --size 64 -o e.svg", "e.svg"),
        ("patterns spectrum jittered r2 -n 64 --trials 3 -o f.svg", "f.svg"),
        ("patterns spectrum jittered -n 64 --trials 3 -o g.png", "g.png"),
        ("patterns spectrum regular -n 1 -o h.svg", "h.svg"),
    ] {
        desk.run(arguments).succeeded();
        let bytes = desk.read(file);
        if file.ends_with("png") {
            assert!(image::load_from_memory(&bytes).expect("a PNG").width() > 64, "{arguments}");
        } else {
            assert!(bytes.starts_with(b"<svg ") && bytes.ends_with(b"</svg>"), "{arguments}");
        }
        desk.run(arguments).succeeded();
        assert_eq!(bytes, desk.read(file), "{arguments}");
    }
    let text = |file: &str| String::from_utf8(desk.read(file)).expect("UTF-8");
    assert_eq!(text("a.svg").matches("<circle").count(), 20);
    assert_eq!(text("c.svg").matches("<circle").count(), 64 + 1, "the points and the disk");
}

#[test]
fn a_photo_is_stippled_where_it_is_dark() {
    let desk = Desk::new();
    let half = image::GrayImage::from_fn(64, 64, |x, _| image::Luma([if x < 32 { 0 } else { 255 }]));
    half.save(desk.path("photo.png")).expect("written");
    desk.run("patterns draw random -n 200 --density photo.png --size 100 -o dots.svg").succeeded();
    let svg = String::from_utf8(desk.read("dots.svg")).expect("UTF-8");
    let places: Vec<f64> = svg.split("<circle cx=\"").skip(1).filter_map(|rest| rest.split('"').next()?.parse().ok()).collect();
    assert_eq!(places.len(), 200);
    assert!(places.iter().all(|x| *x <= 16.0 + 50.0), "no dot on white");
}

#[test]
fn spectra_and_integrals_have_figures() {
    let desk = Desk::new();
    let spectrum = row(&desk.run("patterns spectrum regular -n 256 --json -"), "regular");
    assert!(number(&spectrum, "low_half") < 1e-9 && number(&spectrum, "peak_frequency") == 1.0, "{spectrum}");
    assert_eq!(spectrum["radial_mean"].as_array().map(Vec::len), Some(32));

    let command = "patterns integrate --test halfplane --patterns random,jittered,regular --spp 4,16,64 --pool 500 --json -";
    let ran = desk.run(&format!("{command} --csv errors.csv --plot plot.svg"));
    let slope = |pattern: &str| number(&row(&ran, pattern), "slope");
    assert!((slope("random") + 0.5).abs() < 0.03 && (slope("jittered") + 0.75).abs() < 0.03, "{ran}");
    assert_eq!((&row(&ran, "random")["sets"], &row(&ran, "regular")["sets"]), (&"fresh".into(), &"fixed".into()));
    assert_eq!(String::from_utf8(desk.read("errors.csv")).expect("UTF-8").lines().count(), 1 + 9);
    assert_eq!(desk.names(), ["errors.csv", "plot.svg"]);
}

#[test]
fn shifted_sets_differ_from_fixed_ones() {
    let desk = Desk::new();
    let error = |options: &str| {
        let ran = desk.run(&format!("patterns integrate --test halfplane --patterns larcher --spp 16 --json - {options}"));
        number(&row(&ran, "larcher-pillichshammer")["errors"][0], "rms")
    };
    let (fixed, shifted) = (error(""), error("--shift"));
    // The shift costs a net a part of its evenness.
    assert!((1e3 * fixed / 33.8 - 1.0).abs() < 0.03 && (1e3 * shifted / 39.7 - 1.0).abs() < 0.03, "{fixed}, {shifted}");
}

#[test]
fn a_scene_is_integrated_by_drawing_it() {
    let desk = Desk::new();
    let command = "patterns integrate edges --patterns regular,random --spp 1,16 --size 64x36 --reference ssaa:spp=256";
    let ran = desk.run(&format!("{command} --json -"));
    let errors = |pattern: &str| [0, 1].map(|i| number(&row(&ran, pattern)["errors"][i], "rms"));
    let [one, sixteen] = errors("regular");
    assert!(one > 4.0 * sixteen && sixteen > 0.0, "{ran}");
    assert!(errors("random")[1] > sixteen, "{ran}");
    assert_eq!(row(&ran, "random")["sets"], "fixed");
}

#[test]
fn a_report_has_the_figures_that_were_measured_and_the_same_bytes_again() {
    let desk = Desk::new();
    let command = "patterns report --patterns regular,random,jittered --size 96x64 -o out";
    assert!(desk.run(command).succeeded().stdout.is_empty());
    let results: Value = serde_json::from_slice(&desk.read("out/results.json")).expect("JSON");
    let page = String::from_utf8(desk.read("out/index.html")).expect("UTF-8");
    let chapters = results["chapters"].as_array().expect("a list");
    let titles: Vec<_> = chapters.iter().map(|chapter| &chapter["title"]).collect();
    assert_eq!(titles, ["Moire", "Floor", "Zone plate"]);
    for series in chapters.iter().flat_map(|chapter| chapter["series"].as_array().expect("a list")) {
        let pictures = series["pictures"].as_array().expect("a list");
        let errors: Vec<f64> = pictures.iter().map(|picture| number(picture, "rms")).collect();
        assert!(errors.len() >= 2 && errors.windows(2).all(|pair| pair[0] > pair[1]), "{series}");
        for error in errors {
            assert!(page.contains(&format!("RMS {:.1},", 1e3 * error)), "{error} is not on the page");
        }
    }

    // The floor on the CPU is what `integrate` measures, that of the scene too.
    let of_floor = |pattern: &str, subject: u64| {
        let series = chapters[1]["series"].as_array().expect("a list").iter();
        let found = series.filter(|s| s["title"] == pattern && s["subject"] == subject).collect::<Vec<_>>();
        found[0]["pictures"].as_array().expect("a list").iter().map(|p| number(p, "rms")).collect::<Vec<f64>>()
    };
    for (subject, what) in [(0, "--test checker --pool 1024"), (1, "checker --size 96x64")] {
        let ran = desk.run(&format!("patterns integrate {what} --patterns random --spp 1,16,64 --json -"));
        let measured =
            row(&ran, "random")["errors"].as_array().expect("a list").iter().map(|e| number(e, "rms")).collect::<Vec<_>>();
        assert_eq!(measured, of_floor("random", subject), "{what}");
    }

    let files = || desk.names().into_iter().filter(|name| desk.path(name).is_file());
    let bytes = || files().map(|name| (desk.read(&name), name)).collect::<Vec<_>>();
    let first = bytes();
    desk.run(command).succeeded();
    assert!(first == bytes(), "other bytes");
}

#[test]
fn a_report_does_not_replace_what_is_no_report() {
    let desk = Desk::new();
    desk.make_folder("thesis");
    desk.write("thesis/thesis.tex", b"years of work");
    desk.refuses("patterns report -o thesis", 2, &["thesis", "name a new or empty folder"]);
}

fn white_png() -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::GrayImage::from_pixel(8, 8, image::Luma([255])).write_to(&mut bytes, image::ImageFormat::Png).expect("encoded");
    bytes.into_inner()
}
