//! Running the command in a folder of its own.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use dejag::picture::{BitDepth, DisplayPicture};
use serde_json::Value;
use tempfile::TempDir;

use super::{junit, schema};

pub(super) struct Desk(TempDir);

/// A command that has ended.
pub(super) struct Ran {
    pub(super) code: Option<i32>,
    pub(super) stdout: String,
    pub(super) stderr: String,
}

impl Desk {
    pub(super) fn new() -> Self {
        Self(tempfile::tempdir().expect("a temporary folder"))
    }

    pub(super) fn path(&self, name: impl AsRef<Path>) -> PathBuf {
        self.0.path().join(name)
    }

    pub(super) fn write(&self, name: impl AsRef<Path>, bytes: impl AsRef<[u8]>) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        fs::write(path, bytes).expect("written");
    }

    /// Writes a PNG of 8 bits.
    pub(super) fn put(&self, name: impl AsRef<Path>, picture: &DisplayPicture) {
        let mut bytes = Vec::new();
        picture.encode_png(&mut bytes, BitDepth::Eight, &[]).expect("encoded");
        self.write(name, bytes);
    }

    /// Everything in the folder and below, in order.
    pub(super) fn names(&self) -> Vec<String> {
        let mut names = Vec::new();
        let mut folders = vec![self.path("")];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder).expect("a folder") {
                let path = entry.expect("an entry").path();
                names.push(path.strip_prefix(self.0.path()).expect("inside").to_string_lossy().into_owned());
                if path.is_dir() && !path.is_symlink() {
                    folders.push(path);
                }
            }
        }
        names.sort();
        names
    }

    /// The command, about to be run here.
    pub(super) fn command(&self) -> Command {
        self.furnished(Command::new(env!("CARGO_BIN_EXE_dejag")))
    }

    fn furnished(&self, mut command: Command) -> Command {
        command.current_dir(self.0.path()).stdin(Stdio::null());
        // Whatever runs the tests, it is not the user.
        for name in ["NO_COLOR", "GITHUB_ACTIONS", "GITHUB_STEP_SUMMARY"] {
            command.env_remove(name);
        }
        command
    }

    /// Sets what may be done with a file or a folder, as `chmod` does.
    #[cfg(unix)]
    pub(super) fn permit(&self, name: &str, mode: u32) {
        use std::os::unix::fs::PermissionsExt as _;
        fs::set_permissions(self.path(name), fs::Permissions::from_mode(mode)).expect("set");
    }

    /// `dejag` with the words of a line as arguments for somebody who is bound by permissions, as root is not until it gives that up.
    #[cfg(target_os = "linux")]
    pub(super) fn bound(&self, line: &str) -> Ran {
        use std::os::unix::fs::MetadataExt as _;
        if fs::metadata(self.path("")).expect("there").uid() != 0 {
            return self.dejag(line);
        }
        let mut command = Command::new("setpriv");
        command.args(["--bounding-set=-dac_override,-dac_read_search", env!("CARGO_BIN_EXE_dejag")]);
        Ran::of(self.furnished(command).args(line.split_whitespace()))
    }

    /// `dejag` with the words of a line as arguments.
    pub(super) fn dejag(&self, line: &str) -> Ran {
        Ran::of(self.command().args(line.split_whitespace()))
    }

    /// `dejag diff` with these arguments.
    pub(super) fn diff<A: AsRef<OsStr>>(&self, arguments: &[A]) -> Ran {
        Ran::of(self.command().arg("diff").args(arguments))
    }

    /// `dejag diff` with the words of a line as arguments.
    pub(super) fn line(&self, line: &str) -> Ran {
        self.diff(&line.split_whitespace().collect::<Vec<_>>())
    }

    /// What `--json -` prints, which must fit its schema, and the exit code.
    #[track_caller]
    pub(super) fn json(&self, line: &str) -> (i32, Value) {
        let ran = self.line(&format!("{line} --json -"));
        let json = ran.json();
        assert_eq!(schema::validate("diff", &json), Ok(()), "{ran}");
        (ran.code.expect("no signal"), json)
    }

    /// Holds a single pair against an outcome in every way there is to hear of it: exit code, text, JSON, and JUnit XML, which says
    /// what the text says. Answers the pair in JSON.
    #[track_caller]
    pub(super) fn comes_to(&self, line: &str, outcome: &str, code: i32, words: &[&str]) -> Value {
        let ran = self.line(&format!("{line} --verbose --junit junit.xml"));
        ran.ended(code, words);
        assert!(ran.stdout.starts_with(&format!("{outcome} ")), "{ran}");
        let (json_code, json) = self.json(line);
        let [pair] = &json["pairs"].as_array().expect("pairs")[..] else { panic!("one pair: {json}") };
        assert_eq!((json_code, &pair["outcome"]), (code, &outcome.into()));
        for (counted, count) in json["counts"].as_object().expect("counts") {
            assert_eq!(count, u64::from(counted == outcome), "{counted}");
        }
        self.junit_says(&ran, outcome);
        pair.clone()
    }

    /// The JUnit XML has one case, which passes, fails or errs by its outcome, in the words of the text.
    #[track_caller]
    fn junit_says(&self, ran: &Ran, outcome: &str) {
        let elements = junit::read(&fs::read_to_string(self.path("junit.xml")).expect("written"));
        let counts: [usize; 2] = match outcome {
            "same" => [0, 0],
            "unreadable" => [0, 1],
            _ => [1, 0],
        };
        let found = ["failure", "error"].map(|name| junit::named(&elements, name));
        assert_eq!(found.each_ref().map(Vec::len), counts, "{elements:?}");
        let [suite] = junit::named(&elements, "testsuite")[..] else { panic!("one suite: {elements:?}") };
        let stated = ["tests", "failures", "errors"].map(|key| suite.get(key).parse::<usize>().expect("a count"));
        assert_eq!(stated, [1, counts[0], counts[1]]);
        let (first, rest) = ran.stdout.split_once('\n').expect("a line");
        let [case] = junit::named(&elements, "testcase")[..] else { panic!("one case: {elements:?}") };
        assert_eq!(first.split_once(' ').map(|(_, name)| name.trim()), Some(case.get("name")));
        if let Some(verdict) = found.iter().flatten().next() {
            let joined = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
            assert_eq!((verdict.get("type"), joined(&verdict.text)), (outcome, joined(rest)));
            assert!(verdict.get("message") == outcome || verdict.text.starts_with(verdict.get("message")), "{verdict:?}");
        }
    }
}

