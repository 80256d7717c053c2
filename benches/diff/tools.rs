//! The programs that are compared.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::options::Options;
use super::pictures::Pair;

/// A program that compares two files, exactly: every pixel that differs counts.
pub(crate) struct Tool {
    pub(crate) name: String,
    /// Name and version.
    pub(crate) version: String,
    program: PathBuf,
    before: Vec<OsString>,
    after: Vec<OsString>,
}

impl Tool {
    pub(crate) fn dejag(options: &[&str]) -> Self {
        let program = PathBuf::from(env!("CARGO_BIN_EXE_dejag"));
        let version = said(&program, &["--version"]).unwrap_or_default();
        let name = ["dejag diff"].iter().chain(options).copied().collect::<Vec<_>>().join(" ");
        Self { name, version, program, before: words(&["diff", "-q"]), after: words(options) }
    }

    pub(crate) fn command(&self, pair: &Pair) -> Command {
        let mut command = Command::new(&self.program);
        command.args(&self.before).args([&pair.expected, &pair.actual]).args(&self.after);
        command
    }

    /// Of those that take folders, what compares all pairs.
    pub(crate) fn folders(&self, folder: &Path) -> Option<Command> {
        self.name.starts_with("dejag").then(|| {
            let mut command = Command::new(&self.program);
            command.args(&self.before).args([folder.join("expected"), folder.join("actual")]).args(&self.after);
            command
        })
    }
}

/// Those that are here, and a line for each that is not.
pub(crate) fn found(options: &Options, scratch: &Path) -> (Vec<Tool>, Vec<String>) {
    let peers = options.peers.as_deref();
    let (mut tools, mut absent) = (vec![Tool::dejag(&[])], Vec::new());
    for (tool, install) in [
        (peers.and_then(odiff), "odiff is absent: npm install --prefix DIR odiff-bin, and --peers DIR"),
        (peers.and_then(|peers| dify(peers, scratch)), "dify is absent: cargo install --root DIR dify, and --peers DIR"),
        (peers.and_then(pixelmatch), "pixelmatch is absent: npm install --prefix DIR pixelmatch pngjs, and --peers DIR"),
        (compare(), "ImageMagick's compare is absent: apt-get install imagemagick, or what your system calls it"),
    ] {
        match tool {
            Some(tool) => tools.push(tool),
            None => absent.push(install.to_owned()),
        }
    }
    (tools, absent)
}

/// Its native program, without the start of Node that its wrapper costs.
fn odiff(peers: &Path) -> Option<Tool> {
    let platforms = std::fs::read_dir(peers.join("node_modules/@odiff")).ok()?;
    let program = platforms.flatten().map(|entry| entry.path().join("odiff")).find(|path| path.is_file())?;
    // Its name stands before the version, and behind it what it is.
    let version = said(&program, &["--version"])?.split(" - ").next()?.to_owned();
    Some(Tool { name: "odiff".into(), version, program, before: Vec::new(), after: words(&["--threshold=0"]) })
}

/// It always writes a picture of what differs.
fn dify(peers: &Path, scratch: &Path) -> Option<Tool> {
    let program = peers.join("bin/dify");
    let version = format!("dify {}", said(&program, &["--version"])?);
    let mut before = words(&["-t", "0", "-o"]);
    before.push(scratch.join("dify.png").into());
    Some(Tool { name: "dify".into(), version, program, before, after: Vec::new() })
}

/// Without its picture, anti-aliased pixels counted too.
fn pixelmatch(peers: &Path) -> Option<Tool> {
    let folder = peers.join("node_modules/pixelmatch");
    let package = std::fs::read_to_string(folder.join("package.json")).ok()?;
    let package: serde_json::Value = serde_json::from_str(&package).ok()?;
    let version = format!("pixelmatch {}, Node {}", package["version"].as_str()?, said(Path::new("node"), &["--version"])?);
    let before = vec![folder.join("bin/pixelmatch").into()];
    Some(Tool { name: "pixelmatch".into(), version, program: "node".into(), before, after: words(&["", "0", "true"]) })
}

fn compare() -> Option<Tool> {
    let version = said(Path::new("compare"), &["-version"])?;
    let name = "ImageMagick compare".into();
    Some(Tool { name, version, program: "compare".into(), before: words(&["-metric", "AE"]), after: words(&["null:"]) })
}

/// The first line that a program says.
fn said(program: &Path, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok()?;
    let text = String::from_utf8_lossy(if output.stdout.is_empty() { &output.stderr } else { &output.stdout }).into_owned();
    text.lines().next().map(|line| line.trim_start_matches("Version: ").to_owned())
}

fn words(words: &[&str]) -> Vec<OsString> {
    words.iter().map(OsString::from).collect()
}
