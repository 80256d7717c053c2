//! The pictures of a case in the report's folder: numbered, so that no name of a case reaches the file system.

use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use super::plain_png::is_plain;
use super::thumbnail::thumbnail;
use super::{CasePictures, is_same};
use crate::picture::{BitDepth, Channels, DisplayPicture, LinearPicture, Raster, write_bytes_atomically};
use crate::suite::CheckedCase;
use crate::{Error, Result};

/// What a picture may take when decoded, in bytes: as `diff` has it by default.
const MAX_BYTES: u64 = 2 << 30;

/// Width and height that pictures have in the overview, in CSS pixels, at most.
const SHOWN_PX: [u32; 2] = [160, 120];

/// Where a case's pictures lie, relative to the page.
#[derive(Debug, Default)]
pub(super) struct CaseFiles {
    pub(super) expected: Picture,
    pub(super) actual: Picture,
    pub(super) heat: Picture,
    /// The script that holds the values of both; absent if there is neither.
    pub(super) pixels: Option<String>,
}

/// What became of a picture.
#[derive(Debug, Default)]
pub(super) enum Picture {
    /// It is not at hand.
    #[default]
    Absent,
    /// It could not be read, and why.
    Unreadable(String),
    /// It is the same, pixel by pixel, as the one beside it, and shown there.
    Twin,
    /// It is shown.
    Shown {
        /// The file in the overview.
        small: String,
        /// Width and height there, in CSS pixels.
        small_px: [u32; 2],
        /// The file in full size; absent where a script alone holds it.
        full: Option<String>,
    },
}

impl Picture {
    /// Its file in full size.
    pub(super) fn full(&self) -> Option<&str> {
        match self {
            Self::Shown { full, .. } => full.as_deref(),
            _ => None,
        }
    }
}

/// A picture that was read, and the bytes of a PNG that holds all its values.
struct Loaded {
    picture: DisplayPicture,
    png: Vec<u8>,
}

type Side = Result<Option<Loaded>, String>;

impl CaseFiles {
    /// Writes what the page shows of the case of that number.
    pub(super) fn write(folder: &Path, number: usize, case: &CheckedCase, pictures: &CasePictures) -> Result<Self> {
        let writer = Writer { folder, number, large: !is_same(case) };
        let actual = read(pictures.actual.as_deref());
        let (expected, twins) = read_beside(case, pictures, &actual);
        let pixels = writer.pixels(&expected, &actual, twins)?;
        Ok(Self {
            expected: if twins { Picture::Twin } else { writer.picture("expected", expected)? },
            actual: writer.picture("actual", actual)?,
            heat: writer.picture("heat", read(pictures.heat.as_deref()))?,
            pixels,
        })
    }
}

/// The expected picture, unless it is known to be the actual one's twin.
fn read_beside(case: &CheckedCase, pictures: &CasePictures, actual: &Side) -> (Side, bool) {
    let Ok(Some(actual)) = actual.as_ref() else { return (read(pictures.expected.as_deref()), false) };
    let golden = case.golden.as_ref().and_then(|golden| golden.hash.as_ref());
    if golden.is_some() && golden == case.candidate_hash.as_ref() {
        return (Ok(None), true);
    }
    let expected = read(pictures.expected.as_deref());
    let twins = is_same(case) && expected.as_ref().is_ok_and(|e| e.as_ref().is_some_and(|e| e.picture == actual.picture));
    (expected, twins)
}

/// A picture that cannot be read is none, and the report goes on.
fn read(path: Option<&Path>) -> Side {
    path.map(|path| load(path).map_err(|error| error.to_string())).transpose()
}

/// Levels keep their depth; floats become display values of 16 bits.
fn load(path: &Path) -> Result<Loaded> {
    let raster = Raster::read(path, MAX_BYTES)?;
    let [width, height] = raster.size();
    let pixels = (0..height).flat_map(|y| raster.row(y)).collect();
    let (picture, depth) = match raster.channels() {
        Channels::Eight(_) => (DisplayPicture::new(width, height, pixels)?, BitDepth::Eight),
        Channels::Sixteen(_) => (DisplayPicture::new(width, height, pixels)?, BitDepth::Sixteen),
        Channels::Float(_) => (LinearPicture::new(width, height, pixels)?.to_display(), BitDepth::Sixteen),
    };
    let own = std::fs::read(path).map_err(Error::io("read", path))?;
    if is_plain(&own) {
        return Ok(Loaded { picture, png: own });
    }
    let mut png = Vec::new();
    picture.encode_png(&mut png, depth, &[]).map_err(Error::io("encode", path))?;
    Ok(Loaded { picture, png })
}

/// Names and writes the files of one case.
struct Writer<'a> {
    folder: &'a Path,
    number: usize,
    /// Whether pictures are kept in full size, and twice as fine in the overview: those that somebody looks at and prints.
    large: bool,
}

impl Writer<'_> {
    fn picture(&self, kind: &str, side: Side) -> Result<Picture> {
        let Loaded { picture, png } = match side {
            Ok(Some(loaded)) => loaded,
            Ok(None) => return Ok(Picture::Absent),
            Err(why) => return Ok(Picture::Unreadable(why)),
        };
        let stem = format!("pictures/{:05}-{kind}", self.number);
        let most = if self.large { SHOWN_PX.map(|side| 2 * side) } else { SHOWN_PX };
        let reduced = thumbnail(&picture, most)?;
        let small_px = shown_px(reduced.as_ref().unwrap_or(&picture).size());
        let full = (self.large || reduced.is_none()).then(|| format!("{stem}.png"));
        if let Some(file) = &full {
            self.save(file, &png)?;
        }
        let small = match (&reduced, &full) {
            (None, Some(full)) => full.clone(),
            _ => format!("{stem}-small.png"),
        };
        if let Some(reduced) = reduced {
            reduced.save_png(&self.folder.join(&small), BitDepth::Eight, &[])?;
        }
        Ok(Picture::Shown { small, small_px, full })
    }

    /// Pages from disk may show a picture but not read its values: those come as a script.
    fn pixels(&self, expected: &Side, actual: &Side, twins: bool) -> Result<Option<String>> {
        let text = |side: &Side| side.as_ref().ok().and_then(Option::as_ref).map(|loaded| STANDARD.encode(&loaded.png));
        let sides: Vec<String> = [("expected", text(expected).filter(|_| !twins)), ("actual", text(actual))]
            .into_iter()
            .filter_map(|(name, png)| Some(format!("{name}: \"{}\"", png?)))
            .collect();
        if sides.is_empty() {
            return Ok(None);
        }
        let name = format!("pixels/{:05}.js", self.number);
        let call = format!("dejagPixels(\"{name}\", {{ twins: {twins}, {} }});\n", sides.join(", "));
        self.save(&name, call.as_bytes())?;
        Ok(Some(name))
    }

    fn save(&self, file: &str, bytes: &[u8]) -> Result<()> {
        write_bytes_atomically(&self.folder.join(file), bytes)
    }
}

/// Reduced to fit into [`SHOWN_PX`], never enlarged.
fn shown_px(size: [u32; 2]) -> [u32; 2] {
    let scale = (0..2).map(|i| f64::from(SHOWN_PX[i]) / f64::from(size[i])).fold(1.0, f64::min);
    size.map(|side| (f64::from(side) * scale).round().max(1.0) as u32)
}
