//! The frames of a sequence as numbered files, a folder for each method.

use super::folder::{self, Staging};
use super::html::slug;
use crate::picture::{BitDepth, DisplayPicture, FileFormat, LinearPicture};
use crate::{Error, Result};
use std::fs;
use std::path::Path;

/// Numbered pictures that are written while a run goes on, and appear all together. Dropped unfinished, it leaves nothing.
#[derive(Debug)]
pub struct FramesFolder {
    staging: Staging,
    format: FileFormat,
    /// A folder for each method.
    names: Vec<String>,
}

impl FramesFolder {
    /// Begins a folder that is to become `dir`. Nothing is seen there until [`Self::finish`], which creates its parents too. Each
    /// method gets a folder named after it; names that would be the same are numbered.
    ///
    /// # Errors
    ///
    /// [`Error::Request`] if `dir` holds anything but frames of an earlier run; [`Error::Io`] if it cannot be written.
    pub fn begin(dir: &Path, format: FileFormat, methods: &[&str]) -> Result<Self> {
        let staging = Staging::begin(folder::FRAMES, dir)?;
        let mut names: Vec<String> = Vec::new();
        for method in methods {
            let plain = slug(method);
            let numbered = (2..).map(|n| format!("{plain}-{n}"));
            let name = std::iter::once(plain.clone()).chain(numbered).find(|name| !names.contains(name)).unwrap_or_default();
            let path = staging.path().join(&name);
            fs::create_dir(&path).map_err(Error::io("create the folder", &path))?;
            names.push(name);
        }
        Ok(Self { staging, format, names })
    }

    /// Writes a frame of the `method`-th method: display values as PNG of 8 bits, linear values as EXR.
    ///
    /// # Errors
    ///
    /// [`Error::Io`] if it cannot be written; [`Error::Request`] if there is no such method.
    pub fn add(&self, method: usize, frame: usize, display: &DisplayPicture, linear: Option<&LinearPicture>) -> Result<()> {
        let Some(name) = self.names.get(method) else {
            return Err(Error::Request(format!("there is no method {method} among {}", self.names.len())));
        };
        let stem = self.staging.path().join(name);
        match self.format {
            FileFormat::Png => display.save_png(&stem.join(format!("{frame:05}.png")), BitDepth::Eight, &[]),
            FileFormat::Exr => {
                let path = stem.join(format!("{frame:05}.exr"));
                linear.map_or_else(|| display.to_linear().save_exr(&path, &[]), |linear| linear.save_exr(&path, &[]))
            }
        }
    }

    /// Puts the folder in its place.
    ///
    /// # Errors
    ///
    /// [`Error::Io`] if it cannot be written.
    pub fn finish(self) -> Result<()> {
        self.staging.publish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_appear_together_and_methods_keep_apart() {
        let home = tempfile::tempdir().expect("a folder");
        let target = home.path().join("deep/frames");
        let picture = DisplayPicture::from_fn(3, 2, |x, y| [x as f32 / 4.0, y as f32, 0.5, 1.0]).expect("a size");
        let folder = FramesFolder::begin(&target, FileFormat::Png, &["m:a=1", "m:a,1", "reference"]).expect("begun");
        for method in 0..3 {
            folder.add(method, method, &picture, None).expect("written");
        }
        assert!(!target.exists());
        folder.finish().expect("published");
        for file in ["m-a-1/00000.png", "m-a-1-2/00001.png", "reference/00002.png"] {
            assert!(target.join(file).is_file(), "{file}");
        }
        drop(FramesFolder::begin(&target, FileFormat::Exr, &["m"]).expect("frames of an earlier run may be replaced"));
        assert!(target.join("m-a-1/00000.png").is_file(), "but not before there are new ones");
    }

    #[test]
    fn a_method_that_there_is_not_is_refused() {
        let home = tempfile::tempdir().expect("a folder");
        let picture = DisplayPicture::from_fn(1, 1, |_, _| [0.0; 4]).expect("a size");
        let folder = FramesFolder::begin(&home.path().join("f"), FileFormat::Exr, &["m"]).expect("begun");
        assert!(folder.add(1, 0, &picture, None).is_err());
        drop(folder);
        assert_eq!(fs::read_dir(home.path()).expect("a folder").count(), 0);
    }
}
