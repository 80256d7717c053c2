//! What can be held of files that only run elsewhere: the action for GitHub, and what docs/ci.md says to copy.

use std::collections::BTreeSet;
use std::fs;
use std::process::Command;

fn read(name: &str) -> String {
    fs::read_to_string(format!("{}/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn indent(line: &str) -> usize {
    line.len() - line.trim_start().len()
}

/// The scripts of a workflow: `run: LINE`, or `run: |` with what is indented below it.
fn scripts(yaml: &str) -> Vec<String> {
    let lines: Vec<&str> = yaml.lines().collect();
    let mut scripts = Vec::new();
    for (number, line) in lines.iter().enumerate() {
        let Some(script) = line.trim_start_matches([' ', '-']).strip_prefix("run: ") else { continue };
        if script != "|" {
            scripts.push(script.to_owned());
            continue;
        }
        let own = line.find("run:").expect("found before");
        let below = lines[number + 1..].iter().take_while(|line| line.trim().is_empty() || indent(line) > own);
        scripts.push(below.map(|line| line.trim_start().to_owned() + "\n").collect());
    }
    scripts
}

/// Whether a shell takes it for a script. Nothing is run.
fn check_syntax(shell: &str, script: &str) {
    let output = Command::new(shell).args(["-n", "-c", script]).output().expect("a shell");
    assert!(output.status.success(), "{}\n{script}", String::from_utf8_lossy(&output.stderr));
}

/// Names that stand behind `before` in `${{ }}` and `if:`.
fn names_behind(before: &str, yaml: &str) -> BTreeSet<String> {
    let name = |rest: &str| rest.chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '-').collect();
    yaml.match_indices(before).map(|(at, _)| name(&yaml[at + before.len()..])).collect()
}

/// The keys right below a key of the first column.
fn keys_below(key: &str, yaml: &str) -> BTreeSet<String> {
    let section = yaml.split_once(&format!("\n{key}:\n")).expect("a section").1;
    let section = section.lines().take_while(|line| line.is_empty() || line.starts_with(' '));
    section.filter(|line| indent(line) == 2).filter_map(|line| Some(line.trim().strip_suffix(':')?.to_owned())).collect()
}

#[cfg(unix)]
#[test]
fn scripts_are_sound_and_nothing_from_outside_is_part_of_them() {
    for (name, count) in [("action.yml", 4), ("docs/ci/github.yml", 1)] {
        let scripts = scripts(&read(name));
        assert_eq!(scripts.len(), count, "{name}: {scripts:#?}");
        for script in scripts {
            assert!(!script.contains("${{"), "an expression becomes part of a script: {script}");
            check_syntax("bash", &script);
        }
    }
    check_syntax("bash", &read("docs/ci/slurm.sh"));
}

#[cfg(unix)]
#[test]
fn arguments_reach_the_program_one_a_line_and_its_exit_code_is_kept() {
    use std::os::unix::fs::PermissionsExt as _;
    let yaml = read("action.yml");
    let script = scripts(&yaml).into_iter().find(|script| script.contains("dejag\" check")).expect("the check");
    let desk = super::desk::Desk::new();
    desk.write("bin/dejag", "#!/bin/sh\nprintf '%s\\n' \"$@\" > said\nexit 3\n");
    fs::set_permissions(desk.path("bin/dejag"), fs::Permissions::from_mode(0o755)).expect("made a program");
    let mut bash = Command::new("bash");
    bash.args(["-e", "-o", "pipefail", "-c", &script]).current_dir(desk.path(""));
    bash.envs([("PROGRAM", "."), ("MANIFEST", "a b.toml"), ("SHARD", "2/4"), ("OUTPUT", "out"), ("GITHUB_OUTPUT", "outputs")]);
    bash.envs([("DEJAG_CACHE_DIR", "c/r"), ("MESA_SHADER_CACHE_DIR", "c/s"), ("ARGS", "edges/*\n\n$(touch broken) `id`; \"\n")]);
    let output = bash.output().expect("bash runs");
    assert_eq!(output.status.code(), Some(3), "{}", String::from_utf8_lossy(&output.stderr));
    let said = fs::read_to_string(desk.path("said")).expect("it was called");
    let wanted = "check --manifest|a b.toml|--output out --report out/report --junit out/junit.xml \
        --shard 2/4 edges/*|$(touch broken) `id`; \"";
    let joined: Vec<&str> = wanted.split('|').collect();
    let words = [joined[0].split(' ').collect(), vec![joined[1]], joined[2].split(' ').collect(), vec![joined[3]]].concat();
    assert_eq!(said.lines().collect::<Vec<_>>(), words);
    assert_eq!(fs::read_to_string(desk.path("outputs")).expect("written"), "exit-code=3\n");
}

/// What is handed to the command in the action, in files to copy and in the documentation exists.
#[test]
fn options_that_are_used_exist() {
    let help = |verb: &str| super::desk::Desk::new().dejag(&format!("{verb} --help")).stdout;
    let known = ["check", "merge", "bless"].map(help).concat();
    let is_ours = |line: &&str| {
        ["dejag check", "dejag merge", "dejag bless", "arguments", "--shard", "exec dejag"].iter().any(|word| line.contains(word))
    };
    let mut used = BTreeSet::new();
    for file in ["action.yml", "docs/ci/github.yml", "docs/ci/slurm.sh", "docs/ci.md", "docs/check.md", "README.md"] {
        let text = read(file);
        for line in text.lines().filter(is_ours) {
            let words = line.split(|c: char| !(c.is_ascii_alphanumeric() || c == '-'));
            used.extend(words.filter(|word| word.len() > 3 && word.starts_with("--")).map(ToOwned::to_owned));
        }
    }
    let unknown: Vec<&String> = used.iter().filter(|option| !known.contains(option.as_str())).collect();
    assert!(unknown.is_empty(), "{unknown:?}");
    assert!(used.len() > 10, "{used:?}");
}

#[test]
fn inputs_are_declared_and_used_and_other_actions_have_a_version() {
    let action = read("action.yml");
    assert_eq!(keys_below("inputs", &action), names_behind("inputs.", &action));
    for yaml in [action, read("docs/ci/github.yml")] {
        let used: Vec<&str> = yaml.lines().filter_map(|line| Some(line.split_once("uses: ")?.1)).collect();
        assert!(used.len() >= 4 && used.iter().all(|action| action.contains('@')), "{used:?}");
    }
}
