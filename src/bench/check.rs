//! What `dejag check` has drawn: frames of scenes with methods.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};

use crate::capture::{Capture, Studio, Watch};
use crate::check::{Drawer, Drawing, Format, Subject};
use crate::error::{Error, Result};
use crate::gpu::Gpu;
use crate::methods::Spec;
use crate::picture::Loaded;
use crate::scene::{Scene, Tick};
use crate::suite::Stamp;

/// Draws the entries of a manifest. Each scene is read once.
#[derive(Debug)]
pub struct Darkroom {
    gpu: Gpu,
    root: PathBuf,
    scenes: BTreeMap<String, Scene>,
    program: String,
    watch: fn() -> Result<()>,
}

impl Darkroom {
    /// On this device; scene files are found below `root`. `watch` is asked between draws whether to go on.
    ///
    /// # Errors
    ///
    /// [`Error::Io`] if the running program's own file cannot be read, which tells one build's pictures from another's.
    pub fn new(gpu: Gpu, root: &Path, watch: fn() -> Result<()>) -> Result<Self> {
        Ok(Self { gpu, root: root.to_path_buf(), scenes: BTreeMap::new(), program: program_hash()?, watch })
    }

    fn scene(&mut self, name: &str) -> Result<&Scene> {
        if !self.scenes.contains_key(name) {
            let file = self.root.join(name);
            let scene = if file.is_file() { Scene::load(&file.to_string_lossy()) } else { Scene::load(name) };
            self.scenes.insert(name.to_owned(), scene?);
        }
        Ok(&self.scenes[name])
    }
}

/// Another build may draw other bits.
fn program_hash() -> Result<String> {
    let path = std::env::current_exe().map_err(Error::io("find", Path::new("this program's file")))?;
    let file = File::open(&path).map_err(Error::io("read", &path))?;
    let mut hasher = blake3::Hasher::new();
    hasher.update_reader(file).map_err(Error::io("read", &path))?;
    Ok(hasher.finalize().to_hex().to_string())
}

/// Asks a function between draws.
struct Asking(fn() -> Result<()>);

impl Watch for Asking {
    fn tick(&mut self, _: u32, _: u32) -> Result<()> {
        (self.0)()
    }
}

impl Drawer for Darkroom {
    fn stamp(&self) -> Stamp {
        Stamp::from(&self.gpu.card)
    }

    fn source(&mut self, subject: &Subject) -> Result<String> {
        let drawing = drawing_of(subject)?;
        let spec = Spec::parse(&drawing.method)?;
        let (program, stamp) = (self.program.clone(), self.stamp());
        let scene = self.scene(&drawing.scene)?;
        if let Subject::Capture(_, frame) = subject {
            scene.frame(*frame, drawing.size)?;
        }
        let facts = format!("{program}\n{stamp:?}\n{:?}\n{spec}\n{subject:?}", scene.fingerprint);
        Ok(blake3::hash(facts.as_bytes()).to_hex().to_string())
    }

    fn draw(&mut self, subject: &Subject, found: &mut dyn FnMut(Option<i64>, Loaded) -> Result<()>) -> Result<()> {
        let drawing = drawing_of(subject)?;
        let spec = Spec::parse(&drawing.method)?;
        let mut watch = Asking(self.watch);
        self.scene(&drawing.scene)?;
        let scene = &self.scenes[&drawing.scene];
        let mut studio = Studio::new(&self.gpu, scene)?;
        match subject {
            Subject::Sequence(_, frames) => {
                let mut shot = studio.shot(&spec, 0, drawing.size)?;
                for index in frames.clone() {
                    let opening = index == frames.start;
                    let tick = Tick::of(scene, index);
                    shot.move_to(if opening { tick.opening() } else { tick }, opening);
                    studio.take(&mut shot, None, &mut watch)?;
                    found(Some(index), stored(drawing, studio.read(&shot)?))?;
                }
                Ok(())
            }
            Subject::Capture(_, frame) => {
                let capture = studio.capture(&spec, *frame, drawing.size, &mut watch)?;
                found(None, stored(drawing, capture))
            }
            Subject::File(_) | Subject::Folder(..) => Ok(()),
        }
    }
}

fn drawing_of(subject: &Subject) -> Result<&Drawing> {
    match subject {
        Subject::Capture(drawing, _) | Subject::Sequence(drawing, _) => Ok(drawing),
        Subject::File(_) | Subject::Folder(..) => Err(Error::Request("files are read, not drawn".into())),
    }
}

/// Linear values where they are asked for and the method has any.
fn stored(drawing: &Drawing, Capture { linear, display, .. }: Capture) -> Loaded {
    match (drawing.format, linear) {
        (Format::Exr, Some(linear)) => Loaded::Linear(linear),
        _ => Loaded::Display(display),
    }
}
