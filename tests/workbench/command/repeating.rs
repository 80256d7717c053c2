//! The same command twice gives the same bytes.

use serde_json::Value;

use super::desk::{Desk, Ran};
use crate::common;

const SCORE: &str = "score edges courtyard -m none -m msaa -m msaa:resolve=mitchell -m ssaa:spp=7,pattern=r2 \
                     --size 48x27 --reference ssaa:spp=16 --repeats 2";

/// Without what depends on the clock.
fn timeless(mut value: Value) -> Value {
    fn strip(value: &mut Value) {
        match value {
            Value::Object(map) => {
                map.remove("timing");
                map.values_mut().for_each(strip);
            }
            Value::Array(list) => list.iter_mut().for_each(strip),
            _ => {}
        }
    }
    strip(&mut value);
    value
}

fn results(ran: &Ran) -> Value {
    timeless(ran.succeeded().json())
}

/// Of a capture with each of some methods, in both formats.
fn pictures(desk: &Desk, threads: Option<&str>) -> Vec<Vec<u8>> {
    let mut pictures = Vec::new();
    for method in ["none", "msaa:samples=4,a2c=on", "ssaa:spp=16,filter=mitchell", "msaa:resolve=gaussian,weight=max3"] {
        for name in ["out.png", "out.exr"] {
            let mut command = desk.command(&format!("capture courtyard -m {method} --size 97x53 -o {name}"));
            if let Some(threads) = threads {
                command.env("LP_NUM_THREADS", threads);
            }
            desk.run_command(command).succeeded();
            pictures.push(desk.read(name));
        }
    }
    pictures
}

#[test]
fn pictures_are_the_same_bytes() {
    let desk = Desk::new();
    assert!(pictures(&desk, None) == pictures(&desk, None));
}

#[test]
fn results_are_the_same_outside_of_timing() {
    let desk = Desk::new();
    let run = || desk.run(&format!("{SCORE} --json - --no-cache"));
    assert_eq!(results(&run()), results(&run()));
}

#[test]
fn results_hold_no_clock_outside_of_timing() {
    let text = timeless(Desk::new().run(&format!("{SCORE} --json -")).succeeded().json()).to_string();
    for word in ["_ms", "seconds", "median", "cached", "clock", "unbeaten"] {
        assert!(!text.contains(&format!("{word}\"")), "'{word}' stands outside of timing");
    }
}

#[test]
fn the_softwares_threads_do_not_matter() {
    if !common::lavapipe_bits(&common::gpu(), "the_softwares_threads_do_not_matter") {
        return;
    }
    let desk = Desk::new();
    assert!(pictures(&desk, Some("1")) == pictures(&desk, Some("2")));
    let run = |threads: &str| {
        let mut command = desk.command(&format!("{SCORE} --json - --no-cache"));
        command.env("LP_NUM_THREADS", threads);
        desk.run_command(command)
    };
    assert_eq!(results(&run("1")), results(&run("2")));
}

#[test]
fn a_warm_cache_changes_nothing() {
    let desk = Desk::new();
    let files = |report: &str, options: &str| {
        desk.run(&format!("{SCORE} --report {report} {options}")).succeeded();
        let pictures = desk.names().into_iter().filter(|name| name.starts_with(&format!("{report}/pictures/")));
        let pictures: Vec<_> = pictures.map(|name| (name[report.len()..].to_owned(), desk.read(&name))).collect();
        let json = serde_json::from_slice(&desk.read(&format!("{report}/results.json"))).expect("JSON");
        (timeless(json), pictures)
    };
    let cold = files("cold", "");
    let warm = files("warm", "");
    let without = files("without", "--no-cache");
    assert_eq!(cold.1.len(), 2 * (1 + 4 * 2));
    assert_eq!(cold.0, warm.0);
    assert_eq!(cold.0, without.0);
    assert!(cold.1 == warm.1 && cold.1 == without.1, "a picture differs");
}

#[test]
fn the_command_that_results_name_makes_them_again() {
    let desk = Desk::new();
    let first = results(&desk.run(&format!("{SCORE} --json -")));
    let words: Vec<&str> = first["command"].as_array().expect("words").iter().filter_map(Value::as_str).collect();
    let again = results(&desk.run(&format!("{} --json -", words.join(" "))));
    assert_eq!(first, again);
    for (option, value) in [("--repeats", "2"), ("--size", "48x27"), ("--reference", "ssaa:spp=16"), ("--frame", "0")] {
        assert!(words.windows(2).any(|pair| pair == [option, value]), "{option} {value} is missing: {words:?}");
    }
}
