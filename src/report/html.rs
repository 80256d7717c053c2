//! The report as a folder with one page that opens from disk.

use super::folder::{self, Staging};
use super::labels::Labels;
use super::{json, page};
use crate::picture::{BitDepth, DisplayPicture, load, write_bytes_atomically};
use crate::suite::{Outcome, Results};
use crate::{Error, Result};
use std::path::Path;

/// What [`write_html`] shows: results, and the pictures behind them.
#[derive(Debug)]
pub struct ReportInput<'a> {
    /// The figures.
    pub results: &'a Results,
    /// The pictures of each scene, in the order of the results.
    pub scenes: Vec<ScenePictures<'a>>,
}

/// The pictures of one scene.
#[derive(Debug)]
pub struct ScenePictures<'a> {
    /// The reference as displayed.
    pub reference: &'a DisplayPicture,
    /// The pictures of each method, in the order of the results; none where a method failed.
    pub methods: Vec<Option<MethodPictures<'a>>>,
}

/// The pictures of one method on one scene.
#[derive(Debug, Clone, Copy)]
pub struct MethodPictures<'a> {
    /// The capture as displayed.
    pub capture: &'a DisplayPicture,
    /// Its error map, such as [`crate::metrics::error_map`]; none where it cannot be made.
    pub error_map: Option<&'a DisplayPicture>,
}

/// Writes a report into the folder `dir`: `index.html`, `pictures/` and `results.json`, whole or not at all. Its parents are
/// created; a report that is there is replaced.
///
/// # Errors
///
/// [`Error::Request`] if `dir` holds anything but a report, or if the pictures do not belong to the results;
/// [`Error::Io`] if it cannot be written.
pub fn write_html(dir: &Path, input: &ReportInput<'_>) -> Result<()> {
    let mut report = HtmlReport::begin(dir)?;
    if input.scenes.len() != input.results.scenes.len() {
        return Err(mismatch("scenes", input.results.scenes.len(), input.scenes.len()));
    }
    for (scene, pictures) in input.results.scenes.iter().zip(&input.scenes) {
        if pictures.methods.len() != scene.methods.len() {
            return Err(mismatch("methods", scene.methods.len(), pictures.methods.len()));
        }
        report.add_scene(&scene.name, pictures.reference)?;
        for (method, pictures) in scene.methods.iter().zip(&pictures.methods) {
            if let Some(pictures) = pictures {
                report.add_method(&method.spec, *pictures)?;
            }
        }
    }
    report.finish(input.results)
}

fn mismatch(what: &str, results: usize, pictures: usize) -> Error {
    Error::Request(format!("a report needs the pictures of all its {what}: {results} have results, {pictures} pictures"))
}

/// A report that is written while the run goes on, so that pictures need not be kept: begin, for each scene its reference and
/// then its methods, finish. Begun early it also finds out early that a folder is taken. Dropped unfinished, it leaves nothing.
#[derive(Debug)]
pub struct HtmlReport {
    staging: Staging,
    scenes: Vec<SceneFiles>,
}

/// Where a scene's pictures lie, relative to the page.
#[derive(Debug)]
pub(super) struct SceneFiles {
    name: String,
    pub(super) reference: String,
    methods: Vec<(String, MethodFiles)>,
}

/// Where a method's pictures lie, relative to the page.
#[derive(Debug)]
pub(super) struct MethodFiles {
    pub(super) capture: String,
    pub(super) error_map: Option<String>,
}

impl SceneFiles {
    pub(super) fn method(&self, spec: &str) -> Option<&MethodFiles> {
        self.methods.iter().find(|(known, _)| known == spec).map(|(_, files)| files)
    }
}

impl HtmlReport {
    /// Begins a report that is to become the folder `dir`. Nothing is seen there until [`Self::finish`], which creates its parents
    /// too.
    ///
    /// # Errors
    ///
    /// [`Error::Request`] if `dir` holds anything but a report; [`Error::Io`] if it cannot be written.
    pub fn begin(dir: &Path) -> Result<Self> {
        let staging = Staging::begin(folder::REPORT, dir)?;
        let pictures = staging.path().join("pictures");
        std::fs::create_dir(&pictures).map_err(Error::io("create the folder", &pictures))?;
        Ok(Self { staging, scenes: Vec::new() })
    }

