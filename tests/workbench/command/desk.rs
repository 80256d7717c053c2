//! Running the command in a folder of its own.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use tempfile::TempDir;

use crate::common::adapter;

/// Whatever takes longer hangs.
const PATIENCE: Duration = Duration::from_secs(120);

/// The options that make a score small.
pub(super) const SMALL: &str = "--size 32x18 --reference ssaa:spp=16 --repeats 1";

/// A folder to work in, with a cache of its own beside it.
pub(super) struct Desk {
    folder: TempDir,
    aside: TempDir,
}

/// A command that has ended.
pub(super) struct Ran {
    /// None if a signal ended it.
    pub(super) code: Option<i32>,
    pub(super) stdout: String,
    pub(super) stderr: String,
    pub(super) took: Duration,
    line: String,
}

/// A command that may still run; killed if nobody waits for it.
pub(super) struct Running {
    child: Child,
    streams: TempDir,
    since: Instant,
    line: String,
}

impl Desk {
    pub(super) fn new() -> Self {
        let folder = || tempfile::tempdir().expect("a temporary folder");
        Self { folder: folder(), aside: folder() }
    }

    pub(super) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(super) fn cache(&self) -> PathBuf {
        self.aside.path().join("cache")
    }

    /// The references in the cache.
    pub(super) fn references(&self) -> Vec<PathBuf> {
        let listing = fs::read_dir(self.cache()).into_iter().flatten();
        let paths = listing.map(|entry| entry.expect("a listed entry").path());
        paths.filter(|path| path.extension().is_some_and(|ending| ending == "reference")).collect()
    }

    pub(super) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).unwrap_or_else(|error| panic!("{name}: {error}"));
    }

    pub(super) fn make_folder(&self, name: &str) {
        fs::create_dir(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    }

    pub(super) fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// Everything in the folder and below, hidden files too.
    pub(super) fn names(&self) -> Vec<String> {
        names_below(self.folder.path(), "")
    }

    /// The command with these arguments, which hold no spaces.
    pub(super) fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_dejag"));
        command.args(arguments.split_whitespace());
        self.furnish(&mut command);
        command
    }

    /// The same under limits that a shell can set, such as `ulimit -v 500000`.
    pub(super) fn limited(&self, limits: &str, arguments: &str) -> Command {
        let mut command = Command::new("sh");
        command.args(["-c", &format!("{limits} && exec \"$@\""), "sh", env!("CARGO_BIN_EXE_dejag")]);
        command.args(arguments.split_whitespace());
        self.furnish(&mut command);
        command
    }

    fn furnish(&self, command: &mut Command) {
        command.current_dir(self.folder.path()).stdin(Stdio::null());
        command.env("DEJAG_CACHE_DIR", self.cache()).env("DEJAG_ADAPTER", adapter()).env_remove("NO_COLOR");
    }

    pub(super) fn run(&self, arguments: &str) -> Ran {
        self.run_command(self.command(arguments))
    }

    pub(super) fn run_command(&self, command: Command) -> Ran {
        self.start(command).end()
    }

    pub(super) fn start(&self, mut command: Command) -> Running {
        let streams = tempfile::tempdir().expect("a temporary folder");
        let stream = |name: &str| File::create(streams.path().join(name)).expect("a new file");
        command.stdout(stream("stdout")).stderr(stream("stderr"));
        let line = format!("{command:?}");
        let child = command.spawn().unwrap_or_else(|error| panic!("{line}: {error}"));
        Running { child, streams, since: Instant::now(), line }
    }

    /// The command must end with this code and say these words on stderr, print nothing, and leave the folder as it was.
    pub(super) fn refuses(&self, arguments: &str, code: i32, words: &[&str]) -> Ran {
        self.refuses_command(self.command(arguments), code, words)
    }

    pub(super) fn refuses_command(&self, command: Command, code: i32, words: &[&str]) -> Ran {
        let before = self.names();
        let ran = self.run_command(command);
        ran.failed(code, words);
        assert_eq!(ran.stdout, "", "{ran}");
        assert_eq!(self.names(), before, "something was left behind by {ran}");
        ran
    }
}

impl Ran {
    pub(super) fn succeeded(&self) -> &Self {
        assert_eq!(self.code, Some(0), "{self}");
        self
    }

    /// Ended with this code and one error that says each of these.
    pub(super) fn failed(&self, code: i32, words: &[&str]) -> &Self {
        assert_eq!(self.code, Some(code), "{self}");
        assert!(self.stderr.starts_with("error: ") || self.stderr.contains("\nerror: "), "{self}");
        for word in words {
            assert!(self.stderr.contains(word), "'{word}' is not said by {self}");
        }
        assert!(!self.stderr.contains("panicked"), "{self}");
        assert!(self.stderr.matches("os error").count() <= 1, "said twice by {self}");
        self
    }

    /// What `--json -` printed.
    pub(super) fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("not JSON ({error}): {self}"))
    }
}

impl std::fmt::Display for Ran {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { code, stdout, stderr, took, line } = self;
        write!(f, "{line}\ncode {code:?} after {took:?}\nstdout: {stdout}\nstderr: {stderr}")
    }
}

impl Running {
    pub(super) fn stderr(&self) -> String {
        self.stream("stderr")
    }

    fn stream(&self, name: &str) -> String {
        let bytes = fs::read(self.streams.path().join(name)).expect("the stream's file");
        String::from_utf8(bytes).expect("the command speaks UTF-8")
    }

    /// Waits until something is so, which must happen before the command ends.
    pub(super) fn until(&mut self, what: &str, happened: impl Fn(&Self) -> bool) {
        while !happened(self) {
            let ended = self.child.try_wait().expect("a child of ours");
            assert!(ended.is_none(), "it ended before {what}: {}\n{}", self.line, self.stderr());
            self.lose_patience(what);
            sleep(Duration::from_millis(10));
        }
    }

    /// Sends a signal by its name, such as `INT`, and starts the watch anew.
    #[cfg(unix)]
    pub(super) fn signal(&mut self, name: &str) {
        let ended = self.child.try_wait().expect("a child of ours");
        assert!(ended.is_none(), "it ended before SIG{name}: {}\n{}", self.line, self.stderr());
        let sent = Command::new("kill").args([format!("-{name}"), self.child.id().to_string()]).status();
        assert!(sent.expect("kill runs").success());
        self.since = Instant::now();
    }

    /// Kills it, if it still runs.
    pub(super) fn kill(&mut self) {
        self.child.kill().expect("a child of ours");
    }

    pub(super) fn end(mut self) -> Ran {
        let status = loop {
            if let Some(status) = self.child.try_wait().expect("a child of ours") {
                break status;
            }
            self.lose_patience("its end");
            sleep(Duration::from_millis(2));
        };
        let took = self.since.elapsed();
        let (stdout, stderr) = (self.stream("stdout"), self.stream("stderr"));
        Ran { code: status.code(), stdout, stderr, took, line: self.line.clone() }
    }

    fn lose_patience(&self, what: &str) {
        assert!(self.since.elapsed() < PATIENCE, "waited in vain for {what}: {}\n{}", self.line, self.stderr());
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // Both fail if it has ended, as it should have.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn names_below(folder: &Path, prefix: &str) -> Vec<String> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let entry = entry.expect("a listed entry");
        let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
        if entry.file_type().expect("a listed entry's kind").is_dir() {
            names.extend(names_below(&entry.path(), &format!("{name}/")));
        }
        names.push(name);
    }
    names.sort();
    names
}
