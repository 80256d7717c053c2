//! What a manifest may say, as plain structs. Unknown keys are refused.

use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use toml::Spanned;

use super::entry::{Drawing, Entry, Format, Subject};
use super::manifest::check_id;
use super::tolerance::Tolerance;
use super::words::{self, Area, Several};
use crate::compare::Filter;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", expecting = "a manifest")]
pub(super) struct Document {
    #[serde(default = "goldens")]
    pub(super) goldens: PathBuf,
    #[serde(default = "output")]
    pub(super) output: PathBuf,
    #[serde(default)]
    pub(super) fallback: Vec<Spanned<String>>,
    #[serde(default)]
    pub(super) tolerance: Tolerance,
    #[serde(default, rename = "override")]
    pub(super) overrides: Vec<OverrideDocument>,
    #[serde(default)]
    pub(super) capture: Vec<Spanned<CaptureDocument>>,
    #[serde(default)]
    pub(super) sequence: Vec<Spanned<SequenceDocument>>,
    #[serde(default)]
    pub(super) files: Vec<Spanned<FilesDocument>>,
}

fn goldens() -> PathBuf {
    "goldens".into()
}

fn output() -> PathBuf {
    "dejag-check".into()
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", expecting = "an override")]
pub(super) struct OverrideDocument {
    pub(super) case: Option<Spanned<String>>,
    pub(super) environment: Option<Spanned<String>>,
    pub(super) platform: Option<Spanned<String>>,
    pub(super) tolerance: Tolerance,
}

/// What every entry may say.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default, expecting = "a table")]
pub(super) struct Scoping {
    pub(super) mask: Option<PathBuf>,
    pub(super) ignore: Vec<Area>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", expecting = "a capture")]
pub(super) struct CaptureDocument {
    pub(super) id: Option<String>,
    pub(super) scene: Several,
    #[serde(default = "plain")]
    pub(super) method: Several,
    #[serde(default = "usual_size", deserialize_with = "words::size")]
    pub(super) size: [u32; 2],
    #[serde(default)]
    pub(super) frame: u32,
    #[serde(default)]
    pub(super) format: Format,
    #[serde(default)]
    pub(super) tolerance: Tolerance,
    #[serde(default)]
    pub(super) scope: Scoping,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", expecting = "a sequence")]
pub(super) struct SequenceDocument {
    pub(super) id: Option<String>,
    pub(super) scene: Several,
    #[serde(default = "plain")]
    pub(super) method: Several,
    #[serde(default = "usual_size", deserialize_with = "words::size")]
    pub(super) size: [u32; 2],
    #[serde(deserialize_with = "words::frames")]
    pub(super) frames: Range<i64>,
    #[serde(default)]
    pub(super) format: Format,
    #[serde(default)]
    pub(super) tolerance: Tolerance,
    #[serde(default)]
    pub(super) scope: Scoping,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", expecting = "files")]
pub(super) struct FilesDocument {
    pub(super) id: String,
    pub(super) file: Option<PathBuf>,
    pub(super) folder: Option<PathBuf>,
    #[serde(default)]
    pub(super) include: Vec<String>,
    #[serde(default)]
    pub(super) exclude: Vec<String>,
    #[serde(default)]
    pub(super) tolerance: Tolerance,
    #[serde(default)]
    pub(super) scope: Scoping,
}

fn plain() -> Several {
    Several(vec!["none".into()])
}

fn usual_size() -> [u32; 2] {
    [640, 360]
}

impl CaptureDocument {
    pub(super) fn entries(&self, tolerance: &Tolerance) -> Result<Vec<Entry>, String> {
        let names = Names { id: self.id.as_deref(), scenes: &self.scene.0, methods: &self.method.0, size: self.size };
        let suffix = if self.frame == 0 { String::new() } else { format!("-frame-{}", self.frame) };
        names.entries(
            self.format,
            &suffix,
            |drawing| Subject::Capture(drawing, self.frame),
            |id, subject| self.scope.entry(id, subject, tolerance.with(&self.tolerance)),
        )
    }
}

impl SequenceDocument {
    pub(super) fn entries(&self, tolerance: &Tolerance) -> Result<Vec<Entry>, String> {
        let names = Names { id: self.id.as_deref(), scenes: &self.scene.0, methods: &self.method.0, size: self.size };
        names.entries(
            self.format,
            "",
            |drawing| Subject::Sequence(drawing, self.frames.clone()),
            |id, subject| self.scope.entry(id, subject, tolerance.with(&self.tolerance)),
        )
    }
}

impl FilesDocument {
    pub(super) fn entry(&self, tolerance: &Tolerance) -> Result<Entry, String> {
        let subject = match (&self.file, &self.folder) {
            (Some(file), None) if self.include.is_empty() && self.exclude.is_empty() => Subject::File(file.clone()),
            (Some(_), None) => return Err("`include` and `exclude` choose among the files of a `folder`".into()),
            (None, Some(folder)) => {
                let filter = Filter::new(&self.include, &self.exclude).map_err(|error| error.to_string())?;
                Subject::Folder(folder.clone(), filter)
            }
            _ => return Err("files need either `file` or `folder`".into()),
        };
        self.scope.entry(self.id.clone(), subject, tolerance.with(&self.tolerance))
    }
}

impl Scoping {
    pub(super) fn entry(&self, id: String, subject: Subject, tolerance: Tolerance) -> Result<Entry, String> {
        check_id(&id)?;
        let ignored = self.ignore.iter().map(|area| area.0).collect();
        Ok(Entry { id, subject, tolerance, mask: self.mask.clone(), ignored })
    }
}

/// Every scene with every method.
struct Names<'a> {
    id: Option<&'a str>,
    scenes: &'a [String],
    methods: &'a [String],
    size: [u32; 2],
}

impl Names<'_> {
    pub(super) fn entries(
        &self,
        format: Format,
        suffix: &str,
        subject: impl Fn(Drawing) -> Subject,
        entry: impl Fn(String, Subject) -> Result<Entry, String>,
    ) -> Result<Vec<Entry>, String> {
        let several = self.scenes.len() * self.methods.len() > 1;
        if several && self.id.is_some() {
            return Err("an `id` names one scene with one method; leave it out, or name one of each".into());
        }
        let mut entries = Vec::new();
        for (scene, method) in self.scenes.iter().flat_map(|scene| self.methods.iter().map(move |method| (scene, method))) {
            let drawing = Drawing { scene: scene.clone(), method: method.clone(), size: self.size, format };
            let id = self.id.map_or_else(|| format!("{}{suffix}", id_of(scene, method)), ToOwned::to_owned);
            entries.push(entry(id, subject(drawing))?);
        }
        Ok(entries)
    }
}

/// `edges-smaa-mode-s2x` of `scenes/edges.toml` and `smaa:mode=s2x`.
fn id_of(scene: &str, method: &str) -> String {
    let stem = Path::new(scene).file_stem().map_or_else(|| scene.into(), |stem| stem.to_string_lossy());
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '_');
    format!("{stem}-{method}").replace(|c: char| !plain(c), "-")
}