    /// Adds the next scene with its reference.
    ///
    /// # Errors
    ///
    /// [`Error::Io`] if the picture cannot be written.
    pub fn add_scene(&mut self, name: &str, reference: &DisplayPicture) -> Result<()> {
        let file = reference_file(self.scenes.len() + 1, name);
        self.save(&file, reference)?;
        self.scenes.push(SceneFiles { name: name.into(), reference: file, methods: Vec::new() });
        Ok(())
    }

    /// Adds a method's pictures to the scene that was added last.
    ///
    /// # Errors
    ///
    /// [`Error::Io`] if a picture cannot be written; [`Error::Request`] if there is no scene yet.
    pub fn add_method(&mut self, spec: &str, pictures: MethodPictures<'_>) -> Result<()> {
        let number = self.scenes.len();
        let Some(scene) = self.scenes.last() else {
            return Err(Error::Request("a report needs a scene before a method".into()));
        };
        let [capture, error_map] = method_files((number, &scene.name), (scene.methods.len() + 1, spec));
        let files = MethodFiles { capture, error_map: pictures.error_map.map(|_| error_map) };
        self.save(&files.capture, pictures.capture)?;
        if let (Some(file), Some(map)) = (&files.error_map, pictures.error_map) {
            self.save(file, map)?;
        }
        self.scenes[number - 1].methods.push((spec.into(), files));
        Ok(())
    }

    /// Adds the next scene with the pictures that another report, of `results` in `folder`, has of its scene at `place`.
    ///
    /// # Errors
    ///
    /// [`Error::Io`] and [`Error::Format`] if its pictures are not there, or cannot be written.
    pub fn take_over(&mut self, results: &Results, folder: &Path, place: usize) -> Result<()> {
        let scene = &results.scenes[place];
        let read = |file: &str| Ok::<_, Error>(load(&folder.join(file))?.into_display());
        self.add_scene(&scene.name, &read(&reference_file(place + 1, &scene.name))?)?;
        let scored = scene.methods.iter().filter(|method| matches!(method.outcome, Outcome::Scored { .. }));
        for (k, method) in scored.enumerate() {
            let [capture, error_map] = method_files((place + 1, &scene.name), (k + 1, &method.spec));
            let capture = read(&capture)?;
            // Where there is no number there is no map.
            let error_map = folder.join(&error_map).is_file().then(|| read(&error_map)).transpose()?;
            self.add_method(&method.spec, MethodPictures { capture: &capture, error_map: error_map.as_ref() })?;
        }
        Ok(())
    }

    /// Writes the page and puts the folder in its place.
    ///
    /// # Errors
    ///
    /// [`Error::Request`] if the scenes that were added are not those of the results; [`Error::Io`] if it cannot be written.
    pub fn finish(self, results: &Results) -> Result<()> {
        if !self.scenes.iter().map(|scene| &scene.name).eq(results.scenes.iter().map(|scene| &scene.name)) {
            return Err(mismatch("scenes", results.scenes.len(), self.scenes.len()));
        }
        let page = page::page(results, &self.scenes, &Labels::of(results));
        write_bytes_atomically(&self.staging.path().join("index.html"), page.as_bytes())?;
        write_bytes_atomically(&self.staging.path().join("results.json"), json(results).as_bytes())?;
        self.staging.publish()
    }

    fn save(&self, file: &str, picture: &DisplayPicture) -> Result<()> {
        picture.save_png(&self.staging.path().join(file), BitDepth::Eight, &[])
    }
}

/// The file of a scene's reference, relative to the page; scenes are counted from 1.
fn reference_file(number: usize, scene: &str) -> String {
    format!("pictures/{number:02}-{}-reference.png", slug(scene))
}

/// The files of a method's capture and error map, relative to the page; both are counted from 1.
fn method_files((number, scene): (usize, &str), (method, spec): (usize, &str)) -> [String; 2] {
    let stem = format!("pictures/{number:02}-{}-{method:02}-{}", slug(scene), slug(spec));
    [format!("{stem}.png"), format!("{stem}-error.png")]
}

/// A name as part of a file's name on any system: lower-case letters, digits and hyphens.
pub(super) fn slug(name: &str) -> String {
    let plain = name.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' });
    let slug: String = plain.take(48).collect();
    let slug = slug.trim_matches('-');
    if slug.is_empty() { "unnamed".into() } else { slug.into() }
}