impl Ran {
    pub(super) fn of(command: &mut Command) -> Self {
        let output = command.output().expect("it runs");
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("it speaks UTF-8");
        let ran = Self { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) };
        assert!(!ran.stderr.contains("panicked"), "{ran}");
        ran
    }

    /// Ended with this code, having said all of these on stdout or stderr.
    #[track_caller]
    pub(super) fn ended(&self, code: i32, words: &[&str]) -> &Self {
        assert_eq!(self.code, Some(code), "{self}");
        // Text is broken into lines where a word ends.
        let said = format!("{} {}", self.stdout, self.stderr).split_whitespace().collect::<Vec<_>>().join(" ");
        for word in words {
            let word = word.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(said.contains(&word), "'{word}' is not said by {self}");
        }
        self
    }

    pub(super) fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("not JSON ({error}): {self}"))
    }
}

impl std::fmt::Display for Ran {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "code {:?}\nstdout: {}\nstderr: {}", self.code, self.stdout, self.stderr)
    }
}

/// 32 x 24 pixels of 8 bits, no two neighbours alike.
pub(super) fn levels() -> Vec<u8> {
    (0..32 * 24).flat_map(|i: u32| [(i * 7 % 200 + 20) as u8, (i * 5 % 190 + 30) as u8, (i * 3 % 180 + 40) as u8, 255]).collect()
}

/// The picture of these levels.
pub(super) fn picture(levels: &[u8]) -> DisplayPicture {
    DisplayPicture::from_rgba8(32, 24, levels).expect("32x24")
}

/// That picture with some channels changed: column, row, channel, and by how much.
pub(super) fn changed(changes: &[(usize, usize, usize, i32)]) -> DisplayPicture {
    let mut levels = levels();
    for (x, y, channel, by) in changes {
        let level = &mut levels[4 * (y * 32 + x) + channel];
        *level = u8::try_from(i32::from(*level) + by).expect("a level");
    }
    picture(&levels)
}
