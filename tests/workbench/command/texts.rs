//! What the command says of itself: help with examples that work, lists, completions, the manual.

use std::time::Duration;

use super::desk::Desk;
use crate::common;

const VERBS: [&str; 9] = ["capture", "filter", "score", "diff", "list", "doctor", "cache", "completions", "man"];
const LISTS: [&str; 6] = ["scenes", "methods", "filters", "patterns", "metrics", "measures"];

/// The examples in a verb's help, without `dejag` and without what a shell does with the output.
fn examples(desk: &Desk, arguments: &str) -> Vec<String> {
    let help = desk.run(&format!("{arguments} --help"));
    assert_eq!(help.succeeded().stderr, "", "{help}");
    let (_, after) = help.stdout.split_once("Examples:\n").unwrap_or_else(|| panic!("no examples: {help}"));
    let lines = after.lines().take_while(|line| !line.trim().is_empty());
    let commands = lines.filter_map(|line| line.trim().strip_prefix("dejag"));
    let commands: Vec<String> =
        commands.map(|line| line.split(['|', '>']).next().unwrap_or_default().trim().to_owned()).collect();
    assert!(!commands.is_empty(), "{help}");
    commands
}

fn all_examples(desk: &Desk) -> Vec<String> {
    std::iter::once("").chain(VERBS).flat_map(|verb| examples(desk, verb)).collect()
}

#[test]
fn every_example_is_understood() {
    let desk = Desk::new();
    // Help is shown for what was understood up to there, and for nothing else.
    for nonsense in ["capture edges --nonsense", "capture edges --size 3", "nonsense", "list nonsense"] {
        assert_eq!(desk.run(&format!("{nonsense} --help")).code, Some(2), "{nonsense}");
    }
    for example in all_examples(&desk) {
        desk.run(&format!("{example} --help")).succeeded();
    }
}

#[test]
fn every_method_and_scene_of_an_example_exists() {
    let desk = Desk::new();
    for example in all_examples(&desk) {
        let words: Vec<&str> = example.split_whitespace().collect();
        for pair in words.windows(2).filter(|pair| pair[0] == "-m") {
            desk.run(&format!("capture edges --size 8x8 -o out.png -m {}", pair[1])).succeeded();
        }
        if words[0] == "capture" && !words[1].contains('.') {
            desk.run(&format!("capture {} --size 8x8 -o out.png", words[1])).succeeded();
        }
    }
}

#[test]
fn examples_that_only_print_do_so() {
    let desk = Desk::new();
    let prints =
        |example: &&String| ["list", "doctor", "cache", "completions", "man"].iter().any(|verb| example.starts_with(verb));
    for example in all_examples(&desk).iter().filter(prints) {
        if example.contains("--adapter software") && common::adapter() != "software" {
            continue;
        }
        let ran = desk.run(example);
        assert!(!ran.succeeded().stdout.is_empty() && ran.stderr.is_empty(), "{ran}");
    }
}

#[test]
fn help_is_found_the_usual_ways() {
    let desk = Desk::new();
    for arguments in ["--help", "-h", "help"] {
        let ran = desk.run(arguments);
        assert!(VERBS[..8].iter().all(|verb| ran.succeeded().stdout.contains(verb)), "{ran}");
        assert!(ran.stdout.contains("Exit codes: 0"), "{ran}");
    }
    let bare = desk.run("");
    assert_eq!((bare.code, bare.stdout.as_str()), (Some(2), ""), "{bare}");
    assert!(bare.stderr.contains("Usage: dejag"), "{bare}");
    assert_eq!(desk.run("--version").succeeded().stdout, format!("dejag {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn help_is_wrapped_and_not_broken() {
    let desk = Desk::new();
    for verb in std::iter::once("").chain(VERBS) {
        let ran = desk.run(&format!("{verb} --help"));
        let lines: Vec<&str> = ran.succeeded().stdout.lines().collect();
        assert!(lines.iter().all(|line| line.chars().count() <= 100), "{ran}");
        // A line break in the source shows as a short line in the middle of a paragraph.
        let words = |line: &str| line.starts_with(|c: char| c.is_ascii_alphanumeric()) && !line.ends_with(':');
        for pair in lines.windows(2).filter(|pair| words(pair[0]) && words(pair[1])) {
            let next = pair[1].split(' ').next().unwrap_or_default();
            assert!(pair[0].chars().count() + 1 + next.chars().count() > 100, "broken after '{}'", pair[0]);
        }
    }
}

#[test]
fn lists_answer_quickly_in_words_and_json() {
    let desk = Desk::new();
    for what in LISTS {
        let words = desk.run(&format!("list {what}"));
        let json = desk.run(&format!("list {what} --json"));
        assert!(words.succeeded().stderr.is_empty() && json.succeeded().stderr.is_empty(), "{words}\n{json}");
        let entries = json.json();
        let entries = entries.as_array().expect("a list");
        assert!(!entries.is_empty());
        for entry in entries {
            let name = entry["name"].as_str().expect("a name");
            assert!(!entry["about"].as_str().expect("a line").is_empty(), "{name}");
            assert!(words.stdout.lines().any(|line| line.split_whitespace().next() == Some(name)), "{name} in {words}");
        }
        let took = (0..3).map(|_| desk.run(&format!("list {what}")).took).min().unwrap_or(words.took);
        println!("list {what}: {took:?}");
        assert!(took < Duration::from_millis(500), "list {what} took {took:?}");
    }
}

#[test]
fn listed_options_have_ranges_and_defaults_that_work() {
    let desk = Desk::new();
    let methods = desk.run("list methods --json").succeeded().json();
    for method in methods.as_array().expect("a list") {
        let name = method["name"].as_str().expect("a name");
        for option in method["options"].as_array().expect("options") {
            let word = |key: &str| option[key].as_str().unwrap_or_else(|| panic!("{key} of {option}"));
            assert!(!word("range").is_empty() && !word("about").is_empty(), "{option}");
            let spec = format!("{name}:{}={}", word("name"), word("default"));
            desk.run(&format!("capture edges --size 8x8 -o out.png -m {spec}")).succeeded();
        }
    }
}

#[test]
fn the_adapter_in_use_is_listed_and_examined() {
    let desk = Desk::new();
    let name = common::gpu().card.name;
    for arguments in ["list adapters", "list adapters --json", "doctor"] {
        let ran = desk.run(arguments);
        assert!(ran.succeeded().stdout.contains(&name) && ran.stderr.is_empty(), "{ran}");
    }
    let doctor = desk.run("doctor").stdout;
    for method in dejag::methods::METHODS {
        assert!(doctor.contains(&format!("  {:<8} ", method.name)), "{} in {doctor}", method.name);
    }
}

#[test]
fn completions_and_manuals_know_every_verb() {
    let desk = Desk::new();
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let ran = desk.run(&format!("completions {shell}"));
        assert!(VERBS[..8].iter().all(|verb| ran.succeeded().stdout.contains(verb)) && ran.stderr.is_empty(), "{shell}");
    }
    assert!(desk.run("man").succeeded().stdout.contains(".TH dejag 1"));
    for verb in VERBS {
        let ran = desk.run(&format!("man {verb}"));
        assert!(ran.succeeded().stdout.contains(&format!("dejag\\-{verb}")), "{ran}");
    }
}
